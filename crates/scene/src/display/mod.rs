//! What faces show: the lit image, one clay for all, or one value of their surfaces.

use trigon_math::{Vec3, Vec4};

use crate::material::{AlphaMode, Material, Shading};

/// What the faces of an image show.
///
/// Values that are no colours (all but those of base colour and emission) are shown as they are stored: 0 is black
/// and 1 is the display's white, so that the byte of a pixel is 255 times the value. What is blended is shown as
/// opaque, and masks keep their holes. Effects of light are off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Display {
    /// Their materials, in light.
    #[default]
    Shaded,
    /// One clay for all faces in the studio's lights, which go with the camera: so a colour tells how a face is
    /// turned to it, whatever its material is.
    Matcap,
    /// The base colour, with textures and vertex colours.
    BaseColor,
    /// The normal that light falls on, along the world's axes: −1 to 1 become 0 to 1.
    Normal,
    /// The normal of the triangle's plane, likewise.
    GeometricNormal,
    /// Coordinates of the first UV set, without their whole parts, in red and green.
    TextureCoordinates,
    /// How metallic a surface is.
    Metallic,
    /// Perceptual roughness.
    Roughness,
    /// The share of ambient light that the occlusion texture lets through.
    Occlusion,
    /// What a surface sends out by itself.
    Emission,
    /// The alpha of the base colour.
    Alpha,
    /// The distance along the view axis: near is dark, the farthest is light grey, and white is the background. One
    /// sample for each pixel.
    Depth,
}

impl Display {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Shaded,
        Self::Matcap,
        Self::BaseColor,
        Self::Normal,
        Self::GeometricNormal,
        Self::TextureCoordinates,
        Self::Metallic,
        Self::Roughness,
        Self::Occlusion,
        Self::Emission,
        Self::Alpha,
        Self::Depth,
    ];

    /// Its name on command lines and in menus, in lower case.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Shaded => "shaded",
            Self::Matcap => "matcap",
            Self::BaseColor => "base-color",
            Self::Normal => "normal",
            Self::GeometricNormal => "geometric-normal",
            Self::TextureCoordinates => "uv",
            Self::Metallic => "metallic",
            Self::Roughness => "roughness",
            Self::Occlusion => "occlusion",
            Self::Emission => "emission",
            Self::Alpha => "alpha",
            Self::Depth => "depth",
        }
    }

    /// The material that takes the place of another one; `None` where it stays.
    pub(crate) fn replaced(self, material: &Material) -> Option<Material> {
        match self {
            Self::Shaded => None,
            Self::Matcap => Some(clay()),
            _ if material.alpha_mode == AlphaMode::Blend => {
                Some(Material { alpha_mode: AlphaMode::Opaque, ..material.clone() })
            }
            _ => None,
        }
    }
}

/// The clay of [`Display::Matcap`].
fn clay() -> Material {
    /// Linear.
    const CLAY: Vec4 = Vec4::new(0.5, 0.2, 0.12, 1.0);
    Material {
        base_color: CLAY,
        shading: Shading::blinn_phong(Vec3::splat(0.3), 20.0),
        alpha_mode: AlphaMode::Opaque,
        ..Material::default()
    }
}

#[cfg(test)]
mod tests;
