//! Whether triangles bound a body, as those of a 3MF have to (Core Specification, 4.1).

/// How many edges do not have exactly two triangles that run along them in opposite directions. 0 for a closed surface.
pub(super) fn open_edges(triangles: &[[u32; 3]]) -> usize {
    let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
    // An edge with its ends in ascending order, and whether the triangle runs along it upwards.
    let mut edges: Vec<(u32, u32, bool)> =
        triangles.iter().flat_map(sides).map(|[from, to]| (from.min(to), from.max(to), from < to)).collect();
    edges.sort_unstable();
    let is_closed = |edge: &&[(u32, u32, bool)]| matches!(edge, [(.., false), (.., true)]);
    edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|edge| !is_closed(edge)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_without_an_opposite_are_counted() {
        let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        assert_eq!(open_edges(&tetrahedron), 0, "closed");
        assert_eq!(open_edges(&tetrahedron[1..]), 3, "a hole");
        let turned = [[0, 1, 2], tetrahedron[1], tetrahedron[2], tetrahedron[3]];
        assert_eq!(open_edges(&turned), 3, "one shows its inside");
        assert_eq!(open_edges(&[tetrahedron, tetrahedron].concat()), 6, "twice the same");
        assert_eq!(open_edges(&[]), 0, "nothing");
    }
}
