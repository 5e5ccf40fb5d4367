//! Stitching, against layouts of planes and other turns.

use proptest::prelude::*;
use trigon_math::{SplitMix64, Vec2, elementary};
use trigon_mesh::primitives;

use super::*;
use crate::tests::{check_operation, meshes};

/// A grid of 4 × 4 with its positions as coordinates, in columns that were turned and moved; and those edges between
/// columns that are chosen.
struct Columns {
    mesh: EditMesh,
    edges: Vec<EdgeId>,
    faces: Vec<FaceId>,
}

const WIDTHS: [u32; 3] = [1, 2, 1];

/// The column of a face, from its middle.
fn column(mesh: &EditMesh, face: FaceId) -> usize {
    let middle = mesh.face_vertices(face).map(|vertex| mesh.position(vertex).x).sum::<f32>() / 4.0;
    if middle < -1.0 { 0 } else { 1 + usize::from(middle > 1.0) }
}

fn flat(mesh: &EditMesh, corner: CornerId) -> DVec2 {
    let position = mesh.position(mesh.corner_vertex(corner)).as_dvec3();
    DVec2::new(position.x, position.z) * 0.2 + 0.4
}

fn columns(still: usize, random: &mut SplitMix64) -> Columns {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(4.0, 4.0, 4, 4));
    mesh.add_uv_set(0).expect("room");
    let motions = WIDTHS.map(|_| {
        let (sin, cos) = elementary::sin_cos(random.between(-3.0, 3.0));
        [DVec2::new(cos, sin), DVec2::new(random.between(1.0, 2.0), random.between(1.0, 2.0))]
    });
    for corner in mesh.corners().collect::<Vec<_>>() {
        let column = column(&mesh, mesh.corner_face(corner));
        let uv = flat(&mesh, corner);
        let moved = if column == still { uv } else { times(motions[column][0], uv) + motions[column][1] };
        mesh.set_uv(0, corner, moved.as_vec2());
    }
    let faces: Vec<FaceId> = mesh.faces().collect();
    let is_between = |&edge: &EdgeId| {
        let columns: Vec<usize> = mesh.edge_faces(edge).map(|face| column(&mesh, face)).collect();
        columns.len() == 2 && columns[0] != columns[1]
    };
    let edges: Vec<EdgeId> = mesh.edges().filter(is_between).collect();
    mesh.mark_seams(&edges).expect("eight");
    Columns { mesh, edges, faces }
}

fn error(mesh: &EditMesh) -> f64 {
    let distance = |corner| mesh.uv(0, corner).expect("set").as_dvec2().distance(flat(mesh, corner));
    mesh.corners().map(distance).fold(0.0, f64::max)
}

#[test]
fn two_sides_of_one_island_meet_in_the_middle() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 2, 2));
    mesh.add_uv_set(0).expect("room");
    for corner in mesh.corners().collect::<Vec<_>>() {
        mesh.set_uv(0, corner, flat(&mesh, corner).as_vec2());
    }
    let all = mesh.clone();
    let slit = mesh.edges().find(|&edge| mesh.edge_pair(edge).is_some()).expect("four");
    let pair = mesh.edge_pair(slit).expect("two");
    let is_outer = |corner: &CornerId| mesh.vertex_faces(mesh.corner_vertex(*corner)).count() == 2;
    let ends = pair.into_iter().flat_map(|corner| [corner, mesh.next_corner(corner)]);
    let outer: Vec<CornerId> = ends.filter(is_outer).collect();
    assert_eq!(outer.len(), 2, "the end at the border");
    for (&corner, by) in outer.iter().zip([0.0625, -0.0625]) {
        mesh.set_uv(0, corner, mesh.uv(0, corner).expect("set") + by);
    }
    let stitched = mesh.stitch_uvs(&[slit], &StitchSettings::default()).expect("it is cut");
    assert_eq!((stitched.edges, stitched.islands), (1, 0));
    for corner in mesh.corners() {
        let [now, before] = [&mesh, &all].map(|mesh| mesh.uv(0, corner).expect("set"));
        assert!(now.distance(before) < 1e-6, "where both were: {now} for {before}");
    }
    let refused = mesh.stitch_uvs(&[slit], &StitchSettings::default()).expect_err("nothing is cut");
    assert!(refused.to_string().contains("two sides"), "{refused}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whichever column stays, the layout becomes that of the whole grid, and the one that stays has the same bits.
    #[test]
    fn parts_of_a_plane_come_together(seed in any::<u64>(), active in 0usize..4, at_midpoints in any::<bool>()) {
        // Without an active face the widest one stays.
        let still = if active == 3 { 1 } else { active };
        let Columns { mesh, edges, faces } = columns(still, &mut SplitMix64::new(seed));
        let active = faces.iter().copied().find(|&face| column(&mesh, face) == active);
        let settings = StitchSettings { active, at_midpoints, ..StitchSettings::default() };
        let stitched = check_operation(&mesh, |mesh| mesh.stitch_uvs(&edges, &settings));
        let (after, stitched) = stitched.map_err(TestCaseError::fail)?.expect("two cuts");
        prop_assert_eq!((stitched.edges, stitched.islands), (8, 2));
        // Rounded to f32 at up to 4: 2⁻²² over the quarter of the width that an edge has.
        prop_assert!(error(&after) < 1e-5, "{}", error(&after));
        prop_assert_eq!(after.uv_island(0, faces[0]).len(), 16, "one island");
        prop_assert!(!after.edges().any(|edge| after.is_seam(edge)), "no seams");
        for corner in mesh.corners().filter(|_| !at_midpoints) {
            if column(&mesh, mesh.corner_face(corner)) == still {
                prop_assert_eq!(after.uv(0, corner), mesh.uv(0, corner));
            }
        }
    }

    /// An island of another size comes as close as any turn and offset could bring it.
    #[test]
    fn no_other_turn_is_closer(seed in any::<u64>(), turn in -0.1f64..0.1, offset in prop::array::uniform2(-0.1f64..0.1)) {
        let mut random = SplitMix64::new(seed);
        let Columns { mut mesh, edges, .. } = columns(1, &mut random);
        let first = |edge: &EdgeId| mesh.edge_faces(*edge).any(|face| column(&mesh, face) == 0);
        let edges: Vec<EdgeId> = edges.into_iter().filter(first).collect();
        let own: Vec<CornerId> =
            mesh.corners().filter(|&corner| column(&mesh, mesh.corner_face(corner)) == 0).collect();
        let [wide, high] = [random.between(0.5, 2.0), random.between(0.5, 2.0)];
        mesh.transform_uvs(0, &own, &trigon_math::DAffine2::from_scale(DVec2::new(wide, high))).expect("finite");
        let layout = IslandLayout::new(&mesh, 0);
        let cuts: Vec<Cut> = edges.iter().filter_map(|&edge| layout.cut(&mesh, edge)).collect();
        let order = Order::new(&layout, &cuts, None);
        let [moved] = &order.moves[..] else { panic!("one island comes to the widest") };
        let sum = |points: &dyn Fn(u32) -> DVec2| -> f64 {
            moved.pairs.iter().map(|&[own, other]| points(own).distance_squared(layout.points[other as usize])).sum()
        };
        let mut brought = IslandLayout::new(&mesh, 0);
        brought.bring(moved);
        let least = sum(&|vertex| brought.points[vertex as usize]);
        let (sin, cos) = elementary::sin_cos(turn);
        let other = sum(&|vertex| times(DVec2::new(cos, sin), brought.points[vertex as usize]) + DVec2::from(offset));
        prop_assert!(other >= least - 1e-12, "{} for {}", other, least);
    }

    #[test]
    fn stitching_is_undone(start in meshes(), bits in any::<u64>(), at_midpoints in any::<bool>()) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        mesh.add_uv_set(0).expect("room");
        for corner in mesh.corners().collect::<Vec<_>>() {
            let uv = Vec2::new((corner.0 * 7 % 5) as f32, (corner.0 * 3 % 4) as f32);
            mesh.set_uv(0, corner, uv);
        }
        let edges: Vec<EdgeId> = mesh.edges().filter(|edge| bits >> (edge.0 % 64) & 1 != 0).collect();
        let settings = StitchSettings { at_midpoints, ..StitchSettings::default() };
        let done = check_operation(&mesh, |mesh| mesh.stitch_uvs(&edges, &settings));
        if let Some((after, _)) = done.map_err(TestCaseError::fail)? {
            for &edge in &edges {
                let Some([one, two]) = after.edge_pair(edge) else { continue };
                let winds_alike = after.corner_vertex(one) != after.corner_vertex(two);
                prop_assert!(!winds_alike || after.shares_uvs(0, one, two), "{:?}", edge);
            }
        }
    }
}
