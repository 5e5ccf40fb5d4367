//! Who is in front: exact ties, surfaces that cross, and how near depth comes to
//! exact arithmetic. Hard cases 24 to 26.

use crate::coverage_support::{SIDE, Samples, Values, clip_position, draw, pixel, rasterizer};
use crate::depth_plane;
use crate::effort::cases;
use crate::random::Random;
use proptest::prelude::*;
use trigon_raster::{
    BlendMode, Culling, DepthTest, Draw, ExecuteSettings, Output, Pass, Stats, TargetImages,
};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, pixel_center};
use trigon_study::oracle::depth::Plane;

const QUAD: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

fn quad(depth: f32) -> Values {
    let corners = [[1000, 1000], [1000, 9000], [9000, 9000], [9000, 1000]];
    Values { vertices: corners.map(|corner| (clip_position(corner, depth), 1.0)).to_vec() }
}

/// Draws the same quad once for each (object, face), in the order given.
fn coincident(keys: &[(u32, u32)], surface: BlendMode) -> TargetImages {
    let pipelines: Vec<_> = keys.iter().map(|_| quad(0.25)).collect();
    let faces: Vec<_> = keys.iter().map(|&(_, face)| [face; 2]).collect();
    let mut pass = Pass::new();
    for ((pipeline, faces), &(object, _)) in pipelines.iter().zip(&faces).zip(keys) {
        let draw = Draw {
            object,
            faces: Some(faces),
            blend_mode: surface,
            culling: Culling::None,
            ..Draw::new(pipeline, &QUAD)
        };
        pass.triangles(draw);
    }
    draw(&pass)
}

/// What the depth of a triangle is off by at most: half a unit of f32 of a depth below 1,
/// what `primitive/depth.rs` states for the plane in f64, and ten roundings of [`exact_depth`].
fn off(corners: [GridPoint; 3]) -> f64 {
    let plane = Plane { corners, depths: [0.0, 1.0, 1.0] };
    depth_plane::bound(&plane) + f64::from(f32::EPSILON) / 4.0 + 5.0 * f64::EPSILON
}

proptest! {
    #![proptest_config(cases(100))]

    /// Hard case 25.
    #[test]
    fn equal_depths_go_to_the_smaller_object_and_face(
        keys in proptest::collection::hash_set((0..5_u32, 0..5_u32), 1..8),
        masked in any::<bool>(),
    ) {
        let keys: Vec<_> = keys.into_iter().collect();
        let surface = if masked { BlendMode::Masked } else { BlendMode::Opaque };
        let images = coincident(&keys, surface);
        let least = keys.iter().min().expect("at least one");
        let inside = (20 * SIDE + 20) as usize;
        let objects = images.objects.expect("asked for");
        let faces = images.faces.expect("asked for");
        prop_assert_eq!((objects[inside], faces[inside]), *least);
        let seen = objects.iter().zip(&faces).filter(|(object, _)| **object != u32::MAX);
        prop_assert!(seen.clone().all(|(&object, &face)| (object, face) == *least), "one visible triangle all over");
    }

    /// Two triangles in random planes against exact depths in f64.
    #[test]
    fn crossing_triangles_show_the_nearer(
        points in [any_point(), any_point(), any_point(), any_point(), any_point(), any_point()],
        depths in [0.01_f32..1.0, 0.01..1.0, 0.01..1.0, 0.01..1.0, 0.01..1.0, 0.01..1.0],
    ) {
        let vertices = (0..6).map(|i| (clip_position(points[i], depths[i]), 1.0)).collect();
        let pipeline = Values { vertices };
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2], [3, 4, 5]]) });
        let images = draw(&pass);
        let (depth, ids) = (images.depth.expect("asked for"), images.triangles.expect("asked for"));
        for index in 0..depth.len() {
            let planes = [0, 3].map(|first| {
                let corner = |i: usize| (points[first + i], f64::from(depths[first + i]));
                exact_depth([corner(0), corner(1), corner(2)], pixel(index))
            });
            let [one, other] = [0, 3].map(|first| off([0, 1, 2].map(|i| points[first + i])));
            match planes {
                [Some(a), Some(b)] if (a - b).abs() > one + other => {
                    prop_assert_eq!(ids[index], u32::from(b > a), "{} and {} at {:?}", a, b, pixel(index));
                }
                [Some(only), None] | [None, Some(only)] => {
                    prop_assert_eq!(ids[index], u32::from(planes[1].is_some()));
                    let error = (f64::from(depth[index]) - only).abs();
                    let bound = if planes[0].is_some() { one } else { other };
                    prop_assert!(error <= bound, "depth is off by {error}");
                }
                [None, None] => prop_assert_eq!((ids[index], depth[index]), (u32::MAX, 0.0)),
                [Some(_), Some(_)] => {}
            }
        }
    }

    /// Equal depths at the corners are that depth everywhere; and no depth
    /// leaves the range of the corners'.
    #[test]
    fn depth_stays_within_the_corners(
        points in [any_point(), any_point(), any_point()],
        depths in [0.0_f32..1.0, 0.0..1.0, 0.0..1.0],
        alike in 0..4_usize,
    ) {
        // All corners alike, or all but one, so that most depths are at an end of the range.
        let depths = [0, 1, 2].map(|i| if alike == 3 || i == alike { depths[0] } else { depths[1] });
        let pipeline = Values { vertices: (0..3).map(|i| (clip_position(points[i], depths[i]), 1.0)).collect() };
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
        let images = draw(&pass);
        let low = depths.iter().copied().fold(1.0, f32::min);
        let high = depths.iter().copied().fold(0.0, f32::max);
        for (depth, id) in images.depth.iter().flatten().zip(images.triangles.iter().flatten()) {
            prop_assert!(*id == u32::MAX || (low <= *depth && *depth <= high), "{depth} of {depths:?}");
        }
    }
}

/// Hundreds of triangles over each other, from small to much larger than the
/// image; every third depth is one of eight, so that many are equal.
fn heap(seed: u64) -> Values {
    let mut random = Random(seed);
    let vertices = (0..600).flat_map(|i| {
        let reach = [600, 3000, 12_000, 100_000][i % 4];
        let middle = [random.within(10_000) + 8192, random.within(10_000) + 8192];
        let depth = (random.within(500) + 500) as f32 / 1000.0;
        let depth = if i % 3 == 0 { (depth * 8.0).floor() / 8.0 } else { depth };
        let steep = if i % 2 == 0 { 0.0 } else { 0.3 };
        [0, 1, 2].map(|corner| {
            let point = middle.map(|v| v + random.within(reach));
            let depth = depth + (1.0 - depth) * steep * corner as f32;
            (clip_position(point, depth), depth)
        })
    });
    Values { vertices: vertices.collect() }
}

/// The heap, its last third with a mask, and what it took.
fn draw_heap(heap: &Values, samples: Samples, depth_test: DepthTest) -> (TargetImages, Stats) {
    let triangles: Vec<_> = (0..600).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let (opaque, masked) = triangles.split_at(400);
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, object: 1, ..Draw::new(heap, opaque) });
    let (culling, surface) = (Culling::None, BlendMode::Masked);
    pass.triangles(Draw { culling, blend_mode: surface, object: 0, ..Draw::new(heap, masked) });
    let mut target = samples.target([SIDE as u32; 2], &[Output::Linear, Output::Depth, Output::Triangle]);
    let settings = ExecuteSettings { depth_test, ..Default::default() };
    let stats = rasterizer(&settings).draw(&pass, &mut target);
    (target.into_images(), stats)
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn bounds_of_depths_leave_out_only_what_is_hidden(seed in any::<u64>(), samples in Samples::any()) {
        let heap = heap(seed);
        let (quick, stats) = draw_heap(&heap, samples, DepthTest::Hierarchical);
        let (late, late_stats) = draw_heap(&heap, samples, DepthTest::Late);
        prop_assert!(quick == late, "the same image");
        prop_assert!(stats.tiles_rejected > 0, "and something was left out");
        prop_assert_eq!(late_stats.tiles_rejected, 0, "which late tests do not");
    }
}

#[test]
fn stages_are_timed_only_on_request() {
    let heap = heap(1);
    let triangles: Vec<_> = (0..600).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mut pass = Pass::new();
    pass.triangles(Draw::new(&heap, &triangles));
    for timed in [false, true] {
        let mut target = Samples::ONE.target([SIDE as u32; 2], &[Output::Linear, Output::Object]);
        let settings = ExecuteSettings { timed, ..Default::default() };
        let Stats { times, samples_visible, .. } = rasterizer(&settings).draw(&pass, &mut target);
        let objects = target.into_images().objects.expect("asked for");
        let seen = objects.iter().filter(|&&object| object != u32::MAX).count() as u64;
        assert!(seen > 0, "the triangles cover something");
        assert_eq!(samples_visible, if timed { seen } else { 0 }, "{timed}");
        let stages = [times.vertices, times.set_up, times.visibility, times.shading, times.resolve];
        assert!(stages.iter().all(|time| time.is_zero() != timed), "{timed}: {times:?}");
        assert!(times.blending.is_zero(), "nothing is translucent");
    }
}

/// The depth that stands for the background was once seen before it where faces are
/// not listed in their order, and not elsewhere.
#[test]
fn the_backgrounds_own_depth_is_not_seen_in_any_order_of_faces() {
    let corners = [[0, 0], [SIDE * 512, 0], [0, SIDE * 512]];
    let values = Values::ones(corners.map(|point| clip_position(point, -f32::MIN_POSITIVE)));
    for faces in [[0, 1], [1, 0]] {
        for surface in [BlendMode::Opaque, BlendMode::Masked, BlendMode::Translucent] {
            let mut pass = Pass::new();
            let draw = Draw::new(&values, &[[0, 1, 2], [0, 1, 2]]);
            pass.triangles(Draw { culling: Culling::None, blend_mode: surface, faces: Some(&faces), ..draw });
            let mut target = Samples::ONE.target([SIDE as u32; 2], &[Output::Linear]);
            let stats = rasterizer(&ExecuteSettings::default()).draw(&pass, &mut target);
            assert_eq!(stats.set_up, 2, "it is not left out before");
            assert_eq!(stats.pixels_shaded, 0, "{faces:?} {surface:?}");
        }
    }
}

/// Behind the far plane nothing is drawn, on it everything.
#[test]
fn the_far_plane_belongs_to_the_view() {
    for (depth, expected) in
        [(0.0, 0), (f32::MIN_POSITIVE, 0), (-1e-6, u32::MAX), (1.0, 0), (1.000_001, u32::MAX)]
    {
        let pipeline = quad(depth);
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &QUAD) });
        let objects = draw(&pass).objects.expect("asked for");
        assert_eq!(objects[(20 * SIDE + 20) as usize], expected, "at depth {depth}");
    }
}

fn any_point() -> impl Strategy<Value = GridPoint> {
    [-30 * 256..(SIDE + 30) * 256, -30 * 256..(SIDE + 30) * 256]
}

/// The depth of a triangle at a pixel's centre, if it covers that.
fn exact_depth(corners: [(GridPoint, f64); 3], pixel: [i32; 2]) -> Option<f64> {
    let sample = pixel_center(pixel).map(i64::from);
    let relative =
        corners.map(|(point, _)| [i64::from(point[0]) - sample[0], i64::from(point[1]) - sample[1]]);
    let cross = |i: usize, j: usize| relative[i][0] * relative[j][1] - relative[i][1] * relative[j][0];
    let edges = [cross(1, 2), cross(2, 0), cross(0, 1)];
    let area: i64 = edges.iter().sum();
    let covered = covers(corners.map(|(point, _)| point), pixel_center(pixel));
    covered.then(|| (0..3).map(|i| edges[i] as f64 / area as f64 * corners[i].1).sum())
}
