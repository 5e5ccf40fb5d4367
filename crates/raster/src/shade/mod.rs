//! The shade stage: computes the colour of the visible triangles at each pixel.
//!
//! It finds out which pixels show which triangles. [`fragments`](crate::fragments) makes records of these
//! triangles and computes the weights of their corners at the pixels, and [`pipeline`](crate::pipeline)
//! runs the pipelines. In the order of the work on a tile:
//!
//! | file | what it does |
//! |---|---|
//! | `pixels_to_shade` | the pixels that are shaded, if not all are |
//! | `tile_bits` | a bit for each pixel of a tile |
//! | `visible` | lists the visible triangles of a tile, by draw |
//! | `edges` | with multisampling, pixels that show several triangles |
//! | `frame_context` | the context of a draw |
//! | `surface` | the tile's work: whole groups of pixels, and fragments of a list |
//! | `list` | fragments listed by triangle: masks, and layers to be blended |
//! | `shading` | memory kept from tile to tile |

mod edges;
mod frame_context;
mod list;
mod pixels_to_shade;
mod shading;
mod surface;
mod tile_bits;
mod visible;

#[cfg(test)]
mod tests;

pub(crate) use edges::{BEHIND, EdgeGroup};
pub(crate) use list::{JobList, mask_jobs, shade_jobs, shade_jobs_with};
pub(crate) use pixels_to_shade::{PartialTile, PixelsToShade};
pub(crate) use shading::{EmptyGroup, Shading};
pub(crate) use surface::{list_visible, note_faces, shade_tile};
pub(crate) use tile_bits::{GROUP_COUNT, TileLanes, TileRows, rows_of, rows_of_either};
