//! A ray against four triangles, without leaks.

use glam::Vec3;

use super::Ray;
use super::wide::{Four, WIDTH};

/// Where a ray meets four triangles.
pub(super) struct MetFour {
    /// No number where it misses one, runs along it, or meets it too far away for a
    /// number.
    pub(super) distances: Four,
    /// Of the three corners; meaningless where there is no distance.
    pub(super) weights: [Four; 3],
}

/// A ray made ready for many triangles: sheared so that it runs along one axis.
pub(super) struct ShearedRay {
    origin: Vec3,
    /// The axes, that along which it runs fastest last.
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
        let shear = [ray.direction[x] / fastest, ray.direction[y] / fastest, 1.0 / fastest];
        Self { origin: ray.origin, axes: [x, y, z], shear }
    }

    /// Where the ray meets four triangles.
    #[inline(always)]
    pub(super) fn meet(&self, corners: &[[Four; 3]; 3]) -> MetFour {
        let [a, b, c] = [0, 1, 2].map(|corner| self.sheared(&corners[corner]));
        let mut edges = [crossed(&c, &b), crossed(&a, &c), crossed(&b, &a)];
        if edges.as_flattened().contains(&0.0) {
            self.decide_exactly([&a, &b, &c], &mut edges);
        }
        let (mut distances, mut weights) = ([0.0; WIDTH], [[0.0; WIDTH]; 3]);
        for i in 0..WIDTH {
            let [u, v, w] = edges.map(|edge| edge[i]);
            let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
            let sum = u + v + w;
            let along = u * a[2][i] + v * b[2][i] + w * c[2][i];
            let inverse = 1.0 / sum;
            let distance = along * self.shear[2] * inverse;
            distances[i] = if inside && sum != 0.0 && distance.is_finite() { distance } else { f32::NAN };
            weights[0][i] = u * inverse;
            weights[1][i] = v * inverse;
            weights[2][i] = w * inverse;
        }
        MetFour { distances, weights }
    }

    /// Exact products decide what lies on an edge.
    #[cold]
    fn decide_exactly(&self, [a, b, c]: [&[Four; 3]; 3], edges: &mut [Four; 3]) {
        let exact = |p: &[Four; 3], q: &[Four; 3], i: usize| {
            let [px, py, qx, qy] = [p[0][i], p[1][i], q[0][i], q[1][i]].map(f64::from);
            (px * qy - py * qx) as f32
        };
        for i in 0..WIDTH {
            if edges.iter().any(|edge| edge[i] == 0.0) {
                edges[0][i] = exact(c, b, i);
                edges[1][i] = exact(a, c, i);
                edges[2][i] = exact(b, a, i);
            }
        }
    }

    #[inline(always)]
    fn sheared(&self, corner: &[Four; 3]) -> [Four; 3] {
        let [x, y, z] = self.axes.map(|axis| {
            let origin = self.origin[axis];
            corner[axis].map(|place| place - origin)
        });
        let [across, down, _] = self.shear;
        let x = std::array::from_fn(|i| x[i] - across * z[i]);
        let y = std::array::from_fn(|i| y[i] - down * z[i]);
        [x, y, z]
    }
}

#[inline(always)]
fn crossed(p: &[Four; 3], q: &[Four; 3]) -> Four {
    std::array::from_fn(|i| p[0][i] * q[1][i] - p[1][i] * q[0][i])
}
