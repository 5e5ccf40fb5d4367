//! What a ray through each sample meets, by brute force: which triangle is
//! seen, and where clipping has left something of one.

use crate::coverage_support::{Samples, Values, draw_sized, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use trigon_math::{DVec2, UVec2, Vec4};
use trigon_raster::{Culling, Draw, ExecuteSettings, Output, Pass};
use trigon_study::oracle::coverage::sample_points;
use trigon_study::oracle::ray::{Facet, Sight, Tolerance, first_met};

const SIDE: i32 = 96;

const SIZE: UVec2 = UVec2::splat(SIDE as u32);

const NEAR: f32 = 0.25;

/// How far a sample may be from an outline, in pixels, and be taken for one on its
/// other side: corners are snapped by 1/512 on either axis, together 1/362, and
/// those that cutting makes have been rounded before by less than what is left.
///
/// Depths of at most 1 are rounded to f32 twice, those of the corners and their
/// own, and `primitive/depth.rs` adds its bound; together that is below 2^-22.
const TOLERANCE: Tolerance = Tolerance { outline: 1.0 / 256.0, depth: 1.0 / (1 << 22) as f64 };

type Triangle = [Vec4; 3];

/// A point at a distance before the eye (negative: behind it), which an infinite
/// perspective has brought to clip space: x and y as shares of the distance.
fn corner(reach: f32, w: impl Strategy<Value = f32>) -> impl Strategy<Value = Vec4> {
    (-reach..reach, -reach..reach, w).prop_map(|(x, y, w)| Vec4::new(x * w.abs(), y * w.abs(), NEAR, w))
}

/// Triangles over much of the image; one in four is cut at the near plane.
fn triangles() -> impl Strategy<Value = Vec<Triangle>> {
    let before = || corner(1.5, 0.3_f32..4.0);
    let any = || corner(1.5, -2.0_f32..4.0);
    let triangle = prop_oneof![3 => [before(), before(), before()], 1 => [before(), any(), any()]];
    proptest::collection::vec(triangle, 2..12)
}

fn pipeline(triangles: &[Triangle]) -> (Values, Vec<[u32; 3]>) {
    let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    (Values::ones(triangles.iter().flatten().copied()), indices)
}

/// Compares all samples that ids are taken from; how many of those that show a
/// triangle were compared, and how many were left out.
fn compare(triangles: &[Triangle], samples: u32) -> [usize; 2] {
    let (pipeline, indices) = pipeline(triangles);
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &indices) });
    let per_pixel = Samples { per_axis: 1, per_pixel: samples };
    let mut target = per_pixel.target([SIDE as u32; 2], &[Output::Triangle]);
    rasterizer(&ExecuteSettings::default()).draw(&pass, &mut target);
    let facets: Vec<_> = triangles.iter().map(|&corners| Facet::new(corners, SIZE)).collect();
    let mut counts = [0; 2];
    for (index, &id) in (0..).zip(target.triangles().expect("asked for")) {
        let raw = sample_points(samples, [index % SIDE, index / SIDE]).next().expect("at least one");
        let point = DVec2::from(raw.map(f64::from)) / 256.0;
        let expected = match first_met(&facets, point, TOLERANCE) {
            Sight::Nothing => Some(u32::MAX),
            Sight::Triangle(number) => Some(number as u32),
            Sight::Unclear => None,
        };
        if let Some(expected) = expected {
            assert_eq!(id, expected, "seen at {point} among {triangles:?}");
        }
        counts[usize::from(expected.is_none())] += usize::from(id != u32::MAX);
    }
    counts
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn the_triangle_seen_is_that_which_a_ray_meets_first(
        triangles in triangles(),
        samples in prop_oneof![Just(1_u32), Just(4), Just(16)],
    ) {
        compare(&triangles, samples);
    }
}

/// The exceptions would be of no use if they were many.
#[test]
fn few_samples_are_left_out() {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let mut counts = [0; 2];
    for _ in 0..30 {
        let scene = triangles().new_tree(&mut runner).expect("every range yields a value").current();
        let [compared, left_out] = compare(&scene, 1);
        counts = [counts[0] + compared, counts[1] + left_out];
    }
    let [compared, left_out] = counts;
    assert!(compared > 50_000, "only {compared} samples show a triangle and were compared");
    assert!(left_out * 50 < compared, "{left_out} samples were left out and {compared} compared");
}

/// A triangle that is cut at the near plane, at the guard band, or at both.
fn cut_triangle() -> impl Strategy<Value = Triangle> {
    let before = || corner(1.5, 0.3_f32..4.0);
    let behind = || corner(1.5, -3.0..NEAR);
    let far_out = || corner(1e6, 0.3_f32..4.0);
    prop_oneof![
        [before(), before(), behind()],
        [before(), behind(), behind()],
        [before(), before(), far_out()],
        [before(), far_out(), far_out()],
        [before(), far_out(), behind()],
        [far_out(), far_out(), far_out()],
    ]
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn a_cut_triangle_covers_its_exact_outline_within_a_256th(triangle in cut_triangle()) {
        let facet = Facet::new(triangle, SIZE);
        let (pipeline, indices) = pipeline(&[triangle]);
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &indices) });
        let ids = draw_sized(&pass, [SIDE; 2], &ExecuteSettings::default()).triangles.expect("asked for");
        for (index, id) in (0..).zip(ids) {
            let point = DVec2::new(f64::from(index % SIDE), f64::from(index / SIDE)) + 0.5;
            if facet.distance_to_outline(point) > TOLERANCE.outline {
                let inside = facet.meets(point).is_some();
                prop_assert_eq!(id == 0, inside, "at {}", point);
            }
        }
    }
}
