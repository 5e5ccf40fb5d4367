//! What a scene contains, and what of it the camera can see.

use trigon_math::Vec3;

use super::Named;
use crate::effect::Effect;
use crate::effects::Optics;
use crate::material::{AlphaMode, DrawnIf, Material, MaterialTexture, Shading};
use crate::mesh_asset::MeshAsset;
use crate::node::Node;
use crate::prepare::PreparedScene;
use crate::settings::ShadingModel;
use crate::shapes::Shape;

/// What a scene contains, and what of it the camera can see.
#[derive(Debug, Default)]
pub(super) struct Survey {
    /// For each effect by its number: the objects that have it, in view and elsewhere.
    found: [[Named; 2]; Effect::ALL.len()],
    /// For each effect by its number, whether lines or points in view have it, which every style shows.
    of_wires: [bool; Effect::ALL.len()],
    /// Objects in view that light reaches.
    pub(super) lit: usize,
    /// Shadow casters, in view or not.
    pub(super) casters: usize,
}

impl Survey {
    pub(super) fn new(prepared: &PreparedScene<'_>) -> Self {
        let mut survey = Self::default();
        for (id, node) in prepared.scene.nodes().iter() {
            let Some(shape) = prepared.shapes.get(id.index()) else { continue };
            let seen = prepared.may_show(shape);
            let name = if node.name.is_empty() { "an unnamed object" } else { &node.name };
            let default = Material::default();
            let materials = shape.geometry.runs.iter().map(|run| {
                let id = node.materials.get(run.slot as usize);
                id.and_then(|&id| prepared.scene.materials.get(id)).unwrap_or(&default)
            });
            let materials: Vec<&Material> = materials.collect();
            let wires = Wires::of(node, prepared);
            let sees_wires = wires.as_ref().is_some_and(|wires| wires.may_show(shape, prepared));
            for effect in Effect::ALL {
                let of_faces = materials.iter().any(|material| has(effect, material, shape, prepared));
                let of_wires = wires.as_ref().is_some_and(|wires| wires.have(effect));
                if of_faces || of_wires {
                    let seen = of_faces && seen || of_wires && sees_wires;
                    survey.found[effect as usize][usize::from(!seen)].add(name);
                }
                survey.of_wires[effect as usize] |= of_wires && sees_wires;
            }
            let lit = |material: &&Material| material.shading != Shading::Unlit;
            survey.lit += usize::from(seen && materials.iter().any(lit));
            let opaque = |material: &&Material| material.alpha_mode != AlphaMode::Blend;
            survey.casters += usize::from(materials.iter().any(opaque));
        }
        survey
    }

    /// The objects that have an effect, in view and elsewhere.
    pub(super) fn of(&self, effect: Effect) -> &[Named; 2] {
        &self.found[effect as usize]
    }

    /// Whether lines or points in view have an effect.
    pub(super) fn is_of_wires(&self, effect: Effect) -> bool {
        self.of_wires[effect as usize]
    }
}

/// The loose edges and points of a node. They are unlit.
struct Wires<'s> {
    asset: &'s MeshAsset,
    /// That of all of them.
    material: Option<&'s Material>,
}

impl<'s> Wires<'s> {
    fn of(node: &Node, prepared: &PreparedScene<'s>) -> Option<Self> {
        let asset = prepared.scene.meshes().get(node.mesh?).filter(|asset| !asset.has_nothing_loose())?;
        let material = node.materials.first().and_then(|&id| prepared.scene.materials.get(id));
        Some(Self { asset, material })
    }

    fn may_show(&self, shape: &Shape, prepared: &PreparedScene<'_>) -> bool {
        prepared.eye.may_see(&self.asset.bounds(), &shape.place.world)
    }

    fn have(&self, effect: Effect) -> bool {
        let mode = self.material.map_or(AlphaMode::Opaque, |material| material.alpha_mode);
        match effect {
            Effect::VertexColors => self.asset.mesh().attributes().vertex_colors.is_some(),
            Effect::Emission => self.material.is_some_and(|material| material.emissive != Vec3::ZERO),
            Effect::Masks => matches!(mode, AlphaMode::Mask { .. }),
            Effect::Transparency => mode == AlphaMode::Blend,
            _ => false,
        }
    }
}

/// Whether a material on a mesh needs an effect.
fn has(effect: Effect, material: &Material, shape: &Shape, prepared: &PreparedScene<'_>) -> bool {
    let lit = material.shading != Shading::Unlit;
    match effect {
        Effect::Highlights => {
            let shading = prepared.settings.reflection.of(material);
            !matches!(shading, Shading::Unlit | Shading::Lambert)
        }
        Effect::Textures => {
            let shading = prepared.settings.reflection.of(material);
            let material = Material { shading, ..material.clone() };
            material.textures().any(|(place, _)| is_drawn(place, &material, prepared))
        }
        Effect::NormalMaps => lit && material.normal_map.is_some(),
        Effect::OcclusionMaps => lit && (MaterialTexture::Occlusion.row().matters)(material),
        Effect::Emission => material.emissive != Vec3::ZERO,
        Effect::VertexColors => shape.geometry.columns.colors.is_some(),
        Effect::Masks => matches!(material.alpha_mode, AlphaMode::Mask { .. }),
        Effect::Transparency => material.alpha_mode == AlphaMode::Blend,
        Effect::Poses => shape.is_posed,
        Effect::MetalStudio => is_metal(material, prepared),
        Effect::Reflection => is_traced(material, false),
        Effect::Refraction => is_traced(material, true),
        // Those that depend on lights and settings, not on materials.
        Effect::Lamps
        | Effect::AmbientLight
        | Effect::LightMeter
        | Effect::Environment
        | Effect::ShadowMaps
        | Effect::ShadowRays
        | Effect::AmbientOcclusion
        | Effect::Fog
        | Effect::ToneMapping
        | Effect::Outline
        | Effect::Edges => false,
    }
}

/// Whether a texture of a material has an effect on what it shows.
fn is_drawn(place: MaterialTexture, material: &Material, prepared: &PreparedScene<'_>) -> bool {
    let settings = prepared.settings;
    let in_pixels = material.shading != Shading::Unlit && settings.shading == ShadingModel::Phong;
    let has_what_it_needs = match place.row().drawn_if {
        DrawnIf::Always => true,
        DrawnIf::LightInPixels | DrawnIf::TangentsInPixels => in_pixels,
        DrawnIf::AmbientLightInPixels => in_pixels && has_ambient(prepared),
        DrawnIf::Refracting => in_pixels && settings.effects.bounces > 0 && is_traced(material, true),
    };
    has_what_it_needs && material.texture(place).is_some() && (place.row().matters)(material)
}

/// Whether light comes from everywhere.
pub(super) fn has_ambient(prepared: &PreparedScene<'_>) -> bool {
    prepared.settings.effects.environment.is_some() || prepared.lights.ambient != Vec3::ZERO
}

/// Whether a material may be metallic somewhere: textures are not searched.
fn is_metal(material: &Material, prepared: &PreparedScene<'_>) -> bool {
    match prepared.settings.reflection.of(material) {
        Shading::Unlit | Shading::Lambert | Shading::BlinnPhong { .. } => false,
        Shading::MetallicRoughness(model) => model.metallic > 0.0,
    }
}

/// Whether sight rays continue at a material, and through it.
fn is_traced(material: &Material, through: bool) -> bool {
    match Optics::of(material) {
        None => false,
        Some(Optics::Mirror) => !through,
        Some(Optics::Glass { .. }) => through,
    }
}
