//! Picking: what of a scene is under a pixel or in a region of a picture, down to the
//! faces, edges and vertices of its polygons.
//!
//! # What counts as hit
//! A [`Region`] is a part of the picture, and [`Reach`] says whether what is hidden counts.
//!
//! | | [`Reach::Visible`] | [`Reach::Through`] |
//! |---|---|---|
//! | a face | wins a pixel whose centre lies in the region | covers a pixel's centre in the region |
//! | a vertex | its point lies in the region, and no face but its own hides it there | its point lies in the region |
//! | an edge | likewise, for one of its own points | one of its own points lies in the region |
//!
//! - *Own* faces of a vertex or an edge are those that contain it.
//! - An edge's *own points* are where its line on the screen crosses the middles of columns of
//!   pixels, or of rows where it is steeper than 45°: one in each pixel that a thin line would
//!   paint. An edge too short to cross any has its middle.
//! - A face *hides* a point that it covers on the screen and that lies behind it by more than a
//!   thousandth of a pixel's width at its distance: what is nearer than that touches. Only
//!   faces that are drawn hide: not the backs of single-sided ones. Of a face whose material
//!   is masked or blended only the pixels hide that it wins.
//! - What lies before the near plane is cut, and what lies beyond the far plane is left out.
//! - Faces that are drawn from behind only are no less covered: `Through` finds them, too.
//!
//! Visible faces are those that the picture's ids tell, so that the picture should have one
//! sample for each pixel, and the style [`Surface`](crate::Style::Surface). All else is decided
//! in f64 at the points themselves, and does not depend on the size of the pixels.

mod covering;
mod elements;
mod hiding;
mod kind;
mod lasso;
mod nearest;
mod object;
mod outline;
mod picker;
mod region;
mod screen;
mod search;
#[cfg(test)]
mod tests;

pub use elements::ElementSet;
pub use nearest::Nearest;
pub use picker::{Pick, Picker, Reach};
pub use region::Region;
