//! Where the lines of a lattice cross a surface.

use std::cmp::Ordering;

use trigon_math::{DVec2, DVec3, Orientation, orientation};

use super::lattice::Lattice;

/// A crossing of a line along an axis with a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct LineCrossing {
    /// The line: [`Lattice::line`].
    pub(super) line: u64,
    /// Along the axis.
    pub(super) coordinate: f64,
    /// 1 where the line enters the surface, −1 where it leaves it.
    pub(super) winding: i8,
}

/// The crossings of all lines along an axis with triangles, sorted by line and coordinate.
///
/// Which lines cross a triangle is exact. A line through an edge or a vertex is decided as if it was moved by a tiny
/// amount along the first axis after its own, and by a much smaller one along the second one (H. Edelsbrunner and
/// E. Mücke, "Simulation of Simplicity", 1990), so that each line enters a closed surface as often as it leaves it.
pub(super) fn line_crossings(triangles: &[[DVec3; 3]], lattice: &Lattice, axis: usize) -> Vec<LineCrossing> {
    let mut crossings = Vec::new();
    for triangle in triangles {
        add_crossings(triangle, lattice, axis, &mut crossings);
    }
    crossings.sort_unstable_by(|a: &LineCrossing, b: &LineCrossing| {
        a.line.cmp(&b.line).then(a.coordinate.total_cmp(&b.coordinate)).then(a.winding.cmp(&b.winding))
    });
    crossings
}

fn add_crossings(triangle: &[DVec3; 3], lattice: &Lattice, axis: usize, crossings: &mut Vec<LineCrossing>) {
    let [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
    let flat = triangle.map(|point| DVec2::new(point[b], point[c]));
    // One more on both sides, for rounding.
    let range = |at: usize, [from, to]: [f64; 2]| {
        let [from, to] = [lattice.number_from(at, from) - 1, lattice.number_from(at, to) + 2];
        from.max(0) as u64..(to.max(0) as u64).min(lattice.counts[at])
    };
    let rows = extent(flat.iter().map(|corner| corner.y));
    for j in range(c, rows) {
        let row = lattice.coordinate(c, j);
        let columns = extent(edges(&flat).filter_map(|edge| crossing_of_row(edge, row)).flatten());
        for i in range(b, columns) {
            let at = DVec2::new(lattice.coordinate(b, i), row);
            if let Some(winding) = side_of(at, &flat) {
                crossings.push(LineCrossing {
                    line: lattice.line(axis, [i, j]),
                    coordinate: coordinate_at(triangle, &flat, at, axis),
                    winding,
                });
            }
        }
    }
}

/// The least and the greatest of some numbers; a range without any if there are none.
fn extent(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], number| {
        [if number < low { number } else { low }, if number > high { number } else { high }]
    })
}

fn edges(corners: &[DVec2; 3]) -> impl Iterator<Item = [DVec2; 2]> {
    let [a, b, c] = *corners;
    [[a, b], [b, c], [c, a]].into_iter()
}

/// Between which x coordinates an edge crosses a row, but for rounding; `None` if it does not reach it.
fn crossing_of_row([p, q]: [DVec2; 2], row: f64) -> Option<[f64; 2]> {
    let [low, high] = extent([p.y, q.y].into_iter());
    if row < low || row > high {
        return None;
    }
    if low == high {
        return Some([p.x, q.x]);
    }
    let x = p.x + (q.x - p.x) * ((row - p.y) / (q.y - p.y));
    Some([x, x])
}

/// Whether a triangle contains a point: 1 if it is clockwise, so that it looks against the axis; −1 if it is
/// counter-clockwise.
fn side_of(at: DVec2, [a, b, c]: &[DVec2; 3]) -> Option<i8> {
    let sides = [turn(at, *a, *b), turn(at, *b, *c), turn(at, *c, *a)];
    match sides {
        [Ordering::Greater, Ordering::Greater, Ordering::Greater] => Some(-1),
        [Ordering::Less, Ordering::Less, Ordering::Less] => Some(1),
        _ => None,
    }
}

/// The sign of the orientation of a point that is moved by (ε, ε²), and two others. Equal only if these are the same.
fn turn(at: DVec2, a: DVec2, b: DVec2) -> Ordering {
    let by_distance = |difference: f64| difference.total_cmp(&0.0);
    match orientation(at, a, b) {
        Orientation::CounterClockwise => Ordering::Greater,
        Orientation::Clockwise => Ordering::Less,
        // The derivatives by both coordinates of the point.
        Orientation::Collinear if a.y != b.y => by_distance(a.y - b.y),
        Orientation::Collinear if a.x != b.x => by_distance(b.x - a.x),
        Orientation::Collinear => Ordering::Equal,
    }
}

/// The coordinate of a triangle along an axis where its projection is at a point within it.
fn coordinate_at(triangle: &[DVec3; 3], flat: &[DVec2; 3], at: DVec2, axis: usize) -> f64 {
    let area = |a: DVec2, b: DVec2| (a - at).perp_dot(b - at);
    let weights = [area(flat[1], flat[2]), area(flat[2], flat[0]), area(flat[0], flat[1])];
    let sum: f64 = weights.iter().sum();
    let heights = triangle.map(|point| point[axis]);
    let [low, high] = extent(heights.into_iter());
    let blend: f64 = weights.iter().zip(heights).map(|(weight, height)| weight / sum * height).sum();
    // Of a triangle that is nearly parallel to the axis, any height is on it but for rounding.
    if blend.is_finite() { blend.clamp(low, high) } else { 0.5 * (low + high) }
}
