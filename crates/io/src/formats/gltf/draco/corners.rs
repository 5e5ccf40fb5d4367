//! The corners of triangles and how they hang together, and the seams at which an attribute has different
//! values on both sides of an edge.

use super::symbols::LikelyBits;

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

/// Which edges are seams: for each kind of attribute, whether the edge that each corner faces is
/// one. Boundaries are not among them.
pub(super) fn read_seams(table: &CornerTable, kinds: &mut [LikelyBits<'_>]) -> Vec<Vec<bool>> {
    let corners = table.opposites.len() as u32;
    let mut seams = vec![vec![false; corners as usize]; kinds.len()];
    for corner in 0..corners {
        let opposite = table.opposite(corner);
        // An edge is stored with the first of its triangles.
        if opposite == NONE || opposite / 3 < corner / 3 {
            continue;
        }
        for (seams, bits) in seams.iter_mut().zip(&mut *kinds) {
            if bits.take() {
                seams[corner as usize] = true;
                seams[opposite as usize] = true;
            }
        }
    }
    seams
}

/// The same triangles without connections across seams, and with a vertex for each side of them.
pub(super) fn split_at_seams(whole: &CornerTable, seams: Vec<bool>) -> CornerTable {
    let opposites = whole.opposites.iter().zip(seams);
    let opposites = opposites.map(|(&opposite, is_seam)| if is_seam { NONE } else { opposite }).collect();
    let mut split = CornerTable { vertices: vec![NONE; whole.vertices.len()], opposites, first: Vec::new() };
    for &start in whole.first.iter().filter(|&&corner| corner != NONE) {
        let leftmost = leftmost(&split, start);
        let mut corner = leftmost;
        loop {
            // To the left of the corner is a seam, a boundary or, of the first one, anything.
            if corner == leftmost || split.opposite(next(corner)) == NONE {
                split.first.push(corner);
            }
            split.vertices[corner as usize] = split.first.len() as u32 - 1;
            corner = whole.swing_right(corner);
            if corner == NONE || corner == leftmost {
                break;
            }
        }
    }
    split
}

/// The last corner to the left of one; the same if there is no end.
fn leftmost(table: &CornerTable, start: u32) -> u32 {
    let mut corner = start;
    loop {
        match table.swing_left(corner) {
            NONE => return corner,
            left if left == start => return start,
            left => corner = left,
        }
    }
}
