//! Four ways to store depth. All start from the same f32 distance, and compute in f32, as
//! a z-buffer does.

use super::{FAR, NEAR};

/// A depth format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DepthFormat {
    /// 0 to 1 from near to far, in 16 bits.
    Fixed16,
    /// The same in 24 bits.
    Fixed24,
    /// The same as a floating-point number.
    Float,
    /// 1 to 0 from near to far, as a floating-point number; these are dense near 0 (E. Lapidous and G. Jiao,
    /// "Optimal depth buffer for low-cost graphics hardware", 1999).
    FloatReversed,
}

impl DepthFormat {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Fixed16, Self::Fixed24, Self::Float, Self::FloatReversed];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed16 => "16 bit",
            Self::Fixed24 => "24 bit",
            Self::Float => "f32",
            Self::FloatReversed => "f32, reversed",
        }
    }

    /// The bytes per depth.
    #[must_use]
    pub fn bytes(self) -> usize {
        if self == Self::Fixed16 { 2 } else { 4 }
    }

    /// The stored value for a distance in metres, as 32 bits that compare in the same order.
    #[must_use]
    pub fn encode(self, distance: f32) -> u32 {
        self.store(if self == Self::FloatReversed { reversed(distance) } else { forward(distance) })
    }

    /// The stored value for a depth computed in `f32`.
    #[must_use]
    pub fn store(self, depth: f32) -> u32 {
        match self {
            Self::Fixed16 => fixed(depth, 16),
            Self::Fixed24 => fixed(depth, 24),
            Self::Float | Self::FloatReversed => depth.max(0.0).to_bits(),
        }
    }

    /// The depth for one over a distance, of which it is a linear function, so it is linear on the screen.
    pub fn depth_at(self, inverse_distance: f64) -> f64 {
        let [near, far] = [NEAR, FAR].map(f64::from);
        if self == Self::FloatReversed {
            near / (far - near) * (far * inverse_distance - 1.0)
        } else {
            far / (far - near) * (1.0 - near * inverse_distance)
        }
    }

    /// Whether the stored depth of one surface is in front of that of another.
    #[must_use]
    pub fn is_nearer(self, one: u32, other: u32) -> bool {
        if self == Self::FloatReversed { one > other } else { one < other }
    }
}

/// 0 to 1 as integers of this many bits, rounded to the nearest.
fn fixed(depth: f32, bits: u32) -> u32 {
    let largest = f64::from((1_u32 << bits) - 1);
    (f64::from(depth).clamp(0.0, 1.0) * largest + 0.5) as u32
}

/// 0 at the near plane, 1 at the far one.
fn forward(distance: f32) -> f32 {
    const SCALE: f32 = FAR / (FAR - NEAR);
    (distance * SCALE - NEAR * SCALE) / distance
}

/// 1 at the near plane, 0 at the far one.
fn reversed(distance: f32) -> f32 {
    const SCALE: f32 = NEAR / (FAR - NEAR);
    (FAR * SCALE - distance * SCALE) / distance
}
