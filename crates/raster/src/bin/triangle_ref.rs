//! References to what is drawn, for chunks and tiles. There are many, so each takes 4 or 8 bytes.

/// What a tile of a chunk lists: a triangle that is drawn as it is, a point that is drawn from its
/// vertex, one of the triangles made from a cut one, or a line or a point that is two triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Entry(pub(super) u32);

/// The primitive to which an [`Entry`] refers.
pub(super) enum Listed {
    /// The triangle or the point of this index in the chunk.
    Primitive(u32),
    /// The index of one of the chunk's own triangles.
    Extra(usize),
    /// The index of one of the chunk's lines and points.
    Quad(usize),
}

impl Entry {
    const EXTRA: u32 = 1 << 31;
    const QUAD: u32 = 1 << 30;
    const POINT: u32 = 1 << 29;

    /// The triangle of this index in the chunk, as it is.
    #[inline(always)]
    pub(crate) fn primitive(index: u32) -> Self {
        Self(index)
    }

    /// The point of this index in the chunk, drawn from its vertex.
    #[inline(always)]
    pub(crate) fn point(index: u32) -> Self {
        Self(index + Self::POINT)
    }

    /// The index in the chunk of a triangle or a point that is drawn as it is.
    #[inline(always)]
    pub(super) fn index(self) -> u32 {
        self.0 & !Self::POINT
    }

    #[inline(always)]
    fn is_point(self) -> bool {
        self.0 & Self::POINT != 0
    }

    /// A triangle of the chunk's own.
    #[inline(always)]
    pub(crate) fn extra(index: usize) -> Self {
        Self(index as u32 + Self::EXTRA)
    }

    /// A line or a point.
    #[inline(always)]
    pub(super) fn quad(index: usize) -> Self {
        Self(index as u32 + Self::QUAD)
    }

    #[inline(always)]
    pub(super) fn listed(self) -> Listed {
        if self.0 & Self::EXTRA != 0 {
            Listed::Extra((self.0 & !Self::EXTRA) as usize)
        } else if self.0 & Self::QUAD != 0 {
            Listed::Quad((self.0 & !Self::QUAD) as usize)
        } else {
            Listed::Primitive(self.index())
        }
    }
}

/// A triangle of a frame: a primitive that is drawn as it is, one that its
/// chunk keeps, or half of a line or a point. Or a point that is drawn from its vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleRef {
    /// The primitive's ordinal in the frame.
    pub(crate) ordinal: u32,
    pub(super) extra: u32,
}

impl TriangleRef {
    const WHOLE: u32 = u32::MAX;
    const POINT: u32 = Self::WHOLE - 1;
    const QUAD: u32 = 1 << 31;

    /// A triangle or a point that is drawn as it is, of a chunk whose ordinals start here.
    #[inline(always)]
    pub(super) fn whole(start: u32, entry: Entry) -> Self {
        Self { ordinal: start + entry.index(), extra: Self::WHOLE - u32::from(entry.is_point()) }
    }

    /// Half of a line or a point.
    #[inline(always)]
    pub(super) fn half(ordinal: u32, quad: usize, half: u32) -> Self {
        Self { ordinal, extra: Self::QUAD + 2 * quad as u32 + half }
    }

    /// Whether it is simply a triangle that was recorded.
    #[inline(always)]
    pub(crate) fn is_whole(self) -> bool {
        self.extra == Self::WHOLE
    }

    /// Whether it is a point that is drawn from its vertex.
    #[inline(always)]
    pub(crate) fn is_point(self) -> bool {
        self.extra == Self::POINT
    }

    /// What triangles of a frame are sorted by.
    #[inline(always)]
    pub(crate) fn order(self) -> (u32, u32) {
        (self.ordinal, self.extra)
    }

    /// The part of its primitive that it is, if it is not all of it: a number that grows from
    /// part to part.
    #[inline(always)]
    pub(crate) fn part(self) -> Option<u32> {
        (self.extra < Self::POINT).then_some(self.extra)
    }

    /// Its index among the chunk's own triangles.
    #[inline(always)]
    pub(super) fn extra(self) -> Option<usize> {
        // What is drawn as it is has this bit set, too.
        (self.extra & Self::QUAD == 0).then_some(self.extra as usize)
    }

    /// The index of a line or a point among the chunk's, and which half of it it is.
    #[inline(always)]
    pub(super) fn quad(self) -> Option<(usize, usize)> {
        let is_half = self.extra < Self::POINT && self.extra & Self::QUAD != 0;
        is_half.then_some(((self.extra & !Self::QUAD) as usize >> 1, self.extra as usize & 1))
    }

    /// Whether it is half of a line or a point: the first half, and the other comes next, as
    /// tiles have both.
    #[inline(always)]
    pub(crate) fn is_first_half(self) -> bool {
        self.quad().is_some_and(|(_, half)| half == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_tell_what_they_list() {
        for number in [0, 1, 2, 77, (1 << 29) - 1] {
            for (entry, is_point) in [(Entry::primitive(number), false), (Entry::point(number), true)] {
                let Listed::Primitive(index) = entry.listed() else { panic!("a primitive") };
                assert_eq!((index, entry.index(), entry.is_point()), (number, number, is_point));
                let triangle = TriangleRef::whole(5, entry);
                assert_eq!((triangle.ordinal, triangle.part()), (5 + number, None), "all of its primitive");
                assert_eq!((triangle.is_point(), triangle.is_whole()), (is_point, !is_point));
                assert_eq!(
                    (triangle.extra(), triangle.quad(), triangle.is_first_half()),
                    (None, None, false)
                );
            }
            let index = number as usize;
            assert!(matches!(Entry::extra(index).listed(), Listed::Extra(found) if found == index));
            assert!(matches!(Entry::quad(index).listed(), Listed::Quad(found) if found == index));
        }
    }

    #[test]
    fn halves_tell_their_line_and_their_order() {
        for quad in [0, 1, 6, (1 << 29) - 1] {
            let [first, second] = [0, 1].map(|half| TriangleRef::half(9, quad, half));
            assert_eq!([first.ordinal, second.ordinal], [9, 9], "of one primitive");
            assert_eq!([first.quad(), second.quad()], [Some((quad, 0)), Some((quad, 1))]);
            assert_eq!([first.is_first_half(), second.is_first_half()], [true, false]);
            assert!(first.part() < second.part(), "the number grows from part to part");
            for half in [first, second] {
                assert!(!half.is_whole() && !half.is_point() && half.extra().is_none());
            }
        }
        for index in [0, 1, 77] {
            let part = TriangleRef { ordinal: 9, extra: index };
            assert_eq!((part.extra(), part.part()), (Some(index as usize), Some(index)), "made by a cut");
            assert_eq!((part.quad(), part.is_whole(), part.is_point()), (None, false, false));
        }
    }
}
