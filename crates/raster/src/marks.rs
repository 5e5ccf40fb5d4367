//! Marks: edges and faces that are painted in colours of their own, such as the selected
//! ones.

use std::cmp::Ordering;
use trigon_math::Vec4;

/// The marks of a draw's edges and faces; [`Pass::marks`](crate::Pass::marks) sets their
/// colours.
///
/// A mark is a number from 1 to 15. 0, greater numbers and places beyond the end of a list mean
/// no mark. Marks are looked up for visible elements only, so marking other elements takes
/// nothing but another list.
#[derive(Clone, Copy, Debug, Default)]
pub struct Marks<'a> {
    /// For each triangle the numbers of the edges that its sides are: side `i` runs from
    /// corner `i` to corner `i + 1 (mod 3)`. `u32::MAX` for diagonals.
    pub sides: &'a [[u32; 3]],
    /// The marks of edges, by their numbers.
    pub edges: &'a [u8],
    /// The marks of faces, by their ids.
    pub faces: &'a [u8],
}

/// The colours of marks, by their numbers. Of two marked edges with equal coverage of a pixel,
/// the one with the greater mark gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkColors {
    /// Linear RGB and opacity of edges: these take the place of
    /// [`FaceEdges`](crate::FaceEdges)' own. The first is not used.
    pub edges: [Vec4; Self::COUNT],
    /// Linear RGB of what is mixed into the colours of faces, and its share. The first is not
    /// used.
    pub faces: [Vec4; Self::COUNT],
}

impl MarkColors {
    /// The number of marks, including the one for "no mark".
    pub const COUNT: usize = 16;

    /// Marks that are invisible.
    pub const NONE: Self = Self { edges: [Vec4::ZERO; Self::COUNT], faces: [Vec4::ZERO; Self::COUNT] };
}

impl Marks<'_> {
    /// Those of a triangle's sides.
    pub(crate) fn of_sides(&self, triangle: u32) -> [u8; 3] {
        let sides = self.sides.get(triangle as usize).unwrap_or(&[u32::MAX; 3]);
        sides.map(|edge| mark(self.edges, edge))
    }

    /// That of a face.
    pub(crate) fn of_face(&self, face: u32) -> u8 {
        mark(self.faces, face)
    }
}

fn mark(marks: &[u8], element: u32) -> u8 {
    let mark = marks.get(element as usize).copied().unwrap_or(0);
    if usize::from(mark) < MarkColors::COUNT { mark } else { 0 }
}

/// What the lines on a pixel cover of it, and the mark of the one that gives them their
/// colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Overlap {
    pub(crate) share: f32,
    pub(crate) mark: u8,
}

impl Overlap {
    /// The one that covers more; of equal ones that with the greater mark.
    pub(crate) fn or(self, other: Self) -> Self {
        if other.is_above(self) { other } else { self }
    }

    /// Whether it is drawn above the other where the two overlap.
    pub(crate) fn is_above(self, other: Self) -> bool {
        match self.share.partial_cmp(&other.share) {
            Some(Ordering::Greater) => true,
            Some(Ordering::Equal) => self.mark > other.mark,
            Some(Ordering::Less) | None => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_a_list_has_no_mark() {
        let marks = Marks { sides: &[[0, 2, u32::MAX]], edges: &[3, 200], faces: &[15] };
        assert_eq!(marks.of_sides(0), [3, 0, 0], "the second edge is beyond the list, the third is none");
        assert_eq!(marks.of_sides(1), [0; 3], "no such triangle");
        assert_eq!([marks.of_face(0), marks.of_face(1)], [15, 0], "the last mark, and none");
        assert_eq!(mark(marks.edges, 1), 0, "no such mark");
    }

    #[test]
    fn the_greater_mark_decides_between_equal_shares_only() {
        let [thin, low, high] = [(0.5, 9), (1.0, 1), (1.0, 2)].map(|(share, mark)| Overlap { share, mark });
        assert_eq!(thin.or(low), low, "more is covered");
        assert_eq!(low.or(high), high, "equally much");
        assert_eq!(high.or(low), high, "in any order");
    }
}
