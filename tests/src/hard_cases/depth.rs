//! Surfaces in each other's plane or next to it, and ranges of depth from a
//! millimetre to a million metres and to infinity.

use crate::coverage_support::{SIDE, Values, clip_position, draw, pixel};
use crate::effort::cases;
use num_traits::Signed;
use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{Bounds3, DVec3, Vec4, elementary};
use trigon_raster::{Culling, Draw, Pass, TargetImages};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::area::rational;
use trigon_study::oracle::coverage::{covers, pixel_center};
use trigon_study::oracle::depth::Plane;

fn images(vertices: Vec<Vec4>, triangles: &[[u32; 3]]) -> TargetImages {
    let pipeline = Values::ones(vertices);
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, triangles) });
    draw(&pass)
}

/// Half a unit of the last place of a depth below 1 is 2^-25. What the plane in f64
/// is off before that, `2^-50 Δz XY/A` and an eighth (see `primitive/depth.rs`), is at most
/// a 32nd of that as long as XY/A is below 2^19.
const ROUNDED: f64 = (1.0 + 1.0 / 32.0) / (1 << 25) as f64;

proptest! {
    #![proptest_config(cases(150))]

    /// Hard case 24: a polygon in a plane, cut into triangles from either of two
    /// corners, has the depth of that plane at each sample. It is a number of 24 bits,
    /// so that the one rounding to f32 finds it again.
    #[test]
    fn two_triangulations_of_a_plane_have_its_depth(
        middle in [20 * 256..44 * 256_i32, 20 * 256..44 * 256],
        radii in [1000..7000_i32, 1000..7000],
        slopes in [-100..100_i32, -100..100],
        base in 1 << 22..3 << 22_i32,
        first in 1..6_u32,
    ) {
        let [x, y] = middle;
        let [rx, ry] = radii;
        // A convex hexagon.
        let offsets = [[-rx, -ry / 2], [0, -ry], [rx, -ry / 2], [rx, ry / 2], [0, ry], [-rx, ry / 2]];
        let corners = offsets.map(|[dx, dy]| [x + dx, y + dy]);
        // 24 bits, so that the corners are exactly in one plane.
        let depth_at = |[x, y]: GridPoint| base + slopes[0] * (x - middle[0]) + slopes[1] * (y - middle[1]);
        let depth = |point| depth_at(point) as f32 / (1 << 24) as f32;
        let fan = |first: u32| (1..5).map(move |i| [first, (first + i) % 6, (first + i + 1) % 6]).collect::<Vec<_>>();
        for fan in [fan(0), fan(first)] {
            let vertices = corners.map(|point| clip_position(point, depth(point))).to_vec();
            let images = images(vertices, &fan);
            let (ids, depths) = (images.triangles.expect("asked for"), images.depth.expect("asked for"));
            for (index, &found) in depths.iter().enumerate() {
                let sample = pixel_center(pixel(index));
                let is_covered = ids[index] != u32::MAX;
                if index % 5 == 0 {
                    let covered = fan.iter().any(|triangle| covers(triangle.map(|i| corners[i as usize]), sample));
                    prop_assert_eq!(is_covered, covered, "coverage at {:?}", pixel(index));
                }
                if is_covered {
                    let exact = f64::from(depth_at(sample)) / f64::from(1 << 24);
                    prop_assert_eq!(f64::from(found), exact, "at {:?}", pixel(index));
                }
            }
        }
    }

    /// Two triangles with the same outline whose depths are some units of the last
    /// place apart: where their exact planes differ by more than rounding, the nearer
    /// one is seen, so they part along one line.
    #[test]
    fn nearly_coplanar_planes_part_where_exact_arithmetic_parts_them(
        corners in [[0..SIDE * 256, 0..SIDE * 256], [0..SIDE * 256, 0..SIDE * 256], [0..SIDE * 256, 0..SIDE * 256]],
        depths in [0.5_f32..0.9, 0.5..0.9, 0.5..0.9],
        steps in [-20..20_i32, -20..20, -20..20],
    ) {
        let moved = [0, 1, 2].map(|i| f32::from_bits(depths[i].to_bits().wrapping_add_signed(steps[i])));
        let planes = [depths, moved].map(|depths| Plane { corners, depths });
        prop_assume!(planes[0].stretch() < f64::from(1 << 19));
        let vertices = planes.iter().flat_map(|plane| [0, 1, 2].map(|i| clip_position(corners[i], plane.depths[i])));
        let ids = images(vertices.collect(), &[[0, 1, 2], [3, 4, 5]]).triangles.expect("asked for");
        for (index, &id) in ids.iter().enumerate().step_by(5) {
            let sample = pixel_center(pixel(index));
            if !covers(corners, sample) {
                continue;
            }
            let [first, second] = planes.map(|plane| plane.at(sample).expect("it has an area"));
            let difference = second - first;
            if difference.abs() > rational(2.0 * ROUNDED) {
                prop_assert_eq!(id, u32::from(difference.is_positive()), "at {:?}", pixel(index));
            } else {
                prop_assert!(id < 2, "one of them");
            }
        }
    }
}

/// Facing walls at these distances, each seen through `projection` over all of the
/// image; which of them is seen, and how deep.
fn walls(projection: &Projection, distances: &[f64]) -> (u32, f32) {
    let matrix = projection.matrix(1.0);
    let wall = |&distance: &f64| {
        let reach = projection.height_at(distance);
        [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]].map(|[x, y]| {
            (matrix * (DVec3::new(x, y, 0.0) * reach - DVec3::Z * distance).extend(1.0)).as_vec4()
        })
    };
    let vertices: Vec<Vec4> = distances.iter().flat_map(wall).collect();
    let triangles: Vec<_> = (0..distances.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let images = images(vertices, &triangles);
    let (ids, depths) = (images.triangles.expect("asked for"), images.depth.expect("asked for"));
    assert!(ids.iter().all(|id| *id == ids[0]), "one wall all over");
    (ids[0], depths[0])
}

fn perspective(near: f64, far: Option<f64>) -> Projection {
    Projection::perspective(1.0, near, far).expect("in range")
}

/// Where the near and far planes are.
#[derive(Clone, Copy, Debug)]
enum Planes {
    /// As they are given.
    Given,
    /// As the engine sets them around a scene that reaches as far, also behind the eye.
    Automatic,
}

fn planes() -> impl Strategy<Value = Planes> {
    prop_oneof![Just(Planes::Given), Just(Planes::Automatic)]
}

impl Planes {
    fn of(self, projection: Projection, reach: f64) -> Projection {
        self.between(projection, -reach, reach)
    }

    /// Around a scene from one distance to another along the line of sight, also behind the eye.
    fn between(self, projection: Projection, from: f64, to: f64) -> Projection {
        let reach = (to - from) / 2.0;
        let around = Bounds3 { min: DVec3::new(-reach, -reach, -to), max: DVec3::new(reach, reach, -from) };
        match self {
            Self::Given => projection,
            Self::Automatic => {
                Camera::default().with_projection(projection).with_clip_planes(&around).projection
            }
        }
    }
}

/// A number from one to another, any magnitude as likely.
fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f64> {
    let [low, high] = [low, high].map(elementary::ln);
    (low..high).prop_map(elementary::exp)
}

proptest! {
    #![proptest_config(cases(60))]

    /// Hard case 26: fifty planes 1e-5 apart, ten metres away, near plane at 0.1. Their
    /// depths are 1e-8 apart and a unit of the last place is 1e-9.
    #[test]
    fn reversed_depth_tells_planes_apart_that_are_close(
        chosen in proptest::sample::subsequence((0..50_u32).collect::<Vec<_>>(), 2..9),
        turn in any::<prop::sample::Index>(),
        far in prop_oneof![Just(Some(100.0)), Just(None)],
        planes in planes(),
    ) {
        let nearest = chosen[0];
        let mut order = chosen;
        let turn = turn.index(order.len());
        order.rotate_left(turn);
        let distances: Vec<f64> = order.iter().map(|&i| 10.0 + 1e-5 * f64::from(i)).collect();
        let (seen, _) = walls(&planes.of(perspective(0.1, far), 100.0), &distances);
        prop_assert_eq!(order[seen as usize], nearest, "of {:?}", order);
    }

    /// From 1e-3 to 1e6 and to infinity: what lies further by 2^-20 of its distance is
    /// behind. With n the near plane, clip space's z is at most n. It is rounded by
    /// 2^-24 n, and w and the depth by 2^-24 of themselves: a depth is off by less than
    /// 2^-22 n/w, and two walls differ by 2^-20 n/w.
    #[test]
    fn depth_keeps_its_precision_at_all_distances(
        distance in magnitude(1.1e-3, 9e5),
        infinite in any::<bool>(),
        swapped in any::<bool>(),
        planes in planes(),
    ) {
        let projection = planes.of(perspective(1e-3, (!infinite).then_some(1e6)), 1e6);
        let further = distance * (1.0 + elementary::exp2(-20.0));
        let order = if swapped { [further, distance] } else { [distance, further] };
        let (seen, depth) = walls(&projection, &order);
        prop_assert_eq!(seen, u32::from(swapped), "at {}", distance);
        let near = projection.near();
        let exact = near / distance * projection.far().map_or(1.0, |far| (far - distance) / (far - near));
        let bound = near / distance * elementary::exp2(-22.0);
        prop_assert!((f64::from(depth) - exact).abs() <= bound, "{depth} instead of {exact}");
    }

    /// Hard case 27: with the far plane at infinity nothing is too far.
    #[test]
    fn an_infinite_far_plane_keeps_what_is_far(
        distance in magnitude(1e6, 1e28), swapped in any::<bool>(), planes in planes(),
    ) {
        let order = if swapped { [distance * 1.01, distance] } else { [distance, distance * 1.01] };
        let (seen, depth) = walls(&planes.of(perspective(0.01, None), 2.0 * distance), &order);
        prop_assert_eq!(seen, u32::from(swapped), "the nearer one");
        prop_assert!(depth > 0.0, "before infinity, {depth}");
    }

    /// Orthographic depth is linear: 1 at the near plane and 0 at the far one, rounded
    /// to f32 once, by 2^-25 at most (in f64 before that by 2^-47, as the range is not
    /// much smaller than its distance). Walls 2^-22 of the range apart are told apart
    /// everywhere, also behind the eye.
    #[test]
    fn orthographic_depth_is_linear(
        start in -10.0_f64..10.0,
        range in magnitude(1e-3, 1e6),
        share in 0.001_f64..0.999,
        swapped in any::<bool>(),
        planes in planes(),
    ) {
        let near = start * range;
        let given = Projection::orthographic(2.0, near, near + range).expect("in range");
        let projection = planes.between(given, near, near + range);
        let distance = near + range * share;
        let further = distance + range * elementary::exp2(-22.0);
        let order = if swapped { [further, distance] } else { [distance, further] };
        let (seen, depth) = walls(&projection, &order);
        prop_assert_eq!(seen, u32::from(swapped), "at {} of the range", share);
        let (near, far) = (projection.near(), projection.far().expect("parallel"));
        prop_assert!(near <= distance && far - near <= 1.2 * range, "planes at {near} and {far}");
        let error = f64::from(depth) - (far - distance) / (far - near);
        prop_assert!(error.abs() <= elementary::exp2(-24.0), "off by {error}");
    }
}

proptest! {
    #![proptest_config(cases(20))]

    /// Hard case 26: depth falls as distance grows, whatever the distances: an image
    /// of 4096 pixels, each with a small wall of its own.
    #[test]
    fn depth_is_monotone_in_distance(
        nearest in proptest::collection::vec(magnitude(0.1, 9e5), SIDE as usize),
        far in prop_oneof![Just(Some(1e6)), Just(None)],
        planes in planes(),
    ) {
        // From each on the next numbers that f32 has.
        let row = |first: &f64| {
            let bits = (*first as f32).to_bits();
            (0..SIDE as u32).map(move |step| f64::from(f32::from_bits(bits + step)))
        };
        let distances: Vec<f64> = nearest.iter().flat_map(row).collect();
        let matrix = planes.of(perspective(0.1, far), 1e6).matrix(1.0);
        let vertices = distances.iter().enumerate().flat_map(|(index, &distance)| {
            let [x, y] = pixel(index).map(|v| 256 * v);
            let clip = matrix * (DVec3::Z * -distance).extend(1.0);
            [[x, y], [x + 300, y], [x, y + 300]]
                .map(|point| (clip_position(point, 0.0).as_dvec4() * clip.w).with_z(clip.z).as_vec4())
        });
        let triangles: Vec<_> = (0..distances.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let images = images(vertices.collect(), &triangles);
        let ids = images.triangles.expect("asked for");
        prop_assert!((0..).zip(&ids).all(|(index, &id)| id == index), "each has its pixel");
        let mut seen: Vec<_> = distances.iter().zip(images.depth.expect("asked for")).collect();
        seen.sort_by(|a, b| a.0.total_cmp(b.0));
        let wrong = seen.windows(2).find(|pair| pair[0].1 < pair[1].1);
        prop_assert!(wrong.is_none(), "{wrong:?}");
    }
}
