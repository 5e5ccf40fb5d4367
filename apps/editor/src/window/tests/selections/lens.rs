//! A perspective camera by its axes, and triangles as rays in f64 meet them.

use trigon_window::scene::camera::{Camera, Projection};
use trigon_window::scene::math::{DVec2, DVec3, elementary};

/// Whether something is so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Answer {
    No,
    /// It depends on roundings.
    Open,
    Yes,
}

impl Answer {
    /// Of a number: whether it is above 0, for sure where it is beyond a margin.
    pub(super) fn of(value: f64, margin: f64) -> Self {
        if value > margin {
            Self::Yes
        } else if value < -margin {
            Self::No
        } else {
            Self::Open
        }
    }

    pub(super) fn not(self) -> Self {
        [Self::Yes, Self::Open, Self::No][self as usize]
    }
}

/// A camera by its axes.
pub(super) struct Lens {
    eye: DVec3,
    axes: [DVec3; 3],
    pub(super) size: DVec2,
    /// Pixels to a metre, at a distance of one metre.
    scale: f64,
}

/// A point on the screen, and its distance along the line of sight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) at: DVec2,
    pub(super) distance: f64,
}

impl Lens {
    /// `None` for cameras without a perspective.
    pub(super) fn new(camera: &Camera, size: DVec2) -> Option<Self> {
        let Projection::Perspective { vertical_fov, .. } = camera.projection else { return None };
        let axes = [DVec3::X, DVec3::Y, DVec3::NEG_Z].map(|axis| camera.orientation.mul_vec3(axis));
        let scale = size.y / 2.0 / elementary::tan(vertical_fov / 2.0);
        Some(Self { eye: camera.position, axes, size, scale })
    }

    /// Across, upwards, and along the line of sight.
    pub(super) fn local(&self, world: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(world - self.eye)))
    }

    pub(super) fn seen(&self, local: DVec3) -> Seen {
        let share = self.scale / local.z;
        let at = DVec2::new(self.size.x / 2.0 + local.x * share, self.size.y / 2.0 - local.y * share);
        Seen { at, distance: local.z }
    }

    /// The ray through a point of the screen: one metre along the line of sight.
    fn ray(&self, at: DVec2) -> DVec3 {
        let from_middle = (at - self.size / 2.0) / self.scale;
        DVec3::new(from_middle.x, -from_middle.y, 1.0)
    }

    /// A thousandth of a pixel's width at this distance: what is nearer than that touches.
    pub(super) fn touching(&self, distance: f64) -> f64 {
        1e-3 / self.scale * distance
    }
}

/// A triangle before the eye.
pub(super) struct Triangle {
    /// Of which mesh, and which polygon of it.
    pub(super) face: (usize, u32),
    corners: [DVec3; 3],
    screen: [DVec2; 3],
    /// Whether it is drawn as seen from here.
    pub(super) is_drawn: bool,
}

impl Triangle {
    /// Its corners by [`Lens::local`], counter-clockwise in front.
    pub(super) fn new(lens: &Lens, face: (usize, u32), corners: [DVec3; 3], is_double_sided: bool) -> Self {
        let screen = corners.map(|corner| lens.seen(corner).at);
        let [a, b, c] = screen;
        // y points down, so fronts are clockwise in these coordinates.
        let is_drawn = is_double_sided || (b - a).perp_dot(c - a) < 0.0;
        Self { face, corners, screen, is_drawn }
    }

    /// The box around it on the screen.
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        let [a, b, c] = self.screen;
        [a.min(b).min(c), a.max(b).max(c)]
    }

    /// By how many pixels a point of the screen lies within; negative beside it.
    pub(super) fn depth_within(&self, at: DVec2) -> f64 {
        let [a, b, c] = self.screen;
        let turn = (b - a).perp_dot(c - a).signum();
        let side = |[from, to]: [DVec2; 2]| (to - from).normalize_or_zero().perp_dot(at - from) * turn;
        [[a, b], [b, c], [c, a]].map(side).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// How far along the line of sight the ray through a point meets its plane.
    pub(super) fn distance(&self, lens: &Lens, at: DVec2) -> f64 {
        let [a, b, c] = self.corners;
        let normal = (b - a).cross(c - a);
        normal.dot(a) / normal.dot(lens.ray(at))
    }
}
