//! The quick ways through a tile: that they are taken, which no image tells.

use super::{ALL, Heap, SIZE, draw, heap, timed};
use crate::{BlendMode, DepthTest, ExecuteSettings, Stats, TileSize};

/// In the image: of 48 and of 12 blocks.
const TILES: u64 = 2;
const BLOCKS: u64 = 60;

fn wall(points: [[i32; 2]; 3], depths: [f32; 3]) -> Heap {
    let mut wall = heap(0, 1, &[points]);
    wall.triangles[0].depths = depths;
    wall
}

/// All points whose coordinates, in pixels, add up to less.
fn corner(sum: f64, depth: f32) -> Heap {
    let far = (sum * 256.0) as i32 + 100_000;
    wall([[far, -100_000], [-100_000, far], [-100_000, -100_000]], [depth; 3])
}

fn stats(heaps: &[Heap]) -> Stats {
    draw(heaps, timed(), 1).1
}

/// What fills tiles of less than 64 pixels was once shaded in the blocks, too, that they do
/// not have.
#[test]
fn what_fills_a_small_tile_is_shaded_once_a_pixel() {
    for tile_size in [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64] {
        for samples in [1, 4] {
            let settings = ExecuteSettings { tile_size, ..timed() };
            let (_, stats) = draw(&[wall(ALL, [0.5; 3])], settings, samples);
            assert_eq!(stats.pixels_shaded, (SIZE[0] * SIZE[1]) as u64, "{tile_size:?}, {samples} samples");
        }
    }
}

#[test]
fn walls_fill_tiles_and_hide_what_is_not_nearer() {
    let walls = [0.75, 0.75, 0.5].map(|depth| wall(ALL, [depth; 3]));
    let stats = stats(&walls);
    assert_eq!(stats.tiles_filled, TILES, "by the first");
    assert_eq!(stats.tiles_rejected, 2 * TILES, "of the others");
    assert_eq!((stats.blocks_accepted, stats.blocks_rejected), (0, 0), "no block is looked at");
}

#[test]
fn late_tests_ask_no_bounds() {
    let small = wall([[1000, 1000], [2700, 1000], [1000, 2700]], [0.25; 3]);
    let walls = [wall(ALL, [0.75; 3]), wall(ALL, [0.5; 3]), small];
    let settings = ExecuteSettings { depth_test: DepthTest::Late, ..timed() };
    let (_, stats) = draw(&walls, settings, 1);
    assert_eq!((stats.tiles_filled, stats.tiles_rejected), (0, 0), "no tile is hidden");
    assert_eq!((stats.blocks_accepted, stats.blocks_rejected), (2 * BLOCKS, 0), "all of both walls");
}

#[test]
fn whole_blocks_make_a_tile_hide() {
    // From 0.67 to 0.61 in the image.
    let slope = wall(ALL, [1.0, 0.5, 0.5]);
    let stats = stats(&[slope, wall(ALL, [0.6; 3])]);
    assert_eq!((stats.blocks_accepted, stats.tiles_rejected), (BLOCKS, TILES), "the slope, the wall");
}

#[test]
fn a_slope_is_hidden_block_by_block() {
    let stats = stats(&[wall(ALL, [0.75; 3]), wall(ALL, [1.0, 0.5, 0.5])]);
    assert_eq!((stats.blocks_rejected, stats.blocks_accepted), (BLOCKS, 0), "behind the wall in the image");
}

#[test]
fn blocks_that_two_triangles_share_hide_in_the_end() {
    let [p, q] = [[-100_000, -60_000], [200_000, 120_000]];
    let halves = [[p, q, [-100_000, 300_000]], [q, p, [200_000, -200_000]]];
    let [a, b] = halves.map(|half| wall(half, [0.75; 3]));
    let all = || wall(ALL, [0.75; 3]);
    let before = stats(&[a.clone(), b.clone()]);
    let after = stats(&[a, b, all(), all()]);
    assert_eq!(after.blocks_rejected - before.blocks_rejected, BLOCKS, "of the third");
    assert_eq!(after.groups_tested, before.groups_tested, "no sample of the third is looked at");
    assert_eq!(after.tiles_rejected, TILES, "of the fourth");
}

#[test]
fn blocks_beside_an_edge_are_told_from_those_within() {
    // With s the sum of a block's column and row, the pixels' centres add up to from 8 s + 1
    // to 8 s + 15.
    let stats = stats(&[corner(40.0, 0.75)]);
    assert_eq!(stats.blocks_accepted, 1 + 2 + 3 + 4, "s up to 3");
    // Their groups, 2 by 4, add up to from 8 s + 4 column + 2 row + 1.
    assert_eq!(
        stats.groups_tested,
        5 * 6,
        "s of 4, less than 40 in four groups on the left and two on the right"
    );
    assert_eq!(stats.blocks_rejected, 48 - 15, "the others of the first tile");
}

#[test]
fn blocks_beside_a_needle_are_left_out() {
    // To the right of 8 pixels it is from row 24 on.
    let needle = [[5, 0], [11, 48], [5, 48]].map(|point| point.map(|pixels| pixels * 256));
    assert_eq!(stats(&[wall(needle, [0.5; 3])]).blocks_rejected, 3, "the upper three on the right");
}

#[test]
fn masks_are_asked_once_a_pixel_and_not_beside_the_image() {
    let masked = |heap: Heap| Heap { blend_mode: BlendMode::Masked, ..heap };
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| f64::from(x + y + 1)));
    for sum in [40.5, 60.5, 100.5, 200.0] {
        let (_, stats) = draw(&[masked(corner(sum, 0.5))], timed(), 1);
        let count = pixels.clone().filter(|&index| index < sum).count();
        assert_eq!(stats.samples_masked, count as u64, "pixels within {sum}");
    }
    let (_, stats) = draw(&[masked(wall(ALL, [0.5; 3]))], timed(), 4);
    assert_eq!(stats.samples_masked, (SIZE[0] * SIZE[1]) as u64, "one answer for four samples");
}
