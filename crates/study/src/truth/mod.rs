//! The image that a frame should be, by another method than the engine's: rays in f64 against triangles, shaded in f64, averaged
//! over each pixel. Nothing here is shared with the engine's sampling, shading or tracing: scenes are read by their
//! public fields, and formulas are written anew from their sources.
//!
//! **Integral.** A pixel is the mean of the light over its area, in linear light. Rays are added in powers of two until all are
//! alike and half of them agree with all of them twice in a row, or there are [`MOST_RAYS`]. Textures are integrated by the same
//! rays: each looks up the texels about one point.
//!
//! **Bound.** At some pixels twice as many rays as anywhere are cast again, elsewhere in the pixel, and none is
//! spared. The root mean square of the differences is that of two independent errors, so it is more than
//! the error of the image, and [`Truth::bound`] is that number.
//!
//! Of a large image some pixels are known, a random one of each square of [`Truth::square`] by as many pixels. An error is then
//! that of a sample, and [`Truth::uncertainty`] tells how far it may be from that of all pixels.

mod cache;
mod light;
mod samples;
mod tree;
mod world;

#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use trigon_math::{DVec2, DVec3, elementary};
use trigon_scene::camera::Camera;
use trigon_scene::{Frame, RenderSettings, Scene};

pub use world::Unsupported;

use samples::{Samples, mixed};
use world::{World, light_of};

/// The most rays through a pixel.
pub const MOST_RAYS: u32 = 256;

/// The fewest.
const FEWEST_RAYS: u32 = 8;

/// How far the mean of half of the rays may be from that of all, in linear light.
const AGREEMENT: f64 = 5e-4;

/// How much the rays of a pixel with fewer than the most may differ: more, and an edge may go through it.
const ALIKE: f64 = 0.05;

/// One in so many pixels is computed again for the bound.
const CHECKED: usize = 61;

/// Where truths are held: the folder `truths` in that of the build.
#[must_use]
pub fn folder() -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    target.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target")).join("truths")
}

/// The right light of an image's pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    size: [u32; 2],
    square: u32,
    /// The pixels that are known, in order.
    pixels: Vec<u32>,
    /// Red, green and blue of each, linear.
    light: Vec<[f64; 3]>,
    /// More than the root mean square error of `light`.
    bound: f64,
}

impl Truth {
    /// Of a scene as settings show it: their size, effects and lights count, their samples do not.
    ///
    /// # Errors
    /// The scene or the settings have something that is not implemented here.
    pub fn new(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Result<Self, Unsupported> {
        Ok(Self::of(&World::new(scene, camera, settings)?, [settings.width, settings.height]))
    }

    /// The same, taken from a folder if it is there, and otherwise put there.
    ///
    /// # Errors
    /// As [`new`](Self::new). A folder that cannot be written is no error: the image is computed every time.
    pub fn cached(
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        folder: &Path,
    ) -> Result<Self, Unsupported> {
        let world = World::new(scene, camera, settings)?;
        let size = [settings.width, settings.height];
        let path = folder.join(cache::name(&world, size));
        if let Some(truth) = cache::read(&path, size, world.square(size)) {
            return Ok(truth);
        }
        let truth = Self::of(&world, size);
        cache::write(&path, &truth);
        Ok(truth)
    }

    fn of(world: &World, size: [u32; 2]) -> Self {
        let square = world.square(size);
        let pixels = known_pixels(size, square);
        let light = over_pixels(&pixels, |pixel| world.pixel(pixel, size));
        let checked: Vec<usize> = (0..pixels.len()).step_by(CHECKED).collect();
        let again: Vec<u32> = checked.iter().map(|&index| pixels[index]).collect();
        let again = over_pixels(&again, |pixel| world.again(pixel, size));
        let squares = checked.iter().zip(&again).map(|(&index, again)| squared(light[index], *again));
        let bound = (squares.sum::<f64>() / (3 * checked.len().max(1)) as f64).sqrt();
        Self { size, square, pixels, light, bound }
    }

    /// More than the root mean square error of this image, in linear light.
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// One pixel of each square with this side is known: 1 for all.
    #[must_use]
    pub fn square(&self) -> u32 {
        self.square
    }

    /// The root mean square difference of an image from it, in linear light up to the display's white, over red, green and blue.
    ///
    /// # Panics
    /// The frame has another size, or no colour.
    #[must_use]
    pub fn error(&self, frame: &Frame) -> f64 {
        assert_eq!(self.size, [frame.width, frame.height], "images of one size are compared");
        self.root_mean(|index| self.found(frame, index))
    }

    /// Two standard errors of [`error`](Self::error) as a part of it, as it is that of a sample of pixels: from the variance of
    /// their squares.
    #[must_use]
    pub fn uncertainty(&self, frame: &Frame) -> f64 {
        let count = self.pixels.len() as f64;
        let square = |index: usize| squared(self.found(frame, index), self.shown(index));
        let sum = |power: &dyn Fn(f64) -> f64| {
            (0..self.pixels.len()).map(|index| power(square(index))).sum::<f64>() / count
        };
        let (mean, fourth) = (sum(&|square| square), sum(&|square| square * square));
        // The root has half of the relative error of the mean.
        if self.square == 1 || mean == 0.0 {
            0.0
        } else {
            ((fourth / (mean * mean) - 1.0).max(0.0) / count).sqrt()
        }
    }

    /// The light of a frame at a known pixel.
    fn found(&self, frame: &Frame, index: usize) -> [f64; 3] {
        let first = 4 * self.pixels[index] as usize;
        [0, 1, 2].map(|channel| light_of(frame.color[first + channel]))
    }

    /// What a display can show of a known pixel.
    fn shown(&self, index: usize) -> [f64; 3] {
        self.light[index].map(|light| light.clamp(0.0, 1.0))
    }

    /// The error of the best image of bytes: this one, rounded.
    #[must_use]
    pub fn rounding(&self) -> f64 {
        self.root_mean(|index| self.light[index].map(|light| light_of(byte_of(light))))
    }

    /// The root mean square difference of images from this one.
    fn root_mean(&self, found: impl Fn(usize) -> [f64; 3]) -> f64 {
        let squares = (0..self.pixels.len()).map(|index| squared(found(index), self.shown(index)));
        (squares.sum::<f64>() / (3 * self.pixels.len()) as f64).sqrt()
    }
}

impl World {
    /// Of how large squares one pixel is computed.
    fn square(&self, [width, height]: [u32; 2]) -> u32 {
        match width * height {
            0..=0x4000 => 1,
            0x4001..=0x4_0000 if self.effects.occlusion.is_some() => 4,
            0x4001..=0x4_0000 => 2,
            _ => 8,
        }
    }

    /// The mean light of a pixel.
    fn pixel(&self, pixel: u32, size: [u32; 2]) -> [f64; 3] {
        let samples = Samples::new(pixel.into(), 0);
        let (mut sum, mut cast, mut agreed) = (DVec3::ZERO, 0, 0);
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut until = FEWEST_RAYS;
        loop {
            let before = sum / f64::from(cast.max(1));
            for sample in cast..until {
                let light = self.ray(pixel, size, &samples, sample);
                (sum, low, high) = (sum + light, low.min(light), high.max(light));
            }
            let mean = sum / f64::from(until);
            let agrees = cast > 0 && (mean - before).abs().max_element() < AGREEMENT;
            agreed = if agrees { agreed + 1 } else { 0 };
            let are_alike = (high - low).max_element() < ALIKE;
            if (agreed >= 2 && are_alike) || until == MOST_RAYS {
                return mean.to_array();
            }
            (cast, until) = (until, 2 * until);
        }
    }

    /// The mean of twice as many rays as [`pixel`](Self::pixel) ever casts.
    fn again(&self, pixel: u32, size: [u32; 2]) -> [f64; 3] {
        let samples = Samples::new(pixel.into(), 1);
        let sum: DVec3 = (0..2 * MOST_RAYS).map(|sample| self.ray(pixel, size, &samples, sample)).sum();
        (sum / f64::from(2 * MOST_RAYS)).to_array()
    }

    fn ray(&self, pixel: u32, [width, _]: [u32; 2], samples: &Samples, sample: u32) -> DVec3 {
        let corner = DVec2::new((pixel % width).into(), (pixel / width).into());
        self.light(corner + samples.position(sample), samples, sample)
    }
}

/// A random pixel of each square.
fn known_pixels([width, height]: [u32; 2], square: u32) -> Vec<u32> {
    let mut state = 0;
    let rows = (0..height / square).flat_map(|row| (0..width / square).map(move |column| [column, row]));
    let mut pixels: Vec<u32> = rows
        .map(|[column, row]| {
            let random = mixed(&mut state);
            let [x, y] = [random, random >> 32].map(|offset| (offset % u64::from(square)) as u32);
            (square * row + y) * width + square * column + x
        })
        .collect();
    pixels.sort_unstable();
    pixels
}

/// A function of all pixels, by all threads.
fn over_pixels(pixels: &[u32], of: impl Fn(u32) -> [f64; 3] + Sync) -> Vec<[f64; 3]> {
    /// Pixels that a thread takes at a time.
    const PART: usize = 1024;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let next = std::sync::atomic::AtomicUsize::new(0);
    let (next, of) = (&next, &of);
    let work = move || {
        let mut done = Vec::new();
        loop {
            let part = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            let Some(own) = pixels.chunks(PART).nth(part) else { return done };
            done.push((part, own.iter().map(|&pixel| of(pixel)).collect::<Vec<_>>()));
        }
    };
    let mut parts: Vec<(usize, Vec<[f64; 3]>)> = std::thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        running.into_iter().flat_map(|thread| thread.join().expect("rays do not panic")).collect()
    });
    parts.sort_unstable_by_key(|(part, _)| *part);
    parts.into_iter().flat_map(|(_, light)| light).collect()
}

fn squared(one: [f64; 3], other: [f64; 3]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// The byte of sRGB nearest to a light (IEC 61966-2-1, 5.2).
fn byte_of(light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let value =
        if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * elementary::pow(light, 1.0 / 2.4) - 0.055 };
    (value * 255.0).round() as u8
}
