//! How close may two surfaces be before a z-buffer confuses them? Depth formats for a perspective with a near
//! and a far plane.

mod formats;
mod road;

#[cfg(test)]
mod tests;

pub use formats::DepthFormat;
pub use road::Road;

use trigon_math::{SplitMix64, elementary};

/// The planes of the perspective, in metres.
pub const NEAR: f32 = 0.1;
/// As [`NEAR`].
pub const FAR: f32 = 10_000.0;

/// Of a thousand pairs of surfaces, how many get the wrong order or equal depths. One surface lies at a
/// random distance near `distance`, the other farther by the fraction `separation` of it.
#[must_use]
pub fn misordered_per_mille(format: DepthFormat, distance: f64, separation: f64) -> f64 {
    const PAIRS: usize = 10_000;
    let mut random = SplitMix64::new(7);
    let is_wrong = |_: &usize| {
        let near = distance * random.between(0.9, 1.1);
        let far = near * (1.0 + separation);
        !format.is_nearer(format.encode(near as f32), format.encode(far as f32))
    };
    let wrong = (0..PAIRS).filter(is_wrong).count();
    1e3 * wrong as f64 / PAIRS as f64
}

/// The smallest separation, as a fraction of the distance and a power of the square root of ten, at which no
/// pair of surfaces is confused; 1 if there is none below.
#[must_use]
pub fn resolved_separation(format: DepthFormat, distance: f64) -> f64 {
    let separations = (-16..=0).map(|power| elementary::pow(10.0, f64::from(power) / 2.0));
    let mut resolved = separations.filter(|&share| misordered_per_mille(format, distance, share) == 0.0);
    resolved.next().unwrap_or(1.0)
}
