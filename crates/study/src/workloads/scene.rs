//! The data of a frame.

use super::Mesh;
use super::geometry::{self, Grid};
use std::f64::consts::TAU;
use trigon_math::glam::dcamera::rh::{proj::directx, view};
use trigon_math::{DVec3, Mat4, UVec2, Vec3};
use trigon_raster::{Culling, Texture};
use trigon_scene::quality::Quality;

/// How surfaces get their colours.
#[derive(Clone, Debug)]
pub enum Shading {
    /// Each triangle has one, from [`Mesh::colors`].
    Flat,
    /// Light at the vertices, interpolated.
    Gouraud,
    /// Light and highlight in each pixel, from interpolated normals.
    BlinnPhong,
    /// A texture, read trilinearly, times light at the vertices.
    Textured(Box<Texture>),
}

/// A mesh, how it looks and from where it is seen.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What is drawn, all in one draw.
    pub mesh: Mesh,
    /// Its colours.
    pub shading: Shading,
    /// Which sides are dropped.
    pub culling: Culling,
    /// Shaded places along each side of a pixel.
    pub samples_per_axis: u32,
    /// Samples of coverage and depth in each of them.
    pub samples: u32,
    /// Width and height of the image in pixels.
    pub size: UVec2,
    /// From the mesh to clip space; depth is reversed, 1 near and 0 far.
    pub to_clip_space: Mat4,
    /// Where the eye is, in the mesh's space.
    pub eye: Vec3,
}

impl Scene {
    /// What shows where nothing is drawn: plain RGBA8.
    pub const BACKGROUND: [u8; 4] = [26, 26, 38, 255];

    /// Width times height.
    #[must_use]
    pub fn pixel_count(&self) -> usize {
        self.size.x as usize * self.size.y as usize
    }

    /// With as many samples as a quality has.
    #[must_use]
    pub fn at_quality(self, quality: Quality) -> Self {
        let Quality { samples_per_axis, samples, .. } = quality;
        Self { samples_per_axis, samples, ..self }
    }

    /// Triangles in flat colours, in clip space already.
    pub(super) fn flat(mesh: Mesh) -> Self {
        Self {
            mesh,
            shading: Shading::Flat,
            culling: Culling::None,
            samples_per_axis: 1,
            samples: 1,
            size: UVec2::new(1920, 1080),
            to_clip_space: Mat4::IDENTITY,
            eye: Vec3::ZERO,
        }
    }

    /// A torus with light at its vertices; [`Grid`] divides it.
    #[must_use]
    pub fn torus(grid: Grid) -> Self {
        let scene =
            Self { shading: Shading::Gouraud, culling: Culling::Back, ..Self::flat(geometry::torus(grid)) };
        scene.viewed_from(Vec3::new(0.0, 2.1, 3.0), [0.5, 10.0])
    }

    /// A torus knot of 70,000 triangles.
    #[must_use]
    pub fn knot(shading: Shading) -> Self {
        let scene = Self { shading, culling: Culling::Back, ..Self::flat(geometry::knot()) };
        scene.viewed_from(Vec3::new(0.3, 0.4, 4.6), [1.0, 20.0])
    }

    /// The same, seen in perspective, 45 degrees high, towards the origin; the
    /// image shows what lies between the planes at distances `near` and `far`.
    pub(super) fn viewed_from(self, eye: Vec3, [near, far]: [f64; 2]) -> Self {
        let aspect = f64::from(self.size.x) / f64::from(self.size.y);
        // With the planes exchanged, depth is reversed.
        let projection = directx::perspective(TAU / 8.0, aspect, far, near);
        let view = view::look_at_mat4(eye.as_dvec3(), DVec3::ZERO, DVec3::Y);
        Self { to_clip_space: (projection * view).as_mat4(), eye, ..self }
    }
}
