//! What set-up makes of triangles, as frames and their counts tell.

use crate::bin::Grid;
use crate::primitive::{Edge, SMALL, SetupTriangle};
use crate::viewport::{SamplePattern, Viewport};
use crate::{
    Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, Rasterizer, Stats, Target, TileSize,
    VertexOutput,
};
use proptest::prelude::*;
use trigon_math::Vec4;

/// Of the image, in pixels.
const SIDE: u32 = 64;

/// Corners in clip space; in the image, (-1, 1) to (1, -1) over w.
struct Corners(Vec<[f32; 4]>);

impl Pipeline for Corners {
    /// The place in clip space, in columns of pixels from the left.
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        self.0.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        let [x, y, z, w] = self.0[index];
        VertexOutput { position: Vec4::new(x, y, z, w), varyings: (x + 1.0) * (SIDE / 2) as f32 }
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        Vec4::new(if fragment.front_facing { 1.0 } else { 2.0 }, fragment.varyings, 0.0, 1.0)
    }
}

fn frame(
    corners: Vec<[f32; 4]>,
    triangles: &[[u32; 3]],
    (culling, samples, tile_size): (Culling, u32, TileSize),
) -> (Vec<Vec4>, Stats) {
    let pipeline = Corners(corners);
    let mut pass = Pass::new();
    pass.triangles(Draw { culling, ..Draw::new(&pipeline, triangles) });
    let mut target = Target::new(SIDE, SIDE, &[Output::Linear]).unwrap().with_samples(samples).unwrap();
    let settings = ExecuteSettings { tile_size, ..ExecuteSettings::default() };
    let stats = Rasterizer::new(settings).unwrap().draw(&pass, &mut target);
    (target.linear().unwrap().to_vec(), stats)
}

/// A frame of one triangle.
fn alone(corners: [[f32; 4]; 3], culling: Culling) -> (Vec<Vec4>, Stats) {
    frame(corners.to_vec(), &[[0, 1, 2]], (culling, 1, TileSize::default()))
}

const ALL_CULLING: [Culling; 3] = [Culling::None, Culling::Back, Culling::Front];

fn orders(corners: [[f32; 4]; 3]) -> [[[f32; 4]; 3]; 6] {
    let [a, b, c] = corners;
    [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]]
}

/// A corner in full view but for z and w.
fn corner(x: f32, y: f32, [z, w]: [f32; 2]) -> [f32; 4] {
    [x, y, z, w]
}

const SEEN: [f32; 2] = [0.5, 1.0];
const TOO_NEAR: [f32; 2] = [2.0, 1.0];
const BEHIND_THE_EYE: [f32; 2] = [0.5, -1.0];

/// By the sign of the volume between the corners and the eye, which no cutting changes.
#[test]
fn triangles_face_as_their_corners_say_however_they_are_cut() {
    let triangle = |a, b, c| [corner(-0.5, -0.5, a), corner(0.5, -0.5, b), corner(0.0, 0.75, c)];
    let scaled = |by: f32| triangle(SEEN, SEEN, SEEN).map(|[x, y, z, w]| [x * by, y * by, z, w]);
    let cases = [
        (scaled(0.5), false),
        (scaled(50.0), false),
        (scaled(1e6), true),
        (triangle(SEEN, SEEN, TOO_NEAR), true),
        (triangle(TOO_NEAR, TOO_NEAR, SEEN), true),
        (triangle(SEEN, SEEN, BEHIND_THE_EYE), true),
        (triangle(BEHIND_THE_EYE, BEHIND_THE_EYE, SEEN), true),
    ];
    for (corners, is_cut) in cases {
        for corners in orders(corners) {
            let [a, b, c] = corners.map(|[x, y, _, w]| [x, y, w]);
            let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            let is_front = a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1) > 0.0;
            for (culling, is_drawn) in ALL_CULLING.into_iter().zip([true, is_front, !is_front]) {
                let (image, stats) = alone(corners, culling);
                let faces: Vec<_> = image.iter().map(|pixel| pixel.x).filter(|&face| face != 0.0).collect();
                assert_eq!(!faces.is_empty(), is_drawn, "{corners:?} {culling:?}");
                let expected = if is_front { 1.0 } else { 2.0 };
                assert!(faces.iter().all(|&face| face == expected), "{corners:?} faces {expected}");
                assert_eq!(stats.clipped, u64::from(is_cut), "{corners:?}");
                assert_eq!((stats.culled, stats.set_up > 0), (u64::from(!is_drawn), is_drawn), "{corners:?}");
            }
        }
    }
}

/// Corners move by at most 1/512 pixel when they are snapped; the corners that cutting
/// makes are found in f32, with an error far below that: values of a plane that rises by 1
/// from pixel to pixel are off by less than twice as much.
#[test]
fn values_run_on_where_a_triangle_is_cut() {
    let (near, seen) = (TOO_NEAR, SEEN);
    for corners in [
        [corner(-0.75, -0.5, near), corner(0.5, -0.75, seen), corner(0.25, 0.75, seen)],
        [corner(-0.75, -0.5, seen), corner(0.5, -0.75, near), corner(0.25, 0.75, near)],
    ] {
        for corners in orders(corners) {
            let (image, _) = alone(corners, Culling::None);
            let shown = image.iter().enumerate().filter(|(_, pixel)| pixel.x != 0.0);
            let mut count = 0;
            for (index, pixel) in shown {
                let column = (index as u32 % SIDE) as f32 + 0.5;
                assert!((pixel.y - column).abs() < 1.0 / 256.0, "{} in column {column}", pixel.y);
                count += 1;
            }
            assert!(count > 50, "{count} pixels of {corners:?}");
        }
    }
}

#[test]
fn cut_triangles_are_seen_among_whole_ones() {
    let whole = [corner(-0.9, -0.9, SEEN), corner(-0.7, -0.9, SEEN), corner(-0.9, -0.7, SEEN)];
    let cut = [corner(-0.5, -0.5, SEEN), corner(0.5, -0.5, SEEN), corner(0.0, 0.75, TOO_NEAR)];
    let shown = |image: &[Vec4]| image.iter().filter(|pixel| pixel.x != 0.0).count();
    let [of_whole, of_cut] = [whole, cut].map(|corners| shown(&alone(corners, Culling::None).0));
    let settings = (Culling::None, 1, TileSize::default());
    let (image, _) = frame([whole, cut].concat(), &[[0, 1, 2], [3, 4, 5], [0, 1, 2]], settings);
    assert_eq!(shown(&image), of_whole + of_cut, "{of_whole} and {of_cut} pixels");
}

#[test]
fn what_is_not_drawn_is_counted_where_it_was_dropped() {
    let (seen, near) = (SEEN, TOO_NEAR);
    let counts = |stats: Stats| [stats.invalid, stats.outside, stats.clipped, stats.culled, stats.set_up];
    let side = |x: f32, z: [f32; 2]| [corner(x, -0.5, seen), corner(x + 9.0, 0.0, seen), corner(x, 0.5, z)];
    let line = |z: [f32; 2]| [corner(0.0, -20.0, seen), corner(0.0, 20.0, seen), corner(0.0, 0.5, z)];
    let cases = [
        ([corner(0.0, 0.0, seen), corner(1.0, 0.0, near), [f32::NAN, 0.0, 0.5, 1.0]], [1, 0, 0, 0, 0]),
        ([corner(0.0, 0.0, near), corner(1.0, 0.0, near), corner(0.0, 1.0, near)], [0, 1, 0, 0, 0]),
        (side(-40.0, seen), [0, 0, 0, 1, 0]),
        (side(-40.0, near), [0, 0, 1, 2, 0]),
        (line(seen), [0, 0, 0, 1, 0]),
        (line(near), [0, 0, 1, 1, 0]),
    ];
    for (corners, expected) in cases {
        for corners in orders(corners) {
            let (_, stats) = alone(corners, Culling::None);
            assert_eq!(counts(stats), expected, "{corners:?}");
        }
    }
    for culling in ALL_CULLING {
        let (_, stats) = alone(line(near), culling);
        assert_eq!(counts(stats), [0, 0, 1, 1, 0], "without area, {culling:?}");
    }
}

/// Triangles of all sizes and shapes or small ones only, with corners on whole multiples of
/// some steps.
fn triangles() -> impl Strategy<Value = Vec<[[i32; 2]; 3]>> {
    let triangle = |reaches: &[i32]| {
        let reach = || prop::sample::select(reaches.to_vec());
        let steps = prop::sample::select(vec![1, 64, 128]);
        (steps, [reach(), reach()]).prop_flat_map(|(steps, reach)| {
            let corner = || reach.map(|reach| -reach..=reach);
            let middle = [-2000..SIDE as i32 * 256 + 2000, -2000..SIDE as i32 * 256 + 2000];
            (middle, [corner(), corner(), corner()]).prop_map(move |([x, y], corners)| {
                corners.map(|[right, down]| [(x + right) / steps * steps, (y + down) / steps * steps])
            })
        })
    };
    let [small, all] = [&[100, 200, 600, 3000][..], &[100, 3000, 9000, 40_000, 1 << 20]].map(triangle);
    prop_oneof![prop::collection::vec(small, 1..20), prop::collection::vec(all, 1..20)]
}

fn is_small(triangle: &SetupTriangle) -> bool {
    let extents = [0, 1].map(|axis| triangle.extent(axis));
    extents.iter().all(|[low, high]| high - low < SMALL)
}

/// How many tiles a triangle is listed in, if it is small; `None` if it is culled.
fn tiles_of(points: [[i32; 2]; 3], culling: Culling, grid: &Grid) -> Option<u64> {
    let triangle = SetupTriangle::on_grid(points);
    let [a, b, c] = points.map(|point| point.map(i64::from));
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let is_culled = match culling {
        Culling::None => area == 0,
        Culling::Back => area >= 0,
        Culling::Front => area <= 0,
    };
    let [columns, rows] = grid.pixels_of(&triangle).filter(|_| !is_culled)?;
    // Those of a pixel or two are asked whether they cover a centre.
    let edges = Edge::of(&triangle);
    let covers = |[x, y]: [i32; 2]| {
        let center = [x * 256 + 128, y * 256 + 128];
        edges.iter().all(|edge| edge.at(center) + edge.bias() >= 0)
    };
    let is_tiny = columns[1] - columns[0] <= 1 && rows[1] - rows[0] <= 1;
    let mut pixels = (columns[0]..=columns[1]).flat_map(|x| (rows[0]..=rows[1]).map(move |y| [x, y]));
    let is_missed = grid.pattern.count() == 1 && is_tiny && !pixels.any(covers);
    (!is_missed).then(|| grid.tiles_of(columns, rows).len() as u64)
}

proptest! {
    #[test]
    fn eight_at_once_are_culled_and_listed_as_one_by_one(
        triangles in triangles(),
        culling in prop::sample::select(ALL_CULLING.to_vec()),
        samples in prop::sample::select(vec![1, 1, 4]),
        (tile_size, side) in prop::sample::select(vec![(TileSize::Pixels8, 8), (TileSize::Pixels64, 64)]),
    ) {
        let coordinate = |raw: i32| raw as f32 / (SIDE * 128) as f32 - 1.0;
        let corners = triangles.iter().flatten().map(|&[x, y]| [coordinate(x), -coordinate(y), 0.5, 1.0]).collect();
        let indices: Vec<_> = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let (_, stats) = frame(corners, &indices, (culling, samples, tile_size));

        let viewport = Viewport { width: SIDE, height: SIDE };
        let pattern = SamplePattern::of(samples).unwrap();
        let grid = Grid::new(viewport, pattern, side);
        let tiles: Vec<_> = triangles.iter().filter_map(|&points| tiles_of(points, culling, &grid)).collect();
        let (set_up, binned) = (tiles.len() as u64, tiles.iter().sum::<u64>());
        let culled = triangles.len() as u64 - set_up;
        prop_assert_eq!([stats.culled, stats.set_up], [culled, set_up]);
        // Large ones are not listed one by one in tiles that they fill.
        if triangles.iter().all(|&points| is_small(&SetupTriangle::on_grid(points))) {
            prop_assert_eq!(stats.binned, binned);
        }
    }
}
