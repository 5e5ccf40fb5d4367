//! The public picker, and points of the scene that a pointer snaps to.

use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use fixedbitset::FixedBitSet;
use trigon_camera::{Camera, Projector, Ray, Viewport};
use trigon_math::{DVec2, DVec3};
use trigon_mesh::Mesh;

use super::nearby::Kind;
use super::nearest::Sets;
use super::nearest::{Best, Nearest};
use super::object::{CachedPoints, VisibleVertices};
use super::object::{PickObject, objects, visible_origins};
use super::region::{Region, center};
use super::screen::Screen;
use super::search::for_each_pixel;
use crate::elements::ElementSet;
use crate::frame::{Frame, Hit};
use crate::node::NodeId;
use crate::scene::Scene;

/// The radius in pixels of the circle that [`Picker::nearest`] searches first.
const CLOSE: f64 = 4.0;

/// Whether hidden elements count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// Only visible elements.
    #[default]
    Visible,
    /// All elements, whatever is in front of them.
    Through,
}

/// Finds the elements of a scene's meshes under pixels of an image, and in regions of it.
///
/// # What is hit
/// A [`Region`] is a part of the image, and [`Reach`] says whether hidden elements count.
///
/// | | [`Reach::Visible`] | [`Reach::Through`] |
/// |---|---|---|
/// | a face | wins a pixel whose centre lies in the region | covers a pixel's centre in the region |
/// | a vertex | its point lies in the region, and no face but its own hides it there | its point lies in the region |
/// | an edge | likewise, for one of its own points | one of its own points lies in the region |
///
/// - *Own* faces of a vertex or an edge are those that contain it.
/// - An edge's *own points* are where its line on the screen crosses the middles of columns of
///   pixels, or of rows where it is steeper than 45°: one in each pixel that a thin line would
///   paint. An edge too short to cross any has its middle.
/// - A face *hides* a point that it covers on the screen and that lies behind it by more than a
///   thousandth of a pixel's width at its distance: anything closer touches it. Only drawn faces
///   hide: not the backs of single-sided ones. A face with a masked or blended material hides only
///   in the pixels where it is visible.
/// - What lies in front of the near plane is cut, and what lies beyond the far plane is ignored.
/// - Faces that are drawn only from behind still count as covered: `Through` finds them, too.
///
/// Visible faces are read from the image's ids, so the image should have one sample per pixel, and
/// the style [`Surface`](crate::Style::Surface). Everything else is decided in f64 at the points
/// themselves, never at pixel centres.
///
/// # What it costs
/// It computes the screen positions of all vertices when a large region first needs them, and keeps
/// them: use one picker as long as scene and camera stay the same, or pass them on
/// ([`Picker::points`]). For a small region, such as
/// around a cursor, it skips most of a mesh in boxes of 64 triangles, and in boxes of 8 within
/// them. The scene keeps these boxes until the mesh changes.
///
/// ```
/// use trigon_scene::math::DVec2;
/// use trigon_scene::mesh::primitives;
/// use trigon_scene::{Material, Outputs, Picker, Reach, Region, RenderSettings, Scene, render};
///
/// let mut scene = Scene::new();
/// let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
/// let outputs = Outputs { ids: true, ..Outputs::NONE };
/// let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(40, 30) };
/// let camera = scene.overview(settings.aspect());
/// let frame = render(&scene, &camera, &settings)?;
///
/// let picker = Picker::new(&scene, &camera, &frame);
/// let pick = picker.at(20, 15).expect("the cube is in the middle");
/// assert_eq!(pick.hit.node, cube);
///
/// let all = Region::Rectangle { min: DVec2::ZERO, max: DVec2::new(40.0, 30.0) };
/// let count = |reach| {
///     let picked = [picker.faces(&all, reach), picker.vertices(&all, reach), picker.edges(&all, reach)];
///     picked.map(|elements| elements.len())
/// };
/// // Of its 8 corners one is hidden; of 12 edges those three that meet there.
/// assert_eq!(count(Reach::Visible), [3, 7, 9]);
/// assert_eq!(count(Reach::Through), [6, 8, 12]);
///
/// let around = Region::Circle { center: DVec2::new(20.0, 15.0), radius: 2.0 };
/// for (node, face) in picker.faces(&around, Reach::Visible).iter() {
///     assert!(node == cube && face < 6);
/// }
/// # Ok::<(), trigon_scene::RenderError>(())
/// ```
pub struct Picker<'p> {
    pub(super) scene: &'p Scene,
    pub(super) frame: &'p Frame,
    pub(super) projector: Projector,
    pub(super) screen: Screen,
    pub(super) objects: OnceLock<Vec<Option<PickObject<'p>>>>,
    /// Once they are found, if they can be kept.
    pub(super) visible: OnceLock<Option<Arc<VisibleVertices>>>,
}

/// What is under a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Pick {
    /// The node and its polygon.
    pub hit: Hit,
    /// The polygon's vertex nearest to the pixel's centre on the screen; of equally near ones the
    /// first. `None` for lines and points.
    pub vertex: Option<u32>,
    /// The polygon's edge nearest to it on the screen, as an index into
    /// [`Mesh::edges`](trigon_mesh::Mesh::edges); of equally near ones the first. `None` for lines and
    /// points.
    pub edge: Option<u32>,
}

impl<'p> Picker<'p> {
    /// For a frame with ids, of the scene as it was drawn. Without ids no face is visible, and only
    /// opaque faces hide.
    #[must_use]
    pub fn new(scene: &'p Scene, camera: &Camera, frame: &'p Frame) -> Self {
        let viewport = Viewport { width: frame.width, height: frame.height };
        Self {
            scene,
            frame,
            projector: Projector::new(camera, viewport),
            screen: Screen::new(camera, viewport),
            objects: OnceLock::new(),
            visible: OnceLock::new(),
        }
    }

    /// The same with what an earlier picker has found out about where points are.
    #[must_use]
    pub fn with_points(scene: &'p Scene, camera: &Camera, frame: &'p Frame, known: &CachedPoints) -> Self {
        let picker = Self::new(scene, camera, frame);
        let objects = objects(scene, &picker.screen, known);
        let is_same = |visible: &Arc<VisibleVertices>| {
            visible_origins(&objects, &picker.screen).is_some_and(|origins| origins == visible.origins)
        };
        let visible = known.visible.clone().filter(is_same);
        let visible = visible.map_or_else(OnceLock::new, |visible| OnceLock::from(Some(visible)));
        Self { objects: OnceLock::from(objects), visible, ..picker }
    }

    /// Finds out which vertices are visible anywhere in the image, for all later questions about the
    /// visible vertices of a region: ahead of them, perhaps on another thread. It takes about as long as the
    /// question about all of the image. In a scene with poses, or with faces that are not opaque, nothing is
    /// found out.
    pub fn find_visible_vertices(&self) {
        self.visible.get_or_init(|| self.visible_vertices().map(Arc::new));
    }

    /// What was found out of points, for the next picker. Takes 24 bytes for each vertex of objects that were
    /// asked about in large regions, and a bit for each vertex if the visible ones were found.
    #[must_use]
    pub fn points(&self) -> CachedPoints {
        let of_object = |object: &Option<PickObject<'_>>| object.as_ref()?.points(&self.screen);
        CachedPoints {
            objects: self.objects.get().into_iter().flatten().map(of_object).collect(),
            visible: self.visible.get().cloned().flatten(),
        }
    }

    /// What is under a pixel; `None` for background, and outside the image. Takes time proportional
    /// to the corners of one polygon, whatever the scene's size.
    pub fn at(&self, x: u32, y: u32) -> Option<Pick> {
        let hit = self.frame.hit(self.scene.nodes(), x, y)?;
        let outline = self.outline(&hit);
        let center = center(x, y);
        let nearest = |candidates: &[(u32, f64)]| {
            candidates.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
        };
        let [vertex, edge] = match &outline {
            Some(outline) => [nearest(&outline.vertices(center)), nearest(&outline.edges(center))],
            None => [None; 2],
        };
        Some(Pick { hit, vertex, edge })
    }

    /// The vertex, the edge and the face that are nearest to a point, among those hit by a circle
    /// of this radius around it, in pixels. Of equally near ones the one closer to the camera, then
    /// the first.
    pub fn nearest(&self, point: DVec2, radius: f64, reach: Reach) -> Nearest {
        // In a dense mesh the nearest elements are a few pixels away, and a small circle finds them
        // among far fewer. What it finds is the nearest in every larger circle, too.
        let close = self.nearest_within(point, radius.min(CLOSE), reach);
        let is_complete = close.vertex.is_some() && close.edge.is_some() && close.face.is_some();
        if is_complete || radius <= CLOSE {
            return close;
        }
        let all = self.nearest_within(point, radius, reach);
        debug_assert!(
            close.vertex.is_none_or(|found| Some(found) == all.vertex)
                && close.edge.is_none_or(|found| Some(found) == all.edge)
                && close.face.is_none_or(|found| Some(found) == all.face),
            "a larger circle holds the smaller one"
        );
        all
    }

    fn nearest_within(&self, point: DVec2, radius: f64, reach: Reach) -> Nearest {
        let region = Region::Circle { center: point, radius };
        let area = self.area(&region);
        let element = |best: Best| {
            let (object, element) = best.element()?;
            Some((self.scene.nodes().id_at(object as usize)?, element))
        };
        let nearby = self.nearby(&area);
        let [vertex, edge] =
            [Kind::Vertex, Kind::Edge].map(|kind| element(self.nearest_element(kind, point, &nearby, reach)));
        Nearest { vertex, edge, face: element(self.nearest_face(point, &area, reach)) }
    }

    /// The faces hit in a region.
    pub fn faces(&self, region: &Region, reach: Reach) -> ElementSet {
        let area = self.area(region);
        match reach {
            Reach::Visible => {
                let mut sets = Sets::new(self.objects(), Mesh::face_count);
                self.visible_faces(&area, |object, face, _| sets.insert(object, face));
                sets.finish()
            }
            Reach::Through => self.faces_through(&area),
        }
    }

    /// The vertices hit in a region. Vertices without a face, an edge or a point are not drawn, and
    /// not found.
    pub fn vertices(&self, region: &Region, reach: Reach) -> ElementSet {
        self.elements(Kind::Vertex, region, reach)
    }

    /// The edges hit in a region, as indices into [`Mesh::edges`](trigon_mesh::Mesh::edges).
    pub fn edges(&self, region: &Region, reach: Reach) -> ElementSet {
        self.elements(Kind::Edge, region, reach)
    }

    /// The nodes hit in a region: visible ones by a pixel that shows one of their faces, lines or
    /// points; through everything, by a face, an edge or a vertex.
    pub fn nodes(&self, region: &Region, reach: Reach) -> BTreeSet<NodeId> {
        match reach {
            Reach::Visible => {
                let area = self.area(region);
                let ids = self.frame.object_ids.as_deref().unwrap_or_default();
                let mut is_visible = FixedBitSet::with_capacity(self.scene.nodes().index_bound());
                for_each_pixel(&area, |[x, y]| {
                    let id = ids.get(self.pixel([x, y])).map_or(usize::MAX, |&id| id as usize);
                    if id < is_visible.len() {
                        is_visible.insert(id);
                    }
                });
                is_visible.ones().filter_map(|index| self.scene.nodes().id_at(index)).collect()
            }
            Reach::Through => {
                let of = |elements: ElementSet| elements.nodes().map(|(node, _)| node).collect::<Vec<_>>();
                let [vertices, edges] =
                    [Kind::Vertex, Kind::Edge].map(|kind| self.elements(kind, region, reach));
                [self.faces(region, reach), vertices, edges].into_iter().flat_map(of).collect()
            }
        }
    }
}

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
