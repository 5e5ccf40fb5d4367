//! The workloads' texture and its filtering, implemented from their definition.

use trigon_math::{DVec3, elementary};

const SIDE: usize = 1024;

/// The texture with its smaller levels, each texel the mean of four, rounded to a byte.
pub(super) struct Texture(Vec<Vec<[u8; 3]>>);

impl Texture {
    pub(super) fn new() -> Self {
        let mut levels = vec![(0..SIDE * SIDE).map(|index| texel([index % SIDE, index / SIDE])).collect()];
        for level in 1..=SIDE.ilog2() {
            let finer: &Vec<[u8; 3]> = &levels[level as usize - 1];
            let side = SIDE >> level;
            let mean = |index: usize| {
                let corner = index / side * 4 * side + index % side * 2;
                let four = [corner, corner + 1, corner + 2 * side, corner + 2 * side + 1];
                [0, 1, 2].map(|channel| {
                    let sum: u32 = four.iter().map(|&place| u32::from(finer[place][channel])).sum();
                    ((sum + 2) / 4) as u8
                })
            };
            levels.push((0..side * side).map(mean).collect());
        }
        Self(levels)
    }

    /// At a place, where a pixel is so many texels long: the mean of four texels on each of the two levels next to that.
    pub(super) fn trilinear(&self, place: [f64; 2], texels: f64) -> DVec3 {
        let level = elementary::log2(texels).clamp(0.0, (self.0.len() - 1) as f64);
        let (finer, part) = (level.floor(), level.fract());
        let coarser = (finer as usize + 1).min(self.0.len() - 1);
        self.bilinear(place, finer as usize).lerp(self.bilinear(place, coarser), part)
    }

    /// The mean of the four texels around a place, repeated for ever.
    pub(super) fn bilinear(&self, place: [f64; 2], level: usize) -> DVec3 {
        let side = SIDE >> level;
        let [x, y] = place.map(|coordinate| coordinate * side as f64 - 0.5);
        let wrapped = |value: f64| (value as i64).rem_euclid(side as i64) as usize;
        let [columns, rows] = [x, y].map(|value| [wrapped(value.floor()), wrapped(value.floor() + 1.0)]);
        let at = |row: usize, column: usize| {
            let [r, g, b] = self.0[level][rows[row] * side + columns[column]].map(f64::from);
            DVec3::new(r, g, b) / 255.0
        };
        let across = |row: usize| at(row, 0).lerp(at(row, 1), x - x.floor());
        across(0).lerp(across(1), y - y.floor())
    }

    /// How many texels there are along a side.
    pub(super) const SIDE: f64 = SIDE as f64;
}

/// A checker of two tints in squares of 64 texels, each with the exclusive or of the coordinates.
fn texel([x, y]: [usize; 2]) -> [u8; 3] {
    let shade = ((x ^ y) & 63) * 2 / 3;
    let tint: [usize; 3] = if (x / 64 + y / 64) % 2 == 1 { [230, 120, 60] } else { [60, 130, 220] };
    tint.map(|channel| (channel - shade) as u8)
}
