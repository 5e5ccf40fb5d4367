//! The pipeline that draws faces: composed of the attributes that a material
//! calls for, so that what it does not use is neither fetched nor interpolated.
//!
//! Each optional part has an absent form, `()`, whose varyings have no size.

use trigon_math::{Mat3, Mat4, Vec2, Vec3, Vec4};
use trigon_raster::{Fragment, Pipeline, Texture, Varyings, VertexOutput};

use super::lighting::{Lights, LitPoint};
use crate::material::{Shading, TextureBinding};

/// Faces of one mesh in one material.
pub(super) struct Surface<'a, L, T, C> {
    pub(super) positions: &'a [Vec3],
    pub(super) to_clip: Mat4,
    pub(super) light: L,
    pub(super) texture: T,
    pub(super) color: C,
    pub(super) base_color: Vec4,
    pub(super) emissive: Vec3,
    /// Alpha below this is a hole; see [`Pipeline::mask`].
    pub(super) cutoff: f32,
    pub(super) coverage: Coverage,
    pub(super) edges: Option<EdgeOverlay>,
}

/// What a surface's alpha does to its colour.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Coverage {
    /// Alpha is 1 whatever the material says.
    Opaque,
    /// Alpha is what the material says.
    Translucent,
}

/// Edges drawn on the surface, in shading: they cannot fight with it for depth.
#[derive(Clone, Copy)]
pub(super) struct EdgeOverlay {
    pub(super) color: Vec3,
    /// Pixels.
    pub(super) half_width: f32,
}

/// How light reaches a surface, if it does.
pub(super) trait LightPart: Sync {
    type Varyings: Varyings;
    fn vertex(&self, position: Vec3, index: usize) -> Self::Varyings;
    /// `facing` is the side that winds counter-clockwise on the screen when the
    /// object is not mirrored.
    fn shade(&self, albedo: Vec3, fragment: &Self::Varyings, facing: Side) -> Vec3;
}

/// A side of a face.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Front,
    Back,
}

impl LightPart for () {
    type Varyings = ();
    fn vertex(&self, _: Vec3, _: usize) {}
    fn shade(&self, albedo: Vec3, (): &(), _: Side) -> Vec3 {
        albedo
    }
}

/// Per-pixel lighting in camera space.
pub(super) struct Lit<'a> {
    pub(super) normals: &'a [Vec3],
    pub(super) to_camera: Mat4,
    pub(super) normal_to_camera: Mat3,
    /// Whether rays of view meet in the camera, or run parallel.
    pub(super) rays: Rays,
    pub(super) lights: &'a Lights,
    pub(super) shading: Shading,
    /// The side that a counter-clockwise triangle shows; see `Placement`.
    pub(super) front: Side,
}

/// How rays of view run.
#[derive(Clone, Copy)]
pub(super) enum Rays {
    /// Perspective.
    Meeting,
    /// Orthographic.
    Parallel,
}

impl LightPart for Lit<'_> {
    /// Position and normal in camera space.
    type Varyings = (Vec3, Vec3);

    fn vertex(&self, position: Vec3, index: usize) -> Self::Varyings {
        let normal = (self.normal_to_camera * self.normals[index]).normalize_or_zero();
        (self.to_camera.transform_point3(position), normal)
    }

    fn shade(&self, albedo: Vec3, &(position, normal): &Self::Varyings, facing: Side) -> Vec3 {
        let normal = normal.normalize_or_zero();
        let normal = if facing == self.front { normal } else { -normal };
        let view = match self.rays {
            Rays::Meeting => (-position).normalize_or_zero(),
            Rays::Parallel => Vec3::Z,
        };
        self.lights.shade(&LitPoint { position, normal, view }, albedo, &self.shading)
    }
}

/// What multiplies the base colour by a texture, if anything does.
pub(super) trait TexturePart: Sync {
    type Varyings: Varyings;
    fn vertex(&self, index: usize) -> Self::Varyings;
    fn sample(&self, uv: &Self::Varyings, ddx: &Self::Varyings, ddy: &Self::Varyings) -> Vec4;
}

impl TexturePart for () {
    type Varyings = ();
    fn vertex(&self, _: usize) {}
    fn sample(&self, (): &(), (): &(), (): &()) -> Vec4 {
        Vec4::ONE
    }
}

/// A texture on one UV set.
pub(super) struct Textured<'a> {
    pub(super) uvs: &'a [Vec2],
    pub(super) texture: &'a Texture,
    pub(super) binding: &'a TextureBinding,
}

impl TexturePart for Textured<'_> {
    type Varyings = Vec2;

    fn vertex(&self, index: usize) -> Vec2 {
        self.binding.transform.transform_point2(self.uvs[index])
    }

    fn sample(&self, uv: &Vec2, ddx: &Vec2, ddy: &Vec2) -> Vec4 {
        self.texture.sample(*uv, *ddx, *ddy, &self.binding.sampler)
    }
}

/// What multiplies the base colour by colours of the mesh, if it has any.
pub(super) trait ColorPart: Sync {
    type Varyings: Varyings;
    fn vertex(&self, index: usize) -> Self::Varyings;
    fn color(&self, color: &Self::Varyings) -> Vec4;
}

impl ColorPart for () {
    type Varyings = ();
    fn vertex(&self, _: usize) {}
    fn color(&self, (): &()) -> Vec4 {
        Vec4::ONE
    }
}

/// Colours of the mesh's corners.
pub(super) struct Colored<'a>(pub(super) &'a [Vec4]);

impl ColorPart for Colored<'_> {
    type Varyings = Vec4;

    fn vertex(&self, index: usize) -> Vec4 {
        self.0[index]
    }

    fn color(&self, color: &Vec4) -> Vec4 {
        *color
    }
}

type Parts<L, T, C> = (<L as LightPart>::Varyings, <T as TexturePart>::Varyings, <C as ColorPart>::Varyings);

impl<L: LightPart, T: TexturePart, C: ColorPart> Surface<'_, L, T, C> {
    /// Linear RGB and straight alpha before lighting.
    #[inline]
    fn albedo(&self, fragment: &Fragment<Parts<L, T, C>>) -> Vec4 {
        let (at, ddx, ddy) = (&fragment.varyings, &fragment.ddx, &fragment.ddy);
        self.base_color * self.texture.sample(&at.1, &ddx.1, &ddy.1) * self.color.color(&at.2)
    }
}

impl<L: LightPart, T: TexturePart, C: ColorPart> Pipeline for Surface<'_, L, T, C> {
    type Varyings = Parts<L, T, C>;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Self::Varyings> {
        let position = self.positions[index];
        let varyings =
            (self.light.vertex(position, index), self.texture.vertex(index), self.color.vertex(index));
        VertexOutput { position: self.to_clip * position.extend(1.0), varyings }
    }

    fn fragment(&self, fragment: &Fragment<Self::Varyings>) -> Vec4 {
        let albedo = self.albedo(fragment);
        let facing = if fragment.front_facing { Side::Front } else { Side::Back };
        let shaded = self.light.shade(albedo.truncate(), &fragment.varyings.0, facing) + self.emissive;
        let alpha = if self.coverage == Coverage::Opaque { 1.0 } else { albedo.w.clamp(0.0, 1.0) };
        let color = (shaded * alpha).extend(alpha);
        self.edges.map_or(color, |edges| edges.over(color, fragment.nearest_edge()))
    }

    fn mask(&self, fragment: &Fragment<Self::Varyings>) -> bool {
        self.albedo(fragment).w >= self.cutoff
    }
}

impl EdgeOverlay {
    /// The edge's colour over the surface's, fading out over one pixel.
    pub(super) fn over(&self, color: Vec4, distance: f32) -> Vec4 {
        let edge = (self.half_width + 0.5 - distance).clamp(0.0, 1.0);
        color * (1.0 - edge) + self.color.extend(1.0) * edge
    }
}
