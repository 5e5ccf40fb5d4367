//! What the surface does in one cell of the lattice: which of the cell's edges it crosses, and which crossings belong
//! together.
//!
//! Corners are numbered by bits: 1 for x, 2 for y, 4 for z. An edge along axis `a` has the number `4 a` plus 1 if it is on
//! the far side along the next axis, and 2 if it is along the one after that. A side of the cell has the number `2 a`,
//! plus 1 for the far one.

/// Which crossings of a cell belong to one sheet of the surface: for each edge 2 bits, the number of its sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CellSheets {
    numbers: u32,
    count: u8,
}

/// Both edges that a sheet crosses on a side of a cell, twice where two corners across are inside.
type Segments = [Option<[usize; 2]>; 2];

impl CellSheets {
    /// Of a cell with a bit for each corner inside, and one for each side across which inner corners are joined.
    pub(super) fn new(inside: u8, joined: u8) -> Self {
        // Crossings are the nodes of a graph of cycles, with a link on each side: labels spread along the links.
        let mut labels: [usize; 12] = std::array::from_fn(|edge| edge);
        for side in 0..6 {
            for [a, b] in segments(inside, side, joined >> side & 1 != 0).into_iter().flatten() {
                let (from, to) = (labels[a].max(labels[b]), labels[a].min(labels[b]));
                labels.iter_mut().filter(|label| **label == from).for_each(|label| *label = to);
            }
        }
        let mut sheets = Self { numbers: 0, count: 0 };
        for edge in (0..12).filter(|&edge| is_crossed(inside, edge)) {
            let number = match labels[edge] {
                first if first == edge => {
                    sheets.count += 1;
                    usize::from(sheets.count - 1)
                }
                first => sheets.of(first),
            };
            sheets.numbers |= (number as u32) << (2 * edge);
        }
        sheets
    }

    /// How many sheets there are: up to 4.
    pub(super) fn count(self) -> u32 {
        u32::from(self.count)
    }

    /// The number of the sheet that crosses an edge.
    pub(super) fn of(self, edge: usize) -> usize {
        (self.numbers >> (2 * edge) & 3) as usize
    }

    /// Whether one sheet crosses all edges of a side, which it crosses twice.
    pub(super) fn is_doubled_at(self, side: usize) -> bool {
        let edges = edges_of(side);
        edges.iter().all(|&edge| self.of(edge) == self.of(edges[0]))
    }
}

/// Whether corners inside and outside alternate around a side, so that the surface crosses all of its edges.
pub(super) fn is_ambiguous(inside: u8, side: usize) -> bool {
    let corners = corners_of(side).map(|corner| inside >> corner & 1 != 0);
    corners[0] == corners[2] && corners[1] == corners[3] && corners[0] != corners[1]
}

fn is_crossed(inside: u8, edge: usize) -> bool {
    let [a, b] = ends_of(edge);
    (inside >> a ^ inside >> b) & 1 != 0
}

/// The corners at both ends of an edge.
fn ends_of(edge: usize) -> [usize; 2] {
    let axis = edge / 4;
    let start = (edge & 1) << ((axis + 1) % 3) | (edge >> 1 & 1) << ((axis + 2) % 3);
    [start, start | 1 << axis]
}

/// The corners of a side, around it.
fn corners_of(side: usize) -> [usize; 4] {
    let axis = side / 2;
    let (b, c) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
    let start = (side & 1) << axis;
    [start, start | b, start | b | c, start | c]
}

/// The edges of a side: from each of its corners to the next one.
fn edges_of(side: usize) -> [usize; 4] {
    let corners = corners_of(side);
    std::array::from_fn(|i| {
        let [from, to] = [corners[i], corners[(i + 1) % 4]];
        let axis = (from ^ to).trailing_zeros() as usize;
        let start = from & to;
        4 * axis + (start >> ((axis + 1) % 3) & 1) + 2 * (start >> ((axis + 2) % 3) & 1)
    })
}

fn segments(inside: u8, side: usize, is_joined: bool) -> Segments {
    let edges = edges_of(side);
    if is_ambiguous(inside, side) {
        // The edges at a corner are the one that ends there and the one that begins there.
        let first_is_inside = inside >> corners_of(side)[0] & 1 != 0;
        let [around_even, around_odd] = [
            [Some([edges[3], edges[0]]), Some([edges[1], edges[2]])],
            [Some([edges[0], edges[1]]), Some([edges[2], edges[3]])],
        ];
        return if first_is_inside == is_joined { around_odd } else { around_even };
    }
    let mut crossed = edges.into_iter().filter(|&edge| is_crossed(inside, edge));
    match (crossed.next(), crossed.next()) {
        (Some(a), Some(b)) => [Some([a, b]), None],
        _ => [None, None],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which corners are connected, as the number of the first of them: along edges, and across ambiguous sides if they
    /// are outside.
    fn regions(inside: u8) -> usize {
        let mut first: [usize; 8] = std::array::from_fn(|corner| corner);
        let mut links: Vec<[usize; 2]> =
            (0..12).filter(|&edge| !is_crossed(inside, edge)).map(ends_of).collect();
        for side in (0..6).filter(|&side| is_ambiguous(inside, side)) {
            let outer = corners_of(side).into_iter().filter(|&corner| inside >> corner & 1 == 0);
            links.push(outer.collect::<Vec<_>>().try_into().expect("two of four"));
        }
        for _ in 0..8 {
            for &[a, b] in &links {
                let least = first[a].min(first[b]);
                (first[a], first[b]) = (least, least);
            }
        }
        (0..8).filter(|&corner| first[corner] == corner).count()
    }

    /// Sheets cut the surface of the cell, a sphere, along closed curves: there is one region more than curves.
    #[test]
    fn each_of_the_256_cells_has_as_many_sheets_as_regions_need() {
        for inside in 1..=254_u8 {
            assert_eq!(CellSheets::new(inside, 0).count() as usize, regions(inside) - 1, "{inside:08b}");
        }
    }

    #[test]
    fn joining_across_all_sides_separates_outer_corners_instead() {
        for inside in 1..=254_u8 {
            assert_eq!(CellSheets::new(inside, 0x3F), CellSheets::new(!inside, 0), "{inside:08b}");
        }
    }
}
