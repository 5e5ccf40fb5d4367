//! The visible triangles of a tile, as the search for outer halves of lines needs them.

use super::FaceLine;
use crate::simd::{F32, LANES, Simd, prelude::*};

/// Triangles whose faces have at least this inner radius, in pixels, are large.
pub(crate) const LARGE: f32 = 3.0;

/// The depths of a visible triangle.
#[derive(Clone, Copy)]
pub(crate) struct DepthRange {
    /// The least, of a triangle with lines; below all depths for others.
    pub(crate) least: f32,
    /// The greatest.
    pub(crate) greatest: f32,
}

impl DepthRange {
    pub(crate) const EMPTY: Self = Self { least: f32::NEG_INFINITY, greatest: f32::NEG_INFINITY };

    /// Both as one number, the least in the lower half.
    #[inline(always)]
    pub(crate) fn bits(self) -> u64 {
        u64::from(self.least.to_bits()) | u64::from(self.greatest.to_bits()) << 32
    }
}

/// The visible triangles of a tile, by their numbers among the tile's, and one more entry for the
/// background.
#[derive(Default)]
pub(crate) struct VisibleFaces {
    pub(crate) depths: Vec<DepthRange>,
    pub(crate) lines: Vec<FaceLine>,
    /// Whether any of them shows lines.
    pub(crate) has_lines: bool,
    /// Whether any of them is large.
    pub(crate) has_large: bool,
}

impl VisibleFaces {
    /// Starts a tile with this many triangles.
    pub(crate) fn begin(&mut self, triangle_count: usize) {
        (self.has_lines, self.has_large) = (false, false);
        // Triangles that are not visible keep old values, which are not read.
        if self.depths.len() < triangle_count + 1 {
            self.depths.resize(triangle_count + 1, DepthRange::EMPTY);
            self.lines.resize(triangle_count + 1, FaceLine::UNLINED);
        }
        self.depths[triangle_count] = DepthRange::EMPTY;
        self.lines[triangle_count] = FaceLine::UNLINED;
    }

    /// Takes triangles from others that were noted, which have these indices in the tile's list now; the indices increase.
    pub(crate) fn note_again(&mut self, others: &Self, indices: &[u32]) {
        let count = indices.len();
        // Mostly all of them come first.
        if indices.last().is_some_and(|&last| last as usize == count - 1) {
            self.depths[..count].copy_from_slice(&others.depths[..count]);
            self.lines[..count].copy_from_slice(&others.lines[..count]);
        } else {
            for ((&index, &depths), &line) in indices.iter().zip(&others.depths).zip(&others.lines) {
                self.depths[index as usize] = depths;
                self.lines[index as usize] = line;
            }
        }
        self.has_lines |= others.has_lines;
        self.has_large |= others.has_large;
    }

    /// Takes up to eight visible triangles of the tile: their least and greatest depths, as [`DepthRange`] has them, and
    /// the half width, weight and inner radius of [`FaceLine`].
    #[inline(always)]
    pub(crate) fn note_eight<S: Simd>(
        &mut self,
        simd: S,
        indices: &[u32],
        [least, greatest]: [F32<S>; 2],
        [half, weight, radius]: [[f32; LANES]; 3],
    ) {
        let lanes = (1 << indices.len()) - 1;
        let has_lines = least.simd_gt(F32::splat(simd, f32::NEG_INFINITY));
        let is_large = F32::simd_from(simd, radius).simd_ge(LARGE);
        self.has_lines |= has_lines.to_bitmask() & lanes != 0;
        self.has_large |= is_large.to_bitmask() & lanes != 0;
        let [least, greatest]: [[f32; LANES]; 2] = [least.into(), greatest.into()];
        for (lane, &index) in indices.iter().enumerate() {
            self.depths[index as usize] = DepthRange { least: least[lane], greatest: greatest[lane] };
            let line = FaceLine { half: half[lane], weight: weight[lane], radius: radius[lane] };
            self.lines[index as usize] = line;
        }
    }

    /// Takes a visible triangle of the tile that belongs to no face with edges, by its greatest depth.
    pub(crate) fn note_unlined(&mut self, index: u32, greatest: f32) {
        self.depths[index as usize] = DepthRange { greatest, ..DepthRange::EMPTY };
        self.lines[index as usize] = FaceLine::UNLINED;
    }
}
