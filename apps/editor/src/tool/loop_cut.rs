//! Ctrl+R: shows the ring under the pointer, a click cuts it, and then the cuts slide.

use trigon_document::mesh::math::{DAffine3, DVec2, DVec3};
use trigon_document::modelling::{EdgeId, EditMesh, FaceId};
use trigon_document::scene::MeshId;
use trigon_document::{Document, LoopCut, edge_ring, face_loop};
use trigon_window::{Hands, Input, PointerButton};

use super::expression::Quantity;
use super::extrude::on;
use super::modal::{FaceTool, Modal, Step};
use super::numeric::NumericEntry;
use super::selected::placed;
use super::snap::rounded;
use super::view::ToolView;
use super::{Tool, ToolMarks, ToolState};

/// A loop cut that runs.
#[derive(Debug)]
pub(crate) struct LoopCutTool {
    modal: Modal,
    cuts: u32,
    snap_step: f64,
    /// The edge under the pointer, and the lines that would be cut.
    hovered: Option<(MeshId, EdgeId)>,
    lines: Vec<[DVec3; 2]>,
    /// Once a click has cut: where the edge runs in the image.
    sliding: Option<DVec2>,
    position: f64,
    /// Whether the cuts keep their distance in place of their part of each edge, and from which side.
    even: bool,
    flipped: bool,
}

/// As many as the parameter allows that are still drawn in time.
const MOST_CUTS: f64 = 100.0;

impl LoopCutTool {
    /// Starts to follow the pointer in edit mode.
    pub(crate) fn start(document: &Document, hands: Hands) -> Option<Self> {
        document.selection().is_editing().then(|| Self {
            modal: Modal::new(hands, NumericEntry::new(Quantity::Factor, 1)),
            cuts: 1,
            snap_step: 0.1,
            hovered: None,
            lines: Vec::new(),
            sliding: None,
            position: 0.0,
            even: false,
            flipped: false,
        })
    }

    fn show_ring(&mut self, document: &Document) {
        self.lines = match self.hovered {
            Some((id, edge)) => document
                .mesh(id)
                .map(|mesh| ring_lines(mesh, edge, self.cuts, &document.mesh_transform(id)))
                .unwrap_or_default(),
            None => Vec::new(),
        };
    }

    fn set_cuts(&mut self, cuts: f64, document: &Document) {
        self.cuts = cuts.round().clamp(1.0, MOST_CUTS) as u32;
        self.show_ring(document);
    }

    fn update(&mut self, document: &mut Document) -> ToolState {
        let typed = match self.modal.numeric.value_or(0.0) {
            Ok(typed) => typed,
            Err(error) => return self.modal.refuse(error.to_string()),
        };
        let Some(way) = self.sliding else {
            if let Some(cuts) = typed {
                self.set_cuts(cuts, document);
            }
            return ToolState::Running;
        };
        // One cut has half of the edge on either side, two have a third, and so on.
        let share = f64::from(self.cuts + 1);
        let dragged = share * self.modal.pointer.way().dot(way) / way.length_squared();
        let dragged = if dragged.is_finite() { dragged } else { 0.0 };
        let snaps = self.modal.inverts_snapping();
        let dragged = if snaps { rounded(dragged, self.snap_step) } else { dragged };
        self.position = typed.unwrap_or(dragged).clamp(-1.0, 1.0);
        self.cut(document)
    }

    fn cut(&mut self, document: &mut Document) -> ToolState {
        let Some((id, edge)) = self.hovered else { return ToolState::Running };
        let command = LoopCut {
            cuts: self.cuts,
            position: self.position,
            even: self.even,
            flipped: self.flipped,
            edge: Some(edge.index()),
            object: document.object_of(id),
        };
        self.modal.show(document, command.into())
    }

    /// The first click cuts in the middle; from now on the pointer slides.
    fn begin_to_slide(&mut self, document: &mut Document, hands: Hands, view: &ToolView) -> ToolState {
        let Some((id, edge)) = self.hovered else {
            return self.modal.refuse("there is no quad under the pointer");
        };
        let to_world = document.mesh_transform(id);
        let way = document.mesh(id).and_then(|mesh| {
            let ends = mesh.edge_vertices(edge).map(|end| view.screen(placed(mesh, end, &to_world)));
            Some(ends[1]? - ends[0]?)
        });
        self.modal = Modal::new(hands, NumericEntry::new(Quantity::Factor, 1));
        self.cut(document);
        if document.previewed().is_some() {
            self.sliding = Some(way.unwrap_or(DVec2::ZERO));
            self.lines.clear();
        }
        ToolState::Running
    }
}

/// The side of a face that is drawn nearest to a position in the image.
fn nearest_side(
    document: &Document,
    view: &ToolView,
    id: MeshId,
    face: FaceId,
    point: DVec2,
) -> Option<EdgeId> {
    let mesh = document.mesh(id).filter(|mesh| mesh.has_face(face))?;
    let to_world = document.mesh_transform(id);
    let drawn = mesh.face_edges(face).filter_map(|edge| {
        let [a, b] = mesh.edge_vertices(edge).map(|end| view.screen(placed(mesh, end, &to_world)));
        Some((distance_to_segment(point, a?, b?), edge))
    });
    drawn.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, edge)| edge)
}

fn distance_to_segment(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    let nearest = if along.is_finite() { a + (b - a) * along } else { a };
    nearest.distance(point)
}

/// The lines that cuts across the ring of an edge would make, in the world.
fn ring_lines(mesh: &EditMesh, edge: EdgeId, cuts: u32, to_world: &DAffine3) -> Vec<[DVec3; 2]> {
    let mut ring = edge_ring(mesh, edge);
    ring.sort_unstable();
    let is_cut = |edge: EdgeId| ring.binary_search(&edge).is_ok();
    let mut lines = Vec::new();
    for face in face_loop(mesh, edge) {
        let corners: Vec<_> = mesh.face_corners(face).collect();
        let corner_points: Vec<DVec3> =
            corners.iter().map(|&corner| placed(mesh, mesh.corner_vertex(corner), to_world)).collect();
        for side in 0..2 {
            if !is_cut(mesh.corner_edge(corners[side])) || !is_cut(mesh.corner_edge(corners[side + 2])) {
                continue;
            }
            let point = |index: usize| corner_points[(side + index) % 4];
            lines.extend((1..=cuts).map(|cut| {
                let t = f64::from(cut) / f64::from(cuts + 1);
                [point(0).lerp(point(1), t), point(3).lerp(point(2), t)]
            }));
        }
    }
    lines
}

impl FaceTool for LoopCutTool {
    /// Until a click has cut.
    fn wants_face(&self) -> bool {
        self.sliding.is_none()
    }

    /// The ring of the side that is nearest to the pointer is shown. `None` shows nothing.
    fn hover(&mut self, document: &Document, view: &ToolView, face: Option<(MeshId, FaceId)>) {
        if self.sliding.is_some() {
            return;
        }
        let point = self.modal.pointer.in_window().unwrap_or_default();
        self.hovered = face.and_then(|(id, face)| Some((id, nearest_side(document, view, id, face, point)?)));
        self.show_ring(document);
    }
}

impl Tool for LoopCutTool {
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState {
        // The right button ends the slide in the middle, as in Blender; Escape takes all back.
        if self.sliding.is_some() && *input == Input::Pressed(PointerButton::Right) {
            self.position = 0.0;
            self.cut(document);
            return Modal::confirm(document);
        }
        match self.modal.step(input, hands) {
            Step::Update => self.update(document),
            Step::Confirm if self.sliding.is_none() => self.begin_to_slide(document, hands, view),
            Step::Confirm => Modal::confirm(document),
            Step::Cancel => Modal::cancel(document),
            Step::Key('e') => {
                self.even = !self.even;
                self.update(document)
            }
            Step::Key('f') => {
                self.flipped = !self.flipped;
                self.update(document)
            }
            Step::Wheel(lines) if self.sliding.is_none() => {
                self.set_cuts(f64::from(self.cuts) + lines, document);
                ToolState::Running
            }
            _ => ToolState::Running,
        }
    }

    fn status(&self) -> String {
        let typed = self.modal.typed();
        self.modal.status(match self.sliding {
            None => format!("Loop Cut: {} {typed} Wheel or digits: how many, then click and move to slide", self.cuts),
            Some(_) => format!(
                "Loop Cut: slide {:.4} {typed} E: even ({}), F: from the other side ({}), right button: in the \
                 middle",
                self.position,
                on(self.even),
                on(self.flipped),
            ),
        })
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }

    fn marks(&self) -> ToolMarks {
        ToolMarks { lines: self.lines.clone(), ..ToolMarks::default() }
    }
}
