//! How an image shows the selection: elements in their own colours in edit mode, an outline around
//! objects in object mode.
//!
//! Colours are those of Blender's default theme. Marks are rebuilt when the selection or the marks of edges
//! change, never per frame: dragging vertices changes neither.

use std::sync::Arc;

use trigon_mesh::math::{Vec3, color};
use trigon_modelling::{EdgeId, ElementMap, FaceId, VertexId};
use trigon_scene::{
    ElementSet, Mark, Marks, MeshId, NodeId, Outline, Reach, RenderSettings, Style, VertexPoints,
};

use super::element::{all, bits};
use super::selected::EditedMeshView;
use crate::document::Document;
use crate::selection::{ElementKind, MeshSelection, Selection};

/// The opacity of faces in X-ray mode.
pub const X_RAY: f32 = 0.5;

const SELECTED_VERTEX: [u8; 3] = [0xff, 0x7a, 0x00];
const SELECTED_EDGE: [u8; 3] = [0xff, 0x99, 0x00];
const SELECTED_FACE: [u8; 3] = [0xff, 0xa3, 0x00];
const ACTIVE: [u8; 3] = [0xff; 3];
/// White over a light material would look like no selection at all.
const ACTIVE_FACE: [u8; 3] = [0xff, 0xc8, 0x50];
const SHARP: [u8; 3] = [0x00, 0xff, 0xff];
const SEAM: [u8; 3] = [0xdb, 0x25, 0x12];
const CREASE: [u8; 3] = [0xcc, 0x00, 0x99];
const CAGE: [u8; 3] = [0; 3];
const OBJECT: [u8; 3] = [0xff, 0xa0, 0x28];

/// The opacity of the colour of a selected face, so that its own colour shows.
const FACE_OPACITY: f32 = 0.3;
const ACTIVE_FACE_OPACITY: f32 = 0.5;

/// In pixels.
const OUTLINE_WIDTH: u32 = 2;

/// How a document's selection is displayed, kept while it is unchanged.
#[derive(Debug, Clone, Default)]
pub struct DisplayMarks {
    /// What they were computed from.
    known: Option<(u64, Selection)>,
    marks: Marks,
    vertices: Option<VertexPoints>,
    outline: Option<Outline>,
    is_editing: bool,
}

impl DisplayMarks {
    /// Brings the marks up to date. Returns whether they changed; if so, pass them to the settings
    /// again. Takes time proportional to the selected meshes if something changed, and otherwise to
    /// the selection.
    pub fn update(&mut self, document: &mut Document) -> bool {
        document.scene();
        let state = (document.marks_revision(), document.selection());
        if self.known.as_ref().is_some_and(|(revision, selection)| (*revision, selection) == state) {
            return false;
        }
        self.known = Some((state.0, state.1.clone()));
        self.make(document);
        true
    }

    /// Shows them in an image. With [`Reach::Through`] faces are translucent (X-ray).
    pub fn apply(&self, settings: &mut RenderSettings, reach: Reach) {
        settings.marks = self.marks.clone();
        settings.vertices = self.vertices;
        settings.effects.outline = self.outline.clone();
        if self.is_editing && settings.style == Style::Surface {
            settings.style = Style::SurfaceWithEdges;
        }
        settings.x_ray = if self.is_editing && reach == Reach::Through { X_RAY } else { 0.0 };
    }

    fn make(&mut self, document: &Document) {
        let selection = document.selection();
        self.is_editing = selection.is_editing();
        self.vertices =
            (self.is_editing && selection.kind() == ElementKind::Vertex).then(VertexPoints::default);
        self.outline = (!self.is_editing).then(|| outline(document)).flatten();
        self.marks = if self.is_editing { edit_marks(document) } else { Marks::default() };
    }
}

/// A line around the selected objects and their descendants.
fn outline(document: &Document) -> Option<Outline> {
    let scene = document.nodes();
    let mut nodes: Vec<NodeId> = Vec::new();
    let mut waiting: Vec<NodeId> = document.selection().objects.iter().copied().collect();
    while let Some(id) = waiting.pop() {
        if let Some(node) = scene.node(id).filter(|_| !nodes.contains(&id)) {
            nodes.push(id);
            // A group has no silhouette of its own.
            if node.mesh.is_none() {
                waiting.extend(node.children());
            }
        }
    }
    nodes.sort_unstable();
    (!nodes.is_empty()).then(|| Outline { nodes, color: linear(OBJECT), width: OUTLINE_WIDTH })
}

/// The elements of all meshes that are displayed in one way.
#[derive(Default)]
struct Sets {
    /// Elements of objects that are not edited.
    plain_edges: ElementSet,
    plain_vertices: ElementSet,
    active: [ElementSet; 3],
    selected: [ElementSet; 3],
    sharp: ElementSet,
    seams: ElementSet,
    creases: ElementSet,
    /// Edges over a subdivision surface; without a mark they would have the colour of the material.
    cage: ElementSet,
}

/// The indices of the kinds in [`Sets`].
const VERTICES: usize = 0;
const EDGES: usize = 1;
const FACES: usize = 2;

fn edit_marks(document: &Document) -> Marks {
    let mut sets = Sets::default();
    let scene = document.nodes();
    for (node, content) in scene.nodes().iter() {
        let Some(mesh) = content.mesh else { continue };
        match document.selection().of(mesh) {
            Some(selected) => sets.add(document, node, mesh, selected),
            None => sets.hide_elements(document, node, mesh),
        }
    }
    sets.into_marks()
}

impl Sets {
    /// The elements of an edited object.
    fn add(&mut self, document: &Document, node: NodeId, id: MeshId, selected: &MeshSelection) {
        let Some(shown) = EditedMeshView::of(document, id) else { return };
        let (kind, numbers) = (document.selection().kind(), shown.numbers);
        for (sets, bits) in self.selected.iter_mut().zip(shown.selected(selected, kind)) {
            sets.add(node, bits);
        }
        self.show_cage(document, node, id, shown.map);
        let [of_vertices, of_edges, of_faces] = shown.counts();
        if let Some(active) = selected.order().last().copied() {
            match kind {
                ElementKind::Vertex => {
                    let active = numbers.vertex(VertexId::new(active)).into_iter();
                    self.active[VERTICES].add(node, bits(of_vertices, active));
                }
                ElementKind::Edge => {
                    let active = numbers.edge(EdgeId::new(active)).into_iter();
                    self.active[EDGES].add(node, bits(of_edges, active));
                }
                ElementKind::Face => {
                    self.active[FACES].add(node, bits(of_faces, shown.parts(FaceId::new(active))));
                }
            }
        }
        let Some(marked) = document.marked(id) else { return };
        let numbered = |edges: &[EdgeId]| bits(of_edges, edges.iter().filter_map(|&id| numbers.edge(id)));
        self.sharp.add(node, numbered(&marked.sharp));
        self.seams.add(node, numbered(&marked.seams));
        self.creases.add(node, numbered(&marked.creases));
    }

    /// Of a surface with its cage, only the edges and vertices of the cage are seen.
    fn show_cage(&mut self, document: &Document, node: NodeId, id: MeshId, map: &ElementMap) {
        if let Some(surface) = document.shown_surface(id) {
            let is_surface =
                |vertex: &&VertexId| document.mesh(id).is_some_and(|mesh| !mesh.has_vertex(**vertex));
            let is_surface_edge =
                |edge: &&EdgeId| document.mesh(id).is_some_and(|mesh| !mesh.has_edge(**edge));
            let loose = map.loose_edges.iter().take_while(is_surface_edge).count();
            let mut cage = all(surface.edge_count());
            cage.set_range(..surface.face_edge_count() + loose, false);
            self.cage.add(node, cage);
            self.plain_edges.add(node, all(surface.face_edge_count()));
            self.plain_vertices.add(node, all(map.vertices.iter().take_while(is_surface).count()));
        }
    }

    /// Only what is edited shows its edges and vertices.
    fn hide_elements(&mut self, document: &Document, node: NodeId, id: MeshId) {
        let of_scene = || Some(document.nodes().meshes().get(id)?.mesh());
        let Some(mesh) = document.shown_surface(id).or_else(of_scene) else { return };
        self.plain_edges.add(node, all(mesh.edge_count()));
        self.plain_vertices.add(node, all(mesh.vertex_count()));
    }

    /// In order of priority.
    fn into_marks(self) -> Marks {
        let mark = |elements: ElementSet, srgb: [u8; 3], opacity: f32| {
            (!elements.is_empty()).then(|| Mark {
                elements: Arc::new(elements),
                color: linear(srgb),
                opacity,
                outlined: false,
            })
        };
        // These are to be seen on white and on black surfaces.
        let outlined = |elements: ElementSet, srgb: [u8; 3]| {
            mark(elements, srgb, 1.0).map(|mark| Mark { outlined: true, ..mark })
        };
        let [active_vertices, active_edges, active_faces] = self.active;
        let [vertices, edges, faces] = self.selected;
        let edges = [
            mark(self.plain_edges, [0; 3], 0.0),
            outlined(active_edges, ACTIVE),
            outlined(edges, SELECTED_EDGE),
            mark(self.sharp, SHARP, 1.0),
            mark(self.seams, SEAM, 1.0),
            mark(self.creases, CREASE, 1.0),
            mark(self.cage, CAGE, 1.0),
        ];
        let faces =
            [mark(active_faces, ACTIVE_FACE, ACTIVE_FACE_OPACITY), mark(faces, SELECTED_FACE, FACE_OPACITY)];
        let vertices = [
            mark(self.plain_vertices, [0; 3], 0.0),
            mark(active_vertices, ACTIVE, 1.0),
            mark(vertices, SELECTED_VERTEX, 1.0),
        ];
        Marks {
            edges: edges.into_iter().flatten().collect(),
            faces: faces.into_iter().flatten().collect(),
            vertices: vertices.into_iter().flatten().collect(),
        }
    }
}

fn linear(srgb: [u8; 3]) -> Vec3 {
    Vec3::from_array(srgb.map(color::srgb8_to_linear))
}

#[cfg(test)]
mod tests;
