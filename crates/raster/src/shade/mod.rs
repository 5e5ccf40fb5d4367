//! The shade stage: computes the colour of the visible triangles at each pixel.
//!
//! It finds out which pixels show which triangles. [`fragments`](crate::fragments) makes records of these
//! triangles and computes the weights of their corners at the pixels, and [`pipeline`](crate::pipeline)
//! runs the pipelines. In the order of the work on a tile:
//!
//! | file | what it does |
//! |---|---|
//! | `visible` | lists the visible triangles of a tile, by draw, and with multisampling the pixels that show several |
//! | `surface` | the tile's work: whole groups of pixels, and fragments listed by triangle: masks, and layers to be blended |
//! | `shading` | memory held from tile to tile; which pixels are shaded, if not all are; the context of a draw |

mod shading;
mod surface;
#[cfg(test)]
mod tests;
mod visible;

pub(crate) use shading::{EmptyGroup, PartialTile, PixelsToShade, Shading};
pub(crate) use surface::{
    JobList, list_visible, mask_jobs, note_faces, shade_jobs, shade_jobs_with, shade_tile,
};
pub(crate) use visible::{BEHIND, EdgeGroup};
