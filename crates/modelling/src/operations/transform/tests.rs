//! Places in closed form, and what holds for every movement of every mesh.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

use proptest::prelude::*;
use trigon_math::{DAffine3, DMat3, DVec3, Vec3};
use trigon_mesh::{Mesh, primitives};

use super::kind::Prepared;
use super::*;
use crate::tests::meshes;
use crate::{EditMesh, MirrorModifier, Refusal, StackedModifier, VertexId};

fn editable(mesh: &Mesh) -> EditMesh {
    EditMesh::from_mesh(mesh).0
}

fn all(mesh: &EditMesh) -> Vec<VertexId> {
    mesh.vertices().collect()
}

/// A cube of 2 m, moved as a whole; where its first corner, at −1, −1, −1, went.
fn moved_cube(transform: Transform) -> Vec3 {
    let mut cube = editable(&primitives::cube(2.0));
    let vertices = all(&cube);
    let corner = vertices.iter().copied().find(|&vertex| cube.position(vertex) == Vec3::NEG_ONE);
    cube.transform_vertices(&vertices, &transform, None).expect("it is possible");
    cube.check_structure().expect("whole");
    cube.position(corner.expect("a cube has this corner"))
}

#[test]
fn a_mirror_modifier_with_clipping_holds_vertices_on_its_plane() {
    let (mut grid, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 2, 2));
    let mirror = MirrorModifier { clip: true, ..MirrorModifier::default() };
    grid.set_modifiers(vec![StackedModifier::new(mirror)]).expect("in range");
    let xs = |mesh: &EditMesh| {
        let mut xs: Vec<f32> = mesh.vertices().map(|vertex| mesh.position(vertex).x).collect();
        xs.sort_by(f32::total_cmp);
        xs
    };
    let vertices: Vec<VertexId> = grid.vertices().collect();
    let offset = DVec3::new(-0.25, 0.5, 0.0);
    let step = Transform::Translate { offset };
    grid.transform_vertices(&vertices, &step, None).expect("finite");
    assert_eq!(xs(&grid), [-1.25, -1.25, -1.25, 0.0, 0.0, 0.0, 0.75, 0.75, 0.75], "the middle stays");
    grid.transform_vertices(&vertices, &Transform::Translate { offset: DVec3::X * -2.0 }, None)
        .expect("finite");
    assert_eq!(xs(&grid), [-3.25, -3.25, -3.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], "nothing crosses it");
}

#[test]
fn each_transform_moves_the_corner_of_a_cube_where_it_should() {
    let center = DVec3::ZERO;
    let offset = DVec3::new(1.0, 2.0, 3.0);
    assert_eq!(moved_cube(Transform::Translate { offset }), Vec3::new(0.0, 1.0, 2.0), "translated");
    let turned = moved_cube(Transform::Rotate {
        center,
        axis: DVec3::Z * 7.0,
        angle: FRAC_PI_2,
        orientation: DMat3::IDENTITY,
    });
    assert_eq!(turned, Vec3::new(1.0, -1.0, -1.0), "from −x, −y towards x");
    let factors = DVec3::new(2.0, -1.0, 0.5);
    let scaled = moved_cube(Transform::Scale { center, factors, orientation: DMat3::IDENTITY });
    assert_eq!(scaled, Vec3::new(-2.0, 1.0, -0.5), "along the axes");
    let (normal, direction) = (DVec3::Y * 3.0, DVec3::X);
    let sheared = moved_cube(Transform::Shear { center, normal, direction, factor: 0.5 });
    assert_eq!(sheared, Vec3::new(-1.5, -1.0, -1.0), "one metre below the plane");
    let round = moved_cube(Transform::ToSphere { center: DVec3::Y, factor: 1.0 });
    // Four corners at √2, four at √6.
    let radius = (SQRT_2 + 6.0f64.sqrt()) / 2.0;
    let distance = round.as_dvec3().distance(DVec3::Y);
    assert!((distance - radius).abs() < 1e-6, "{distance} for {radius}, rounded to f32");
    let fat = moved_cube(Transform::AlongNormals { distance: 3.0f64.sqrt() });
    // Normals are weighted by angles that are within 2·10⁻⁸.
    assert!(fat.abs_diff_eq(Vec3::splat(-2.0), 1e-6), "{fat}");
    let pushed = moved_cube(Transform::PushPull { center, distance: -(3.0f64.sqrt()) });
    assert!(pushed.abs_diff_eq(Vec3::ZERO, 1e-7), "{pushed} is at the centre");
}

#[test]
fn scaling_along_a_diagonal_stretches_only_that() {
    let turn = DMat3::from_cols(DVec3::new(1.0, 1.0, 0.0), DVec3::new(-1.0, 1.0, 0.0), DVec3::Z * SQRT_2);
    let orientation = turn * SQRT_2.recip();
    let factors = DVec3::new(3.0, 1.0, 1.0);
    let corner = moved_cube(Transform::Scale { center: DVec3::ZERO, factors, orientation });
    assert!(corner.abs_diff_eq(Vec3::new(-3.0, -3.0, -1.0), 1e-6), "{corner}");
}

/// In a mesh that is drawn twice as wide, a quarter of a turn takes a metre along y to half a metre along x.
#[test]
fn a_turn_in_an_uneven_space_is_one_as_it_is_drawn() {
    let orientation = DMat3::from_diagonal(DVec3::new(0.5, 1.0, 1.0));
    let turn = |angle| Transform::Rotate { center: DVec3::ZERO, axis: DVec3::NEG_Z, angle, orientation };
    let corner = moved_cube(turn(FRAC_PI_2));
    assert!(corner.abs_diff_eq(Vec3::new(-0.5, 2.0, -1.0), 1e-6), "(-2, -1) drawn goes to (-1, 2): {corner}");
    let (half, whole) = (turn(FRAC_PI_2).prepare(|_| 0.0), turn(FRAC_PI_2 / 2.0).prepare(|_| 0.0));
    let (half, whole) = (half.expect("a turn"), whole.expect("a turn"));
    let place = |prepared: &Prepared, weight| prepared.moved(DVec3::NEG_ONE, weight, DVec3::ZERO);
    assert!(place(&half, 0.5).abs_diff_eq(place(&whole, 1.0), 1e-15), "a part of a turn is a smaller turn");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let mut cube = editable(&primitives::cube(2.0));
    let before = cube.clone();
    let vertices = all(&cube);
    let mut refused = |transform| {
        cube.transform_vertices(&vertices, &transform, None).expect_err("it makes no sense").to_string()
    };
    let center = DVec3::ZERO;
    let message =
        refused(Transform::Rotate { center, axis: DVec3::ZERO, angle: 1.0, orientation: DMat3::IDENTITY });
    assert_eq!(message, "rotating is not possible here: the axis is zero or not finite");
    refused(Transform::Translate { offset: DVec3::NAN });
    let orientation = DMat3::from_cols(DVec3::X, DVec3::X, DVec3::Z);
    refused(Transform::Scale { center, factors: DVec3::splat(2.0), orientation });
    refused(Transform::Rotate { center, axis: DVec3::X, angle: 1.0, orientation });
    let falloff = Falloff { radius: 0.0, ..Falloff::default() };
    let refusal = MoveSession::with_falloff(&cube, &vertices, &falloff).expect_err("no radius");
    assert!(matches!(refusal, Refusal::OutOfRange { .. }), "{refusal}");
    assert!(MoveSession::new(&cube, &[]).is_err(), "nothing moves");
    assert!(cube == before, "nothing was done");
}

#[test]
fn falloff_lifts_a_tent_over_a_grid() {
    // Vertices a metre apart, the middle one at the origin.
    let mut grid = editable(&primitives::grid(8.0, 8.0, 8, 8));
    let tip = grid.vertices().find(|&vertex| grid.position(vertex) == Vec3::ZERO).expect("the middle");
    let lift = Transform::Translate { offset: DVec3::Y };
    let falloff = Falloff { shape: FalloffShape::Linear, radius: 4.0, distance: FalloffDistance::Straight };
    grid.transform_vertices(&[tip], &lift, Some(&falloff)).expect("it is possible");
    for vertex in grid.vertices() {
        let place = grid.position(vertex);
        let distance = Vec3::new(place.x, 0.0, place.z).as_dvec3().length();
        assert_eq!(place.y, (1.0 - distance / 4.0).max(0.0) as f32, "at {place}");
    }

    let mut grid = editable(&primitives::grid(8.0, 8.0, 8, 8));
    let falloff = Falloff { distance: FalloffDistance::AlongEdges, ..falloff };
    grid.transform_vertices(&[tip], &lift, Some(&falloff)).expect("it is possible");
    for vertex in grid.vertices() {
        let place = grid.position(vertex);
        let distance = f64::from(place.x.abs() + place.z.abs());
        assert_eq!(place.y, (1.0 - distance / 4.0).max(0.0) as f32, "at {place}");
    }
}

#[test]
fn falloff_along_edges_leaves_what_is_not_connected_and_hidden_vertices_stay() {
    let mut mesh = editable(&primitives::grid(4.0, 1.0, 4, 1));
    let apart = mesh.add_vertex(Vec3::new(-2.0, 0.25, -0.5)).expect("room");
    let first = VertexId::new(0);
    assert!(mesh.position(first).distance(mesh.position(apart)) < 0.3, "they are close");
    let reach = |mesh: &EditMesh, distance| {
        let falloff = Falloff { radius: 10.0, distance, shape: FalloffShape::Constant };
        MoveSession::with_falloff(mesh, &[first], &falloff).expect("it is possible").vertices().len()
    };
    assert_eq!(reach(&mesh, FalloffDistance::Straight), 11, "all");
    assert_eq!(reach(&mesh, FalloffDistance::AlongEdges), 10, "what is connected");
    let [hidden, also] = [1, 2].map(|x| {
        let column = move |mesh: &EditMesh, vertex| mesh.position(vertex).x == -2.0 + x as f32;
        let found: Vec<VertexId> = mesh.vertices().filter(|&vertex| column(&mesh, vertex)).collect();
        found
    });
    for &vertex in &hidden {
        mesh.set_vertex_hidden(vertex, true);
    }
    assert_eq!(reach(&mesh, FalloffDistance::Straight), 9, "the hidden ones stay");
    assert_eq!(reach(&mesh, FalloffDistance::AlongEdges), 2, "nothing goes through what is hidden");
    assert_eq!(also.len(), 2, "a column behind them");
}

#[test]
fn half_a_turn_with_half_a_weight_is_a_quarter() {
    let mut mesh = EditMesh::new();
    let moved = mesh.add_vertex(Vec3::X).expect("room");
    let follows = mesh.add_vertex(Vec3::X * 2.0).expect("room");
    let falloff = Falloff { shape: FalloffShape::Linear, radius: 2.0, ..Falloff::default() };
    let half = Transform::Rotate {
        center: DVec3::ZERO,
        axis: DVec3::Z,
        angle: 2.0 * FRAC_PI_2,
        orientation: DMat3::IDENTITY,
    };
    mesh.transform_vertices(&[moved], &half, Some(&falloff)).expect("it is possible");
    assert!(mesh.position(moved).abs_diff_eq(Vec3::NEG_X, 1e-7), "half");
    assert!(mesh.position(follows).abs_diff_eq(Vec3::Y * 2.0, 1e-7), "a quarter");
}

#[test]
fn given_normals_turn_with_whole_faces_and_make_room_at_others() {
    let mut mesh = primitives::uv_sphere(1.0, 12, 8);
    mesh.smooth_by_angle(3.0);
    assert!(mesh.attributes().corner_normals.is_some(), "given for all corners");
    let mut attributes = mesh.attributes().clone();
    attributes.face_smooth = None;
    mesh.set_attributes(attributes).expect("one value each");
    let start = editable(&mesh);
    let rotation = Transform::Rotate {
        center: DVec3::ONE,
        axis: DVec3::new(1.0, 2.0, 3.0),
        angle: 0.7,
        orientation: DMat3::IDENTITY,
    };

    let mut whole = start.clone();
    whole.transform_vertices(&all(&start), &rotation, None).expect("it is possible");
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    for corner in whole.corners() {
        let normal = |mesh: &EditMesh| mesh.custom_normal(corner).expect("given").as_dvec3();
        // Rounded to f32.
        assert!(normal(&whole).abs_diff_eq(turn * normal(&start), 1e-7), "{corner}");
    }

    let mut part = start.clone();
    let pole = part.vertices().max_by_key(|&vertex| part.vertex_edges(vertex).count()).expect("a pole");
    part.transform_vertices(&[pole], &Transform::Translate { offset: DVec3::Y }, None).expect("possible");
    for face in part.faces() {
        let is_moved = part.face_vertices(face).any(|vertex| vertex == pole);
        let given = part.face_corners(face).filter(|&corner| part.custom_normal(corner).is_some()).count();
        assert_eq!(given, if is_moved { 0 } else { part.face_size(face) }, "{face}");
        assert_eq!(part.is_smooth(face), is_moved, "the given normals showed {face} as smooth");
    }
}

#[test]
fn a_mirroring_scale_turns_given_normals_with_the_inverted_faces() {
    let mut mesh = primitives::cube(2.0);
    mesh.smooth_by_angle(0.1);
    let mut cube = editable(&mesh);
    let factors = DVec3::new(-1.0, 1.0, 1.0);
    let mirror = Transform::Scale { center: DVec3::ZERO, factors, orientation: DMat3::IDENTITY };
    let vertices = all(&cube);
    cube.transform_vertices(&vertices, &mirror, None).expect("it is possible");
    for corner in cube.corners() {
        let normal = cube.custom_normal(corner).expect("given").as_dvec3();
        assert_eq!(
            normal,
            cube.face_normal(cube.corner_face(corner)),
            "as the face, which looks inwards now"
        );
    }
}

#[test]
fn vertices_go_back_to_where_they_were_made() {
    let mut cube = editable(&primitives::cube(2.0));
    let before = cube.clone();
    let vertices = all(&cube);
    let some = &vertices[..3];
    cube.transform_vertices(some, &Transform::Translate { offset: DVec3::X }, None).expect("it is possible");
    assert_eq!(cube.reset_vertices(&vertices), Ok(3), "the others are there");
    assert!(cube == before, "as it was");
    assert!(cube.reset_vertices(&[]).is_err(), "nothing to reset");
}

fn transforms() -> impl Strategy<Value = Transform> {
    let number = || -3.0f64..3.0;
    let vector = move || prop::array::uniform3(number()).prop_map(DVec3::from_array);
    prop_oneof![
        vector().prop_map(|offset| Transform::Translate { offset }),
        (vector(), vector(), number()).prop_map(|(center, axis, angle)| Transform::Rotate {
            center,
            axis,
            angle,
            orientation: DMat3::IDENTITY,
        }),
        (vector(), vector()).prop_map(|(center, factors)| {
            Transform::Scale { center, factors, orientation: DMat3::IDENTITY }
        }),
        (vector(), vector(), vector(), number()).prop_map(|(center, normal, direction, factor)| {
            Transform::Shear { center, normal, direction, factor }
        }),
        (vector(), number()).prop_map(|(center, factor)| Transform::ToSphere { center, factor }),
        number().prop_map(|distance| Transform::AlongNormals { distance }),
        (vector(), number()).prop_map(|(center, distance)| Transform::PushPull { center, distance }),
    ]
}

fn falloffs() -> impl Strategy<Value = Option<Falloff>> {
    use FalloffShape::{Constant, Linear, Root, Sharp, Smooth, Sphere};
    let shapes = prop::sample::select(vec![Smooth, Sphere, Root, Sharp, Linear, Constant]);
    let distances = prop_oneof![Just(FalloffDistance::Straight), Just(FalloffDistance::AlongEdges)];
    let falloff = (shapes, 0.1f64..5.0, distances);
    prop::option::of(falloff.prop_map(|(shape, radius, distance)| Falloff { shape, radius, distance }))
}

proptest! {
    /// Cancelled, a session leaves no trace; confirmed, it is one step, which is the last
    /// transform alone.
    #[test]
    fn a_session_is_one_step_or_none(
        start in meshes(),
        chosen in prop::collection::vec(any::<prop::sample::Index>(), 1..8),
        steps in prop::collection::vec(transforms(), 1..4),
        falloff in falloffs(),
        has_normals in any::<bool>(),
    ) {
        let mut start = start;
        if has_normals {
            start.smooth_by_angle(1.0);
        }
        let mut mesh = editable(&start);
        let ids = all(&mesh);
        let vertices: Vec<VertexId> = chosen.iter().map(|index| *index.get(&ids)).collect();
        // A place that is not a number moves nothing else.
        mesh.set_position(ids[0], Vec3::new(f32::NAN, 0.0, 0.0));
        let before = mesh.clone();
        let bits = |mesh: &EditMesh| -> Vec<_> {
            mesh.vertices().map(|vertex| mesh.position(vertex).to_array().map(f32::to_bits)).collect()
        };
        let begin = |mesh: &EditMesh| match &falloff {
            Some(falloff) => MoveSession::with_falloff(mesh, &vertices, falloff),
            None => MoveSession::new(mesh, &vertices),
        };
        let mut session = begin(&mesh).expect("the vertices exist");
        for step in &steps {
            session.apply(&mut mesh, step).expect("random directions have a length");
        }
        session.cancel(&mut mesh);
        prop_assert_eq!(bits(&mesh), bits(&before));
        // NaN differs from itself: all the rest is compared without it.
        let without = |mesh: &EditMesh| {
            let mut mesh = mesh.clone();
            mesh.set_position(ids[0], Vec3::ZERO);
            mesh
        };
        prop_assert!(without(&mesh) == without(&before), "cancelled");

        let mut session = begin(&mesh).expect("the vertices exist");
        for step in &steps {
            session.apply(&mut mesh, step).expect("as before");
        }
        let mut difference = session.confirm(&mut mesh).expect("as before");
        let confirmed = mesh.clone();
        difference.apply(&mut mesh);
        prop_assert_eq!(bits(&mesh), bits(&before));
        prop_assert!(without(&mesh) == without(&before), "undone");
        let last = steps.last().expect("at least one");
        mesh.transform_vertices(&vertices, last, falloff.as_ref()).expect("as before");
        prop_assert_eq!(bits(&mesh), bits(&confirmed));
        prop_assert!(without(&mesh) == without(&confirmed), "in one step");
        prop_assert_eq!(mesh.check_structure(), Ok(()));
    }

    /// Against the transform that is baked into a whole mesh, with normals.
    #[test]
    fn a_rotated_mesh_is_the_one_that_was_edited(start in meshes(), angle in -7.0f64..7.0) {
        let mut start = start;
        start.smooth_by_angle(1.0);
        let mut mesh = editable(&start);
        let axis = DVec3::new(2.0, -1.0, 0.5).normalize();
        let rotation = Transform::Rotate { center: DVec3::ZERO, axis, angle, orientation: DMat3::IDENTITY };
        let vertices = all(&mesh);
        mesh.transform_vertices(&vertices, &rotation, None).expect("it is possible");
        start.transform(&DAffine3::from_axis_angle(axis, angle));
        let (edited, map) = mesh.to_mesh();
        for (place, expected) in edited.positions().iter().zip(start.positions()) {
            // Both are rounded once, from f64.
            prop_assert!(place.abs_diff_eq(*expected, 1e-6), "{} for {}", place, expected);
        }
        let expected = start.attributes().corner_normals.as_ref().expect("given");
        let normals = edited.attributes().corner_normals.as_ref().expect("given");
        for (normal, corner) in normals.iter().zip(&map.corners) {
            prop_assert!(normal.abs_diff_eq(expected[corner.index() as usize], 1e-6), "{}", corner);
        }
    }
}

#[test]
fn a_session_tells_how_much_each_vertex_follows() {
    let grid = editable(&primitives::grid(4.0, 4.0, 8, 8));
    let middle = all(&grid).into_iter().find(|&v| grid.position(v) == Vec3::ZERO).expect("a vertex there");
    let falloff = Falloff { shape: FalloffShape::Linear, radius: 2.0, ..Falloff::default() };
    let session = MoveSession::with_falloff(&grid, &[middle], &falloff).expect("possible");
    for (place, &vertex) in session.vertices().iter().enumerate() {
        let expected = 1.0 - grid.position(vertex).as_dvec3().length() / 2.0;
        assert!((session.weight(place) - expected).abs() < 1e-12, "{:?}", grid.position(vertex));
    }
    let whole = MoveSession::new(&grid, &[middle]).expect("possible");
    assert_eq!(whole.weight(0), 1.0, "moved wholly");
}

#[test]
fn given_tangents_turn_with_whole_faces() {
    let mut square = primitives::plane(2.0, 2.0);
    let attributes = trigon_mesh::Attributes {
        corner_normals: Some(vec![Vec3::Y; 4]),
        corner_tangents: Some(vec![trigon_math::Vec4::new(1.0, 0.0, 0.0, -1.0); 4]),
        ..square.attributes().clone()
    };
    square.set_attributes(attributes).expect("one for each corner");
    let mut mesh = editable(&square);
    let vertices = all(&mesh);
    // A quarter turn about y takes x to −z.
    let turn = Transform::Rotate {
        center: DVec3::ZERO,
        axis: DVec3::Y,
        angle: FRAC_PI_2,
        orientation: DMat3::IDENTITY,
    };
    mesh.transform_vertices(&vertices, &turn, None).expect("possible");
    let (turned, _) = mesh.to_mesh();
    let tangents = turned.attributes().corner_tangents.as_ref().expect("they stay");
    for tangent in tangents {
        let expected = trigon_math::Vec4::new(0.0, 0.0, -1.0, -1.0);
        assert!(tangent.distance(expected) < 1e-6, "{tangent}, not {expected}");
    }
}
