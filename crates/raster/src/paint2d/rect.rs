//! Rectangles of whole pixels.

/// Pixels from `min` to before `max`: origin top-left, y down. Empty if `max`
/// is not beyond `min` on both axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rect {
    /// The first column and row inside.
    pub min: [i32; 2],
    /// The first column and row beyond.
    pub max: [i32; 2],
}

impl Rect {
    /// From the first column and row inside to the first ones beyond.
    #[must_use]
    pub const fn new(min: [i32; 2], max: [i32; 2]) -> Self {
        Self { min, max }
    }

    /// The pixels of both.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let [a, b] = [self, other];
        Self {
            min: [a.min[0].max(b.min[0]), a.min[1].max(b.min[1])],
            max: [a.max[0].min(b.max[0]), a.max[1].min(b.max[1])],
        }
    }

    /// Whether no pixel is inside.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.min[0] >= self.max[0] || self.min[1] >= self.max[1]
    }

    /// Whether all pixels of `other` are inside.
    #[must_use]
    pub fn contains(self, other: Self) -> bool {
        other.is_empty() || self.intersection(other) == other
    }
}
