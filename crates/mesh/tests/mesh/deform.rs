//! Meshes in a pose, against what the maps do to points, planes and directions.

use trigon_math::glam::Affine3;
use trigon_math::{DAffine3, DVec3, Mat3, Vec2, Vec3, Vec4};
use trigon_mesh::{
    Attributes, Deformed, Deltas, MeshBuilder, MeshError, MorphTarget, RenderMesh, SkinWeights,
};

/// A triangle in the plane z = 0, with tangents along x, that follows joint 1.
fn triangle() -> trigon_mesh::Mesh {
    let mut builder = MeshBuilder::new();
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|position| builder.push_vertex(position));
    builder.push_face(&corners).expect("a face");
    let mut mesh = builder.build();
    let attributes = Attributes {
        corner_normals: Some(vec![Vec3::new(0.6, 0.0, 0.8); 3]),
        corner_tangents: Some(vec![Vec4::new(0.8, 0.0, -0.6, 1.0); 3]),
        uv_sets: vec![vec![Vec2::ZERO; 3]],
        skin: SkinWeights::new(2, vec![1, 0, 1, 0, 1, 0], vec![1.0, 0.0, 1.0, 0.0, 0.5, 0.5]),
        morph_targets: vec![MorphTarget {
            positions: Deltas::new(vec![(2, Vec3::Z)]),
            ..MorphTarget::default()
        }],
        ..Attributes::default()
    };
    mesh.set_attributes(attributes).expect("one of each");
    mesh
}

fn scaled(by: Vec3) -> Affine3 {
    Affine3 { matrix3: Mat3::from_diagonal(by), translation: Vec3::ZERO }
}

#[test]
fn normals_turn_as_planes_and_tangents_as_directions() {
    let mesh = RenderMesh::from_mesh(&triangle());
    let mut posed = Deformed::default();
    mesh.deform(&[], &[Affine3::IDENTITY, scaled(Vec3::new(4.0, 1.0, 1.0))], &mut posed);
    assert_eq!(posed.positions[1], Vec3::new(4.0, 0.0, 0.0), "stretched along x");
    let exact = Vec3::new(0.6 / 4.0, 0.0, 0.8).normalize();
    assert!(posed.normals[0].distance(exact) < 1e-6, "by the inverse transpose: {}", posed.normals[0]);
    let exact = Vec3::new(0.8 * 4.0, 0.0, -0.6).normalize();
    assert!(posed.tangents[0].truncate().distance(exact) < 1e-6, "by the map: {}", posed.tangents[0]);
    let across = posed.normals[0].dot(posed.tangents[0].truncate());
    assert!(across.abs() < 1e-6, "still across each other: {across}");
}

#[test]
fn a_mirror_turns_the_handedness_and_no_normal_inside_out() {
    let mesh = RenderMesh::from_mesh(&triangle());
    let mut posed = Deformed::default();
    mesh.deform(&[], &[Affine3::IDENTITY, scaled(Vec3::new(1.0, -1.0, 1.0))], &mut posed);
    assert_eq!(posed.normals[0], Vec3::new(0.6, 0.0, 0.8), "the mirror plane holds it");
    assert_eq!(posed.tangents[0].w, -1.0, "the bitangent is the other way round");
}

#[test]
fn targets_come_before_joints_and_what_is_missing_does_nothing() {
    let mesh = triangle();
    let doubled = [Affine3::IDENTITY, scaled(Vec3::splat(2.0))];
    assert_eq!(mesh.deformed_positions(&[3.0], &doubled)[2], Vec3::new(0.0, 1.5, 4.5), "half of each joint");
    let rest = mesh.positions().to_vec();
    for weights in [&[][..], &[0.0], &[f32::NAN], &[f32::INFINITY]] {
        assert_eq!(mesh.deformed_positions(weights, &[]), rest, "{weights:?}");
    }
    let one = [scaled(Vec3::splat(2.0))];
    assert_eq!(mesh.deformed_positions(&[], &one)[1], Vec3::X, "joint 1 is not in the palette");
    let flat = [scaled(Vec3::ZERO); 2];
    let mut posed = Deformed::default();
    RenderMesh::from_mesh(&mesh).deform(&[], &flat, &mut posed);
    assert_eq!(posed.normals[0], Vec3::new(0.6, 0.0, 0.8), "as at rest where nothing is left of it");
}

#[test]
fn attributes_of_movement_are_checked_like_all_others() {
    let refused = |attributes: Attributes| {
        let mut mesh = triangle();
        matches!(mesh.set_attributes(attributes), Err(MeshError::AttributeLength { .. }))
    };
    let target = |positions, normals| Attributes {
        morph_targets: vec![MorphTarget { positions, normals, ..MorphTarget::default() }],
        ..Attributes::default()
    };
    let beyond = || Deltas::new(vec![(3, Vec3::X)]);
    assert!(
        refused(Attributes { corner_tangents: Some(vec![Vec4::X; 2]), ..Attributes::default() }),
        "tangents"
    );
    assert!(
        refused(Attributes { skin: SkinWeights::new(1, vec![0], vec![1.0]), ..Attributes::default() }),
        "skin"
    );
    assert!(refused(target(beyond(), Deltas::default())), "a vertex too many");
    assert!(refused(target(Deltas::default(), beyond())), "a corner too many");
}

#[test]
fn corners_that_part_in_a_target_are_not_welded() {
    let mut builder = MeshBuilder::new();
    let corners = [Vec3::ZERO, Vec3::X, Vec3::ONE.with_z(0.0), Vec3::Y].map(|at| builder.push_vertex(at));
    let [a, b, c, d] = corners;
    builder.push_face(&[a, b, c]).expect("a face");
    builder.push_face(&[a, c, d]).expect("a face");
    let mut mesh = builder.build();
    assert_eq!(RenderMesh::from_mesh(&mesh).positions.len(), 4, "the two share an edge");
    let target = MorphTarget { normals: Deltas::new(vec![(3, Vec3::X)]), ..MorphTarget::default() };
    let attributes = Attributes { morph_targets: vec![target], ..Attributes::default() };
    mesh.set_attributes(attributes).expect("it has a corner 3");
    let render = RenderMesh::from_mesh(&mesh);
    assert_eq!(render.positions.len(), 5, "one corner of the second leans away");
    let moved: Vec<u32> = render.morph_targets[0].normals.iter().map(|(vertex, _)| vertex).collect();
    assert_eq!(moved, [3], "the first vertex that the second face shows");
}

#[test]
fn a_transform_takes_tangents_and_targets_along() {
    let mut mesh = triangle();
    let mirror = DAffine3::from_scale(DVec3::new(-2.0, 2.0, 2.0));
    mesh.transform(&mirror);
    let attributes = mesh.attributes();
    let tangents = attributes.corner_tangents.as_ref().expect("it has some");
    assert!(tangents[0].distance(Vec4::new(-0.8, 0.0, -0.6, -1.0)) < 1e-6, "mirrored: {}", tangents[0]);
    let moved: Vec<(u32, Vec3)> = attributes.morph_targets[0].positions.iter().collect();
    assert_eq!(moved, [(2, Vec3::new(0.0, 0.0, 2.0))], "twice as far");
}

/// A square that is folded along its diagonal: both halves lie in one plane at rest,
/// and each has a normal of its own in the pose.
#[test]
fn flat_faces_have_the_normals_of_their_pose() {
    let mut builder = MeshBuilder::new();
    let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    let [a, b, c, d] = corners.map(|position| builder.push_vertex(position));
    builder.push_face(&[a, b, c]).expect("a face");
    builder.push_face(&[a, c, d]).expect("a face");
    let mut mesh = builder.build();
    let target = MorphTarget { positions: Deltas::new(vec![(d, Vec3::Z)]), ..MorphTarget::default() };
    let of_a_kind = |smooth| Attributes {
        morph_targets: vec![target.clone()],
        skin: SkinWeights::new(1, vec![0; 4], vec![1.0; 4]),
        face_smooth: Some(vec![smooth; 2]),
        ..Attributes::default()
    };
    mesh.set_attributes(of_a_kind(false)).expect("one of each");
    let flat = RenderMesh::from_mesh(&mesh);
    assert_eq!(flat.positions.len(), 6, "the halves share no vertex");
    let mut posed = Deformed::default();
    flat.deform(&[1.0], &[], &mut posed);
    // Of (0, 0, 0), (1, 1, 0) and (0, 1, 1).
    let exact = Vec3::new(1.0, -1.0, 1.0).normalize();
    assert_eq!(posed.normals[..3], [Vec3::Z; 3], "the half that stays");
    assert!(posed.normals[3..].iter().all(|normal| normal.distance(exact) < 1e-6), "{:?}", posed.normals);
    flat.deform(&[1.0], &[scaled(Vec3::new(1.0, 1.0, -1.0))], &mut posed);
    let mirrored = Vec3::new(1.0, -1.0, -1.0).normalize();
    assert!(posed.normals[5].distance(mirrored) < 1e-6, "outside stays outside: {:?}", posed.normals);
    flat.deform(&[0.0], &[], &mut posed);
    assert_eq!(posed.normals, flat.normals, "at rest every bit is the mesh's own");

    mesh.set_attributes(of_a_kind(true)).expect("one of each");
    assert_eq!(RenderMesh::from_mesh(&mesh).positions.len(), 4, "smooth faces share theirs");
}
