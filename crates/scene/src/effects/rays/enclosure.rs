//! Whether a surface encloses a volume. A ray that enters through an open surface would never leave, so an open
//! surface stands for a plate.

/// Whether triangles enclose a volume: each of their edges is passed as often in one direction as in
/// the other. Vertices at the same position are the same.
pub(super) fn encloses([x, y, z]: &[Vec<f32>; 3], triangles: impl Iterator<Item = [u32; 3]>) -> bool {
    // +0, so that both zeros are the same.
    let position_bits = |vertex: u32| [x, y, z].map(|column| (column[vertex as usize] + 0.0).to_bits());
    let mut ordered: Vec<u32> = (0..x.len() as u32).collect();
    ordered.sort_unstable_by_key(|&vertex| position_bits(vertex));
    let mut welded = vec![0_u32; ordered.len()];
    for pair in ordered.windows(2) {
        let is_new = position_bits(pair[0]) != position_bits(pair[1]);
        welded[pair[1] as usize] = welded[pair[0] as usize] + u32::from(is_new);
    }
    let mut edges: Vec<([u32; 2], bool)> = Vec::new();
    for corners in triangles {
        let [a, b, c] = corners.map(|vertex| welded[vertex as usize]);
        let sides = [[a, b], [b, c], [c, a]].into_iter().filter(|[from, to]| from != to);
        edges.extend(sides.map(|[from, to]| ([from.min(to), from.max(to)], from < to)));
    }
    edges.sort_unstable();
    let is_balanced = |edge: &[([u32; 2], bool)]| {
        2 * edge.iter().filter(|(_, is_forward)| *is_forward).count() == edge.len()
    };
    !edges.is_empty() && edges.chunk_by(|one, next| one.0 == next.0).all(is_balanced)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a tetrahedron, each three times as at creases, the last ones with a zero of
    /// the other sign.
    fn positions() -> [Vec<f32>; 3] {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let column = |axis: usize| -> Vec<f32> {
            let of = |zero: f32| corners.map(|corner: [f32; 3]| if corner[axis] == 0.0 { zero } else { 1.0 });
            [of(0.0), of(0.0), of(-0.0)].concat()
        };
        [column(0), column(1), column(2)]
    }

    #[test]
    fn closed_surfaces_enclose_and_open_ones_do_not() {
        let faces = [[0, 2, 1], [4, 5, 7], [8, 11, 10], [1, 6, 11]];
        let encloses = |faces: &[[u32; 3]]| encloses(&positions(), faces.iter().copied());
        assert!(encloses(&faces), "a tetrahedron");
        assert!(!encloses(&faces[..3]), "one that lacks a face");
        let turned = [faces[0], faces[1], faces[2], [11, 6, 1]];
        assert!(!encloses(&turned), "one with a face that looks inwards");
        assert!(encloses(&[&faces[..], &[[0, 4, 8]]].concat()), "a triangle without area is no edge");
        assert!(!encloses(&[]), "nothing");
    }
}
