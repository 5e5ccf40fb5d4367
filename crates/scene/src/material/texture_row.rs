//! Textures as materials use them, and the properties of each texture slot of a material.

use trigon_math::glam::Affine2;
use trigon_raster::{Sampler, TextureFormat};

use super::Material;
use crate::effect::Effect;
use crate::texture_asset::TextureId;

/// All that planner, renderer, importers and exporters know of a texture's place.
pub(crate) struct TextureRow {
    /// Whether the image holds colours or data.
    pub(crate) format: TextureFormat,
    /// The effect that its look-ups are counted for.
    pub(crate) effect: Effect,
    pub(crate) drawn_if: DrawnIf,
    /// Whether the material's factors leave anything of it to be seen: a texture times 0 shows nothing. Asked
    /// through [`MaterialTexture::matters`].
    pub(super) matters: fn(&Material) -> bool,
    pub(crate) get: fn(&Material) -> Option<TextureBinding>,
    pub(crate) set: fn(&mut Material, Option<TextureBinding>),
}

/// What a draw must have so that a texture can be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DrawnIf {
    /// Nothing more than coordinates.
    Always,
    /// Light that is found at each pixel.
    LightInPixels,
    /// The same, and ambient light.
    AmbientLightInPixels,
    /// Light that is found at each pixel, and tangents.
    TangentsInPixels,
    /// Rays that go on through the surface.
    Refracting,
}

/// Lists the places of textures: the variant and its row.
macro_rules! texture_rows {
    ($($(#[$doc:meta])* $slot:ident => $row:expr),+ $(,)?) => {
        /// A place of a material that can have a texture.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum MaterialTexture {
            $($(#[$doc])* $slot),+
        }

        impl MaterialTexture {
            /// All of them.
            pub const ALL: [Self; [$(stringify!($slot)),+].len()] = [$(Self::$slot),+];

            /// Whether its images hold colours or data.
            #[must_use]
            pub fn format(self) -> TextureFormat {
                self.row().format
            }

            /// Whether the material's factors leave anything of its texture here to be seen.
            pub(crate) fn matters(self, material: &Material) -> bool {
                keeps_unseen() || (self.row().matters)(material)
            }

            pub(crate) fn row(self) -> &'static TextureRow {
                match self {
                    $(Self::$slot => const { &$row }),+
                }
            }
        }
    };
}
pub(super) use texture_rows;

/// A texture, its coordinates, and its sampling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureBinding {
    /// The texture. Its own format (`Texture::format`) says whether its bytes are colours or data;
    /// an image used both ways is two textures.
    pub texture: TextureId,
    /// The UV set of the mesh. A mesh without it shows no texture.
    pub uv_set: usize,
    /// Applied to the coordinates before sampling (v grows downwards).
    pub transform: Affine2,
    /// Wrapping and filtering.
    pub sampler: Sampler,
}

impl TextureBinding {
    /// The texture on the first UV set, repeated and filtered.
    #[must_use]
    pub fn new(texture: TextureId) -> Self {
        Self { texture, uv_set: 0, transform: Affine2::IDENTITY, sampler: Sampler::default() }
    }
}

/// A normal map: red, green and blue, 0 to 1, stand for x, y and z from −1 to 1 along tangent, bitangent and
/// normal. Green points up in the image, against v (as in glTF 2.0, section 3.9.3). A mesh without tangents
/// gets them from the binding's UV set; beyond the eighth set there are none, and the map is not drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// The directions; the texture holds data.
    pub binding: TextureBinding,
    /// Multiplies x and y before the direction is normalized; 1 leaves them as they are, 0
    /// flattens, negative values invert bumps.
    pub scale: f32,
}

/// A map of how much ambient light reaches the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occlusion {
    /// Red is the fraction that arrives; the texture holds data. Light from lamps is not reduced.
    pub binding: TextureBinding,
    /// 0 (no effect) to 1 (as in the texture): the factor on ambient light is `1 + strength · (red
    /// − 1)`.
    pub strength: f32,
}
