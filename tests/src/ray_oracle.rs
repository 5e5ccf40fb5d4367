//! Triangles as rays from the eye meet them, in f64: no edge functions, no
//! snapping, no cutting.

use trigon_math::{DVec2, DVec3, DVec4, Vec4};

/// A triangle in clip space, seen on a square picture.
pub(crate) struct Facet {
    /// What a ray's direction is multiplied with for the share of each corner, in
    /// such units that the point met has w = 1.
    shares: [DVec3; 3],
    /// The depth of the point met, likewise.
    depth: DVec3,
    /// What the near plane leaves of the outline, in pixels.
    outline: Vec<DVec2>,
    side: f64,
}

impl Facet {
    /// A triangle on a picture of `side` by `side` pixels. Its corners have z > 0, so
    /// that nothing before the eye is lost to the near plane, z = w, but what lies
    /// nearer.
    pub(crate) fn new(corners: [Vec4; 3], side: i32) -> Self {
        let side = f64::from(side);
        let [a, b, c] = corners.map(|v| DVec3::new(v.x.into(), v.y.into(), v.w.into()));
        let volume = a.dot(b.cross(c));
        let shares = [b.cross(c), c.cross(a), a.cross(b)].map(|normal| normal / volume);
        let depth = (0..3).map(|i| shares[i] * f64::from(corners[i].z)).sum();
        Self { shares, depth, outline: outline(&corners, side), side }
    }

    /// The direction of the ray through a point in pixels.
    fn ray(&self, point: DVec2) -> DVec3 {
        let at = point / self.side * 2.0 - 1.0;
        DVec3::new(at.x, -at.y, 1.0)
    }

    /// The depth z/w where the ray through a point meets the triangle, between the
    /// eye's near plane and infinity.
    pub(crate) fn meets(&self, point: DVec2) -> Option<f64> {
        let ray = self.ray(point);
        let depth = self.depth.dot(ray);
        let inside = self.shares.iter().all(|share| share.dot(ray) >= 0.0);
        (inside && depth <= 1.0).then_some(depth)
    }

    /// How far a point is from the outline, in pixels.
    pub(crate) fn distance_to_outline(&self, point: DVec2) -> f64 {
        let ends = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        ends.map(|(&from, &to)| distance_to_segment(point, from, to)).fold(f64::INFINITY, f64::min)
    }

    /// By how much the depth changes along a pixel's width and height together.
    pub(crate) fn steepness(&self) -> f64 {
        (self.depth.x.abs() + self.depth.y.abs()) * 2.0 / self.side
    }
}

fn distance_to_segment(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let share = (point - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    point.distance(from + along * share.clamp(0.0, 1.0))
}

/// The corners and cuts behind the near plane, on the picture.
fn outline(corners: &[Vec4; 3], side: f64) -> Vec<DVec2> {
    let behind = |v: Vec4| f64::from(v.w) - f64::from(v.z);
    let mut outline = Vec::new();
    let mut push = |v: DVec4| {
        outline.push(DVec2::new(v.x / v.w + 1.0, 1.0 - v.y / v.w) * side / 2.0);
    };
    for (index, &corner) in corners.iter().enumerate() {
        let next = corners[(index + 1) % 3];
        let [from, to] = [behind(corner), behind(next)];
        if from >= 0.0 {
            push(corner.as_dvec4());
        }
        if (from < 0.0) != (to < 0.0) {
            let share = from / (from - to);
            push(corner.as_dvec4().lerp(next.as_dvec4(), share));
        }
    }
    outline
}
