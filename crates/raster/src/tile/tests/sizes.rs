//! Triangles of all sizes: of a pixel or a few, eight side by side; much longer than wide, which the kernel `sliver` draws;
//! few and large, where a heap seldom has them. Also the quick ways through a tile: that they are taken, which no image
//! shows.

use super::{ALL, Flat, Heap, SIZE, check, draw, flats, heap, settings, timed};
use crate::{
    BlendMode, Culling, DepthTest, ExecuteSettings, Output, Pass, Points, Rasterizer, Stats, Target, TileSize,
};
use proptest::prelude::*;

/// Eight triangles of some size in 1/256 pixel, none on another.
fn eight(side: i32) -> [[[i32; 2]; 3]; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
        let [x, y] = [1000 + (side + 80) * i, 900 + 300 * i];
        [[x, y], [x + side, y], [x, y + side]]
    })
}

fn at_depths(mut heap: Heap, depths: [f32; 3]) -> Heap {
    for triangle in &mut heap.triangles {
        triangle.depths = depths;
    }
    heap
}

/// A block's nearest depth is that of the nearest corners, not of the farthest.
#[test]
fn small_triangles_are_seen_before_a_farther_one_that_covers_their_block() {
    for samples in [1, 4] {
        for side in [600, 1700] {
            let small = at_depths(heap(0, 1, &eight(side)), [0.125, 1.0, 1.0]);
            let all = at_depths(heap(1, 9, &[ALL]), [0.5; 3]);
            check(&[small, all], timed(), samples);
        }
    }
}

#[test]
fn keys_decide_between_equal_small_triangles() {
    for samples in [1, 4] {
        for side in [600, 1700] {
            for objects in [[0, 1], [1, 0]] {
                check(
                    &[heap(objects[0], 1, &eight(side)), heap(objects[1], 9, &eight(side))],
                    timed(),
                    samples,
                );
            }
        }
    }
}

/// A smaller key decides where depths are equal, and nowhere else.
#[test]
fn farther_small_triangles_take_nothing_by_their_keys() {
    for samples in [1, 4] {
        for side in [600, 900, 1700] {
            let at = |x: i32| [[x, 900], [x + side, 900], [x, 900 + side]];
            // Descending, so that the order of the triangles is not that of the keys.
            let mut there = Heap { faces: vec![2, 1], ..heap(0, 1, &[at(900), at(900 + side / 2)]) };
            there.triangles[0].depths = [0.5; 3];
            there.triangles[1].depths = [0.75; 3];
            let later = Heap { faces: vec![0], ..heap(0, 9, &[at(900 + side / 4)]) };
            check(&[there, at_depths(later, [0.5; 3])], timed(), samples);
        }
    }
}

/// As deep as what stands for nobody is not before it.
#[test]
fn what_is_as_deep_as_the_background_is_not_seen() {
    for samples in [1, 4] {
        for objects in [[0, 1], [1, 0]] {
            let sides = [600, 1700, 9000].into_iter().enumerate();
            let of_side = |(i, side): (usize, i32)| heap(objects[i % 2], 1 + 8 * i as u32, &eight(side));
            let heaps: Vec<_> =
                sides.map(of_side).map(|heap| at_depths(heap, [-f32::MIN_POSITIVE; 3])).collect();
            check(&heaps, timed(), samples);
        }
    }
}

/// Where the first sample of a pixel lies.
fn first_sample(samples: u32) -> [i32; 2] {
    if samples == 1 { [128, 128] } else { [96, 32] }
}

/// All edge functions are less than 256 there.
#[test]
fn triangles_of_a_speck_cover_the_sample_that_they_hold() {
    for samples in [1, 4] {
        let offset = first_sample(samples);
        let specks = [2, 3, 4, 5, 6, 7, 8].map(|i| {
            let [x, y] = offset.map(|v| v + 1024 * i);
            [[x - i, y - i], [x + 2 * i, y - i], [x - i, y + 2 * i]]
        });
        let larger = [[600, 600], [3000, 600], [600, 3000]];
        check(&[heap(0, 1, &specks)], timed(), samples);
        check(&[heap(0, 1, &specks), heap(1, 9, &[larger])], timed(), samples);
        check(&[heap(0, 1, &[&specks[..], &[larger]].concat())], timed(), samples);
    }
}

/// Planes of depth as steep as can be, where rounding leaves the range of the corners'
/// depths: samples on a side whose ends are equally deep, of triangles that are 1/256 pixel
/// wide.
#[test]
fn depths_of_slivers_keep_to_those_of_their_corners() {
    for samples in [1, 4] {
        let [x, y] = first_sample(samples).map(|v| v + 256 * 20);
        // In the far plane rounding would leave the image, too.
        let depths = [[0.7, 0.0], [0.7, 1.0], [0.0, 1.0]];
        for (reach, [ends_depth, third]) in [1, 3, 9].into_iter().flat_map(|reach| depths.map(|d| (reach, d)))
        {
            let slivers = (1..=40).flat_map(|i| {
                let [dx, dy] = [41 * reach + i, 7 * i * reach % 431 - 200];
                let ends = [[x - dx, y - dy], [x + dx, y + dy]];
                [-1, 1].map(|side| Flat {
                    points: [ends[0], ends[1], [x - dx, y - dy + side]],
                    depths: [ends_depth, ends_depth, third],
                })
            });
            for triangle in slivers {
                check(&[Heap { triangles: vec![triangle], ..heap(0, 1, &[]) }], timed(), samples);
            }
        }
    }
}

/// Twice the area in 1/256 pixel over the length: widths about which a column may hold one pixel more.
const WIDTHS: [i32; 9] = [1, 30, 128, 253, 254, 256, 509, 511, 520];

/// Up to 95 pixels long, along any direction, with a third corner anywhere along it.
fn sliver() -> impl Strategy<Value = Flat> {
    let middle = [-2000..21_200_i32, -2000..13_500];
    let reach = prop_oneof![700..6000_i32, 6000..12_000];
    let across = prop_oneof![Just(0), -700..700_i32, -12_000..12_000];
    let depth = || prop_oneof![(0..=4_u8).prop_map(|step| f32::from(step) / 4.0), 0.0_f32..=1.0];
    let depths = prop_oneof![depth().prop_map(|depth| [depth; 3]), [depth(), depth(), depth()]];
    let width = prop_oneof![prop::sample::select(WIDTHS.to_vec()), 1..600_i32];
    let kind = (0..=256_i32, any::<[bool; 4]>(), prop_oneof![Just(1), Just(128)]);
    (middle, (reach, across), width, kind, depths).prop_map(
        |(
            [x, y],
            (reach, across),
            width,
            (share, [is_steep, is_left, is_turned, is_rising], steps),
            depths,
        )| {
            let across = across.clamp(-reach, reach) * if is_rising { 1 } else { -1 };
            let [start, end] = [[x - reach, y - across], [x + reach, y + across]];
            let along = [0, 1].map(|axis| start[axis] + (end[axis] - start[axis]) * share / 256);
            let third = [along[0], along[1] + if is_left { width } else { -width }];
            let points = if is_turned { [end, third, start] } else { [start, end, third] };
            let on_steps = |v: i32| v / steps * steps;
            let points = points.map(|[x, y]| if is_steep { [y, x] } else { [x, y] }.map(on_steps));
            Flat { points, depths }
        },
    )
}

/// Slivers, with a few other triangles between them.
fn mixed() -> impl Strategy<Value = Vec<Flat>> {
    let slivers = |most: usize| prop::collection::vec(sliver(), 1..most);
    (slivers(40), flats(), slivers(20)).prop_map(|(first, mut others, last)| {
        others.truncate(6);
        [first, others, last].concat()
    })
}

/// Two draws of them, in the order of their keys or in none.
fn heaps() -> impl Strategy<Value = Vec<Heap>> {
    let faces = prop::option::of(prop::collection::vec(0..4_u32, 128));
    ([mixed(), mixed()], faces).prop_map(|(draws, faces)| {
        let heap = |(draw, triangles): (u32, Vec<Flat>)| {
            let faces = faces.as_ref().map_or_else(Vec::new, |faces| faces[..triangles.len()].to_vec());
            let object = if faces.is_empty() { draw } else { 1 };
            Heap { triangles, faces, culling: Culling::None, ..heap(object, 1 + 100 * draw, &[]) }
        };
        (0..).zip(draws).map(heap).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 8, ..ProptestConfig::default() })]

    #[test]
    fn every_sample_of_slivers_shows_what_a_search_finds(heaps in heaps(), settings in settings()) {
        check(&heaps, settings, 1);
    }
}

/// Long edges through samples, on either side, from end to end of several tiles.
#[test]
fn samples_on_the_longest_edge_of_a_sliver_follow_the_top_left_rule() {
    for (slope, width) in [0, 1, 2, 64].into_iter().flat_map(|slope| WIDTHS.map(|width| (slope, width))) {
        for (is_steep, side) in [(false, 1), (false, -1), (true, 1), (true, -1)] {
            let slivers = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
                let [x, y] = [128 + 256 * i, 128 + 256 * (3 + 4 * i)];
                let [start, end] = [[x, y], [x + 64 * 256, y + slope * 64]];
                let third = [x + 32 * 256, y + slope * 32 + side * width];
                [start, end, third].map(|[x, y]| if is_steep { [y, x] } else { [x, y] })
            });
            check(&[heap(0, 1, &slivers)], timed(), 1);
        }
    }
}

/// A sliver is drawn after others of the same eight, but its key comes first.
#[test]
fn keys_decide_between_slivers_and_what_is_as_deep() {
    let wide = |x: i32| [[x, 2000], [x + 9000, 2000], [x, 9000]];
    let sliver = |y: i32| [[100, y], [18_000, y + 100], [9000, y + 300]];
    for triangles in [[wide(300), sliver(3000), wide(900)], [sliver(3000), wide(300), sliver(3100)]] {
        check(&[heap(0, 1, &triangles)], timed(), 1);
        let faces = vec![2, 0, 1];
        check(&[Heap { faces, ..heap(0, 1, &triangles) }, heap(0, 9, &triangles)], timed(), 1);
    }
}

/// Walls of one draw.
fn walls(triangles: &[Flat]) -> Heap {
    Heap { triangles: triangles.to_vec(), ..heap(0, 1, &[]) }
}

#[test]
fn walls_that_cross_are_seen_at_each_sample_by_itself() {
    let all = [[-100_000, -100_000], [200_000, -100_000], [-100_000, 200_000]];
    let steep = [[-2000, -2000], [22_000, -2000], [-2000, 22_000]];
    let ways = [[1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, 0.0]];
    for first in ways {
        for second in ways {
            let [first, second] = [first, second].map(|depths| Flat { points: steep, depths });
            let flat = Flat { points: all, depths: [0.5; 3] };
            for samples in [1, 4] {
                check(&[walls(&[flat, first, second])], timed(), samples);
                check(&[walls(&[first, second])], timed(), samples);
            }
        }
    }
}

#[test]
fn edges_between_the_samples_of_a_tiles_first_pixels() {
    for points in
        [[[128, -100_000], [128, 100_000], [200_000, 0]], [[-100_000, 128], [100_000, 128], [0, 200_000]]]
    {
        check(&[walls(&[Flat { points, depths: [0.5; 3] }])], timed(), 4);
    }
}

#[test]
fn equally_deep_masked_walls_are_seen_by_their_keys() {
    let all = [[-100_000, -100_000], [200_000, -100_000], [-100_000, 200_000]];
    let wall = Flat { points: all, depths: [0.5; 3] };
    for blend_mode in [BlendMode::Masked, BlendMode::MaskedPerSample] {
        for faces in [vec![1, 0], vec![0, 1]] {
            check(&[Heap { blend_mode, faces, ..walls(&[wall; 2]) }], timed(), 4);
        }
    }
}

/// Tiles lie within half of the square around a disc and not within the disc.
#[test]
fn a_disc_larger_than_tiles_is_round() {
    let [centre, diameter] = [[-100, 190], [400; 2]];
    let point = walls(&[Flat { points: [centre.map(|pixels| pixels * 256); 3], depths: [0.5; 3] }]);
    let [width, height] = SIZE.map(|side| side as u32);
    let mut target = Target::new(width, height, &[Output::Linear]).unwrap();
    let mut pass = Pass::new();
    pass.points(Points::new(&point, &[0], diameter[0] as f32));
    Rasterizer::new(timed()).unwrap().draw(&pass, &mut target);
    for (index, shown) in target.linear().unwrap().iter().enumerate() {
        let pixel = [index as i32 % SIZE[0], index as i32 / SIZE[0]];
        let [x, y] = [0, 1].map(|axis| 2 * (pixel[axis] - centre[axis]) + 1);
        let within = x * x + y * y < diameter[0] * diameter[1];
        assert_eq!(shown.x != 0.0, within, "pixel {pixel:?}");
    }
}

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
