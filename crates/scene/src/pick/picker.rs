//! The picker as its users see it.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use fixedbitset::FixedBitSet;
use trigon_camera::{Camera, Projector, Viewport};
use trigon_math::DVec2;
use trigon_mesh::Mesh;

use super::elements::Sets;
use super::kind::Kind;
use super::nearest::{Best, Nearest};
use super::object::Object;
use super::region::{Region, center};
use super::screen::Screen;
use super::search::for_each_pixel;
use crate::elements::ElementSet;
use crate::frame::{Frame, Hit};
use crate::node::NodeId;
use crate::scene::Scene;

/// Whether what is hidden counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// Only what is seen.
    #[default]
    Visible,
    /// Everything, whatever lies before it.
    Through,
}

/// Finds the elements of a scene's meshes under the pixels of a picture, and in regions of
/// it.
///
/// # What is hit
/// A [`Region`] is a part of the picture, and [`Reach`] says whether what is hidden counts.
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
///   thousandth of a pixel's width at its distance: what is nearer than that touches. Only
///   faces that are drawn hide: not the backs of single-sided ones. Of a face whose material
///   is masked or blended only the pixels hide that it wins.
/// - What lies before the near plane is cut, and what lies beyond the far plane is left out.
/// - Faces that are drawn from behind only are no less covered: `Through` finds them, too.
///
/// Visible faces are those that the picture's ids tell, so that the picture should have one
/// sample for each pixel, and the style [`Surface`](crate::Style::Surface). All else is decided
/// in f64 at the points themselves: no pixel's centre is taken for them.
///
/// # What it costs
/// It finds out where all vertices are on the screen when a question about a large region
/// first needs that, and keeps it: ask one picker for as long as scene and camera stay. For a small
/// region, such as around a cursor, it passes over most of a mesh in boxes of 64 triangles, which
/// the scene keeps until the mesh changes.
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
    pub(super) objects: OnceLock<Vec<Option<Object<'p>>>>,
}

/// What is under a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pick {
    /// The node and its polygon.
    pub hit: Hit,
    /// Of the polygon's vertices the one that is seen nearest to the pixel's centre;
    /// of equally near ones the first. `None` for lines and points.
    pub vertex: Option<u32>,
    /// Of the polygon's edges the one that is seen nearest, as an index into
    /// [`Mesh::edges`](trigon_mesh::Mesh::edges); of equally near ones the first. `None` for lines and points.
    pub edge: Option<u32>,
}

impl<'p> Picker<'p> {
    /// For a frame with ids, of the scene as it was drawn. Without ids no face is visible,
    /// and only opaque faces hide.
    pub fn new(scene: &'p Scene, camera: &Camera, frame: &'p Frame) -> Self {
        let viewport = Viewport { width: frame.width, height: frame.height };
        Self {
            scene,
            frame,
            projector: Projector::new(camera, viewport),
            screen: Screen::new(camera, viewport),
            objects: OnceLock::new(),
        }
    }

    /// What is under a pixel; `None` for background, and outside the picture. It costs the
    /// corners of one polygon, whatever the scene's size.
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

    /// The vertex, the edge and the face that are nearest to a point, of those that a circle
    /// of this radius around it hits, in pixels. Of equally near ones that which is nearer to
    /// the camera, then the first.
    pub fn nearest(&self, point: DVec2, radius: f64, reach: Reach) -> Nearest {
        let region = Region::Circle { center: point, radius };
        let area = self.area(&region);
        let element = |best: Best| {
            let (object, element) = best.element()?;
            Some((self.scene.nodes().id_at(object as usize)?, element))
        };
        let nearby = self.nearby(&area);
        let [vertex, edge] = [Kind::Vertex, Kind::Edge]
            .map(|kind| element(self.nearest_element((kind, point), &nearby, reach)));
        Nearest { vertex, edge, face: element(self.nearest_face(point, &area, reach)) }
    }

    /// The faces that are hit in a region.
    pub fn faces(&self, region: &Region, reach: Reach) -> ElementSet {
        let area = self.area(region);
        match reach {
            Reach::Visible => {
                let mut sets = Sets::new(self.objects(), Mesh::face_count);
                self.winners(&area, |object, face, _| sets.insert(object, face));
                sets.finish()
            }
            Reach::Through => self.faces_through(&area),
        }
    }

    /// The vertices that are hit in a region. Those that belong to no face, no edge and no
    /// point are not drawn, and not found.
    pub fn vertices(&self, region: &Region, reach: Reach) -> ElementSet {
        self.elements(Kind::Vertex, region, reach)
    }

    /// The edges that are hit in a region, as indices into
    /// [`Mesh::edges`](trigon_mesh::Mesh::edges).
    pub fn edges(&self, region: &Region, reach: Reach) -> ElementSet {
        self.elements(Kind::Edge, region, reach)
    }

    /// The nodes of which something is hit in a region: by a pixel that it wins, with a face,
    /// a line or a point; through everything a face, an edge or a vertex.
    pub fn nodes(&self, region: &Region, reach: Reach) -> BTreeSet<NodeId> {
        match reach {
            Reach::Visible => {
                let area = self.area(region);
                let ids = self.frame.object_ids.as_deref().unwrap_or_default();
                let mut seen = FixedBitSet::with_capacity(self.scene.nodes().index_bound());
                for_each_pixel(&area, |[x, y]| {
                    let id = ids.get(self.pixel([x, y])).map_or(usize::MAX, |&id| id as usize);
                    if id < seen.len() {
                        seen.insert(id);
                    }
                });
                seen.ones().filter_map(|index| self.scene.nodes().id_at(index)).collect()
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
