//! The built-in studio that metals reflect in a scene that defines no surroundings.
//!
//! Metals show hardly anything but reflections: under lamps alone they are black except for their highlights.
//! The studio is grey, so that metals show their own colours, and the same all around: what a metal reflects
//! depends on two numbers, the elevation of the reflected direction and the roughness. The table of both takes
//! 5 kB and is made for the first metal, in a few milliseconds. An [`Environment`](crate::Environment) of the
//! same studio would hold maps of all directions.
//!
//! The studio is fixed to the world, as environments are, while the studio's lamps move with the camera.

use crate::work::{Work, note};
use std::sync::LazyLock;

use trigon_math::{Mat3, Vec3, elementary};
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, lanes_of, prelude::*};

use crate::lanes::{dot, mix, splat, table_step};
use crate::lighting::LitPoints;

/// Light from straight above: the ceiling is one large lamp.
const CEILING: f32 = 0.8;

/// At the horizon.
const WALL: f32 = 0.36;

/// From straight below.
const FLOOR: f32 = 0.14;

/// Directions of the table, from straight down to straight up in equal steps of height. One of them
/// is the horizon, where the light changes abruptly.
const HEIGHTS: usize = 129;

/// Roughnesses of the table, from 0 to 1 in equal steps.
const ROUGHNESSES: usize = 9;

/// A row of heights for each roughness.
static TABLE: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let share = |step: usize, count: usize| step as f32 / (count - 1) as f32;
    (0..ROUGHNESSES * HEIGHTS)
        .map(|entry| {
            let height = share(entry % HEIGHTS, HEIGHTS) * 2.0 - 1.0;
            blurred(share(entry / HEIGHTS, ROUGHNESSES), height)
        })
        .collect()
});

/// The light from a direction of the studio, by its height: −1 is straight down. From the horizon up it
/// grows evenly and ever faster; below, it falls off within a few degrees, as where a wall meets a floor.
fn radiance(height: f32) -> f32 {
    if height >= 0.0 {
        return WALL + (CEILING - WALL) * height * height;
    }
    let level = 1.0 + height;
    let level = if level > 0.0 { level } else { 0.0 };
    let square = level * level;
    FLOOR + (WALL - FLOOR) * square * square * square * square
}

/// The studio around the metals of an image.
#[derive(Clone, Debug)]
pub(crate) struct MetalStudio {
    /// The up axis of the world in camera space.
    up: Vec3,
    /// Factor on all of its light.
    intensity: f32,
    table: &'static [f32],
}

/// The studio's light on eight points of metal; the same in all channels.
pub(crate) struct StudioOnMetal<S: Simd> {
    /// Light from the mirrored direction, blurred by the roughness.
    pub(crate) mirrored: F32<S>,
    /// Light from all directions, as a white matt surface shows it.
    pub(crate) around: F32<S>,
}

impl MetalStudio {
    /// For a camera whose space `from_camera` turns to that of the studio, in which +Y is up.
    pub(crate) fn new(from_camera: &Mat3, intensity: f32) -> Self {
        Self { up: from_camera.row(1), intensity, table: &TABLE }
    }

    /// The light on points in camera space.
    pub(crate) fn light<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        roughness: F32<S>,
    ) -> StudioOnMetal<S> {
        note(Work::StudioLight);
        simd.vectorize(
            #[inline(always)]
            || {
                let up = splat(simd, self.up);
                let (normal, view) = (dot(points.normal, up), dot(points.view, up));
                // Only the height of the direction 2 (n · v) n − v is needed.
                let height = normal * (dot(points.normal, points.view) * 2.0) - view;
                // The roughest mirror weights all directions as a matt surface does.
                let roughest = [ROUGHNESSES as i32 - 1; LANES];
                StudioOnMetal {
                    mirrored: self.at(simd, height, roughness),
                    around: self.in_row(simd, normal, roughest),
                }
            },
        )
    }

    /// The light from a direction of the studio, as mirrors without roughness show it.
    pub(crate) fn radiance(&self, direction: Vec3) -> Vec3 {
        Vec3::splat(radiance(direction.y) * self.intensity)
    }

    pub(crate) fn byte_count(&self) -> usize {
        size_of_val(self.table)
    }

    /// Interpolates between the four entries of the table around each height and roughness.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, height: F32<S>, roughness: F32<S>) -> F32<S> {
        let (row, share) = table_step(roughness, ROUGHNESSES);
        let sharper = self.in_row(simd, height, row);
        mix(sharper, self.in_row(simd, height, row.map(|row| row + 1)), share)
    }

    /// Interpolates between the two entries of a row around each height.
    #[inline(always)]
    fn in_row<S: Simd>(&self, simd: S, height: F32<S>, row: [i32; LANES]) -> F32<S> {
        let (column, share) = table_step(height * 0.5 + 0.5, HEIGHTS);
        let pairs = lanes_of(
            #[inline(always)]
            |lane| {
                let first = row[lane] as usize * HEIGHTS + column[lane] as usize;
                let pair = &self.table[first..first + 2];
                [pair[0], pair[1]]
            },
        );
        let [below, above] = [0, 1].each(
            #[inline(always)]
            |end| F32::simd_from(simd, pairs.map(|pair| pair[end])),
        );
        mix(below, above, share) * self.intensity
    }
}

/// What a mirror of a roughness shows when seen head-on at a height: the studio weighted by GGX's
/// distribution and the cosine (B. Karis, "Real Shading in Unreal Engine 4", 2013, section
/// "Pre-Filtered Environment Map").
fn blurred(roughness: f32, height: f32) -> f32 {
    /// Half vectors, by their distance from the normal: each ring has as many as the distribution
    /// has there.
    const RINGS: u8 = 16;
    /// And around it, on one side: the other one mirrors the same.
    const SECTORS: usize = 16;
    let around: [f32; SECTORS] = std::array::from_fn(|sector| {
        elementary::cos_f32(std::f32::consts::PI * (sector as f32 + 0.5) / SECTORS as f32)
    });
    let square = roughness * roughness * roughness * roughness;
    let level = (1.0 - height * height).sqrt();
    let (mut sum, mut weights) = (0.0, 0.0);
    for ring in 0..RINGS {
        // Up to grazing light.
        let across = (f32::from(ring) + 0.5) / (f32::from(RINGS) * (1.0 + square));
        let half = (1.0 - across) / (1.0 + (square - 1.0) * across);
        // Half the angle between normal and light.
        let cosine = 2.0 * half - 1.0;
        let sine = (1.0 - cosine * cosine).sqrt();
        for around in around {
            let towards = height * cosine + level * sine * around;
            sum += radiance(towards) * cosine;
            weights += cosine;
        }
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use crate::baseline::baseline;

    use super::*;
    use crate::environment::Environment;

    /// Not at the fold of octahedral maps.
    fn direction(height: f32) -> Vec3 {
        let level = (1.0 - height * height).sqrt();
        Vec3::new(level * 0.8, height, level * 0.6)
    }

    /// The studio seen from a point whose normal and view are the same.
    fn head_on(studio: &MetalStudio, towards: Vec3, roughness: f32) -> [f32; 2] {
        let simd = baseline();
        let towards = splat(simd, towards);
        let points = LitPoints::elsewhere(simd, towards, towards, towards);
        let StudioOnMetal { mirrored, around } = studio.light(simd, &points, F32::splat(simd, roughness));
        [mirrored, around].map(|light| light[0])
    }

    fn heights() -> impl Iterator<Item = Vec3> {
        (-50_i8..=50).map(|step| direction(f32::from(step) / 50.0))
    }

    #[test]
    fn a_mirror_shows_the_studio_itself() {
        let studio = MetalStudio::new(&Mat3::IDENTITY, 1.0);
        for towards in heights() {
            let error = (head_on(&studio, towards, 0.0)[0] - radiance(towards.y)).abs();
            // The table's steps are 1/64 high, and the light's second derivative is below 13: values
            // between two entries are within 13/8 of the step's square.
            assert!(error < 4e-4, "{towards}: {error}");
        }
    }

    /// The mean of the studio over all directions, weighted by the cosine and GGX's distribution of
    /// the half vector, direction by direction.
    fn weighed(towards: Vec3, roughness: f64) -> f64 {
        const RINGS: u32 = 300;
        const SECTORS: u32 = 100;
        let normal = towards.as_dvec3();
        let (across, along) = normal.any_orthonormal_pair();
        let square = roughness * roughness * roughness * roughness;
        let (mut sum, mut weights) = (0.0, 0.0);
        for (ring, sector) in (0..RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| (ring, sector))) {
            // Denser near the normal, from where smooth surfaces mirror.
            let place = (f64::from(ring) + 0.5) / f64::from(RINGS);
            let cosine = 1.0 - place * place * place;
            let angle = std::f64::consts::TAU * (f64::from(sector) + 0.5) / f64::from(SECTORS);
            let (sine, around) = ((1.0 - cosine * cosine).sqrt(), elementary::cos(angle));
            let light = normal * cosine + (across * around + along * elementary::sin(angle)) * sine;
            let half = (light + normal).normalize().dot(normal);
            let width = half * half * (square - 1.0) + 1.0;
            let weight = cosine * place * place / (width * width);
            sum += f64::from(radiance(light.as_vec3().y)) * weight;
            weights += weight;
        }
        sum / weights
    }

    /// An image of all directions of the studio.
    fn environment() -> Environment {
        const HEIGHT: usize = 512;
        let rows = (0..HEIGHT)
            .map(|row| elementary::cos_f32(std::f32::consts::PI * (row as f32 + 0.5) / HEIGHT as f32));
        let pixels: Vec<[f32; 3]> = rows.flat_map(|height| [[radiance(height); 3]; 2 * HEIGHT]).collect();
        Environment::from_equirectangular(2 * HEIGHT, HEIGHT, &pixels).expect("a pixel for each direction")
    }

    #[test]
    fn rough_metals_mirror_the_studio_weighed_by_the_distribution() {
        let (studio, environment) = (MetalStudio::new(&Mat3::IDENTITY, 1.0), environment());
        for roughness in [0.25_f32, 0.5, 0.75, 1.0] {
            for towards in heights().step_by(5) {
                let [mirrored, around] = head_on(&studio, towards, roughness);
                let exact = weighed(towards, f64::from(roughness));
                let error = (f64::from(mirrored) - exact).abs();
                // The table's own sum is within 0.005 (next to the horizon, where the light changes
                // most), and between its entries the error is as above.
                assert!(error < 0.006, "roughness {roughness}, {towards}: {error}");
                // An environment of this studio is the same, within the accuracy of its coarse maps
                // and its nine coefficients (3 % of the brightest, Ramamoorthi 2001).
                let error = (mirrored - environment.radiance(towards, roughness)).abs().max_element();
                assert!(error < 0.02, "an environment, roughness {roughness}, {towards}: {error}");
                let error = (around - environment.irradiance(towards)).abs().max_element();
                assert!(error < 0.03, "matt, {towards}: {error}");
            }
        }
    }

    /// The studio does not turn with the camera.
    #[test]
    fn up_is_up_in_the_world() {
        let quarter = trigon_math::Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
        let studio = MetalStudio::new(&Mat3::from_quat(quarter), 2.0);
        let up = quarter.inverse() * Vec3::Y;
        let [mirrored, _] = head_on(&studio, up, 0.0);
        assert!((mirrored - 2.0 * CEILING).abs() < 1e-5, "{mirrored}, twice as bright");
        assert_eq!(studio.radiance(Vec3::NEG_Y), Vec3::splat(2.0 * FLOOR), "and below");
    }

    #[test]
    fn the_studio_is_brighter_the_higher_one_looks() {
        let light = |step: i8| radiance(f32::from(step) / 50.0);
        assert_eq!([light(-50), light(0), light(50)], [FLOOR, WALL, CEILING], "where they belong");
        assert!(
            (-50..50).all(|step| light(step) < light(step + 1) || light(step) - FLOOR < 1e-6),
            "in order"
        );
    }
}
