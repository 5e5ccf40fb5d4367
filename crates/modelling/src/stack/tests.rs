//! Stacks of modifiers: what they make, and where it came from.

use proptest::prelude::*;
use trigon_math::{DVec3, Vec3};
use trigon_mesh::{Mesh, primitives};

use super::*;
use crate::ids::{EdgeId, FaceId, NONE};
use crate::modifier::{
    ArrayModifier, BevelModifier, BeveledEdges, DecimateSettings, MirrorModifier, ScrewModifier,
    SolidifySettings, TriangulateModifier, WeldModifier,
};
use crate::tests::{add_affine_group, meshes};

fn editable(mesh: &Mesh) -> EditMesh {
    EditMesh::from_mesh(mesh).0
}

fn subdivision(levels: u32) -> StackedModifier {
    StackedModifier::new(SubdivisionModifier { levels })
}

fn with(mesh: &Mesh, modifiers: Vec<StackedModifier>) -> EditMesh {
    let mut mesh = editable(mesh);
    mesh.set_modifiers(modifiers).expect("they are in range");
    mesh
}

fn evaluation(mesh: &EditMesh) -> Evaluation {
    let mut evaluation = Evaluation::default();
    evaluation.update(mesh, &NoObjects);
    evaluation
}

fn evaluated(mesh: &EditMesh) -> EditMesh {
    mesh.evaluated(&NoObjects).expect("it is small").expect("a modifier is on")
}

#[test]
fn a_cage_lies_over_the_surface_of_a_cube() {
    let cube = with(&primitives::cube(2.0), vec![subdivision(2)]);
    let (mesh, map) = evaluation(&cube).to_mesh_with_cage(&cube).expect("it is another");
    assert_eq!(
        [mesh.face_count(), mesh.vertex_count()],
        [96, 98 + 8],
        "the surface, and the cage's vertices"
    );
    assert_eq!(mesh.loose_edges().len(), 12, "the edges of the cage");
    let of_cage = || map.vertices.iter().enumerate().filter(|(_, vertex)| cube.has_vertex(**vertex));
    assert_eq!(of_cage().count(), 8, "vertices of the surface are none of the mesh");
    for (number, vertex) in of_cage() {
        assert_eq!(mesh.positions()[number], cube.position(*vertex), "where it is edited");
    }
}

#[test]
fn a_surface_is_what_catmull_clark_makes_and_applying_it_gives_the_same() {
    let mut cube = with(&primitives::cube(2.0), vec![subdivision(3)]);
    cube.set_crease(EdgeId(3), 0.7);
    let surface = evaluated(&cube);
    let mut subdivided = EditMesh { modifiers: Vec::new(), ..cube.clone() };
    subdivided.catmull_clark(3).expect("it has faces");
    assert!(surface == subdivided, "also at the crease");
    cube.apply_modifier(0, &NoObjects).expect("there is one");
    assert!(cube == surface, "and the stack is empty");
    assert!(cube.apply_modifier(0, &NoObjects).is_err(), "once");
}

#[test]
fn stacks_are_undone_and_surfaces_that_are_too_large_are_refused() {
    let mut grid = editable(&primitives::grid(1.0, 1.0, 200, 100));
    let before = grid.clone();
    let refusal = grid.set_modifiers(vec![subdivision(5)]).expect_err("20 million faces");
    assert!(refusal.to_string().contains("`memory`") && grid == before, "the setting: {refusal}");
    let levels = grid.transaction_within(u64::MAX, |grid| grid.set_modifiers(vec![subdivision(5)]));
    let (_, mut difference) = levels.expect("all memory is allowed");
    assert!(difference.changes_modifiers() && !difference.changes_elements() && !difference.is_empty());
    let (was, refused) = (grid.clone(), grid.evaluated(&NoObjects).expect_err("20 million faces"));
    assert!(refused.to_string().contains("fewer levels"), "{refused}");
    assert!(grid.apply_modifier(0, &NoObjects).is_err() && grid == was, "it stays as it was");
    // 20,000 quads are 80,000 corners.
    assert_eq!(evaluation(&grid).states().collect::<Vec<_>>(), [&ModifierState::Fewer(1)]);
    difference.apply(&mut grid);
    assert_eq!(grid.modifiers(), [], "undone");
    assert!(grid.set_modifiers(vec![subdivision(6)]).is_err(), "5 are the most");
}

#[test]
fn a_stack_is_changed_by_index() {
    let mut mesh = editable(&primitives::cube(2.0));
    let names = |mesh: &EditMesh| -> Vec<_> {
        mesh.modifiers().iter().map(|stacked| (stacked.modifier.name(), stacked.is_on)).collect()
    };
    for (index, modifier) in
        [(0, Modifier::from(WeldModifier::default())), (1, MirrorModifier::default().into())]
    {
        mesh.add_modifier(index, StackedModifier::new(modifier)).expect("before the end, or at it");
    }
    mesh.add_modifier(1, subdivision(1)).expect("between");
    mesh.move_modifier(2, 0).expect("both exist");
    mesh.switch_modifier(1, false).expect("it exists");
    assert_eq!(names(&mesh), [("Mirror", true), ("Weld", false), ("Subdivision Surface", true)]);
    mesh.set_modifier(0, ArrayModifier::default().into()).expect("it exists");
    assert_eq!(mesh.remove_modifier(1).map(|removed| removed.is_on), Ok(false));
    assert_eq!(names(&mesh), [("Array", true), ("Subdivision Surface", true)]);
    let was = mesh.clone();
    assert!(mesh.add_modifier(3, subdivision(1)).is_err(), "beyond the end");
    assert!(mesh.move_modifier(0, 2).is_err() && mesh.remove_modifier(2).is_err());
    assert!(mesh.set_modifier(0, ArrayModifier { count: 0, ..ArrayModifier::default() }.into()).is_err());
    assert!(mesh == was, "a refusal changes nothing");
}

/// A cube of 2 m from x = 0 on.
fn beside_the_plane() -> Mesh {
    let mut cube = primitives::cube(2.0);
    cube.transform(&trigon_mesh::math::DAffine3::from_translation(DVec3::X));
    cube
}

#[test]
fn a_mirrored_half_is_a_closed_whole() {
    let mut half = editable(&beside_the_plane());
    let on_plane: Vec<FaceId> = half.faces().filter(|&face| half.face_center(face).x.abs() < 1e-6).collect();
    half.delete_only_faces(&on_plane).expect("one face");
    half.set_modifiers(vec![StackedModifier::new(MirrorModifier::default())]).expect("in range");
    let whole = evaluated(&half);
    assert_eq!((whole.vertex_count(), whole.face_count()), (12, 10), "four vertices are shared");
    assert!(whole.edges().all(|edge| whole.edge_faces(edge).count() == 2), "closed");
    let copies = MirrorModifier { axes: [true; 3], merge_distance: None, ..MirrorModifier::default() };
    let eight = evaluated(&with(&primitives::cube(2.0), vec![StackedModifier::new(copies)]));
    assert_eq!((eight.vertex_count(), eight.face_count()), (64, 48), "nothing is shared");
}

#[test]
fn a_bisected_mesh_is_the_side_that_stays_twice() {
    for (flip, size) in [(false, 3.0), (true, 1.0)] {
        let mut cube = primitives::cube(2.0);
        cube.transform(&trigon_mesh::math::DAffine3::from_translation(DVec3::X * 0.5));
        let mirror = MirrorModifier { bisect: true, flip, ..MirrorModifier::default() };
        let whole = evaluated(&with(&cube, vec![StackedModifier::new(mirror)]));
        let xs = || whole.vertices().map(|vertex| whole.position(vertex).x);
        let widest = xs().fold(f32::MIN, f32::max) - xs().fold(f32::MAX, f32::min);
        assert_eq!(widest, size, "from -0.5 to 1.5 is cut at 0");
    }
}

#[test]
fn mirrored_texture_coordinates_run_backwards() {
    let mut grid = primitives::grid(1.0, 1.0, 1, 1);
    let uvs = (0..grid.corner_count()).map(|corner| trigon_math::Vec2::new(0.1 * corner as f32, 0.25));
    let attributes = trigon_mesh::Attributes { uv_sets: vec![uvs.collect()], ..grid.attributes().clone() };
    grid.set_attributes(attributes).expect("one for each corner");
    let mirror = MirrorModifier { mirror_u: true, ..MirrorModifier::default() };
    let mesh = evaluated(&with(&grid, vec![StackedModifier::new(mirror)])).to_mesh().0;
    let uvs = &mesh.attributes().uv_sets[0];
    let mut sums: Vec<f32> = uvs[4..].iter().map(|uv| uv.x).collect();
    sums.sort_by(f32::total_cmp);
    assert_eq!(sums, [0.7, 0.8, 0.9, 1.0].map(|u: f32| u), "1 - u for each");
    assert!(uvs[4..].iter().all(|uv| uv.y == 0.25), "v stays");
}

#[test]
fn an_array_stands_in_a_row() {
    let offset = ArrayModifier { count: 4, offset: [0.0, 0.5, 0.0], ..ArrayModifier::default() };
    let row = evaluated(&with(&primitives::cube(2.0), vec![StackedModifier::new(offset)]));
    assert_eq!((row.vertex_count(), row.face_count()), (32, 24), "four cubes");
    let highest = row.vertices().map(|vertex| row.position(vertex)).fold(Vec3::MIN, Vec3::max);
    assert_eq!(highest, Vec3::new(1.0 + 3.0 * 2.0, 1.0 + 3.0 * 0.5, 1.0));
    let welded = ArrayModifier { count: 4, merge_distance: Some(1e-3), ..ArrayModifier::default() };
    let bar = evaluated(&with(&primitives::cube(2.0), vec![StackedModifier::new(welded)]));
    assert_eq!(bar.vertex_count(), 20, "four between neighbours are shared");
}

#[test]
fn edges_without_faces_are_shown_before_those_of_the_cage() {
    let line = primitives::polyline(&[Vec3::ZERO, Vec3::X, Vec3::ONE]);
    let line = with(&line, vec![StackedModifier::new(ArrayModifier::default())]);
    let (mesh, map) = evaluation(&line).to_mesh_with_cage(&line).expect("it is another");
    assert_eq!((mesh.loose_edges().len(), mesh.vertex_count()), (4 + 2, 6 + 3), "two lines, and the cage");
    let are_own: Vec<bool> = map.loose_edges.iter().map(|&edge| line.has_edge(edge)).collect();
    assert_eq!(are_own, [false, false, false, false, true, true]);
}

#[test]
fn a_sheet_becomes_a_wall_a_line_a_cylinder_and_a_sphere_coarse() {
    let wall = SolidifySettings { thickness: 0.5, ..SolidifySettings::default() };
    let wall = evaluated(&with(&primitives::grid(2.0, 3.0, 1, 1), vec![StackedModifier::new(wall)]));
    assert!(wall.is_watertight() && (wall.volume() - 3.0).abs() < 1e-6, "{}", wall.volume());
    let line = primitives::polyline(&[Vec3::X, Vec3::X + Vec3::Y]);
    let screw = StackedModifier::new(ScrewModifier::default());
    let tube = evaluated(&with(&line, vec![screw]));
    assert_eq!((tube.vertex_count(), tube.face_count()), (32, 16), "sixteen steps that close");
    let half = StackedModifier::new(DecimateSettings::default());
    assert_eq!(evaluated(&with(&primitives::icosphere(1.0, 2), vec![half])).face_count(), 160, "of 320");
}

#[test]
fn a_bevel_takes_the_edges_that_it_is_told() {
    let faces = |edges, change: fn(&mut EditMesh)| {
        let bevel = BevelModifier { edges, ..BevelModifier::default() };
        let mut cube = with(&primitives::cube(2.0), vec![StackedModifier::new(bevel)]);
        change(&mut cube);
        evaluated(&cube).face_count()
    };
    assert_eq!(
        faces(BeveledEdges::All, |_| {}),
        6 + 12 + 8,
        "a strip for each edge, a triangle for each corner"
    );
    assert_eq!(faces(BeveledEdges::Angle, |_| {}), 6 + 12 + 8, "all are at right angles");
    assert_eq!(faces(BeveledEdges::Sharp, |_| {}), 6, "none is marked");
    assert_eq!(faces(BeveledEdges::Sharp, |cube| cube.set_sharp(EdgeId(2), true)), 7);
    assert_eq!(faces(BeveledEdges::Creased, |cube| cube.set_crease(EdgeId(2), 0.5)), 7);
}

#[test]
fn what_is_refused_or_off_is_left_out() {
    let off = StackedModifier { is_on: false, ..subdivision(1) };
    let far = ArrayModifier { offset: [f64::MAX, 0.0, 0.0], ..ArrayModifier::default() };
    let behind = MirrorModifier { bisect: true, flip: true, ..MirrorModifier::default() };
    let stack = vec![off, StackedModifier::new(far), StackedModifier::new(behind), subdivision(1)];
    let cube = with(&beside_the_plane(), stack);
    let live = evaluation(&cube);
    let states: Vec<_> = live.states().collect();
    assert!(matches!(states[0], ModifierState::Off), "{states:?}");
    assert!(matches!(states[1], ModifierState::Refused(Refusal::Overflow(_))), "{states:?}");
    assert!(matches!(states[2], ModifierState::Refused(Refusal::NotPossible { .. })), "{states:?}");
    assert_eq!(live.to_mesh().map(|mesh| mesh.face_count()), Some(24), "the surface of the cube");
    assert!(matches!(cube.evaluated(&NoObjects), Err(Refusal::Overflow(_))), "no file holds it");
}

#[test]
fn a_view_leaves_out_what_is_dense() {
    let grid = primitives::grid(1.0, 1.0, 300, 300);
    let many = ArrayModifier { count: 2, ..ArrayModifier::default() };
    let mesh = with(&grid, vec![StackedModifier::new(many), StackedModifier::new(WeldModifier::default())]);
    let live = evaluation(&mesh);
    let dense = 2 * 301 * 301;
    assert_eq!(live.states().collect::<Vec<_>>(), [&ModifierState::TooDense(dense), &ModifierState::Shown]);
    assert_eq!(evaluated(&mesh).face_count(), 180_000, "an export has all");
}

/// Parameters of any kind, on or off.
pub(crate) fn stacked() -> impl Strategy<Value = StackedModifier> {
    let distance = || prop::option::of(0.0..0.5f64);
    let any_edges = [BeveledEdges::Angle, BeveledEdges::Sharp, BeveledEdges::Creased, BeveledEdges::All];
    let subdivision = (1u32..3).prop_map(|levels| Modifier::from(SubdivisionModifier { levels }));
    let mirror =
        (any::<[bool; 6]>(), distance()).prop_map(|([x, y, z, bisect, flip, mirror_u], merge_distance)| {
            let axes = [x, y, z];
            MirrorModifier { axes, merge_distance, bisect, flip, mirror_u, ..MirrorModifier::default() }
                .into()
        });
    let offset = || prop::array::uniform3(-2.0..2.0f64);
    let array = (1u32..4, offset(), offset(), distance()).prop_map(
        |(count, offset, relative_offset, merge_distance)| {
            ArrayModifier { count, offset, relative_offset, merge_distance, ..ArrayModifier::default() }
                .into()
        },
    );
    let group = || prop::sample::select(vec![String::new(), "affine".into(), "missing".into()]);
    let bevel = (prop::sample::select(any_edges.to_vec()), 0.0..0.3f64, 1u32..3, any::<bool>(), group())
        .prop_map(|(edges, width, segments, invert_group, group)| {
            BevelModifier { edges, width, segments, group, invert_group, ..BevelModifier::default() }.into()
        });
    let weld = (0.0..1.0f64).prop_map(|distance| WeldModifier { distance }.into());
    let triangulate = (4u32..6).prop_map(|least_corners| TriangulateModifier { least_corners }.into());
    let solidify = (0.0..0.5f64, -1.0..=1.0f64, any::<[bool; 3]>(), group()).prop_map(
        |(thickness, offset, [even, rim, invert_group], group)| {
            SolidifySettings { thickness, offset, even, rim, group, invert_group, ..Default::default() }
                .into()
        },
    );
    let decimate = (0.0..=1.0f64, any::<bool>(), group()).prop_map(|(ratio, invert_group, group)| {
        DecimateSettings { ratio, group, invert_group, ..DecimateSettings::default() }.into()
    });
    let screw =
        (-360.0..360.0f64, 1u32..5, 0.0..1.0f64, 1u32..3).prop_map(|(angle, steps, height, turns)| {
            ScrewModifier { angle, steps, height, turns, ..ScrewModifier::default() }.into()
        });
    let kinds = prop_oneof![subdivision, mirror, array, bevel, weld, triangulate, solidify, decimate, screw];
    (kinds, prop::bool::weighted(0.8)).prop_map(|(modifier, is_on)| StackedModifier { modifier, is_on })
}

/// The mesh whose modifiers are applied one after the other, those that are off removed.
fn applied(mesh: &EditMesh) -> EditMesh {
    let mut mesh = mesh.clone();
    while let Some(first) = mesh.modifiers().first() {
        if !first.is_on || mesh.apply_modifier(0, &NoObjects).is_err() {
            drop(mesh.remove_modifier(0));
        }
    }
    mesh
}

proptest! {
    /// Materials follow faces through each of these, so they show of which face one is a part.
    #[test]
    fn faces_of_a_result_name_the_face_that_they_are_of(
        start in meshes(), removed in any::<u32>(), stack in prop::collection::vec(stacked(), 1..4)
    ) {
        let mut mesh = editable(&start);
        let face = FaceId(removed % mesh.face_capacity().max(1) as u32);
        drop(mesh.remove_face(face));
        for face in mesh.faces().collect::<Vec<_>>() {
            mesh.set_material(face, face.0);
        }
        prop_assume!(mesh.face_count() > 0 && mesh.set_modifiers(stack).is_ok());
        let Some((shown, map)) = evaluation(&mesh).to_mesh_with_cage(&mesh) else { return Ok(()) };
        let none = vec![0; shown.face_count()];
        let materials = shown.attributes().face_materials.as_ref().unwrap_or(&none);
        let origins: Vec<u32> = map.faces.iter().map(|face| face.0).collect();
        // A loose edge that is swept makes faces of no other.
        let has_screw = |stacked: &StackedModifier| matches!(stacked.modifier, Modifier::Screw(_));
        let sweeps = mesh.modifiers().iter().any(has_screw);
        for (origin, material) in origins.iter().zip(materials) {
            prop_assert!(origin == material || sweeps && *origin == NONE, "{origins:?}\n{materials:?}");
        }
        prop_assert!(origins.is_sorted(), "parts of one face follow one another");
    }

    #[test]
    fn a_stack_gives_what_applying_one_after_the_other_does(
        start in meshes(), stack in prop::collection::vec(stacked(), 0..4), other in stacked(), at in any::<prop::sample::Index>()
    ) {
        let mut mesh = editable(&start);
        if mesh.vertex_count().is_multiple_of(2) {
            add_affine_group(&mut mesh, "affine");
        }
        prop_assume!(mesh.set_modifiers(stack).is_ok());
        let mut live = evaluation(&mesh);
        let result = |live: &Evaluation, mesh: &EditMesh| live.to_edit_mesh().unwrap_or_else(|| {
            EditMesh { modifiers: Vec::new(), ..mesh.clone() }
        });
        prop_assert!(result(&live, &mesh) == applied(&mesh));
        prop_assert_eq!(result(&live, &mesh).check_structure(), Ok(()));
        if let Ok(Some(evaluated)) = mesh.evaluated(&NoObjects) {
            prop_assert!(evaluated == applied(&mesh), "as exported");
        }
        // What is retained of the stack before is what would be evaluated anew.
        let at = at.index(mesh.modifiers().len() + 1);
        prop_assume!(mesh.add_modifier(at, other).is_ok());
        live.update(&mesh, &NoObjects);
        prop_assert!(result(&live, &mesh) == applied(&mesh));
    }
}
