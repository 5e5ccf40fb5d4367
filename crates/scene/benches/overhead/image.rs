//! What both ways of drawing show.

use trigon_raster::{Texture, TextureFormat};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::math::{DVec3, Vec3};
use trigon_scene::mesh::primitives::{TorusKnot, torus_knot};
use trigon_scene::mesh::{Attributes, Mesh};

pub(crate) const SIZE: [u32; 2] = [1920, 1080];
pub(crate) const AMBIENT: f32 = 0.1;
/// Of the one lamp: parallel light along −Z of the world.
pub(crate) const LIGHT: f32 = 0.9;
pub(crate) const COLOR: Vec3 = Vec3::new(0.85, 0.65, 0.4);
pub(crate) const BEHIND: Vec3 = Vec3::new(0.1, 0.1, 0.15);
/// The side of the shadow map in texels.
pub(crate) const SHADOW_TEXELS: u32 = 1024;

/// The material of the knot and its light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Class {
    /// One colour, unlit.
    Plain,
    /// A texture, and light at the vertices.
    Textured,
    /// One colour, and Lambert's light in each pixel.
    Lit,
    /// A texture, a normal map, Lambert's light in each pixel, and the lamp's shadow map, which is drawn in the first
    /// frame.
    Mapped,
    /// Base colour, normals, metalness and roughness from textures; GGX in the light of the lamp alone.
    Metal,
}

impl Class {
    pub(crate) const ALL: [Self; 5] = [Self::Plain, Self::Textured, Self::Lit, Self::Mapped, Self::Metal];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Textured => "textured",
            Self::Lit => "lit",
            Self::Mapped => "mapped",
            Self::Metal => "metal",
        }
    }

    pub(crate) fn has_normal_map(self) -> bool {
        matches!(self, Self::Mapped | Self::Metal)
    }
}

/// The knot, with tangents if its class needs them.
pub(crate) fn knot(class: Class) -> Mesh {
    let mut mesh = torus_knot(&TorusKnot {
        major_radius: 1.0,
        minor_radius: 0.5,
        tube_radius: 0.28,
        segments: 700,
        sides: 50,
        ..TorusKnot::default()
    });
    if class.has_normal_map() {
        let corner_tangents = mesh.generate_tangents(0);
        let attributes = Attributes { corner_tangents, ..mesh.attributes().clone() };
        mesh.set_attributes(attributes).expect("there is a tangent for each corner");
    }
    mesh
}

pub(crate) fn camera() -> Camera {
    let projection = Projection::perspective(45_f64.to_radians(), 1.0, Some(20.0));
    let camera = Camera::look_at(DVec3::new(0.3, 0.4, 4.6), DVec3::ZERO, DVec3::Y);
    Camera { projection: projection.expect("the numbers are in range"), ..camera }
}

/// A checker with a finer pattern in its squares.
pub(crate) fn checker() -> Texture {
    texture(TextureFormat::Srgb, |x, y| {
        let shade = (x ^ y) % 64 * 2 / 3;
        let tint = if (x / 64 + y / 64) % 2 == 1 { [230, 120, 60] } else { [60, 130, 220] };
        tint.map(|channel: u32| (channel - shade) as u8)
    })
}

/// Normals that tilt to and fro.
pub(crate) fn bumps() -> Texture {
    let tilt = |i: u32| (128 + (i % 32).abs_diff(16) * 4 - 32) as u8;
    texture(TextureFormat::Linear, |x, y| [tilt(x), tilt(y), 230])
}

/// Stripes of roughness, and squares of metal.
pub(crate) fn metal_and_roughness() -> Texture {
    texture(TextureFormat::Linear, |x, y| {
        let roughness = 60 + (x + y) % 128;
        [0, roughness as u8, if (x / 128 + y / 128) % 2 == 1 { 255 } else { 0 }]
    })
}

/// An opaque texture of 1024² texels.
fn texture(format: TextureFormat, texel: impl Fn(u32, u32) -> [u8; 3]) -> Texture {
    let opaque = |[r, g, b]: [u8; 3]| [r, g, b, 255];
    let texels = (0..1024).flat_map(|y| (0..1024).map(move |x| [x, y]));
    let texels = texels.map(|[x, y]| opaque(texel(x, y))).collect();
    Texture::new(1024, 1024, texels, format).expect("the size is in range")
}
