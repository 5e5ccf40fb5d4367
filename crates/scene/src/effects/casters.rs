//! Shadow casters: everything opaque and visible in the scene, inside the camera's view or not.

use std::sync::Arc;

use trigon_math::Bounds3;
use trigon_raster::Texture;

use crate::geometry::{Geometry, GeometryState};
use crate::material::{AlphaMode, Material};
use crate::node::Node;
use crate::scene::{NodePlacement, Scene};
use crate::shapes::{Shape, Shapes};

/// All shadow casters of a scene.
#[derive(Debug)]
pub(crate) struct Casters {
    pub(crate) list: Vec<Caster>,
    /// In the world; empty without casters.
    pub(crate) bounds: Bounds3,
}

/// One mesh at one node.
#[derive(Debug)]
pub(crate) struct Caster {
    /// The number of its node.
    pub(crate) node: u32,
    pub(crate) geometry: Arc<Geometry>,
    pub(crate) shadow: ShadowSource,
    bounds: Bounds3,
}

/// Everything that a caster's shadow depends on, to recognize it in a later frame. It identifies
/// the geometry without holding it: geometry with no other owner is changed in place.
#[derive(Clone, Debug)]
pub(crate) struct ShadowSource {
    geometry: GeometryState,
    pub(crate) placement: NodePlacement,
    /// For each run of the geometry its material, or `None` if light passes.
    pub(crate) materials: Vec<Option<Material>>,
    /// The current content of the materials' textures of colour, transmission and thickness: an
    /// image can be replaced under its id, or removed.
    textures: Vec<[Option<Arc<Texture>>; 3]>,
}

impl PartialEq for ShadowSource {
    /// Whether the shadow is certainly the same.
    fn eq(&self, other: &Self) -> bool {
        self.geometry == other.geometry
            && self.placement == other.placement
            && self.materials == other.materials
            && self.texture_addresses().eq(other.texture_addresses())
    }
}

impl ShadowSource {
    /// Distinguishes textures: both keys keep theirs alive, so no two share one.
    fn texture_addresses(&self) -> impl Iterator<Item = Option<*const Texture>> {
        self.textures.iter().flatten().map(|texture| texture.as_ref().map(Arc::as_ptr))
    }
}

impl Casters {
    pub(crate) fn gather(scene: &Scene, shapes: &Shapes) -> Self {
        let mut casters = Self { list: Vec::new(), bounds: Bounds3::EMPTY };
        for (id, node) in scene.nodes().iter() {
            let Some(shape) = shapes.get(id.index()) else { continue };
            let Shape { geometry, world, .. } = shape;
            let materials: Vec<Option<Material>> =
                geometry.runs.iter().map(|run| cast_by(scene, node, run.slot)).collect();
            if materials.iter().all(Option::is_none) {
                continue;
            }
            let bounds = geometry.bounds().transformed(world);
            casters.bounds = casters.bounds.union(bounds);
            let textures = materials.iter().flatten().map(|material| textures(scene, material)).collect();
            let shadow = ShadowSource {
                geometry: geometry.state.clone(),
                placement: shape.placement(),
                materials,
                textures,
            };
            let node = id.index() as u32;
            casters.list.push(Caster { node, geometry: Arc::clone(geometry), shadow, bounds });
        }
        casters
    }

    /// Everything that the shadows of all casters depend on.
    pub(crate) fn shadow_sources(&self) -> impl Iterator<Item = &ShadowSource> {
        self.list.iter().map(|caster| &caster.shadow)
    }

    /// The boxes of all casters in the world.
    pub(crate) fn boxes(&self) -> impl Iterator<Item = &Bounds3> {
        self.list.iter().map(|caster| &caster.bounds)
    }
}

/// The textures of a material that shadows and sight rays look up, each in its own slot, so that
/// none can be mistaken for another after one is removed.
fn textures(scene: &Scene, material: &Material) -> [Option<Arc<Texture>>; 3] {
    let Material { base_color_texture, transmission_texture, thickness_texture, .. } = material;
    [base_color_texture, transmission_texture, thickness_texture].map(|binding| {
        let asset = scene.textures.get(binding.as_ref()?.texture)?;
        Some(Arc::clone(&asset.texture))
    })
}

/// The material of a slot if it blocks light.
fn cast_by(scene: &Scene, node: &Node, slot: u32) -> Option<Material> {
    let id = node.materials.get(slot as usize);
    let material = id.and_then(|&id| scene.materials.get(id)).cloned().unwrap_or_default();
    (material.alpha_mode != AlphaMode::Blend).then_some(material)
}
