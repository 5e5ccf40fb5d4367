//! Textures: the image in its encoded form, the sampler, and where in a mesh it lies.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

use serde_json::json;
use trigon_math::elementary;
use trigon_math::glam::Affine2;
use trigon_scene::{Filter, MipFilter, Sampler, Scene, TextureBinding, TextureId, Wrap};

use super::draft::Draft;
use super::raw::RawObject;
use crate::GltfSource;
use crate::encode_image::{Pixels, encode_png};

/// What is known of textures while a document is written.
pub(super) struct Textures<'a> {
    scene: &'a Scene,
    /// Where the encoded images are.
    source: Option<&'a GltfSource>,
    /// Whether images of the source keep their index.
    is_retained: bool,
    images: BTreeMap<TextureId, Option<usize>>,
    samplers: HashMap<Sampler, usize>,
    textures: HashMap<(usize, Sampler), usize>,
}

impl<'a> Textures<'a> {
    pub(super) fn new(scene: &'a Scene, source: Option<&'a GltfSource>, is_retained: bool) -> Self {
        let (images, samplers, textures) = Default::default();
        Self { scene, source, is_retained, images, samplers, textures }
    }

    /// The `textureInfo` of a binding; none if its texture is gone.
    pub(super) fn info(&mut self, draft: &mut Draft<'a>, binding: &TextureBinding) -> Option<RawObject> {
        let image = self.image(draft, binding.texture)?;
        let mut info = RawObject::default();
        info.set("index", &self.texture(draft, image, binding.sampler));
        if binding.uv_set != 0 {
            info.set("texCoord", &binding.uv_set);
        }
        if binding.transform != Affine2::IDENTITY {
            draft.extensions.insert("KHR_texture_transform");
            let mut extensions = RawObject::default();
            extensions.set("KHR_texture_transform", &transform(&binding.transform));
            info.set("extensions", &extensions);
        }
        Some(info)
    }

    fn texture(&mut self, draft: &mut Draft<'a>, image: usize, sampler: Sampler) -> usize {
        if let Some(&known) = self.textures.get(&(image, sampler)) {
            return known;
        }
        let mut texture = RawObject::default();
        if draft.object("images", image).get("mimeType") == Some("\"image/webp\"") {
            let mut extensions = RawObject::default();
            extensions.set("EXT_texture_webp", &json!({"source": image}));
            texture.set("extensions", &extensions);
            draft.extensions.insert("EXT_texture_webp");
            draft.required.insert("EXT_texture_webp");
        } else {
            texture.set("source", &image);
        }
        if sampler != Sampler::default() {
            let index =
                self.samplers.entry(sampler).or_insert_with(|| draft.push("samplers", &sampled(sampler)));
            texture.set("sampler", index);
        }
        let index = draft.push("textures", &texture);
        self.textures.insert((image, sampler), index);
        index
    }

    fn image(&mut self, draft: &mut Draft<'a>, id: TextureId) -> Option<usize> {
        if let Some(&known) = self.images.get(&id) {
            return known;
        }
        let origin = self.source.and_then(|source| source.images(id).next());
        let image = match origin.filter(|_| self.is_retained) {
            Some(image) => Some(image),
            None => self.add_image(draft, id, origin),
        };
        self.images.insert(id, image);
        image
    }

    /// Adds an image: as it was encoded, or else as PNG.
    fn add_image(&self, draft: &mut Draft<'a>, id: TextureId, origin: Option<usize>) -> Option<usize> {
        let asset = self.scene.textures.get(id)?;
        let encoded = origin.and_then(|image| self.source?.image(image));
        let (bytes, kind) = match encoded.and_then(|bytes| Some((bytes, mime_type(bytes)?))) {
            Some((bytes, kind)) => (Cow::Borrowed(bytes), kind),
            None => {
                let texels: Vec<u8> = asset.texture.texels().flatten().collect();
                let (width, height) = (asset.texture.width(), asset.texture.height());
                let mut png = Vec::new();
                encode_png(&mut png, width, height, Pixels::Rgba8(&texels)).expect("memory takes an image");
                (Cow::Owned(png), "image/png")
            }
        };
        let mut image = RawObject::default();
        if !asset.name.is_empty() {
            image.set("name", &asset.name);
        }
        image.set("bufferView", &draft.view(bytes, None));
        image.set("mimeType", kind);
        Some(draft.push("images", &image))
    }
}

/// What an image is, by its first bytes, if glTF has a name for it.
pub(crate) fn mime_type(bytes: &[u8]) -> Option<&'static str> {
    let is_webp = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP");
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xff, 0xd8, ..] => Some("image/jpeg"),
        [0xab, b'K', b'T', b'X', b' ', b'2', b'0', ..] => Some("image/ktx2"),
        _ if is_webp => Some("image/webp"),
        _ => None,
    }
}

/// KHR_texture_transform; a sheared map loses its shear. See `slots` for what the numbers mean.
fn transform(map: &Affine2) -> RawObject {
    let (u, v) = (map.matrix2.x_axis, map.matrix2.y_axis);
    let mut object = RawObject::default();
    object.set("offset", &map.translation.to_array());
    if u.y == 0.0 && v.x == 0.0 {
        object.set("scale", &[u.x, v.y]);
        return object;
    }
    let rotation = elementary::atan2(f64::from(-u.y), f64::from(u.x));
    let (sine, cosine) = elementary::sin_cos(rotation);
    let scale = [f64::from(u.length()), f64::from(v.x) * sine + f64::from(v.y) * cosine];
    object.set("rotation", &(rotation as f32));
    object.set("scale", &scale.map(|factor| factor as f32));
    object
}

fn sampled(sampler: Sampler) -> serde_json::Value {
    let wrap = |wrap| match wrap {
        Wrap::Repeat => 10497,
        Wrap::MirroredRepeat => 33648,
        Wrap::ClampToEdge => 33071,
    };
    let filter = |filter| if filter == Filter::Nearest { 9728 } else { 9729 };
    let levels = match sampler.mip {
        MipFilter::None => 0,
        MipFilter::Nearest => 256,
        MipFilter::Linear | MipFilter::Anisotropic(_) => 258,
    };
    json!({
        "magFilter": filter(sampler.magnification),
        "minFilter": filter(sampler.minification) + levels,
        "wrapS": wrap(sampler.wrap_u),
        "wrapT": wrap(sampler.wrap_v),
    })
}
