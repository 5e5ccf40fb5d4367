//! The lines on a face: how wide they are, by the rule of [`FaceEdges`](crate::FaceEdges), and what the search for the
//! outer halves of lines reads of the visible triangles of a tile.

use super::Ink;
use crate::draw::Overlap;
use crate::simd::{F32, LANES, Simd, greater, lesser, prelude::*};

/// The most of its inner radius that half a line takes of a face.
const SHARE: f32 = 1.0 / 3.0;

/// The radius in pixels of the target below which it takes less.
const FADING: f32 = 1.5;

/// The radii in pixels of the finer grid between which the share of the face takes the
/// place of distances.
const RESOLVED: [f32; 2] = [0.5, 1.5];

/// The radii in pixels of the finer grid between which lines begin to show beyond their
/// faces: of smaller ones that is less than a pixel shows, and everywhere.
const BEYOND: [f32; 2] = [1.0, 2.0];

/// The lines on eight faces, in pixels of the finer grid.
#[derive(Clone, Copy)]
pub(crate) struct LineColumns<S: Simd> {
    /// Half of the width.
    pub(crate) half: F32<S>,
    /// 1 where distances to single edges count, 0 where the share of the face does.
    pub(crate) weight: F32<S>,
    /// What they cover in any case: the share where it counts.
    pub(crate) floor: F32<S>,
    /// 1 where they show in full beyond their faces, 0 where they do not.
    pub(crate) beyond: F32<S>,
}

impl<S: Simd> LineColumns<S> {
    /// Of faces with these inner radii, above 0, in pixels of the finer grid.
    #[inline(always)]
    pub(crate) fn new(simd: S, ink: &Ink, radius: F32<S>) -> Self {
        let wanted = F32::splat(simd, ink.half_width);
        let fading = radius * radius * (SHARE / (FADING * ink.scale));
        let half = lesser(lesser(wanted, radius * SHARE), fading);
        let [zero, one] = [0.0, 1.0].map(|value| F32::splat(simd, value));
        let rising =
            |[low, high]: [f32; 2]| lesser(greater((radius - low) * (1.0 / (high - low)), zero), one);
        let weight = rising(RESOLVED);
        let inner = (radius - half) / radius;
        let floor = (one - weight) * (one - inner * inner);
        Self { half, weight, floor, beyond: rising(BEYOND) }
    }

    /// Of outlined edges on the same faces: the distances at which the whole and the core end to cover anything, and the
    /// weight; the first two are multiplied by the third.
    #[inline(always)]
    pub(crate) fn outlined(self, simd: S, ink: &Ink, radius: F32<S>) -> [F32<S>; 3] {
        let fading = radius * radius * (SHARE / (FADING * ink.scale));
        let limit = lesser(radius * SHARE, fading);
        let whole = lesser(F32::splat(simd, ink.outlined_half), limit);
        let core = lesser(F32::splat(simd, ink.core_half), limit);
        [(whole + 0.5) * self.weight, (core + 0.5) * self.weight, self.weight]
    }
}

/// Half of the width of an outlined edge on a face, in pixels of the finer grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OutlinedHalves {
    /// With its outline.
    pub(crate) whole: f32,
    pub(crate) core: f32,
}

impl OutlinedHalves {
    /// On a face with this inner radius.
    pub(crate) fn on(ink: &Ink, radius: f32) -> Self {
        let least = |a: f32, b: f32| if b < a { b } else { a };
        let limit = least(radius * SHARE, radius * radius * (SHARE / (FADING * ink.scale)));
        Self { whole: least(ink.outlined_half, limit), core: least(ink.core_half, limit) }
    }
}

/// The point of an edge that is nearest to another point.
#[derive(Clone, Copy)]
pub(crate) struct EdgePoint {
    /// In pixels.
    pub(crate) distance: f64,
    /// In 1/256 pixel.
    pub(crate) point: [f64; 2],
    pub(crate) depth: f64,
    pub(crate) mark: u8,
    /// Whether it is an end of the edge.
    pub(crate) is_end: bool,
}

/// The lines on one face, as they show beyond it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct FaceLine {
    pub(crate) half: f32,
    pub(crate) weight: f32,
    /// The inner radius.
    pub(crate) radius: f32,
}

impl FaceLine {
    /// What it covers of a pixel along an edge, which may be outlined.
    pub(crate) fn overlap(self, edge: &EdgePoint, outlined: Option<OutlinedHalves>) -> Overlap {
        let Some(OutlinedHalves { whole, core }) = outlined.filter(|_| !edge.is_end) else {
            return Overlap::plain(self.coverage(edge.distance), edge.mark);
        };
        let [share, core] = [whole, core].map(|half| Self { half, ..self }.coverage(edge.distance));
        Overlap { share, core, mark: edge.mark }
    }

    /// Of a triangle that belongs to no face with edges: it narrows no line of others.
    pub(crate) const UNLINED: Self = Self { half: f32::INFINITY, weight: 1.0, radius: 0.0 };

    /// What a line of a face covers on another one that shares a corner with it.
    pub(crate) fn narrower(self, other: Self) -> Self {
        let least = |a: f32, b: f32| if b < a { b } else { a };
        Self { half: least(self.half, other.half), weight: least(self.weight, other.weight), ..self }
    }

    /// What it covers of a pixel with an edge at a distance.
    fn coverage(self, distance: f64) -> f32 {
        let most = (2.0 * self.half).min(1.0);
        self.weight * (self.half + 0.5 - distance as f32).min(most).max(0.0)
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FaceEdges;
    use crate::simd::{LANES, SimdLevel, at_level};
    use trigon_math::Vec3;

    /// Half widths, weights and floors.
    fn lines(width: f32, scale: u32, radii: [f32; LANES]) -> [[f32; LANES]; 3] {
        let ink = Ink::new(Some(&FaceEdges { width, color: Vec3::ZERO, opacity: 1.0 }), None, scale).unwrap();
        let token = SimdLevel::best().token().expect("the best level is there");
        at_level!(token, simd => {
            let LineColumns { half, weight, floor, .. } = LineColumns::new(simd, &ink, F32::simd_from(simd, radii));
            [half.into(), weight.into(), floor.into()]
        })
    }

    #[test]
    fn lines_take_no_more_than_their_share_and_fade_away() {
        let radii = [100.0, 4.5, 3.0, 1.5, 1.0, 0.5, 0.1, 0.001];
        let [half, weight, floor] = lines(2.0, 1, radii);
        assert_eq!(&half[..3], [1.0, 1.0, 1.0], "a third of the radius is enough");
        for (lane, radius) in radii.into_iter().enumerate() {
            let expected = 1.0_f32.min(radius / 3.0).min(radius * radius / 4.5);
            assert!((half[lane] - expected).abs() <= expected * 1e-6, "{} at {radius}", half[lane]);
            let inner = 1.0 - expected / radius;
            let share = 1.0 - inner * inner;
            // A few roundings of numbers of about 1.
            assert!((floor[lane] - (1.0 - weight[lane]) * share).abs() < 1e-6, "the share at {radius}");
        }
        assert_eq!(weight, [1.0, 1.0, 1.0, 1.0, 0.5, 0.0, 0.0, 0.0], "a pixel cannot resolve the last");
        assert!(floor[7] < 1e-3, "nothing is left of the edges of faces far away");
    }

    /// `min(w, 1, w/2 + 1/2 - d)` of a pixel.
    #[test]
    fn a_line_covers_its_width_and_no_more_than_the_pixel() {
        let line = |half| FaceLine { half, weight: 0.5, radius: 9.0 };
        for half in [0.0, 0.1, 0.5, 0.75, 3.0] {
            for distance in (0..40).map(|i| f64::from(i) / 8.0) {
                let expected = f64::from(2.0 * half).min(1.0).min(f64::from(half) + 0.5 - distance).max(0.0);
                let found = f64::from(line(half).coverage(distance));
                assert!((found - 0.5 * expected).abs() < 1e-6, "{found} of {half} at {distance}");
            }
        }
        let narrower = line(3.0).narrower(FaceLine { half: 1.0, weight: 0.75, radius: 2.0 });
        assert_eq!(narrower, FaceLine { half: 1.0, weight: 0.5, radius: 9.0 }, "of both the least");
        assert_eq!(line(3.0).narrower(FaceLine::UNLINED), line(3.0));
    }

    #[test]
    fn a_finer_grid_changes_no_width() {
        let radii = [40.0, 10.0, 5.0, 3.0, 2.0, 1.0, 0.5, 0.1];
        let [coarse, ..] = lines(3.0, 1, radii);
        let [fine, ..] = lines(3.0, 4, radii.map(|radius| radius * 4.0));
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            assert!((fine - coarse * 4.0).abs() <= fine * 1e-6, "{fine} for {coarse}");
        }
    }
}
