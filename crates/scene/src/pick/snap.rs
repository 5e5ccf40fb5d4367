//! Points of the scene that a pointer snaps to.

use trigon_camera::Ray;
use trigon_math::{DVec2, DVec3};

use super::nearest::Nearest;
use super::object::PickObject;
use super::picker::{Picker, Reach};
use super::region::center;
use crate::node::NodeId;

/// A point of the scene that a pointer snapped to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Snap {
    /// The node that it belongs to.
    pub node: NodeId,
    /// The element of the node's mesh.
    pub element: SnapElement,
    /// Where it is in the world.
    pub point: DVec3,
}

/// An element of a mesh, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SnapElement {
    /// The vertex itself.
    Vertex(u32),
    /// The point of the edge that is seen nearest to the pointer.
    Edge(u32),
    /// The point of the face in the middle of the pixel under the pointer.
    Face(u32),
}

impl Picker<'_> {
    /// What a pointer at `point` snaps to: a visible vertex within `radius` pixels, else a visible edge within half of
    /// that, else the face under it. `None` if there is none of them, and for faces in frames without depth.
    pub fn snap(&self, point: DVec2, radius: f64) -> Option<Snap> {
        let found = |of: Option<(NodeId, u32)>| of.filter(|(node, _)| self.object(*node).is_some());
        if let Some((node, vertex)) = found(self.nearest(point, radius, Reach::Visible).vertex) {
            let point = self.object(node)?.position(vertex);
            return Some(Snap { node, element: SnapElement::Vertex(vertex), point });
        }
        let Nearest { edge, .. } = self.nearest(point, radius * 0.5, Reach::Visible);
        if let (Some((node, edge)), Some(ray)) = (found(edge), self.projector.ray(point)) {
            let object = self.object(node)?;
            let ends = object.mesh().edges().get(edge as usize)?.map(|end| object.position(end));
            return Some(Snap { node, element: SnapElement::Edge(edge), point: nearest_on(ends, &ray) });
        }
        let [x, y] = [point.x, point.y].map(|at| at as u32);
        let hit = self.frame.hit(self.scene.nodes(), x, y)?;
        let at = y as usize * self.frame.width as usize + x as usize;
        let distance = *self.frame.depth.as_ref()?.get(at)?;
        // The depth is that of the pixel's centre.
        let point = self.projector.at_distance(center(x, y), distance.into())?;
        Some(Snap { node: hit.node, element: SnapElement::Face(hit.face? as u32), point })
    }
}

impl<'p> Picker<'p> {
    /// The mesh of a node as it is picked.
    fn object(&self, node: NodeId) -> Option<&PickObject<'p>> {
        self.objects().get(node.index())?.as_ref()
    }
}

/// The point between two ends that is nearest to the line of a ray.
fn nearest_on([start, end]: [DVec3; 2], ray: &Ray) -> DVec3 {
    let (along, sight) = (end - start, ray.direction);
    let from = start - ray.origin;
    let (a, b, c) = (along.dot(along), along.dot(sight), sight.dot(sight));
    let (d, e) = (along.dot(from), sight.dot(from));
    let denominator = a * c - b * b;
    // Seen end-on, all points are equally near.
    let share = if denominator > 0.0 { (b * e - c * d) / denominator } else { 0.0 };
    start + along * share.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use trigon_camera::{Camera, Projector, Viewport};
    use trigon_mesh::primitives;

    use super::*;
    use crate::{Frame, Material, Outputs, RenderSettings, Scene, render};

    /// A cube of 2 m from the front and above.
    fn cube() -> (Scene, Camera, Frame) {
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(2.0), Material::default());
        let camera = Camera::look_at(DVec3::new(0.5, 3.0, 7.0), DVec3::ZERO, DVec3::Y);
        let outputs = Outputs { ids: true, depth: true, ..Outputs::NONE };
        let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(200, 150) };
        let frame = render(&scene, &camera, &settings).expect("drawn");
        (scene, camera, frame)
    }

    #[test]
    fn pointers_snap_to_vertices_then_edges_then_faces() {
        let (scene, camera, frame) = cube();
        let picker = Picker::new(&scene, &camera, &frame);
        let projector = Projector::new(&camera, Viewport { width: 200, height: 150 });
        let near = |point: DVec3, by: DVec2| {
            let at = projector.to_screen(point).expect("before the eye") + by;
            picker.snap(at, 8.0).expect("the cube")
        };
        let corner = near(DVec3::ONE, DVec2::new(3.0, 2.0));
        assert!(matches!(corner.element, SnapElement::Vertex(_)), "{corner:?}");
        assert_eq!(corner.point, DVec3::ONE, "the corner itself");
        let edge = near(DVec3::new(0.0, 1.0, 1.0), DVec2::new(0.0, 2.0));
        assert!(matches!(edge.element, SnapElement::Edge(_)), "{edge:?}");
        assert!((edge.point.y, edge.point.z) == (1.0, 1.0) && edge.point.x.abs() < 0.1, "{edge:?}");
        let face = near(DVec3::new(0.1, 0.0, 1.0), DVec2::ZERO);
        assert!(matches!(face.element, SnapElement::Face(_)), "{face:?}");
        // The depth is f32.
        assert!((face.point.z - 1.0).abs() < 1e-5, "on the face: {face:?}");
        assert!(face.point.distance(DVec3::new(0.1, 0.0, 1.0)) < 0.05, "within a pixel: {face:?}");
        assert_eq!(picker.snap(DVec2::new(1.0, 1.0), 8.0), None, "the background");
        assert_eq!(picker.snap(DVec2::new(-5.0, 1e9), 8.0), None, "outside");
    }
}
