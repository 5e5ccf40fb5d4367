//! Picking: what is under a pixel or in a region of an image, down to the faces, edges and vertices
//! of polygons.
//!
//! [`Picker`] defines the rule. Visible faces are read from an image's ids (`search`); everything else is
//! decided in f64: `screen` and `object` locate the points of elements, `nearby` (by `sides`; in small regions
//! `few`, `beyond`) finds what may lie in a region (`region`, `lasso`), `kind` what does, `hiding` (with
//! `occluders`, `probes` and `forms`) which of these a face hides, and `covering` which pixel centres a face
//! covers.

mod beyond;
mod covering;
mod elements;
mod few;
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
mod snap;
#[cfg(test)]
mod tests;

pub use nearest::Nearest;
pub use picker::{Pick, Picker, Reach};
pub use region::Region;
pub use snap::{Snap, SnapElement};
