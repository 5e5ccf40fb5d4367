//! Filling a strip with faces.

/// Fills the strip between two rows of points with quads and triangles: steps along each row are
/// spread evenly, and where both rows step at the same moment there is a quad. Rows may begin or
/// end in the same point. `piece` gets the outlines, which run along `row` and back along `other`.
pub(super) fn fill_strip(row: &[u32], other: &[u32], mut piece: impl FnMut(&[u32])) {
    let (steps, other_steps) = (row.len() - 1, other.len() - 1);
    let (mut i, mut j) = (0, 0);
    while i < steps || j < other_steps {
        // Step number i of n happens at (i + 1/2) / n.
        let moment = (2 * i + 1) as u64 * other_steps as u64;
        let other_moment = (2 * j + 1) as u64 * steps as u64;
        let advances = j == other_steps || (i < steps && moment <= other_moment);
        let other_advances = i == steps || (j < other_steps && other_moment <= moment);
        let mut outline = [0; 4];
        let mut count = 0;
        let mut add = |index: u32| {
            if !outline[..count].contains(&index) {
                outline[count] = index;
                count += 1;
            }
        };
        add(row[i]);
        i += usize::from(advances);
        add(row[i]);
        add(other[j + usize::from(other_advances)]);
        add(other[j]);
        j += usize::from(other_advances);
        if count > 2 {
            piece(&outline[..count]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(row: &[u32], other: &[u32]) -> Vec<Vec<u32>> {
        let mut pieces = Vec::new();
        fill_strip(row, other, |piece| pieces.push(piece.to_vec()));
        pieces
    }

    #[test]
    fn a_strip_is_filled_evenly() {
        assert_eq!(pieces(&[0, 1, 2], &[5, 4, 3]), [[0, 1, 4, 5], [1, 2, 3, 4]], "quads");
        assert_eq!(pieces(&[0, 1, 2], &[4, 3]), [[0, 1, 4], [1, 3, 4], [1, 2, 3]], "three triangles");
        let symmetric = [vec![0, 1, 9], vec![1, 2, 8, 9], vec![2, 3, 8]];
        assert_eq!(pieces(&[0, 1, 2, 3], &[9, 8]), symmetric, "a quad in the middle");
        assert_eq!(pieces(&[0, 1, 2], &[9]), [[0, 1, 9], [1, 2, 9]], "a fan");
        assert_eq!(pieces(&[0, 1, 2], &[0, 3, 4]), [vec![0, 1, 3], vec![1, 2, 4, 3]], "from one point");
    }
}
