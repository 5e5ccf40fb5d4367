//! The current shape of every visible node: its mesh in the pose that its joints and morph weights give it.
//!
//! Only meshes with a pose are deformed, and of these only what is in the view of the camera or of a lamp
//! that casts shadows.

use std::sync::Arc;

use trigon_math::glam::Affine3;
use trigon_math::{Bounds3, DAffine3, is_mirroring};
use trigon_mesh::Mesh;

use crate::geometry::Geometry;
use crate::mesh_asset::MeshAsset;
use crate::node::{Node, NodeId};
use crate::placement::Eye;
use crate::scene::{NodePlacement, Scene};

/// A placed mesh. There may be millions.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) geometry: Arc<Geometry>,
    /// As in its [placement](Self::placement).
    pub(crate) world: DAffine3,
    pub(crate) is_mirrored: bool,
    /// Whether a pose changed it.
    pub(crate) is_posed: bool,
    /// Whether it is that of the coarser mesh.
    pub(crate) is_coarse: bool,
}

impl Shape {
    fn new(geometry: Arc<Geometry>, placement: NodePlacement, is_posed: bool) -> Self {
        let NodePlacement { world, is_mirrored } = placement;
        Self { geometry, world, is_mirrored, is_posed, is_coarse: false }
    }

    /// What its geometry is made of.
    pub(crate) fn source<'a>(&self, asset: &'a MeshAsset) -> &'a Mesh {
        let coarse = asset.coarse().filter(|_| self.is_coarse);
        coarse.map_or(asset.mesh(), |coarse| &coarse.mesh)
    }

    pub(crate) fn placement(&self) -> NodePlacement {
        NodePlacement { world: self.world, is_mirrored: self.is_mirrored }
    }
}

/// The shapes of all visible nodes, by their indices.
#[derive(Debug, Default)]
pub(crate) struct Shapes(Vec<Option<Shape>>);

/// From where shapes are seen.
#[derive(Clone, Copy)]
pub(crate) enum Onlookers<'a> {
    /// The camera alone: poses beyond its view are not computed.
    Camera(&'a Eye),
    /// The camera of a draft: coarser meshes replace those that have one.
    Draft(&'a Eye),
    /// The camera, lamps, rays.
    All,
}

impl Shapes {
    /// `placements` is the scene's table of visible nodes.
    pub(crate) fn new(scene: &Scene, placements: &[Option<NodePlacement>], onlookers: Onlookers<'_>) -> Self {
        let mut shapes = vec![None; placements.len()];
        for (id, node) in scene.nodes().iter() {
            let (Some(placement), Some(mesh)) = (placements[id.index()], node.mesh) else { continue };
            let Some(asset) = scene.meshes().get(mesh) else { continue };
            shapes[id.index()] = shape(scene, id, node, asset, placement, onlookers);
        }
        Self(shapes)
    }

    /// The shape of a node; `None` where nothing is drawn of it.
    pub(crate) fn get(&self, index: usize) -> Option<&Shape> {
        self.0.get(index)?.as_ref()
    }

    /// Removes and returns the shape of a node.
    pub(crate) fn take(&mut self, index: usize) -> Option<Shape> {
        self.0.get_mut(index)?.take()
    }

    /// The bytes of deformed vertices.
    pub(crate) fn posed_bytes(&self) -> usize {
        let posed = self.0.iter().flatten().filter(|shape| shape.is_posed);
        posed.map(|shape| shape.geometry.columns.byte_count()).sum()
    }
}

fn shape(
    scene: &Scene,
    id: NodeId,
    node: &Node,
    asset: &MeshAsset,
    placement: NodePlacement,
    onlookers: Onlookers<'_>,
) -> Option<Shape> {
    if let (Onlookers::Draft(_), Some(coarse)) = (onlookers, asset.coarse()) {
        let shape = Shape::new(Arc::clone(&coarse.geometry), placement, false);
        return Some(Shape { is_coarse: true, ..shape });
    }
    let rest = Shape::new(Arc::clone(asset.geometry()), placement, false);
    let Some(bend) = scene.bend(id, asset) else { return Some(rest) };
    // Joints may have moved the mesh elsewhere.
    let placement = bend.joints.as_ref().map_or(placement, |pose| NodePlacement {
        world: pose.world,
        is_mirrored: is_mirroring(&pose.world.matrix3),
    });
    if let (Onlookers::Camera(eye) | Onlookers::Draft(eye), false) = (onlookers, bend.is_morphed)
        && !eye.may_see(&reach(&asset.bounds(), bend.palette()), &placement.world)
    {
        return None;
    }
    let geometry = asset.geometry().posed(&node.morph_weights, bend.palette());
    let posed = geometry.map(|geometry| Shape::new(Arc::new(geometry), placement, true));
    Some(posed.unwrap_or(rest))
}

/// A box around everything that joints can make of a box: weights only blend their maps.
fn reach(rest: &Bounds3, palette: &[Affine3]) -> Bounds3 {
    palette.iter().fold(*rest, |reach, joint| {
        let matrix = joint.matrix3;
        let joint = DAffine3::from_mat3_translation(
            trigon_math::DMat3::from_cols(
                matrix.x_axis.as_dvec3(),
                matrix.y_axis.as_dvec3(),
                matrix.z_axis.as_dvec3(),
            ),
            joint.translation.as_dvec3(),
        );
        reach.union(rest.transformed(&joint))
    })
}
