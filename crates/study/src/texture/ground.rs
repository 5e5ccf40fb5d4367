//! A checkered plane below the eye, in closed form.

use trigon_raster::{Texture, TextureFormat};

/// Squares of 8 texels, 64 texels to the metre, one metre below the eye.
pub struct Ground {
    width: usize,
    texture: Texture,
}

const SIDE: u32 = 64;
const SQUARE: u32 = 8;

/// Light and dark as bytes of linear light.
const TINTS: [u8; 2] = [230, 20];

impl Ground {
    /// In an image of `width` pixels, all of it below the horizon.
    #[must_use]
    pub fn new(width: usize) -> Self {
        let texel = |x: u32, y: u32| {
            let tint = TINTS[((x / SQUARE + y / SQUARE) % 2) as usize];
            [tint, tint, tint, 255]
        };
        let texels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| texel(x, y))).collect();
        let texture = Texture::new(SIDE, SIDE, texels, TextureFormat::Linear).expect("the size is in range");
        Self { width, texture }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.width / 2]
    }

    pub(super) fn texture(&self) -> &Texture {
        &self.texture
    }

    /// How far ahead a point of the image lies on the floor, in metres.
    pub(super) fn distance(&self, [_, y]: [f64; 2]) -> f64 {
        let scale = self.width as f64 / 2.0;
        // The horizon lies a twentieth of the height above the image.
        scale / (y + self.width as f64 / 40.0)
    }

    /// Texture coordinates at a point of the image, turned by 0.6 against it.
    pub(super) fn coordinates(&self, point: [f64; 2]) -> [f64; 2] {
        const TURN: [f64; 2] = [0.8, 0.6];
        let (scale, ahead) = (self.width as f64 / 2.0, self.distance(point));
        let right = (point[0] - scale) / scale * ahead;
        [TURN[0] * right - TURN[1] * ahead, TURN[1] * right + TURN[0] * ahead]
    }

    /// The light at a point of the image: that of the texel it lies in.
    pub(super) fn light(&self, point: [f64; 2]) -> f64 {
        let squares = self.coordinates(point).map(|part| (part * f64::from(SIDE / SQUARE)).floor() as i64);
        f64::from(TINTS[(squares[0] + squares[1]).rem_euclid(2) as usize]) / 255.0
    }
}
