//! The showcase's images, made in code: a floor of two woods, and the soft
//! dark spot under an object.

use trigon_math::{Vec2, Vec3, color};
use trigon_raster::{Texture, TextureFormat};

/// Texels along each side of the floor's image.
const FLOOR_SIDE: u32 = 512;

/// Fields along each side of the image: enough that the grain does not
/// visibly repeat from field to field.
const FIELDS: u32 = 4;

/// sRGB of the two woods.
const WOODS: [Vec3; 2] = [Vec3::new(0.86, 0.74, 0.57), Vec3::new(0.52, 0.35, 0.22)];

/// How many metres of floor the image covers.
pub(super) const METRES: f32 = 4.0;

/// A chequered floor, light and dark wood with the grain turned from field to
/// field. It can be repeated: every field ends with a joint.
pub(super) fn floor() -> Texture {
    let texel = |index: u32| {
        let (x, y) = (index % FLOOR_SIDE, index / FLOOR_SIDE);
        let place = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) * (FIELDS as f32 / FLOOR_SIDE as f32);
        opaque(wood(place))
    };
    let texels = (0..FLOOR_SIDE * FLOOR_SIDE).map(texel).collect();
    Texture::new(FLOOR_SIDE, FLOOR_SIDE, texels, TextureFormat::Srgb).expect("the size is within the limits")
}

/// sRGB of the floor; `place` counts fields.
fn wood(place: Vec2) -> Vec3 {
    let (column, row) = (place.x as u32, place.y as u32);
    let within = place - Vec2::new(column as f32, row as f32);
    let along = if (column + row) % 2 == 0 { within } else { Vec2::new(within.y, within.x) };
    let seed = column * 8 + row;
    // Fibres: noise that is stretched along the grain, and bent by slower noise.
    let bend = noise(along * Vec2::new(1.5, 3.0), seed) * 1.4;
    // Two steps aside, for the bend is at most 1.4 to either side and noise wants no negative places.
    let rings = noise(Vec2::new(along.x * 0.8, along.y * 7.0 + bend + 2.0), seed + 100);
    let fibres = noise(along * Vec2::new(6.0, 70.0), seed + 200);
    let shade = 0.9 + 0.16 * rings + 0.07 * fibres + 0.05 * noise(Vec2::ZERO, seed + 300);
    let edge = smaller(smaller(within.x, 1.0 - within.x), smaller(within.y, 1.0 - within.y));
    let joint = smooth((edge / 0.012).clamp(0.0, 1.0));
    WOODS[((column + row) % 2) as usize] * (shade * (0.55 + 0.45 * joint))
}

/// Texels along each side of a spot's image.
const SPOT_SIDE: u32 = 64;

/// The part of a spot's radius that is wholly black.
const DARKEST: f32 = 0.35;

/// Black that fades out from the middle: what ambient light does not reach
/// under an object.
pub(super) fn spot() -> Texture {
    let texel = |index: u32| {
        let place = Vec2::new((index % SPOT_SIDE) as f32 + 0.5, (index / SPOT_SIDE) as f32 + 0.5);
        let out = (place * (2.0 / SPOT_SIDE as f32) - Vec2::ONE).length().clamp(0.0, 1.0);
        let alpha = smooth(((1.0 - out) / (1.0 - DARKEST)).clamp(0.0, 1.0));
        [0, 0, 0, (alpha * 255.0 + 0.5) as u8]
    };
    let texels = (0..SPOT_SIDE * SPOT_SIDE).map(texel).collect();
    Texture::new(SPOT_SIDE, SPOT_SIDE, texels, TextureFormat::Linear).expect("the size is within the limits")
}

fn opaque(srgb: Vec3) -> [u8; 4] {
    let byte = |channel: f32| color::linear_to_srgb8(color::srgb_to_linear(channel.clamp(0.0, 1.0)));
    [byte(srgb.x), byte(srgb.y), byte(srgb.z), 255]
}

/// Smooth noise, −1 to 1, with a feature per unit: bilinear between hashed
/// lattice points, eased (Perlin's value noise). Both coordinates are at least 0.
fn noise(at: Vec2, seed: u32) -> f32 {
    let (x, y) = (at.x as u32, at.y as u32);
    let (u, v) = (smooth(at.x - x as f32), smooth(at.y - y as f32));
    let [a, b, c, d] = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|(x, y)| lattice(x, y, seed));
    let (top, bottom) = (a + (b - a) * u, c + (d - c) * u);
    top + (bottom - top) * v
}

/// A value for a lattice point, −1 to 1, by the mixing steps of MurmurHash3
/// (Appleby, public domain).
fn lattice(x: u32, y: u32, seed: u32) -> f32 {
    let mut hash = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ seed.wrapping_mul(0xc2b2_ae3d);
    hash = (hash ^ (hash >> 16)).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ (hash >> 13)).wrapping_mul(0xc2b2_ae35);
    hash ^= hash >> 16;
    (hash >> 8) as f32 * (2.0 / 16_777_215.0) - 1.0
}

/// From 0 to 1 with no slope at either end.
fn smooth(t: f32) -> f32 {
    t * t * (3.0 - 2.0 * t)
}

fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}
