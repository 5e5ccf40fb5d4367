//! The triangles of all visible nodes, as rays from the eye meet them.

use std::sync::Arc;

use trigon_math::{Bounds3, Bvh, DAffine3, DVec3, Vec3};

use crate::geometry::GeometryState;
use crate::prepare::PreparedScene;
use crate::scene::NodePlacement;
use crate::shapes::Shape;

/// All triangles, around the middle of their box: those of a node follow each other, in the order of its geometry.
#[derive(Debug, Default)]
pub(in crate::render) struct EyeTriangles {
    pub(super) bvh: Bvh,
    /// In the world.
    pub(super) middle: DVec3,
    /// The nodes, and the number of the first triangle of each; ascending.
    nodes: Vec<NodeTriangles>,
}

#[derive(Clone, Copy, Debug)]
struct NodeTriangles {
    node: u32,
    first: u32,
}

/// Everything that the triangles of a node depend on. It identifies the geometry without holding it.
#[derive(Debug, PartialEq)]
struct PlacedGeometry {
    node: u32,
    geometry: GeometryState,
    placement: NodePlacement,
}

/// The triangles of the last frame: a small image of 490,000 triangles takes 18 ms with them, and 440 if they are gathered
/// for it.
#[derive(Default)]
pub(in crate::render) struct EyeTriangleCache {
    cached: Option<CachedTriangles>,
}

struct CachedTriangles {
    made_of: Vec<PlacedGeometry>,
    triangles: Arc<EyeTriangles>,
}

impl EyeTriangleCache {
    /// Those of a scene, made anew if it has changed.
    pub(in crate::render) fn of(&mut self, prepared: &PreparedScene<'_>) -> Arc<EyeTriangles> {
        let made_of: Vec<PlacedGeometry> = shapes(prepared)
            .map(|(node, shape)| PlacedGeometry {
                node,
                geometry: shape.geometry.state.clone(),
                placement: shape.placement(),
            })
            .collect();
        let cached = self.cached.take().filter(|cached| cached.made_of == made_of);
        let cached = cached
            .unwrap_or_else(|| CachedTriangles { made_of, triangles: Arc::new(EyeTriangles::new(prepared)) });
        Arc::clone(&self.cached.insert(cached).triangles)
    }
}

/// The visible nodes with shapes, by their indices.
fn shapes<'p>(prepared: &'p PreparedScene<'_>) -> impl Iterator<Item = (u32, &'p Shape)> {
    let ids = prepared.scene.nodes().iter().map(|(id, _)| id.index());
    ids.filter_map(|index| Some((index as u32, prepared.shapes.get(index)?)))
}

impl EyeTriangles {
    fn new(prepared: &PreparedScene<'_>) -> Self {
        let bounds = shapes(prepared).fold(Bounds3::EMPTY, |bounds, (_, shape)| {
            bounds.union(shape.geometry.bounds().transformed(&shape.world))
        });
        let middle = bounds.center().filter(|middle| middle.is_finite()).unwrap_or(DVec3::ZERO);
        let (mut triangles, mut nodes) = (Vec::new(), Vec::new());
        for (node, shape) in shapes(prepared) {
            nodes.push(NodeTriangles { node, first: triangles.len() as u32 });
            let world = shape.world;
            let to_tree = DAffine3 { translation: world.translation - middle, ..world };
            let [x, y, z] = &shape.geometry.columns.positions;
            let position = |vertex: u32| {
                let at = vertex as usize;
                to_tree.transform_point3(Vec3::new(x[at], y[at], z[at]).as_dvec3()).as_vec3()
            };
            triangles.extend(shape.geometry.triangles.iter().map(|corners| corners.map(position)));
        }
        Self { bvh: Bvh::new(&triangles), middle, nodes }
    }

    /// The node of a triangle, and its number there.
    pub(super) fn owner(&self, triangle: u32) -> [u32; 2] {
        let after = self.nodes.partition_point(|node| node.first <= triangle);
        let NodeTriangles { node, first } = self.nodes[after - 1];
        [node, triangle - first]
    }
}
