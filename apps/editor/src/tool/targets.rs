//! Snap targets: vertices, edges and faces that do not move with the selection.

use trigon_document::mesh::Mesh;
use trigon_document::mesh::math::{DAffine3, DVec2, DVec3, Vec3};
use trigon_document::modelling::EditMesh;
use trigon_document::scene::camera::Ray;
use trigon_document::scene::{Node, NodeId};
use trigon_document::{Document, ElementKind, MeshSelection};

use super::snap::SnapTarget;
use super::view::ToolView;

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
        let scene = document.nodes();
        let mut targets = Self::default();
        let placements = scene.visible_transforms();
        for (object, node) in scene.nodes().iter() {
            if let Some(Some(placement)) = placements.get(object.index()) {
                targets.add_object(document, object, node, placement);
            }
        }
        targets
    }

    fn add_object(&mut self, document: &Document, object: NodeId, node: &Node, placement: &DAffine3) {
        let selection = document.selection();
        let Some(id) = node.mesh else { return };
        let moves = |above: NodeId| selection.objects.contains(&above);
        if !selection.is_editing() && document.nodes().ancestors(object).any(moves) {
            return;
        }
        if let Some(mesh) = document.mesh(id) {
            self.add_edited(mesh, selection.of(id), selection.kind(), placement);
        } else if let Some(asset) = document.nodes().meshes().get(id) {
            self.add_mesh(asset.mesh(), placement);
        }
    }

    fn add_edited(
        &mut self,
        mesh: &EditMesh,
        selection: Option<&MeshSelection>,
        kind: ElementKind,
        placement: &DAffine3,
    ) {
        let moving = selection.map(|selection| selection.vertices(mesh, kind)).unwrap_or_default();
        let stays = |vertex| moving.binary_search(&vertex).is_err();
        let place = |vertex| in_world(mesh.position(vertex), placement);
        let visible = mesh.vertices().filter(|&vertex| !mesh.is_vertex_hidden(vertex) && stays(vertex));
        self.vertices.extend(visible.map(place));
        let edges =
            mesh.edges().filter(|&edge| !mesh.is_edge_hidden(edge)).map(|edge| mesh.edge_vertices(edge));
        self.edges
            .extend(edges.filter(|ends| ends.iter().all(|&end| stays(end))).map(|ends| ends.map(place)));
        for face in mesh.faces().filter(|&face| !mesh.is_face_hidden(face)) {
            if mesh.face_vertices(face).all(stays) {
                self.faces.push(mesh.face_vertices(face).map(place).collect());
            }
        }
    }

    fn add_mesh(&mut self, mesh: &Mesh, placement: &DAffine3) {
        let place = |vertex: &u32| in_world(mesh.positions()[*vertex as usize], placement);
        self.vertices.extend(mesh.positions().iter().map(|&position| in_world(position, placement)));
        self.edges.extend(mesh.edges().iter().map(|ends| [place(&ends[0]), place(&ends[1])]));
        let faces = 0..mesh.face_count();
        self.faces.extend(faces.map(|face| mesh.face_vertices(face).iter().map(place).collect::<Vec<_>>()));
    }

    /// The point of a target that is nearest to a position in the image; `None` if none is near. Points that
    /// faces hide are excluded unless `through` is set.
    pub(crate) fn find(
        &self,
        target: SnapTarget,
        view: &ToolView,
        place: DVec2,
        through: bool,
    ) -> Option<DVec3> {
        let points: Vec<Candidate> = match target {
            SnapTarget::Vertex => {
                self.vertices.iter().map(|&point| Candidate { point, ends: [point; 2] }).collect()
            }
            SnapTarget::Edge => {
                let nearest = |&ends| Some(Candidate { point: nearest_on_edge(view, ends, place)?, ends });
                self.edges.iter().filter_map(nearest).collect()
            }
            SnapTarget::Face => return self.face_under(view, place),
            SnapTarget::Increment | SnapTarget::Grid => return None,
        };
        let projector = view.projector();
        let distance = |point| Some(projector.to_screen(point)?.distance(place));
        let near = points.into_iter().filter_map(|candidate| Some((distance(candidate.point)?, candidate)));
        let mut near: Vec<_> = near.filter(|(distance, _)| *distance <= REACH * view.scale).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut seen = near.into_iter().take(MOST_TRIED).map(|(_, candidate)| candidate);
        seen.find(|candidate| through || !self.hides(view, candidate)).map(|candidate| candidate.point)
    }

    /// Whether a face lies before a point.
    fn hides(&self, view: &ToolView, Candidate { point, ends }: &Candidate) -> bool {
        /// Of the distance: a face that the point lies on is met as far away, but for roundings.
        const SAME: f64 = 1e-6;
        let Some(place) = view.screen(*point) else { return true };
        let Some(ray) = view.projector().ray(place) else { return true };
        let distance = (*point - ray.origin).dot(ray.direction) / ray.direction.length_squared();
        // Faces at the element itself do not hide it, however bent they are.
        let others = self.faces.iter().filter(|face| !ends.iter().all(|end| face.contains(end)));
        others
            .filter_map(|face| distance_to_face(view, place, &ray, face))
            .any(|hit| hit < distance * (1.0 - SAME))
    }

    fn face_under(&self, view: &ToolView, place: DVec2) -> Option<DVec3> {
        let ray = view.projector().ray(place)?;
        let hits = self.faces.iter().filter_map(|face| distance_to_face(view, place, &ray, face));
        hits.min_by(f64::total_cmp).map(|distance| ray.at(distance))
    }
}

/// The distance along the ray through a position in the image to the face that is visible there.
fn distance_to_face(view: &ToolView, place: DVec2, ray: &Ray, face: &[DVec3]) -> Option<f64> {
    let outline: Option<Vec<DVec2>> = face.iter().map(|&corner| view.screen(corner)).collect();
    if !contains(&outline?, place) {
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
fn nearest_on_edge(view: &ToolView, [start, end]: [DVec3; 2], place: DVec2) -> Option<DVec3> {
    let (from, to) = (view.screen(start)?, view.screen(end)?);
    let (length, way) = (from.distance(to), end - start);
    if length == 0.0 {
        return Some(start);
    }
    let axis = way.try_normalize()?;
    // Onto the edge in the image first, so that the ray there passes the edge itself.
    let along = ((place - from).dot(to - from) / (length * length)).clamp(0.0, 1.0);
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
    use trigon_document::mesh::primitives;
    use trigon_document::scene::{Material, Scene};

    use super::super::view::tests::front;
    use super::*;

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
