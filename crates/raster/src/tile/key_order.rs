//! A tile's triangles in the order of their keys, which [`FrameView::compare`] defines.

use crate::bin::TriangleRef;
use crate::tile_buffer::{NO_TRIANGLE, VisibilityBuffer};
use crate::view::FrameView;

/// A triangle of a tile: its object, its face, its number among the tile's.
///
/// In one number, from the highest bits down, because such numbers are sorted much faster
/// than anything that takes a function to compare.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Keyed(u128);

impl Keyed {
    fn new(object_and_face: u64, number: u32) -> Self {
        Self(u128::from(object_and_face) << 32 | u128::from(number))
    }

    fn object_and_face(self) -> u64 {
        (self.0 >> 32) as u64
    }

    fn number(self) -> usize {
        self.0 as u32 as usize
    }
}

/// Some of a tile's triangles in the order of their keys: at equal depth the first is
/// visible.
#[derive(Default)]
pub(crate) struct KeyOrder {
    sorted: Vec<Keyed>,
}

impl KeyOrder {
    /// Sorts triangles by [`FrameView::compare`]. Parts of one primitive keep their order.
    pub(super) fn sort(&mut self, frame: &FrameView<'_>, triangles: &[TriangleRef]) {
        self.sorted.clear();
        // Neighbours mostly belong to the same draw.
        let mut draw = 0;
        self.sorted.extend(triangles.iter().zip(0..).map(|(&triangle, number)| {
            if !frame.plan.draws[draw].ordinals.contains(&triangle.ordinal) {
                draw = frame.draw_of(triangle);
            }
            Keyed::new(frame.object_and_face(draw, triangle), number)
        }));
        self.sorted.sort_unstable();
        let same_face = |a: &Keyed, b: &Keyed| a.object_and_face() == b.object_and_face();
        for face in self.sorted.chunk_by_mut(same_face).filter(|face| face.len() > 1) {
            let triangle_of = |keyed: &Keyed| triangles[keyed.number()];
            let [first, last] =
                [&face[0], &face[face.len() - 1]].map(|keyed| frame.draw_of(triangle_of(keyed)));
            // Those of one draw are in order already.
            if first != last {
                face.sort_unstable_by(|a, b| frame.compare(triangle_of(a), triangle_of(b)).then(a.cmp(b)));
            }
        }
    }

    /// The same triangles in this order.
    pub(super) fn of(&self, triangles: &[TriangleRef]) -> impl Iterator<Item = TriangleRef> {
        self.sorted.iter().map(|keyed| triangles[keyed.number()])
    }

    /// For each triangle how many primitives come before it.
    pub(super) fn ranks(&self, triangles: &[TriangleRef], ranks: &mut Vec<u32>) {
        ranks.clear();
        ranks.resize(triangles.len(), 0);
        let same_primitive =
            |a: &Keyed, b: &Keyed| triangles[a.number()].ordinal == triangles[b.number()].ordinal;
        for (rank, parts) in (0..).zip(self.sorted.chunk_by(same_primitive)) {
            for part in parts {
                ranks[part.number()] = rank;
            }
        }
    }

    /// Replaces the indices in this order by those among the tile's triangles.
    pub(super) fn name_visible(&self, buffer: &mut VisibilityBuffer) {
        for visible in buffer.visible_mut().iter_mut().filter(|visible| **visible != NO_TRIANGLE) {
            *visible = self.sorted[*visible as usize].number() as u32;
        }
    }
}
