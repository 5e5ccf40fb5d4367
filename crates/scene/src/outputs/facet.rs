//! Intersection of eye rays with a triangle, in f64.

use trigon_math::{DVec2, DVec3, Vec3};

/// A visible triangle, prepared for ray intersection.
///
/// A ray through the image has the direction (x, y, −1) in camera space. In a parallel projection
/// corners are first flattened to z = −1; then the same formulas find the intersection with a
/// parallel ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    /// In camera space.
    corners: [DVec3; 3],
    /// As rays meet them.
    projected: [DVec3; 3],
    /// A ray's product with these is the volume that it spans with the opposite edge: the
    /// barycentrics up to a common factor.
    shares: [DVec3; 3],
}

/// How the rays of an image run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Beam {
    /// From the eye.
    Central,
    /// Along the line of sight.
    Parallel,
}

impl Facet {
    /// A triangle in camera space.
    pub(crate) fn new(corners: [DVec3; 3], beam: Beam) -> Self {
        let projected = match beam {
            Beam::Central => corners,
            Beam::Parallel => corners.map(|corner| corner.truncate().extend(-1.0)),
        };
        let [a, b, c] = projected;
        Self { corners, projected, shares: [b.cross(c), c.cross(a), a.cross(b)] }
    }

    /// Whether the triangle winds clockwise on the screen.
    pub(crate) fn is_clockwise(&self) -> bool {
        self.projected[0].dot(self.shares[0]) > 0.0
    }

    /// The barycentrics of the point that a ray hits; for a ray that misses, of the nearest point
    /// of the outline. At least 0, with sum 1.
    pub(crate) fn weights(&self, ray: DVec3) -> DVec3 {
        let volumes = self.volumes(ray);
        let weights = volumes / (volumes.x + volumes.y + volumes.z);
        // NaN is not inside, nor is a point behind the eye: its signs are flipped.
        let before = (volumes.x + volumes.y + volumes.z > 0.0) == self.is_clockwise();
        if before && weights.cmpge(DVec3::ZERO).all() { weights } else { self.nearest(ray) }
    }

    /// The change of the barycentrics per pixel, whose ray differs by `step`, at the point where
    /// they are `weights`. All 0 if they overflow.
    pub(crate) fn slope(&self, ray: DVec3, weights: DVec3, step: DVec3) -> DVec3 {
        let (volumes, change) = (self.volumes(ray), self.volumes(step));
        let slope =
            (change - weights * (change.x + change.y + change.z)) / (volumes.x + volumes.y + volumes.z);
        if slope.is_finite() { slope } else { DVec3::ZERO }
    }

    /// The point with these barycentrics, in camera space.
    pub(super) fn at(&self, weights: DVec3) -> DVec3 {
        let [a, b, c] = self.corners;
        a * weights.x + b * weights.y + c * weights.z
    }

    /// The normal of the triangle in camera space, on the side from which it winds
    /// counter-clockwise. 0 without area.
    pub(super) fn normal(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a).normalize_or_zero()
    }

    fn volumes(&self, ray: DVec3) -> DVec3 {
        DVec3::from_array(self.shares.map(|share| share.dot(ray)))
    }

    /// The point of the outline that is nearest to a ray.
    fn nearest(&self, ray: DVec3) -> DVec3 {
        let ray = ray.normalize();
        let mut nearest = (f64::INFINITY, DVec3::X);
        for corner in 0..3 {
            let next = (corner + 1) % 3;
            let (from, to) = (self.projected[corner], self.projected[next]);
            let [start, along] = [from, to - from].map(|vector| vector - ray * vector.dot(ray));
            let share = -start.dot(along) / along.length_squared();
            let share = if share > 0.0 { if share < 1.0 { share } else { 1.0 } } else { 0.0 };
            let point = from + (to - from) * share;
            let distance = (start + along * share).length() / point.dot(ray);
            if distance >= 0.0 && distance < nearest.0 {
                let mut weights = DVec3::ZERO;
                weights[corner] = 1.0 - share;
                weights[next] += share;
                nearest = (distance, weights);
            }
        }
        nearest.1
    }
}

/// Interpolates a value of each corner.
pub(super) fn mixed(weights: DVec3, values: [f32; 3]) -> f64 {
    weights.dot(DVec3::from_array(values.map(f64::from)))
}

/// Two columns, mixed at three corners.
pub(super) fn mixed2(weights: DVec3, columns: &[Vec<f32>; 2], corners: [usize; 3]) -> DVec2 {
    let [x, y] = columns.each_ref().map(|column| mixed(weights, corners.map(|corner| column[corner])));
    DVec2::new(x, y)
}

/// The three entries of a vertex.
pub(super) fn vertex(columns: &[Vec<f32>], at: usize) -> Vec3 {
    Vec3::new(columns[0][at], columns[1][at], columns[2][at])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facet(beam: Beam) -> Facet {
        let corners = [DVec3::new(-1.0, -1.0, -2.0), DVec3::new(1.0, -1.0, -2.0), DVec3::new(0.0, 1.0, -6.0)];
        Facet::new(corners, beam)
    }

    #[test]
    fn rays_meet_what_they_aim_at() {
        for beam in [Beam::Central, Beam::Parallel] {
            let facet = facet(beam);
            for weights in [DVec3::new(0.2, 0.5, 0.3), DVec3::new(0.1, 0.1, 0.8), DVec3::splat(1.0 / 3.0)] {
                let aim = facet.at(weights);
                let ray = match beam {
                    Beam::Central => aim / -aim.z,
                    Beam::Parallel => aim.truncate().extend(-1.0),
                };
                let error = (facet.weights(ray) - weights).abs().max_element();
                assert!(error < 1e-15, "{beam:?} {weights}: off by {error}");
            }
        }
    }

    #[test]
    fn slopes_are_what_a_small_step_changes() {
        for beam in [Beam::Central, Beam::Parallel] {
            let (facet, ray) = (facet(beam), DVec3::new(0.05, -0.1, -1.0));
            let weights = facet.weights(ray);
            for step in [DVec3::X, DVec3::Y] {
                let small = 1e-6;
                let change = (facet.weights(ray + step * small) - weights) / small;
                let slope = facet.slope(ray, weights, step);
                assert!((slope - change).abs().max_element() < 1e-4, "{beam:?}: {slope} and {change}");
            }
        }
    }

    #[test]
    fn a_ray_that_passes_by_takes_the_nearest_point() {
        let facet = facet(Beam::Parallel);
        let below = facet.weights(DVec3::new(0.5, -1.001, -1.0));
        // As the eye at the origin sees it, not straight up.
        assert!(
            (below - DVec3::new(0.25, 0.75, 0.0)).abs().max_element() < 1e-3,
            "on the lower edge: {below}"
        );
        let beside = facet.weights(DVec3::new(3.0, -3.0, -1.0));
        assert_eq!(beside, DVec3::Y, "the corner");
        // Seen along its plane a triangle is a line.
        let corners = [DVec3::new(0.0, -1.0, -2.0), DVec3::new(0.0, 1.0, -2.0), DVec3::new(0.0, 0.0, -3.0)];
        let line = Facet::new(corners, Beam::Central).weights(DVec3::new(1e-3, 0.25, -1.0));
        assert!(
            line.is_finite() && (line.x + line.y + line.z - 1.0).abs() < 1e-15,
            "weights all the same: {line}"
        );
        let point = Facet::new([DVec3::NEG_Z; 3], Beam::Central).weights(DVec3::NEG_Z);
        assert_eq!(point, DVec3::X, "a point is its corner");
    }
}
