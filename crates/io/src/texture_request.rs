//! Textures that a model needs, before their images are decoded, and the images that are combined into one:
//! MTL stores colour and opacity, or roughness and metalness, in separate files.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use trigon_raster::TextureFormat;

use super::error::Location;
use super::rgba_image::RgbaImage;

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

/// The part of the texture that an image provides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Role {
    /// All of it.
    Whole,
    /// Its alpha: from the image's own alpha, or from its grey if that is opaque everywhere.
    Alpha,
    /// Its green, where glTF stores roughness.
    Roughness,
    /// Its blue, where glTF stores metalness.
    Metallic,
    /// Its green: 1 − its alpha times a factor.
    Glossiness {
        /// The bits of an f32 from 0 to 1.
        factor: u32,
    },
    /// All of it, but only if it contains directions and not heights.
    Directions,
}

/// An image that should contain directions contains heights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct HeightMap;

/// Combines images, the first below. Smaller ones are stretched to the largest; channels without an
/// image are white.
pub(crate) fn merge(mut layers: Vec<(Role, RgbaImage)>) -> Result<RgbaImage, HeightMap> {
    match layers.as_slice() {
        [(Role::Whole, _)] => return Ok(layers.remove(0).1),
        [(Role::Directions, image)] if shows_directions(image) => return Ok(layers.remove(0).1),
        [(Role::Directions, _)] => return Err(HeightMap),
        _ => {}
    }
    let largest = layers.iter().max_by_key(|(_, image)| u64::from(image.width) * u64::from(image.height));
    let (width, height) = largest.map_or((1, 1), |(_, image)| (image.width, image.height));
    let mut merged = RgbaImage { width, height, rgba: vec![255; 4 * width as usize * height as usize] };
    for (role, layer) in &layers {
        lay_over(&mut merged, *role, layer);
    }
    Ok(merged)
}

fn lay_over(merged: &mut RgbaImage, role: Role, layer: &RgbaImage) {
    let has_alpha = layer.rgba.chunks_exact(4).any(|texel| texel[3] != 255);
    let stretched = |at: usize, from: u32, to: u32| at * from as usize / to as usize;
    let (width, row) = (merged.width as usize, layer.width as usize);
    for (index, texel) in merged.rgba.chunks_exact_mut(4).enumerate() {
        let x = stretched(index % width, layer.width, merged.width);
        let y = stretched(index / width, layer.height, merged.height);
        let from = &layer.rgba[4 * (y * row + x)..][..4];
        match role {
            Role::Whole | Role::Directions => texel.copy_from_slice(from),
            Role::Alpha => texel[3] = if has_alpha { from[3] } else { from[0] },
            Role::Roughness => texel[1] = from[0],
            Role::Metallic => texel[2] = from[0],
            Role::Glossiness { factor } => {
                texel[1] = (255.5 - f32::from_bits(factor) * f32::from(from[3])) as u8;
            }
        }
    }
}

/// Whether the colours of an image are directions: mostly up, which is blue, and balanced sideways.
/// Heights are grey.
fn shows_directions(image: &RgbaImage) -> bool {
    let texels = image.rgba.len() as u64 / 4;
    let mean = |channel: usize| {
        let sum: u64 = image.rgba.iter().skip(channel).step_by(4).map(|&value| u64::from(value)).sum();
        sum / texels.max(1)
    };
    let sideways = 88..=168;
    mean(2) >= 160 && sideways.contains(&mean(0)) && sideways.contains(&mean(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, texels: &[[u8; 4]]) -> RgbaImage {
        RgbaImage { width, height: texels.len() as u32 / width, rgba: texels.concat() }
    }

    #[test]
    fn each_image_fills_its_channels() {
        let (color, grey) = ([[1, 2, 3, 255]; 4], [[9, 9, 9, 255], [200, 200, 200, 255]]);
        let layers = vec![(Role::Whole, image(2, &color)), (Role::Alpha, image(2, &grey))];
        let expected = [[1, 2, 3, 9], [1, 2, 3, 200]].repeat(2);
        assert_eq!(merge(layers), Ok(image(2, &expected)), "stretched over two rows");
        let clear = [[0, 0, 0, 7]];
        let layers = vec![(Role::Whole, image(2, &color)), (Role::Alpha, image(1, &clear))];
        assert_eq!(merge(layers), Ok(image(2, &[[1, 2, 3, 7]; 4])), "its own alpha");
        let layers = vec![(Role::Roughness, image(1, &[[50; 4]])), (Role::Metallic, image(1, &[[60; 4]]))];
        assert_eq!(merge(layers), Ok(image(1, &[[255, 50, 60, 255]])), "as glTF keeps them");
        for (factor, roughness) in [(1.0_f32, 205), (0.5, 230), (0.0, 255)] {
            let layers = vec![(Role::Glossiness { factor: factor.to_bits() }, image(1, &[[9, 9, 9, 50]]))];
            let made = merge(layers).expect("an image").rgba[1];
            assert_eq!(made, roughness, "1 − 50/255 · {factor}");
        }
    }

    #[test]
    fn directions_are_told_from_heights() {
        let up = image(1, &[[128, 127, 255, 255]]);
        assert_eq!(merge(vec![(Role::Directions, up.clone())]), Ok(up), "a normal map");
        for grey in [0, 128, 255] {
            let heights = image(1, &[[grey, grey, grey, 255]]);
            assert_eq!(merge(vec![(Role::Directions, heights)]), Err(HeightMap), "heights at {grey}");
        }
    }
}
