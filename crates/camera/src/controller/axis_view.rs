//! The named views along the axes.

use trigon_math::elementary;

/// A named view. "Front" is what a camera in front of the model sees.
///
/// With +Y up, front looks along −Z, right along −X and top along −Y with −Z towards the upper
/// edge. With +Z up, front looks along +Y, as in CAD. For any other up axis these are rotated by
/// the shortest arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AxisView {
    /// From the front.
    Front,
    /// From behind.
    Back,
    /// From its right side.
    Right,
    /// From its left side.
    Left,
    /// Above it.
    Top,
    /// Below it.
    Bottom,
    /// From the front, right and above, all three by the same angle.
    Isometric,
}

impl AxisView {
    /// All views.
    pub const ALL: [Self; 7] =
        [Self::Front, Self::Back, Self::Right, Self::Left, Self::Top, Self::Bottom, Self::Isometric];

    /// The view from the opposite side. Isometric is its own opposite; only [`crate::Orbit`]'s
    /// rotations reach its view from below and behind.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Front => Self::Back,
            Self::Back => Self::Front,
            Self::Right => Self::Left,
            Self::Left => Self::Right,
            Self::Top => Self::Bottom,
            Self::Bottom => Self::Top,
            Self::Isometric => Self::Isometric,
        }
    }

    /// Azimuth (from the front to the right) and elevation, in radians.
    pub(crate) fn azimuth_and_elevation(self) -> (f64, f64) {
        const QUARTER: f64 = std::f64::consts::FRAC_PI_2;
        match self {
            Self::Front => (0.0, 0.0),
            Self::Back => (2.0 * QUARTER, 0.0),
            Self::Right => (QUARTER, 0.0),
            Self::Left => (-QUARTER, 0.0),
            Self::Top => (0.0, QUARTER),
            Self::Bottom => (0.0, -QUARTER),
            // Elevation of (1, 1, 1): opposite 1, adjacent √2.
            Self::Isometric => (0.5 * QUARTER, elementary::atan2(1.0, std::f64::consts::SQRT_2)),
        }
    }
}
