//! The box around the vertices that a drag leaves where they are.

use trigon_math::{Bounds3, Vec3};

/// The vertices that moved last, and the box around all others. That is the same as long as no others move, so a drag
/// finds it once.
#[derive(Clone, Debug, Default)]
pub(crate) struct StillBounds {
    moved: Vec<u32>,
    /// `None` until somebody asks for it.
    others: Option<Bounds3>,
}

impl StillBounds {
    /// The box around all vertices but those that are about to move, if it is known. It is if the box around all, which
    /// is given, stays the same without them, or if they have moved last: then `others` finds it once, from their
    /// indices, which increase. Vertices without a place do not count.
    pub(crate) fn without(
        &mut self,
        bounds: Option<Bounds3>,
        moved: impl Iterator<Item = u32> + Clone,
        position: impl Fn(u32) -> Option<Vec3>,
        others: impl FnOnce(&[u32]) -> Bounds3,
    ) -> Option<Bounds3> {
        let is_repeated = self.moved.iter().copied().eq(moved.clone());
        if !is_repeated {
            *self = Self { moved: moved.clone().collect(), others: None };
        }
        let bounds = bounds?;
        let is_on_border = |vertex: u32| {
            let position = position(vertex).map(Vec3::as_dvec3);
            position.is_some_and(|position| (position.cmpeq(bounds.min) | position.cmpeq(bounds.max)).any())
        };
        if !moved.clone().any(is_on_border) {
            return Some(bounds);
        }
        is_repeated.then(|| {
            *self.others.get_or_insert_with(|| {
                let mut moved = self.moved.clone();
                moved.sort_unstable();
                others(&moved)
            })
        })
    }
}
