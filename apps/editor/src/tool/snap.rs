//! Snapping to increments, to the grid, and to vertices, edges and faces of elements that do not move with
//! the selection.

use trigon_document::mesh::Mesh;
use trigon_document::mesh::math::{DAffine3, DMat3, DVec2, DVec3, Vec3};
use trigon_document::modelling::{EditMesh, VertexId};
use trigon_document::scene::Node;
use trigon_document::scene::camera::Ray;
use trigon_document::{Document, Selection};

use super::selected::Selected;
use super::view::ToolView;

/// To what a movement snaps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SnapTarget {
    /// Steps from where it started.
    #[default]
    Increment,
    /// Places on the grid.
    Grid,
    /// The nearest vertex in the image.
    Vertex,
    /// The nearest edge in the image.
    Edge,
    /// The face under the pointer.
    Face,
}

/// The point of the selection that is moved onto the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SnapSource {
    /// The one nearest to the target.
    #[default]
    Closest,
    /// The middle of the box around the selection.
    Center,
    /// The mean.
    Median,
    /// What was selected last.
    Active,
}

/// How tools snap. Ctrl inverts whether they do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SnapSettings {
    /// Whether they snap without Ctrl.
    pub(crate) is_on: bool,
    pub(crate) target: SnapTarget,
    pub(crate) source: SnapSource,
    /// Steps of moves, in metres; also those of the grid.
    pub(crate) step: f64,
    /// Steps of turns, in degrees.
    pub(crate) angle: f64,
    /// Steps of scales.
    pub(crate) factor: f64,
    /// Whether what faces hide is snapped to: X-ray.
    pub(crate) through: bool,
}

impl Default for SnapSettings {
    fn default() -> Self {
        let (target, source) = (SnapTarget::default(), SnapSource::default());
        Self { is_on: false, target, source, step: 1.0, angle: 5.0, factor: 0.1, through: false }
    }
}

/// With Shift a step is divided in so many.
const FINER: f64 = 10.0;
/// The same of turns: from 5° to 1°.
const FINER_ANGLE: f64 = 5.0;

impl SnapSettings {
    /// The step of moves.
    pub(crate) fn length_step(&self, is_precise: bool) -> f64 {
        if is_precise { self.step / FINER } else { self.step }
    }

    /// The step of turns, in degrees.
    pub(crate) fn angle_step(&self, is_precise: bool) -> f64 {
        if is_precise { self.angle / FINER_ANGLE } else { self.angle }
    }

    /// The step of scales.
    pub(crate) fn factor_step(&self, is_precise: bool) -> f64 {
        if is_precise { self.factor / FINER } else { self.factor }
    }
}

/// The nearest multiple of a step; the value itself where the step is none.
pub(crate) fn rounded(value: f64, step: f64) -> f64 {
    let rounded = (value / step).round() * step;
    if rounded.is_finite() { rounded } else { value }
}

/// The same along axes of unit length at right angles.
pub(crate) fn rounded_along(value: DVec3, axes: &DMat3, step: f64) -> DVec3 {
    let inverse = axes.transpose();
    let parts = inverse * value;
    *axes * DVec3::new(rounded(parts.x, step), rounded(parts.y, step), rounded(parts.z, step))
}

impl SnapSource {
    /// The point of a selection, as it started, that is to lie on a target; `offset` is how far it would move
    /// without snapping.
    pub(crate) fn point(self, selected: &Selected, offset: DVec3, target: DVec3) -> DVec3 {
        let distance = |point: &&DVec3| (**point + offset).distance_squared(target);
        let closest = || selected.points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        match self {
            Self::Closest => closest().copied().unwrap_or_else(|| selected.median()),
            Self::Center => selected.bounds_center(),
            Self::Median => selected.median(),
            Self::Active => selected.active.unwrap_or_else(|| selected.median()),
        }
    }
}

/// The selected point that is drawn nearest to a position, if one is within a distance in pixels.
pub(crate) fn nearest_on_screen(
    points: &[DVec3],
    screen: impl Fn(DVec3) -> Option<DVec2>,
    position: DVec2,
    within: f64,
) -> Option<DVec3> {
    let drawn = points.iter().filter_map(|&point| Some((screen(point)?.distance(position), point)));
    let nearest = drawn.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (nearest.0 <= within).then_some(nearest.1)
}

/// Elements that stay, in the world. They are looked through at each move, so a search takes time in
/// proportion to all that is visible.
#[derive(Debug, Clone, Default)]
pub(crate) struct SnapTargets {
    vertices: Vec<DVec3>,
    edges: Vec<[DVec3; 2]>,
    faces: Vec<Vec<DVec3>>,
}

/// A point of an element, and the ends of the edge on which it lies, or itself twice.
struct Candidate {
    point: DVec3,
    ends: [DVec3; 2],
}

/// For this many of the nearest elements, hidden ones are excluded, which tests every face.
const MOST_TRIED: usize = 8;

/// An element is found when it is drawn within so many logical pixels of the pointer.
const REACH: f64 = 20.0;

impl SnapTargets {
    /// All that is visible and not selected.
    pub(crate) fn of(document: &Document) -> Self {
        Self::without(document, Some(document.selection()))
    }

    /// All that is visible.
    pub(crate) fn all(document: &Document) -> Self {
        Self::without(document, None)
    }

    fn without(document: &Document, selection: Option<&Selection>) -> Self {
        let scene = document.nodes();
        let mut targets = Self::default();
        let placements = scene.visible_transforms();
        let moves = |above| selection.is_some_and(|all| !all.is_editing() && all.objects.contains(&above));
        for (object, node) in scene.nodes().iter().filter(|&(object, _)| !scene.ancestors(object).any(moves))
        {
            if let Some(Some(placement)) = placements.get(object.index()) {
                targets.add_object(document, node, selection, placement);
            }
        }
        targets
    }

    fn add_object(
        &mut self,
        document: &Document,
        node: &Node,
        selection: Option<&Selection>,
        placement: &DAffine3,
    ) {
        let Some(id) = node.mesh else { return };
        if let Some(mesh) = document.mesh(id) {
            let moving =
                selection.and_then(|all| Some(all.of(id)?.vertices(mesh, all.kind()))).unwrap_or_default();
            self.add_edited(mesh, &moving, placement);
        } else if let Some(asset) = document.nodes().meshes().get(id) {
            self.add_mesh(asset.mesh(), placement);
        }
    }

    /// Without what has a vertex that moves.
    fn add_edited(&mut self, mesh: &EditMesh, moving: &[VertexId], placement: &DAffine3) {
        let stays = |vertex| moving.binary_search(&vertex).is_err();
        let pixel = |vertex| in_world(mesh.position(vertex), placement);
        let visible = mesh.vertices().filter(|&vertex| !mesh.is_vertex_hidden(vertex) && stays(vertex));
        self.vertices.extend(visible.map(pixel));
        let edges =
            mesh.edges().filter(|&edge| !mesh.is_edge_hidden(edge)).map(|edge| mesh.edge_vertices(edge));
        self.edges
            .extend(edges.filter(|ends| ends.iter().all(|&end| stays(end))).map(|ends| ends.map(pixel)));
        for face in mesh.faces().filter(|&face| !mesh.is_face_hidden(face)) {
            if mesh.face_vertices(face).all(stays) {
                self.faces.push(mesh.face_vertices(face).map(pixel).collect());
            }
        }
    }

    fn add_mesh(&mut self, mesh: &Mesh, placement: &DAffine3) {
        let pixel = |vertex: &u32| in_world(mesh.positions()[*vertex as usize], placement);
        self.vertices.extend(mesh.positions().iter().map(|&position| in_world(position, placement)));
        self.edges.extend(mesh.edges().iter().map(|ends| [pixel(&ends[0]), pixel(&ends[1])]));
        let faces = 0..mesh.face_count();
        self.faces.extend(faces.map(|face| mesh.face_vertices(face).iter().map(pixel).collect::<Vec<_>>()));
    }

    /// The point of a target that is nearest to a position in the image; `None` if none is near. Points that
    /// faces hide are excluded unless `through` is set.
    pub(crate) fn find(
        &self,
        target: SnapTarget,
        view: &ToolView,
        pixel: DVec2,
        through: bool,
    ) -> Option<DVec3> {
        let points: Vec<Candidate> = match target {
            SnapTarget::Vertex => {
                self.vertices.iter().map(|&point| Candidate { point, ends: [point; 2] }).collect()
            }
            SnapTarget::Edge => {
                let nearest = |&ends| Some(Candidate { point: nearest_on_edge(view, ends, pixel)?, ends });
                self.edges.iter().filter_map(nearest).collect()
            }
            SnapTarget::Face => return self.face_under(view, pixel),
            SnapTarget::Increment | SnapTarget::Grid => return None,
        };
        let projector = view.projector();
        let distance = |point| Some(projector.to_screen(point)?.distance(pixel));
        let near = points.into_iter().filter_map(|candidate| Some((distance(candidate.point)?, candidate)));
        let mut near: Vec<_> = near.filter(|(distance, _)| *distance <= REACH * view.scale).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut candidates = near.into_iter().take(MOST_TRIED).map(|(_, candidate)| candidate);
        candidates.find(|candidate| through || !self.hides(view, candidate)).map(|candidate| candidate.point)
    }

    /// Whether a face lies before a point.
    fn hides(&self, view: &ToolView, Candidate { point, ends }: &Candidate) -> bool {
        /// Of the distance: a face that the point lies on is met as far away, but for roundings.
        const SAME: f64 = 1e-6;
        let Some(pixel) = view.screen(*point) else { return true };
        let Some(ray) = view.projector().ray(pixel) else { return true };
        let distance = (*point - ray.origin).dot(ray.direction) / ray.direction.length_squared();
        // Faces at the element itself do not hide it, however bent they are.
        let others = self.faces.iter().filter(|face| !ends.iter().all(|end| face.contains(end)));
        others
            .filter_map(|face| distance_to_face(view, pixel, &ray, face))
            .any(|hit| hit < distance * (1.0 - SAME))
    }

    fn face_under(&self, view: &ToolView, pixel: DVec2) -> Option<DVec3> {
        let ray = view.projector().ray(pixel)?;
        let hits = self.faces.iter().filter_map(|face| distance_to_face(view, pixel, &ray, face));
        hits.min_by(f64::total_cmp).map(|distance| ray.at(distance))
    }
}

/// The distance along the ray through a position in the image to the face that is visible there.
fn distance_to_face(view: &ToolView, pixel: DVec2, ray: &Ray, face: &[DVec3]) -> Option<f64> {
    let outline: Option<Vec<DVec2>> = face.iter().map(|&corner| view.screen(corner)).collect();
    if !contains(&outline?, pixel) {
        return None;
    }
    // Its area vector (M. E. Newell's method) is that of a plane also where a face is bent.
    let center = face.iter().sum::<DVec3>() / face.len() as f64;
    let next = face.iter().cycle().skip(1);
    let normal: DVec3 = face.iter().zip(next).map(|(a, b)| (*a - center).cross(*b - center)).sum();
    let distance = (center - ray.origin).dot(normal) / ray.direction.dot(normal);
    (distance > 0.0 && distance.is_finite()).then_some(distance)
}

fn in_world(position: Vec3, placement: &DAffine3) -> DVec3 {
    placement.transform_point3(position.as_dvec3())
}

/// The point of an edge that is drawn nearest to a position: where the pointer's ray passes it.
fn nearest_on_edge(view: &ToolView, [start, end]: [DVec3; 2], pixel: DVec2) -> Option<DVec3> {
    let (from, to) = (view.screen(start)?, view.screen(end)?);
    let (length, way) = (from.distance(to), end - start);
    if length == 0.0 {
        return Some(start);
    }
    let axis = way.try_normalize()?;
    // Onto the edge in the image first, so that the ray there passes the edge itself.
    let along = ((pixel - from).dot(to - from) / (length * length)).clamp(0.0, 1.0);
    let distance = view.dragged_along(start, axis, (to - from) * along);
    Some(start + axis * distance.clamp(0.0, way.length()))
}

/// Whether a polygon contains a point, by the even-odd rule.
fn contains(outline: &[DVec2], point: DVec2) -> bool {
    let next = outline.iter().cycle().skip(1);
    let crossings = outline.iter().zip(next).filter(|(a, b)| {
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossings.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::view::tests::front;
    use proptest::prelude::*;
    use trigon_document::mesh::primitives;
    use trigon_document::scene::{Material, Scene};

    #[test]
    fn values_round_to_steps() {
        assert_eq!(rounded(1.4, 1.0), 1.0, "down");
        assert_eq!(rounded(-1.6, 1.0), -2.0, "away from zero");
        assert_eq!(rounded(0.3, 0.0), 0.3, "no step");
        let turned = DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z);
        assert_eq!(rounded_along(DVec3::new(0.4, 1.6, 0.0), &turned, 1.0), DVec3::Y * 2.0, "in other axes");
    }

    #[test]
    fn shift_makes_steps_finer() {
        let settings = SnapSettings::default();
        assert_eq!((settings.length_step(false), settings.length_step(true)), (1.0, 0.1), "moves");
        assert_eq!((settings.angle_step(false), settings.angle_step(true)), (5.0, 1.0), "turns");
        assert_eq!((settings.factor_step(false), settings.factor_step(true)), (0.1, 0.01), "scales");
    }

    #[test]
    fn sources_are_points_of_the_selection() {
        let selected = Selected {
            points: vec![DVec3::ZERO, DVec3::ZERO, DVec3::X * 6.0],
            active: None,
            origin: DVec3::ZERO,
            local: DMat3::IDENTITY,
            normal: DMat3::IDENTITY,
            is_editing: true,
        };
        let source = |source: SnapSource| source.point(&selected, DVec3::X, DVec3::X * 5.0).x;
        assert_eq!(source(SnapSource::Closest), 6.0, "7 is nearer to 5 than 1");
        assert_eq!((source(SnapSource::Center), source(SnapSource::Median)), (3.0, 2.0), "middles");
        assert_eq!(source(SnapSource::Active), 2.0, "the median without an active one");
    }

    proptest! {
        #[test]
        fn rounding_goes_at_most_half_a_step(value in -1e3f64..1e3, step in 0.01f64..10.0) {
            prop_assert!((rounded(value, step) - value).abs() <= step * 0.5 + 1e-9);
        }
    }

    /// A cube of 2 m around the origin; a pixel is 1 cm wide, and the origin at (400, 300).
    fn cube() -> SnapTargets {
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(2.0), Material::default());
        SnapTargets::of(&Document::new(scene))
    }

    #[test]
    fn what_is_near_the_pointer_is_found() {
        let (targets, view) = (cube(), front());
        let find = |target, x, y| targets.find(target, &view, DVec2::new(x, y), false);
        let corner = find(SnapTarget::Vertex, 495.0, 205.0).expect("near (1, 1)");
        assert_eq!(corner.truncate(), DVec2::ONE, "the corner at (500, 200)");
        assert_eq!(find(SnapTarget::Vertex, 450.0, 250.0), None, "none is near");
        let edge = find(SnapTarget::Edge, 495.0, 250.0).expect("near x = 1");
        assert!(edge.truncate().abs_diff_eq(DVec2::new(1.0, 0.5), 1e-9), "{edge}");
        let face = find(SnapTarget::Face, 420.0, 280.0).expect("the front");
        assert!(face.abs_diff_eq(DVec3::new(0.2, 0.2, 1.0), 1e-9), "{face}, the nearer one of two");
        assert_eq!(find(SnapTarget::Face, 700.0, 280.0), None, "beside it");
    }

    #[test]
    fn what_faces_hide_is_found_in_x_ray_only() {
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(2.0), Material::default());
        scene.add_object("inside", primitives::grid(1.0, 1.0, 1, 1), Material::default());
        let (targets, view) = (SnapTargets::of(&Document::new(scene)), front());
        for target in [SnapTarget::Vertex, SnapTarget::Edge] {
            let find = |through| targets.find(target, &view, DVec2::new(450.0, 302.0), through);
            assert_eq!(find(false), None, "{target:?}: the cube is before it");
            assert_eq!(find(true).map(|point| point.x), Some(0.5), "{target:?}: through the cube");
        }
    }
}
