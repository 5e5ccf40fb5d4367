//! Cuts: counts, closed and dangling paths, areas, and values that stay affine.

use proptest::prelude::*;
use trigon_math::elementary::sin_cos;
use trigon_math::{DVec2, Orientation, area_vector, orientation};
use trigon_mesh::primitives;

use super::*;
use crate::tests::{keeps_affine_values, meshes, with_affine_values};

fn edit(mesh: trigon_mesh::Mesh) -> EditMesh {
    EditMesh::from_mesh(&with_affine_values(mesh)).0
}

fn counts(mesh: &EditMesh) -> [usize; 3] {
    mesh.check_structure().expect("whole");
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

fn center(mesh: &EditMesh, face: FaceId) -> Vec3 {
    let sum: Vec3 = mesh.face_vertices(face).map(|vertex| mesh.position(vertex)).sum();
    sum / mesh.face_size(face) as f32
}

#[test]
fn a_path_over_a_cube_cuts_the_faces_that_it_crosses() {
    let mut cube = edit(primitives::cube(2.0));
    let edges: Vec<EdgeId> = cube.face_edges(FaceId(0)).collect();
    let middle = KnifePoint::Face(FaceId(0), center(&cube, FaceId(0)));
    // From one side to its neighbour, with a corner in the middle of the face.
    let path = vec![KnifePoint::Edge(edges[0], 0.25), middle, KnifePoint::Edge(edges[1], 0.5)];
    let cut = cube.knife(&[path]).expect("one face");
    assert_eq!((cut.edges.len(), cut.vertices.len(), cut.faces.len()), (2, 3, 1), "one cut with a corner");
    assert_eq!(counts(&cube), [8 + 3, 12 + 2 + 2, 7], "genus 0");
    let position = center(&edit(primitives::cube(2.0)), FaceId(0));
    assert!(
        cube.position(cut.vertices[1].expect("it divides")).abs_diff_eq(position, 1e-6),
        "as given, but for rounding"
    );
    keeps_affine_values(&cube).expect("interpolated");
}

#[test]
fn a_notch_at_an_edge_and_a_diagonal_are_cuts_too() {
    let mut cube = edit(primitives::cube(2.0));
    let corners: Vec<VertexId> = cube.face_vertices(FaceId(0)).collect();
    let diagonal = vec![KnifePoint::Vertex(corners[0]), KnifePoint::Vertex(corners[2])];
    cube.knife(std::slice::from_ref(&diagonal)).expect("across a face");
    assert_eq!(counts(&cube), [8, 13, 7], "two triangles");
    let again = cube.knife(std::slice::from_ref(&diagonal)).expect("along an edge");
    assert_eq!((again.faces.len(), again.edges.len()), (0, 1), "nothing is cut");

    let mut plane = edit(primitives::plane(2.0, 2.0));
    let corners: Vec<VertexId> = plane.face_vertices(FaceId(0)).collect();
    let inside = KnifePoint::Face(FaceId(0), Vec3::ZERO);
    let cut = plane.knife(&[vec![KnifePoint::Vertex(corners[0]), inside, KnifePoint::Vertex(corners[1])]]);
    let cut = cut.expect("a triangle at a side");
    assert_eq!(counts(&plane), [5, 6, 2], "a triangle and a hollow pentagon");
    let mut sizes = [plane.face_size(FaceId(0)), plane.face_size(cut.faces[0])];
    sizes.sort_unstable();
    assert_eq!(sizes, [3, 5], "with the point in both");
    keeps_affine_values(&plane).expect("interpolated");
}

#[test]
fn a_path_that_is_none_is_refused_and_nothing_is_cut() {
    let mut mesh = edit(primitives::grid(2.0, 2.0, 2, 2));
    let before = mesh.clone();
    let edges: Vec<EdgeId> = mesh.face_edges(FaceId(0)).collect();
    let far: Vec<EdgeId> = mesh.face_edges(FaceId(3)).filter(|&edge| mesh.is_boundary(edge)).collect();
    let inside = KnifePoint::Face(FaceId(0), center(&mesh, FaceId(0)));
    let side = |i: usize| KnifePoint::Edge(edges[i], 0.5);
    let outside = KnifePoint::Face(FaceId(0), Vec3::splat(100.0));
    for (path, reason) in [
        (vec![side(0), inside], "divide no face"),
        (vec![side(0), outside, side(1)], "on its border or outside"),
        (vec![side(0), KnifePoint::Edge(far[0], 0.5)], "no face in common"),
    ] {
        let refusal = mesh.knife(&[path]).expect_err(reason);
        assert!(refusal.to_string().contains(reason), "{refusal}");
    }
    let outside = mesh.knife(&[vec![side(0), KnifePoint::Edge(edges[1], 2.0)]]);
    assert!(matches!(outside, Err(Refusal::OutOfRange { .. })), "beyond the edge");
    assert!(mesh == before, "unchanged");
}

/// The sum of the areas of all faces.
fn area(mesh: &EditMesh) -> f64 {
    let of = |face| area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex))).length();
    mesh.faces().map(of).sum()
}

/// A face in the plane of x and z, which looks up.
fn polygon(outline: &[[f32; 2]]) -> EditMesh {
    let mut mesh = EditMesh::new();
    let add = |&[x, z]: &[f32; 2]| mesh.add_vertex(Vec3::new(x, 0.0, z)).expect("room");
    let vertices: Vec<VertexId> = outline.iter().rev().map(add).collect();
    mesh.add_face(&vertices).expect("a polygon");
    edit(mesh.to_mesh().0)
}

fn within(face: u32, [x, z]: [f32; 2]) -> KnifePoint {
    KnifePoint::Face(FaceId(face), Vec3::new(x, 0.0, z))
}

/// Compares all sides of each face: no two touch, but for neighbours at their ends, and the face looks up.
fn check_simple_from_above(mesh: &EditMesh) -> Result<(), String> {
    for face in mesh.faces() {
        let outline: Vec<DVec2> =
            mesh.face_vertices(face).map(|v| mesh.point(v)).map(|p| DVec2::new(p.z, p.x)).collect();
        let count = outline.len();
        let side = |i: usize| (outline[i % count], outline[(i + 1) % count]);
        for i in 0..count {
            for j in i + 1..count {
                let ((a, b), (c, d)) = (side(i), side(j));
                let turns =
                    [(a, b, c), (a, b, d), (c, d, a), (c, d, b)].map(|(a, b, c)| orientation(a, b, c));
                let overlap = a.min(b).cmple(c.max(d)).all() && c.min(d).cmple(a.max(b)).all();
                let apart = [[0, 1], [2, 3]]
                    .iter()
                    .any(|&[i, j]| turns[i] == turns[j] && turns[i] != Orientation::Collinear);
                let is_next = j == i + 1 || (i == 0 && j == count - 1);
                let on_line = turns == [Orientation::Collinear; 4];
                // Neighbours on a line overlap only if they run back.
                let runs_back = is_next && on_line && (b - a).dot(d - c) <= 0.0;
                if overlap && !apart && (!is_next || runs_back) {
                    return Err(format!("{face}: sides {i} and {j} meet: {outline:?}"));
                }
            }
        }
        let doubled: f64 =
            (1..count - 1).map(|i| (outline[i] - outline[0]).perp_dot(outline[i + 1] - outline[0])).sum();
        if doubled <= 0.0 {
            return Err(format!("{face} is turned over: {outline:?}"));
        }
    }
    Ok(())
}

#[test]
fn a_window_within_a_face_is_cut_out_and_the_ring_around_it_is_two_faces() {
    let mut mesh = polygon(&[[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]);
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let cut = mesh.knife(&[corners.map(|at| within(0, at)).to_vec()]).expect("it closes");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (4, 2, 0), "the window and a half of the ring");
    assert_eq!(counts(&mesh), [8, 4 + 4 + 2, 3], "joined by two edges");
    check_simple_from_above(&mesh).expect("polygons");
    keeps_affine_values(&mesh).expect("interpolated");
    let mut areas: Vec<f64> = mesh
        .faces()
        .map(|face| area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex))).length())
        .collect();
    areas.sort_by(f64::total_cmp);
    assert!((areas[1] - 4.0).abs() < 1e-5, "the window, between the parts of the ring: {areas:?}");
    assert!((areas.iter().sum::<f64>() - 16.0).abs() < 1e-5, "{areas:?}");
    // The new edges are as short as can be: from corner to corner, √2 each.
    let lengths =
        mesh.edges().filter(|edge| !cut.edges.contains(edge) && !mesh.is_boundary(*edge)).map(|edge| {
            let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.point(vertex));
            a.distance(b)
        });
    let lengths: Vec<f64> = lengths.collect();
    assert!(lengths.len() == 2 && lengths.iter().all(|l| (l - 2.0_f64.sqrt()).abs() < 1e-5), "{lengths:?}");
}

/// The half behind the edge was lost without a word.
#[test]
fn both_halves_of_a_closed_cut_across_an_edge_are_cut() {
    let mut mesh = edit(primitives::grid(2.0, 1.0, 2, 1));
    let whole = area(&mesh);
    let middle = mesh.edges().find(|&edge| !mesh.is_boundary(edge)).expect("one");
    let [left, right] = [-0.5_f32, 0.5].map(|x| {
        let face = mesh.faces().find(|&face| center(&mesh, face).x * x > 0.0).expect("both");
        KnifePoint::Face(face, Vec3::new(x, 0.0, 0.0))
    });
    let [near, far] = [0.25, 0.75].map(|share| KnifePoint::Edge(middle, share));
    let cut = mesh.knife(&[vec![left, near, right, far, left]]).expect("it closes");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (4, 2, 0), "a triangle in each face");
    assert_eq!(counts(&mesh), [6 + 4, 7 + 2 + 4, 4], "nothing needs to be joined");
    check_simple_from_above(&mesh).expect("polygons");
    assert!((area(&mesh) - whole).abs() < 1e-5, "of the same area");
}

#[test]
fn pieces_that_end_within_a_face_are_left_out_and_counted() {
    let mut mesh = polygon(&[[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]);
    let edges: Vec<EdgeId> = mesh.face_edges(FaceId(0)).collect();
    let [a, b] = [0, 2].map(|number| KnifePoint::Edge(edges[number], 0.5));
    // Across, and back to the middle, and to a point beside the cut.
    let cut = mesh
        .knife(&[vec![a, b, within(0, [1.0, 0.1]), within(0, [1.0, -0.2])]])
        .expect("the first line cuts");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (1, 1, 1), "one piece of two lines is loose");
    assert!(
        cut.vertices[..2].iter().all(Option::is_some) && cut.vertices[2..] == [None, None],
        "no vertices"
    );
    assert_eq!(counts(&mesh), [6, 7, 2], "nothing of it is there");
    // A line that ends in a closed cut's corner, and one that crosses it.
    let mut mesh = polygon(&[[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]);
    let edges: Vec<EdgeId> = mesh.face_edges(FaceId(0)).collect();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.5, 0.0]];
    let path: Vec<KnifePoint> =
        [KnifePoint::Edge(edges[0], 0.5)].into_iter().chain(corners.map(|at| within(0, at))).collect();
    let cut = mesh.knife(&[path]).expect("it closes");
    assert_eq!((cut.uncut, cut.faces.len()), (1, 3), "beyond the side that it crosses it is loose");
    check_simple_from_above(&mesh).expect("polygons");
    assert_eq!(counts(&mesh)[0], 4 + 1 + 3 + 1, "a vertex at the crossing");
}

#[test]
fn a_line_outside_a_hollow_face_cuts_nothing() {
    // A U: its tips are at the top.
    let mut mesh = polygon(&[
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ]);
    let at = |x: f32, z: f32| {
        let vertex = mesh.vertices().find(|&vertex| mesh.position(vertex) == Vec3::new(x, 0.0, z));
        KnifePoint::Vertex(vertex.expect("a corner"))
    };
    let [left, right, low, bottom] = [at(1.0, 2.0), at(2.0, 2.0), at(2.0, 1.0), at(0.0, 0.0)];
    let before = mesh.clone();
    let refusal = mesh.knife(&[vec![left, right]]).expect_err("over the gap");
    assert!(refusal.to_string().contains("divide no face") && mesh == before, "{refusal}");
    let cut = mesh.knife(&[vec![right, left, bottom, low]]).expect("two lines inside");
    assert_eq!((cut.uncut, cut.edges.len()), (1, 2), "and one outside");
    check_simple_from_above(&mesh).expect("polygons");
}

#[test]
fn strokes_that_cross_meet_in_a_vertex_and_loose_ones_that_meet_divide() {
    let square = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let mut mesh = polygon(&square);
    let edges: Vec<EdgeId> = mesh.face_edges(FaceId(0)).collect();
    let side = |i: usize| KnifePoint::Edge(edges[i], 0.5);
    let cut = mesh.knife(&[vec![side(0), side(2)], vec![side(1), side(3)]]).expect("a cross");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (4, 3, 0), "four squares");
    assert_eq!(counts(&mesh), [4 + 4 + 1, 4 + 4 + 4, 4], "with a vertex in the middle");
    assert!(mesh.vertices().any(|vertex| mesh.position(vertex) == Vec3::ZERO), "there");
    keeps_affine_values(&mesh).expect("interpolated");
    // Each ends within the face, but in the same point.
    let mut mesh = polygon(&square);
    let inside = within(0, [0.5, 0.25]);
    let cut = mesh.knife(&[vec![side(0), inside], vec![side(1), inside]]).expect("both together");
    assert_eq!((cut.edges.len(), cut.faces.len(), cut.uncut), (2, 1, 0), "a corner is cut off");
    let refusal = mesh.knife(&[vec![side(0)]]).expect_err("a point is no stroke");
    assert!(refusal.to_string().contains("two points"), "{refusal}");
}

/// A star-shaped polygon around the origin: radii at equal angles.
fn star(radii: &[f32]) -> Vec<[f32; 2]> {
    let step = std::f64::consts::TAU / radii.len() as f64;
    let at = |(i, &radius): (usize, &f32)| {
        let (sin, cos) = sin_cos(step * i as f64);
        [radius * cos as f32, radius * sin as f32]
    };
    radii.iter().enumerate().map(at).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Closed polygons, crossing themselves or not, in hollow faces: the parts are simple, they cover the face, and
    /// the surface is still a disc.
    #[test]
    fn any_closed_cut_within_a_face_leaves_simple_parts_of_its_area(
        radii in prop::collection::vec(1.5f32..3.0, 5..10),
        points in prop::collection::vec(prop::array::uniform2(-0.8f32..0.8), 3..9),
    ) {
        let mut mesh = polygon(&star(&radii));
        let (before, whole) = (mesh.clone(), area(&mesh));
        let path: Vec<KnifePoint> = points.iter().chain(&points[..1]).map(|&at| within(0, at)).collect();
        let (cut, mut difference) = mesh.transaction(|mesh| mesh.knife(&[path])).expect("it is inside and closed");
        prop_assert_eq!(mesh.check_structure(), Ok(()));
        prop_assert_eq!(check_simple_from_above(&mesh), Ok(()));
        prop_assert_eq!(cut.uncut, 0);
        prop_assert!(cut.vertices.iter().all(Option::is_some));
        prop_assert_eq!(mesh.vertex_count() + mesh.face_count() - mesh.edge_count(), 1, "a disc");
        // Positions are rounded once: by at most 2⁻²⁴ of 3 m, along at most 40 sides of at most 6 m.
        prop_assert!((area(&mesh) - whole).abs() < 1e-4, "{} was {}", area(&mesh), whole);
        prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
        difference.apply(&mut mesh);
        prop_assert!(mesh == before, "undone");
    }

    /// Straight strokes all across a convex face make as many parts as there are strokes and crossings, and one: each
    /// crossing is found by its determinants.
    #[test]
    fn strokes_all_across_a_face_divide_it_as_an_arrangement_of_lines(
        ends in prop::collection::vec([0..6usize, 0..6usize], 1..6),
        shares in prop::collection::vec(prop::array::uniform2(0.1f64..0.9), 6),
    ) {
        let mut mesh = polygon(&star(&[2.0; 6]));
        let (whole, edges) = (area(&mesh), mesh.face_edges(FaceId(0)).collect::<Vec<_>>());
        let mut strokes: Vec<[KnifePoint; 2]> = Vec::new();
        for (&[from, to], &[first, second]) in ends.iter().zip(&shares).filter(|([from, to], _)| from != to) {
            strokes.push([KnifePoint::Edge(edges[from], first), KnifePoint::Edge(edges[to], second)]);
        }
        prop_assume!(!strokes.is_empty());
        let flat = |point: KnifePoint| { let at = mesh.knife_position(point); DVec2::new(at.z, at.x) };
        let lines: Vec<[DVec2; 2]> = strokes.iter().map(|stroke| stroke.map(flat)).collect();
        let turns = |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| {
            [c, d].map(|at| (b - a).perp_dot(at - a))
        };
        let mut crossings = 0;
        for (i, &one) in lines.iter().enumerate() {
            for &other in &lines[..i] {
                let all = [turns(one, other), turns(other, one)];
                // No two in one point, and no three.
                prop_assume!(all.iter().flatten().all(|turn| turn.abs() > 1e-3));
                crossings += usize::from(all.iter().all(|[a, b]| a * b < 0.0));
            }
        }
        let cut = mesh.knife(&strokes.iter().map(|stroke| stroke.to_vec()).collect::<Vec<_>>()).expect("across");
        prop_assert_eq!((mesh.face_count(), cut.uncut), (1 + lines.len() + crossings, 0));
        prop_assert_eq!(check_simple_from_above(&mesh), Ok(()));
        prop_assert!((area(&mesh) - whole).abs() < 1e-4, "{} was {}", area(&mesh), whole);
    }

    /// A star-shaped cut: what is inside has its area, and is one face.
    #[test]
    fn what_a_closed_cut_encloses_is_one_face(
        radii in prop::collection::vec(1.5f32..3.0, 5..10), inner in prop::collection::vec(0.2f32..0.9, 3..9),
    ) {
        let mut mesh = polygon(&star(&radii));
        let cut_out = star(&inner);
        let path: Vec<KnifePoint> = cut_out.iter().chain(&cut_out[..1]).map(|&at| within(0, at)).collect();
        let cut = mesh.knife(&[path]).expect("closed");
        prop_assert_eq!((cut.edges.len(), mesh.face_count()), (inner.len(), 3), "with two parts of the ring");
        let vertices: Vec<VertexId> = cut.vertices[1..].iter().copied().map(|v| v.expect("all")).collect();
        let enclosed = mesh.face_over(&vertices, |_| false);
        prop_assert!(enclosed.is_some_and(|face| mesh.face_size(face) == inner.len()));
        prop_assert_eq!(check_simple_from_above(&mesh), Ok(()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// A walk from face to face across their edges, now and then through a point within.
    #[test]
    fn cuts_keep_structure_and_affine_values_and_can_be_undone(
        start in meshes(),
        face in any::<u32>(),
        steps in prop::collection::vec((any::<u32>(), 0.0f64..=1.0, any::<bool>()), 1..8),
    ) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        let before = mesh.clone();
        let mut face = FaceId(face % mesh.face_capacity().max(1) as u32);
        prop_assume!(mesh.has_face(face));
        let mut path = Vec::new();
        for (choice, t, is_inside) in steps {
            let edges: Vec<EdgeId> = mesh.face_edges(face).collect();
            let edge = edges[choice as usize % edges.len()];
            if is_inside && !path.is_empty() {
                path.push(KnifePoint::Face(face, center(&mesh, face)));
            }
            path.push(KnifePoint::Edge(edge, t));
            let faces: Vec<FaceId> = mesh.edge_faces(edge).collect();
            face = faces[choice as usize / 7 % faces.len()];
        }
        let count = path.len();
        if let Ok((cut, mut difference)) = mesh.transaction(|mesh| mesh.knife(&[path])) {
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            prop_assert_eq!(cut.vertices.len(), count);
            prop_assert_eq!(mesh.face_count(), before.face_count() + cut.faces.len());
            prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
            difference.apply(&mut mesh);
        }
        prop_assert!(mesh == before, "undone, or refused");
    }
}
