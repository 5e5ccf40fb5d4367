//! Random sequences of moves, marks, mirrors, projections and repairs on random meshes, a third of them
//! non-manifold or open.

use proptest::prelude::*;
use trigon_math::{Bounds3, DAffine3, DMat3, DQuat, DVec3, Plane, Vec3};

use super::*;
use crate::modifier::{DecimateSettings, SolidifySettings};
use crate::tests::{add_affine_group, check_undo_and_redo, keeps_affine_values, meshes};
use crate::{BooleanOperation, EdgeId, EditMesh, FaceId, Refusal, VertexId};

/// About half of some elements, as the bits of a number say, repeated.
fn some<T: Copy>(all: impl Iterator<Item = T>, bits: u64) -> Vec<T> {
    all.enumerate().filter(|(i, _)| bits >> (i % 64) & 1 != 0).map(|(_, element)| element).collect()
}

/// The name of the first vertex group; empty without any.
fn first_group(mesh: &EditMesh) -> String {
    mesh.vertex_group_names().next().unwrap_or_default().to_owned()
}

/// The group that limits an operation, half of the time.
fn limit(mesh: &EditMesh, bits: u64) -> String {
    if bits & 8 == 0 { String::new() } else { first_group(mesh) }
}

/// How many kinds of operations there are.
const KINDS: u8 = 52;

/// Does an operation of a kind to the elements that some bits choose, with two parameters within −1…1.
fn step(mesh: &mut EditMesh, kind: u8, bits: u64, a: f64, b: f64) -> Result<(), Refusal> {
    let vertices: Vec<VertexId> = some(mesh.vertices(), bits);
    let edges: Vec<EdgeId> = some(mesh.edges(), bits);
    let faces: Vec<FaceId> = some(mesh.faces(), bits);
    let center = DVec3::new(a, b, 0.5);
    let plane = Plane::from_point_and_normal(center * 0.5, DVec3::new(1.0, b, a)).expect("a direction");
    let falloff = Falloff { radius: 1.0 + a, ..Falloff::default() };
    match kind % KINDS {
        0 => mesh.transform_vertices(&vertices, &Transform::Translate { offset: center }, Some(&falloff)),
        1 => {
            let rotation = Transform::Rotate {
                center,
                axis: DVec3::new(1.0, a, b),
                angle: 3.0 * b,
                orientation: DMat3::IDENTITY,
            };
            mesh.transform_vertices(&vertices, &rotation, None)
        }
        2 => mesh.transform_vertices(&vertices, &Transform::ToSphere { center, factor: b }, None),
        3 => mesh.transform_vertices(&vertices, &Transform::AlongNormals { distance: a }, None),
        4 => mesh.reset_vertices(&vertices).map(drop),
        5 => mesh.mark_sharp(&edges).map(drop),
        6 => mesh.clear_sharp(&edges).map(drop),
        7 => mesh.mark_sharp_by_angle(&edges, a.abs()).map(drop),
        8 => mesh.mark_seams(&edges).map(drop),
        9 => mesh.crease_edges(&edges, b as f32).map(drop),
        10 => mesh.shade_smooth(&faces).map(drop),
        11 => mesh.shade_flat(&faces).map(drop),
        12 => mesh.assign_material(&faces, (bits % 4) as u32).map(drop),
        13 => mesh.flip_faces(&faces),
        14 => mesh.recalculate_normals(&faces).map(drop),
        15 => mesh.mirror(&vertices, &plane),
        16 => mesh.mirror_copy(&faces, &edges, &plane, (a > 0.0).then_some(b.abs())).map(drop),
        17 => mesh.symmetrize(&faces, &plane, b.abs() * 0.1).map(drop),
        18 => mesh.project_uvs_on_box(&faces, 1, &BoxProjection::default()),
        19 => mesh.hide_faces(&faces).map(drop),
        20 => {
            let steps = (bits % 4) as u32;
            let settings = UnwrapSettings { minimize_stretch: steps, ..UnwrapSettings::default() };
            mesh.unwrap_faces(&faces, &settings).map(drop)
        }
        21 => mesh.smart_project_uvs(&faces, &SmartProjection::default()).map(drop),
        22 => {
            mesh.pack_uv_islands(&faces, 0, &PackSettings { rotate: a > 0.0, ..Default::default() }).map(drop)
        }
        23 => mesh.project_uvs_on_cylinder(
            &faces,
            1,
            &CylinderProjection { axis: center, ..Default::default() },
        ),
        24 => mesh.project_uvs_on_sphere(&faces, 1, &SphereProjection { axis: center, ..Default::default() }),
        25 => {
            let settings = SolidifySettings {
                thickness: b.abs(),
                offset: a,
                even: bits.is_multiple_of(2),
                group: limit(mesh, bits),
                ..Default::default()
            };
            mesh.solidify_faces(&faces, &settings).map(drop)
        }
        26 => {
            let group = limit(mesh, bits);
            let settings =
                DecimateSettings { ratio: a.abs(), group, invert_group: b > 0.0, ..Default::default() };
            mesh.decimate(&faces, &settings).map(drop)
        }
        27 => {
            let height = if bits.is_multiple_of(3) { b } else { 0.0 };
            let settings = SpinSettings { angle: 6.0 * a, steps: 3, height, ..Default::default() };
            mesh.spin(&edges, &vertices, &settings).map(drop)
        }
        28 => {
            let [clear_outer, clear_inner, fill] = [1, 4, 2].map(|bit| bits & bit != 0 && b > 0.0);
            let settings = BisectSettings { clear_outer, clear_inner, fill, threshold: 0.0 };
            mesh.bisect(&faces, center * 0.2, plane.normal(), &settings).map(drop)
        }
        29 => mesh.poke_faces(&faces, a).map(drop),
        30 => mesh.convex_hull(&vertices, &HullSettings { replace: a > 0.0 }).map(drop),
        31 => {
            let settings = WireframeSettings { thickness: b.abs(), replace: a > 0.0 };
            mesh.wireframe_faces(&faces, &settings).map(drop)
        }
        32 => {
            let copy = mesh.clone();
            let transform = DAffine3::from_rotation_translation(DQuat::from_rotation_y(b), center);
            let operation =
                [BooleanOperation::Union, BooleanOperation::Difference, BooleanOperation::Intersection]
                    [bits as usize % 3];
            mesh.boolean(&[BooleanTool { mesh: &copy, transform }], operation).map(drop)
        }
        33 => mesh.un_subdivide(&faces).map(drop),
        34 => mesh.pin_uvs(0, &some(mesh.corners(), bits)).map(drop),
        35 => mesh.unpin_uvs(0, &some(mesh.corners(), bits)).map(drop),
        36 => {
            let settings = StitchSettings { at_midpoints: a > 0.0, ..StitchSettings::default() };
            mesh.stitch_uvs(&edges, &settings).map(drop)
        }
        37 => mesh.straighten_uvs(0, &edges).map(drop),
        38 => mesh.average_uv_island_scale(&faces, 0).map(drop),
        39 => mesh.mark_seams_by_angle(&edges, b.abs()).map(drop),
        40 => {
            let parts = |face: FaceId| {
                let corners: Vec<Vec3> =
                    mesh.face_vertices(face).map(|vertex| mesh.position(vertex)).collect();
                let center = corners.iter().sum::<Vec3>() / corners.len() as f32;
                let point = |(i, &corner): (usize, &Vec3)| {
                    KnifePoint::Face(face, center.lerp(corner, [0.5, b.abs() as f32 / 2.0][i % 2]))
                };
                // Closed or not; it may cross the edge where it begins.
                let edge = mesh.face_edges(face).next().map(|edge| KnifePoint::Edge(edge, a.abs()));
                edge.into_iter().chain(corners.iter().enumerate().map(point)).collect()
            };
            let strokes: Vec<Vec<KnifePoint>> = faces.iter().map(|&face| parts(face)).collect();
            mesh.knife(&strokes).map(drop)
        }
        41 => {
            // Three to eight voxels across, whatever other steps made of the mesh.
            let points = mesh.vertices().map(|vertex| mesh.point(vertex));
            let size = Bounds3::from_points(points).size().max_element();
            let settings = VoxelRemeshSettings { voxel_size: size * (0.22 + 0.1 * a), project: b > 0.0 };
            mesh.voxel_remesh(&settings).map(drop)
        }
        42 => {
            let settings = TubeSettings { radius: 0.1, sides: 3, caps: a > 0.0, replace: b > 0.0 };
            mesh.tube_edges(&edges, &settings).map(drop)
        }
        43 => {
            let copy = mesh.clone();
            let transform = DAffine3::from_rotation_translation(DQuat::from_rotation_y(b), center);
            let settings = TransferSettings { colors: a > 0.0, ..TransferSettings::default() };
            mesh.transfer_values(&faces, &TransferSource { mesh: &copy, transform }, &settings)
        }
        // All faces of a large mesh that winds through itself cross most others.
        44 | 45 if mesh.face_count() > 100 => Err(Refusal::TooMany),
        44 => {
            let with = if a > 0.0 { IntersectWith::Others } else { IntersectWith::Themselves };
            mesh.intersect_faces(&faces, with).map(drop)
        }
        45 => {
            let tool = mesh.clone();
            let transform = DAffine3::from_rotation_translation(DQuat::from_rotation_x(b), center * 0.2);
            let projection = KnifeProjection { transform, direction: center, cut_through: b > 0.0 };
            mesh.knife_project(&faces, &tool, &projection).map(drop)
        }
        46 => {
            let settings = SolidSettings { within: a.abs() * 0.2, ..Default::default() };
            mesh.make_solid(&settings).map(drop)
        }
        47 => mesh.add_vertex_group(&format!("{}", bits % 4)),
        48 => {
            let falloff = (b > 0.0).then_some(falloff);
            let assignment = GroupAssignment { weight: b.abs(), falloff, replace: bits.is_multiple_of(2) };
            mesh.assign_to_vertex_group(&first_group(mesh), &vertices, &assignment).map(drop)
        }
        49 => mesh.remove_from_vertex_group(&first_group(mesh), &vertices).map(drop),
        50 if a > 0.0 => mesh.remove_vertex_group(&first_group(mesh)),
        50 => mesh.rename_vertex_group(&first_group(mesh), &format!("{}", bits % 4)),
        _ => mesh.collapse_zero_length_edges(a.abs() * 0.2).map(drop),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// After each step the structure is whole; a refusal changes nothing; undoing all gives the first
    /// bytes, redoing all the last; and what is shown of it can be made.
    #[test]
    fn random_operations_keep_every_rule(
        start in meshes(),
        has_normals in any::<bool>(),
        has_groups in any::<bool>(),
        steps in prop::collection::vec((any::<u8>(), any::<u64>(), -1.0f64..1.0, -1.0f64..1.0), 1..8),
    ) {
        let mut start = start;
        if has_normals {
            start.smooth_by_angle(1.0);
        }
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        if has_groups {
            add_affine_group(&mut mesh, "affine");
        }
        let first = mesh.clone();
        let mut differences = Vec::new();
        for s in steps {
            let (kind, bits, a, b) = s;
            // What grows with each mirror is enough.
            if mesh.face_count() > 2000 {
                break;
            }
            let before = mesh.clone();
            match mesh.transaction(|mesh| step(mesh, kind, bits, a, b)) {
                Ok(((), difference)) => differences.push(difference),
                Err(_) => prop_assert!(mesh == before, "a refusal changes nothing: {:?}", s),
            }
            prop_assert_eq!(mesh.check_structure(), Ok(()), "after {:?}", s);
            // Marks and windings move no place, and no value from it.
            if (5..15).contains(&(kind % KINDS)) {
                prop_assert!(keeps_affine_values(&before).is_err() || keeps_affine_values(&mesh).is_ok(), "{:?}", s);
            }
        }
        let (shown, _) = mesh.to_mesh();
        let normals = shown.shading_normals();
        prop_assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5), "directions");
        check_undo_and_redo(mesh, &first, &mut differences)?;
    }
}
