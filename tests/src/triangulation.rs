//! Triangulations in exact rationals: the areas of the triangles add up to the
//! polygon's, to the last bit, on coordinates as floats have them.

use num_rational::BigRational;
use num_traits::{Signed, Zero};
use proptest::prelude::*;
use trigon_math::{Vec3, elementary};
use trigon_mesh::triangulate_polygon;

type Point = [BigRational; 2];

fn exact(position: Vec3) -> Point {
    [position.x, position.y].map(|x| BigRational::from_float(x).expect("test coordinates are finite"))
}

/// Twice the area of a triangle, positive if it is counter-clockwise.
fn doubled_area([a, b, c]: [&Point; 3]) -> BigRational {
    let minus = |p: &Point, q: &Point| [&p[0] - &q[0], &p[1] - &q[1]];
    let ([ux, uy], [vx, vy]) = (minus(b, a), minus(c, a));
    ux * vy - uy * vx
}

fn check(outline: &[Vec3]) {
    let points: Vec<Point> = outline.iter().copied().map(exact).collect();
    let mut whole = BigRational::zero();
    for pair in points.windows(2) {
        whole += doubled_area([&points[0], &pair[0], &pair[1]]);
    }
    assert!(whole.is_positive(), "the test's outline is counter-clockwise");
    let mut sum = BigRational::zero();
    for triangle in triangulate_polygon(outline) {
        let part = doubled_area(triangle.each_ref().map(|&i| &points[i as usize]));
        assert!(part.is_positive(), "triangle {triangle:?} has the area {part}");
        sum += part;
    }
    assert_eq!(sum, whole, "areas of the triangles and of the polygon");
}

/// A star round a centre far from the origin, so that coordinates are coarse
/// and angles are anything.
fn star(radii: &[f32], centre: f32) -> Vec<Vec3> {
    let at = |(i, radius): (usize, &f32)| {
        let angle = std::f64::consts::TAU * i as f64 / radii.len() as f64;
        let (sin, cos) = elementary::sin_cos(angle);
        Vec3::new(cos as f32 * radius + centre, sin as f32 * radius - centre, centre)
    };
    radii.iter().enumerate().map(at).collect()
}

/// A strip between two lines that rise and fall together: nothing but slivers.
fn strip(heights: &[f32], thickness: f32) -> Vec<Vec3> {
    let lower = heights.iter().enumerate().map(|(i, &y)| Vec3::new(i as f32, y, 0.0));
    let upper = lower.clone().rev().map(|p| p + Vec3::Y * thickness);
    lower.chain(upper).collect()
}

proptest! {
    #![proptest_config(crate::effort::cases(64))]

    #[test]
    fn areas_of_stars_add_up(
        radii in prop::collection::vec(1f32..1000.0, 8..60),
        centre in prop::sample::select(vec![0f32, 3.0, 4096.5]),
    ) {
        check(&star(&radii, centre));
    }

    #[test]
    fn areas_of_slivers_add_up(
        heights in prop::collection::vec(-100f32..100.0, 2..40),
        exponent in -3i32..3,
    ) {
        check(&strip(&heights, elementary::pow(10.0, f64::from(exponent)) as f32));
    }

    #[test]
    fn areas_of_quads_add_up(
        x in prop::array::uniform4(1f32..1000.0),
        scale in prop::sample::select(vec![1e-20f32, 1.0, 1e15]),
    ) {
        let around = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        let corner = |i: usize| Vec3::new(around[i].0 * x[i] * scale, around[i].1 * x[i] * scale, 0.0);
        check(&[0, 1, 2, 3].map(corner));
    }
}
