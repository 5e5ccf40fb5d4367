//! Eight images that every renderer can draw. Each measures one thing: how fast pixels are filled, triangles
//! set up, fragments shaded, textures read, hidden surfaces skipped, or samples stored.
//!
//! All are 1920 by 1080 pixels of plain (not sRGB) RGBA8 on [`Scene::BACKGROUND`]; the nearest fragment is
//! visible; nothing is blended. A frame goes from the caller's vertices to the finished row-major image.

mod canvas;
mod geometry;
mod pipelines;
mod scene;
mod texture;
mod timings;

pub use canvas::Canvas;
pub use geometry::{Grid, Mesh};
pub use pipelines::{blinn_phong, lambert_lanes};
pub use scene::{Scene, Shading};
pub use texture::knot_surface;
pub use timings::Timings;

use trigon_math::Vec3;
use trigon_raster::Culling;

/// How many layers [`Workload::FillPass`] and [`Workload::FillReject`] draw.
const LAYERS: u32 = 64;

/// One of the images.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Workload {
    /// Nothing visible: what a frame costs at least.
    Clear,
    /// 64 quads over the whole screen, each nearer than those before: every
    /// fragment passes the depth test.
    FillPass,
    /// The same with the nearest first: 63 of 64 layers are hidden.
    FillReject,
    /// A torus of 1,000,000 triangles, about two for each visible pixel, with
    /// light at the vertices.
    Torus,
    /// A torus knot of 70,000 triangles, lit in each pixel.
    KnotPhong,
    /// The same with a trilinear texture and light at the vertices.
    KnotTextured,
    /// 10,000 cubes in no useful order, most of them hidden, in flat colours.
    Cubes,
    /// [`KnotPhong`](Self::KnotPhong) with four samples a pixel.
    KnotMultisampled,
}

impl Workload {
    /// All of them, in the order of their names.
    pub const ALL: [Self; 8] = [
        Self::Clear,
        Self::FillPass,
        Self::FillReject,
        Self::Torus,
        Self::KnotPhong,
        Self::KnotTextured,
        Self::Cubes,
        Self::KnotMultisampled,
    ];

    /// The name in tables and file names.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Clear => "W0-clear",
            Self::FillPass => "W1a-fill-pass",
            Self::FillReject => "W1b-fill-reject",
            Self::Torus => "W2-torus1M",
            Self::KnotPhong => "W3-knot-phong",
            Self::KnotTextured => "W4-knot-tex",
            Self::Cubes => "W5-cubes10k",
            Self::KnotMultisampled => "W6-knot-msaa4",
        }
    }

    /// What is drawn.
    #[must_use]
    pub fn scene(self) -> Scene {
        match self {
            Self::Clear => Scene::flat(geometry::off_screen()),
            Self::FillPass => Scene::flat(geometry::layers((0..LAYERS).rev())),
            Self::FillReject => Scene::flat(geometry::layers(0..LAYERS)),
            Self::Torus => Scene::torus(Grid { along: 1000, around: 500 }),
            Self::KnotPhong => Scene::knot(Shading::BlinnPhong),
            Self::KnotTextured => Scene::knot(Shading::Textured(Box::new(knot_surface()))),
            Self::Cubes => Scene {
                culling: Culling::Back,
                ..Scene::flat(geometry::cubes()).viewed_from(Vec3::new(30.0, 20.0, 36.0), [1.0, 200.0])
            },
            Self::KnotMultisampled => Scene { samples: 4, ..Scene::knot(Shading::BlinnPhong) },
        }
    }

    /// What one frame of `scene` does, in the unit of the workload's rate:
    /// pixels, all layers counted, or triangles, culled ones included.
    #[must_use]
    pub fn work(self, scene: &Scene) -> f64 {
        let pixels = f64::from(scene.size.x) * f64::from(scene.size.y);
        match self {
            Self::Clear => pixels,
            Self::FillPass | Self::FillReject => pixels * f64::from(LAYERS),
            _ => scene.mesh.triangles.len() as f64,
        }
    }
}

#[cfg(test)]
mod tests;
