//! The tree answers as a look at every triangle does.

use glam::Vec3;

use super::triangle::ShearedRay;
use super::*;
use proptest::prelude::*;

fn vector() -> impl Strategy<Value = Vec3> {
    // A coarse grid, too: rays then meet edges, vertices and sides of boxes.
    let coordinate = prop_oneof![-4.0_f32..4.0, (-4_i8..=4).prop_map(f32::from)];
    [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from_array)
}

fn by_brute_force(triangles: &[[Vec3; 3]], ray: &Ray) -> Option<RayHit> {
    let sheared = ShearedRay::new(ray);
    let mut nearest: Option<RayHit> = None;
    for (triangle, corners) in (0_u32..).zip(triangles) {
        let met = sheared.meet(&Leaf::new(std::iter::once((triangle, *corners))).corners);
        let (distance, weights) = (met.distances[0], met.weights.map(|weight| weight[0]));
        if distance >= 0.0 && distance.is_finite() && nearest.is_none_or(|best| distance < best.distance) {
            nearest = Some(RayHit { distance, triangle, weights });
        }
    }
    nearest
}

proptest! {
    #[test]
    fn a_tree_answers_as_a_look_at_every_triangle(
        triangles in prop::collection::vec([vector(), vector(), vector()], 0..120),
        rays in prop::collection::vec((vector(), vector()), 20),
    ) {
        let bvh = Bvh::new(&triangles);
        for (origin, direction) in rays {
            prop_assume!(direction != Vec3::ZERO);
            let ray = Ray { origin, direction };
            let expected = by_brute_force(&triangles, &ray);
            prop_assert_eq!(bvh.nearest(&ray, 0.0..f32::INFINITY), expected, "{:?}", ray);
            prop_assert_eq!(bvh.meets_any(&ray, 0.0..f32::INFINITY), expected.is_some(), "{:?}", ray);
        }
    }

    /// A closed solid seen from inside has no holes, whatever the ray.
    #[test]
    fn no_ray_leaks_out_of_a_closed_solid(origin in vector(), direction in vector()) {
        prop_assume!(direction != Vec3::ZERO);
        let corner = |i: u32| Vec3::new(
            if i & 1 == 0 { -1.0 } else { 1.0 },
            if i & 2 == 0 { -1.0 } else { 1.0 },
            if i & 4 == 0 { -1.0 } else { 1.0 },
        );
        let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let triangles: Vec<[Vec3; 3]> = quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .map(|corners| corners.map(corner))
            .collect();
        let ray = Ray { origin: origin * 0.2, direction };
        let hit = Bvh::new(&triangles).nearest(&ray, 0.0..f32::INFINITY);
        prop_assert!(hit.is_some(), "{:?} leaves the cube", ray);
    }
}

#[test]
fn nothing_is_met_where_there_is_nothing() {
    let ray = Ray { origin: Vec3::ZERO, direction: Vec3::X };
    assert_eq!(Bvh::new(&[]).nearest(&ray, 0.0..1.0), None, "no triangle");
    let broken = [[Vec3::NAN, Vec3::X, Vec3::Y]];
    assert!(Bvh::new(&broken).is_empty(), "a triangle that is nowhere");
    let nowhere = Ray { direction: Vec3::ZERO, ..ray };
    let triangle = [[Vec3::new(1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, -1.0), Vec3::new(1.0, 0.0, 1.0)]];
    assert_eq!(Bvh::new(&triangle).nearest(&nowhere, 0.0..1.0), None, "a ray without direction");
    assert!(Bvh::new(&triangle).meets_any(&ray, 0.0..2.0), "and one with");
}

#[test]
fn the_same_triangles_many_times_do_not_make_a_deep_tree() {
    let triangle = [Vec3::X, Vec3::Y, Vec3::Z];
    let bvh = Bvh::new(&vec![triangle; 5000]);
    let ray = Ray { origin: Vec3::ZERO, direction: Vec3::ONE };
    let hit = bvh.nearest(&ray, 0.0..f32::INFINITY).expect("in the way");
    assert_eq!(hit.triangle, 0, "the smallest number of equals");
}
