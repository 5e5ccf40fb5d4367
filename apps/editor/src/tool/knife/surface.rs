//! What the knife meets where the pointer is, and lines over a surface as they are seen.

use trigon_document::mesh::math::{DAffine3, DVec2, DVec3};
use trigon_document::modelling::{EditMesh, FaceId, KnifePoint, ProjectedLine, Sight};
use trigon_document::scene::camera::{Projector, Ray};

use super::super::selected::placed;
use super::super::view::ToolView;

/// How near a vertex or an edge has to be, in logical pixels.
pub(super) const RADIUS: f64 = 10.0;

/// A mesh as it is seen.
pub(super) struct Surface<'m> {
    pub(super) mesh: &'m EditMesh,
    pub(super) to_world: DAffine3,
    pub(super) view: &'m ToolView,
}

impl Surface<'_> {
    /// A vertex of a face near the pointer, or else a point of an edge, or else of the face.
    pub(super) fn point_at(&self, face: FaceId, at: DVec2, in_middle: bool) -> Option<KnifePoint> {
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
    pub(super) fn line(&self, points: [KnifePoint; 2]) -> Option<ViewLine> {
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
pub(super) struct ViewLine {
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
