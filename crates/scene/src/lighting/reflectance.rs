//! The fraction of light that a microfacet surface reflects in all directions together, as a table, because
//! the integral has no closed form.
//!
//! The table is made on first use. Each entry is the mean over 256 directions of the distribution (B. Karis,
//! "Real Shading in Unreal Engine 4", 2013, section "Environment BRDF"), with the shadowing term of the
//! surface itself.

use std::sync::OnceLock;

use trigon_math::{Vec3, elementary};
use trigon_raster::simd::{F32, Simd, inlined, lanes_of, prelude::*};

use crate::lanes::{mix, table_step};

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
