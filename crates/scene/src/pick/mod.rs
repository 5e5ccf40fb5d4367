//! Picking: what of a scene is under a pixel or in a region of a picture, down to the
//! faces, edges and vertices of its polygons.
//!
//! The rule of what is hit stands at [`Picker`]. Faces that are seen are read from the ids of a
//! picture (`search`); all else is decided in f64: `screen` and `object` tell where points of
//! elements are, `nearby` (in small regions `few`, `beyond`) what may lie in a region (`region`, `lasso`), `kind` what does, `hiding` (with
//! `occluders`) which of that a face hides, and `covering` which pixels' centres a face covers.

mod beyond;
mod covering;
mod elements;
mod few;
mod hiding;
mod kind;
mod lasso;
mod nearby;
mod nearest;
mod object;
mod occluders;
mod outline;
mod picker;
mod region;
mod screen;
mod search;
mod snap;
#[cfg(test)]
mod tests;

pub use nearest::Nearest;
pub use picker::{Pick, Picker, Reach};
pub use region::Region;
pub use snap::{Snap, SnapElement};
