//! Where a pass lands: row-major pictures, one for each output asked for.

mod tiles;

pub(crate) use tiles::{TileRect, TileRows, split_into_tiles};

use thiserror::Error;
use trigon_math::Vec4;

/// The largest width and height of a target in pixels.
pub const MAX_TARGET_SIZE: u32 = 16384;

/// The largest number of samples per pixel and axis.
pub const MAX_SAMPLES_PER_AXIS: u32 = 4;

/// One picture that a frame can leave behind. What is not asked for is neither
/// computed nor stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// Colour as four bytes: red, green, blue through the sRGB transfer
    /// function, straight alpha.
    Srgb8,
    /// Colour in linear light, premultiplied by alpha, as f32.
    Linear,
    /// Reversed depth as f32: 1 at the near plane, 0 for the background.
    Depth,
    /// The id of the object that is seen, `u32::MAX` for the background.
    Object,
    /// The id of the face that is seen, `u32::MAX` for the background.
    Face,
    /// The index of the triangle, segment or point in its draw, `u32::MAX` for
    /// the background.
    Triangle,
}

/// Why a target cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum TargetError {
    /// Width or height is 0 or above [`MAX_TARGET_SIZE`].
    #[error("a target of {width}x{height} pixels: each side must be 1 to {MAX_TARGET_SIZE}")]
    Size {
        /// The width asked for.
        width: u32,
        /// The height asked for.
        height: u32,
    },
    /// Not 1 to [`MAX_SAMPLES_PER_AXIS`].
    #[error("{samples_per_axis} samples per axis: it must be 1 to {MAX_SAMPLES_PER_AXIS}")]
    Samples {
        /// The number asked for.
        samples_per_axis: u32,
    },
}

/// The pictures that a pass draws into; made once and used for many frames.
///
/// All are row-major from the top left, `width * height` entries. With several
/// samples per pixel, colour is their mean in linear light; depth and ids are
/// never averaged but taken from one sample, in the middle of the pixel or
/// (when the number per axis is even) the one next to the middle to the right
/// and below. Translucent draws leave no depth and no ids.
pub struct Target {
    width: u32,
    height: u32,
    samples_per_axis: u32,
    srgb8: Option<Vec<[u8; 4]>>,
    linear: Option<Vec<Vec4>>,
    depth: Option<Vec<f32>>,
    objects: Option<Vec<u32>>,
    faces: Option<Vec<u32>>,
    triangles: Option<Vec<u32>>,
}

impl Target {
    /// A target of `width` by `height` pixels, one sample each, that keeps the
    /// `outputs` asked for.
    ///
    /// # Errors
    /// [`TargetError::Size`] if a side is 0 or above [`MAX_TARGET_SIZE`].
    pub fn new(width: u32, height: u32, outputs: &[Output]) -> Result<Self, TargetError> {
        let sides = 1..=MAX_TARGET_SIZE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(TargetError::Size { width, height });
        }
        let pixels = width as usize * height as usize;
        let ids = |output| outputs.contains(&output).then(|| vec![u32::MAX; pixels]);
        Ok(Self {
            width,
            height,
            samples_per_axis: 1,
            srgb8: outputs.contains(&Output::Srgb8).then(|| vec![[0; 4]; pixels]),
            linear: outputs.contains(&Output::Linear).then(|| vec![Vec4::ZERO; pixels]),
            depth: outputs.contains(&Output::Depth).then(|| vec![0.0; pixels]),
            objects: ids(Output::Object),
            faces: ids(Output::Face),
            triangles: ids(Output::Triangle),
        })
    }

    /// The same with a regular grid of samples in each pixel, `samples_per_axis`
    /// in a row.
    ///
    /// # Errors
    /// [`TargetError::Samples`] if it is 0 or above [`MAX_SAMPLES_PER_AXIS`].
    pub fn with_samples_per_axis(mut self, samples_per_axis: u32) -> Result<Self, TargetError> {
        if !(1..=MAX_SAMPLES_PER_AXIS).contains(&samples_per_axis) {
            return Err(TargetError::Samples { samples_per_axis });
        }
        self.samples_per_axis = samples_per_axis;
        Ok(self)
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// How many samples a pixel has in a row and in a column.
    pub fn samples_per_axis(&self) -> u32 {
        self.samples_per_axis
    }

    /// The picture of [`Output::Srgb8`], if asked for.
    pub fn srgb8(&self) -> Option<&[[u8; 4]]> {
        self.srgb8.as_deref()
    }

    /// The picture of [`Output::Linear`], if asked for.
    pub fn linear(&self) -> Option<&[Vec4]> {
        self.linear.as_deref()
    }

    /// The picture of [`Output::Depth`], if asked for.
    pub fn depth(&self) -> Option<&[f32]> {
        self.depth.as_deref()
    }

    /// The picture of [`Output::Object`], if asked for.
    pub fn objects(&self) -> Option<&[u32]> {
        self.objects.as_deref()
    }

    /// The picture of [`Output::Face`], if asked for.
    pub fn faces(&self) -> Option<&[u32]> {
        self.faces.as_deref()
    }

    /// The picture of [`Output::Triangle`], if asked for.
    pub fn triangles(&self) -> Option<&[u32]> {
        self.triangles.as_deref()
    }

    /// Gives the pictures away.
    pub fn into_pictures(self) -> Pictures {
        Pictures {
            srgb8: self.srgb8,
            linear: self.linear,
            depth: self.depth,
            objects: self.objects,
            faces: self.faces,
            triangles: self.triangles,
        }
    }
}

/// The pictures of a [`Target`], owned; those that were not asked for are
/// `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pictures {
    /// See [`Output::Srgb8`].
    pub srgb8: Option<Vec<[u8; 4]>>,
    /// See [`Output::Linear`].
    pub linear: Option<Vec<Vec4>>,
    /// See [`Output::Depth`].
    pub depth: Option<Vec<f32>>,
    /// See [`Output::Object`].
    pub objects: Option<Vec<u32>>,
    /// See [`Output::Face`].
    pub faces: Option<Vec<u32>>,
    /// See [`Output::Triangle`].
    pub triangles: Option<Vec<u32>>,
}
