//! What the report claims of filling, and that each algorithm is what it says.

use super::*;
use trigon_classic::Field;
use trigon_math::{Vec2, elementary};

const SIDE: usize = 256;
const SIZE: [usize; 2] = [SIDE; 2];

fn painted(fill: Fill, triangles: &[Triangle]) -> FillCanvas {
    let mut canvas = FillCanvas::new(SIZE);
    fill.paint(triangles, &mut canvas);
    canvas
}

fn errors(fill: Fill, case: Tiling, seeds: u64) -> FillErrors {
    let mut sum = FillErrors::default();
    for seed in 0..seeds {
        let triangles = case.triangles(SIDE, seed);
        sum += FillErrors::of(&painted(fill, &triangles), &owners(&triangles, SIZE));
    }
    sum
}

/// The pixels of an 8 by 8 image as text.
fn text(fill: Fill, triangle: Triangle) -> String {
    let mut canvas = FillCanvas::new([8, 8]);
    fill.paint(&[triangle], &mut canvas);
    let row = |y| (0..8).map(|x| if canvas.pixels()[[x, y]].count > 0 { '#' } else { '.' }).collect();
    (0..8).map(row).collect::<Vec<String>>().join(" ")
}

#[test]
fn every_case_tiles_the_image() {
    for case in Tiling::ALL {
        let owners = owners(&case.triangles(SIDE, 3), SIZE);
        let orphans = owners.values().iter().filter(|&&owner| owner == u32::MAX).count();
        assert_eq!(orphans, 0, "{case:?}: pixels without an owner");
    }
}

#[test]
fn a_grid_leaves_no_gap_and_paints_nothing_twice() {
    for fill in [Fill::Fixed4, Fill::Fixed8, Fill::Fixed12, Fill::Engine] {
        for case in Tiling::ALL {
            let FillErrors { gaps, doubles, .. } = errors(fill, case, 2);
            assert_eq!((gaps, doubles), (0, 0), "{fill:?} on {case:?}");
        }
    }
}

#[test]
fn each_bit_of_a_grid_buys_accuracy() {
    let wrong = [Fill::Fixed4, Fill::Fixed8, Fill::Fixed12].map(|fill| errors(fill, Tiling::Tiles, 8).wrong);
    // A corner moves by 1/16 of what it did, and so does the area that changes owners;
    // half of that leaves room for the count of a few pixels.
    assert!(wrong[0] > 8 * wrong[1] && wrong[1] > 8 * wrong[2], "wrong pixels with 4, 8, 12 bits: {wrong:?}");
}

#[test]
fn what_lies_on_the_grid_is_exact() {
    let floats = [Fill::FloatFromCorners, Fill::FloatHoisted];
    for fill in [Fill::Fixed4, Fill::Fixed8, Fill::Fixed12, Fill::Engine].into_iter().chain(floats) {
        assert_eq!(errors(fill, Tiling::Lattice, 2).wrong, 0, "{fill:?}: corners on half pixels");
    }
}

#[test]
fn inclusive_edges_paint_shared_pixels_twice() {
    let FillErrors { gaps, doubles, wrong, .. } = errors(Fill::EdgesAtCenters, Tiling::Lattice, 1);
    assert!(doubles > 100 && gaps == 0 && wrong == doubles, "{doubles} doubles, {gaps} gaps, {wrong} wrong");
    let strips = errors(Fill::Strips, Tiling::Tiles, 1);
    assert!(strips.doubles > strips.edge_pixels / 2, "strips take in all pixels at their ends: {strips:?}");
}

#[test]
fn float_edges_break_where_values_are_large() {
    let far = errors(Fill::FloatFromCorners, Tiling::Fan, 4);
    assert!(far.gaps + far.doubles > 0, "needles of 12,000 pixels: {far:?}");
    assert!(
        far.wrong < errors(Fill::Fixed4, Tiling::Fan, 4).wrong,
        "but corners stay nearer to the input than on a coarse grid"
    );
}

#[test]
fn lanes_paint_the_pixels_of_one_at_a_time() {
    for case in Tiling::ALL {
        let triangles = case.triangles(SIDE, 6);
        for [lanes, single] in [[Fill::FloatLanes, Fill::FloatHoisted], [Fill::Fixed8Lanes, Fill::Fixed8]] {
            assert!(
                painted(lanes, &triangles).pixels() == painted(single, &triangles).pixels(),
                "{lanes:?}, {case:?}"
            );
        }
    }
}

/// Edges farther away than 32 bits reach are done one pixel at a time.
#[test]
fn lanes_do_not_overflow() {
    let far = [Vec2::new(-16_000.0, -16_000.0), Vec2::new(16_000.0, -15_000.0), Vec2::new(100.0, 16_000.0)];
    let edges = fixed::edges(&far, 8).unwrap();
    assert_eq!(edges.planes([0; 2], [255; 2]), None, "values of up to 2^36");
    let [lanes, single] = [Fill::Fixed8Lanes, Fill::Fixed8].map(|fill| painted(fill, &[far]));
    assert!(lanes.pixels() == single.pixels(), "every pixel");
}

/// Neighbours get the same value with opposite signs, unlike from corners.
#[test]
fn hoisted_float_edges_neither_leave_gaps_nor_paint_twice() {
    for case in Tiling::ALL {
        let FillErrors { gaps, doubles, .. } = errors(Fill::FloatHoisted, case, 4);
        assert_eq!((gaps, doubles), (0, 0), "{case:?}");
    }
}

#[test]
fn the_bounding_box_changes_no_pixel() {
    let triangles = Tiling::Tiles.triangles(SIDE, 1);
    let [screen, inbox] = [Fill::EdgesOnScreen, Fill::EdgesInBox].map(|fill| painted(fill, &triangles));
    assert!(screen.pixels() == inbox.pixels(), "source rows C1 and C3");
}

#[test]
fn the_engine_is_fixed_point_with_eight_bits() {
    // Corners on 1/256 pixel are exact in clip space, too: the side is a power of two.
    let triangles = tiles(SIDE, 9.0, 1.0 / 256.0, 5);
    let [engine, fixed] = [Fill::Engine, Fill::Fixed8].map(|fill| painted(fill, &triangles));
    assert!(engine.pixels() == fixed.pixels(), "every pixel");
}

#[test]
fn each_source_draws_the_triangle_its_own_way() {
    let triangle = [Vec2::new(0.75, 0.75), Vec2::new(6.25, 2.5), Vec2::new(2.5, 6.25)];
    let images =
        [Fill::Fixed8, Fill::Strips, Fill::Scanlines, Fill::EdgesInBox].map(|fill| text(fill, triangle));
    let expected = [
        "........ .##..... .#####.. ..###... ..##.... ..#..... ........ ........",
        ".#...... .####... .#####.. .#####.. ..###... ..##.... ..#..... ........",
        "#....... ###..... .######. .#####.. .###.... ..##.... ..#..... ........",
        "........ .#...... ..###... ..####.. ..###... ...#.... ........ ........",
    ];
    assert_eq!(images, expected, "exact, strips, scanlines, edges at the corners of pixels");
}

#[test]
fn tiles_are_moved_squares_on_a_grid() {
    for (square, unit) in [(16.0, 1.0 / 16384.0), (16.0, 0.5), (9.0, 1.0 / 256.0)] {
        let triangles = tiles(SIDE, square, unit, 3);
        let count = (SIDE as f64 / square).ceil() as usize + 2;
        assert_eq!(triangles.len(), 2 * count * count, "two to a square, one square more on every side");
        let mut moved = 0.0_f64;
        for (number, halves) in triangles.chunks(2).enumerate() {
            let [x, y] = [number % count, number / count].map(|position| position as f64 - 1.0);
            let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]| [x + u, y + v]);
            let [[a, b, c], [d, e, f]] = [halves[0], halves[1]];
            assert_eq!((a, c), (d, e), "both have the diagonal");
            for (corner, position) in [a, b, c, f].into_iter().zip(positions) {
                for (found, position) in corner.to_array().map(f64::from).into_iter().zip(position) {
                    assert_eq!((found / unit).fract(), 0.0, "{found} on a grid of {unit}");
                    moved = moved.max((found - position * square).abs());
                }
            }
        }
        assert!((0.2..0.27).contains(&(moved / square)), "up to a quarter: {moved} of {square}");
        assert_ne!(triangles, tiles(SIDE, square, unit, 4), "another seed");
    }
}

#[test]
fn needles_of_a_fan_go_round_once() {
    for seed in 0..3 {
        let needles = Tiling::Fan.triangles(SIDE, seed);
        assert_eq!(needles.len(), 200);
        let center = needles[0][0];
        let range = 0.3 * SIDE as f32..0.7 * SIDE as f32;
        assert!(range.contains(&center.x) && range.contains(&center.y), "{center}");
        for (number, &[middle, from, to]) in needles.iter().enumerate() {
            assert_eq!((middle, to), (center, needles[(number + 1) % 200][1]), "side by side");
            assert!((from.length() - 12_000.0).abs() < 0.01, "{from}");
            let angle =
                elementary::atan2(f64::from(from.y), f64::from(from.x)).rem_euclid(std::f64::consts::TAU);
            let steps = angle / std::f64::consts::TAU * 200.0;
            let off = (steps - number as f64 + 100.0).rem_euclid(200.0) - 100.0;
            assert!(off.abs() <= 0.401, "needle {number} at step {steps}");
        }
    }
}

/// Two halves, side by side, with a pixel that both paint and one that neither does.
#[test]
fn errors_are_counted_against_the_owners_and_told_for_a_thousand_edge_pixels() {
    let owners = Field::from_fn([4, 4], |[x, _]| u32::from(x >= 2));
    let [left, right] = [Vec2::ZERO, Vec2::X].map(|corner| [corner; 3]);
    let mut canvas = FillCanvas::new([4, 4]);
    canvas.each(&[left, right], |half, canvas| {
        let columns = if half == &left { 0..3 } else { 2..4 };
        let pixels = columns.flat_map(|x| (0..4).map(move |y| [x, y]));
        let is_painted = |[x, y]: &[i32; 2]| match x {
            2 => half == &right || *y == 0,
            _ => [*x, *y] != [3, 3],
        };
        pixels.filter(is_painted).for_each(|[x, y]| canvas.paint(x, y));
    });
    let errors = FillErrors::of(&canvas, &owners);
    assert_eq!(errors, FillErrors { edge_pixels: 4, wrong: 2, gaps: 1, doubles: 1 }, "four rows meet");
    assert_eq!(errors.wrong_per_mille(), 500.0, "two of four");
}
