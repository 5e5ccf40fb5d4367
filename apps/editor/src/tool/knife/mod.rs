//! K: clicks on vertices, edges and faces draw a cut, which runs straight across the faces between them, or with C
//! through all faces in the line of sight. E begins another stroke, A holds lines to angles, and X, Y or Z to an axis.

mod aim;
mod surface;

use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_document::modelling::{FaceId, KnifePoint};
use trigon_document::scene::MeshId;
use trigon_document::{Document, Knife, PathPoint};
use trigon_window::{Hands, Input, Key, Modifiers, PointerButton};

use self::aim::{AngleSnap, along, at_angle_steps};
use self::surface::{RADIUS, Surface};
use super::constraint::Axis;
use super::expression::Quantity;
use super::modal::{FaceTool, Modal, Step};
use super::numeric::NumericEntry;
use super::view::ToolView;
use super::{Tool, ToolMarks, ToolState};

/// A cut that is drawn.
#[derive(Debug)]
pub(crate) struct KnifeTool {
    modal: Modal,
    /// The mesh that is cut: that of the first point.
    mesh: Option<MeshId>,
    /// The last one is being drawn; there is always one.
    strokes: Vec<Stroke>,
    /// Whether new lines cut all faces in the line of sight.
    cuts_through: bool,
    angles: AngleSnap,
    axis: Option<Axis>,
    /// What a click would add.
    hovered: Option<(MeshId, KnifePoint)>,
    /// The way there over the surface, if it can be reached.
    to_hovered: Option<Vec<KnifePoint>>,
    lines: Vec<[DVec3; 2]>,
    mark: Option<DVec3>,
}

/// Lines that follow each other.
#[derive(Debug, Clone, Default)]
struct Stroke {
    /// What was clicked.
    points: Vec<KnifePoint>,
    /// For each point but the first what the line to it cuts: paths of points.
    cuts: Vec<Vec<Vec<KnifePoint>>>,
}

impl KnifeTool {
    /// Starts in edit mode.
    pub(crate) fn start(document: &Document, hands: Hands) -> Option<Self> {
        document.selection().is_editing().then(|| Self {
            modal: Modal::new(hands, NumericEntry::new(Quantity::Factor, 1)),
            mesh: None,
            strokes: vec![Stroke::default()],
            cuts_through: false,
            angles: AngleSnap::default(),
            axis: None,
            hovered: None,
            to_hovered: None,
            lines: Vec::new(),
            mark: None,
        })
    }

    fn points(&self) -> impl DoubleEndedIterator<Item = KnifePoint> + '_ {
        self.strokes.iter().flat_map(|stroke| stroke.points.iter().copied())
    }

    /// The last point of the stroke that is being drawn.
    fn last(&self) -> Option<KnifePoint> {
        self.strokes.last().and_then(|stroke| stroke.points.last().copied())
    }

    /// A click: the hovered point is added.
    fn add(&mut self, document: &Document, view: &ToolView) -> ToolState {
        let Some((id, point)) = self.hovered else {
            return self.modal.refuse("there is no face under the pointer");
        };
        if self.mesh.is_some_and(|own| own != id) {
            return self.modal.refuse("a cut stays in one object");
        }
        let cut = match (self.last(), self.cuts_through) {
            (None, _) => None,
            (Some(last), true) => Some(through(document, view, id, [last, point])),
            (Some(_), false) => match self.to_hovered.take() {
                Some(path) => Some(vec![path]),
                None => {
                    let text =
                        "the line leaves the surface: click on edges in between, or cut through with C";
                    return self.modal.refuse(text);
                }
            },
        };
        self.mesh = Some(id);
        if let Some(stroke) = self.strokes.last_mut() {
            stroke.cuts.extend(cut);
            stroke.points.push(point);
        }
        self.modal.clear_refusal();
        self.draw(document);
        ToolState::Running
    }

    /// The next click begins another stroke.
    fn begin_stroke(&mut self, document: &Document) -> ToolState {
        if self.last().is_some() {
            self.strokes.push(Stroke::default());
            self.to_hovered = None;
        }
        self.draw(document);
        ToolState::Running
    }

    /// Takes the last point back; the last of them all ends the tool.
    fn take_back(&mut self, document: &mut Document) -> ToolState {
        if self.last().is_none() && self.strokes.len() > 1 {
            self.strokes.pop();
        }
        let Some(stroke) = self.strokes.last_mut().filter(|stroke| !stroke.points.is_empty()) else {
            return Modal::cancel(document);
        };
        stroke.points.pop();
        stroke.cuts.pop();
        if self.points().next().is_none() {
            self.mesh = None;
        }
        self.draw(document);
        ToolState::Running
    }

    fn cut(&mut self, document: &mut Document) -> ToolState {
        let cuts = self.strokes.iter().flat_map(|stroke| stroke.cuts.iter().flatten());
        let strokes: Vec<Vec<PathPoint>> =
            cuts.map(|path| path.iter().copied().map(path_point).collect()).collect();
        if strokes.is_empty() {
            return self.modal.refuse("a cut goes from edge to edge, or closes: click at least two points");
        }
        let object = self.mesh.and_then(|mesh| document.object_of(mesh));
        self.modal.show(document, Knife { object, strokes }.into());
        if document.previewed().is_some() { Modal::confirm(document) } else { ToolState::Running }
    }

    /// Where a point is in the world.
    fn position(&self, document: &Document, point: KnifePoint) -> Option<DVec3> {
        let id = self.mesh?;
        let position = document.mesh(id)?.knife_position(point);
        Some(document.mesh_transform(id).transform_point3(position))
    }

    fn on_screen(&self, document: &Document, view: &ToolView, point: KnifePoint) -> Option<DVec2> {
        view.screen(self.position(document, point)?)
    }

    /// The point of the cut that is drawn near a position: lines close there, and strokes meet.
    fn own_point(&self, document: &Document, view: &ToolView, at: DVec2) -> Option<KnifePoint> {
        let near = self.points().filter_map(|point| {
            let distance = self.on_screen(document, view, point)?.distance(at);
            (distance <= RADIUS * view.scale && Some(point) != self.last()).then_some((distance, point))
        });
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, point)| point)
    }

    /// The lines of the cut so far, and to the pointer.
    fn draw(&mut self, document: &Document) {
        let id = self.mesh.or(self.hovered.map(|(id, _)| id));
        let Some((id, mesh)) = id.and_then(|id| Some((id, document.mesh(id)?))) else {
            (self.lines, self.mark) = (Vec::new(), None);
            return;
        };
        let to_world = document.mesh_transform(id);
        let at = |point: &KnifePoint| to_world.transform_point3(mesh.knife_position(*point));
        let mut paths: Vec<&[KnifePoint]> = Vec::new();
        for stroke in &self.strokes {
            paths.push(&stroke.points);
            paths.extend(stroke.cuts.iter().flatten().map(Vec::as_slice));
        }
        paths.extend(self.to_hovered.as_deref());
        let lines = paths.into_iter().flat_map(|path| path.windows(2));
        self.lines = lines.map(|pair| [at(&pair[0]), at(&pair[1])]).collect();
        self.mark = self.hovered.filter(|(of, _)| *of == id).map(|(_, point)| at(&point));
    }
}

/// What a line between two points cuts through.
fn through(document: &Document, view: &ToolView, id: MeshId, ends: [KnifePoint; 2]) -> Vec<Vec<KnifePoint>> {
    let Some(mesh) = document.mesh(id) else { return Vec::new() };
    let surface = Surface { mesh, to_world: document.mesh_transform(id), view };
    let Some(line) = surface.line(ends) else { return Vec::new() };
    let faces: Vec<FaceId> = mesh.faces().filter(|&face| !mesh.is_face_hidden(face)).collect();
    mesh.knife_through(&faces, &line)
}

fn path_point(point: KnifePoint) -> PathPoint {
    match point {
        KnifePoint::Vertex(vertex) => PathPoint::Vertex { vertex: vertex.index() },
        KnifePoint::Edge(edge, position) => PathPoint::Edge { edge: edge.index(), position },
        KnifePoint::Face(face, position) => {
            PathPoint::Face { face: face.index(), position: position.to_array() }
        }
    }
}

impl FaceTool for KnifeTool {
    fn wants_face(&self) -> bool {
        true
    }

    fn reach(&self) -> f64 {
        RADIUS
    }

    /// On a line from the last point, if lines are held to angles or an axis.
    fn aim(&self, document: &Document, view: &ToolView) -> Option<DVec2> {
        let pointer = self.modal.pointer.in_window()?;
        let held = || {
            let at = self.on_screen(document, view, self.last()?)?;
            if let Some(axis) = self.axis {
                let last = self.position(document, self.last()?)?;
                let step = view.up.axes().col(axis.index()) * view.metres_per_pixel(last);
                return Some(along(at, view.screen(last + step)? - at, pointer));
            }
            let level = DVec2::X;
            Some(match self.angles {
                AngleSnap::Free => pointer,
                AngleSnap::Screen => at_angle_steps(at, level, pointer),
                AngleSnap::Previous => {
                    let before = self.strokes.last()?.points.iter().rev().nth(1);
                    let before = before.and_then(|&point| self.on_screen(document, view, point));
                    at_angle_steps(at, before.map_or(level, |before| at - before), pointer)
                }
            })
        };
        Some(held().unwrap_or(pointer))
    }

    fn hover(&mut self, document: &Document, view: &ToolView, face: Option<(MeshId, FaceId)>) {
        let at = self.aim(document, view).unwrap_or_default();
        let in_middle = self.modal.modifiers().contains(Modifiers::SHIFT);
        self.hovered = face.and_then(|(id, face)| {
            let own = self.own_point(document, view, at).filter(|_| !in_middle && self.mesh == Some(id));
            if let Some(point) = own {
                return Some((id, point));
            }
            let mesh = document.mesh(id).filter(|mesh| mesh.has_face(face))?;
            let surface = Surface { mesh, to_world: document.mesh_transform(id), view };
            Some((id, surface.point_at(face, at, in_middle)?))
        });
        self.to_hovered = self.last().zip(self.hovered).and_then(|(from, (id, to))| {
            let mesh = document.mesh(id).filter(|_| self.mesh == Some(id))?;
            if self.cuts_through {
                return Some(vec![from, to]);
            }
            let surface = Surface { mesh, to_world: document.mesh_transform(id), view };
            let crossings = mesh.knife_line([from, to], &surface.line([from, to])?)?;
            Some([from].into_iter().chain(crossings).chain([to]).collect())
        });
        self.draw(document);
    }
}

impl Tool for KnifeTool {
    fn input(&mut self, input: &Input, hands: Hands, view: &ToolView, document: &mut Document) -> ToolState {
        let takes_back = |key: &Key| {
            let undoes = *key == Key::Character('z') && hands.modifiers.contains(Modifiers::CTRL);
            *key == Key::Backspace || undoes
        };
        match input {
            Input::Key { logical: Some(key), .. } if takes_back(key) => return self.take_back(document),
            Input::Pressed(PointerButton::Left) if !hands.modifiers.contains(Modifiers::ALT) => {
                return self.add(document, view);
            }
            _ => {}
        }
        match self.modal.step(input, hands) {
            Step::Confirm => return self.cut(document),
            Step::Cancel => return Modal::cancel(document),
            Step::Key('e') => return self.begin_stroke(document),
            Step::Key('c') => self.cuts_through = !self.cuts_through,
            Step::Key('a') => (self.angles, self.axis) = (self.angles.next(), None),
            Step::Key(key) => {
                if let Some(axis) = Axis::of_key(key) {
                    self.axis = (self.axis != Some(axis)).then_some(axis);
                }
            }
            _ => {}
        }
        ToolState::Running
    }

    fn status(&self) -> String {
        let held = match self.axis {
            Some(axis) => format!(" along {}", axis.letter()),
            None => self.angles.status().to_owned(),
        };
        let through = if self.cuts_through { ", cutting through" } else { "" };
        let text = format!(
            "Knife, points: {}{held}{through}. Click: add, Shift: middle of an edge, E: new stroke, C: cut through, \
             A: angles, X/Y/Z: axis, Backspace: take back, Enter: cut",
            self.points().count()
        );
        self.modal.explained(text)
    }

    fn modal(&mut self) -> &mut Modal {
        &mut self.modal
    }

    fn marks(&self) -> ToolMarks {
        ToolMarks { lines: self.lines.clone(), point: self.mark, ..ToolMarks::default() }
    }
}
