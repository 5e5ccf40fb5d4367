//! Runs of samples that see the same triangle.

/// Neighbouring samples in a row that belong to one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    /// The triangle's ordinal in the frame; while visible samples are being
    /// sorted, its place in the tile.
    pub(crate) triangle: u32,
    /// Where the first result goes; the others follow.
    pub(crate) output: u32,
    /// The first sample in the tile.
    pub(crate) x: u16,
    pub(crate) y: u16,
    pub(crate) length: u16,
}

impl Span {
    /// Adds a sample to the last of the `spans` if it continues that, else as a
    /// span of its own.
    #[inline]
    pub(crate) fn extend(spans: &mut Vec<Self>, triangle: u32, [x, y]: [usize; 2], output: usize) {
        if let Some(last) = spans.last_mut()
            && last.triangle == triangle
            && usize::from(last.y) == y
            && usize::from(last.x + last.length) == x
            && (last.output + u32::from(last.length)) as usize == output
        {
            last.length += 1;
            return;
        }
        spans.push(Self { triangle, output: output as u32, x: x as u16, y: y as u16, length: 1 });
    }
}
