//! Metalness and roughness: GGX in the light of one lamp, with textures of base colour, normals, and both factors.

use trigon_raster::simd::{F32, Simd, greater, inlined, lesser, prelude::*};
use trigon_raster::{FragmentLanes, LanePipeline, Texture, VertexLanes};

use super::surface::{NormalMapped, look_up};
use crate::image::LIGHT;
use crate::lanes::{dot, mix, normalized, positive, scaled, splat, sum};

/// The reflectance of a dielectric with a refractive index of 1.5, head-on.
const DIELECTRIC: f32 = 0.04;
const LEAST_COSINE: f32 = 1e-4;
/// Of α, the square of the roughness.
const LEAST_ALPHA: f32 = 1e-3;

pub(super) struct Metal<'a> {
    pub(super) surface: NormalMapped<'a>,
    pub(super) base: &'a Texture,
    pub(super) metal: &'a Texture,
}

impl LanePipeline for Metal<'_> {
    const VARYINGS: usize = NormalMapped::VARYINGS;

    fn vertex_count(&self) -> usize {
        self.surface.columns.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.surface.vertices(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [r, g, b, _] = look_up(simd, fragments, self.base);
        let [_, normal] = self.surface.normals(simd, fragments);
        let [_, roughness, metallic, _] = look_up(simd, fragments, self.metal);
        let towards = splat(simd, self.surface.columns.towards);
        let n_dot_l = positive(dot(normal, towards));
        let one = F32::splat(simd, 1.0);
        if !n_dot_l.simd_gt(0.0).any_true() {
            let black = F32::splat(simd, 0.0);
            return [black, black, black, one];
        }
        let to_surface = fragments.varyings::<3>(NormalMapped::POSITION);
        let view = normalized(scaled(to_surface, F32::splat(simd, -1.0)));
        let half = normalized(sum(towards, view));
        let highlight = highlight(
            roughness,
            Cosines {
                n_dot_l: n_dot_l + LEAST_COSINE,
                n_dot_v: dot(normal, view).abs() + LEAST_COSINE,
                n_dot_h: positive(dot(normal, half)),
            },
        );
        let away = 1.0 - lesser(positive(dot(view, half)), one);
        let square = away * away;
        let grazing = square * square * away;
        let (light, matt) = (n_dot_l * LIGHT, 1.0 - metallic);
        let channel = inlined(
            #[inline(always)]
            |base: F32<S>| {
                let head_on = mix(F32::splat(simd, DIELECTRIC), base, metallic);
                let fresnel = mix(head_on, one, grazing);
                base * matt * (light * (1.0 - fresnel)) + light * (fresnel * highlight)
            },
        );
        [channel(r), channel(g), channel(b), one]
    }
}

/// All above 0.
struct Cosines<S: Simd> {
    n_dot_l: F32<S>,
    n_dot_v: F32<S>,
    n_dot_h: F32<S>,
}

/// π · D · V of glTF 2.0, appendix B.
#[inline(always)]
fn highlight<S: Simd>(roughness: F32<S>, Cosines { n_dot_l, n_dot_v, n_dot_h }: Cosines<S>) -> F32<S> {
    let alpha = greater(roughness * roughness, F32::splat(roughness.token(), LEAST_ALPHA));
    let square = alpha * alpha;
    let width = (n_dot_h * square - n_dot_h) * n_dot_h + 1.0;
    let distribution = square / (width * width);
    let towards_view = n_dot_l * ((n_dot_v - n_dot_v * square) * n_dot_v + square).sqrt();
    let towards_light = n_dot_v * ((n_dot_l - n_dot_l * square) * n_dot_l + square).sqrt();
    distribution * 0.5 / (towards_view + towards_light)
}
