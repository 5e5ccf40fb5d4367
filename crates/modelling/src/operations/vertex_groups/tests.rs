//! Vertex groups, against distances between all pairs of vertices, values that are affine in position, and bits.

use proptest::prelude::*;
use trigon_math::{DAffine3, DVec3, Vec3};
use trigon_mesh::primitives;

use super::*;
use crate::modifier::{BevelModifier, DecimateSettings, SolidifySettings, StackedModifier, WeldModifier};
use crate::tests::{add_affine_group, affine_weight, check_operation, meshes};
use crate::{BisectSettings, EdgeId, ExtrudeOffset, FaceId, FalloffDistance, FalloffShape};

const SHAPES: [FalloffShape; 6] = [
    FalloffShape::Smooth,
    FalloffShape::Sphere,
    FalloffShape::Root,
    FalloffShape::Sharp,
    FalloffShape::Linear,
    FalloffShape::Constant,
];

/// What is left at a part of the radius, as the curves are drawn in textbooks.
fn curve(shape: FalloffShape, part: f64) -> f64 {
    let x = 1.0 - part;
    match shape {
        _ if x <= 0.0 => 0.0,
        FalloffShape::Smooth => 3.0 * x * x - 2.0 * x * x * x,
        FalloffShape::Sphere => (1.0 - (1.0 - x) * (1.0 - x)).sqrt(),
        FalloffShape::Root => x.sqrt(),
        FalloffShape::Sharp => x * x,
        FalloffShape::Linear => x,
        FalloffShape::Constant => 1.0,
    }
}

/// By index, the distance of each vertex from the nearest of some: between all pairs in a straight line, or over ever more
/// edges until nothing changes.
fn distances(mesh: &EditMesh, from: &[VertexId], distance: FalloffDistance) -> Vec<f64> {
    let at = |vertex: VertexId| mesh.position(vertex).as_dvec3();
    let mut all = vec![f64::INFINITY; mesh.vertex_capacity()];
    from.iter().for_each(|vertex| all[vertex.0 as usize] = 0.0);
    if distance == FalloffDistance::Straight {
        for vertex in mesh.vertices() {
            let nearest = from.iter().map(|&other| at(vertex).distance(at(other)));
            all[vertex.0 as usize] = nearest.fold(f64::INFINITY, f64::min);
        }
        return all;
    }
    let edges: Vec<[VertexId; 2]> = mesh.edges().map(|edge| mesh.edge_vertices(edge)).collect();
    for _ in 0..mesh.vertex_count() {
        for &[a, b] in &edges {
            let length = at(a).distance(at(b));
            for (near, far) in [(a, b), (b, a)] {
                let longer = all[near.0 as usize] + length;
                let is_way = !mesh.is_vertex_hidden(far) && !mesh.is_vertex_hidden(near);
                let known = &mut all[far.0 as usize];
                *known = if is_way && longer < *known { longer } else { *known };
            }
        }
    }
    all
}

fn chosen(mesh: &EditMesh, bits: u64) -> Vec<VertexId> {
    mesh.vertices().filter(|vertex| bits >> (vertex.0 % 64) & 1 != 0).collect()
}

fn weights(mesh: &EditMesh, name: &str) -> Vec<Option<f32>> {
    let group = mesh.vertex_group(name).expect("it is there");
    mesh.vertices().map(|vertex| group.weight(vertex)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_falloff_gives_what_distances_between_all_vertices_give(
        start in meshes(),
        (some, hidden) in (any::<u64>(), any::<u64>()),
        (radius, weight) in (0.3f64..3.0, 0.0f64..=1.0),
        (shape, is_connected, replace) in (0usize..6, any::<bool>(), any::<bool>()),
    ) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        add_affine_group(&mut mesh, "group");
        let [some, hidden] = [chosen(&mesh, some & some >> 7), chosen(&mesh, hidden & hidden >> 9)];
        let given: Vec<VertexId> = some.into_iter().filter(|vertex| !hidden.contains(vertex)).collect();
        mesh.remove_from_vertex_group("group", &chosen(&mesh, !0 >> 32)).expect("half of them");
        hidden.iter().for_each(|&vertex| mesh.set_vertex_hidden(vertex, true));
        let before = mesh.clone();
        let shape = SHAPES[shape];
        let distance = if is_connected { FalloffDistance::AlongEdges } else { FalloffDistance::Straight };
        let assignment =
            GroupAssignment { weight, falloff: Some(Falloff { shape, radius, distance }), replace };
        let done = check_operation(&before, |mesh| mesh.assign_to_vertex_group("group", &given, &assignment));
        let Some((after, changed)) = done.map_err(TestCaseError::fail)? else {
            prop_assert!(given.is_empty(), "nothing is selected");
            return Ok(());
        };
        let far = distances(&before, &given, distance);
        let (was, is) = (weights(&before, "group"), weights(&after, "group"));
        prop_assert_eq!(changed, was.iter().zip(&is).filter(|(was, is)| was != is).count());
        for ((vertex, was), is) in before.vertices().zip(was).zip(is) {
            let far = far[vertex.0 as usize];
            if given.contains(&vertex) {
                prop_assert_eq!(is, Some(weight as f32), "given");
            } else if before.is_vertex_hidden(vertex) {
                prop_assert_eq!(is, was, "hidden");
            } else if (far - radius).abs() > 1e-6 {
                let reached = (far < radius).then(|| weight * curve(shape, far / radius));
                let was = was.map(f64::from);
                let expected = match (was, reached) {
                    (Some(was), Some(reached)) if !replace => Some(was.max(reached)),
                    (was, reached) => reached.or(was),
                };
                let [is, expected] = [is.map_or(-1.0, f64::from), expected.unwrap_or(-1.0)];
                prop_assert!((is - expected).abs() < 1e-6, "{} has {} for {}", vertex, is, expected);
            }
        }
    }

    /// Cuts interpolate weights as they do positions.
    #[test]
    fn what_cuts_faces_leaves_weights_affine(start in meshes(), kind in 0u8..6, bits in any::<u64>()) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        add_affine_group(&mut mesh, "affine");
        let edges: Vec<EdgeId> = mesh.edges().filter(|edge| bits >> (edge.0 % 64) & 1 != 0).collect();
        let faces: Vec<FaceId> = mesh.faces().collect();
        let done = check_operation(&mesh, |mesh| match kind {
            0 => mesh.subdivide(&edges, 2).map(drop),
            1 => mesh.poke_faces(&faces, 0.0).map(drop),
            2 => {
                let plane = [DVec3::new(0.1, 0.2, 0.05), DVec3::new(1.0, 0.5, 0.25)];
                mesh.bisect(&faces, plane[0], plane[1], &BisectSettings::default()).map(drop)
            }
            3 => mesh.triangulate_faces(&faces).map(drop),
            4 => edges.iter().try_for_each(|&edge| mesh.split_edge(edge, 0.375).map(drop)),
            _ => mesh.merge_by_distance(&mesh.vertices().collect::<Vec<_>>(), 0.0).map(drop),
        });
        let Some((after, ())) = done.map_err(TestCaseError::fail)? else { return Ok(()) };
        let group = after.vertex_group("affine").expect("it stays");
        for vertex in after.vertices() {
            let [is, expected] =
                [group.weight(vertex).map_or(-1.0, f64::from), affine_weight(after.position(vertex))];
            prop_assert!((is - expected).abs() < 1e-5, "{} has {} for {}", vertex, is, expected);
        }
    }

    #[test]
    fn groups_are_undone_and_saved(start in meshes(), kind in 0u8..5, bits in any::<u64>()) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        add_affine_group(&mut mesh, "one");
        mesh.add_vertex_group("two").expect("room");
        let some = chosen(&mesh, bits);
        let done = check_operation(&mesh, |mesh| match kind {
            0 => mesh.add_vertex_group("three"),
            1 => mesh.remove_vertex_group("one").and_then(|()| mesh.add_vertex_group("other")),
            2 => mesh.rename_vertex_group("one", "three"),
            3 => mesh.remove_from_vertex_group("one", &some).map(drop),
            _ => mesh.assign_to_vertex_group("two", &some, &GroupAssignment::default()).map(drop),
        });
        let Some((after, ())) = done.map_err(TestCaseError::fail)? else { return Ok(()) };
        let (mesh, map) = after.to_mesh();
        let (again, _) = EditMesh::from_mesh_and_data(&mesh, &after.edit_data(&map)).expect("they fit");
        let names = |mesh: &EditMesh| mesh.vertex_group_names().map(str::to_owned).collect::<Vec<_>>();
        prop_assert_eq!(names(&again), names(&after));
        for name in names(&after) {
            prop_assert_eq!(weights(&again, &name), weights(&after, &name), "to the bit");
        }
    }
}

#[test]
fn names_are_unique_and_there_is_room_for_64() {
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    for number in 0..64 {
        cube.add_vertex_group(&number.to_string()).expect("room");
    }
    let before = cube.clone();
    assert_eq!(cube.add_vertex_group("7"), Err(Refusal::GroupExists("7".into())));
    assert!(cube.add_vertex_group("").is_err() && cube.add_vertex_group("64").is_err(), "64 are the most");
    assert_eq!(cube.rename_vertex_group("7", "8"), Err(Refusal::GroupExists("8".into())));
    assert_eq!(cube.rename_vertex_group("64", "65"), Err(Refusal::NoSuchGroup("64".into())));
    assert!(cube.rename_vertex_group("7", "").is_err() && cube.rename_vertex_group("7", "7").is_ok());
    assert_eq!(cube.remove_vertex_group("64"), Err(Refusal::NoSuchGroup("64".into())));
    let all: Vec<VertexId> = cube.vertices().collect();
    let heavy = GroupAssignment { weight: 1.5, ..GroupAssignment::default() };
    assert!(cube.assign_to_vertex_group("7", &all, &heavy).is_err(), "a weight is at most 1");
    assert!(cube.assign_to_vertex_group("7", &[], &GroupAssignment::default()).is_err(), "nothing given");
    assert!(cube.assign_to_vertex_group("64", &all, &GroupAssignment::default()).is_err(), "no such group");
    let mut other = EditMesh::from_mesh(&primitives::cube(1.0)).0;
    other.add_vertex_group("64").expect("room");
    assert!(cube.join_mesh(&other, &DAffine3::IDENTITY).is_err(), "it would be one too many");
    assert!(cube == before, "a refusal changes nothing");
    cube.remove_vertex_group("7").expect("it is there");
    cube.add_vertex_group("64").expect("there is room again");
    assert_eq!(cube.vertex_layers.len(), 64, "in what the other one left");
    assert_eq!(cube.vertex_group_names().last(), Some("64"), "at the end");
}

#[test]
fn a_group_is_renamed_in_modifiers_and_a_removed_one_is_missed() {
    let (mut grid, _) = EditMesh::from_mesh(&primitives::grid(1.0, 1.0, 1, 1));
    add_affine_group(&mut grid, "top");
    let wall = SolidifySettings { group: "top".into(), ..SolidifySettings::default() };
    let stack = [StackedModifier::new(wall.clone()), StackedModifier::new(WeldModifier::default())];
    grid.set_modifiers(stack.to_vec()).expect("in range");
    let before = grid.clone();
    let (_, mut difference) =
        grid.transaction(|grid| grid.rename_vertex_group("top", "upper")).expect("it is there");
    let renamed = SolidifySettings { group: "upper".into(), ..wall };
    assert_eq!(grid.modifiers()[0].modifier, renamed.into());
    assert!(grid.evaluated(&crate::NoObjects).expect("small").is_some_and(|wall| wall.face_count() == 6));
    difference.apply(&mut grid);
    assert!(grid == before, "undone");
    grid.remove_vertex_group("top").expect("it is there");
    assert!(
        grid.evaluated(&crate::NoObjects).expect("small").is_some_and(|wall| wall.face_count() == 1),
        "left out"
    );
    let refusal = grid.apply_modifier(0, &crate::NoObjects).expect_err("it has no group");
    assert_eq!(refusal, Refusal::NoSuchGroup("top".into()));
}

#[test]
fn operations_carry_groups() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 2, 1));
    mesh.add_vertex_group("left").expect("room");
    let left: Vec<VertexId> = mesh.vertices().filter(|&vertex| mesh.position(vertex).x < -0.5).collect();
    mesh.assign_to_vertex_group("left", &left, &GroupAssignment::default()).expect("two");
    let count = |mesh: &EditMesh| mesh.vertex_group("left").map_or(0, |group| group.vertices().count());
    let faces: Vec<FaceId> = mesh.faces().collect();
    let mut doubled = mesh.clone();
    doubled.duplicate(&[], &[], &faces).expect("room");
    assert_eq!(count(&doubled), 4, "a copy has the same");
    let mut apart = mesh.clone();
    let part = apart.separate(&faces[..1]).expect("a face");
    assert_eq!(count(&apart) + count(&part), 2, "one of the two parts");
    let mut extruded = mesh.clone();
    extruded.extrude_region(&faces, ExtrudeOffset::By(DVec3::Y)).expect("faces");
    assert_eq!(count(&extruded), 4, "those above and those below");
    let mut smooth = mesh.clone();
    smooth.catmull_clark(1).expect("room");
    let group = smooth.vertex_group("left").expect("it stays");
    let mut all: Vec<f32> = group.vertices().map(|(_, weight)| weight).collect();
    all.sort_by(f32::total_cmp);
    assert_eq!(all, [0.5, 0.5, 0.5, 1.0, 1.0, 1.0], "also half way to the others");
    // By name, whatever number it has there.
    let mut joined = EditMesh::from_mesh(&primitives::cube(1.0)).0;
    joined.add_vertex_group("own").expect("room");
    let own: Vec<VertexId> = joined.vertices().collect();
    joined.assign_to_vertex_group("own", &own, &GroupAssignment::default()).expect("eight");
    joined.join_mesh(&mesh, &DAffine3::from_translation(DVec3::X)).expect("room");
    joined.join_mesh(&mesh, &DAffine3::IDENTITY).expect("room");
    joined.check_structure().expect("whole");
    assert_eq!(joined.vertex_group_names().collect::<Vec<_>>(), ["own", "left"]);
    assert_eq!((count(&joined), joined.vertex_group("own").map(|own| own.vertices().count())), (4, Some(8)));
}

#[test]
fn the_thickness_of_a_wall_is_times_the_weight() {
    let (mut grid, _) = EditMesh::from_mesh(&primitives::grid(2.0, 3.0, 4, 3));
    add_affine_group(&mut grid, "thick");
    let faces: Vec<FaceId> = grid.faces().collect();
    for (invert_group, even) in [(false, true), (true, false)] {
        let mut wall = grid.clone();
        let settings = SolidifySettings {
            thickness: 0.5,
            even,
            group: "thick".into(),
            invert_group,
            ..Default::default()
        };
        let made = wall.solidify_faces(&faces, &settings).expect("faces");
        let normal = grid.face_normal(faces[0]);
        for vertex in grid.vertices() {
            let weight = affine_weight(grid.position(vertex));
            let depth = 0.5 * if invert_group { 1.0 - weight } else { weight };
            let expected = grid.position(vertex).as_dvec3() - normal * depth;
            let is_there = |&&copy: &&VertexId| wall.position(copy).as_dvec3().distance(expected) < 1e-6;
            assert_eq!(made.vertices.iter().filter(is_there).count(), 1, "behind {vertex}");
            assert_eq!(wall.position(vertex), grid.position(vertex), "the layer in front stays");
        }
    }
    let missing = SolidifySettings { group: "thin".into(), ..Default::default() };
    let before = grid.clone();
    assert_eq!(grid.solidify_faces(&faces, &missing), Err(Refusal::NoSuchGroup("thin".into())));
    assert!(grid == before, "nothing was done");
}

#[test]
fn a_bevel_is_limited_to_edges_within_a_group() {
    let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    cube.add_vertex_group("top").expect("room");
    let top: Vec<VertexId> = cube.vertices().filter(|&vertex| cube.position(vertex).y > 0.0).collect();
    let volume = |weight: f64, settings: BevelModifier| {
        let mut cube = cube.clone();
        let assignment = GroupAssignment { weight, ..GroupAssignment::default() };
        cube.assign_to_vertex_group("top", &top, &assignment).expect("four");
        cube.set_modifiers(vec![StackedModifier::new(settings)]).expect("in range");
        let result = cube.evaluated(&crate::NoObjects).expect("small");
        result.expect("one is on").volume()
    };
    let bevel = BevelModifier { width: 0.5, group: "top".into(), ..BevelModifier::default() };
    // A frustum of height 1/2 below a square of 1 by 1, on a box.
    let expected = 4.0 * 1.5 + 0.5 / 3.0 * (4.0 + 1.0 + 2.0);
    assert!((volume(0.5, bevel.clone()) - expected).abs() < 1e-6, "the four edges around the top");
    assert!((volume(0.49, bevel.clone()) - 8.0).abs() < 1e-6, "too little weight");
    let inverted = BevelModifier { invert_group: true, ..bevel };
    assert!((volume(1.0, inverted) - expected).abs() < 1e-6, "the four around the bottom");
}

/// A sphere whose upper half is in a group with weight 0, the rest with 1.
fn half_protected() -> EditMesh {
    let (mut sphere, _) = EditMesh::from_mesh(&primitives::icosphere(1.0, 3));
    sphere.add_vertex_group("below").expect("room");
    let below: Vec<VertexId> = sphere.vertices().filter(|&vertex| sphere.position(vertex).y < 0.0).collect();
    sphere.assign_to_vertex_group("below", &below, &GroupAssignment::default()).expect("half");
    sphere
}

#[test]
fn a_group_protects_from_decimation() {
    let sphere = half_protected();
    let faces: Vec<FaceId> = sphere.faces().collect();
    let settings = DecimateSettings { ratio: 0.6, group: "below".into(), ..Default::default() };
    let mut fewer = sphere.clone();
    let made = fewer.decimate(&faces, &settings).expect("faces");
    assert!(!made.is_held && fewer.is_watertight(), "{} are left", fewer.face_count());
    assert_eq!(fewer.face_count(), 768, "three fifths of 1280");
    let is_above = |vertex: &VertexId| sphere.position(*vertex).y >= 0.0;
    for vertex in sphere.vertices().filter(is_above) {
        assert!(fewer.has_vertex(vertex) && fewer.position(vertex) == sphere.position(vertex), "{vertex}");
    }
    for face in sphere.faces().filter(|&face| sphere.face_vertices(face).all(|vertex| is_above(&vertex))) {
        assert!(sphere.face_vertices(face).eq(fewer.face_vertices(face)), "{face}");
    }
    let mut upper = sphere.clone();
    let inverted = DecimateSettings { invert_group: true, ..settings.clone() };
    upper.decimate(&faces, &inverted).expect("faces");
    let is_below = |vertex: &VertexId| !is_above(vertex);
    let mut lower = sphere.vertices().filter(is_below);
    assert!(
        lower.all(|vertex| upper.has_vertex(vertex) && upper.position(vertex) == sphere.position(vertex))
    );
    let refused = fewer.decimate(&faces[..1], &DecimateSettings { group: "none".into(), ..settings });
    assert_eq!(refused, Err(Refusal::NoSuchGroup("none".into())));
}

#[test]
fn a_group_of_all_with_full_weight_limits_nothing() {
    let (mut sphere, _) = EditMesh::from_mesh(&primitives::icosphere(1.0, 2));
    let all: Vec<VertexId> = sphere.vertices().collect();
    sphere.add_vertex_group("all").expect("room");
    sphere.assign_to_vertex_group("all", &all, &GroupAssignment::default()).expect("all");
    let faces: Vec<FaceId> = sphere.faces().collect();
    let [mut with, mut without] = [sphere.clone(), sphere];
    with.decimate(&faces, &DecimateSettings { group: "all".into(), ..Default::default() }).expect("faces");
    without.decimate(&faces, &DecimateSettings::default()).expect("faces");
    assert!(with == without, "to the byte");
    let faces: Vec<FaceId> = with.faces().collect();
    with.solidify_faces(&faces, &SolidifySettings { group: "all".into(), ..Default::default() })
        .expect("faces");
    without.solidify_faces(&faces, &SolidifySettings::default()).expect("faces");
    assert!(with == without, "to the byte");
}

#[test]
fn an_error_counts_as_divided_by_the_weight() {
    let half = |weight: f64| {
        let (mut sphere, _) = EditMesh::from_mesh(&primitives::icosphere(1.0, 2));
        let all: Vec<VertexId> = sphere.vertices().collect();
        sphere.add_vertex_group("all").expect("room");
        let assignment = GroupAssignment { weight, ..GroupAssignment::default() };
        sphere.assign_to_vertex_group("all", &all, &assignment).expect("all");
        sphere
    };
    let settings = |error: f64| DecimateSettings {
        goal: crate::DecimateGoal::Error,
        error,
        group: "all".into(),
        ..Default::default()
    };
    let [mut whole, mut weighted] = [half(1.0), half(0.5)];
    let faces: Vec<FaceId> = whole.faces().collect();
    let made = whole.decimate(&faces, &settings(0.02)).expect("faces");
    let of_half = weighted.decimate(&faces, &settings(0.04)).expect("faces");
    assert!(made.removed > 0 && made.removed < faces.len() - 20, "{} of {}", made.removed, faces.len());
    assert_eq!(made.faces, of_half.faces, "twice the error at half the weight");
    let positions = |mesh: &EditMesh| mesh.vertices().map(|at| mesh.position(at)).collect::<Vec<Vec3>>();
    assert_eq!(positions(&whole), positions(&weighted), "the same shape");
}
