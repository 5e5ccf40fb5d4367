//! What it costs to collapse each edge. Costs are computed on all threads, and the same on any number of them.

use rayon::prelude::*;
use trigon_math::DVec3;

use super::quadric::Quadric;
use super::surface::{Freedom, ReducedTriangle, Surface};
use crate::ids::NONE;

/// Where all costs are equal, as in a plane, short edges go first: a length counts as a distance from the surface of this
/// part of it, squared.
const SHORT_FIRST: f64 = 1e-5;

/// How strongly a new vertex is drawn to the middle of its edge, against the planes: only where these leave a choice.
const PULL: f64 = 1e-6;

/// A vertex farther from the middle of its edge, in lengths of the edge, is not reliable.
const FARTHEST: f64 = 2.0;

/// A possible collapse.
#[derive(Debug, Clone, Copy)]
pub(super) struct Collapse {
    pub(super) retained: u32,
    pub(super) gone: u32,
    pub(super) point: DVec3,
    /// For the order.
    pub(super) cost: f64,
    /// The mean squared distance from the planes, divided by the square of what the edge allows.
    pub(super) error: f64,
}

/// The triangles at each vertex when a round begins.
pub(super) struct Adjacency {
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Adjacency {
    pub(super) fn of(surface: &Surface) -> Self {
        let mut starts = vec![0u32; surface.points.len() + 1];
        for triangle in &surface.triangles {
            triangle.vertices.iter().for_each(|&vertex| starts[vertex as usize + 1] += 1);
        }
        for index in 1..starts.len() {
            starts[index] += starts[index - 1];
        }
        let mut next = starts.clone();
        let mut triangles = vec![0; 3 * surface.triangles.len()];
        for (number, triangle) in (0..).zip(&surface.triangles) {
            for &vertex in &triangle.vertices {
                triangles[next[vertex as usize] as usize] = number;
                next[vertex as usize] += 1;
            }
        }
        Self { starts, triangles }
    }

    pub(super) fn at(&self, vertex: u32) -> &[u32] {
        let [start, end] = [vertex, vertex + 1].map(|index| self.starts[index as usize] as usize);
        &self.triangles[start..end]
    }
}

/// An edge of triangles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub(super) ends: [u32; 2],
    pub(super) is_feature: bool,
}

/// All edges, each once.
pub(super) fn pairs(surface: &Surface, adjacency: &Adjacency) -> Vec<Pair> {
    let mut listed = vec![NONE; surface.points.len()];
    let mut pairs = Vec::with_capacity(surface.triangles.len() * 3 / 2);
    for vertex in 0..surface.points.len() as u32 {
        for &number in adjacency.at(vertex) {
            let ReducedTriangle { vertices, features, .. } = surface.triangles[number as usize];
            let side = index_of(&vertices, vertex);
            for (other, between) in [((side + 1) % 3, side), ((side + 2) % 3, (side + 2) % 3)] {
                let other = vertices[other];
                if other > vertex && listed[other as usize] != vertex {
                    listed[other as usize] = vertex;
                    pairs.push(Pair { ends: [vertex, other], is_feature: features[between] != NONE });
                }
            }
        }
    }
    pairs
}

pub(super) fn index_of(vertices: &[u32; 3], vertex: u32) -> usize {
    if vertices[0] == vertex {
        0
    } else if vertices[1] == vertex {
        1
    } else {
        2
    }
}

/// The edges that may collapse, the cheapest first: costs in the upper half, indices in the lower.
pub(super) fn order(surface: &Surface, pairs: &[Pair], largest: f64) -> Vec<u64> {
    let key = |(index, pair): (usize, &Pair)| {
        let candidate = candidate(surface, *pair)?;
        let is_allowed = candidate.error <= largest && candidate.cost.is_finite();
        // Numbers from 0 on are in the order of their bits.
        is_allowed.then(|| u64::from((candidate.cost as f32).to_bits()) << 32 | index as u64)
    };
    let mut order: Vec<u64> = pairs.par_iter().enumerate().filter_map(key).collect();
    order.par_sort_unstable();
    order
}

/// What collapsing an edge does, if its ends may move so.
pub(super) fn candidate(surface: &Surface, Pair { ends: [a, b], is_feature }: Pair) -> Option<Collapse> {
    let freedom = |vertex: u32| surface.freedoms[vertex as usize];
    let (retained, gone) = if freedom(a) >= freedom(b) { (a, b) } else { (b, a) };
    let moves = match (freedom(retained), freedom(gone)) {
        (Freedom::Fixed, Freedom::Fixed) => return None,
        (_, Freedom::OnCurve) if !is_feature => return None,
        (one, two) => one == two,
    };
    let allowance = surface.allowance([a, b]);
    if allowance == 0.0 {
        return None;
    }
    let mut quadric = surface.quadrics[a as usize];
    quadric += surface.quadrics[b as usize];
    let weight = quadric.weight;
    surface.values.add_error([a, b], &mut quadric);
    let [from, to] = [retained, gone].map(|vertex| surface.points[vertex as usize]);
    let length_squared = from.distance_squared(to);
    let point = if moves { surface.rounded(best_point(&quadric, from, to)) } else { from };
    let value = quadric.value(point);
    let scale = 1.0 / (allowance * allowance);
    let cost = (value + SHORT_FIRST * weight * length_squared) * scale;
    let error = if weight > 0.0 { value / weight * scale } else { 0.0 };
    Some(Collapse { retained, gone, point, cost, error })
}

/// Where the error is smallest. The ends are tried, too: at the corner of a box, what draws to the middle would move it.
fn best_point(quadric: &Quadric, from: DVec3, to: DVec3) -> DVec3 {
    let middle = (from + to) / 2.0;
    let lowest = quadric.lowest(middle, PULL * quadric.weight);
    let is_near = lowest.distance_squared(middle) <= FARTHEST * FARTHEST * from.distance_squared(to);
    let mut best = if is_near { lowest } else { middle };
    for point in [from, to] {
        if quadric.value(point) < quadric.value(best) {
            best = point;
        }
    }
    best
}

impl Surface {
    /// A position as the mesh will have it.
    fn rounded(&self, point: DVec3) -> DVec3 {
        (point + self.origin).as_vec3().as_dvec3() - self.origin
    }
}
