//! An analytic sky: three colours.

use trigon_math::Vec3;

/// A sky of three colours that blend into each other: linear RGB, up to several
/// times the white of the display.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Overhead.
    pub zenith: Vec3,
    /// At the horizon.
    pub horizon: Vec3,
    /// Below.
    pub ground: Vec3,
}

impl Default for Sky {
    /// A clear day, as bright on a level white surface as ambient light of about one half.
    fn default() -> Self {
        Self {
            zenith: Vec3::new(0.28, 0.42, 0.78),
            horizon: Vec3::new(0.78, 0.82, 0.88),
            ground: Vec3::new(0.2, 0.19, 0.17),
        }
    }
}

impl Sky {
    /// The light from a unit vector, +Y up. Above the horizon, it approaches the
    /// zenith colour with the third power of the elevation; below, the ground colour with the
    /// eighth: haze is thick, and the ground begins abruptly.
    #[must_use]
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        let level = 1.0 - direction.y.abs();
        let level = if level > 0.0 { level } else { 0.0 };
        let square = level * level;
        if direction.y >= 0.0 {
            self.zenith.lerp(self.horizon, square * level)
        } else {
            self.ground.lerp(self.horizon, square * square * square * square)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_three_colours_are_where_they_belong() {
        let sky = Sky::default();
        assert_eq!(sky.radiance(Vec3::Y), sky.zenith, "overhead");
        assert_eq!(sky.radiance(Vec3::NEG_Y), sky.ground, "below");
        assert_eq!(sky.radiance(Vec3::X), sky.horizon, "and between them");
    }
}
