//! The table of operations.

use trigon_math::{DAffine3, DVec3, Plane, Vec3};

use super::{Chosen, Operation, Promise, operation};
use crate::modifier::{DecimateSettings, SolidifySettings};
use crate::operations::*;
use crate::tests::with_affine_values;
use crate::{BooleanOperation, EdgeId, EditMesh, FaceId, Refusal};

fn plane() -> Plane {
    Plane::from_point_and_normal(DVec3::ZERO, DVec3::X).expect("a direction")
}

pub(super) const OPERATIONS: [Operation; 58] = [
    operation("merge by distance", Promise::Nothing, |mesh, on| {
        mesh.merge_by_distance(&on.vertices, 1.1).map(drop)
    }),
    operation("merge at the centre", Promise::Nothing, |mesh, on| {
        mesh.merge_at_center(&on.vertices).map(drop)
    }),
    operation("merge at the first", Promise::Nothing, |mesh, on| mesh.merge_at_first(&on.vertices).map(drop)),
    operation("merge at the last", Promise::Nothing, |mesh, on| mesh.merge_at_last(&on.vertices).map(drop)),
    operation("collapse edges", Promise::Nothing, |mesh, on| mesh.collapse_edges(&on.edges).map(drop)),
    operation("dissolve vertices", Promise::Closed, |mesh, on| {
        mesh.dissolve_vertices(&on.vertices).map(drop)
    }),
    operation("dissolve edges", Promise::Closed, |mesh, on| mesh.dissolve_edges(&on.edges).map(drop)),
    operation("dissolve faces", Promise::Closed, |mesh, on| mesh.dissolve_faces(&on.faces).map(drop)),
    operation("limited dissolve", Promise::Shape, |mesh, on| {
        mesh.dissolve_limited(&on.faces, LimitedDissolve { angle: 0.01 }).map(drop)
    }),
    operation("dissolve anything", Promise::Closed, |mesh, on| {
        mesh.dissolve_limited(&on.faces, LimitedDissolve { angle: std::f64::consts::PI }).map(drop)
    }),
    operation("triangulate", Promise::Shape, |mesh, on| mesh.triangulate_faces(&on.faces).map(drop)),
    operation("triangles to quads", Promise::Euler, |mesh, on| {
        mesh.triangulate_faces(&on.all_faces)?;
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.tris_to_quads(&faces, QuadLimits { face_angle: 3.1, shape_angle: 3.1 }).map(drop)
    }),
    operation("subdivide", Promise::Euler, |mesh, on| {
        mesh.subdivide(&on.edges, 1 + on.number as u32 % 3).map(drop)
    }),
    operation("Catmull-Clark", Promise::Euler, |mesh, _| mesh.catmull_clark(1).map(drop)),
    operation("extrude a region", Promise::Nothing, |mesh, on| {
        mesh.extrude_region(&on.faces, ExtrudeOffset::Along(0.3)).map(drop)
    }),
    operation("extrude faces", Promise::Nothing, |mesh, on| {
        mesh.extrude_individual(&on.faces, ExtrudeOffset::By(DVec3::ONE)).map(drop)
    }),
    operation("extrude edges", Promise::Nothing, |mesh, on| {
        mesh.extrude_edges(&on.edges, DVec3::Z).map(drop)
    }),
    operation("extrude vertices", Promise::Nothing, |mesh, on| {
        mesh.extrude_vertices(&on.vertices, DVec3::Z).map(drop)
    }),
    operation("inset faces", Promise::Nothing, |mesh, on| {
        mesh.inset_individual(&on.faces, Inset { thickness: 0.1, ..Inset::default() }).map(drop)
    }),
    operation("inset a region", Promise::Nothing, |mesh, on| {
        mesh.inset_region(&on.faces, Inset { thickness: 0.1, ..Inset::default() }).map(drop)
    }),
    operation("outset a region", Promise::Nothing, |mesh, on| {
        mesh.outset_region(&on.faces, Inset { thickness: 0.1, ..Inset::default() }).map(drop)
    }),
    operation("bisect", Promise::Shape, |mesh, on| {
        mesh.bisect(&on.faces, DVec3::splat(0.1), DVec3::new(1.0, 0.3, -0.2), &BisectSettings::default())
            .map(drop)
    }),
    operation("bisect, clear and fill", Promise::Nothing, |mesh, on| {
        let settings = BisectSettings { clear_outer: true, fill: true, ..Default::default() };
        mesh.bisect(&on.faces, DVec3::ZERO, DVec3::X, &settings).map(drop)
    }),
    operation("reverse a subdivision", Promise::Closed, |mesh, on| {
        mesh.catmull_clark(1)?;
        let faces: Vec<FaceId> = mesh.faces().collect();
        let some = if on.number == 0 { faces.len() } else { faces.len() / 2 };
        mesh.un_subdivide(&faces[..some]).map(drop)
    }),
    operation("wireframe", Promise::Nothing, |mesh, on| {
        mesh.wireframe_faces(&on.faces, &WireframeSettings::default()).map(drop)
    }),
    operation("remesh by voxels", Promise::Closed, |mesh, on| {
        let voxel_size = 0.3 + 0.01 * on.number as f64;
        mesh.voxel_remesh(&VoxelRemeshSettings { voxel_size, project: on.number % 2 == 0 }).map(drop)
    }),
    operation("tube", Promise::Nothing, |mesh, on| {
        mesh.tube_edges(&on.edges, &TubeSettings { sides: 3, ..TubeSettings::default() }).map(drop)
    }),
    operation("transfer from a coarser mesh", Promise::Shape, |mesh, on| {
        let (source, _) = EditMesh::from_mesh(&with_affine_values(trigon_mesh::primitives::cube(2.0)));
        let source = TransferSource { mesh: &source, transform: DAffine3::IDENTITY };
        mesh.transfer_values(&on.faces, &source, &TransferSettings::default())
    }),
    operation("poke", Promise::Euler, |mesh, on| mesh.poke_faces(&on.faces, 0.0).map(drop)),
    operation("convex hull", Promise::Nothing, |mesh, on| {
        mesh.convex_hull(&on.vertices, &HullSettings { replace: on.number % 2 == 0 }).map(drop)
    }),
    operation("spin", Promise::Nothing, |mesh, on| {
        let settings = SpinSettings { axis: [1.0, 0.0, 1.0], steps: 3, ..Default::default() };
        mesh.spin(&on.edges, &on.vertices, &settings).map(drop)
    }),
    operation("decimate", Promise::Closed, |mesh, on| {
        mesh.decimate(&on.faces, &DecimateSettings::default()).map(drop)
    }),
    operation("solidify", Promise::Nothing, |mesh, on| {
        mesh.solidify_faces(&on.faces, &SolidifySettings { thickness: 0.1, ..Default::default() }).map(drop)
    }),
    operation("bevel edges", Promise::Closed, |mesh, on| {
        let settings = BevelSettings { segments: 1 + on.number as usize % 3, ..BevelSettings::default() };
        mesh.bevel_edges(&on.edges, &settings).map(drop)
    }),
    operation("bevel vertices", Promise::Closed, |mesh, on| {
        mesh.bevel_vertices(&on.vertices, &BevelSettings::default()).map(drop)
    }),
    operation("loop cut", Promise::Shape, |mesh, on| {
        let edge = *on.edges.first().ok_or(Refusal::TooMany)?;
        mesh.loop_cut(edge, &LoopCutSettings { cuts: 2, ..LoopCutSettings::default() }).map(drop)
    }),
    operation("connect vertices", Promise::Shape, |mesh, on| mesh.connect_vertices(&on.vertices).map(drop)),
    operation("knife", Promise::Euler, |mesh, on| {
        let corner = on.corner(mesh).ok_or(Refusal::TooMany)?;
        let across = mesh.corner_edge(mesh.next_corner(corner));
        let path = vec![KnifePoint::Vertex(mesh.corner_vertex(corner)), KnifePoint::Edge(across, 0.5)];
        mesh.knife(&[path]).map(drop)
    }),
    operation("knife within faces", Promise::Shape, |mesh, on| {
        let strokes: Vec<Vec<KnifePoint>> = on.faces.iter().map(|&face| star_within(mesh, face)).collect();
        mesh.knife(&strokes).map(drop)
    }),
    operation("intersect faces", Promise::Shape, |mesh, on| {
        let with = [IntersectWith::Others, IntersectWith::Themselves][on.number as usize % 2];
        mesh.intersect_faces(&on.faces, with).map(drop)
    }),
    operation("project an outline", Promise::Shape, |mesh, on| {
        let number = on.number as f64;
        let transform = DAffine3::from_scale(DVec3::splat(0.4)) * DAffine3::from_rotation_y(number);
        let direction = DVec3::new(0.3, 1.0, number / 20.0);
        let cut_through = on.number.is_multiple_of(2);
        let tool = mesh.clone();
        mesh.knife_project(&on.faces, &tool, &KnifeProjection { transform, direction, cut_through }).map(drop)
    }),
    operation("make solid", Promise::Nothing, |mesh, on| {
        let face = *on.faces.first().ok_or(Refusal::TooMany)?;
        mesh.delete_only_faces(&[face])?;
        mesh.make_solid(&SolidSettings::default()).map(drop)
    }),
    operation("fill edges", Promise::Nothing, |mesh, on| mesh.fill_edges(&on.edges).map(drop)),
    operation("fill vertices", Promise::Nothing, |mesh, on| mesh.fill_vertices(&on.vertices).map(drop)),
    operation("fill a gap with a grid", Promise::Nothing, |mesh, on| {
        let face = *on.faces.first().ok_or(Refusal::TooMany)?;
        let edges: Vec<EdgeId> = mesh.face_edges(face).collect();
        mesh.delete_only_faces(&[face])?;
        mesh.grid_fill(&edges, GridSides { span: Some(1), offset: 1 }).map(drop)
    }),
    operation("bridge faces", Promise::Nothing, |mesh, on| {
        mesh.bridge_faces(&on.faces, &[], &BridgeSettings::default()).map(drop)
    }),
    operation("bridge edges", Promise::Nothing, |mesh, on| {
        // Two sides of one face lead to the loops beside it.
        let face = *on.faces.first().ok_or(Refusal::TooMany)?;
        let edges: Vec<EdgeId> = mesh.face_edges(face).step_by(2).take(2).collect();
        mesh.bridge_edges(&edges, &BridgeSettings::default()).map(drop)
    }),
    operation("bridge faces with cuts", Promise::Nothing, |mesh, on| {
        let settings =
            BridgeSettings { cuts: 2, interpolation: BridgePath::Path, twist: 1, ..Default::default() };
        mesh.bridge_faces(&on.faces, &[], &settings).map(drop)
    }),
    operation("rip", Promise::Nothing, |mesh, on| {
        mesh.rip(&on.edges, &on.vertices, DVec3::X, on.number % 2 == 0).map(drop)
    }),
    operation("extend vertices", Promise::Euler, |mesh, on| {
        mesh.extend_vertices(&on.vertices, DVec3::new(1.0, 0.5, 0.25)).map(drop)
    }),
    operation("mirror a copy", Promise::Nothing, |mesh, on| {
        mesh.mirror_copy(&on.faces, &[], &plane(), Some(0.2)).map(drop)
    }),
    operation("symmetrize", Promise::Nothing, |mesh, on| {
        mesh.symmetrize(&on.all_faces, &plane(), 0.1).map(drop)
    }),
    operation("duplicate", Promise::Nothing, |mesh, on| {
        mesh.duplicate(&on.vertices, &on.edges, &on.faces).map(drop)
    }),
    operation("remove small faces and edges", Promise::Nothing, |mesh, _| {
        mesh.dissolve_zero_area_faces(0.3)?;
        mesh.collapse_zero_length_edges(0.7).map(drop)
    }),
    operation("split off", Promise::Nothing, |mesh, on| mesh.split_off(&on.faces).map(drop)),
    operation("unite with a moved copy", Promise::Closed, |mesh, on| {
        boolean_with_a_copy(mesh, on, BooleanOperation::Union)
    }),
    operation("cut out a moved copy", Promise::Closed, |mesh, on| {
        boolean_with_a_copy(mesh, on, BooleanOperation::Difference)
    }),
    operation("intersect with a moved copy", Promise::Closed, |mesh, on| {
        boolean_with_a_copy(mesh, on, BooleanOperation::Intersection)
    }),
];

/// Every third time it is moved along the axes by halves of a metre, and turned otherwise.
fn boolean_with_a_copy(mesh: &mut EditMesh, on: &Chosen, operation: BooleanOperation) -> Result<(), Refusal> {
    let number = on.number as f64;
    let offset = DVec3::new((number / 3.0).floor() / 2.0 - 2.0, 0.5, 0.0);
    let angle = if on.number.is_multiple_of(3) { 0.0 } else { number };
    let transform = DAffine3::from_translation(offset) * DAffine3::from_rotation_z(angle);
    let copy = mesh.clone();
    mesh.boolean(&[BooleanTool { mesh: &copy, transform }], operation).map(drop)
}

/// A closed cut within a face: each second corner is near its middle, so that it is hollow.
fn star_within(mesh: &EditMesh, face: FaceId) -> Vec<KnifePoint> {
    let corners: Vec<Vec3> = mesh.face_vertices(face).map(|vertex| mesh.position(vertex)).collect();
    let center = corners.iter().sum::<Vec3>() / corners.len() as f32;
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let points = ends.flat_map(|(&a, &b)| [center.lerp(a, 0.3), center.lerp((a + b) / 2.0, 0.05)]);
    let mut stroke: Vec<KnifePoint> = points.map(|position| KnifePoint::Face(face, position)).collect();
    stroke.extend(stroke.first().copied());
    stroke
}
