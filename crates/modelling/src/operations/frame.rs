//! A face in its plane: directions inwards from its edges, and the combination of its corners for a
//! position.

use trigon_math::{DVec2, DVec3, area_vector, unit_or_zero};

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};

/// Up to this number of corners a position is a combination of all; beyond it the work for all
/// corners of a face would grow with their square.
const MANY: usize = 32;

/// Larger weights belong to a position far outside, or to a self-intersecting outline, for which
/// mean values are meaningless.
const HEAVIEST: f64 = 64.0;

/// One face; its memory is reused for the next.
#[derive(Default)]
pub(super) struct FaceFrame {
    pub(super) corners: Vec<CornerId>,
    pub(super) positions: Vec<DVec3>,
    /// Of unit length; zero where the face has no area or is not finite.
    pub(super) normal: DVec3,
    /// The positions in the plane.
    flat: Vec<DVec2>,
    axes: [DVec3; 2],
    /// Three corners that span the plane; `None` until needed.
    span: Option<[usize; 3]>,
}

impl FaceFrame {
    /// Sets the face.
    pub(super) fn load(&mut self, mesh: &EditMesh, face: FaceId) {
        self.corners.clear();
        self.corners.extend(mesh.face_corners(face));
        self.positions.clear();
        self.positions.extend(self.corners.iter().map(|&corner| mesh.point(mesh.corner_vertex(corner))));
        self.normal = unit_or_zero(area_vector(self.positions.iter().copied()));
        self.axes = plane_axes(self.normal);
        self.flat.clear();
        let Self { positions, flat, axes, .. } = self;
        let origin = positions[0];
        flat.extend(positions.iter().map(|&position| flatten(position - origin, axes)));
        self.span = None;
    }

    /// The unit vector in the plane pointing inwards from an edge, which runs from the corner of this number
    /// to the next; zero if the edge has no direction.
    pub(super) fn inward(&self, index: usize) -> DVec3 {
        let next = self.positions[(index + 1) % self.positions.len()];
        unit_or_zero(self.normal.cross(next - self.positions[index]))
    }

    /// Writes the weights of corners, by their numbers, for a position in the plane, which the content of the
    /// corner `from` moved to. They sum to 1, and for functions that are affine in the plane they give the
    /// value at the position, also outside the face.
    ///
    /// Inside the face, up to [`MANY`] corners, these are mean value coordinates (Michael S. Floater, "Mean
    /// value coordinates", 2003; Kai Hormann and Floater, "Mean value coordinates for arbitrary planar
    /// polygons", 2006). Elsewhere the value at the corner changes with the slope between three corners of
    /// the face.
    pub(super) fn weights(&mut self, from: usize, position: DVec3, weights: &mut Vec<(usize, f64)>) {
        let at = flatten(position - self.positions[0], &self.axes);
        if at == self.flat[from] || self.normal == DVec3::ZERO {
            weights.clear();
            weights.push((from, 1.0));
        } else if self.flat.len() > MANY || !mean_values(&self.flat, at, weights) {
            self.slope_weights(from, at, weights);
        }
    }

    fn slope_weights(&mut self, from: usize, at: DVec2, weights: &mut Vec<(usize, f64)>) {
        let [a, b, c] = *self.span.get_or_insert_with(|| widest(&self.flat));
        let (ab, ac, step) = (self.flat[b] - self.flat[a], self.flat[c] - self.flat[a], at - self.flat[from]);
        let area = ab.perp_dot(ac);
        let (to_b, to_c) = (step.perp_dot(ac) / area, ab.perp_dot(step) / area);
        weights.clear();
        weights.push((from, 1.0));
        if to_b.is_finite() && to_c.is_finite() {
            weights.extend([(a, -to_b - to_c), (b, to_b), (c, to_c)]);
        }
    }
}

/// Two unit vectors perpendicular to a normal and each other, counter-clockwise around it.
fn plane_axes(normal: DVec3) -> [DVec3; 2] {
    let across = if normal.x.abs() < 0.6 { DVec3::X } else { DVec3::Y };
    let u = unit_or_zero(across.cross(normal));
    [u, normal.cross(u)]
}

fn flatten(vector: DVec3, axes: &[DVec3; 2]) -> DVec2 {
    DVec2::new(vector.dot(axes[0]), vector.dot(axes[1]))
}

/// Three corners of a polygon that span much of it: the first, the one farthest from it, and the one
/// farthest from the line through both.
fn widest(flat: &[DVec2]) -> [usize; 3] {
    let best = |measure: &dyn Fn(DVec2) -> f64| {
        let mut best = 0;
        for (i, &point) in flat.iter().enumerate() {
            if measure(point) > measure(flat[best]) {
                best = i;
            }
        }
        best
    };
    let b = best(&|point| point.distance_squared(flat[0]));
    let c = best(&|point| (flat[b] - flat[0]).perp_dot(point - flat[0]).abs());
    [0, b, c]
}

/// Mean value coordinates of a position; returns whether they are usable.
fn mean_values(flat: &[DVec2], at: DVec2, weights: &mut Vec<(usize, f64)>) -> bool {
    weights.clear();
    let mut sum = 0.0;
    let last = flat[flat.len() - 1] - at;
    let mut here = flat[0] - at;
    let (last_length, mut here_length) = (last.length(), here.length());
    let Some(mut last_tangent) = half_tangent(last, here, last_length * here_length) else {
        return on_edge(flat, flat.len() - 1, [last_length, here_length], weights);
    };
    for i in 0..flat.len() {
        let next = flat[(i + 1) % flat.len()] - at;
        let next_length = next.length();
        let Some(tangent) = half_tangent(here, next, here_length * next_length) else {
            return on_edge(flat, i, [here_length, next_length], weights);
        };
        let weight = (last_tangent + tangent) / here_length;
        weights.push((i, weight));
        sum += weight;
        (last_tangent, here, here_length) = (tangent, next, next_length);
    }
    let mut is_useful = true;
    for (_, weight) in weights {
        *weight /= sum;
        is_useful &= weight.abs() <= HEAVIEST;
    }
    is_useful
}

/// The tangent of half the angle from one direction to another, given the product of their lengths;
/// `None` if they point in opposite directions or one is zero.
fn half_tangent(a: DVec2, b: DVec2, lengths: f64) -> Option<f64> {
    let (cross, dot) = (a.perp_dot(b), a.dot(b));
    // The one of two forms that loses no digits.
    let tangent = if dot >= 0.0 { cross / (lengths + dot) } else { (lengths - dot) / cross };
    tangent.is_finite().then_some(tangent)
}

/// The weights of a position on an edge, at these distances from its ends.
fn on_edge(flat: &[DVec2], first: usize, [a, b]: [f64; 2], weights: &mut Vec<(usize, f64)>) -> bool {
    weights.clear();
    let sum = a + b;
    weights.extend([(first, b / sum), ((first + 1) % flat.len(), a / sum)]);
    sum > 0.0 && sum.is_finite()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;

    use super::*;

    fn frame_of(outline: &[Vec3]) -> FaceFrame {
        let mut mesh = EditMesh::new();
        let vertices: Vec<_> = outline.iter().map(|&at| mesh.add_vertex(at).expect("room")).collect();
        let face = mesh.add_face(&vertices).expect("a polygon");
        let mut frame = FaceFrame::default();
        frame.load(&mesh, face);
        frame
    }

    proptest! {
        /// Weights sum to 1 and reproduce the position, for any polygon.
        #[test]
        fn weights_are_exact_for_affine_functions(
            outline in prop::collection::vec((-8i8..8, -8i8..8), 3..40),
            position in (-8.0f64..8.0, -8.0f64..8.0),
            from in any::<prop::sample::Index>(),
        ) {
            let outline: Vec<Vec3> =
                outline.iter().map(|&(x, y)| Vec3::new(f32::from(x), f32::from(y), 1.0)).collect();
            let mut frame = frame_of(&outline);
            // Figures of eight have areas that cancel out; then nothing moves.
            prop_assume!(frame.normal != DVec3::ZERO);
            let position = DVec3::new(position.0, position.1, 1.0);
            let mut weights = Vec::new();
            frame.weights(from.index(outline.len()), position, &mut weights);
            let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
            let mixed = weights.iter().fold(DVec3::ZERO, |sum, &(i, weight)| sum + frame.positions[i] * weight);
            // Weights up to 64 of some dozen corners lose three of sixteen digits.
            prop_assert!((sum - 1.0).abs() < 1e-10, "sum {}", sum);
            prop_assert!(mixed.abs_diff_eq(position, 1e-9), "{} for {}", mixed, position);
        }
    }

    #[test]
    fn in_the_middle_of_a_square_all_corners_count_alike() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
        let mut frame = frame_of(&square);
        let mut weights = Vec::new();
        frame.weights(0, DVec3::new(0.5, 0.5, 0.0), &mut weights);
        assert!(weights.iter().all(|&(_, weight)| (weight - 0.25).abs() < 1e-15), "{weights:?}");
        frame.weights(0, DVec3::new(0.25, 0.0, 0.0), &mut weights);
        assert_eq!(weights, [(0, 0.75), (1, 0.25)], "on an edge its ends alone count");
        assert_eq!(frame.inward(0), DVec3::Y, "inwards from the lower edge");
    }
}
