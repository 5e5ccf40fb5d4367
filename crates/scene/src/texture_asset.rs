//! Textures as materials share them.

use std::sync::Arc;

use trigon_raster::Texture;

use crate::arena::Id;

/// Names a texture.
pub type TextureId = Id<TextureAsset>;

/// A texture as the scene shares it between materials.
#[derive(Clone, Debug)]
pub struct TextureAsset {
    /// For people; need not be unique.
    pub name: String,
    /// The picture.
    pub texture: Arc<Texture>,
}
