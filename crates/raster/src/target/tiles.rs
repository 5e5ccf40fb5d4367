//! Cuts a target into tiles: disjoint mutable rows, so that tiles can be drawn
//! in any order on any thread without `unsafe`.

use super::Target;
use trigon_math::Vec4;

/// A tile's place in the target, in pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileRect {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// The part of each output that belongs to one tile, row by row. An output
/// that was not asked for has no rows.
pub(crate) struct TileRows<'a> {
    pub(crate) rect: TileRect,
    pub(crate) srgb8: Vec<&'a mut [[u8; 4]]>,
    pub(crate) linear: Vec<&'a mut [Vec4]>,
    pub(crate) depth: Vec<&'a mut [f32]>,
    pub(crate) objects: Vec<&'a mut [u32]>,
    pub(crate) faces: Vec<&'a mut [u32]>,
    pub(crate) triangles: Vec<&'a mut [u32]>,
}

/// The tiles of a target, row by row, each of at most `size` by `size` pixels.
pub(crate) fn split_into_tiles(target: &mut Target, size: u32) -> Vec<TileRows<'_>> {
    let (width, height) = (target.width, target.height);
    let mut tiles = Vec::new();
    for y in (0..height).step_by(size as usize) {
        for x in (0..width).step_by(size as usize) {
            let rect = TileRect { x, y, width: size.min(width - x), height: size.min(height - y) };
            tiles.push(TileRows {
                rect,
                srgb8: Vec::new(),
                linear: Vec::new(),
                depth: Vec::new(),
                objects: Vec::new(),
                faces: Vec::new(),
                triangles: Vec::new(),
            });
        }
    }
    let cut = Cut { width, size };
    cut.deal(target.srgb8.as_deref_mut(), &mut tiles, |tile| &mut tile.srgb8);
    cut.deal(target.linear.as_deref_mut(), &mut tiles, |tile| &mut tile.linear);
    cut.deal(target.depth.as_deref_mut(), &mut tiles, |tile| &mut tile.depth);
    cut.deal(target.objects.as_deref_mut(), &mut tiles, |tile| &mut tile.objects);
    cut.deal(target.faces.as_deref_mut(), &mut tiles, |tile| &mut tile.faces);
    cut.deal(target.triangles.as_deref_mut(), &mut tiles, |tile| &mut tile.triangles);
    tiles
}

struct Cut {
    width: u32,
    size: u32,
}

impl Cut {
    /// Deals the rows of one output out to the tiles that they cross.
    fn deal<'a, T>(
        &self,
        picture: Option<&'a mut [T]>,
        tiles: &mut [TileRows<'a>],
        rows: impl for<'t> Fn(&'t mut TileRows<'a>) -> &'t mut Vec<&'a mut [T]>,
    ) {
        let Some(picture) = picture else { return };
        let columns = self.width.div_ceil(self.size) as usize;
        for (y, row) in picture.chunks_mut(self.width as usize).enumerate() {
            let first = y / self.size as usize * columns;
            for (x, part) in row.chunks_mut(self.size as usize).enumerate() {
                rows(&mut tiles[first + x]).push(part);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Output;

    #[test]
    fn tiles_cover_the_target_once() {
        let mut target = Target::new(70, 33, &[Output::Object]).unwrap();
        for (index, tile) in split_into_tiles(&mut target, 32).into_iter().enumerate() {
            assert_eq!(tile.objects.len(), tile.rect.height as usize, "one slice for each row");
            for row in tile.objects {
                assert_eq!(row.len(), tile.rect.width as usize, "as wide as the tile");
                row.fill(index as u32);
            }
        }
        let ids = target.objects().unwrap();
        assert!(!ids.contains(&u32::MAX), "every pixel belongs to a tile");
        assert_eq!(ids[0], 0, "the first tile is at the top left");
        assert_eq!(ids[70 * 33 - 1], 5, "the last at the bottom right");
    }
}
