//! The document on the stage: its scene, what is selected of it, and how it is drawn.

use std::sync::Arc;

use trigon_edit::scene::{ElementSet, FixedBitSet, Mark, Marks, MeshId, NodeId, Style, VertexPoints};
use trigon_edit::{Document, ElementKind};
use trigon_window::Stage;
use trigon_window::scene::math::Vec3;
use trigon_window::scene::{Lighting, Reflection, Scene};

use super::editor::Editor;
use crate::request::DisplayMode;

/// Linear RGB of what is selected: Blender's orange.
const SELECTED: Vec3 = Vec3::new(1.0, 0.25, 0.02);

/// Shows the document as it is now.
pub(crate) fn onto_stage(editor: &mut Editor, stage: &mut Stage) {
    let mut scene: Scene = editor.document.scene().clone();
    if let Some(only) = &editor.view.local {
        for (id, node) in scene.nodes_mut() {
            node.visible &= node.mesh.is_none() || only.contains(&id);
        }
    }
    stage.scene = scene.into();
    let selection = editor.document.selection();
    let active = selection.active.filter(|id| selection.objects.contains(id));
    stage.selection = active.filter(|_| !selection.is_editing());
    set_look(editor, stage);
}

/// Style, lights and marks of the mode that the editor is in.
fn set_look(editor: &Editor, stage: &mut Stage) {
    let selection = editor.document.selection();
    let is_editing = selection.is_editing();
    let display = editor.view.display;
    let settings = &mut stage.settings;
    settings.style = match (display, is_editing) {
        (DisplayMode::Wireframe, _) => Style::Wireframe,
        (_, true) => Style::SurfaceWithEdges,
        (_, false) => Style::Surface,
    };
    if editor.view.x_ray && settings.style == Style::Surface {
        settings.style = Style::SurfaceWithEdges;
    }
    settings.x_ray = if editor.view.x_ray { 0.6 } else { 0.0 };
    settings.lighting = if display == DisplayMode::Rendered { Lighting::Automatic } else { Lighting::Studio };
    settings.reflection =
        if display == DisplayMode::Solid { Reflection::Lambert } else { Reflection::Material };
    let shows_vertices = is_editing && selection.kind() == ElementKind::Vertex;
    settings.vertices = shows_vertices.then(VertexPoints::default);
    settings.marks = if is_editing { marks(&editor.document) } else { Marks::default() };
}

/// The selected elements in their colour.
fn marks(document: &Document) -> Marks {
    let kind = document.selection().kind();
    let mut set = ElementSet::default();
    for (id, node) in document.nodes().nodes().iter() {
        if let Some(bits) = node.mesh.and_then(|mesh| shown_bits(document, mesh, kind)) {
            set.add(id, bits);
        }
    }
    let mark = |opacity| vec![Mark { elements: Arc::new(set), color: SELECTED, opacity }];
    match kind {
        ElementKind::Vertex => Marks { vertices: mark(1.0), ..Marks::default() },
        ElementKind::Edge => Marks { edges: mark(1.0), ..Marks::default() },
        ElementKind::Face => Marks { faces: mark(0.5), ..Marks::default() },
    }
}

/// Which elements of the scene's mesh show a selected one.
fn shown_bits(document: &Document, id: MeshId, kind: ElementKind) -> Option<FixedBitSet> {
    let selected = document.selection().of(id)?;
    let mesh = document.nodes().meshes().get(id)?.mesh();
    let numbers = element_numbers(document, id, kind)?;
    let count = match kind {
        ElementKind::Vertex => mesh.vertex_count(),
        ElementKind::Edge => mesh.edge_count(),
        ElementKind::Face => mesh.face_count(),
    };
    let mut bits = FixedBitSet::with_capacity(count);
    let chosen = numbers.iter().enumerate().filter(|(_, number)| selected.contains(**number));
    bits.extend(chosen.map(|(shown, _)| shown));
    Some(bits)
}

/// By the elements of the scene's mesh: the numbers of the edited mesh's elements that they show.
pub(crate) fn element_numbers(document: &Document, id: MeshId, kind: ElementKind) -> Option<Vec<u32>> {
    let (mesh, edited) = (document.nodes().meshes().get(id)?.mesh(), document.mesh(id)?);
    let Some(map) = document.shown_elements(id) else {
        // It was never changed: all numbers are the same, but those of edges, which only a map has.
        let (_, map) = edited.to_mesh();
        return Some(numbers_of(&map, mesh, edited, kind));
    };
    Some(numbers_of(map, mesh, edited, kind))
}

fn numbers_of(
    map: &trigon_edit::mesh::edit::ElementMap,
    mesh: &trigon_edit::mesh::Mesh,
    edited: &trigon_edit::mesh::edit::EditMesh,
    kind: ElementKind,
) -> Vec<u32> {
    match kind {
        ElementKind::Vertex => map.vertices.iter().map(|vertex| vertex.index()).collect(),
        ElementKind::Edge => map.edges(mesh, edited).iter().map(|edge| edge.index()).collect(),
        ElementKind::Face => map.faces.iter().map(|face| face.index()).collect(),
    }
}

/// The mesh of a node.
pub(crate) fn mesh_of(document: &Document, node: NodeId) -> Option<MeshId> {
    document.nodes().node(node)?.mesh
}
