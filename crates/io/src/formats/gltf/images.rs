//! Images of the document, for the textures that materials use.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use gltf::json::Root;
use gltf::json::texture::{MagFilter, MinFilter, WrappingMode};
use serde_json::Value;
use trigon_raster::{Filter, MipFilter, Sampler, TextureFormat, Wrap};
use trigon_scene::TextureId;

use super::accessor::valid;
use super::buffers::{Buffers, UnreadReason, read_reference};
use super::references::source_of;
use super::slots::{SlotTexture, purpose_of};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::folder::{Folder, Lookup};
use crate::import::Import;
use crate::texture_request::Role;
use crate::texture_request::{ImageBytes, Purpose, Request};
use crate::textures::add_textures;
use crate::uri::{Reference, parse_reference};

/// The textures that images of the document became: one for colours, one for
/// data, as they are used.
pub(crate) struct Images {
    ids: BTreeMap<ImageUse, TextureId>,
}

/// An image, and what it is read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct ImageUse {
    image: usize,
    is_data: bool,
    role: Role,
}

impl ImageUse {
    fn of(root: &Root, from: &SlotTexture) -> Option<Self> {
        let role = match from.glossiness {
            Some(factor) => Role::Glossiness { factor: factor.to_bits() },
            None => Role::Whole,
        };
        let is_data = from.slot.format() == TextureFormat::Linear;
        Some(Self { image: image_of(root, from.texture)?, is_data, role })
    }
}

impl Images {
    /// Reads the images behind some textures, and decodes each once for
    /// colours and once for data, where it is used so.
    pub(crate) fn read(
        import: &mut Import<'_>,
        root: &Root,
        buffers: &mut Buffers,
        textures: &[SlotTexture],
    ) -> Result<Self, LoadError> {
        let wanted = wanted_images(import, root, textures);
        let (mut requests, mut indices) = (Vec::new(), BTreeMap::new());
        // Many images may be one image: it is read, decoded and kept once.
        let mut known = HashMap::new();
        for (used, purpose) in wanted {
            let ImageUse { image, is_data, role } = used;
            let from = &root.images[image];
            let source = (&from.uri, from.buffer_view.map(|view| view.value()), is_data, role);
            let index = *known.entry(source).or_insert_with(|| {
                let bytes = read_image(import, root, buffers, image)?;
                let (name, location) = (image_name(root, image), Location::Item("image", image));
                let layers = vec![(role, bytes)];
                requests.push(Request { name, file: import.path.to_owned(), location, layers, purpose });
                Some(requests.len() - 1)
            });
            indices.extend(index.map(|index| (used, index)));
        }
        let ids = add_textures(import, &requests)?;
        if let Some(source) = &mut import.source {
            // What is made of an image is not the image.
            let whole = indices.iter().filter(|(used, _)| used.role == Role::Whole);
            source.note_images(&requests, &ids, whole.map(|(used, &index)| (used.image, index)));
        }
        let ids = indices.into_iter().filter_map(|(key, index)| Some((key, ids[index]?))).collect();
        Ok(Self { ids })
    }

    /// The texture of the scene for one of the document.
    pub(crate) fn get(&self, root: &Root, from: &SlotTexture) -> Option<TextureId> {
        self.ids.get(&ImageUse::of(root, from)?).copied()
    }
}

/// Which images are needed, and what for: a colour of a surface before others.
fn wanted_images(
    import: &mut Import<'_>,
    root: &Root,
    textures: &[SlotTexture],
) -> BTreeMap<ImageUse, Purpose> {
    let mut wanted = BTreeMap::new();
    for from in textures {
        let Some(used) = ImageUse::of(root, from) else {
            let location = Location::Item("texture", from.texture);
            import.warnings.push(location, "it has no image and is not drawn", "export the model again");
            continue;
        };
        let purpose = purpose_of(from.slot);
        let known = wanted.entry(used).or_insert(purpose);
        if purpose == Purpose::BaseColor {
            *known = purpose;
        }
    }
    wanted
}

/// The image that a texture shows: the plain one, else one in a format that an
/// extension adds. The image itself then says what it is.
pub(crate) fn image_of(root: &Root, texture: usize) -> Option<usize> {
    let texture = &root.textures[texture];
    if let Some(source) = source_of(texture) {
        return Some(source);
    }
    let others = &texture.extensions.as_ref()?.others;
    let sources = others.values().filter_map(|extension| extension.get("source").and_then(Value::as_u64));
    let mut images = sources.filter_map(|source| usize::try_from(source).ok());
    images.find(|&image| image < root.images.len())
}

fn image_name(root: &Root, image: usize) -> String {
    let from = &root.images[image];
    let file = from.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
    file.or(from.name.as_deref()).map_or_else(|| format!("image {image}"), str::to_owned)
}

fn read_image(
    import: &mut Import<'_>,
    root: &Root,
    buffers: &mut Buffers,
    image: usize,
) -> Option<ImageBytes> {
    let location = Location::Item("image", image);
    match fetch_image(root, buffers, &mut import.folder, image) {
        Ok((bytes, respelled)) => {
            if let Some(path) = respelled {
                let what = format!(
                    "\"{}\" was not found; \"{}\" is used instead",
                    image_name(root, image),
                    Path::new(&path).display()
                );
                import.warnings.push(location, what, "correct the name in the model");
            }
            Some(bytes)
        }
        Err(UnreadReason { what, remedy, .. }) => {
            let what = format!("the image is not drawn: {what}");
            let tried = tried_for(&mut import.folder, root, image);
            import.warnings.push_unusable(import.path, location, what, remedy, tried);
            None
        }
    }
}

/// Every path at which the file of an image is looked for.
fn tried_for(folder: &mut Folder, root: &Root, image: usize) -> Vec<PathBuf> {
    let reference = root.images[image].uri.as_deref().map(parse_reference);
    let Some(Ok(Reference::Path(names))) = reference else { return Vec::new() };
    let mut tried = Vec::new();
    for path in names.all().flat_map(|name| folder.tried(Path::new(""), name)) {
        if !tried.contains(&path) {
            tried.push(path);
        }
    }
    tried
}

/// The bytes of an image; the second value is another spelling that was used for a file.
pub(crate) fn fetch_image(
    root: &Root,
    buffers: &mut Buffers,
    folder: &mut Folder,
    image: usize,
) -> Result<(ImageBytes, Option<String>), UnreadReason> {
    let from = &root.images[image];
    match (&from.uri, from.buffer_view) {
        (Some(uri), _) => {
            let (bytes, respelled) = read_reference(uri, folder, Lookup::Forgiving)?;
            Ok((ImageBytes::Own(bytes), respelled))
        }
        (None, Some(view)) => {
            let (buffer, range) = buffers.view(root, view.value(), folder).map_err(|unplaced| unplaced.1)?;
            Ok((ImageBytes::Shared(buffer, range), None))
        }
        (None, None) => {
            let what = "it has neither a URI nor a bufferView".to_owned();
            Err(UnreadReason { kind: LoadErrorKind::Malformed, what, remedy: "export the model again" })
        }
    }
}

/// How a texture is sampled; the specification's defaults where it says nothing.
pub(crate) fn convert_sampler(root: &Root, texture: usize) -> Sampler {
    let Some(index) = root.textures[texture].sampler else { return Sampler::default() };
    let from = &root.samplers[index.value()];
    let (minification, mip) = from
        .min_filter
        .as_ref()
        .and_then(valid)
        .map_or_else(|| (Filter::Linear, MipFilter::Linear), minification);
    Sampler {
        wrap_u: valid(&from.wrap_s).map_or(Wrap::Repeat, wrap),
        wrap_v: valid(&from.wrap_t).map_or(Wrap::Repeat, wrap),
        magnification: match from.mag_filter.as_ref().and_then(valid) {
            Some(MagFilter::Nearest) => Filter::Nearest,
            _ => Filter::Linear,
        },
        minification,
        mip,
    }
}

fn wrap(mode: WrappingMode) -> Wrap {
    match mode {
        WrappingMode::ClampToEdge => Wrap::ClampToEdge,
        WrappingMode::MirroredRepeat => Wrap::MirroredRepeat,
        WrappingMode::Repeat => Wrap::Repeat,
    }
}

fn minification(filter: MinFilter) -> (Filter, MipFilter) {
    match filter {
        MinFilter::Nearest => (Filter::Nearest, MipFilter::None),
        MinFilter::Linear => (Filter::Linear, MipFilter::None),
        MinFilter::NearestMipmapNearest => (Filter::Nearest, MipFilter::Nearest),
        MinFilter::LinearMipmapNearest => (Filter::Linear, MipFilter::Nearest),
        MinFilter::NearestMipmapLinear => (Filter::Nearest, MipFilter::Linear),
        MinFilter::LinearMipmapLinear => (Filter::Linear, MipFilter::Linear),
    }
}
