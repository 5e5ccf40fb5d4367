//! The shadow map of parallel light: depths that are drawn once, and looked up as `effects/shadow.rs` says.

use std::error::Error;

use trigon_raster::simd::{F32, I32, InlineMap, LANES, Simd, greater, inlined, lanes_of, lesser, prelude::*};
use trigon_raster::{Culling, Draw, FragmentLanes, LanePipeline, Pass, Rasterizer, Target, VertexLanes};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::math::{Bounds3, DAffine3, DMat4, DVec3, DVec4, Mat4, Vec3};

use super::one_thread;
use super::surface::{Columns, clip};
use crate::image::SHADOW_TEXELS;
use crate::lanes::{V3, dot, mix, positive, scaled, sum};

pub(super) struct ShadowMap {
    /// Reversed depth, 0 where nothing is; row by row.
    depths: Vec<f32>,
    /// From camera space to the column, the row and the depth.
    to_texels: [[f32; 4]; 3],
    /// The width of a texel in metres.
    texel: f32,
}

/// Eight points that the lamp may not reach, in camera space.
pub(super) struct Receivers<S: Simd> {
    pub(super) position: V3<S>,
    /// Interpolated normals, of unit length.
    pub(super) facing: V3<S>,
    /// Perpendicular to the triangles, of any length.
    pub(super) plane: V3<S>,
    /// To the lamp.
    pub(super) towards: V3<S>,
}

impl ShadowMap {
    pub(super) fn new(
        columns: &Columns,
        triangles: &[[u32; 3]],
        camera: &Camera,
    ) -> Result<Self, Box<dyn Error>> {
        let seen = LampView::of(columns)?;
        let caster = Caster { positions: &columns.positions, to_clip: seen.to_clip.as_mat4() };
        let mut depths = vec![0.0; SHADOW_TEXELS as usize * SHADOW_TEXELS as usize];
        let mut target = Target::new(SHADOW_TEXELS, SHADOW_TEXELS, &[])?.with_depth(&mut depths)?;
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&caster, triangles) });
        Rasterizer::new(one_thread())?.draw(&pass, &mut target);
        drop(target);
        let half = f64::from(SHADOW_TEXELS) / 2.0;
        let to_texels = DMat4::from_cols(
            DVec4::new(half, 0.0, 0.0, 0.0),
            DVec4::new(0.0, -half, 0.0, 0.0),
            DVec4::Z,
            DVec4::new(half, half, 0.0, 1.0),
        );
        let to_world = DAffine3::from_rotation_translation(camera.orientation, camera.position);
        let rows = (to_texels * seen.to_clip * DMat4::from(to_world)).as_mat4().transpose();
        let [x, y, depth, _] = rows.to_cols_array_2d();
        let texel = (seen.width / f64::from(SHADOW_TEXELS)) as f32;
        Ok(Self { depths, to_texels: [x, y, depth], texel })
    }

    /// The fraction of the lamp's light that arrives.
    #[inline(always)]
    pub(super) fn share<S: Simd>(&self, simd: S, points: &Receivers<S>) -> F32<S> {
        let Receivers { position, facing, plane, towards } = *points;
        let cosine = dot(facing, towards);
        let sine = positive(1.0 - cosine * cosine).sqrt();
        let square = dot(plane, plane);
        let upright = greater(dot(plane, facing).abs(), square.sqrt() * 0.5);
        let part = dot(plane, towards);
        let leaning = positive(square - part * part).sqrt() / upright;
        const ASIDE: f32 = std::f32::consts::SQRT_2;
        let offset = greater(leaning * ASIDE, sine * ASIDE + 0.25) * self.texel;
        let [x, y, z] = sum(position, scaled(facing, offset));
        let [column, row, depth] = self.to_texels.each(
            #[inline(always)]
            |[a, b, c, d]| x * a + y * b + z * c + d,
        );
        self.compared(simd, [column, row], depth)
    }

    /// The fraction of four texels around points that are at least as far from the lamp.
    #[inline(always)]
    fn compared<S: Simd>(&self, simd: S, position: [F32<S>; 2], depth: F32<S>) -> F32<S> {
        const SIDE: f32 = SHADOW_TEXELS as f32;
        let zero = F32::splat(simd, 0.0);
        let axis = inlined(
            #[inline(always)]
            |value: F32<S>| {
                let held = lesser(greater(value, zero), F32::splat(simd, SIDE)) - 0.5;
                let first = held.floor();
                let [before, after] =
                    [greater(first, zero), lesser(first + 1.0, F32::splat(simd, SIDE - 1.0))];
                ([before.to_int::<I32<S>>(), after.to_int()], held - first)
            },
        );
        let ((columns, across), (rows, down)) = (axis(position[0]), axis(position[1]));
        let rows = [rows[0] * SHADOW_TEXELS as i32, rows[1] * SHADOW_TEXELS as i32];
        let lit = inlined(
            #[inline(always)]
            |[right, below]: [usize; 2]| {
                let texels: [i32; LANES] = (rows[below] + columns[right]).into();
                let stored = lanes_of(
                    #[inline(always)]
                    |lane| self.depths[texels[lane] as usize],
                );
                // Where nothing is, the depth is 0, below that of all points between the ends.
                let stored = F32::simd_from(simd, stored);
                stored.simd_le(depth).select(F32::splat(simd, 1.0), zero)
            },
        );
        let above = mix(lit([0, 0]), lit([1, 0]), across);
        mix(above, mix(lit([0, 1]), lit([1, 1]), across), down)
    }
}

/// How the lamp sees the knot.
struct LampView {
    /// From the world.
    to_clip: DMat4,
    /// In metres, along the longer axis.
    width: f64,
}

impl LampView {
    /// As the scene renderer fits parallel light to the box of all casters.
    fn of(columns: &Columns) -> Result<Self, Box<dyn Error>> {
        let turned = Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y);
        let [x, y, z] = &columns.positions;
        let points = x.iter().zip(y).zip(z).map(|((x, y), z)| Vec3::new(*x, *y, *z).as_dvec3());
        let bounds = Bounds3::from_points(points);
        let extent = Bounds3::from_points(bounds.corners().map(|corner| turned.to_camera(corner)));
        let (middle, size) = (extent.center().ok_or("the knot is empty")?, extent.size());
        let margin = 1e-3 * size.length() + 1e-30;
        let (width, height, depth) = (size.x + margin, size.y + margin, size.z / 2.0 + margin);
        let projection = Projection::orthographic(height, -depth, depth)?;
        let camera = Camera { position: turned.to_world(middle), projection, ..turned };
        Ok(Self { to_clip: camera.view_projection(width / height), width: width.max(height) })
    }
}

/// The shape alone.
struct Caster<'a> {
    positions: &'a [Vec<f32>; 3],
    to_clip: Mat4,
}

impl LanePipeline for Caster<'_> {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        clip(simd, vertices, self.positions, &self.to_clip)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, _: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        [F32::splat(simd, 1.0); 4]
    }
}
