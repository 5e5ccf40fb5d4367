//! Mip levels by an exact box filter in linear light.

use super::format::{TextureFormat, decode, full_scale};
use trigon_math::{Vec4, color};

/// One level as rows of texels, top row first.
#[derive(Clone, Debug)]
pub(super) struct LevelRows {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) texels: Vec<[u8; 4]>,
}

impl LevelRows {
    pub(super) fn row(&self, y: u32) -> &[[u8; 4]] {
        let width = self.width as usize;
        &self.texels[y as usize * width..][..width]
    }
}

/// The texels of one axis that a texel of the next level covers, and the weight
/// of each. An odd number of texels is not halved evenly: then a texel covers
/// parts of three.
#[derive(Clone, Copy)]
struct CoveredTexels {
    first: u32,
    weights: [f32; 3],
}

impl CoveredTexels {
    fn new(index: u32, from: u32, to: u32) -> Self {
        if from == to {
            return Self { first: index, weights: [1.0, 0.0, 0.0] };
        }
        if from == 2 * to {
            return Self { first: 2 * index, weights: [0.5, 0.5, 0.0] };
        }
        // from = 2 to + 1: in units of 1/to of a texel, texel `index` covers
        // [index * from, (index + 1) * from), texel k of the finer level
        // [k * to, (k + 1) * to).
        let whole = 1.0 / from as f32;
        let weights = [(to - index) as f32 * whole, to as f32 * whole, (index + 1) as f32 * whole];
        Self { first: 2 * index, weights }
    }
}

/// The next smaller level; `None` below a single texel.
pub(super) fn halved(from: &LevelRows, format: TextureFormat) -> Option<LevelRows> {
    if from.width == 1 && from.height == 1 {
        return None;
    }
    let (width, height) = ((from.width / 2).max(1), (from.height / 2).max(1));
    let columns: Vec<_> = (0..width).map(|x| CoveredTexels::new(x, from.width, width)).collect();
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let rows = CoveredTexels::new(y, from.height, height);
        for column in &columns {
            texels.push(mean(from, *column, rows, format));
        }
    }
    Some(LevelRows { width, height, texels })
}

fn mean(from: &LevelRows, columns: CoveredTexels, rows: CoveredTexels, format: TextureFormat) -> [u8; 4] {
    let mut plain = Vec4::ZERO;
    let mut weighted = Vec4::ZERO;
    for (j, &row_weight) in (rows.first..from.height).zip(&rows.weights) {
        for (i, &column_weight) in (columns.first..from.width).zip(&columns.weights) {
            let texel = decode(from.texels[(j * from.width + i) as usize], format) / full_scale(format);
            let weight = row_weight * column_weight;
            plain += texel * weight;
            weighted += texel * (weight * texel.w);
        }
    }
    let alpha = plain.w;
    let rgb = if format == TextureFormat::Srgb && alpha > 0.0 { weighted / alpha } else { plain };
    encode(rgb.with_w(alpha), format)
}

fn encode(value: Vec4, format: TextureFormat) -> [u8; 4] {
    let byte = |v: f32| (v * 255.0 + 0.5) as u8;
    let code = |v: f32| match format {
        TextureFormat::Srgb => color::linear_to_srgb8(v),
        TextureFormat::Linear => byte(v),
    };
    [code(value.x), code(value.y), code(value.z), byte(value.w)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(width: u32, height: u32, value: impl Fn(u32, u32) -> u8) -> LevelRows {
        let texels = (0..width * height).map(|i| [value(i % width, i / width), 0, 0, 255]).collect();
        LevelRows { width, height, texels }
    }

    fn chain(base: LevelRows, format: TextureFormat) -> Vec<LevelRows> {
        std::iter::successors(Some(base), |rows| halved(rows, format)).collect()
    }

    #[test]
    fn every_size_ends_in_one_texel() {
        for (width, height, count) in [(1, 1, 1), (1, 4096, 13), (5, 3, 3), (7, 16, 5), (1000, 1, 10)] {
            let levels = chain(level(width, height, |_, _| 99), TextureFormat::Srgb);
            assert_eq!(levels.len(), count, "levels of {width}x{height}");
            assert!(
                levels.iter().all(|level| level.texels.iter().all(|t| *t == [99, 0, 0, 255])),
                "a constant stays constant at {width}x{height}"
            );
        }
    }

    #[test]
    fn an_odd_axis_is_shared_out_exactly() {
        for to in [1_u32, 2, 3, 50] {
            let from = 2 * to + 1;
            let mut total = vec![0.0_f32; from as usize];
            for index in 0..to {
                let covered = CoveredTexels::new(index, from, to);
                for (k, weight) in covered.weights.iter().enumerate() {
                    total[covered.first as usize + k] += weight;
                }
            }
            let expected = to as f32 / from as f32;
            assert!(
                total.iter().all(|t| (t - expected).abs() < 1e-6),
                "every texel of {from} counts the same: {total:?}"
            );
        }
    }

    #[test]
    fn black_and_white_meet_in_linear_light() {
        let checker = level(2, 2, |x, y| if (x + y) % 2 == 0 { 255 } else { 0 });
        let srgb = chain(checker.clone(), TextureFormat::Srgb);
        assert_eq!(srgb[1].texels[0][0], 188, "half the light is sRGB 188");
        let data = chain(checker, TextureFormat::Linear);
        assert_eq!(data[1].texels[0][0], 128, "half of 255, rounded up");
    }

    #[test]
    fn transparent_texels_do_not_bleed() {
        let texels = vec![[255, 0, 0, 255], [0, 255, 0, 0]];
        let levels = chain(LevelRows { width: 2, height: 1, texels }, TextureFormat::Srgb);
        assert_eq!(levels[1].texels[0], [255, 0, 0, 128], "only the red one is seen");
    }
}
