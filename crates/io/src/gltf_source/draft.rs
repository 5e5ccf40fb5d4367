//! A source under construction, collected during a load on request; see `keep`.

use std::collections::BTreeMap;
use std::sync::Arc;

use trigon_scene::TextureId;

use super::origins::Origins;
use super::text::JsonText;
use super::{GltfSource, SharedBytes};
use crate::texture_request::{ImageBytes, Request};

/// The data collected so far.
#[derive(Default)]
pub(crate) struct SourceDraft {
    /// `None` as long as the file is not known to be a glTF.
    pub(crate) text: Option<JsonText>,
    pub(crate) buffers: Vec<Option<Arc<[u8]>>>,
    pub(crate) images: BTreeMap<usize, SharedBytes>,
    pub(crate) image_count: usize,
    pub(crate) origins: Origins,
}

impl SourceDraft {
    /// Records the images given by their index in `requests`, and the textures that they became.
    pub(crate) fn note_images(
        &mut self,
        requests: &[Request],
        textures: &[Option<TextureId>],
        images: impl Iterator<Item = (usize, usize)>,
    ) {
        // Many images may be the same file, which is kept once.
        let shared: Vec<SharedBytes> = requests.iter().map(|request| share(&request.layers[0].1)).collect();
        for (image, request) in images {
            self.images.entry(image).or_insert_with(|| shared[request].clone());
            if let Some(id) = textures[request] {
                self.origins.textures.entry(id).or_default().insert(image);
            }
        }
    }

    /// Records the next animation of the scene.
    pub(crate) fn note_animation(&mut self, index: usize) {
        self.origins.animations.push(index);
    }

    /// The source; `None` if the file was not a glTF.
    pub(crate) fn finish(self) -> Option<GltfSource> {
        let Self { text, buffers, mut images, image_count, origins } = self;
        let images = (0..image_count).map(|image| images.remove(&image)).collect();
        Some(GltfSource { text: text?, buffers, images, origins })
    }
}

pub(crate) fn share(bytes: &ImageBytes) -> SharedBytes {
    match bytes {
        ImageBytes::Own(bytes) => SharedBytes { bytes: bytes.as_slice().into(), range: 0..bytes.len() },
        ImageBytes::Shared(buffer, range) => SharedBytes { bytes: buffer.clone(), range: range.clone() },
    }
}
