//! The images of a material library, in their original encoding or as PNG.

use std::collections::BTreeMap;
use std::path::Path;

use trigon_scene::{Scene, TextureId};

use super::names::Names;
use crate::export::{ExportedFile, plain_name};
use crate::formats::gltf::mime_type;
use crate::gltf_source::GltfSource;
use crate::png::{Pixels, encode_png};

pub(super) struct ImageFiles<'a> {
    /// What all names begin with, so that none is that of another model's image.
    stem: &'a str,
    scene: &'a Scene,
    source: Option<&'a GltfSource>,
    names: Names,
    known: BTreeMap<TextureId, String>,
    files: Vec<ExportedFile>,
}

impl<'a> ImageFiles<'a> {
    pub(super) fn new(stem: &'a str, scene: &'a Scene, source: Option<&'a GltfSource>) -> Self {
        let (names, known, files) = Default::default();
        Self { stem, scene, source, names, known, files }
    }

    pub(super) fn into_files(self) -> Vec<ExportedFile> {
        self.files
    }

    /// The name of a texture's file; none if the texture is gone.
    pub(super) fn file(&mut self, id: TextureId) -> Option<String> {
        if let Some(name) = self.known.get(&id) {
            return Some(name.clone());
        }
        let asset = self.scene.textures.get(id)?;
        let origin = self.source.and_then(|source| source.image(source.images(id).next()?));
        let encoded = origin.and_then(|bytes| Some((bytes.to_vec(), ending(mime_type(bytes)?)?)));
        let (bytes, ending) = encoded.unwrap_or_else(|| {
            let texels: Vec<u8> = asset.texture.texels().flatten().collect();
            let mut png = Vec::new();
            let (width, height) = (asset.texture.width(), asset.texture.height());
            encode_png(&mut png, width, height, Pixels::Rgba8(&texels)).expect("memory takes an image");
            (png, "png")
        });
        let own = asset.name.replace('\\', "/");
        let own = Path::new(&own).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = self.names.unique(&format!("{}_{}", self.stem, plain_name(&own, "texture")), "texture");
        let name = format!("{name}.{ending}");
        self.files.push(ExportedFile { name: name.clone(), bytes });
        self.known.insert(id, name.clone());
        Some(name)
    }
}

/// The ending of a kind of image that other programs read in an MTL.
fn ending(mime_type: &str) -> Option<&'static str> {
    match mime_type {
        "image/png" => Some("png"),
        "image/jpeg" => Some("jpg"),
        "image/webp" => Some("webp"),
        _ => None,
    }
}
