//! Materials: only differences from the file are written, so that members that trigon does not know
//! are preserved.

use trigon_math::{Vec3, Vec4};
use trigon_scene::{
    AlphaMode, Material, MetallicRoughness, NormalMap, Occlusion, ParameterField, Shading, TextureBinding,
};

use super::draft::Draft;
use super::raw::RawObject;
use super::textures::Textures;
use crate::formats::gltf::material_extensions::{amount, share};
use crate::formats::gltf::native::{self, ExactShading, MaterialExtras};
use crate::formats::gltf::{material_extensions, specular_glossiness};

/// The defaults of a material in a file.
pub(super) fn plain() -> Material {
    let model = MetallicRoughness { metallic: 1.0, roughness: 1.0, ..MetallicRoughness::default() };
    Material {
        base_color: Vec4::ONE,
        shading: Shading::MetallicRoughness(model),
        double_sided: false,
        ..Material::default()
    }
}

/// Changes the object of a material to that of another material.
pub(super) fn write_material<'a>(
    draft: &mut Draft<'a>,
    textures: &mut Textures<'a>,
    object: &mut RawObject,
    was: &Material,
    now: &Material,
) {
    let was = &without_specular_glossiness(object, was);
    let mut writer = MaterialWriter { draft, textures, object };
    if now.name != was.name {
        writer.object.set("name", &now.name);
    }
    writer.base(was, now);
    writer.surface(was, now);
    writer.extensions(was, now);
    writer.exact_shading(was, now);
}

/// Removes the extension of an older shading model, which would hide what is written beside it, and the
/// metallic-roughness that it hid. Returns what the object then says of a material.
fn without_specular_glossiness(object: &mut RawObject, was: &Material) -> Material {
    let mut extensions = object.object("extensions");
    if extensions.get(specular_glossiness::NAME).is_none() {
        return was.clone();
    }
    for name in [specular_glossiness::NAME, "KHR_materials_ior", "KHR_materials_specular"] {
        extensions.remove(name);
    }
    object.set_object("extensions", &extensions);
    object.remove("pbrMetallicRoughness");
    let Material { base_color, base_color_texture, shading, ior, .. } = plain();
    Material { base_color, base_color_texture, shading, ior, ..was.clone() }
}

struct MaterialWriter<'w, 'd, 'a> {
    draft: &'w mut Draft<'a>,
    textures: &'w mut Textures<'a>,
    object: &'d mut RawObject,
}

impl MaterialWriter<'_, '_, '_> {
    fn base(&mut self, was: &Material, now: &Material) {
        let (old, new) = (model(was), model(now));
        let mut pbr = self.object.object("pbrMetallicRoughness");
        if now.base_color != was.base_color {
            let color = now.base_color.to_array().map(|channel| share(channel, 1.0));
            pbr.set("baseColorFactor", &color);
        }
        set_number(&mut pbr, "metallicFactor", old.metallic, share(new.metallic, 1.0));
        set_number(&mut pbr, "roughnessFactor", old.roughness, share(new.roughness, 1.0));
        self.texture(&mut pbr, "baseColorTexture", &was.base_color_texture, &now.base_color_texture);
        self.texture(&mut pbr, "metallicRoughnessTexture", &old.texture, &new.texture);
        self.object.set_object("pbrMetallicRoughness", &pbr);
    }

    fn surface(&mut self, was: &Material, now: &Material) {
        if now.alpha_mode != was.alpha_mode {
            let (mode, cutoff) = match now.alpha_mode {
                AlphaMode::Opaque => ("OPAQUE", None),
                AlphaMode::Mask { cutoff } => ("MASK", Some(amount(cutoff, 0.5))),
                AlphaMode::Blend => ("BLEND", None),
            };
            self.object.set("alphaMode", mode);
            self.object.set_or_remove("alphaCutoff", cutoff.as_ref());
        }
        if now.double_sided != was.double_sided {
            self.object.set("doubleSided", &now.double_sided);
        }
        let mut object = std::mem::take(self.object);
        self.texture(&mut object, "emissiveTexture", &was.emissive_texture, &now.emissive_texture);
        self.normal_map(&mut object, was.normal_map, now.normal_map);
        self.occlusion(&mut object, was.occlusion, now.occlusion);
        *self.object = object;
    }

    fn normal_map(&mut self, object: &mut RawObject, was: Option<NormalMap>, now: Option<NormalMap>) {
        if now == was {
            return;
        }
        let binding = |map: NormalMap| map.binding;
        self.texture(object, "normalTexture", &was.map(binding), &now.map(binding));
        if let (Some(map), true) = (now, object.get("normalTexture").is_some()) {
            let mut info = object.object("normalTexture");
            info.set("scale", &(if map.scale.is_finite() { map.scale } else { 1.0 }));
            object.set("normalTexture", &info);
        }
    }

    fn occlusion(&mut self, object: &mut RawObject, was: Option<Occlusion>, now: Option<Occlusion>) {
        if now == was {
            return;
        }
        let binding = |map: Occlusion| map.binding;
        self.texture(object, "occlusionTexture", &was.map(binding), &now.map(binding));
        if let (Some(map), true) = (now, object.get("occlusionTexture").is_some()) {
            let mut info = object.object("occlusionTexture");
            info.set("strength", &share(map.strength, 1.0));
            object.set("occlusionTexture", &info);
        }
    }

    fn extensions(&mut self, was: &Material, now: &Material) {
        let mut extensions = self.object.object("extensions");
        let is_unlit = |material: &Material| material.shading == Shading::Unlit;
        if is_unlit(now) != is_unlit(was) {
            self.extension(&mut extensions, "KHR_materials_unlit", RawObject::default(), is_unlit(now));
        }
        if now.ior != was.ior {
            let mut ior = extensions.object("KHR_materials_ior");
            ior.set("ior", &amount(now.ior, 1.5));
            self.extension(&mut extensions, "KHR_materials_ior", ior, now.ior != 1.5);
        }
        if now.emissive != was.emissive {
            self.emission(&mut extensions, now.emissive);
        }
        self.parameters(&mut extensions, was, now);
        self.object.set_object("extensions", &extensions);
    }

    /// The extensions whose parameters are plain numbers, colours and textures.
    fn parameters(&mut self, extensions: &mut RawObject, was: &Material, now: &Material) {
        let physical =
            |of: &Material| Material { shading: Shading::MetallicRoughness(model(of)), ..of.clone() };
        let (mut was, mut now, mut default) = (physical(was), physical(now), Material::default());
        default.shading = Shading::MetallicRoughness(MetallicRoughness::default());
        for name in material_extensions::names() {
            let mut object = extensions.object(name);
            let (mut is_changed, mut is_needed) = (false, false);
            for row in material_extensions::parameters(name) {
                let values =
                    [&mut was, &mut now, &mut default].map(|material| MaterialValue::of(row.field, material));
                let [old, new, plain] = values;
                is_needed |= new != plain;
                if new != old {
                    is_changed = true;
                    self.parameter(&mut object, row.name, &old, &new);
                }
            }
            if is_changed {
                self.extension(extensions, name, object, is_needed);
            }
        }
    }

    fn parameter(&mut self, object: &mut RawObject, name: &str, was: &MaterialValue, now: &MaterialValue) {
        match (was, now) {
            (_, MaterialValue::Number(number)) if !number.is_finite() => object.remove(name),
            (_, MaterialValue::Number(number)) => object.set(name, &number),
            (_, MaterialValue::Color(color)) => object.set(name, &color),
            (MaterialValue::Texture(old), MaterialValue::Texture(new)) => {
                self.texture(object, name, old, new);
            }
            (_, MaterialValue::Texture(new)) => self.texture(object, name, &None, new),
            (_, MaterialValue::Missing) => object.remove(name),
        }
    }

    /// Values above 1 need a strength: a power of two, so that nothing is rounded.
    fn emission(&mut self, extensions: &mut RawObject, emissive: Vec3) {
        /// Beyond it, doubling would soon overflow.
        const MOST: f32 = 1e30;
        let emissive = emissive.to_array().map(|channel| amount(channel, 0.0).min(MOST));
        let mut strength = 1.0f32;
        while emissive.iter().any(|&channel| channel > strength) {
            strength *= 2.0;
        }
        self.object.set("emissiveFactor", &emissive.map(|channel| channel / strength));
        let mut object = extensions.object("KHR_materials_emissive_strength");
        object.set("emissiveStrength", &strength);
        self.extension(extensions, "KHR_materials_emissive_strength", object, strength > 1.0);
    }

    /// Sets or removes an extension.
    fn extension(
        &mut self,
        extensions: &mut RawObject,
        name: &'static str,
        object: RawObject,
        is_there: bool,
    ) {
        if is_there {
            self.draft.extensions.insert(name);
            extensions.set(name, &object);
        } else {
            extensions.remove(name);
        }
    }

    /// Sets or removes a changed texture. Its other members are kept only if the texture is the
    /// same.
    fn texture(
        &mut self,
        object: &mut RawObject,
        name: &str,
        was: &Option<TextureBinding>,
        now: &Option<TextureBinding>,
    ) {
        if now == was {
            return;
        }
        let info = now.as_ref().and_then(|binding| self.textures.info(self.draft, binding));
        object.set_or_remove(name, info.as_ref());
    }

    /// Shading models that the format lacks are stored exactly, besides the nearest equivalent.
    fn exact_shading(&mut self, was: &Material, now: &Material) {
        if now.shading == was.shading {
            return;
        }
        let exact = match now.shading {
            Shading::Unlit | Shading::MetallicRoughness(_) => None,
            Shading::Lambert => Some(ExactShading::Lambert),
            Shading::BlinnPhong { specular, shininess, .. } => {
                Some(ExactShading::BlinnPhong { specular: specular.to_array(), shininess })
            }
        };
        let mut extras = self.object.object("extras");
        let own = exact.map(|shading| MaterialExtras { version: native::VERSION, shading });
        extras.set_or_remove(native::MEMBER, own.as_ref());
        self.object.set_object("extras", &extras);
    }
}

/// What a material has in a field.
#[derive(Clone, Copy, PartialEq)]
enum MaterialValue {
    /// The shading model does not have the field.
    Missing,
    Number(f32),
    Color([f32; 3]),
    Texture(Option<TextureBinding>),
}

impl MaterialValue {
    fn of(field: ParameterField, material: &mut Material) -> Self {
        match field {
            ParameterField::Share(field) => {
                field(material).map_or(Self::Missing, |value| Self::Number(share(*value, 1.0)))
            }
            ParameterField::Amount(field) => field(material).map_or(Self::Missing, |value| {
                Self::Number(if value.is_finite() { amount(*value, 0.0) } else { f32::INFINITY })
            }),
            ParameterField::Color(field) => field(material).map_or(Self::Missing, |color| {
                Self::Color(color.to_array().map(|channel| amount(channel, 1.0)))
            }),
            ParameterField::Texture(slot) => Self::Texture(material.texture(slot)),
        }
    }
}

fn set_number(object: &mut RawObject, name: &str, was: f32, now: f32) {
    if now != was {
        object.set(name, &now);
    }
}

/// The model of a material, or the nearest equivalent.
fn model(material: &Material) -> MetallicRoughness {
    match material.shading {
        Shading::MetallicRoughness(model) => model,
        Shading::Unlit => match plain().shading {
            Shading::MetallicRoughness(model) => model,
            _ => MetallicRoughness::default(),
        },
        Shading::Lambert => {
            MetallicRoughness { roughness: 1.0, specular: 0.0, ..MetallicRoughness::default() }
        }
        // The highlight of GGX with α² = 2 / (n + 2) has the same width (Karis, "Specular BRDF
        // Reference", 2013); α is the square of the roughness.
        Shading::BlinnPhong { shininess, specular_texture, .. } => MetallicRoughness {
            roughness: (2.0 / (amount(shininess, 0.0) + 2.0)).sqrt().sqrt(),
            specular_color_texture: specular_texture,
            ..MetallicRoughness::default()
        },
    }
}
