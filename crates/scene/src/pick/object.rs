//! Objects for picking: their elements, the screen positions of their points, and which sides of their faces are drawn.
//! Everything is computed on first use. [`CachedPoints`] outlives a picker: screen positions, and which vertices are
//! visible.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;
use trigon_math::at_level;
use trigon_math::simd::Token;
use trigon_math::{DMat4, DVec2, DVec3, Vec3};
use trigon_mesh::Mesh;
use trigon_raster::simd::{LANES, inlined, lanes_of};

use super::region::{Area, Sides};
use super::screen::{Screen, Spot, Spots};
use crate::elements::ElementSet;
use crate::geometry::{BlockBox, Blocks, GeometryState, Run};
use crate::material::AlphaMode;
use crate::node::NodeId;
use crate::render::{Onlookers, Shape, Shapes};
use crate::scene::{PlacedMesh, Scene};

/// Points that a thread takes at a time.
pub(super) const POINTS: usize = 4096;

/// A visible node with a mesh.
pub(super) struct PickObject<'s> {
    pub(super) node: NodeId,
    placed: PlacedMesh<'s>,
    /// Of its geometry, if it is at rest.
    state: Option<GeometryState>,
    /// Its triangles as they are drawn; `None` where nothing of them can be in view.
    drawn: Option<DrawnTriangles>,
    /// Where vertices are.
    map: DMat4,
    /// The same for all of them, once that is kept, and for some more.
    vertices: OnceLock<Arc<Vec<[Spot; LANES]>>>,
}

/// The triangles of an object.
pub(super) struct DrawnTriangles {
    shape: Shape,
    map: DMat4,
    /// For each run how its material shows faces.
    facings: Vec<Facing>,
    /// Where all corners are, once that is kept, and some more.
    corners: OnceLock<Arc<Vec<[Spot; LANES]>>>,
}

/// All visible objects, by the indices of their nodes, with the points that are known of them.
pub(super) fn objects<'s>(
    scene: &'s Scene,
    screen: &Screen,
    known: &CachedPoints,
) -> Vec<Option<PickObject<'s>>> {
    let placements = scene.visible_placements();
    let mut shapes = Shapes::new(scene, &placements, Onlookers::Camera(&screen.eye));
    let mut objects: Vec<Option<PickObject<'_>>> = Vec::new();
    objects.resize_with(placements.len(), || None);
    for (node, _) in scene.nodes().iter() {
        let Some(placement) = placements[node.index()] else { continue };
        let Some(placed) = scene.placed_mesh(node, placement.world) else { continue };
        let map = screen.map(placed.world());
        let shape = shapes.take(node.index());
        let at_rest = shape.as_ref().filter(|shape| !shape.is_posed);
        let state = at_rest.map(|shape| shape.geometry.state.clone());
        let drawn = shape.and_then(|shape| DrawnTriangles::new(scene, node, shape, screen));
        let mut object = PickObject { node, placed, state, drawn, map, vertices: OnceLock::new() };
        let points = object.origin(screen).and_then(|origin| known.of(node.index(), &origin));
        object.vertices = points.map_or_else(OnceLock::new, OnceLock::from);
        objects[node.index()] = Some(object);
    }
    objects
}

/// What decides which vertices of all objects are visible, by the indices of their nodes. `None` if it also depends on
/// something else: a pose, or the pixels in which a face with holes or a translucent one is visible.
pub(super) fn visible_origins(
    objects: &[Option<PickObject<'_>>],
    screen: &Screen,
) -> Option<Vec<Option<VisibleOrigin>>> {
    let of_object = |object: &Option<PickObject<'_>>| match object {
        Some(object) => object.visible_origin(screen).map(Some),
        None => Some(None),
    };
    objects.iter().map(of_object).collect()
}

impl<'s> PickObject<'s> {
    pub(super) fn mesh(&self) -> &'s Mesh {
        self.placed.mesh()
    }

    /// Where a vertex is in the world.
    pub(super) fn position(&self, vertex: u32) -> DVec3 {
        self.placed.position(vertex)
    }

    pub(super) fn drawn(&self) -> Option<&DrawnTriangles> {
        self.drawn.as_ref()
    }

    /// On which sides of an area all vertices lie; where they are is kept.
    pub(super) fn vertex_sides(&self, screen: &Screen, area: &Area<'_>) -> Vec<[Sides; LANES]> {
        let positions = self.placed.positions();
        let spots = LazySpots { cached: &self.vertices, count: positions.len(), screen, map: &self.map };
        spots.sides(area, |block| {
            let coordinates =
                |vertex: usize| positions.get(vertex).map_or([0.0; 3], |point| point.to_array());
            let points: [[f32; 3]; LANES] = lanes_of(|lane| coordinates(block * LANES + lane));
            [0, 1, 2].map(|axis| points.map(|point| point[axis]))
        })
    }

    /// Where a vertex is.
    pub(super) fn vertices<'v>(&'v self, screen: &'v Screen) -> impl Fn(usize) -> Spot + Sync + 'v {
        let positions = self.placed.positions();
        let cached = self.vertices.get().map(|spots| spots.as_flattened());
        inlined(
            #[inline(always)]
            move |vertex: usize| match cached {
                Some(spots) => spots[vertex],
                None => screen.spot(&self.map, positions[vertex].as_dvec3()),
            },
        )
    }

    /// Which vertices belong to a face, an edge or a point.
    pub(super) fn used(&self) -> &'s [bool] {
        self.placed.used_vertices()
    }

    /// What the places of its vertices come from; `None` in a pose.
    fn origin(&self, screen: &Screen) -> Option<PointOrigin> {
        let state = self.state.clone()?;
        Some(PointOrigin { state, map: self.map, half_size: screen.half_size() })
    }

    /// What decides which points it hides, and which of its own are hidden; `None` in a pose, and if it hides
    /// points only in some pixels.
    fn visible_origin(&self, screen: &Screen) -> Option<VisibleOrigin> {
        let facings = self.drawn.as_ref().map_or(&[][..], |drawn| &drawn.facings).to_vec();
        let is_opaque = facings.iter().all(|facing| facing.is_opaque);
        let points = self.origin(screen).filter(|_| is_opaque)?;
        Some(VisibleOrigin { points, facings })
    }

    /// Where its vertices are, for another picker.
    pub(super) fn points(&self, screen: &Screen) -> Option<ObjectPoints> {
        let spots = Arc::clone(self.vertices.get()?);
        Some(ObjectPoints { origin: self.origin(screen)?, spots })
    }

    /// What the near plane leaves of the line between two vertices.
    pub(super) fn cut_line(&self, screen: &Screen, ends: [u32; 2]) -> Option<[Spot; 2]> {
        let positions = self.placed.positions();
        screen.cut_line(&self.map, ends.map(|end| positions[end as usize].as_dvec3()))
    }
}

impl DrawnTriangles {
    fn new(scene: &Scene, node: NodeId, shape: Shape, screen: &Screen) -> Option<Self> {
        if !screen.eye.may_see(&shape.geometry.bounds(), &shape.world) {
            return None;
        }
        let materials = &scene.node(node)?.materials;
        let facing = |run: &Run| {
            let material = materials.get(run.slot as usize).and_then(|&id| scene.materials.get(id));
            Facing {
                double_sided: material.is_none_or(|material| material.double_sided),
                is_opaque: material.is_none_or(|material| material.alpha_mode == AlphaMode::Opaque),
                is_mirrored: shape.is_mirrored,
            }
        };
        let facings = shape.geometry.runs.iter().map(facing).collect();
        Some(Self { map: screen.map(&shape.world), facings, shape, corners: OnceLock::new() })
    }

    /// The triangles of each material.
    pub(super) fn runs(&self) -> impl Iterator<Item = (Facing, Range<usize>)> + '_ {
        self.facings.iter().copied().zip(self.shape.geometry.runs.iter().map(|run| run.triangles.clone()))
    }

    /// Of its corners, to clip space.
    pub(super) fn map(&self) -> &DMat4 {
        &self.map
    }

    /// Boxes around its triangles.
    pub(super) fn blocks(&self, mesh: &Mesh) -> &Blocks {
        self.shape.geometry.blocks(mesh)
    }

    /// The triangles in those boxes that pass a test, a few at a time.
    pub(super) fn within<'d>(
        &'d self,
        blocks: &'d Blocks,
        may_hold: impl Fn(&BlockBox) -> bool + Copy + 'd,
    ) -> impl Iterator<Item = Range<usize>> + 'd {
        blocks.within(&self.shape.geometry, may_hold)
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.shape.geometry.triangles.len()
    }

    /// The polygon of a triangle.
    pub(super) fn face(&self, triangle: usize) -> u32 {
        self.shape.geometry.face(triangle)
    }

    /// The corners of a triangle.
    #[inline]
    pub(super) fn triangle(&self, triangle: usize) -> [usize; 3] {
        self.shape.geometry.triangles[triangle].map(|corner| corner as usize)
    }

    /// For each corner a vertex of the mesh that lies at the same place of the screen; `None` if some may lie
    /// elsewhere, as in a pose.
    pub(super) fn corner_vertices(&self, object: &PickObject<'_>) -> Option<&[u32]> {
        let is_at_rest = !self.shape.is_posed && self.map == object.map;
        is_at_rest.then(|| self.shape.geometry.mesh_vertices(object.mesh()))
    }

    /// On which sides of an area all corners lie; where they are is kept.
    pub(super) fn corner_sides(&self, screen: &Screen, area: &Area<'_>) -> Vec<[Sides; LANES]> {
        let columns = &self.shape.geometry.columns;
        let spots =
            LazySpots { cached: &self.corners, count: columns.vertex_count(), screen, map: &self.map };
        spots.sides(area, |block| {
            columns.positions.each_ref().map(|column| {
                let rest = &column[block * LANES..];
                let at = |lane: usize| rest.get(lane).copied().unwrap_or_default();
                rest.first_chunk().copied().unwrap_or_else(|| lanes_of(at))
            })
        })
    }

    /// Where a corner is.
    pub(super) fn corners<'d>(&'d self, screen: &'d Screen) -> impl Fn(usize) -> Spot + Sync + 'd {
        let cached = self.corners.get().map(|spots| spots.as_flattened());
        inlined(
            #[inline(always)]
            move |corner: usize| match cached {
                Some(spots) => spots[corner],
                None => screen.spot(&self.map, self.position(corner)),
            },
        )
    }

    /// Calls `visit` with a triangle between these spots, or with those that the near plane leaves of it.
    #[inline]
    pub(super) fn pieces(
        &self,
        screen: &Screen,
        triangle: usize,
        spots: [Spot; 3],
        mut visit: impl FnMut(&[Spot; 3]),
    ) {
        if spots.iter().all(Spot::is_somewhere) {
            visit(&spots);
        } else if spots.iter().any(Spot::is_somewhere) {
            let points = self.triangle(triangle).map(|corner| self.position(corner));
            screen.cut_triangle(&self.map, points).triangles().for_each(|piece| visit(&piece));
        }
    }

    fn position(&self, corner: usize) -> DVec3 {
        let [x, y, z] = &self.shape.geometry.columns.positions;
        Vec3::new(x[corner], y[corner], z[corner]).as_dvec3()
    }
}

/// Where the points of an object are on the screen, kept once they are found.
struct LazySpots<'o> {
    cached: &'o OnceLock<Arc<Vec<[Spot; LANES]>>>,
    /// The number of points.
    count: usize,
    screen: &'o Screen,
    /// From the object to the screen.
    map: &'o DMat4,
}

impl LazySpots<'_> {
    /// On which sides of an area the points lie. `points` gives eight of them, by axis.
    fn sides(
        &self,
        area: &Area<'_>,
        points: impl Fn(usize) -> [[f32; LANES]; 3] + Sync,
    ) -> Vec<[Sides; LANES]> {
        let level = Token::best();
        if let Some(spots) = self.cached.get() {
            let blocks = spots.par_iter().with_min_len(POINTS / LANES);
            let of = |spots| at_level!(level, simd => Sides::of_each(simd, &Spots::of(simd, spots), area));
            return blocks.map(of).collect();
        }
        let blocks = (0..self.count.div_ceil(LANES)).into_par_iter().with_min_len(POINTS / LANES);
        let found = blocks.map(|block| {
            let points = points(block);
            at_level!(level, simd => {
                let spots = self.screen.spots(simd, self.map, points);
                (spots.each(), Sides::of_each(simd, &spots, area))
            })
        });
        let (mut spots, mut sides) = (Vec::new(), Vec::new());
        found.unzip_into_vecs(&mut spots, &mut sides);
        // Another thread may have been quicker, and has found the same.
        let _ = self.cached.set(Arc::new(spots));
        sides
    }
}

/// How faces of a material are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Facing {
    /// Whether backs are drawn, too.
    pub(super) double_sided: bool,
    /// Whether there are no holes, and nothing shines through.
    pub(super) is_opaque: bool,
    /// Whether fronts wind clockwise because the object is mirrored.
    pub(super) is_mirrored: bool,
}

impl Facing {
    /// Whether a triangle of this area on the screen, where y points down, is drawn.
    pub(super) fn draws(&self, area: f64) -> bool {
        area != 0.0 && (self.double_sided || (area < 0.0) != self.is_mirrored)
    }
}

/// Where the vertices of a scene's objects are on the screen and which of them are visible, as far as a picker has
/// found out: the next one need not do so again. It uses only what it knows of objects that are as they were, and
/// seen in the same way.
#[derive(Clone, Debug, Default)]
pub struct CachedPoints {
    /// By the indices of nodes.
    pub(super) objects: Vec<Option<ObjectPoints>>,
    pub(super) visible: Option<Arc<VisibleVertices>>,
}

/// The vertices of an object at rest.
#[derive(Clone, Debug)]
pub(super) struct ObjectPoints {
    pub(super) origin: PointOrigin,
    /// With some more at the end.
    pub(super) spots: Arc<Vec<[Spot; LANES]>>,
}

/// Everything that the screen positions of an object at rest depend on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PointOrigin {
    pub(super) state: GeometryState,
    /// To clip space.
    pub(super) map: DMat4,
    /// Of the image, in pixels.
    pub(super) half_size: DVec2,
}

/// Which vertices no face but their own hides, of all that lie in an image.
#[derive(Clone, Debug)]
pub(super) struct VisibleVertices {
    /// By the indices of nodes.
    pub(super) origins: Vec<Option<VisibleOrigin>>,
    pub(super) vertices: ElementSet,
}

/// What the visibility of points depends on, of one object.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VisibleOrigin {
    pub(super) points: PointOrigin,
    pub(super) facings: Vec<Facing>,
}

impl CachedPoints {
    /// The points of the node with this index, if they have this origin.
    pub(super) fn of(&self, index: usize, origin: &PointOrigin) -> Option<Arc<Vec<[Spot; LANES]>>> {
        let points = self.objects.get(index)?.as_ref()?;
        (points.origin == *origin).then(|| Arc::clone(&points.spots))
    }
}
