//! Materials: new ones, their values, and the material slots of objects.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{Vec3, Vec4};
use trigon_modelling::Refusal;
use trigon_scene::{AlphaMode, Material, MaterialId, MetallicRoughness, NodeId, Scene, Shading};

use super::set_transform::named_or_active;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// A material by its number, or by its name: the first one with that name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum MaterialName {
    /// Its number in the scene.
    Number(u32),
    /// Its name.
    Name(String),
}

impl MaterialName {
    /// A material of a scene.
    #[must_use]
    pub fn of(id: MaterialId) -> Self {
        Self::Number(id.index() as u32)
    }

    /// The material with this name.
    fn find(&self, scene: &Scene) -> Result<MaterialId, EditError> {
        let found = match self {
            Self::Number(number) => scene.materials.id_at(*number as usize),
            Self::Name(name) => {
                scene.materials.iter().find(|(_, material)| material.name == *name).map(|(id, _)| id)
            }
        };
        found.ok_or_else(|| match self {
            Self::Number(number) => EditError::NoSuchMaterial(format!("number {number}")),
            Self::Name(name) => EditError::NoSuchMaterial(format!("{name:?}")),
        })
    }
}

/// The material that a command names, or the first one of the active object.
pub(super) fn named_or_first(
    change: &Change<'_>,
    name: Option<&MaterialName>,
    command: &'static str,
) -> Result<MaterialId, EditError> {
    if let Some(name) = name {
        return name.find(change.scene());
    }
    let active = named_or_active(change, None, command)?;
    let first = change.scene().node(active).and_then(|node| node.materials.first().copied());
    let first = first.filter(|&id| change.scene().materials.get(id).is_some());
    first.ok_or(EditError::NothingSelected { command, needed: "an active object with a material" })
}

/// Adds a material slot with a new material to an object: light grey, half rough.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AddMaterial {
    /// The object. Default: the active one.
    pub object: Option<ObjectName>,
    /// The name of the material.
    pub name: String,
    /// The slot that it takes, from 0, instead of the material there; one beyond the last adds a slot. Default: a new slot.
    pub slot: Option<u32>,
}

impl Default for AddMaterial {
    fn default() -> Self {
        Self { object: None, name: "Material".to_owned(), slot: None }
    }
}

impl Action for AddMaterial {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let object = with_surface(change, self.object.as_ref(), "adding a material")?;
        let scene = change.scene_mut();
        let shading = Shading::MetallicRoughness(MetallicRoughness::default());
        let material = scene.add_material(Material::default().with_name(&self.name).with_shading(shading));
        let slots = &mut scene.node_mut(object).expect("it was just found").materials;
        put(slots, self.slot.map_or(slots.len(), |slot| slot as usize), material);
        Ok(Outcome::silent())
    }
}

/// Puts a material into a slot, or into a new one beyond the last.
fn put(slots: &mut Vec<MaterialId>, slot: usize, material: MaterialId) {
    match slots.get_mut(slot) {
        Some(slot) => *slot = material,
        None => slots.push(material),
    }
}

/// An object by name, or the active one. Without a mesh it has no slots: a file could not hold what they hold.
fn with_surface(
    change: &Change<'_>,
    name: Option<&ObjectName>,
    operation: &'static str,
) -> Result<NodeId, EditError> {
    let object = named_or_active(change, name, operation)?;
    if change.scene().node(object).is_some_and(|node| node.mesh.is_some()) {
        return Ok(object);
    }
    let reason = "the object has no mesh: select one that has";
    Err(Refusal::NotPossible { operation, reason }.into())
}

/// Puts another material of the scene into a slot of an object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetMaterialSlot {
    /// The object. Default: the active one.
    #[serde(default)]
    pub object: Option<ObjectName>,
    /// The slot, from 0; one beyond the last adds a slot.
    #[serde(default)]
    pub slot: u32,
    /// The material.
    pub material: MaterialName,
}

impl Action for SetMaterialSlot {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let object = with_surface(change, self.object.as_ref(), "setting a material slot")?;
        let material = self.material.find(change.scene())?;
        let slots = &mut change.scene_mut().node_mut(object).expect("it was just found").materials;
        put(slots, self.slot as usize, material);
        Ok(Outcome::silent())
    }
}

/// How a surface reflects light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SurfaceShading {
    /// Shows the base colour, independent of light.
    Unlit,
    /// Diffuse.
    Lambert,
    /// Diffuse with a highlight.
    BlinnPhong,
    /// Between metal and dielectric, as in glTF.
    MetallicRoughness,
}

/// What the alpha of the base colour means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SurfaceAlpha {
    /// Ignored: the surface is opaque.
    Opaque,
    /// The surface has holes where alpha is below the cutoff.
    Mask,
    /// The surface is blended with what lies behind it.
    Blend,
}

/// Changes a material, for all objects that use it. Parameters that are not given keep their
/// values.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SetMaterial {
    /// The material. Default: the first one of the active object.
    pub material: Option<MaterialName>,
    /// Its name.
    pub name: Option<String>,
    /// How it reflects light.
    pub shading: Option<SurfaceShading>,
    /// Linear red, green, blue and alpha, 0 to 1.
    pub base_color: Option<[f32; 4]>,
    /// 0 (dielectric) to 1 (metal); makes it metallic-roughness.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub metallic: Option<f32>,
    /// 0 (mirror) to 1 (matt); makes it metallic-roughness.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: Option<f32>,
    /// Linear red, green and blue of a highlight, 0 to 1; makes it Blinn-Phong.
    pub specular: Option<[f32; 3]>,
    /// The exponent of a highlight, from 1 (wide) on; makes it Blinn-Phong.
    #[schemars(range(min = 0.0))]
    pub shininess: Option<f32>,
    /// Linear red, green and blue of emitted light.
    pub emissive: Option<[f32; 3]>,
    /// The strength of its normal map, if it has one.
    pub normal_scale: Option<f32>,
    /// The strength of its occlusion map, if it has one, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub occlusion_strength: Option<f32>,
    /// What alpha means.
    pub alpha: Option<SurfaceAlpha>,
    /// For a mask: the smallest alpha that counts as surface, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub alpha_cutoff: Option<f32>,
    /// Whether back faces are shown.
    pub double_sided: Option<bool>,
    /// The fraction of light that passes through, 0 to 1; visible where rays are traced.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub transmission: Option<f32>,
    /// Index of refraction.
    #[schemars(range(min = 1.0))]
    pub ior: Option<f32>,
}

impl Action for SetMaterial {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = named_or_first(change, self.material.as_ref(), "changing a material")?;
        let material = change.scene_mut().materials.get_mut(id).expect("it was just found");
        self.change(material);
        Ok(Outcome::silent())
    }
}

impl SetMaterial {
    fn change(&self, material: &mut Material) {
        set(&mut material.name, self.name.clone());
        set(&mut material.base_color, self.base_color.map(Vec4::from));
        set(&mut material.emissive, self.emissive.map(Vec3::from));
        set(&mut material.double_sided, self.double_sided);
        set(&mut material.transmission, self.transmission);
        set(&mut material.ior, self.ior);
        self.change_shading(&mut material.shading);
        self.change_alpha(&mut material.alpha_mode);
        if let Some(map) = &mut material.normal_map {
            set(&mut map.scale, self.normal_scale);
        }
        if let Some(map) = &mut material.occlusion {
            set(&mut map.strength, self.occlusion_strength);
        }
    }

    fn change_shading(&self, shading: &mut Shading) {
        let is_physical = matches!(shading, Shading::MetallicRoughness(_));
        let physical = Shading::MetallicRoughness(MetallicRoughness::default());
        let is_highlight = matches!(shading, Shading::BlinnPhong { .. });
        let highlight = Material::default().shading;
        match self.shading {
            Some(SurfaceShading::Unlit) => *shading = Shading::Unlit,
            Some(SurfaceShading::Lambert) => *shading = Shading::Lambert,
            Some(SurfaceShading::BlinnPhong) if !is_highlight => *shading = highlight,
            Some(SurfaceShading::MetallicRoughness) if !is_physical => *shading = physical,
            None if !is_physical && (self.metallic.is_some() || self.roughness.is_some()) => {
                *shading = physical;
            }
            None if !is_highlight && (self.specular.is_some() || self.shininess.is_some()) => {
                *shading = highlight;
            }
            Some(SurfaceShading::BlinnPhong | SurfaceShading::MetallicRoughness) | None => {}
        }
        if let Shading::BlinnPhong { specular, shininess, .. } = shading {
            set(specular, self.specular.map(Vec3::from));
            set(shininess, self.shininess);
        }
        if let Shading::MetallicRoughness(model) = shading {
            set(&mut model.metallic, self.metallic);
            set(&mut model.roughness, self.roughness);
        }
    }

    fn change_alpha(&self, mode: &mut AlphaMode) {
        // . glTF's cutoff if none is given.
        let cutoff = if let AlphaMode::Mask { cutoff } = *mode { cutoff } else { 0.5 };
        match self.alpha {
            Some(SurfaceAlpha::Opaque) => *mode = AlphaMode::Opaque,
            Some(SurfaceAlpha::Mask) => *mode = AlphaMode::Mask { cutoff },
            Some(SurfaceAlpha::Blend) => *mode = AlphaMode::Blend,
            None => {}
        }
        if let AlphaMode::Mask { cutoff } = mode {
            set(cutoff, self.alpha_cutoff);
        }
    }
}

fn set<T>(value: &mut T, to: Option<T>) {
    if let Some(to) = to {
        *value = to;
    }
}
