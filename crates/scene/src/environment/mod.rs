//! Environment light: from a sky, or from an image of all directions.
//!
//! Two forms are computed once and stored. One is the diffuse irradiance for each orientation, as nine
//! coefficients (R. Ramamoorthi and P. Hanrahan, "An Efficient Representation for Irradiance Environment Maps",
//! 2001). The other is the reflections at five roughnesses (B. Karis, "Real Shading in Unreal Engine 4", 2013).
//!
//! [`Sky`] is an analytic sky of three colours.

mod octahedral;
mod prefilter;

use std::sync::Arc;

use octahedral::Octahedral;
use thiserror::Error;
use trigon_math::{Mat3, Vec3, elementary};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, lanes_of};

use self::prefilter::Harmonics;
use crate::lanes::{V3, turned};
use crate::work::{Work, note};

/// The smallest side of the sharpest map in texels. (The horizon is four sides long.)
const LEAST: usize = 256;
/// The largest one: as sharp as an image of 8192 × 4096 pixels, in 50 MB.
const MOST: usize = 2048;

/// Ambient light from an environment. Radiance is in the unit of
/// [`Light::intensity`](crate::Light): 1 all around shows a white surface as 1.
///
/// Its directions are those of a world in which +Y is up and +Z is the front; in other worlds it is turned
/// ([`Scene::up`](crate::Scene::up)).
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// What it was made from, unless it was an image.
    sky: Option<Sky>,
    matt: Harmonics,
    /// From the sharpest map on, each half as wide as the previous one.
    halved: Vec<Octahedral>,
    /// What rough surfaces mirror, in equal steps of roughness; a mirror shows the
    /// sharpest map.
    blurred: Vec<Octahedral>,
}

/// Why an image is not a valid environment.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// A side is 0 (or too long for a map), or there are not `width * height` pixels.
    #[error(
        "{given} pixels do not make an image of {width}x{height}: each side must be at least 1, and that of a map at most {MOST}"
    )]
    Size {
        /// Pixels from left to right.
        width: usize,
        /// Pixels from top to bottom.
        height: usize,
        /// The number of pixels given.
        given: usize,
    },
}

impl Environment {
    /// From an image of all directions, as `.hdr` files hold it: row-major from the top, linear RGB. The
    /// middle looks along −Z, the right half to +X, and the upper edge is +Y. Values that are negative or not
    /// finite count as 0.
    ///
    /// # Errors
    /// There are not `width * height` pixels, or none.
    pub fn from_equirectangular(
        width: usize,
        height: usize,
        pixels: &[[f32; 3]],
    ) -> Result<Self, EnvironmentError> {
        if width == 0 || height == 0 || width.checked_mul(height) != Some(pixels.len()) {
            return Err(EnvironmentError::Size { width, height, given: pixels.len() });
        }
        // The horizon of the map is as long as the image is wide.
        let side = (width / 4).clamp(LEAST, MOST).next_power_of_two();
        Ok(Self::from_sharp(Octahedral::from_equirectangular(side, width, height, pixels)))
    }

    /// From a sky.
    #[must_use]
    pub fn from_sky(sky: &Sky) -> Self {
        let map = Octahedral::from_function(LEAST, |direction| sky.radiance(direction));
        Self { sky: Some(*sky), ..Self::from_sharp(map) }
    }

    /// The sky that it was made from, if any.
    #[must_use]
    pub fn sky(&self) -> Option<&Sky> {
        self.sky.as_ref()
    }

    /// The same linear RGB from all directions.
    #[must_use]
    pub fn uniform(radiance: Vec3) -> Self {
        Self::from_sharp(Octahedral::from_function(32, |_| radiance))
    }

    /// From what [`Self::texels`] gives: a square of `side` by `side` directions, the
    /// octahedron of unit absolute sums folded open, +Y in the middle. Values that
    /// are negative or not finite count as 0.
    ///
    /// # Errors
    /// There are not `side * side` texels, or none, or more than 2048 on a side.
    pub fn from_texels(side: usize, texels: &[[f32; 3]]) -> Result<Self, EnvironmentError> {
        if side == 0 || side > MOST || side * side != texels.len() {
            return Err(EnvironmentError::Size { width: side, height: side, given: texels.len() });
        }
        let texels: Vec<Vec3> = texels.iter().map(|&texel| octahedral::clean(texel)).collect();
        Ok(Self::from_sharp(Octahedral::from_texels(side, &texels)))
    }

    /// The side and the texels (linear RGB) of the map that everything else is made
    /// from, see [`Self::from_texels`].
    #[must_use]
    pub fn texels(&self) -> (usize, Vec<[f32; 3]>) {
        let sharp = &self.halved[0];
        (sharp.size(), sharp.iter().map(|(_, _, light)| light.to_array()).collect())
    }

    fn from_sharp(sharp: Octahedral) -> Self {
        let halved = prefilter::halved(sharp);
        // Finer ones would not change matt surfaces.
        let matt = Harmonics::of(halved.iter().find(|map| map.size() <= LEAST).unwrap_or(&halved[0]));
        let blurred = prefilter::blurred(&halved);
        Self { sky: None, matt, halved, blurred }
    }

    /// The light that a surface of a roughness from 0 to 1 mirrors from a direction (of any length
    /// but 0).
    #[must_use]
    pub fn radiance(&self, direction: Vec3, roughness: f32) -> Vec3 {
        let last = self.blurred.len();
        let exact_level = if roughness > 0.0 { roughness * last as f32 } else { 0.0 };
        let exact_level = if exact_level < last as f32 { exact_level } else { last as f32 };
        let (level, share) = (exact_level as usize, exact_level - (exact_level as usize) as f32);
        let shown = |level: usize| match level.checked_sub(1) {
            None => self.halved[0].at(direction),
            Some(level) => self.blurred[level].at(direction),
        };
        if share == 0.0 { shown(level) } else { shown(level).lerp(shown(level + 1), share) }
    }

    /// The light from a direction (of any length but 0), filtered to a pixel's width in radians, so
    /// that pixels do not miss what lies between them.
    pub(crate) fn filtered_radiance(&self, direction: Vec3, width: f32) -> Vec3 {
        note(Work::EnvironmentLight);
        if let Some(sky) = &self.sky {
            return sky.radiance(direction.normalize_or_zero());
        }
        // On average, since each texel covers its part of the whole sphere.
        let texel = (4.0 * std::f32::consts::PI).sqrt() / self.halved[0].size() as f32;
        let last = self.halved.len() - 1;
        let wider = width / texel;
        let exact_level = if wider > 1.0 { elementary::log2_f32(wider) } else { 0.0 };
        let exact_level = if exact_level < last as f32 { exact_level } else { last as f32 };
        let (level, share) = (exact_level as usize, exact_level - (exact_level as usize) as f32);
        let shown = self.halved[level].at(direction);
        if share == 0.0 { shown } else { shown.lerp(self.halved[level + 1].at(direction), share) }
    }

    /// What a white matt surface shows whose normal is a unit vector.
    #[must_use]
    pub fn irradiance(&self, normal: Vec3) -> Vec3 {
        self.matt.at(normal)
    }

    /// Its memory in bytes.
    pub fn byte_count(&self) -> usize {
        let maps = self.halved.iter().chain(&self.blurred);
        maps.map(Octahedral::byte_count).sum::<usize>() + size_of::<Harmonics>()
    }
}

/// An environment as a frame uses it.
#[derive(Clone, Debug)]
pub(crate) struct Surroundings {
    pub(crate) environment: Arc<Environment>,
    /// From camera space to that of the environment.
    pub(crate) from_camera: Mat3,
    /// Factor on all of its light.
    pub(crate) intensity: f32,
}

impl Surroundings {
    /// What white matt surfaces show, for unit normals in camera space.
    #[inline(always)]
    pub(crate) fn matt<S: Simd>(&self, simd: S, normal: V3<S>) -> V3<S> {
        note(Work::EnvironmentLight);
        let [r, g, b] = self.environment.matt.at_lanes(simd, turned(&self.from_camera, normal));
        [r * self.intensity, g * self.intensity, b * self.intensity]
    }

    /// What surfaces mirror, for directions in camera space.
    pub(crate) fn mirrored<S: Simd>(&self, simd: S, direction: V3<S>, roughness: F32<S>) -> V3<S> {
        note(Work::EnvironmentLight);
        let [x, y, z] = simd.vectorize(
            #[inline(always)]
            || {
                let axes: [[f32; LANES]; 3] = turned(&self.from_camera, direction).each(
                    #[inline(always)]
                    |axis| axis.into(),
                );
                axes
            },
        );
        let roughness: [f32; LANES] = roughness.into();
        let found = lanes_of(|lane| {
            let direction = Vec3::new(x[lane], y[lane], z[lane]);
            self.environment.radiance(direction, roughness[lane]) * self.intensity
        });
        [0, 1, 2].map(|channel| F32::simd_from(simd, found.map(|light| light[channel])))
    }
}

/// The unit vector of a position in an image of all directions, u and v from 0 to 1.
fn equirectangular(u: f32, v: f32) -> Vec3 {
    let (around, down) = ((u - 0.5) * std::f32::consts::TAU, v * std::f32::consts::PI);
    let flat = elementary::sin_f32(down);
    Vec3::new(
        flat * elementary::sin_f32(around),
        elementary::cos_f32(down),
        -flat * elementary::cos_f32(around),
    )
}

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
    fn the_same_light_from_everywhere_is_the_same_on_every_surface() {
        let environment = Environment::uniform(Vec3::new(0.25, 0.5, 1.0));
        for direction in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.3, -0.5, 0.8).normalize()] {
            for light in [environment.irradiance(direction), environment.radiance(direction, 0.4)] {
                let error = (light - Vec3::new(0.25, 0.5, 1.0)).abs().max_element();
                assert!(error < 2e-3, "{light} from {direction}");
            }
        }
    }

    /// A bright upper half shows a surface that is tilted by θ as (1 + cos θ) / 2.
    #[test]
    fn a_bright_half_lights_surfaces_by_their_view_of_it() {
        let (width, height) = (128, 64);
        let pixels: Vec<[f32; 3]> =
            (0..width * height).map(|i| if i < width * height / 2 { [1.0; 3] } else { [0.0; 3] }).collect();
        let environment = Environment::from_equirectangular(width, height, &pixels).expect("the size fits");
        for tilt in [0.0_f32, 0.5, 1.0, 1.57, 2.5, 3.1] {
            let normal = Vec3::new(elementary::sin_f32(tilt), elementary::cos_f32(tilt), 0.0);
            let (shown, exact) = (environment.irradiance(normal).x, (1.0 + normal.y) / 2.0);
            // Nine coefficients are within 3 % of the brightest (Ramamoorthi 2001).
            assert!((shown - exact).abs() < 0.03, "{shown} at {tilt}, not {exact}");
        }
        let up = environment.radiance(Vec3::Y, 0.0).x;
        assert!((up - 1.0).abs() < 1e-3, "the sky overhead is bright: {up}");
        assert!(environment.radiance(Vec3::NEG_Y, 0.25).x < 1e-3, "the ground is dark");
        let grazing = environment.radiance(Vec3::X, 1.0).x;
        assert!((grazing - 0.5).abs() < 0.05, "a rough mirror on the horizon sees half of each: {grazing}");
    }

    #[test]
    fn the_middle_of_the_image_looks_along_minus_z() {
        let (width, height) = (64, 32);
        let mut pixels = vec![[0.0; 3]; width * height];
        for y in 12..20 {
            for x in 28..36 {
                pixels[y * width + x] = [1.0; 3];
            }
        }
        let environment = Environment::from_equirectangular(width, height, &pixels).expect("it fits");
        assert!(environment.radiance(Vec3::NEG_Z, 0.0).x > 0.99, "bright ahead");
        for dark in [Vec3::X, Vec3::Z, Vec3::Y, Vec3::NEG_X] {
            assert!(environment.radiance(dark, 0.0).x < 0.01, "dark towards {dark}");
        }
    }

    #[test]
    fn an_environment_is_made_again_from_its_texels() {
        let image: Vec<[f32; 3]> = (0..64_u8).map(|i| [f32::from(i), 0.5, 0.0]).collect();
        let image = Environment::from_equirectangular(16, 4, &image).expect("the size fits");
        for environment in [Environment::uniform(Vec3::new(0.1, 0.2, 3.0)), image] {
            let (side, texels) = environment.texels();
            assert_eq!(Environment::from_texels(side, &texels), Ok(environment), "every bit, at {side}");
        }
        assert!(Environment::from_texels(0, &[]).is_err(), "no direction at all");
        assert!(Environment::from_texels(2, &[[1.0; 3]; 3]).is_err(), "too few");
    }

    #[test]
    fn an_image_without_pixels_is_refused() {
        let error = Environment::from_equirectangular(2, 2, &[[0.0; 3]]).expect_err("too few");
        assert_eq!(error, EnvironmentError::Size { width: 2, height: 2, given: 1 }, "says what is there");
    }

    #[test]
    fn the_three_colours_are_where_they_belong() {
        let sky = Sky::default();
        assert_eq!(sky.radiance(Vec3::Y), sky.zenith, "overhead");
        assert_eq!(sky.radiance(Vec3::NEG_Y), sky.ground, "below");
        assert_eq!(sky.radiance(Vec3::X), sky.horizon, "and between them");
    }
}
