//! Layouts within a circle: without overlaps whatever the surface, but with much stretch.
//!
//! W. Tutte, *How to Draw a Graph*, 1963: if the border of a triangulated disc is put onto a convex polygon, and
//! every other vertex into the mean of its neighbours, no triangle is turned over. M. Floater, *One-to-one
//! Piecewise Linear Mappings over Triangulations*, 2003, has the conditions: on a circle they hold for every disc.

use trigon_math::{DVec2, elementary};

use super::charts::UvChart;
use super::factor::{Entry, Factor, NoFactor};
use super::ordering::Graph;

/// The layout of a chart that is a disc with holes: the longest loop of its border on a circle, with distances as
/// long in relation to one another as on the surface. Other loops are closed by a vertex in the middle of each.
pub(super) fn convex(chart: &UvChart, memory: u64) -> Result<Vec<DVec2>, NoFactor> {
    let outer = longest_loop(chart);
    let count = chart.points.len();
    let mut layout = vec![DVec2::ZERO; count];
    let mut is_fixed = vec![false; count];
    on_circle(chart, &chart.loops[outer], &mut layout);
    chart.loops[outer].iter().for_each(|&vertex| is_fixed[vertex as usize] = true);
    let mut unknown = vec![u32::MAX; count];
    let mut unknowns = 0;
    for vertex in (0..count).filter(|&vertex| !is_fixed[vertex]) {
        unknown[vertex] = unknowns;
        unknowns += 1;
    }
    let (filled, nodes) = with_filled_holes(chart, outer);
    unknown.extend((0..(nodes - count) as u32).map(|hole| unknowns + hole));
    let size = unknowns as usize + nodes - count;
    let (mut entries, mut right_hand_side) = (Vec::new(), vec![DVec2::ZERO; size]);
    for (vertex, &row) in unknown.iter().enumerate().filter(|&(_, &row)| row != u32::MAX) {
        let neighbors = filled.neighbors(vertex as u32);
        let degree = DVec2::new(neighbors.len() as f64, 0.0);
        entries.push(Entry { row, column: row, value: degree });
        for &neighbor in neighbors {
            match unknown[neighbor as usize] {
                u32::MAX => right_hand_side[row as usize] += layout[neighbor as usize],
                column if row < column => entries.push(Entry { row, column, value: DVec2::NEG_X }),
                _ => {}
            }
        }
    }
    let solution = Factor::new(size, &entries, memory)?.solve(&right_hand_side);
    for (vertex, row) in unknown[..count].iter().enumerate().filter(|&(_, &row)| row != u32::MAX) {
        layout[vertex] = solution[*row as usize];
    }
    Ok(layout)
}

/// The length of a loop of the border.
fn length(chart: &UvChart, border: &[u32]) -> f64 {
    (0..border.len()).map(|i| edge_length(chart, border, i)).sum()
}

fn edge_length(chart: &UvChart, border: &[u32], i: usize) -> f64 {
    let [from, to] = [border[i], border[(i + 1) % border.len()]];
    chart.points[from as usize].distance(chart.points[to as usize])
}

/// The first of the longest loops.
pub(super) fn longest_loop(chart: &UvChart) -> usize {
    let mut longest = (0, length(chart, &chart.loops[0]));
    for (i, border) in chart.loops.iter().enumerate().skip(1) {
        let length = length(chart, border);
        if length > longest.1 {
            longest = (i, length);
        }
    }
    longest.0
}

fn on_circle(chart: &UvChart, border: &[u32], layout: &mut [DVec2]) {
    // Vertices stay apart even where edges have no length.
    let least = (length(chart, border) / border.len() as f64 * 1e-2).max(f64::MIN_POSITIVE);
    let lengths: Vec<f64> = (0..border.len()).map(|i| edge_length(chart, border, i).max(least)).collect();
    let whole: f64 = lengths.iter().sum();
    let mut along = 0.0;
    for (&vertex, length) in border.iter().zip(lengths) {
        let (sin, cos) = elementary::sin_cos(std::f64::consts::TAU * along / whole);
        layout[vertex as usize] = DVec2::new(cos, sin);
        along += length;
    }
}

/// The neighbours of all vertices, and of one more in each hole; with the number of all.
fn with_filled_holes(chart: &UvChart, outer: usize) -> (Graph, usize) {
    let sides = chart.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let holes = chart.loops.iter().enumerate().filter(|&(i, _)| i != outer).map(|(_, hole)| hole);
    let first = chart.points.len() as u32;
    let spokes =
        (first..).zip(holes).flat_map(|(center, hole)| hole.iter().map(move |&vertex| [center, vertex]));
    let nodes = chart.points.len() + chart.loops.len() - 1;
    (Graph::new(nodes, sides.chain(spokes)), nodes)
}
