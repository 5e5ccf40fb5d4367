//! Less stretch: a layout is changed so that each triangle comes closer to its own shape and size.
//!
//! The energy is the symmetric Dirichlet energy of J. Smith and S. Schaefer, *Bijective Parameterization with Free
//! Boundaries*, 2015, section 3.1: the sum of the squared singular values of the map and of its inverse. It is least
//! for an isometry, and infinite where a triangle has no area. Each step solves one system of equations. Far from the
//! least energy its matrix is that of M. Rabinovich, R. Poranne, D. Panozzo and O. Sorkine-Hornung, *Scalable Locally
//! Injective Mappings*, 2017, section 3, near it the Hessian without its negative part, whose eigensystem is that of
//! B. Smith, F. de Goes and T. Kim, *Analytic Eigensystems for Isotropic Distortion Energies*, 2019. A step goes only
//! as far as no triangle is turned over (Smith and Schaefer, section 3.3). One that would let the border cross
//! itself, or not decrease the energy, is halved.

use trigon_math::{DMat2, DVec2, Orientation, orientation};

use super::charts::{FlatTriangle, UvChart};
use super::factor::{MatrixPattern, NoFactor, conjugate, times};
use super::injective::{is_injective, turned_over};

/// Steps that gain less than this part of the energy end the iteration.
const LEAST_GAIN: f64 = 1e-4;
/// How far towards the first triangle without area a step goes at most.
const SAFETY: f64 = 0.9;
const HALVINGS: usize = 12;
/// Above this mean energy, of which the least is 4, a layout is far from an isometry: there the Hessian leads to small
/// steps, but as soon as a step gains less than the other part of the energy, it is used.
const FAR_ENERGY: f64 = 6.0;
const FAR_GAIN: f64 = 0.05;

/// Changes a layout in at most `iterations` steps, if no triangle is turned over to begin with. Held vertices of the
/// chart stay where they are; without any, the layout is first scaled so that its energy is least.
pub(super) fn minimize_stretch(
    chart: &UvChart,
    layout: &mut Vec<DVec2>,
    iterations: u32,
    memory: u64,
) -> Result<(), NoFactor> {
    if iterations == 0 || turned_over(chart, layout) > 0 {
        return Ok(());
    }
    let triangles = StretchTriangle::of_chart(chart);
    if chart.held.is_empty() {
        scale_to_least(&triangles, layout);
    }
    // All but the first may move if none is held.
    let held = if chart.held.is_empty() { &[0][..] } else { &chart.held };
    let system = System::new(layout.len(), held, &triangles, memory)?;
    let (mut energy, mut gain) = (energy_of(&triangles, layout), f64::INFINITY);
    for _ in 0..iterations {
        let model = Model::at(energy, gain);
        let offsets = match system.offsets(&triangles, layout, model) {
            // Triangles are so flat in the layout that their equations drown all others.
            Err(NoFactor::NotPositive) => break,
            offsets => offsets?,
        };
        let is_allowed = |layout: &[DVec2]| is_injective(chart, layout);
        let Some(step) = step(&triangles, layout, &offsets, is_allowed) else { break };
        gain = energy - step.energy;
        *layout = step.layout;
        energy = step.energy;
        if is_little(gain, energy) {
            break;
        }
    }
    Ok(())
}

/// Whether a step gained so little that it was the last one.
pub(super) fn is_little(gain: f64, energy: f64) -> bool {
    gain <= LEAST_GAIN * energy
}

/// A triangle and its map into the layout: a z + b conj(z) of complex numbers, but for a translation.
pub(super) struct StretchTriangle {
    vertices: [u32; 3],
    /// By corner: the derivative of a by its position in the layout, that of b is the conjugate.
    gradients: [DVec2; 3],
    pub(super) area: f64,
}

/// The two parts of a map: that which preserves angles, and that which turns them round.
#[derive(Clone, Copy)]
struct MapParts {
    similar: DVec2,
    mirrored: DVec2,
}

impl StretchTriangle {
    pub(super) fn of_chart(chart: &UvChart) -> Vec<Self> {
        let new = |flat: FlatTriangle| Self::new(flat.vertices, flat.points, flat.double_area() / 2.0);
        chart.flat_triangles().into_iter().map(new).collect()
    }

    /// With the shape that it has in a layout, and a weight instead of its area.
    pub(super) fn at_rest(vertices: [u32; 3], layout: &[DVec2], weight: f64) -> Self {
        Self::new(vertices, vertices.map(|vertex| layout[vertex as usize]), weight)
    }

    fn new(vertices: [u32; 3], shape: [DVec2; 3], area: f64) -> Self {
        let double_area = (shape[1] - shape[0]).perp_dot(shape[2] - shape[0]);
        let gradient = |corner: usize| {
            let opposite = shape[(corner + 2) % 3] - shape[(corner + 1) % 3];
            conjugate(opposite.perp()) / (2.0 * double_area)
        };
        Self { vertices, gradients: [0, 1, 2].map(gradient), area }
    }

    /// Whether it is not turned over.
    pub(super) fn is_right(&self, layout: &[DVec2]) -> bool {
        let [a, b, c] = self.in_layout(layout);
        orientation(a, b, c) == Orientation::CounterClockwise
    }

    fn in_layout(&self, layout: &[DVec2]) -> [DVec2; 3] {
        self.vertices.map(|vertex| layout[vertex as usize])
    }

    fn parts(&self, layout: &[DVec2]) -> MapParts {
        let mut parts = MapParts { similar: DVec2::ZERO, mirrored: DVec2::ZERO };
        for (point, &gradient) in self.in_layout(layout).into_iter().zip(&self.gradients) {
            parts.similar += times(gradient, point);
            parts.mirrored += times(conjugate(gradient), point);
        }
        parts
    }
}

impl MapParts {
    /// The sums of the squared singular values of the map and of its inverse; infinite if it turns over.
    fn energies(self) -> [f64; 2] {
        let [similar, mirrored] = [self.similar.length_squared(), self.mirrored.length_squared()];
        let determinant = similar - mirrored;
        let sum = 2.0 * (similar + mirrored);
        if determinant > 0.0 { [sum, sum / (determinant * determinant)] } else { [sum, f64::INFINITY] }
    }
}

/// The mean energy over the surface: at least 4.
pub(super) fn energy_of(triangles: &[StretchTriangle], layout: &[DVec2]) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    for triangle in triangles {
        let [forward, backward] = triangle.parts(layout).energies();
        sum += triangle.area * (forward + backward);
        area += triangle.area;
    }
    sum / area
}

/// Scales a layout so that its energy is least.
pub(super) fn scale_to_least(triangles: &[StretchTriangle], layout: &mut [DVec2]) {
    let mut sums = DVec2::ZERO;
    for triangle in triangles {
        sums += triangle.area * DVec2::from_array(triangle.parts(layout).energies());
    }
    let scale = (sums.y / sums.x).sqrt().sqrt();
    if scale.is_finite() && scale > 0.0 {
        layout.iter_mut().for_each(|point| *point *= scale);
    }
}

/// By which matrix the energy is replaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Model {
    /// One that leads to an isometry at once, if triangles were independent.
    Far,
    /// The Hessian.
    Near,
}

impl Model {
    /// For a mean energy, and how much the last step gained.
    pub(super) fn at(energy: f64, gain: f64) -> Self {
        if energy > FAR_ENERGY && gain > FAR_GAIN * energy { Self::Far } else { Self::Near }
    }
}

/// First derivatives of a triangle's energy, and those second ones that are used.
struct Derivatives {
    /// The directions of both parts.
    directions: [DVec2; 2],
    /// By part, along its direction.
    gradient: DVec2,
    /// Symmetric: along the directions.
    along: DMat2,
    /// Symmetric: across them.
    across: DMat2,
}

impl Derivatives {
    fn new(parts: MapParts, model: Model) -> Self {
        let [similar, mirrored] = [parts.similar.length(), parts.mirrored.length()];
        // The singular values.
        let [large, small] = [similar + mirrored, similar - mirrored];
        let slope = |value: f64| 2.0 * (value - 1.0 / (value * value * value));
        let gradient = DVec2::new(slope(large) + slope(small), slope(large) - slope(small));
        let curvature = |value: f64| match model {
            Model::Far => 2.0 * (value + 1.0) * (value * value + 1.0) / (value * value * value),
            Model::Near => 2.0 + 6.0 / (value * value * value * value),
        };
        let sum = curvature(large) + curvature(small);
        let difference = curvature(large) - curvature(small);
        let symmetric =
            |x: f64, mixed: f64, y: f64| DMat2::from_cols(DVec2::new(x, mixed), DVec2::new(mixed, y));
        let across = match model {
            Model::Far => symmetric(sum, -difference, sum),
            Model::Near => {
                let product = small * large;
                let cube = product * product * product;
                let turning = gradient.x / similar;
                let mirroring = 4.0 * (1.0 + (small * small + small * large + large * large) / cube);
                symmetric(turning.max(LEAST_TURNING), 0.0, mirroring)
            }
        };
        let direction = |part: DVec2| part.normalize_or(DVec2::X);
        Self {
            directions: [direction(parts.similar), direction(parts.mirrored)],
            gradient,
            along: symmetric(sum, difference, sum),
            across,
        }
    }

    /// For a corner with this gradient.
    fn rows(&self, gradient: DVec2) -> CornerRows {
        let [similar, mirrored] = self.directions.map(conjugate);
        let (similar, mirrored) = (times(similar, gradient), times(mirrored, conjugate(gradient)));
        CornerRows {
            along: DMat2::from_cols(DVec2::new(similar.x, mirrored.x), DVec2::new(-similar.y, -mirrored.y)),
            across: DMat2::from_cols(DVec2::new(similar.y, mirrored.y), DVec2::new(similar.x, mirrored.x)),
        }
    }
}

/// By which linear maps the offset of a corner changes both parts, along their directions and across.
struct CornerRows {
    along: DMat2,
    across: DMat2,
}

/// The least curvature of a rotation: that of an isometry has none.
const LEAST_TURNING: f64 = 1e-3;

/// The vertices that a step may move: all that are not held.
struct Unknowns {
    /// By vertex: the number of its unknown, `None` where it stays.
    by_vertex: Vec<Option<u32>>,
    count: usize,
}

/// The pairs of corners on and above the diagonal.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];

impl Unknowns {
    fn new(vertices: usize, held: &[u32]) -> Self {
        let mut count = 0;
        let unknown = |vertex| {
            let is_free = held.binary_search(&vertex).is_err();
            count += u32::from(is_free);
            is_free.then(|| count - 1)
        };
        let by_vertex = (0..vertices as u32).map(unknown).collect();
        Self { by_vertex, count: count as usize }
    }

    /// The row and the column of two corners of a triangle, if both may move.
    fn entry(&self, triangle: &StretchTriangle, corners: [usize; 2]) -> Option<[u32; 2]> {
        let [row, column] = corners.map(|corner| self.by_vertex[triangle.vertices[corner] as usize]);
        row.zip(column).map(|(row, column)| [row, column])
    }

    fn entries<'s>(&'s self, triangle: &'s StretchTriangle) -> impl Iterator<Item = [u32; 2]> + 's {
        PAIRS.into_iter().filter_map(|pair| self.entry(triangle, pair))
    }
}

/// The equations of a step.
pub(super) struct System {
    pattern: MatrixPattern,
    unknowns: Unknowns,
}

impl System {
    /// Held vertices are in ascending order.
    pub(super) fn new(
        vertices: usize,
        held: &[u32],
        triangles: &[StretchTriangle],
        memory: u64,
    ) -> Result<Self, NoFactor> {
        let unknowns = Unknowns::new(vertices, held);
        let positions: Vec<[u32; 2]> =
            triangles.iter().flat_map(|triangle| unknowns.entries(triangle)).collect();
        Ok(Self { pattern: MatrixPattern::new::<DMat2>(unknowns.count, &positions, memory)?, unknowns })
    }

    /// Where the vertices should go from their layout: zero for those that stay.
    pub(super) fn offsets(
        &self,
        triangles: &[StretchTriangle],
        layout: &[DVec2],
        model: Model,
    ) -> Result<Vec<DVec2>, NoFactor> {
        let Unknowns { by_vertex, count } = &self.unknowns;
        let mut wanted = vec![DVec2::ZERO; *count];
        let mut values = Vec::with_capacity(PAIRS.len() * triangles.len());
        for triangle in triangles {
            let derivatives = Derivatives::new(triangle.parts(layout), model);
            let rows = triangle.gradients.map(|gradient| derivatives.rows(gradient));
            for (&vertex, rows) in triangle.vertices.iter().zip(&rows) {
                let Some(unknown) = by_vertex[vertex as usize] else { continue };
                wanted[unknown as usize] -= rows.along.transpose() * derivatives.gradient * triangle.area;
            }
            for [i, j] in PAIRS.into_iter().filter(|&pair| self.unknowns.entry(triangle, pair).is_some()) {
                let value = rows[i].along.transpose() * derivatives.along * rows[j].along
                    + rows[i].across.transpose() * derivatives.across * rows[j].across;
                values.push(value * triangle.area);
            }
        }
        let solution = self.pattern.factor(&values)?.solve(&wanted);
        let offset = |unknown: &Option<u32>| unknown.map_or(DVec2::ZERO, |at| solution[at as usize]);
        Ok(by_vertex.iter().map(offset).collect())
    }
}

/// A layout that is better than the last.
pub(super) struct StretchStep {
    pub(super) layout: Vec<DVec2>,
    pub(super) energy: f64,
}

/// Goes along offsets as far as possible; `None` if nothing is gained.
pub(super) fn step(
    triangles: &[StretchTriangle],
    layout: &[DVec2],
    offsets: &[DVec2],
    is_allowed: impl Fn(&[DVec2]) -> bool,
) -> Option<StretchStep> {
    let energy = energy_of(triangles, layout);
    let mut length = longest_step(triangles, layout, offsets);
    for _ in 0..HALVINGS {
        let next: Vec<DVec2> =
            layout.iter().zip(offsets).map(|(point, offset)| *point + *offset * length).collect();
        let next_energy = energy_of(triangles, &next);
        if next_energy < energy && is_allowed(&next) {
            return Some(StretchStep { layout: next, energy: next_energy });
        }
        length /= 2.0;
    }
    None
}

/// How far all triangles keep an area: at most 1, the whole step.
fn longest_step(triangles: &[StretchTriangle], layout: &[DVec2], offsets: &[DVec2]) -> f64 {
    let mut longest: f64 = 1.0 / SAFETY;
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
