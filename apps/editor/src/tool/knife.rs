//! K: clicks on vertices, edges and faces draw a cut, which runs straight across the faces between them.

use trigon_document::mesh::math::{DAffine3, DVec2, DVec3};
use trigon_document::modelling::{EditMesh, FaceId, KnifePoint, ProjectedLine, Sight};
use trigon_document::scene::MeshId;
use trigon_document::scene::camera::{Projector, Ray};
use trigon_document::{Document, Knife, PathPoint};
use trigon_window::{Hands, Input, Key, Modifiers, PointerButton};

use super::expression::Quantity;
use super::modal::{FaceTool, Modal, Step};
use super::numeric::NumericEntry;
use super::selected::placed;
use super::view::ToolView;
use super::{Tool, ToolMarks, ToolState};

/// How near a vertex or an edge has to be, in logical pixels.
const RADIUS: f64 = 10.0;

/// A cut that is drawn.
#[derive(Debug)]
pub(crate) struct KnifeTool {
    modal: Modal,
    /// The mesh that is cut: that of the first point.
    mesh: Option<MeshId>,
    /// What was clicked, and for each point but the first the crossings before it.
    points: Vec<KnifePoint>,
    between: Vec<Vec<KnifePoint>>,
    /// What a click would add.
    hovered: Option<(MeshId, KnifePoint)>,
    /// The crossings before that, if it can be reached.
    to_hovered: Option<Vec<KnifePoint>>,
    lines: Vec<[DVec3; 2]>,
    mark: Option<DVec3>,
}

impl KnifeTool {
    /// Starts in edit mode.
    pub(crate) fn start(document: &Document, hands: Hands) -> Option<Self> {
        document.selection().is_editing().then(|| Self {
            modal: Modal::new(hands, NumericEntry::new(Quantity::Factor, 1)),
            mesh: None,
            points: Vec::new(),
            between: Vec::new(),
            hovered: None,
            to_hovered: None,
            lines: Vec::new(),
            mark: None,
        })
    }

    /// A click: the hovered point is added.
    fn add(&mut self, document: &Document) -> ToolState {
        let Some((mesh, point)) = self.hovered else {
            return self.modal.refuse("there is no face under the pointer");
        };
        if self.mesh.is_some_and(|own| own != mesh) {
            return self.modal.refuse("a cut stays in one object");
        }
        if !self.points.is_empty() {
            let Some(crossings) = self.to_hovered.take() else {
                return self.modal.refuse("the line leaves the surface: click on edges in between");
            };
            self.between.push(crossings);
        }
        self.mesh = Some(mesh);
        self.points.push(point);
        self.modal.clear_refusal();
        self.draw(document);
        ToolState::Running
    }

    /// Takes the last point back; the last of them all ends the tool.
    fn take_back(&mut self, document: &mut Document) -> ToolState {
        if self.points.pop().is_none() {
            return Modal::cancel(document);
        }
        self.between.pop();
        if self.points.is_empty() {
            self.mesh = None;
        }
        self.draw(document);
        ToolState::Running
    }

    /// All points of the cut, with the crossings between them.
    fn path(&self) -> Vec<KnifePoint> {
        let mut path: Vec<KnifePoint> = self.points.first().copied().into_iter().collect();
        for (crossings, point) in self.between.iter().zip(self.points.iter().skip(1)) {
            path.extend(crossings);
            path.push(*point);
        }
        path
    }

    fn cut(&mut self, document: &mut Document) -> ToolState {
        let is_within = |point: &KnifePoint| matches!(point, KnifePoint::Face(..));
        let mut path = self.path();
        // A cut that ends within a face would divide nothing there.
        let begin = path.iter().position(|point| !is_within(point)).unwrap_or(path.len());
        path.drain(..begin);
        while path.last().is_some_and(is_within) {
            path.pop();
        }
        if path.len() < 2 {
            let text = match self.points.len() {
                0 | 1 => "a cut goes from edge to edge: click at least two points",
                _ => "a cut begins and ends on edges or at vertices: click on one at each end",
            };
            return self.modal.refuse(text);
        }
        let object = self.mesh.and_then(|mesh| document.object_of(mesh));
        let strokes = vec![path.into_iter().map(path_point).collect()];
        self.modal.show(document, Knife { object, strokes }.into());
        if document.previewed().is_some() { Modal::confirm(document) } else { ToolState::Running }
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
        let mut path = self.path();
        if let (Some(crossings), Some((_, point))) = (&self.to_hovered, self.hovered) {
            path.extend(crossings);
            path.push(point);
        }
        self.lines = path.windows(2).map(|pair| [at(&pair[0]), at(&pair[1])]).collect();
        self.mark = self.hovered.filter(|(of, _)| *of == id).map(|(_, point)| at(&point));
    }
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

    fn hover(&mut self, document: &Document, view: &ToolView, face: Option<(MeshId, FaceId)>) {
        let at = self.modal.pointer.in_window().unwrap_or_default();
        let in_middle = self.modal.modifiers().contains(Modifiers::SHIFT);
        self.hovered = face.and_then(|(id, face)| {
            let mesh = document.mesh(id).filter(|mesh| mesh.has_face(face))?;
            let surface = Surface { mesh, to_world: document.mesh_transform(id), view };
            Some((id, surface.point_at(face, at, in_middle)?))
        });
        self.to_hovered = self.points.last().zip(self.hovered).and_then(|(&from, (id, to))| {
            let mesh = document.mesh(id).filter(|_| self.mesh == Some(id))?;
            let surface = Surface { mesh, to_world: document.mesh_transform(id), view };
            mesh.knife_line([from, to], &surface.line([from, to])?)
        });
        self.draw(document);
    }
}

/// A mesh as it is seen.
struct Surface<'m> {
    mesh: &'m EditMesh,
    to_world: DAffine3,
    view: &'m ToolView,
}

impl Surface<'_> {
    /// A vertex of a face near the pointer, or else a point of an edge, or else of the face.
    fn point_at(&self, face: FaceId, at: DVec2, in_middle: bool) -> Option<KnifePoint> {
        let radius = RADIUS * self.view.scale;
        let on_screen = |vertex| self.view.screen(placed(self.mesh, vertex, &self.to_world));
        let vertices = self
            .mesh
            .face_vertices(face)
            .filter_map(|vertex| Some((on_screen(vertex)?.distance(at), vertex)));
        let vertex = vertices.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(distance, _)| *distance <= radius);
        if let (Some((_, vertex)), false) = (vertex, in_middle) {
            return Some(KnifePoint::Vertex(vertex));
        }
        let ray = self.view.projector().ray(at)?;
        let edges = self.mesh.face_edges(face).filter_map(|edge| {
            let ends = self.mesh.edge_vertices(edge).map(|vertex| placed(self.mesh, vertex, &self.to_world));
            let share = if in_middle { 0.5 } else { nearest_share(ends, &ray) };
            let nearest = self.view.screen(ends[0].lerp(ends[1], share))?;
            Some((nearest.distance(at), KnifePoint::Edge(edge, share)))
        });
        let edge = edges.min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, point)) = edge.filter(|(distance, _)| in_middle || *distance <= radius) {
            return Some(point);
        }
        let outline: Vec<DVec2> = self.mesh.face_vertices(face).filter_map(on_screen).collect();
        if !contains(&outline, at) {
            return None;
        }
        let normal = self.to_world.matrix3.inverse().transpose() * self.mesh.face_area_vector(face);
        let first = self.mesh.face_vertices(face).next()?;
        let on_plane = placed(self.mesh, first, &self.to_world);
        let distance = normal.dot(on_plane - ray.origin) / normal.dot(ray.direction);
        let position = ray.origin + ray.direction * distance;
        let local = self.to_world.inverse().transform_point3(position);
        local.is_finite().then(|| KnifePoint::Face(face, local.as_vec3()))
    }

    /// The line between two points, as it is seen; `None` where one is not seen, or both in one position.
    fn line(&self, points: [KnifePoint; 2]) -> Option<ViewLine> {
        let world = points.map(|point| self.to_world.transform_point3(self.mesh.knife_position(point)));
        let projector = self.view.projector();
        let [from, to] = [projector.to_screen(world[0])?, projector.to_screen(world[1])?];
        let rays = [projector.ray(from)?, projector.ray(to)?];
        // Through both lines of sight, in parallel projection, too.
        let normal = rays[0].direction.cross(rays[1].origin + rays[1].direction - rays[0].origin);
        let to_world = self.to_world;
        let to_mesh = to_world.inverse();
        let sights = rays.map(|ray| Sight {
            origin: to_mesh.transform_point3(ray.origin),
            direction: to_mesh.transform_vector3(ray.direction),
        });
        (normal != DVec3::ZERO).then_some(ViewLine {
            projector,
            to_world,
            origin: rays[0].origin,
            normal,
            from,
            to,
            sights,
        })
    }
}

/// Whether a point lies in a polygon, by the even-odd rule.
fn contains(outline: &[DVec2], at: DVec2) -> bool {
    let sides = outline.iter().zip(outline.iter().cycle().skip(1));
    let crossed = sides.filter(|(from, to)| {
        let share = (at.y - from.y) / (to.y - from.y);
        (from.y > at.y) != (to.y > at.y) && from.x + share * (to.x - from.x) > at.x
    });
    crossed.count() % 2 == 1
}

/// The share of the way along an edge that is nearest to a ray.
fn nearest_share([a, b]: [DVec3; 2], ray: &Ray) -> f64 {
    let (along, sight) = (b - a, ray.direction.normalize_or_zero());
    let across = along - sight * along.dot(sight);
    let from_ray = a - ray.origin;
    let offset = from_ray - sight * from_ray.dot(sight);
    let share = -offset.dot(across) / across.length_squared();
    if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 }
}

/// A plane through two lines of sight.
struct ViewLine {
    projector: Projector,
    to_world: DAffine3,
    origin: DVec3,
    normal: DVec3,
    from: DVec2,
    to: DVec2,
    /// Through both ends, in the space of the mesh.
    sights: [Sight; 2],
}

impl ProjectedLine for ViewLine {
    fn side(&self, point: DVec3) -> f64 {
        self.normal.dot(self.to_world.transform_point3(point) - self.origin)
    }

    fn progress(&self, point: DVec3) -> f64 {
        let at = self.projector.to_screen(self.to_world.transform_point3(point));
        // What is behind the eye is not ahead.
        at.map_or(f64::NEG_INFINITY, |at| (at - self.from).dot(self.to - self.from))
    }

    fn sights(&self) -> [Sight; 2] {
        self.sights
    }
}

impl Tool for KnifeTool {
    fn input(&mut self, input: &Input, hands: Hands, _: &ToolView, document: &mut Document) -> ToolState {
        let takes_back = |key: &Key| {
            let undoes = *key == Key::Character('z') && hands.modifiers.contains(Modifiers::CTRL);
            *key == Key::Backspace || undoes
        };
        match input {
            Input::Key { logical: Some(key), .. } if takes_back(key) => return self.take_back(document),
            Input::Pressed(PointerButton::Left) if !hands.modifiers.contains(Modifiers::ALT) => {
                return self.add(document);
            }
            _ => {}
        }
        match self.modal.step(input, hands) {
            Step::Confirm => self.cut(document),
            Step::Cancel => Modal::cancel(document),
            _ => ToolState::Running,
        }
    }

    fn status(&self) -> String {
        let text = format!(
            "Knife, points: {}. Click: add, Shift: middle of an edge, Backspace: take back, Enter: cut",
            self.points.len()
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
