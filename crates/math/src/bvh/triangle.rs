//! A ray against a triangle, without leaks.

use glam::Vec3;

use super::Ray;

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

    /// The distance and the weights of the corners; `None` where it misses, or runs
    /// along the triangle.
    pub(super) fn meets(&self, corners: &[Vec3; 3]) -> Option<(f32, [f32; 3])> {
        let [a, b, c] = corners.map(|corner| self.sheared(corner));
        let cross = |p: [f32; 3], q: [f32; 3]| p[0] * q[1] - p[1] * q[0];
        let mut edges = [cross(c, b), cross(a, c), cross(b, a)];
        if edges.contains(&0.0) {
            // Exact products decide what lies on an edge.
            let exact = |p: [f32; 3], q: [f32; 3]| {
                (f64::from(p[0]) * f64::from(q[1]) - f64::from(p[1]) * f64::from(q[0])) as f32
            };
            edges = [exact(c, b), exact(a, c), exact(b, a)];
        }
        let negative = edges.iter().any(|&edge| edge < 0.0);
        let positive = edges.iter().any(|&edge| edge > 0.0);
        let sum = edges[0] + edges[1] + edges[2];
        if negative == positive || sum == 0.0 {
            return None;
        }
        let along = edges[0] * a[2] + edges[1] * b[2] + edges[2] * c[2];
        let inverse = 1.0 / sum;
        let distance = along * self.shear[2] * inverse;
        distance.is_finite().then(|| (distance, edges.map(|edge| edge * inverse)))
    }

    fn sheared(&self, corner: Vec3) -> [f32; 3] {
        let offset = corner - self.origin;
        let [x, y, z] = self.axes.map(|axis| offset[axis]);
        [x - self.shear[0] * z, y - self.shear[1] * z, z]
    }
}
