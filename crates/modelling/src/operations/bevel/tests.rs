//! Closed forms of bevels, and properties of bevels of any mesh.

use std::f64::consts::PI;

use proptest::prelude::*;
use trigon_math::{DVec3, Vec2, Vec3};
use trigon_mesh::{Mesh, primitives};

use super::*;
use crate::ids::CornerId;
use crate::tests::{keeps_affine_values, meshes, with_affine_values};

fn settings(width: f64, segments: usize, profile: f64) -> BevelSettings {
    BevelSettings { width, segments, profile, ..BevelSettings::default() }
}

fn edit(mesh: Mesh) -> EditMesh {
    EditMesh::from_mesh(&with_affine_values(mesh)).0
}

fn counts(mesh: &EditMesh) -> [usize; 3] {
    mesh.check_structure().expect("whole");
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

fn all_edges(mesh: &EditMesh) -> Vec<EdgeId> {
    mesh.edges().collect()
}

/// Twice a face's area along its normal (Newell's method).
fn area_vector(mesh: &EditMesh, face: FaceId) -> DVec3 {
    let points: Vec<DVec3> = mesh.face_vertices(face).map(|vertex| mesh.point(vertex)).collect();
    (0..points.len()).map(|i| points[i].cross(points[(i + 1) % points.len()])).sum()
}

/// The volume within a closed mesh: of cones from the origin to each face, about its mean.
fn volume(mesh: &EditMesh) -> f64 {
    let of_face = |face| {
        let points: Vec<DVec3> = mesh.face_vertices(face).map(|vertex| mesh.point(vertex)).collect();
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        mean.dot(area_vector(mesh, face)) / 6.0
    };
    mesh.faces().map(of_face).sum()
}

/// Whether each edge is between two faces that bend outward there, or not at all.
fn check_convex(mesh: &EditMesh) {
    for edge in mesh.edges() {
        let pair = mesh.edge_pair(edge).expect("a closed mesh");
        let [one, other] = pair.map(|corner| area_vector(mesh, mesh.corner_face(corner)).normalize());
        let start = mesh.point(mesh.corner_vertex(pair[0]));
        let way = mesh.point(mesh.corner_vertex(mesh.next_corner(pair[0]))) - start;
        // Positions are f32: normals of faces a hundredth of a metre wide are off by 1e-5.
        let bend = one.cross(other).dot(way.normalize());
        assert!(bend > -1e-4 && one.dot(other) > -1e-4, "{edge} bends by {bend}");
    }
}

/// Vertices in the grid where some bevels meet, and its faces.
fn grid_counts(edges: usize, segments: usize) -> [usize; 2] {
    let half = segments / 2;
    match segments % 2 {
        0 => [edges * half * (half + 1) + 1, edges * half * half],
        _ => [edges * (half + 1) * (half + 1), edges * half * (half + 1) + 1],
    }
}

#[test]
fn a_cube_with_all_edges_beveled_is_closed_convex_and_has_the_counts_of_its_grids() {
    for segments in 1..=7 {
        for profile in [0.5, 0.25, 0.7, 1.0] {
            let mut mesh = edit(primitives::cube(2.0));
            let made = mesh.bevel_edges(&all_edges(&mesh), &settings(0.25, segments, profile));
            let made = made.expect("a cube has twelve edges");
            let [vertices, faces] = grid_counts(3, segments);
            let faces = 6 + 12 * segments + 8 * faces;
            assert_eq!(counts(&mesh), [8 * vertices, 8 * vertices + faces - 2, faces], "genus 0");
            assert_eq!((made.faces.len(), made.vertices.len()), (faces - 6, 8 * vertices), "all are told");
            assert_eq!((made.width, made.left_out), (0.25, BevelLeftOut::default()), "as asked");
            keeps_affine_values(&mesh).expect("each value is interpolated");
            if profile <= 0.7 {
                check_convex(&mesh);
            }
        }
    }
}

#[test]
fn a_round_bevel_of_a_cube_is_symmetric_and_its_corners_are_parts_of_spheres() {
    for segments in [2, 3, 4, 5, 8] {
        let mut mesh = edit(primitives::cube(2.0));
        mesh.bevel_edges(&all_edges(&mesh), &settings(0.25, segments, 0.5)).expect("twelve edges");
        let bits = |position: Vec3| position.to_array().map(|x| (x * 1e6).round() as i64);
        let mut positions: Vec<_> = mesh.vertices().map(|vertex| bits(mesh.position(vertex))).collect();
        positions.sort_unstable();
        // Mirrored, turned about a diagonal, and with two axes exchanged.
        let changes: [fn([i64; 3]) -> [i64; 3]; 3] =
            [|[x, y, z]| [-x, y, z], |[x, y, z]| [y, z, x], |[x, y, z]| [y, x, z]];
        for change in changes {
            let mut changed: Vec<_> = positions.iter().map(|&position| change(position)).collect();
            changed.sort_unstable();
            // One unit of rounding either way.
            for (a, b) in positions.iter().zip(&changed) {
                assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1), "{a:?} and {b:?}");
            }
        }
        for vertex in mesh.vertices() {
            let outside = (mesh.point(vertex).abs() - DVec3::splat(0.75)).max(DVec3::ZERO);
            assert!((outside.length() - 0.25).abs() < 1e-6, "{vertex} is a quarter from the inner cube");
        }
    }
}

#[test]
fn where_more_than_three_bevels_meet_the_grid_is_closed_and_convex() {
    for (solid, corners, edges) in
        [(primitives::octahedron(1.0), 6, 4), (primitives::icosahedron(1.0), 12, 5)]
    {
        for segments in 1..=6 {
            let mut mesh = edit(solid.clone());
            let [_, all, sides] = counts(&mesh);
            mesh.bevel_edges(&all_edges(&mesh), &settings(0.1, segments, 0.5)).expect("all");
            let [vertices, faces] = grid_counts(edges, segments);
            let faces = sides + all * segments + corners * faces;
            let vertices = corners * vertices;
            assert_eq!(
                counts(&mesh),
                [vertices, vertices + faces - 2, faces],
                "{edges} edges, {segments} segments"
            );
            keeps_affine_values(&mesh).expect("interpolated");
            check_convex(&mesh);
        }
    }
}

#[test]
fn volumes_of_beveled_cubes_are_known() {
    let inner = |width: f64| {
        let side = 2.0 - 2.0 * width;
        (side * side * side + 6.0 * width * side * side, side)
    };
    let mut flat = edit(primitives::cube(2.0));
    flat.bevel_edges(&all_edges(&flat), &settings(0.25, 1, 0.5)).expect("twelve edges");
    let (plates, side) = inner(0.25);
    let wanted = plates + 12.0 * 0.03125 * side + 8.0 * 0.015625 / 6.0;
    assert!((volume(&flat) - wanted).abs() < 1e-6, "prisms and tetrahedra: {}", volume(&flat));

    let mut round = edit(primitives::cube(2.0));
    round.bevel_edges(&all_edges(&round), &settings(0.25, 32, 0.5)).expect("twelve edges");
    let wanted = plates + 3.0 * PI * 0.0625 * side + 4.0 / 3.0 * PI * 0.015625;
    // 128 chords round a circle leave out 4e-4 of its area.
    assert!((volume(&round) - wanted).abs() < 1e-3, "cylinders and a sphere: {}", volume(&round));

    let mut kept = edit(primitives::cube(2.0));
    kept.bevel_edges(&all_edges(&kept), &settings(0.25, 4, 1.0)).expect("twelve edges");
    assert!((volume(&kept) - 8.0).abs() < 1e-5, "profile 1 keeps the form: {}", volume(&kept));
}

/// Checks that all edges can be beveled, and that each rim has the width as distance from its edge.
fn check_rims(old: &EditMesh) -> EditMesh {
    let mut mesh = old.clone();
    let width = 0.1;
    let made = mesh.bevel_edges(&all_edges(old), &settings(width, 1, 0.5)).expect("all can be beveled");
    assert_eq!(made.width, width, "there is room");
    for face in old.faces() {
        // Faces keep their ids and corners, so corner by corner.
        for corner in old.face_corners(face) {
            let [a, b] = [corner, old.next_corner(corner)].map(|corner| old.point(old.corner_vertex(corner)));
            let new = mesh.point(mesh.corner_vertex(corner));
            let distance = (b - a).normalize().cross(new - a).length();
            assert!((distance - width).abs() < 1e-6, "{distance} from {corner}'s edge");
        }
    }
    mesh.check_structure().expect("whole");
    keeps_affine_values(&mesh).expect("interpolated");
    mesh
}

#[test]
fn rims_have_the_width_as_distance_from_the_old_edges() {
    for solid in [primitives::tetrahedron(1.0), primitives::dodecahedron(1.0), primitives::cube(2.0)] {
        check_convex(&check_rims(&edit(solid)));
    }
}

#[test]
fn rims_keep_their_distance_in_hollow_corners() {
    // An L, 1 m high, with sides of 2 m and arms 1 m wide: 3 m³.
    let outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]].map(|at| at.map(|x| x as f32));
    let mut builder = trigon_mesh::MeshBuilder::new();
    for z in [0.0, 1.0] {
        for [x, y] in outline {
            builder.push_vertex(Vec3::new(x, y, z));
        }
    }
    builder.push_face(&[5, 4, 3, 2, 1, 0]).expect("the bottom");
    builder.push_face(&[6, 7, 8, 9, 10, 11]).expect("the top");
    for i in 0..6 {
        let next = (i + 1) % 6;
        builder.push_face(&[i, next, next + 6, i + 6]).expect("a side");
    }
    let mesh = edit(builder.build());
    assert!((volume(&mesh) - 3.0).abs() < 1e-12, "as drawn, but for rounding");
    let beveled = check_rims(&mesh);
    let lost = 3.0 - volume(&beveled);
    // 21 m of outer edges lose a prism of 0.005 m², 1 m of hollow edge gains one; at corners prisms meet.
    assert!((0.09..0.1).contains(&lost), "{lost} m³ lost");
}

#[test]
fn rims_run_on_straight_past_vertices_within_an_edge() {
    let mut mesh = edit(primitives::cube(2.0));
    for edge in all_edges(&mesh) {
        mesh.split_edge(edge, 0.5).expect("twelve edges");
    }
    let beveled = check_rims(&mesh);
    // Each strip of the cube's is cut in two; counts else as without the vertices.
    assert_eq!(counts(&beveled), [24 + 24, 48 + 24 + 12, 26 + 12], "genus 0");
}

/// An edge between two faces that no other such edge touches.
fn inner_edge(mesh: &EditMesh) -> EdgeId {
    let inside = |edge: &EdgeId| {
        mesh.edge_vertices(*edge).iter().all(|&vertex| mesh.vertex_edges(vertex).count() == 4)
    };
    mesh.edges().find(inside).expect("the grid is large")
}

#[test]
fn one_edge_ends_on_the_edges_beside_it() {
    for segments in 1..5 {
        let mut cube = edit(primitives::cube(2.0));
        cube.bevel_edges(&[EdgeId(0)], &settings(0.5, segments, 0.5)).expect("an edge");
        let [vertices, faces] = [8 - 2 + 2 * (segments + 1), 6 + segments];
        assert_eq!(counts(&cube), [vertices, vertices + faces - 2, faces], "three edges at each end");
        keeps_affine_values(&cube).expect("interpolated");
        if segments == 1 {
            assert!((volume(&cube) - (8.0 - 0.25)).abs() < 1e-6, "a prism less: {}", volume(&cube));
        }

        // Of four edges at each end, the three others get a vertex each; a polygon lies between.
        let mut grid = edit(primitives::grid(4.0, 4.0, 4, 4));
        let edge = inner_edge(&grid);
        grid.bevel_edges(&[edge], &settings(0.25, segments, 0.5)).expect("an edge");
        let [vertices, faces] = [25 - 2 + 6 + 2 * (segments - 1), 16 + 2 + segments];
        assert_eq!(counts(&grid), [vertices, vertices + faces - 1, faces], "a disc");
        keeps_affine_values(&grid).expect("interpolated");
    }
}

#[test]
fn edges_that_meet_in_pairs_share_a_curve() {
    for segments in 1..5 {
        let mut mesh = edit(primitives::cube(2.0));
        let edges: Vec<EdgeId> = mesh.face_edges(FaceId(0)).collect();
        let made = mesh.bevel_edges(&edges, &settings(0.5, segments, 0.5)).expect("four edges");
        assert_eq!(made.faces.len(), 4 * segments, "four strips and nothing at the corners");
        let vertices = 4 + 4 * (segments + 1);
        assert_eq!(counts(&mesh), [vertices, vertices + 4 + 4 * segments, 6 + 4 * segments], "a ring more");
        check_convex(&mesh);
        keeps_affine_values(&mesh).expect("interpolated");
    }
}

#[test]
fn a_width_that_is_too_large_is_lessened() {
    let mut mesh = edit(primitives::cube(2.0));
    let made = mesh.bevel_edges(&all_edges(&mesh), &settings(5.0, 1, 0.5)).expect("twelve edges");
    assert!((made.width - 1.0).abs() < 1e-12, "rims meet in the middle of faces: {}", made.width);
    counts(&mesh);
    let mut mesh = edit(primitives::cube(2.0));
    let free = BevelSettings { clamp_overlap: false, ..settings(5.0, 1, 0.5) };
    assert_eq!(mesh.bevel_edges(&[EdgeId(0)], &free).expect("an edge").width, 5.0, "as asked");
    let mut mesh = edit(primitives::cube(2.0));
    let made = mesh.bevel_edges(&[EdgeId(0)], &settings(5.0, 1, 0.5)).expect("an edge");
    assert!((made.width - 2.0).abs() < 1e-12, "one edge alone takes all: {}", made.width);
}

#[test]
fn what_cannot_be_beveled_is_left_out_and_counted() {
    let mut grid = edit(primitives::grid(2.0, 2.0, 2, 2));
    let edges: Vec<EdgeId> = all_edges(&grid).into_iter().chain([EdgeId(0)]).collect();
    let made = grid.bevel_edges(&edges, &settings(0.25, 1, 0.5)).expect("four inner edges");
    assert_eq!(made.left_out, BevelLeftOut { borders: 8, ..BevelLeftOut::default() }, "each once");
    // Four strips and a square; the border gets four more vertices.
    assert_eq!(counts(&grid), [4 + 4 * 2 + 4, 4 * 4 + 3 * 4 - 4, 4 + 4 + 1], "a disc");

    let mut mesh = EditMesh::new();
    let v: Vec<VertexId> =
        (0..6).map(|i| mesh.add_vertex(Vec3::new(i as f32, (i * i) as f32, 0.0)).expect("room")).collect();
    for third in [2, 3, 4] {
        mesh.add_face(&[v[0], v[1], v[third]]).expect("a triangle");
    }
    mesh.add_face(&[v[0], v[2], v[5]]).expect("a triangle");
    let before = mesh.clone();
    let beside = mesh.find_edge(v[0], v[2]).expect("between two triangles");
    let folded = mesh.find_edge(v[0], v[1]).expect("of three triangles");
    let refusal = mesh.bevel_edges(&[folded], &settings(0.1, 1, 0.5)).expect_err("three faces");
    assert!(refusal.to_string().contains("more than two faces meet at the edges"), "{refusal}");
    let refusal = mesh.bevel_edges(&[beside], &settings(0.1, 1, 0.5)).expect_err("ends there");
    assert!(refusal.to_string().contains("beside them"), "{refusal}");
    assert_eq!(
        mesh.bevel_edges(&[EdgeId(99)], &settings(0.1, 1, 0.5)),
        Err(Refusal::NoSuchEdge(EdgeId(99))),
        "99"
    );
    for wrong in
        [settings(-1.0, 1, 0.5), settings(f64::NAN, 1, 0.5), settings(0.1, 0, 0.5), settings(0.1, 1, 1.5)]
    {
        let refusal = mesh.bevel_edges(&[beside], &wrong);
        assert!(matches!(refusal, Err(Refusal::OutOfRange { .. })), "{wrong:?}");
    }
    assert!(mesh == before, "unchanged");
}

#[test]
fn a_cube_with_beveled_vertices_is_a_truncated_cube() {
    let vertices = |mesh: &EditMesh| mesh.vertices().collect::<Vec<_>>();
    let mut mesh = edit(primitives::cube(2.0));
    mesh.bevel_vertices(&vertices(&mesh), &settings(0.5, 1, 0.5)).expect("eight vertices");
    assert_eq!(counts(&mesh), [24, 36, 14], "eight triangles and six octagons");
    // A tetrahedron with three right angles is cut off at each corner.
    assert!((volume(&mesh) - (8.0 - 8.0 * 0.125 / 6.0)).abs() < 1e-6, "{}", volume(&mesh));
    keeps_affine_values(&mesh).expect("interpolated");
    for segments in 2..6 {
        let mut mesh = edit(primitives::cube(2.0));
        mesh.bevel_vertices(&vertices(&mesh), &settings(0.5, segments, 0.5)).expect("eight vertices");
        let [inner, faces] = grid_counts(3, segments);
        let faces = 6 + 8 * faces;
        assert_eq!(counts(&mesh), [8 * inner, 8 * inner + faces - 2, faces], "genus 0");
        keeps_affine_values(&mesh).expect("interpolated");
    }
    let mut mesh = edit(primitives::cube(2.0));
    let made = mesh.bevel_vertices(&vertices(&mesh), &settings(5.0, 1, 0.5)).expect("eight vertices");
    assert!((made.width - 1.0).abs() < 1e-12, "half of each edge: {}", made.width);
    let mut plane = edit(primitives::plane(2.0, 2.0));
    plane.bevel_vertices(&vertices(&plane), &settings(0.5, 3, 0.5)).expect("four corners");
    assert_eq!(counts(&plane), [16, 16, 1], "a rounded rectangle");
}

#[test]
fn materials_and_marks_go_to_the_sides_of_a_bevel() {
    let mut mesh = edit(primitives::cube(2.0));
    let edge = EdgeId(0);
    let sides: Vec<FaceId> = mesh.edge_faces(edge).collect();
    mesh.set_material(sides[0], 7);
    mesh.set_material(sides[1], 9);
    mesh.set_sharp(edge, true);
    mesh.set_seam(edge, true);
    mesh.set_crease(edge, 0.5);
    let made = mesh.bevel_edges(&[edge], &settings(0.5, 2, 0.5)).expect("an edge");
    let mut materials: Vec<u32> = made.faces.iter().map(|&face| mesh.material(face)).collect();
    materials.sort_unstable();
    assert_eq!(materials, [7, 9], "each half has its side's");
    let of = |has: &dyn Fn(EdgeId) -> bool| mesh.edges().filter(|&edge| has(edge)).count();
    assert_eq!(of(&|edge| mesh.is_sharp(edge)), 2, "both rims");
    assert_eq!(of(&|edge| mesh.crease(edge) == 0.5), 2, "both rims");
    let seam: Vec<EdgeId> = mesh.edges().filter(|&edge| mesh.is_seam(edge)).collect();
    let [seam] = seam[..] else { panic!("one seam, not {seam:?}") };
    let beside: Vec<u32> = mesh.edge_faces(seam).map(|face| mesh.material(face)).collect();
    assert!(beside == [7, 9] || beside == [9, 7], "in the middle: {beside:?}");
}

#[test]
fn where_images_are_cut_each_side_continues_its_own() {
    // Each face of the cube shows the whole image.
    for segments in 1..5 {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let made = mesh.bevel_edges(&all_edges(&mesh), &settings(0.25, segments, 0.5)).expect("twelve edges");
        for corner in mesh.corners() {
            let uv = mesh.uv(0, corner).expect("a set");
            let inside = uv.cmpge(Vec2::splat(-1e-6)).all() && uv.cmple(Vec2::splat(1.0 + 1e-6)).all();
            assert!(inside, "{corner} shows {uv}, which no face showed");
        }
        // Along at least one rim, the strip's image continues that of the face.
        for &face in &made.faces[..12 * segments] {
            let continues = |corner: CornerId| {
                let other = mesh.radial_next(corner);
                let pairs = [(corner, mesh.next_corner(other)), (mesh.next_corner(corner), other)];
                pairs.iter().all(|&(a, b)| {
                    mesh.uv(0, a).expect("a set").abs_diff_eq(mesh.uv(0, b).expect("a set"), 1e-6)
                })
            };
            assert!(mesh.face_corners(face).any(continues), "{face} with {segments} segments");
        }
    }
}

#[test]
fn a_hub_with_many_beveled_edges_takes_linear_time() {
    // In quadratic time this would not end.
    let mut mesh = EditMesh::new();
    let hub = mesh.add_vertex(Vec3::Y).expect("room");
    let rim: Vec<VertexId> = (0..100_000)
        .map(|i| {
            let (sin, cos) = trigon_math::elementary::sin_cos(f64::from(i) * 2.0 * PI / 1e5);
            mesh.add_vertex(Vec3::new(cos as f32, 0.0, -sin as f32)).expect("room")
        })
        .collect();
    for i in 0..rim.len() {
        mesh.add_face(&[hub, rim[i], rim[(i + 1) % rim.len()]]).expect("a triangle");
    }
    let edges: Vec<EdgeId> = mesh.vertex_edges(hub).collect();
    let made = mesh.bevel_edges(&edges, &settings(1e-7, 2, 0.5)).expect("spokes");
    assert_eq!(made.faces.len(), 2 * 100_000 + 1, "strips and one polygon");
    let mut other = EditMesh::new();
    let hub = other.add_vertex(Vec3::Y).expect("room");
    assert!(other.bevel_vertices(&[hub], &settings(0.1, 1, 0.5)).is_err(), "a vertex alone");
}

/// Euler's characteristic, if each edge is between two faces and each vertex has at least three edges.
fn closed_characteristic(mesh: &EditMesh) -> Option<isize> {
    let is_closed = mesh.edges().all(|edge| mesh.edge_pair(edge).is_some())
        && mesh.vertices().all(|vertex| mesh.vertex_edges(vertex).take(3).count() == 3);
    let [vertices, edges, faces] =
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()].map(|count| count as isize);
    is_closed.then_some(vertices - edges + faces)
}

/// Settings besides width, segments and profile.
fn other_settings() -> impl Strategy<Value = BevelSettings> {
    let width_type = prop::sample::select(vec![
        BevelWidth::Offset,
        BevelWidth::Width,
        BevelWidth::Depth,
        BevelWidth::Percent,
        BevelWidth::Absolute,
    ]);
    let outer = prop::sample::select(vec![OuterMiter::Sharp, OuterMiter::Patch, OuterMiter::Arc]);
    let inner = prop::sample::select(vec![InnerMiter::Sharp, InnerMiter::Arc]);
    (width_type, outer, inner, any::<[bool; 4]>()).prop_map(
        |(width_type, outer_miter, inner_miter, switches)| {
            let [clamp_overlap, mark_sharp, mark_seams, harden_normals] = switches;
            let marks = BevelSettings { mark_sharp, mark_seams, harden_normals, ..BevelSettings::default() };
            BevelSettings { width_type, outer_miter, inner_miter, clamp_overlap, ..marks }
        },
    )
}

/// Numbers that choose elements.
fn some() -> impl Strategy<Value = Vec<u32>> {
    prop_oneof![prop::collection::vec(any::<u32>(), 1..6), Just((0..200).collect())]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn bevels_keep_structure_and_affine_values_and_can_be_undone(
        start in meshes(),
        chosen in some(),
        is_of_edges in any::<bool>(),
        width in 0.0f64..0.5,
        segments in 1usize..5,
        profile in prop_oneof![Just(0.5), Just(0.25), Just(1.0), 0.0f64..=1.0],
        other in other_settings(),
    ) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        let before = mesh.clone();
        let settings = BevelSettings { width, segments, profile, ..other };
        let edges: Vec<EdgeId> =
            chosen.iter().map(|&edge| EdgeId(edge % mesh.edge_capacity().max(1) as u32)).collect();
        let vertices: Vec<VertexId> =
            chosen.iter().map(|&vertex| VertexId(vertex % mesh.vertex_capacity().max(1) as u32)).collect();
        let made = mesh.transaction(|mesh| match is_of_edges {
            true => mesh.bevel_edges(&edges, &settings),
            false => mesh.bevel_vertices(&vertices, &settings),
        });
        match made {
            Ok((made, mut difference)) => {
                prop_assert_eq!(mesh.check_structure(), Ok(()));
                prop_assert!(made.width <= width);
                prop_assert!(made.faces.iter().all(|&face| mesh.has_face(face)));
                prop_assert!(made.vertices.iter().all(|&vertex| mesh.vertex_edges(vertex).next().is_some()));
                prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
                difference.apply(&mut mesh);
            }
            Err(Refusal::NotPossible { .. } | Refusal::NoSuchEdge(_) | Refusal::NothingGiven { .. }) => {}
            Err(refusal) => prop_assert!(false, "{}", refusal),
        }
        prop_assert!(mesh == before, "undone, or refused");
    }

    #[test]
    fn places_that_are_not_numbers_do_no_harm(
        chosen in some(),
        positions in prop::collection::vec((any::<u32>(), prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(f32::MAX), Just(0.0)]), 1..4),
    ) {
        let mut mesh = edit(primitives::torus(2.0, 0.5, 6, 5));
        for (vertex, value) in positions {
            mesh.set_position(VertexId(vertex % 30), Vec3::splat(value));
        }
        let edges: Vec<EdgeId> = chosen.iter().map(|&edge| EdgeId(edge % 60)).collect();
        mesh.bevel_edges(&edges, &settings(0.1, 3, 0.5)).expect("all can be beveled");
        prop_assert_eq!(mesh.check_structure(), Ok(()));
    }

    /// Bevels, loop cuts and slides one after the other: each sees what the others leave, free slots and
    /// polygons included.
    #[test]
    fn operations_in_any_order_keep_the_structure_and_the_genus(
        start in meshes(),
        cut_open in any::<bool>(),
        steps in prop::collection::vec((0u8..4, some(), 1usize..4, 0.0f64..=1.0), 1..5),
    ) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        // Some slots are free.
        if cut_open {
            drop(mesh.delete_only_faces(&[FaceId(0)]));
        }
        let first = mesh.clone();
        let mut differences = Vec::new();
        for (kind, chosen, segments, t) in steps {
            let edges: Vec<EdgeId> = mesh.edges().collect();
            let vertices: Vec<VertexId> = mesh.vertices().collect();
            let pick = |count: usize| chosen.iter().map(move |&i| i as usize % count.max(1));
            let chosen_edges: Vec<EdgeId> =
                pick(edges.len()).filter_map(|i| edges.get(i).copied()).take(40).collect();
            let chosen_vertices: Vec<VertexId> =
                pick(vertices.len()).filter_map(|i| vertices.get(i).copied()).take(40).collect();
            let settings = settings(0.1, segments, t);
            let kept = closed_characteristic(&mesh);
            let done = mesh.transaction(|mesh| match (kind, chosen_edges.first()) {
                (0, _) => mesh.bevel_edges(&chosen_edges, &settings).map(drop),
                (1, _) => mesh.bevel_vertices(&chosen_vertices, &settings).map(drop),
                (2, Some(&edge)) => {
                    let cut = crate::LoopCutSettings { cuts: segments, position: t, ..Default::default() };
                    mesh.loop_cut(edge, &cut).map(drop)
                }
                _ => mesh.slide_edges(&chosen_edges, t).map(drop),
            });
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            if let Ok(((), difference)) = done {
                differences.push(difference);
                if kept.is_some() {
                    prop_assert_eq!(closed_characteristic(&mesh), kept);
                }
            }
        }
        for difference in differences.iter_mut().rev() {
            difference.apply(&mut mesh);
        }
        prop_assert!(mesh == first, "undone");
    }
}

/// Two edges of a cube that meet in a corner: at the corner's third edge both bevels end at the same distance,
/// the width, since all faces are at right angles.
#[test]
fn two_bevels_at_a_corner_meet_on_its_third_edge() {
    for width in [0.25, 0.5] {
        let mut cube = EditMesh::from_mesh(&primitives::cube(2.0)).0;
        let at = |mesh: &EditMesh, position: Vec3| {
            mesh.vertices().find(|&vertex| mesh.position(vertex) == position).expect("a corner")
        };
        let corner = at(&cube, Vec3::ONE);
        let ends = [Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, -1.0, 1.0)].map(|position| at(&cube, position));
        let edges = ends.map(|end| cube.find_edge(corner, end).expect("an edge of the cube"));
        cube.bevel_edges(&edges, &settings(width, 1, 0.5)).expect("it is possible");
        let expected = Vec3::new(1.0, 1.0, 1.0 - width as f32);
        let nearest = cube.vertices().map(|vertex| cube.position(vertex).distance(expected));
        assert!(nearest.fold(f32::INFINITY, f32::min) < 1e-6, "a vertex at {expected}");
    }
}
