//! The visible triangles of a tile, as the search for outer halves of lines needs them.

use super::FaceLine;

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

    /// Takes triangles from others that were noted, which have these places in the tile's list now; the places increase.
    pub(crate) fn note_again(&mut self, others: &Self, places: &[u32]) {
        let count = places.len();
        // Mostly all of them come first.
        if places.last().is_some_and(|&last| last as usize == count - 1) {
            self.depths[..count].copy_from_slice(&others.depths[..count]);
            self.lines[..count].copy_from_slice(&others.lines[..count]);
        } else {
            for ((&place, &depths), &line) in places.iter().zip(&others.depths).zip(&others.lines) {
                self.depths[place as usize] = depths;
                self.lines[place as usize] = line;
            }
        }
        self.has_lines |= others.has_lines;
        self.has_large |= others.has_large;
    }

    /// Takes a visible triangle of the tile. Whoever notes one with lines, or a large one, says so in `has_lines` and
    /// `has_large`.
    #[inline(always)]
    pub(crate) fn note(&mut self, place: u32, depths: DepthRange, line: FaceLine) {
        self.depths[place as usize] = depths;
        self.lines[place as usize] = line;
    }
}
