//! Conformal layouts: angles are preserved as well as possible.
//!
//! B. Lévy, S. Petitjean, N. Ray and J. Maillot, *Least Squares Conformal Maps for Automatic Texture Atlas
//! Generation*, SIGGRAPH 2002. Two or more vertices are pinned; the others are where the sum over all triangles of the
//! squared deviation from a similarity is least. The sum is taken over complex numbers as in section 3, and
//! solved by its normal equations.

use trigon_math::DVec2;

use super::charts::{FlatTriangle, UvChart};
use super::factor::{Entry, Factor, NoFactor, conjugate, times};
use super::pinned::Pin;

/// The layout of a chart, up to a similarity.
pub(super) fn conformal(chart: &UvChart, memory: u64) -> Result<Vec<DVec2>, NoFactor> {
    let FarVertices { vertices, distance } = FarVertices::new(chart);
    let ends = [(vertices[0], DVec2::ZERO), (vertices[1], DVec2::new(distance, 0.0))];
    solve(chart, ends.into_iter(), memory)
}

/// The layout of a chart with at least two pins.
pub(super) fn between(chart: &UvChart, pins: &[Pin], memory: u64) -> Result<Vec<DVec2>, NoFactor> {
    solve(chart, pins.iter().map(|pin| (pin.vertex, pin.point())), memory)
}

/// The layout in which some vertices are at given points.
fn solve(
    chart: &UvChart,
    given: impl Iterator<Item = (u32, DVec2)>,
    memory: u64,
) -> Result<Vec<DVec2>, NoFactor> {
    let mut rows = NormalEquations::new(chart.points.len(), given);
    chart.flat_triangles().iter().for_each(|triangle| rows.add(triangle));
    let factor = Factor::new(rows.right_hand_side.len(), &rows.entries, memory)?;
    let solution = factor.solve(&rows.right_hand_side);
    let value = |fixed: &Fixed| match *fixed {
        Fixed::Pinned(value) => value,
        Fixed::Free(unknown) => solution[unknown as usize],
    };
    Ok(rows.vertices.iter().map(value).collect())
}

/// Two vertices of the border that are far apart, and their distance.
struct FarVertices {
    vertices: [u32; 2],
    distance: f64,
}

impl FarVertices {
    /// The farthest pair of a small border; of a large one the ends of the longest of a few steps, each to the
    /// vertex that is farthest from the last.
    fn new(chart: &UvChart) -> Self {
        const SMALL: usize = 256;
        const STEPS: usize = 4;
        let border: Vec<u32> = chart.loops.iter().flatten().copied().collect();
        let point = |vertex: u32| chart.points[vertex as usize];
        let mut best = Self { vertices: [border[0], border[1]], distance: 0.0 };
        let mut farthest_from = |from: u32| {
            let mut farthest = Self { vertices: [from, from], distance: -1.0 };
            for &to in border.iter().filter(|&&to| to != from) {
                let distance = point(from).distance(point(to));
                if distance > farthest.distance {
                    farthest = Self { vertices: [from, to], distance };
                }
            }
            let to = farthest.vertices[1];
            if farthest.distance > best.distance {
                best = farthest;
            }
            to
        };
        if border.len() <= SMALL {
            for &from in &border {
                farthest_from(from);
            }
        } else {
            (0..STEPS).fold(border[0], |from, _| farthest_from(from));
        }
        if best.distance <= 0.0 {
            // All are at one point: any size will do.
            best.distance = 1.0;
        }
        best
    }
}

/// Whether a vertex is pinned, or the number of its unknown.
enum Fixed {
    Pinned(DVec2),
    Free(u32),
}

/// The normal equations.
struct NormalEquations {
    vertices: Vec<Fixed>,
    entries: Vec<Entry>,
    right_hand_side: Vec<DVec2>,
}

impl NormalEquations {
    fn new(count: usize, given: impl Iterator<Item = (u32, DVec2)>) -> Self {
        let mut points = vec![None; count];
        given.for_each(|(vertex, point)| points[vertex as usize] = Some(point));
        let mut free = 0;
        let fixed = |point: Option<DVec2>| {
            point.map_or_else(
                || {
                    free += 1;
                    Fixed::Free(free - 1)
                },
                Fixed::Pinned,
            )
        };
        let vertices: Vec<Fixed> = points.into_iter().map(fixed).collect();
        Self { vertices, entries: Vec::new(), right_hand_side: vec![DVec2::ZERO; free as usize] }
    }

    fn add(&mut self, triangle: &FlatTriangle) {
        let [a, b, c] = triangle.points;
        // A map is a similarity exactly if the sum of these times the texture coordinates is 0.
        let weights = [c - b, a - c, b - a];
        let area = triangle.double_area();
        for (&row_vertex, &row_weight) in triangle.vertices.iter().zip(&weights) {
            let Fixed::Free(row) = self.vertices[row_vertex as usize] else { continue };
            for (&vertex, &weight) in triangle.vertices.iter().zip(&weights) {
                let value = times(conjugate(row_weight), weight) / area;
                match self.vertices[vertex as usize] {
                    Fixed::Pinned(pin) => self.right_hand_side[row as usize] -= times(value, pin),
                    Fixed::Free(column) if row <= column => self.entries.push(Entry { row, column, value }),
                    Fixed::Free(_) => {}
                }
            }
        }
    }
}
