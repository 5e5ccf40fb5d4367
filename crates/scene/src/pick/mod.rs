//! Picking: what is under a pixel or in a region of an image, down to the faces, edges and vertices of polygons.
//!
//! The documentation of [`Picker`] says what counts as hit. Visible faces are read from an image's ids. Everything
//! else is decided in f64; f32 is used only where it proves the same answer.
//!
//! | file | what it does |
//! |---|---|
//! | `picker` | the public picker; points of the scene that a pointer snaps to |
//! | `search` | **which faces a point or a region hits**; how pixels, triangles and points are visited |
//! | `nearest` | the elements nearest to a point; distances from a polygon; sets of elements |
//! | `region` | which points lie in a region; the even-odd rule; which side of an area a point is on |
//! | `screen` | screen positions of an object's points |
//! | `object` | an object's data that outlive a picker |
//! | `nearby` | the objects near an area, and which of their elements may lie in the area |
//! | `small_region` | for small areas: skips whole boxes of triangles |
//! | `hiding` | **which points a face hides** |
//! | `occluders`, `forms` | the triangles and the points of that test; a quick proof in f32 that a point is not hidden |
//! | `covering` | the pixel centres that a face covers |

mod covering;
mod forms;
mod hiding;
mod nearby;
mod nearest;
mod object;
mod occluders;
mod picker;
mod region;
mod screen;
mod search;
mod small_region;
#[cfg(test)]
mod tests;

pub use nearest::Nearest;
pub use object::CachedPoints;
pub use picker::{Pick, Picker, Reach, Snap, SnapElement};
pub use region::Region;
