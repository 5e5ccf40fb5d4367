//! Textures that a model asks for, before their pictures are decoded.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use trigon_raster::TextureFormat;

use crate::error::Place;
use crate::layers::Role;

/// A texture to make, and where its name was found.
pub(crate) struct Request {
    /// For people: the picture's file name, or its name in the model.
    pub(crate) name: String,
    /// The file that is to blame when it is broken.
    pub(crate) file: PathBuf,
    pub(crate) place: Place,
    /// The pictures that it is made of.
    pub(crate) layers: Vec<(Role, PictureBytes)>,
    pub(crate) purpose: Purpose,
}

/// What a picture is for: how its bytes are meant, and whether its loss must show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Purpose {
    /// The colour of a surface, which nobody may overlook when it is missing.
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

/// The bytes of a picture file: its own, or some of a buffer that many share.
pub(crate) enum PictureBytes {
    Own(Vec<u8>),
    Shared(Arc<[u8]>, Range<usize>),
}

impl PictureBytes {
    pub(crate) fn get(&self) -> &[u8] {
        match self {
            Self::Own(bytes) => bytes,
            Self::Shared(buffer, range) => &buffer[range.clone()],
        }
    }
}
