//! The corners of triangles, and how they hang together.
//!
//! Corner 3 · t + k is the k-th of triangle t. The opposite of a corner is the one across the edge
//! that it faces.

/// Stands for no corner, vertex or entry.
pub(super) const NONE: u32 = u32::MAX;

/// The corner after one in its triangle; [`NONE`] after none.
pub(super) fn next(corner: u32) -> u32 {
    match corner {
        NONE => NONE,
        _ if corner % 3 == 2 => corner - 2,
        _ => corner + 1,
    }
}

/// The corner before one in its triangle; [`NONE`] before none.
pub(super) fn previous(corner: u32) -> u32 {
    match corner {
        NONE => NONE,
        _ if corner.is_multiple_of(3) => corner + 2,
        _ => corner - 1,
    }
}

/// A mesh as corners.
#[derive(Default)]
pub(super) struct CornerTable {
    /// The vertex of each corner.
    pub(super) vertices: Vec<u32>,
    /// The opposite of each corner; [`NONE`] at a boundary.
    pub(super) opposites: Vec<u32>,
    /// A corner of each vertex, the leftmost if the vertex is on a boundary; [`NONE`] for vertices
    /// that no triangle uses.
    pub(super) first: Vec<u32>,
}

impl CornerTable {
    /// Triangles that are not connected and have no vertices.
    pub(super) fn with_triangles(count: usize) -> Self {
        Self { vertices: vec![NONE; 3 * count], opposites: vec![NONE; 3 * count], first: Vec::new() }
    }

    /// The vertex of a corner; [`NONE`] of none.
    pub(super) fn vertex(&self, corner: u32) -> u32 {
        self.vertices.get(corner as usize).copied().unwrap_or(NONE)
    }

    /// The corner across an edge; [`NONE`] at a boundary.
    pub(super) fn opposite(&self, corner: u32) -> u32 {
        self.opposites.get(corner as usize).copied().unwrap_or(NONE)
    }

    /// A corner of a vertex; [`NONE`] of none.
    pub(super) fn first(&self, vertex: u32) -> u32 {
        self.first.get(vertex as usize).copied().unwrap_or(NONE)
    }

    /// The corner of the same vertex in the triangle to the left.
    pub(super) fn swing_left(&self, corner: u32) -> u32 {
        next(self.opposite(next(corner)))
    }

    /// The corner of the same vertex in the triangle to the right.
    pub(super) fn swing_right(&self, corner: u32) -> u32 {
        previous(self.opposite(previous(corner)))
    }

    /// The corner that faces the triangle of a corner from the left.
    pub(super) fn left(&self, corner: u32) -> u32 {
        self.opposite(previous(corner))
    }

    /// The corner that faces the triangle of a corner from the right.
    pub(super) fn right(&self, corner: u32) -> u32 {
        self.opposite(next(corner))
    }

    /// Whether the triangles around a vertex do not close.
    pub(super) fn is_on_boundary(&self, vertex: u32) -> bool {
        self.swing_left(self.first(vertex)) == NONE
    }

    /// All corners of a vertex, from one of them: to the left, and at a boundary then to the right.
    pub(super) fn around(&self, start: u32) -> impl Iterator<Item = u32> + '_ {
        let mut is_left = true;
        std::iter::successors(Some(start).filter(|&corner| corner != NONE), move |&corner| {
            if is_left {
                match self.swing_left(corner) {
                    NONE => is_left = false,
                    left => return Some(left).filter(|&left| left != start),
                }
                return Some(self.swing_right(start)).filter(|&right| right != NONE);
            }
            Some(self.swing_right(corner)).filter(|&right| right != NONE)
        })
    }
}
