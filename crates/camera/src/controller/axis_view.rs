//! The named views along the axes.

use trigon_math::elementary;

/// A view by name. "Front" is what the camera sees that stands before the model.
///
/// With +Y up, front looks along −Z, right along −X and top along −Y with −Z
/// towards the upper edge. With +Z up, front looks along +Y, as in CAD. Any
/// other up axis turns these the shortest way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AxisView {
    /// Before the model.
    Front,
    /// Behind the model.
    Back,
    /// On its right side.
    Right,
    /// On its left side.
    Left,
    /// Above it.
    Top,
    /// Below it.
    Bottom,
    /// Before it, to the right and above, all three by the same angle.
    Isometric,
}

impl AxisView {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Front, Self::Back, Self::Right, Self::Left, Self::Top, Self::Bottom, Self::Isometric];

    /// The view from the other side. Isometric is seen from below and behind
    /// only through [`crate::Orbit`]'s own turning: it is its own opposite here.
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
