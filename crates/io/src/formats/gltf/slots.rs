//! The textures of a glTF material: their uses, and the location of their coordinates in a mesh.

use gltf::json::extensions::texture::TextureTransform;
use gltf::json::{Material, texture};
use serde_json::{Map, Value};
use trigon_math::glam::{Affine2, Mat2};
use trigon_math::{Vec2, elementary};
use trigon_scene::{MaterialTexture, TextureFormat};

use super::{material_extensions, specular_glossiness};
use crate::texture_request::Purpose;

/// What the images in a place of a material are for.
pub(crate) fn purpose_of(slot: MaterialTexture) -> Purpose {
    match (slot, slot.format()) {
        (MaterialTexture::BaseColor, _) => Purpose::BaseColor,
        (_, TextureFormat::Srgb) => Purpose::Color,
        (_, TextureFormat::Linear) => Purpose::Data,
    }
}

/// A texture in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SlotTexture {
    pub(crate) slot: MaterialTexture,
    /// Of the document.
    pub(crate) texture: usize,
    pub(crate) uv_set: u32,
    pub(crate) transform: Affine2,
    /// Of a texture of roughness that is made of glossiness: the factor of that.
    pub(crate) glossiness: Option<f32>,
}

/// All textures of a material.
pub(crate) fn slot_textures(material: &Material) -> Vec<SlotTexture> {
    let pbr = &material.pbr_metallic_roughness;
    let own = [
        (MaterialTexture::BaseColor, pbr.base_color_texture.as_ref()),
        (MaterialTexture::MetallicRoughness, pbr.metallic_roughness_texture.as_ref()),
        (MaterialTexture::Emissive, material.emissive_texture.as_ref()),
    ];
    let mut list: Vec<SlotTexture> =
        own.into_iter().filter_map(|(slot, info)| Some(from_info(slot, info?))).collect();
    let extended = material.extensions.as_ref().map(material_extensions::textures).unwrap_or_default();
    if let Some(roughness) =
        list.iter_mut().find(|texture| texture.slot == MaterialTexture::MetallicRoughness)
    {
        roughness.glossiness = specular_glossiness::glossiness(material);
    }
    list.extend(extended.iter().map(|(slot, info)| from_info(*slot, info)));
    // Types of their own, in which gltf::json does not know the extension.
    macro_rules! loose {
        ($slot:expr, $info:expr) => {
            if let Some(info) = $info {
                let others = info.extensions.as_ref().map(|extensions| &extensions.others);
                let transform = others.and_then(loose_transform);
                list.push(in_slot($slot, info.index.value(), info.tex_coord, transform.as_ref()));
            }
        };
    }
    loose!(MaterialTexture::Normal, &material.normal_texture);
    loose!(MaterialTexture::Occlusion, &material.occlusion_texture);
    list
}

fn from_info(slot: MaterialTexture, info: &texture::Info) -> SlotTexture {
    let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
    in_slot(slot, info.index.value(), info.tex_coord, transform)
}

fn in_slot(
    slot: MaterialTexture,
    texture: usize,
    tex_coord: u32,
    transform: Option<&TextureTransform>,
) -> SlotTexture {
    let uv_set = transform.and_then(|transform| transform.tex_coord).unwrap_or(tex_coord);
    let transform = transform.map_or(Affine2::IDENTITY, to_affine);
    SlotTexture { slot, texture, uv_set, transform, glossiness: None }
}

/// gltf::json knows the extension in some places only.
fn loose_transform(others: &Map<String, Value>) -> Option<TextureTransform> {
    serde_json::from_value(others.get("KHR_texture_transform")?.clone()).ok()
}

/// KHR_texture_transform: translation · rotation · scale, rotating counter-clockwise with v
/// pointing down.
fn to_affine(from: &TextureTransform) -> Affine2 {
    let (sine, cosine) = elementary::sin_cos(f64::from(from.rotation.0));
    let (sine, cosine) = (sine as f32, cosine as f32);
    let (scale, offset) = (Vec2::from(from.scale.0), Vec2::from(from.offset.0));
    let matrix = Mat2::from_cols(Vec2::new(cosine, -sine) * scale.x, Vec2::new(sine, cosine) * scale.y);
    let affine = Affine2::from_mat2_translation(matrix, offset);
    if affine.is_finite() { affine } else { Affine2::IDENTITY }
}
