//! Less stretch: a layout is changed so that each triangle comes closer to its own shape and size.
//!
//! The steps are those of L. Liu, L. Zhang, Y. Xu, C. Gotsman and S. Gortler, *A Local/Global Approach to Mesh
//! Parameterization*, 2008, section 4.2 ("as rigid as possible"): each triangle is turned to fit its layout, then one
//! system of equations joins them. They go only as far as no triangle is turned over: the bound is that of J. Smith
//! and S. Schaefer, *Bijective Parameterization with Free Boundaries*, 2015, section 3.3. A step that would let the
//! border cross itself, or increase the energy, is halved.

use trigon_math::DVec2;

use super::charts::{FlatTriangle, UvChart};
use super::factor::{Entry, Factor, NoFactor, conjugate, times};
use super::injective::{is_injective, turned_over};

/// Steps that gain less than this part of the energy end the iteration.
const LEAST_GAIN: f64 = 1e-6;
/// How far towards the first triangle without area a step goes at most.
const SAFETY: f64 = 0.8;
const HALVINGS: usize = 12;

/// Changes a layout in at most `iterations` steps. It is scaled to the area of the chart first. If triangles are
/// turned over to begin with, nothing else happens.
pub(super) fn minimize_stretch(
    chart: &UvChart,
    layout: &mut Vec<DVec2>,
    iterations: u32,
    memory: u64,
) -> Result<(), NoFactor> {
    let triangles: Vec<WeightedTriangle> = chart.flat_triangles().iter().map(WeightedTriangle::new).collect();
    scale_to_area(&triangles, layout);
    if iterations == 0 || turned_over(chart, layout) > 0 {
        return Ok(());
    }
    let global = Global::new(chart, &triangles, memory)?;
    let mut rotations = vec![DVec2::X; triangles.len()];
    let mut energy = fit(&triangles, layout, &mut rotations);
    for _ in 0..iterations {
        let wanted = global.solve(&triangles, &rotations, layout);
        let Some(step) = step(chart, &triangles, layout, &wanted, energy) else { break };
        let gain = energy - step.energy;
        *layout = step.layout;
        energy = fit(&triangles, layout, &mut rotations);
        if gain <= LEAST_GAIN * energy {
            break;
        }
    }
    Ok(())
}

/// A triangle with half the cotangents of the angles opposite to its sides.
struct WeightedTriangle {
    flat: FlatTriangle,
    /// By corner, for the side opposite to it.
    weights: [f64; 3],
}

/// One side of a triangle.
struct TriangleSide {
    ends: [u32; 2],
    /// On the surface.
    shape: DVec2,
    weight: f64,
}

impl WeightedTriangle {
    fn new(flat: &FlatTriangle) -> Self {
        let weight = |corner: usize| {
            let here = flat.points[corner];
            let [a, b] = [1, 2].map(|next| flat.points[(corner + next) % 3] - here);
            a.dot(b) / (2.0 * flat.double_area())
        };
        Self { flat: *flat, weights: [0, 1, 2].map(weight) }
    }

    fn sides(&self) -> [TriangleSide; 3] {
        [0, 1, 2].map(|corner| {
            let [from, to] = [(corner + 1) % 3, (corner + 2) % 3];
            TriangleSide {
                ends: [self.flat.vertices[from], self.flat.vertices[to]],
                shape: self.flat.points[to] - self.flat.points[from],
                weight: self.weights[corner],
            }
        })
    }

    /// The corners in a layout.
    fn in_layout(&self, layout: &[DVec2]) -> [DVec2; 3] {
        self.flat.vertices.map(|vertex| layout[vertex as usize])
    }
}

/// Scales a layout to the area of the surface.
fn scale_to_area(triangles: &[WeightedTriangle], layout: &mut [DVec2]) {
    let (mut surface, mut flat) = (0.0, 0.0);
    for triangle in triangles {
        let [a, b, c] = triangle.in_layout(layout);
        surface += triangle.flat.double_area();
        flat += (b - a).perp_dot(c - a);
    }
    let scale = (surface / flat.abs()).sqrt();
    if scale.is_finite() && scale > 0.0 {
        layout.iter_mut().for_each(|point| *point *= scale);
    }
}

/// The rotation that turns each triangle into its layout best, as a complex number. Returns the energy that is left:
/// the integral over the surface of the squared deviation from a rotation.
fn fit(triangles: &[WeightedTriangle], layout: &[DVec2], rotations: &mut [DVec2]) -> f64 {
    let mut energy = 0.0;
    for (triangle, rotation) in triangles.iter().zip(rotations) {
        let sides = triangle.sides();
        let laid = |side: &TriangleSide| layout[side.ends[1] as usize] - layout[side.ends[0] as usize];
        let sum: DVec2 =
            sides.iter().map(|side| times(laid(side), conjugate(side.shape)) * side.weight).sum();
        *rotation = sum.normalize_or(DVec2::X);
        for side in &sides {
            energy += side.weight * (laid(side) - times(*rotation, side.shape)).length_squared();
        }
    }
    energy
}

/// The system of equations that joins all triangles. The held vertices stay where they are, or else the first.
struct Global {
    factor: Factor,
    /// By vertex: the number of its unknown, `None` where it is held.
    unknowns: Vec<Option<u32>>,
}

impl Global {
    fn new(chart: &UvChart, triangles: &[WeightedTriangle], memory: u64) -> Result<Self, NoFactor> {
        let held = if chart.held.is_empty() { &[0][..] } else { &chart.held };
        let mut free = 0;
        let unknown = |vertex| {
            let is_free = held.binary_search(&vertex).is_err();
            free += u32::from(is_free);
            is_free.then(|| free - 1)
        };
        let unknowns: Vec<Option<u32>> = (0..chart.points.len() as u32).map(unknown).collect();
        let mut entries = Vec::new();
        for TriangleSide { ends, weight, .. } in triangles.iter().flat_map(WeightedTriangle::sides) {
            let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])].map(|end| unknowns[end as usize]);
            let value = DVec2::new(weight, 0.0);
            entries.extend(high.map(|high| Entry { row: high, column: high, value }));
            entries.extend(low.map(|low| Entry { row: low, column: low, value }));
            entries.extend(low.zip(high).map(|(row, column)| Entry { row, column, value: -value }));
        }
        Ok(Self { factor: Factor::new(free as usize, &entries, memory)?, unknowns })
    }

    /// Where all vertices would be, if held ones are where they are in a layout.
    fn solve(&self, triangles: &[WeightedTriangle], rotations: &[DVec2], layout: &[DVec2]) -> Vec<DVec2> {
        let is_free = |vertex: u32| self.unknowns[vertex as usize].is_some();
        let first = self.unknowns.iter().position(Option::is_none).expect("one is held");
        // Relative to the first that is held.
        let origin = layout[first];
        let mut sums = vec![DVec2::ZERO; self.unknowns.len()];
        for (triangle, &rotation) in triangles.iter().zip(rotations) {
            for TriangleSide { ends: [from, to], shape, weight } in triangle.sides() {
                let wanted = times(rotation, shape) * weight;
                sums[from as usize] -= wanted;
                sums[to as usize] += wanted;
                for [free, held] in [[from, to], [to, from]] {
                    if is_free(free) && !is_free(held) && held as usize != first {
                        sums[free as usize] += (layout[held as usize] - origin) * weight;
                    }
                }
            }
        }
        let right_hand_side: Vec<DVec2> = sums
            .iter()
            .zip(&self.unknowns)
            .filter(|(_, unknown)| unknown.is_some())
            .map(|(sum, _)| *sum)
            .collect();
        let relative = self.factor.solve(&right_hand_side);
        let point = |(unknown, at): (&Option<u32>, &DVec2)| {
            unknown.map_or(*at, |unknown| origin + relative[unknown as usize])
        };
        self.unknowns.iter().zip(layout).map(point).collect()
    }
}

/// A layout that is better than the last.
struct Step {
    layout: Vec<DVec2>,
    energy: f64,
}

/// Goes towards a layout as far as possible; `None` if nothing is gained.
fn step(
    chart: &UvChart,
    triangles: &[WeightedTriangle],
    layout: &[DVec2],
    wanted: &[DVec2],
    energy: f64,
) -> Option<Step> {
    let offsets: Vec<DVec2> = wanted.iter().zip(layout).map(|(wanted, point)| *wanted - *point).collect();
    let mut length = longest_step(triangles, layout, &offsets);
    let mut rotations = vec![DVec2::X; triangles.len()];
    for _ in 0..HALVINGS {
        let next: Vec<DVec2> =
            layout.iter().zip(&offsets).map(|(point, offset)| *point + *offset * length).collect();
        let next_energy = fit(triangles, &next, &mut rotations);
        if next_energy < energy && is_injective(chart, &next) {
            return Some(Step { layout: next, energy: next_energy });
        }
        length /= 2.0;
    }
    None
}

/// How far all triangles keep an area: at most 1, the whole step.
fn longest_step(triangles: &[WeightedTriangle], layout: &[DVec2], offsets: &[DVec2]) -> f64 {
    let mut longest = 1.0 / SAFETY;
    for triangle in triangles {
        let [a, b, c] = triangle.in_layout(layout);
        let [from_a, from_b, from_c] = triangle.in_layout(offsets);
        let (side, other) = (b - a, c - a);
        let (side_offset, other_offset) = (from_b - from_a, from_c - from_a);
        // Twice the area after a step of length t: constant + linear · t + square · t².
        let constant = side.perp_dot(other);
        let linear = side.perp_dot(other_offset) + side_offset.perp_dot(other);
        let square = side_offset.perp_dot(other_offset);
        if let Some(root) = first_root(constant, linear, square) {
            longest = root.min(longest);
        }
    }
    longest * SAFETY
}

/// The least positive root of a quadratic polynomial that is positive at 0.
fn first_root(constant: f64, linear: f64, square: f64) -> Option<f64> {
    let discriminant = linear * linear - 4.0 * square * constant;
    if discriminant < 0.0 {
        return None;
    }
    // Without cancellation: the product of the roots is constant / square.
    let q = (discriminant.sqrt() + linear.abs()) * if linear < 0.0 { 0.5 } else { -0.5 };
    let roots = [q / square, constant / q];
    roots.into_iter().filter(|root| *root > 0.0 && root.is_finite()).reduce(f64::min)
}
