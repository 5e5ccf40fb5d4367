//! The triangles that the rays of a lens meet, one by one, in f64.

#![expect(clippy::disallowed_methods, reason = "the platform's functions are the oracle here")]

use trigon_camera::FisheyeCamera;
use trigon_math::DVec3;

/// `θ (1 + k₁θ² + …) = r`, by bisection alone.
fn angle(radius: f64, [k1, k2, k3, k4]: [f64; 4], greatest: f64) -> Option<f64> {
    let d = |t: f64| t + k1 * t.powi(3) + k2 * t.powi(5) + k3 * t.powi(7) + k4 * t.powi(9);
    if radius > d(greatest) {
        return None;
    }
    let (mut low, mut high) = (0.0, greatest);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if d(middle) < radius { low = middle } else { high = middle }
    }
    Some(low)
}

/// The direction of a pixel's middle in the world, of a square image with its centre in the middle.
pub(crate) fn direction(camera: &FisheyeCamera, side: u32, focal: f64, [x, y]: [u32; 2]) -> Option<DVec3> {
    let half = f64::from(side) / 2.0;
    let [u, v] = [x, y].map(|at| (f64::from(at) + 0.5 - half) / focal);
    let angle = angle((u * u + v * v).sqrt(), camera.lens.distortion(), camera.lens.greatest_angle())?;
    let side = v.atan2(u);
    // Rows run down, the camera's Y up; it looks along −Z.
    let there = DVec3::new(angle.sin() * side.cos(), -angle.sin() * side.sin(), -angle.cos());
    Some(camera.orientation * there)
}

/// A hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    pub(crate) triangle: usize,
    pub(crate) distance: f64,
    /// How far from the edges: the least barycentric.
    pub(crate) margin: f64,
}

/// All hits, the nearest first (T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997).
pub(crate) fn hits(origin: DVec3, direction: DVec3, triangles: &[[DVec3; 3]]) -> Vec<Hit> {
    let hit = |(triangle, &[a, b, c]): (usize, &[DVec3; 3])| {
        let (e1, e2) = (b - a, c - a);
        let p = direction.cross(e2);
        let determinant = e1.dot(p);
        let s = origin - a;
        let u = s.dot(p) / determinant;
        let q = s.cross(e1);
        let v = direction.dot(q) / determinant;
        let distance = e2.dot(q) / determinant;
        let margin = u.min(v).min(1.0 - u - v);
        (margin > -1e-5 && distance > 0.0).then_some(Hit { triangle, distance, margin })
    };
    let mut hits: Vec<Hit> = triangles.iter().enumerate().filter_map(hit).collect();
    hits.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    hits
}
