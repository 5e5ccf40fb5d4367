//! What lies at a point or in a box of the UV view, as commands that select it in the mesh.

use trigon_document::mesh::math::{DVec2, Vec3};
use trigon_document::mesh::triangulate_polygon;
use trigon_document::modelling::{CornerId, EditMesh, FaceId};
use trigon_document::scene::MeshId;
use trigon_document::{Command, Document, ElementKind, ElementsOf, Select, SelectAction, SelectElements};
use trigon_window::egui::{Pos2, Rect};

use super::canvas::UvCanvas;
use crate::overlay::distance_to_line;

/// The set of texture coordinates that is shown.
pub(crate) const UV_SET: usize = 0;

/// How near is near enough, in points.
const RADIUS: f32 = 10.0;

/// The edited meshes with texture coordinates.
pub(super) fn meshes(document: &Document) -> impl Iterator<Item = (MeshId, &EditMesh)> {
    let edited = document.selection().meshes();
    let with_mesh = edited.filter_map(|(id, _)| Some((id, document.mesh(id)?)));
    with_mesh.filter(|(_, mesh)| mesh.uv_set_count() > UV_SET)
}

pub(super) fn uv(mesh: &EditMesh, corner: CornerId) -> DVec2 {
    mesh.uv(UV_SET, corner).unwrap_or_default().as_dvec2()
}

/// Selects what a click is at, of the kind that is selected; what it is beside of clears the selection.
pub(crate) fn click(
    document: &Document,
    canvas: &UvCanvas,
    at: Pos2,
    action: SelectAction,
) -> Option<Command> {
    let kind = document.selection().kind();
    let found = meshes(document).filter_map(|(id, mesh)| {
        let (element, distance) = nearest(mesh, canvas, at, kind)?;
        Some((id, element, distance))
    });
    let found = found.min_by(|a, b| a.2.total_cmp(&b.2));
    match found {
        Some((id, element, _)) => {
            let objects = vec![document.object_of(id)?];
            Some(Select { objects, elements: vec![element], action }.into())
        }
        None if action == SelectAction::Replace => {
            Some(SelectElements { parts: Vec::new(), action: SelectAction::Replace }.into())
        }
        None => None,
    }
}

/// The nearest element of a kind within reach, and how far it is, in points.
fn nearest(mesh: &EditMesh, canvas: &UvCanvas, at: Pos2, kind: ElementKind) -> Option<(u32, f32)> {
    let visible = |corner: &CornerId| !mesh.is_face_hidden(mesh.corner_face(*corner));
    let best = |found: &mut dyn Iterator<Item = (u32, f32)>| {
        found.filter(|(_, distance)| *distance <= RADIUS).min_by(|a, b| a.1.total_cmp(&b.1))
    };
    match kind {
        ElementKind::Vertex => best(&mut mesh.corners().filter(visible).map(|corner| {
            let distance = canvas.point(uv(mesh, corner)).distance(at);
            (mesh.corner_vertex(corner).index(), distance)
        })),
        ElementKind::Edge => best(&mut mesh.corners().filter(visible).map(|corner| {
            let ends = [corner, mesh.next_corner(corner)].map(|end| canvas.point(uv(mesh, end)));
            (mesh.corner_edge(corner).index(), distance_to_line(ends, at))
        })),
        ElementKind::Face => face_at(mesh, canvas.uv(at)).map(|face| (face.index(), 0.0)),
    }
}

/// The last face whose coordinates lie around a point; it is drawn over the others.
pub(crate) fn face_at(mesh: &EditMesh, at: DVec2) -> Option<FaceId> {
    mesh.faces().filter(|&face| !mesh.is_face_hidden(face) && contains(mesh, face, at)).last()
}

fn contains(mesh: &EditMesh, face: FaceId, at: DVec2) -> bool {
    let points: Vec<Vec3> =
        mesh.face_corners(face).map(|corner| uv(mesh, corner).as_vec2().extend(0.0)).collect();
    triangulate_polygon(&points).iter().any(|triangle| {
        let corners = triangle.map(|corner| points[corner as usize].truncate().as_dvec2());
        let sides = [0, 1, 2].map(|side| {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            (to - from).perp_dot(at - from)
        });
        sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
    })
}

/// Selects the elements in a box: vertices and whole edges in it, and faces whose middle is.
pub(crate) fn within(document: &Document, canvas: &UvCanvas, rect: Rect, action: SelectAction) -> Command {
    let kind = document.selection().kind();
    let is_inside = |at: DVec2| rect.contains(canvas.point(at));
    let part = |(id, mesh): (MeshId, &EditMesh)| {
        let faces = mesh.faces().filter(|&face| !mesh.is_face_hidden(face));
        let corners = || faces.clone().flat_map(|face| mesh.face_corners(face));
        let mut found: Vec<u32> = match kind {
            ElementKind::Vertex => corners()
                .filter(|&corner| is_inside(uv(mesh, corner)))
                .map(|corner| mesh.corner_vertex(corner).index())
                .collect(),
            ElementKind::Edge => corners()
                .filter(|&corner| {
                    [corner, mesh.next_corner(corner)].into_iter().all(|end| is_inside(uv(mesh, end)))
                })
                .map(|corner| mesh.corner_edge(corner).index())
                .collect(),
            ElementKind::Face => faces
                .clone()
                .filter(|&face| {
                    let sum: DVec2 = mesh.face_corners(face).map(|corner| uv(mesh, corner)).sum();
                    is_inside(sum / mesh.face_size(face) as f64)
                })
                .map(FaceId::index)
                .collect(),
        };
        found.sort_unstable();
        found.dedup();
        Some(ElementsOf::new(document.object_of(id)?, found))
    };
    SelectElements { parts: meshes(document).filter_map(part).collect(), action }.into()
}

/// Selects the island under a point, in the kind that is selected.
pub(crate) fn island(document: &Document, at: DVec2, action: SelectAction) -> Option<Command> {
    let found = meshes(document).filter_map(|(id, mesh)| Some((id, mesh, face_at(mesh, at)?)));
    let (id, mesh, face) = found.last()?;
    let faces = mesh.uv_island(UV_SET, face);
    let mut elements: Vec<u32> = match document.selection().kind() {
        ElementKind::Face => faces.iter().map(|face| face.index()).collect(),
        ElementKind::Edge => {
            faces.iter().flat_map(|&face| mesh.face_edges(face)).map(|edge| edge.index()).collect()
        }
        ElementKind::Vertex => {
            faces.iter().flat_map(|&face| mesh.face_vertices(face)).map(|vertex| vertex.index()).collect()
        }
    };
    elements.sort_unstable();
    elements.dedup();
    let parts = vec![ElementsOf::new(document.object_of(id)?, elements)];
    Some(SelectElements { parts, action }.into())
}
