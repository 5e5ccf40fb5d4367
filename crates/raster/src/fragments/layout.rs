//! How the record of a visible triangle is laid out: which number stands in which column.

use super::context::ShadeContext;
use crate::ink::Ink;
use crate::simd::LANES;

/// The columns that every vector loads before those of varyings.
pub(crate) mod hot {
    /// The first of the sorted vertices from the tile's corner, in 1/256 pixel: x in
    /// the low half, y in the high one. Like the steps only of triangles that are
    /// not wide.
    pub(crate) const POINT: usize = 0;
    /// Steps of the edge functions opposite vertices 1 and 2: to the right in the
    /// low half, down in the high one. Nothing for triangles that are wide or cut.
    pub(crate) const STEPS: usize = 1;
    /// The vertices' 1/w, divided by the largest power of two not above the greatest of them.
    pub(crate) const Q: usize = 3;
    /// How many there are.
    pub(crate) const COUNT: usize = 6;
}

/// Columns of the two rows that few vectors load.
pub(crate) mod cold {
    /// As in the hot row, each number separately.
    pub(crate) const POINT: usize = 0;
    pub(crate) const RIGHT: usize = 2;
    pub(crate) const DOWN: usize = 4;
    /// The power of two.
    pub(crate) const SCALE: usize = 6;
    /// The triangle among the tile's.
    pub(crate) const INDEX: usize = 7;
    /// Depths of the vertices.
    pub(crate) const DEPTH: usize = 8;
    /// How many there are.
    pub(crate) const COUNT: usize = 16;
}

/// Columns of the lines on triangles, behind the varyings, of draws whose edges are painted.
pub(crate) mod lined {
    /// One over the slope of the corners' raw weights in pixels, times the weight of the line: turns a
    /// raw weight into the distance from the edge opposite the corner. Below 0 where that is no
    /// edge of the face.
    pub(crate) const INVERSE: usize = 0;
    /// The distance at which a line ends to cover anything, and the most that it covers.
    pub(crate) const REACH: usize = 3;
    pub(crate) const MOST: usize = 4;
    /// What is covered everywhere.
    pub(crate) const FLOOR: usize = 5;
    /// How many there are.
    pub(crate) const COUNT: usize = 6;
}

/// Columns of outlined edges, in frames that have any: see `LineColumns::outlined`.
pub(crate) mod outlined {
    pub(crate) const WHOLE: usize = 0;
    pub(crate) const CORE: usize = 1;
    pub(crate) const WEIGHT: usize = 2;
    /// How many there are.
    pub(crate) const COUNT: usize = 3;
}

/// Bits of a record's flags. The lowest six tell which corners the vertices are,
/// two bits each.
pub(crate) mod flag {
    /// It shows its back.
    pub(crate) const BACK: i32 = 1 << 6;
    /// It has edges to measure a distance to.
    pub(crate) const EDGES: i32 = 1 << 7;
    /// Its bounding box is at least [`SMALL`](crate::primitive::SMALL) on an axis, so its edge
    /// functions may need more than 32 bits.
    pub(crate) const WIDE: i32 = 1 << 8;
    /// Its vertices are not the corners of its primitive: it was cut, or it is half of a line.
    pub(crate) const CUT: i32 = 1 << 9;
}

/// The weights of the corners at the vertices of cut triangles, in lanes:
/// `[vertex][corner]`.
pub(crate) type CutColumns = [[[f32; LANES]; 3]; 3];

/// Where the records of a draw are, and how each is laid out.
#[derive(Clone, Copy, Default)]
pub(crate) struct RecordShape {
    /// The first row and the first record.
    pub(crate) first: [usize; 2],
    /// All rows of a record.
    pub(crate) size: usize,
    /// The first of them, that every vector loads.
    pub(crate) loaded: usize,
    /// How many varyings each vertex has.
    pub(crate) varyings: usize,
    /// The first column of [`lined`], where edges are painted.
    pub(crate) lines: Option<usize>,
    /// The column of the marks, where there are any: of the sides opposite the corners and of
    /// the face, a byte each from the lowest on.
    pub(crate) marks: Option<usize>,
    /// The first column of [`outlined`], where there are lines and marks and some of these are outlined.
    pub(crate) outlined: Option<usize>,
}

impl RecordShape {
    /// All rows of a record.
    #[inline(always)]
    pub(crate) fn rows(self) -> usize {
        self.size
    }

    /// The first of all.
    pub(crate) fn new(context: &ShadeContext<'_>) -> Self {
        let varyings = context.varying_count;
        let lines = context.ink().map(|_| hot::COUNT + 3 * varyings);
        let columns = lines.map_or(hot::COUNT + 3 * varyings, |first| first + lined::COUNT);
        let marks = context.marks().map(|_| columns);
        let columns = columns + usize::from(marks.is_some());
        let has_outlines = context.ink().is_some_and(Ink::has_outlines) && marks.is_some();
        let outlined = has_outlines.then_some(columns);
        let columns = columns + if has_outlines { outlined::COUNT } else { 0 };
        let loaded = columns.div_ceil(LANES);
        let size = loaded + if context.reads_all { cold::COUNT / LANES } else { 0 };
        Self { first: [0; 2], size, loaded, varyings, lines, marks, outlined }
    }
}
