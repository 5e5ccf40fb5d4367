//! How close may two surfaces be before a z-buffer confuses them? Depth formats for a perspective with a near
//! and a far plane.

use trigon_classic::Field;
use trigon_math::{SplitMix64, elementary};

/// The planes of the perspective, in metres.
pub const NEAR: f32 = 0.1;
/// As [`NEAR`].
pub const FAR: f32 = 10_000.0;

/// Of a thousand pairs of surfaces, how many get the wrong order or equal depths. One surface lies at a
/// random distance near `distance`, the other farther by the fraction `separation` of it.
#[must_use]
pub fn misordered_per_mille(format: DepthFormat, distance: f64, separation: f64) -> f64 {
    const PAIRS: usize = 10_000;
    let mut random = SplitMix64::new(7);
    let is_wrong = |_: &usize| {
        let near = distance * random.between(0.9, 1.1);
        let far = near * (1.0 + separation);
        !format.is_nearer(format.encode(near as f32), format.encode(far as f32))
    };
    let wrong = (0..PAIRS).filter(is_wrong).count();
    1e3 * wrong as f64 / PAIRS as f64
}

/// The smallest separation, as a fraction of the distance and a power of the square root of ten, at which no
/// pair of surfaces is confused; 1 if there is none below.
#[must_use]
pub fn resolved_separation(format: DepthFormat, distance: f64) -> f64 {
    let separations = (-16..=0).map(|power| elementary::pow(10.0, f64::from(power) / 2.0));
    let mut resolved = separations.filter(|&share| misordered_per_mille(format, distance, share) == 0.0);
    resolved.next().unwrap_or(1.0)
}

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

/// An image of the road.
pub struct Road {
    size: [usize; 2],
    /// The height of the eye above the road, and above the paint, in metres.
    heights: [f64; 2],
}

impl Road {
    /// Seen from a height of 1.7 metres, with paint this many metres above the road, in an image of `width`
    /// pixels and half that height.
    #[must_use]
    pub fn new(width: usize, paint: f64) -> Self {
        Self { size: [width, width / 2], heights: [1.7, 1.7 - paint] }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// One over the distance of a layer at the first pixel's centre, and its steps per column and per row.
    /// The eye is rolled a little, so that no two rows are alike.
    fn inverse_distance(&self, height: f64) -> [f64; 3] {
        const ROLL: f64 = 0.01;
        let scale = self.size[1] as f64 * height;
        [(0.5 + 0.5 * ROLL) / scale, ROLL / scale, 1.0 / scale]
    }

    /// Whether each pixel shows the paint, which is in front everywhere.
    #[must_use]
    pub fn draw(&self, format: DepthFormat) -> Field<bool> {
        let mut buffers = Buffers::new(self);
        buffers.draw(self, format);
        buffers.is_paint
    }

    /// Returns a closure that draws the image repeatedly.
    #[must_use]
    pub fn repeated(&self, format: DepthFormat) -> Box<dyn FnMut() + '_> {
        let mut buffers = Buffers::new(self);
        Box::new(move || buffers.draw(self, format))
    }

    /// Of a thousand pixels, how many show the road instead of the paint.
    #[must_use]
    pub fn wrong_per_mille(&self, format: DepthFormat) -> f64 {
        let drawn = self.draw(format);
        let wrong = drawn.values().iter().filter(|is_paint| !**is_paint).count();
        1e3 * wrong as f64 / drawn.values().len() as f64
    }
}

/// The stored depths, and the layer that each came from.
struct Buffers {
    depths: Field<u32>,
    is_paint: Field<bool>,
}

impl Buffers {
    fn new(road: &Road) -> Self {
        Self { depths: Field::new(road.size, 0), is_paint: Field::new(road.size, false) }
    }

    /// Each layer's depths are linear on the screen, and computed in `f32`.
    fn draw(&mut self, road: &Road, format: DepthFormat) {
        self.depths.clear(format.store(format.depth_at(0.0) as f32));
        self.is_paint.clear(false);
        for (height, is_paint) in road.heights.into_iter().zip([false, true]) {
            let [start, across, down] = road.inverse_distance(height);
            let offset = format.depth_at(0.0);
            let step = |step: f64| (format.depth_at(step) - offset) as f32;
            let (start, across, down) = (format.depth_at(start) as f32, step(across), step(down));
            let rows = self.depths.rows_mut().zip(self.is_paint.rows_mut());
            for (y, (depths, shown)) in rows.enumerate() {
                for (x, (depth, shown)) in depths.iter_mut().zip(shown).enumerate() {
                    let found = format.store(start + across * x as f32 + down * y as f32);
                    if format.is_nearer(found, *depth) {
                        (*depth, *shown) = (found, is_paint);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
