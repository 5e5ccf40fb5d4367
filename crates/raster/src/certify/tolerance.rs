//! By how much positions, depths and colours may be off.

/// The most that a position may be off, in pixels: far less than the range of
/// the grid, so that sums with it cannot overflow.
const POSITION_MAX: f64 = 256.0;

/// By how much what an image is made from may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    position: f64,
    depth_ulps: u32,
    color: f32,
}

impl Tolerance {
    /// Bounds on positions in pixels of the target (0 to 256), on depths in units
    /// in the last place, and on linear colours in each component (0 or more);
    /// `None` for numbers out of range.
    #[must_use]
    pub fn new(position: f64, depth_ulps: u32, color: f32) -> Option<Self> {
        let valid = (0.0..=POSITION_MAX).contains(&position) && (0.0..=f32::MAX).contains(&color);
        valid.then_some(Self { position, depth_ulps, color })
    }

    /// By how much a vertex may be off on the screen on each axis, in pixels.
    #[must_use]
    pub fn position(&self) -> f64 {
        self.position
    }

    /// By how many units in the last place a vertex's depth may be off.
    #[must_use]
    pub fn depth_ulps(&self) -> u32 {
        self.depth_ulps
    }

    /// By how much each component of a pixel's linear colour may be off.
    #[must_use]
    pub fn color(&self) -> f32 {
        self.color
    }
}

impl Default for Tolerance {
    /// What other arithmetic may change: 1/512 pixel, as much as snapping does; 4
    /// units in the last place of depths; 2^-16 in colours.
    fn default() -> Self {
        Self { position: 1.0 / 512.0, depth_ulps: 4, color: 1.0 / 65536.0 }
    }
}
