//! Seams: edges at which an attribute has different values on both sides.

use super::corners::{CornerTable, NONE, next};
use super::rans::LikelyBits;

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
