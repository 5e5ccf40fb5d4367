//! The quick ways through a tile: that they are taken, which no picture tells.

use super::{Heap, SIZE, draw, heap, timed};
use crate::{ExecuteSettings, TileSize};

fn at_depths<const N: usize>(points: [[i32; 2]; 3], depths: [f32; N]) -> Heap {
    let mut heap = heap(0, 1, &[points; N]);
    for (triangle, depth) in heap.triangles.iter_mut().zip(depths) {
        triangle.depths = [depth; 3];
    }
    heap
}

const ALL: [[i32; 2]; 3] = [[-100_000, -100_000], [200_000, -100_000], [-100_000, 200_000]];

/// What fills tiles of less than 64 pixels was once shaded in the blocks, too, that they do
/// not have.
#[test]
fn what_fills_a_small_tile_is_shaded_once_a_pixel() {
    for tile_size in [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64] {
        for samples in [1, 4] {
            let settings = ExecuteSettings { tile_size, ..timed() };
            let (_, stats) = draw(&[at_depths(ALL, [0.5])], settings, samples);
            assert_eq!(stats.pixels_shaded, (SIZE[0] * SIZE[1]) as u64, "{tile_size:?}, {samples} samples");
        }
    }
}
