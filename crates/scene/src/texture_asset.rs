//! Textures that materials share.

use std::sync::Arc;

use trigon_raster::Texture;

use crate::arena::Id;

/// Identifies a texture.
pub type TextureId = Id<TextureAsset>;

/// A texture that the scene shares between materials.
#[derive(Clone, Debug)]
pub struct TextureAsset {
    /// A display name; need not be unique.
    pub name: String,
    /// The image.
    pub texture: Arc<Texture>,
}
