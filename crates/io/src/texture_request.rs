//! Textures that a model needs, before their images are decoded.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use trigon_raster::TextureFormat;

use crate::error::Location;
use crate::layers::Role;

/// A texture to create, and where it was named.
pub(crate) struct Request {
    /// A display name: the image's file name, or its name in the model.
    pub(crate) name: String,
    /// The file to report if it is broken.
    pub(crate) file: PathBuf,
    pub(crate) location: Location,
    /// The images that it consists of.
    pub(crate) layers: Vec<(Role, ImageBytes)>,
    pub(crate) purpose: Purpose,
}

/// The use of an image: how its bytes are interpreted, and whether a placeholder replaces it if it
/// cannot be decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Purpose {
    /// The colour of a surface; a placeholder is shown if it cannot be decoded.
    BaseColor,
    /// Another colour.
    Color,
    /// Numbers, such as directions or roughness.
    Data,
}

impl Purpose {
    pub(crate) fn format(self) -> TextureFormat {
        match self {
            Self::BaseColor | Self::Color => TextureFormat::Srgb,
            Self::Data => TextureFormat::Linear,
        }
    }
}

/// The bytes of an image file: its own, or a part of a shared buffer.
pub(crate) enum ImageBytes {
    Own(Vec<u8>),
    Shared(Arc<[u8]>, Range<usize>),
}

impl ImageBytes {
    pub(crate) fn get(&self) -> &[u8] {
        match self {
            Self::Own(bytes) => bytes,
            Self::Shared(buffer, range) => &buffer[range.clone()],
        }
    }
}
