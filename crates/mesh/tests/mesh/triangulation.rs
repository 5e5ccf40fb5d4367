//! Polygons to triangles: everything that DESIGN's hard case 35 asks for.

use std::collections::BTreeMap;

use earcut::Earcut;
use proptest::prelude::*;
use trigon_math::{DVec2, Orientation, Vec3, orientation};
use trigon_mesh::{Mesh, triangulate_polygon};

use crate::outlines::*;

/// Holds a polygon that does not cross itself, in all three planes, to all
/// promises: n − 2 triangles, none turned over, edges that fit together with
/// the outline as their border, areas that add up, everything inside.
fn check(points: &[DVec2]) {
    for plane in 0..3 {
        let triangles = triangulate_polygon(&in_space(points, plane));
        let count = points.len();
        assert_eq!(triangles.len(), count - 2, "triangles of a polygon of {count} in plane {plane}");
        for triangle in &triangles {
            let [a, b, c] = triangle.map(|i| points[i as usize]);
            let turn = orientation(a, b, c);
            assert_eq!(turn, Orientation::CounterClockwise, "triangle {triangle:?} ({a} {b} {c})");
        }
        check_edges(count as u32, &triangles);
        check_area(points, &triangles);
        check_inside(points, &triangles);
    }
}

/// Every side of the outline is one triangle's edge; all other edges come in
/// opposite pairs.
fn check_edges(corners: u32, triangles: &[[u32; 3]]) {
    let mut balance = BTreeMap::new();
    for &[a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *balance.entry((from.min(to), from.max(to))).or_insert(0) += if from < to { 1 } else { -1 };
        }
    }
    for corner in 0..corners {
        let next = (corner + 1) % corners;
        let expected = if corner < next { 1 } else { -1 };
        let side = balance.remove(&(corner.min(next), corner.max(next)));
        assert_eq!(side, Some(expected), "side {corner}-{next} of the outline");
    }
    for (edge, sum) in balance {
        assert_eq!(sum, 0, "inner edge {edge:?} has no partner");
    }
}

fn check_area(points: &[DVec2], triangles: &[[u32; 3]]) {
    let expected = doubled_area(points);
    let of_triangle = |t: &[u32; 3]| doubled_area(&t.map(|i| points[i as usize]));
    let sum: f64 = triangles.iter().map(of_triangle).sum();
    assert!((sum - expected).abs() <= 1e-9 * expected, "areas add up to {sum}, not {expected}");
}

fn check_inside(points: &[DVec2], triangles: &[[u32; 3]]) {
    // Quadratic: large polygons are sampled.
    for triangle in triangles.iter().step_by(1 + points.len() / 500) {
        let [a, b, c] = triangle.map(|i| points[i as usize]);
        let middle = (a + b + c) / 3.0;
        let mut inside = false;
        for (i, &p) in points.iter().enumerate() {
            let q = points[(i + 1) % points.len()];
            if (p.y > middle.y) != (q.y > middle.y) {
                let x = p.x + (middle.y - p.y) / (q.y - p.y) * (q.x - p.x);
                inside ^= middle.x < x;
            }
        }
        assert!(inside, "the middle of triangle {triangle:?} is outside");
    }
}

#[test]
fn simple_shapes() {
    check(&outline(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]));
    check(&outline(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]));
    // L, U, and an arrow head from each of its corners.
    check(&outline(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]));
    let u = [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (2.0, 3.0), (2.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)];
    check(&outline(&u));
    let mut arrow = outline(&[(0.0, 0.0), (3.0, -1.0), (1.0, 0.0), (3.0, 1.0)]);
    for _ in 0..4 {
        check(&arrow);
        arrow.rotate_left(1);
    }
}

#[test]
fn corners_within_a_side_are_used() {
    check(&outline(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 2.0)]));
    let ring =
        [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0), (0.0, 1.0)];
    check(&outline(&ring));
    check(&skyline(&[3, 3, 3, 1, 1, 4, 4, 0, 0, 0]));
}

#[test]
fn holes_with_bridges_stay_open() {
    for holes in [1, 2, 7, 40] {
        check(&holes_with_bridges(holes));
    }
}

#[test]
fn a_star_with_20_000_corners() {
    let radii: Vec<f64> = (0..20_000).map(|i| if i % 2 == 0 { 1000.0 } else { 400.0 }).collect();
    check(&star(&radii));
}

#[test]
fn a_comb_with_4000_corners() {
    check(&comb(2000));
}

#[test]
fn a_20_000_gon_is_cut_evenly() {
    // A fan would give every triangle one corner in common.
    let circle = star(&vec![1000.0; 20_000]);
    let triangles = triangulate_polygon(&in_space(&circle, 0));
    let mut uses = vec![0u32; circle.len()];
    triangles.iter().flatten().for_each(|&i| uses[i as usize] += 1);
    let most = uses.iter().max();
    assert!(most <= Some(&64), "one corner is in {most:?} triangles");
}

#[test]
fn a_repeated_corner_costs_one_triangle() {
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let points = outline(&square);
    let triangles = triangulate_polygon(&in_space(&points, 0));
    assert_eq!(triangles.len(), 2, "a square with a corner twice");
    check_area(&points, &triangles);
}

#[test]
fn a_spike_without_width_is_left_out() {
    let points = outline(&[(0.0, 0.0), (1.0, 0.0), (5.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    let triangles = triangulate_polygon(&in_space(&points, 1));
    check_area(&points, &triangles);
    check_inside(&points, &triangles);
}

#[test]
fn polygons_without_area_have_no_triangles() {
    let line: Vec<Vec3> = (0..6).map(|i| Vec3::splat(i as f32)).collect();
    assert_eq!(triangulate_polygon(&line), [[0u32; 3]; 0], "a line");
    assert_eq!(triangulate_polygon(&line[..4]), [[0u32; 3]; 0], "a short line");
    assert_eq!(triangulate_polygon(&[Vec3::ONE; 5]), [[0u32; 3]; 0], "a point");
    assert_eq!(triangulate_polygon(&line[..3]), [[0, 1, 2]], "a triangle is itself");
    assert_eq!(triangulate_polygon(&line[..2]), [[0u32; 3]; 0], "two points");
    assert_eq!(triangulate_polygon(&[]), [[0u32; 3]; 0], "nothing");
}

#[test]
fn crossing_polygons_stay_in_their_hull() {
    let bow_tie = outline(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]);
    let lopsided = outline(&[(0.0, 0.0), (3.0, 2.0), (3.0, 0.0), (0.0, 1.0)]);
    let pentagram: Vec<DVec2> = [0, 2, 4, 1, 3].map(|i| star(&[1.0; 5])[i]).to_vec();
    let tangle: Vec<DVec2> =
        (0..500).map(|i| DVec2::new(f64::from(i * 37 % 101), f64::from(i * 61 % 97))).collect();
    for points in [bow_tie, lopsided, pentagram, tangle] {
        let triangles = triangulate_polygon(&in_space(&points, 2));
        assert!(!triangles.is_empty(), "a crossing polygon still shows something");
        assert!(triangles.len() <= points.len() - 2, "{} triangles", triangles.len());
        let turn = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| points[i as usize]);
            orientation(a, b, c)
        };
        // The polygon's own sense, where it has one.
        let expected = match doubled_area(&points) {
            area if area > 0.0 => Orientation::CounterClockwise,
            area if area < 0.0 => Orientation::Clockwise,
            _ => turn(&triangles[0]),
        };
        assert!(triangles.iter().all(|t| turn(t) == expected), "not all of {triangles:?} turn {expected:?}");
    }
}

#[test]
fn quads_take_the_shorter_diagonal_that_turns_nothing_over() {
    let quad =
        |points: [(f32, f32, f32); 4]| triangulate_polygon(&points.map(|(x, y, z)| Vec3::new(x, y, z)));
    let first = [[0, 1, 2], [0, 2, 3]];
    let second = [[0, 1, 3], [1, 2, 3]];
    let square = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)];
    assert_eq!(quad(square), first, "equal diagonals");
    let long = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (3.0, 3.0, 0.0), (0.0, 1.0, 0.0)];
    assert_eq!(quad(long), second, "a kite is cut across");
    let bent = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.5), (1.0, 1.0, 0.0), (0.0, 1.0, 0.5)];
    assert_eq!(quad(bent), first, "a saddle whose diagonals are equal");
    let arrow = [(0.0, 0.0, 0.0), (3.0, -1.0, 0.0), (1.0, 0.0, 0.0), (3.0, 1.0, 0.0)];
    assert_eq!(quad(arrow), first, "the other diagonal is outside");
}

#[test]
fn what_is_not_finite_becomes_a_fan() {
    for bad in [f32::NAN, f32::INFINITY] {
        for count in [4, 7] {
            let mut points = vec![Vec3::ZERO; count];
            points[2].x = bad;
            assert_eq!(triangulate_polygon(&points).len(), count - 2, "{bad} in a polygon of {count}");
        }
    }
}

#[test]
fn huge_and_tiny_polygons() {
    for scale in [1e-30, 1e-20, 1e-6, 1e15, 1e30] {
        let points: Vec<Vec3> = in_space(&holes_with_bridges(3), 2).iter().map(|p| *p * scale).collect();
        let triangles = triangulate_polygon(&points);
        assert_eq!(triangles.len(), points.len() - 2, "at scale {scale}");
    }
}

#[test]
fn a_mesh_keeps_faces_and_corners_apart() {
    let positions = in_space(&outline(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (-1.0, 0.5)]), 0);
    let mesh = mesh(&positions, &[&[0, 1, 2, 3], &[0, 3, 4]]);
    let triangulation = mesh.triangulation();
    assert_eq!(triangulation.triangles, [[0, 1, 2], [0, 2, 3], [4, 5, 6]], "corner indices");
    assert_eq!(triangulation.triangle_faces, [0, 0, 1], "faces");
    assert!(Mesh::default().triangulation().triangles.is_empty(), "nothing comes of nothing");
}

fn earcut_area(points: &[DVec2]) -> f64 {
    let mut triangles: Vec<u32> = Vec::new();
    Earcut::new().earcut(points.iter().map(|p| p.to_array()), &[], &mut triangles);
    let corner = |i: u32| points[i as usize];
    triangles.chunks(3).map(|t| doubled_area(&[corner(t[0]), corner(t[1]), corner(t[2])]).abs()).sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn random_stars(radii in prop::collection::vec(0.05f64..1000.0, 3..80)) {
        let points = star(&radii);
        // Three directions cannot surround the origin, so they may cross it.
        prop_assume!(radii.len() > 3);
        check(&points);
        let area = doubled_area(&points);
        prop_assert!((earcut_area(&points) - area).abs() <= 1e-9 * area, "earcut disagrees");
    }

    /// Earcut does not promise a triangulation of every simple outline, so only the promises are asked for.
    #[test]
    fn random_outlines(
        points in prop::collection::vec((0u8..=16, 0u8..=16, any::<usize>()), 1..60),
    ) {
        let points: Vec<(DVec2, usize)> = points
            .iter()
            .map(|&(x, y, side)| (DVec2::new(f64::from(x), f64::from(y)), side % 64))
            .collect();
        check(&grown(&points));
    }

    #[test]
    fn random_skylines(heights in prop::collection::vec(0u8..4, 1..60)) {
        check(&skyline(&heights));
    }

    #[test]
    fn where_an_outline_starts_does_not_matter(
        heights in prop::collection::vec(0u8..3, 2..20),
        turn in 0usize..40,
    ) {
        let mut points = skyline(&heights);
        let count = points.len();
        points.rotate_left(turn % count);
        check(&points);
    }

    #[test]
    fn anything_at_all_gives_few_triangles(
        points in prop::collection::vec((-4i8..4, -4i8..4, -1i8..2), 0..40),
    ) {
        let positions: Vec<Vec3> = points
            .iter()
            .map(|&(x, y, z)| Vec3::new(f32::from(x), f32::from(y), f32::from(z)))
            .collect();
        let triangles = triangulate_polygon(&positions);
        prop_assert!(triangles.len() <= positions.len().saturating_sub(2), "{} triangles", triangles.len());
        for triangle in triangles {
            prop_assert!(triangle.iter().all(|&i| (i as usize) < positions.len()), "{triangle:?}");
        }
    }
}
