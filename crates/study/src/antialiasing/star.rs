//! Needles around a point, with black between them.

use crate::oracle::{GridPoint, STEPS};
use std::f64::consts::TAU;
use trigon_math::elementary;

/// Triangles on the grid of 1/256 pixel that do not overlap.
pub struct Star {
    pub(super) side: usize,
    pub(super) triangles: Vec<[GridPoint; 3]>,
}

impl Star {
    /// 24 needles in a square image.
    #[must_use]
    pub fn new(side: usize) -> Self {
        const NEEDLES: usize = 24;
        // Off the centre of a pixel, so that no sample lies on an axis.
        let middle = side as f64 / 2.0 + 0.37;
        let point = |turn: f64, radius: f64| {
            let (sine, cosine) = elementary::sin_cos(turn * TAU);
            [cosine, sine].map(|part| ((middle + radius * part) * f64::from(STEPS)).round() as i32)
        };
        let needle = |i: usize| {
            let [from, to] = [0.02, 0.48].map(|share| (i as f64 + share) / NEEDLES as f64);
            let radius = side as f64 * 0.47;
            [point((from + to) / 2.0, side as f64 * 0.05), point(from, radius), point(to, radius)]
        };
        Self { side, triangles: (0..NEEDLES).map(needle).collect() }
    }
}
