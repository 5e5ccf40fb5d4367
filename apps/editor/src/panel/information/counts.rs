//! Element counts.

use trigon_document::mesh::math::Bounds3;
use trigon_document::modelling::EditMesh;
use trigon_document::scene::{MeshId, NodeId};
use trigon_document::{Document, MeshSelection};

/// Elements of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct ElementCounts {
    pub(super) vertices: usize,
    pub(super) edges: usize,
    pub(super) faces: usize,
    pub(super) triangles: usize,
}

impl ElementCounts {
    fn add(&mut self, other: Self) {
        self.vertices += other.vertices;
        self.edges += other.edges;
        self.faces += other.faces;
        self.triangles += other.triangles;
    }
}

/// Of a document.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Counts {
    pub(super) objects: usize,
    pub(super) selected_objects: usize,
    /// Of all objects; meshes that several show count each time.
    pub(super) scene: ElementCounts,
    /// Of the selected objects, or the selected elements.
    pub(super) selected: ElementCounts,
    /// Around what is selected: of objects in the world, of elements in the space of their mesh.
    pub(super) bounds: Bounds3,
}

/// Counts all. Of elements it visits those that are selected, otherwise objects only.
pub(super) fn counted(document: &Document) -> Counts {
    let (nodes, selection) = (document.nodes().nodes(), document.selection());
    let is_selected = |id: &NodeId| nodes.get(*id).is_some() && selection.objects.contains(id);
    let mut counts = Counts {
        objects: nodes.len(),
        selected_objects: selection.objects.iter().filter(|id| is_selected(id)).count(),
        scene: ElementCounts::default(),
        selected: ElementCounts::default(),
        bounds: Bounds3::EMPTY,
    };
    for (id, node) in nodes.iter() {
        let Some(mesh) = node.mesh else { continue };
        let of_mesh = of_mesh(document, mesh);
        counts.scene.add(of_mesh);
        if is_selected(&id) && !selection.is_editing() {
            counts.selected.add(of_mesh);
            let bounds = bounds(document, mesh).transformed(&document.nodes().world_transform(id));
            counts.bounds = counts.bounds.union(bounds);
        }
    }
    for (id, selected) in selection.meshes().filter(|(_, selected)| !selected.is_empty()) {
        let Some(mesh) = document.mesh(id) else { continue };
        let (elements, bounds) = of_elements(document, mesh, selected);
        counts.selected.add(elements);
        counts.bounds = counts.bounds.union(bounds);
    }
    counts
}

/// Each polygon has two triangles fewer than corners.
fn triangles(corners: usize, faces: usize) -> usize {
    corners.saturating_sub(2 * faces)
}

fn of_mesh(document: &Document, id: MeshId) -> ElementCounts {
    if let Some(mesh) = document.mesh(id) {
        let (corners, faces) = (mesh.corner_count(), mesh.face_count());
        let (vertices, edges) = (mesh.vertex_count(), mesh.edge_count());
        return ElementCounts { vertices, edges, faces, triangles: triangles(corners, faces) };
    }
    let Some(asset) = document.nodes().meshes().get(id) else { return ElementCounts::default() };
    let mesh = asset.mesh();
    let (corners, faces) = (mesh.corner_vertices().len(), mesh.face_count());
    let (vertices, edges) = (mesh.vertex_count(), mesh.edge_count());
    ElementCounts { vertices, edges, faces, triangles: triangles(corners, faces) }
}

fn bounds(document: &Document, id: MeshId) -> Bounds3 {
    match document.mesh(id) {
        Some(mesh) => mesh.bounds(),
        None => document.nodes().meshes().get(id).map_or(Bounds3::EMPTY, |asset| asset.mesh().bounds()),
    }
}

fn of_elements(document: &Document, mesh: &EditMesh, selected: &MeshSelection) -> (ElementCounts, Bounds3) {
    let kind = document.selection().kind();
    let (vertices, faces) = (selected.vertices(mesh, kind), selected.faces(mesh, kind));
    let corners = faces.iter().map(|&face| mesh.face_size(face)).sum();
    let counts = ElementCounts {
        vertices: vertices.len(),
        edges: selected.edges(mesh, kind).len(),
        faces: faces.len(),
        triangles: triangles(corners, faces.len()),
    };
    (counts, mesh.bounds_of(vertices))
}
