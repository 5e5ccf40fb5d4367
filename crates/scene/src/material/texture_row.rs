//! The properties of each texture slot of a material.

use trigon_raster::TextureFormat;

use super::{Material, TextureBinding};
use crate::effect::Effect;

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
