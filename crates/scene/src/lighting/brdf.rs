//! Eight points of a surface, and the light that they reflect.
//!
//! The microfacet surface is that of glTF 2.0, appendix B. It has the GGX distribution (B. Walter et al., "Microfacet
//! Models for Refraction through Rough Surfaces", 2007). Shadowing is height-correlated (E. Heitz, "Understanding the
//! Masking-Shadowing Function in Microfacet-Based BRDFs", 2014), and Fresnel's law that of C. Schlick's approximation
//! (1994). All terms are multiplied by π, so that a light of radiance 1 shows a white Lambertian surface as 1; see the
//! head of `light.rs`.
//!
//! The fraction of light that a surface reflects in all directions together has no closed form. A table is made on first
//! use. Each entry is the mean over 256 directions of the distribution (B. Karis, "Real Shading in Unreal Engine 4", 2013,
//! section "Environment BRDF"), with the shadowing term of the surface itself.

use std::sync::OnceLock;

use trigon_math::{Vec3, elementary};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, LANES, Simd, greater, inlined, lanes_of};

use crate::lanes::{V3, fifth_power, mix, positive, product, saturated, sum, table_step};

/// The parameters of a microfacet surface at eight points.
#[derive(Clone, Copy)]
pub(crate) struct Microfacets<S: Simd> {
    /// The reflectance at normal incidence (F0), linear RGB.
    pub(crate) f0: V3<S>,
    /// The reflectance at grazing angles (F90).
    pub(crate) grazing: F32<S>,
    /// Perceptual roughness, 0…1.
    pub(crate) roughness: F32<S>,
    /// Metalness, 0…1; reflections of the environment depend on it.
    pub(crate) metallic: F32<S>,
}

/// The smallest α (the square of the roughness) for lamps: because a lamp has no size, a perfect mirror would
/// show no highlight at all.
const ALPHA_LEAST: f32 = 1e-3;

impl<S: Simd> Microfacets<S> {
    /// The fraction of light that is reflected at the surface (Fresnel). `cosine` is that of the angle
    /// between the light and the half vector.
    #[inline(always)]
    pub(crate) fn fresnel(&self, cosine: F32<S>) -> V3<S> {
        let grazing = fifth_power(1.0 - saturated(cosine));
        let [r, g, b] = self.f0;
        [mix(r, self.grazing, grazing), mix(g, self.grazing, grazing), mix(b, self.grazing, grazing)]
    }

    /// π · D · V: the highlight without the Fresnel term and without N·L. All cosines are above 0.
    #[inline(always)]
    pub(crate) fn highlight(&self, [n_dot_l, n_dot_v, n_dot_h]: [F32<S>; 3]) -> F32<S> {
        let alpha = self.roughness * self.roughness;
        let alpha = greater(alpha, F32::splat(alpha.token(), ALPHA_LEAST));
        let square = alpha * alpha;
        let width = (n_dot_h * square - n_dot_h) * n_dot_h + 1.0;
        // D of the specification times π: the π of both cancel.
        let distribution = square / (width * width);
        let towards_view = n_dot_l * ((n_dot_v - n_dot_v * square) * n_dot_v + square).sqrt();
        let towards_light = n_dot_v * ((n_dot_l - n_dot_l * square) * n_dot_l + square).sqrt();
        distribution * 0.5 / (towards_view + towards_light)
    }

    /// The reflection of uniform light: the fractions that are reflected specularly (RGB, single and multiple
    /// scattering together) and what remains for the diffuse part.
    ///
    /// Single scattering comes from a table, multiple scattering from C. Fdez-Agüera ("A Multiple-Scattering
    /// Microfacet Model for Real-Time Image-based Lighting", 2019). No energy is lost, so white surfaces
    /// vanish in a white room.
    #[inline(always)]
    pub(crate) fn surrounded(&self, n_dot_v: F32<S>) -> Surrounded<S> {
        let [scale, offset] = reflectance(n_dot_v.token(), self.roughness, n_dot_v);
        let all = scale + offset;
        let lost = 1.0 - all;
        let mut answer = Surrounded { single: self.f0, repeated: self.f0, diffuse: self.f0 };
        for channel in 0..3 {
            let f0 = self.f0[channel];
            let single = f0 * scale + self.grazing * offset;
            let average = f0 + (self.grazing - f0) * (1.0 / 21.0);
            let repeated = single * average * lost / (1.0 - average * lost);
            answer.single[channel] = single;
            answer.repeated[channel] = repeated;
            answer.diffuse[channel] = positive(1.0 - single - repeated);
        }
        answer
    }
}

/// See [`Microfacets::surrounded`].
#[derive(Clone, Copy)]
pub(crate) struct Surrounded<S: Simd> {
    /// The factor of light from the mirror direction, blurred by the roughness.
    pub(crate) single: V3<S>,
    /// The factor of light from all directions, after multiple scattering.
    pub(crate) repeated: V3<S>,
    /// The fraction that remains for the diffuse part.
    pub(crate) diffuse: V3<S>,
}

/// Entries along each axis, roughness and cosine, both from 0 to 1.
const SIDE: usize = 16;

/// Directions for each entry.
const SAMPLES: u32 = 256;

/// The factors of F0 and of F90.
type Table = [[f32; SIDE * SIDE]; 2];

fn table() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(|| {
        let share = |step: usize| step as f32 / (SIDE - 1) as f32;
        let entries: Vec<[f32; 2]> =
            (0..SIDE * SIDE).map(|entry| integral(share(entry / SIDE), share(entry % SIDE))).collect();
        [0, 1].map(|factor| std::array::from_fn(|entry| entries[entry][factor]))
    })
}

/// Both factors for a roughness and the cosine between normal and view.
fn integral(roughness: f32, cosine: f32) -> [f32; 2] {
    /// At grazing views and for perfect mirrors there is nothing to integrate.
    const LEAST: f32 = 1e-3;
    let cosine = if cosine > LEAST { cosine } else { LEAST };
    let alpha = if roughness * roughness > LEAST { roughness * roughness } else { LEAST };
    let square = alpha * alpha;
    let view = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    let mut sums = [0.0_f64; 2];
    for sample in 0..SAMPLES {
        // Hammersley's points; half vectors as GGX has them.
        let across = (sample as f32 + 0.5) / SAMPLES as f32;
        let around = sample.reverse_bits() as f32 / 4_294_967_296.0 * std::f32::consts::TAU;
        let n_dot_h = ((1.0 - across) / (1.0 + (square - 1.0) * across)).sqrt();
        let flat = (1.0 - n_dot_h * n_dot_h).sqrt();
        let half = Vec3::new(flat * elementary::cos_f32(around), flat * elementary::sin_f32(around), n_dot_h);
        let v_dot_h = view.dot(half);
        let n_dot_l = 2.0 * v_dot_h * n_dot_h - cosine;
        if n_dot_l <= 0.0 || v_dot_h <= 0.0 {
            continue;
        }
        let towards_view = n_dot_l * ((cosine - cosine * square) * cosine + square).sqrt();
        let towards_light = cosine * ((n_dot_l - n_dot_l * square) * n_dot_l + square).sqrt();
        let visible = 0.5 / (towards_view + towards_light);
        let weight = f64::from(visible * n_dot_l * v_dot_h * 4.0 / n_dot_h);
        let away = 1.0 - v_dot_h;
        let fresnel = f64::from(away * away * away * away * away);
        sums[0] += (1.0 - fresnel) * weight;
        sums[1] += fresnel * weight;
    }
    sums.map(|sum| (sum / f64::from(SAMPLES)) as f32)
}

/// Both factors at eight points: the reflectance is the first times F0 plus the second times F90.
#[inline(always)]
pub(super) fn reflectance<S: Simd>(simd: S, roughness: F32<S>, cosine: F32<S>) -> [F32<S>; 2] {
    let table = table();
    let ((row, down), (column, across)) = (table_step(roughness, SIDE), table_step(cosine, SIDE));
    let of = inlined(
        #[inline(always)]
        |factor: usize| {
            let entry = inlined(
                #[inline(always)]
                |step: usize| {
                    let values = lanes_of(
                        #[inline(always)]
                        |lane| table[factor][row[lane] as usize * SIDE + column[lane] as usize + step],
                    );
                    F32::simd_from(simd, values)
                },
            );
            mix(mix(entry(0), entry(1), across), mix(entry(SIDE), entry(SIDE + 1), across), down)
        },
    );
    [of(0), of(1)]
}

/// Eight points of a surface, in camera space.
#[derive(Clone, Copy)]
pub(crate) struct LitPoints<S: Simd> {
    pub(crate) position: V3<S>,
    /// Of unit length, or zero, which no light reaches.
    pub(crate) normal: V3<S>,
    /// The same without the normal map: the orientation of the surface itself.
    pub(crate) facing: V3<S>,
    /// Perpendicular to the triangle, of any length and on either side: `facing` may be interpolated. Shadow maps alone
    /// need it; without them it is `facing`.
    pub(crate) plane: V3<S>,
    /// Unit vectors towards the eye.
    pub(crate) view: V3<S>,
    pub(crate) lanes: ImageLanes<S>,
}

/// Where the image shows eight points: neighbouring pixels cast different rays, and share what they find.
#[derive(Clone, Copy)]
pub(crate) struct ImageLanes<S: Simd> {
    /// In pixels, where the points are seen: directly, or by a ray that starts there.
    pub(crate) pixels: [F32<S>; 2],
    /// A bit for each point in use.
    pub(crate) active: u64,
    /// Whether the image shows the points themselves.
    pub(crate) is_direct: bool,
}

impl<S: Simd> ImageLanes<S> {
    /// Points that no pixel shows, such as vertices.
    #[inline(always)]
    pub(crate) fn elsewhere(simd: S) -> Self {
        Self { pixels: [F32::splat(simd, 0.0); 2], active: (1 << LANES) - 1, is_direct: false }
    }
}

impl<S: Simd> LitPoints<S> {
    /// Points of which no pixel shows any, on triangles as even as their normals say.
    #[inline(always)]
    pub(crate) fn elsewhere(simd: S, position: V3<S>, normal: V3<S>, view: V3<S>) -> Self {
        let lanes = ImageLanes::elsewhere(simd);
        Self { position, normal, facing: normal, plane: normal, view, lanes }
    }
}

/// The reflection model at eight points.
#[derive(Clone, Copy)]
pub(crate) enum Brdf<S: Simd> {
    /// Base colour × N·L.
    Lambert,
    /// See [`Shading::BlinnPhong`](crate::Shading::BlinnPhong).
    BlinnPhong { specular: V3<S>, shininess: F32<S> },
    /// See [`Shading::MetallicRoughness`](crate::Shading::MetallicRoughness).
    Microfacets(Microfacets<S>),
}

/// Light that leaves towards the eye.
#[derive(Clone, Copy)]
pub(crate) struct Reflected<S: Simd> {
    /// To be multiplied by the diffuse colour.
    pub(crate) diffuse: V3<S>,
    /// Highlights.
    pub(crate) specular: V3<S>,
}

impl<S: Simd> Reflected<S> {
    #[inline(always)]
    pub(crate) fn none(simd: S) -> Self {
        let zero = F32::splat(simd, 0.0);
        Self { diffuse: [zero; 3], specular: [zero; 3] }
    }

    /// Adds light, of which `diffuse` and `specular` are reflected to the eye.
    #[inline(always)]
    pub(crate) fn add(&mut self, light: V3<S>, diffuse: V3<S>, specular: V3<S>) {
        self.diffuse = sum(self.diffuse, product(light, diffuse));
        self.specular = sum(self.specular, product(light, specular));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::{Baseline, baseline};
    use trigon_math::{Vec3, elementary};

    fn surface(roughness: f32, f0: f32) -> Microfacets<Baseline> {
        let simd = baseline();
        let splat = |value| F32::splat(simd, value);
        Microfacets {
            f0: [splat(f0); 3],
            grazing: splat(1.0),
            roughness: splat(roughness),
            metallic: splat(0.0),
        }
    }

    /// The integral over all microfacets of D · G₁ · max(v·h, 0) / n·v. It is 1 for any roughness: before
    /// shadowing, no light is lost or gained (Heitz 2014, equation 22, the "weak white furnace test").
    fn furnace(roughness: f32, n_dot_v: f64) -> f64 {
        let simd = baseline();
        let (rings, sectors) = (600, 256);
        let view = [(1.0 - n_dot_v * n_dot_v).sqrt(), n_dot_v];
        let mut total = 0.0;
        for ring in 0..rings {
            // Denser near the pole, where smooth surfaces have all of theirs.
            let t = (f64::from(ring) + 0.5) / f64::from(rings);
            let (cosine, step) = (1.0 - t * t * t, 3.0 * t * t / f64::from(rings));
            let sine = (1.0 - cosine * cosine).sqrt();
            // With light and view along the normal, V is 1/4: what is left is π · D.
            let [one, n_dot_h] = [1.0, cosine as f32].map(|value| F32::splat(simd, value));
            let highlight = surface(roughness, 1.0).highlight([one, one, n_dot_h])[0];
            let distribution = f64::from(highlight) * 4.0 / std::f64::consts::PI;
            let mut around = 0.0;
            for sector in 0..sectors {
                let angle = std::f64::consts::TAU * (f64::from(sector) + 0.5) / f64::from(sectors);
                let v_dot_h = view[0] * sine * elementary::cos(angle) + view[1] * cosine;
                around += v_dot_h.max(0.0);
            }
            total += distribution * around * step * std::f64::consts::TAU / f64::from(sectors);
        }
        let alpha = f64::from(roughness) * f64::from(roughness);
        let tangent = (1.0 - n_dot_v * n_dot_v) / (n_dot_v * n_dot_v);
        let masking = 2.0 / (1.0 + (1.0 + alpha * alpha * tangent).sqrt());
        total * masking / n_dot_v
    }

    #[test]
    fn microfacets_reflect_all_light_before_it_is_shadowed() {
        for roughness in [0.3, 0.5, 0.8, 1.0] {
            for n_dot_v in [0.3, 0.6, 0.95] {
                let total = furnace(roughness, n_dot_v);
                assert!((total - 1.0).abs() < 0.01, "roughness {roughness}, cosine {n_dot_v}: {total}");
            }
        }
    }

    /// The integral of the whole highlight over all directions of light.
    fn albedo(roughness: f32, n_dot_v: f32) -> f64 {
        let simd = baseline();
        let view = Vec3::new((1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v);
        let (rings, sectors) = (400_u16, 256_u16);
        let mut total = 0.0;
        for (ring, sector) in (0..rings).flat_map(|ring| (0..sectors).map(move |sector| (ring, sector))) {
            let cosine = (f32::from(ring) + 0.5) / f32::from(rings);
            let angle = std::f32::consts::TAU * (f32::from(sector) + 0.5) / f32::from(sectors);
            let sine = (1.0 - cosine * cosine).sqrt();
            let light =
                Vec3::new(sine * elementary::cos_f32(angle), sine * elementary::sin_f32(angle), cosine);
            let half = (light + view).normalize();
            let splat = |value| F32::splat(simd, value);
            let cosines = [splat(cosine), splat(n_dot_v), splat(half.z)];
            let highlight = surface(roughness, 1.0).highlight(cosines)[0] * cosine;
            total += f64::from(highlight) * 2.0 / (f64::from(rings) * f64::from(sectors));
        }
        total
    }

    #[test]
    fn no_more_light_leaves_than_arrives() {
        for roughness in [0.25, 0.4, 0.6, 0.8, 1.0] {
            for n_dot_v in [0.1, 0.4, 0.7, 1.0] {
                let albedo = albedo(roughness, n_dot_v);
                assert!(albedo <= 1.01, "roughness {roughness}, cosine {n_dot_v}: {albedo}");
            }
        }
        let smooth = albedo(0.25, 0.7);
        assert!((smooth - 1.0).abs() < 0.01, "a smooth one shadows nearly nothing: {smooth}");
    }

    #[test]
    fn the_table_holds_the_integral_of_the_highlight() {
        for roughness in [0.3, 0.6, 0.9] {
            for n_dot_v in [0.3, 0.6, 0.9] {
                let splat = |value| F32::splat(baseline(), value);
                let [scale, offset] = reflectance(baseline(), splat(roughness), splat(n_dot_v));
                let (found, exact) = (f64::from((scale + offset)[0]), albedo(roughness, n_dot_v));
                assert!(
                    (found - exact).abs() < 0.015,
                    "roughness {roughness}, {n_dot_v}: {found}, not {exact}"
                );
            }
        }
    }

    #[test]
    fn white_surfaces_vanish_in_a_white_room() {
        let simd = baseline();
        for (roughness, f0) in [(0.0, 1.0), (0.5, 1.0), (1.0, 1.0), (0.2, 0.04), (0.9, 0.04)] {
            for n_dot_v in [0.05, 0.5, 1.0] {
                let answer = surface(roughness, f0).surrounded(F32::splat(simd, n_dot_v));
                let total = (answer.single[0] + answer.repeated[0] + answer.diffuse[0])[0];
                assert!((total - 1.0).abs() < 0.01, "{roughness} {f0} {n_dot_v}: {total} of 1");
                assert!(answer.diffuse[0][0] < 0.01 || f0 < 1.0, "a metal leaves nothing for diffuse light");
            }
        }
    }
}
