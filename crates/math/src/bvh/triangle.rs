//! Watertight intersection of a ray with four triangles.

use glam::Vec3;

use super::Ray;
use super::wide::{Four, WIDTH};

/// The hits of a ray on four triangles.
pub(super) struct MetFour {
    /// NaN if it misses one, runs parallel to it, or the distance overflows.
    pub(super) distances: Four,
    /// Of the three corners; meaningless without a distance.
    pub(super) weights: [Four; 3],
}

/// A ray prepared for many triangles: sheared so that it runs along one axis.
pub(super) struct ShearedRay {
    origin: Vec3,
    /// The axes; the last is the one along which the ray runs fastest.
    axes: [usize; 3],
    shear: [f32; 3],
}

impl ShearedRay {
    pub(super) fn new(ray: &Ray) -> Self {
        let along = ray.direction.abs();
        let z = if along.x > along.y && along.x > along.z {
            0
        } else if along.y > along.z {
            1
        } else {
            2
        };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if ray.direction[z] < 0.0 {
            (x, y) = (y, x);
        }
        let fastest = ray.direction[z];
        // A shear that is not a normal number has no precision: the ray runs straight on that axis.
        let shear = [x, y].map(|axis| ray.direction[axis] / fastest);
        let [across, down] = shear.map(|shear| if shear.is_normal() { shear } else { 0.0 });
        let shear = [across, down, 1.0 / fastest];
        Self { origin: ray.origin, axes: [x, y, z], shear }
    }

    /// The axis along which the ray runs fastest.
    pub(super) fn axis(&self) -> usize {
        self.axes[2]
    }

    /// The direction of a ray with zeros on the axes on which it is taken to run straight.
    pub(super) fn straightened(&self, mut direction: Vec3) -> Vec3 {
        for (shear, axis) in self.shear.into_iter().zip(self.axes).take(2) {
            if shear == 0.0 {
                direction[axis] = 0.0;
            }
        }
        direction
    }

    /// The distance along the ray to a coordinate on that axis.
    pub(super) fn distance_along(&self, coordinate: f32) -> f32 {
        (coordinate - self.origin[self.axes[2]]) * self.shear[2]
    }

    /// The hits of the ray on four triangles.
    #[inline(always)]
    pub(super) fn meet(&self, corners: &[[Four; 3]; 3]) -> MetFour {
        let corners = [0, 1, 2].map(|corner| self.sheared(&corners[corner]));
        let [a, b, c] = &corners;
        let edges = [crossed(c, b), crossed(a, c), crossed(b, a)];
        let mut met = MetFour { distances: [f32::NAN; WIDTH], weights: [[0.0; WIDTH]; 3] };
        for i in 0..WIDTH {
            let [u, v, w] = edges.map(|edge| edge[i]);
            // Where a sign is uncertain, both count.
            if (u.high >= 0.0 && v.high >= 0.0 && w.high >= 0.0)
                || (u.low <= 0.0 && v.low <= 0.0 && w.low <= 0.0)
            {
                self.meet_exactly(corners.map(|corner| corner.map(|axis| axis[i])), i, &mut met);
            }
        }
        met
    }

    /// The hit of the ray on one triangle, if any. Products of two f32 are exact in f64, so the
    /// signs of their differences are right, and barycentrics are within one f32 rounding even if
    /// the triangle is seen from its edge.
    #[cold]
    fn meet_exactly(&self, [a, b, c]: [[f32; 3]; 3], slot: usize, met: &mut MetFour) {
        let exact =
            |p: [f32; 3], q: [f32; 3]| f64::from(p[0]) * f64::from(q[1]) - f64::from(p[1]) * f64::from(q[0]);
        let [u, v, w] = [exact(c, b), exact(a, c), exact(b, a)];
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let sum = u + v + w;
        if !inside || sum == 0.0 {
            return;
        }
        let along = u * f64::from(a[2]) + v * f64::from(b[2]) + w * f64::from(c[2]);
        let distance = (along / sum * f64::from(self.shear[2])) as f32;
        if distance.is_finite() {
            met.distances[slot] = distance;
            for (weights, edge) in met.weights.iter_mut().zip([u, v, w]) {
                weights[slot] = (edge / sum) as f32;
            }
        }
    }

    #[inline(always)]
    fn sheared(&self, corner: &[Four; 3]) -> [Four; 3] {
        let [x, y, z] = self.axes.map(|axis| {
            let origin = self.origin[axis];
            corner[axis].map(|coordinate| coordinate - origin)
        });
        let [across, down, _] = self.shear;
        let x = std::array::from_fn(|i| x[i] - across * z[i]);
        let y = std::array::from_fn(|i| y[i] - down * z[i]);
        [x, y, z]
    }
}

/// An edge function, as an interval.
#[derive(Clone, Copy)]
struct Edge {
    low: f32,
    high: f32,
}

/// The edge function of two corners. Two products and their difference are each rounded once: the
/// error is less than 2u of one product and u of the other, and where the sign is uncertain the two
/// are nearly equal.
#[inline(always)]
fn crossed(p: &[Four; 3], q: &[Four; 3]) -> [Edge; WIDTH] {
    std::array::from_fn(|i| {
        let (first, second) = (p[0][i] * q[1][i], p[1][i] * q[0][i]);
        let (edge, doubt) = (first - second, first.abs() * (2.0 * f32::EPSILON) + f32::MIN_POSITIVE);
        Edge { low: edge - doubt, high: edge + doubt }
    })
}
