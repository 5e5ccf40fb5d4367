//! Picking: what is under a pixel or in a region of an image, down to the faces, edges and vertices of polygons.
//!
//! [`Picker`] defines the rule. Visible faces are read from an image's ids. Everything else is decided in f64.
//!
//! | file | what it does |
//! |---|---|
//! | `picker` | the public picker |
//! | `search` | **which faces a point or a region hits**; how pixels, triangles and points are visited |
//! | `nearest`, `snap` | the elements nearest to a point; points of the scene that a pointer snaps to |
//! | `region`, `lasso`, `outline` | which points lie in a region; the even-odd rule; distances from a polygon |
//! | `screen`, `object` | screen positions of an object's points |
//! | `facing` | which sides of faces are drawn |
//! | `cached_points` | what outlives a picker: screen positions and visible vertices |
//! | `nearby` | the objects near an area, and which of their elements may lie in it |
//! | `sides` | for large areas: one byte per point, which side of the area it is on |
//! | `small_region`, `box_culling` | for small areas: skips whole boxes of triangles |
//! | `kind` | vertices and edges: the points that must be visible |
//! | `hiding` | **which points a face hides** |
//! | `occluders`, `probes`, `forms` | the triangles and the points of that test; a quick proof in f32 that a point is not hidden |
//! | `covering` | the pixel centres that a face covers |
//! | `elements` | sets of elements |

mod box_culling;
mod cached_points;
mod covering;
mod elements;
mod facing;
mod forms;
mod hiding;
mod kind;
mod lasso;
mod nearby;
mod nearest;
mod object;
mod occluders;
mod outline;
mod picker;
mod probes;
mod region;
mod screen;
mod search;
mod sides;
mod small_region;
mod snap;
#[cfg(test)]
mod tests;

pub use cached_points::CachedPoints;
pub use nearest::Nearest;
pub use picker::{Pick, Picker, Reach};
pub use region::Region;
pub use snap::{Snap, SnapElement};
