//! The target of a pass: row-major images, one for each requested output.

mod bands;

pub(crate) use bands::{Band, Bands};

use crate::viewport::SamplePattern;
use bands::Plane;
use thiserror::Error;
use trigon_math::Vec4;

/// The largest width and height of a target in pixels.
pub const MAX_TARGET_SIZE: u32 = 16384;

/// The largest number of samples per pixel and axis.
pub const MAX_SAMPLES_PER_AXIS: u32 = 4;

/// One image that a frame can produce. Outputs that are not requested are neither computed nor stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// Colour as four bytes: red, green, blue through the sRGB transfer
    /// function, straight alpha.
    Srgb8,
    /// Colour as four bytes, each component as it is, premultiplied: 0 to 1 as
    /// 0 to 255, to the nearest.
    Unorm8,
    /// Colour in linear light, premultiplied by alpha, as f32.
    Linear,
    /// Reversed depth as f32: 1 at the near plane, 0 for the background.
    Depth,
    /// The id of the visible object, `u32::MAX` for the background.
    Object,
    /// The id of the visible face, `u32::MAX` for the background.
    Face,
    /// The index of the triangle, segment or point in its draw, `u32::MAX` for
    /// the background.
    Triangle,
}

/// Why a target cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TargetError {
    /// Width or height is 0 or above [`MAX_TARGET_SIZE`].
    #[error("a target of {width}x{height} pixels: each side must be 1 to {MAX_TARGET_SIZE}")]
    Size {
        /// The requested width.
        width: u32,
        /// The requested height.
        height: u32,
    },
    /// Not 1 to [`MAX_SAMPLES_PER_AXIS`].
    #[error("{samples_per_axis} samples per axis: it must be 1 to {MAX_SAMPLES_PER_AXIS}")]
    SamplesPerAxis {
        /// The requested number.
        samples_per_axis: u32,
    },
    /// Not 1, 2, 4, 8 or 16.
    #[error("{samples} samples per pixel: it must be 1, 2, 4, 8 or 16")]
    Samples {
        /// The requested number.
        samples: u32,
    },
    /// Borrowed pixels are not as many as the target has.
    #[error("{given} pixels for a target that has {needed}")]
    Length {
        /// The pixels given.
        given: usize,
        /// Width times height.
        needed: usize,
    },
    /// The images do not fit into memory.
    #[error("no memory for images of {width}x{height} pixels: make the target smaller")]
    Memory {
        /// The requested width.
        width: u32,
        /// The requested height.
        height: u32,
    },
}

/// The images that a pass draws into; created once and used for many frames.
///
/// All are row-major from the top left, `width * height` entries. With several samples per pixel, colour is
/// their mean in linear light. Depth and ids are never averaged but taken from one sample: the first of the
/// standard pattern. With supersampling it is taken from the pixel of the finer grid in the middle, or, if
/// the number per axis is even, from the one to the right and below of the middle. Translucent draws leave no
/// depth and no ids.
pub struct Target<'a> {
    width: u32,
    height: u32,
    samples_per_axis: u32,
    pattern: SamplePattern,
    srgb8: Plane<'a, [u8; 4]>,
    unorm8: Plane<'a, [u8; 4]>,
    linear: Plane<'a, Vec4>,
    depth: Plane<'a, f32>,
    objects: Plane<'a, u32>,
    faces: Plane<'a, u32>,
    triangles: Plane<'a, u32>,
}

impl<'a> Target<'a> {
    /// A target of `width` by `height` pixels, one sample each, with the requested `outputs`.
    ///
    /// # Errors
    /// [`TargetError::Size`] if a side is 0 or above [`MAX_TARGET_SIZE`],
    /// [`TargetError::Memory`] if there is not enough.
    pub fn new(width: u32, height: u32, outputs: &[Output]) -> Result<Self, TargetError> {
        let sides = 1..=MAX_TARGET_SIZE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(TargetError::Size { width, height });
        }
        let pixels = width as usize * height as usize;
        let pixels = |output| if outputs.contains(&output) { pixels } else { 0 };
        let full = TargetError::Memory { width, height };
        let ids = |output| Plane::owned(pixels(output), u32::MAX).ok_or(full);
        Ok(Self {
            width,
            height,
            samples_per_axis: 1,
            pattern: SamplePattern::SINGLE,
            srgb8: Plane::owned(pixels(Output::Srgb8), [0; 4]).ok_or(full)?,
            unorm8: Plane::owned(pixels(Output::Unorm8), [0; 4]).ok_or(full)?,
            linear: Plane::owned(pixels(Output::Linear), Vec4::ZERO).ok_or(full)?,
            depth: Plane::owned(pixels(Output::Depth), 0.0).ok_or(full)?,
            objects: ids(Output::Object)?,
            faces: ids(Output::Face)?,
            triangles: ids(Output::Triangle)?,
        })
    }

    /// The same with the image of [`Output::Srgb8`] in the caller's memory.
    ///
    /// # Errors
    /// [`TargetError::Length`] if there are not `width * height` pixels.
    pub fn with_srgb8(mut self, pixels: &'a mut [[u8; 4]]) -> Result<Self, TargetError> {
        self.srgb8 = self.borrowed(pixels)?;
        Ok(self)
    }

    /// The same with the image of [`Output::Unorm8`] in the caller's memory.
    ///
    /// # Errors
    /// [`TargetError::Length`] if there are not `width * height` pixels.
    pub fn with_unorm8(mut self, pixels: &'a mut [[u8; 4]]) -> Result<Self, TargetError> {
        self.unorm8 = self.borrowed(pixels)?;
        Ok(self)
    }

    /// The same with the image of [`Output::Linear`] in the caller's memory.
    ///
    /// # Errors
    /// [`TargetError::Length`] if there are not `width * height` pixels.
    pub fn with_linear(mut self, pixels: &'a mut [Vec4]) -> Result<Self, TargetError> {
        self.linear = self.borrowed(pixels)?;
        Ok(self)
    }

    /// The same with the image of [`Output::Depth`] in the caller's memory.
    ///
    /// # Errors
    /// [`TargetError::Length`] if there are not `width * height` pixels.
    pub fn with_depth(mut self, pixels: &'a mut [f32]) -> Result<Self, TargetError> {
        self.depth = self.borrowed(pixels)?;
        Ok(self)
    }

    /// The same with the image of [`Output::Object`] in the caller's memory.
    ///
    /// # Errors
    /// [`TargetError::Length`] if there are not `width * height` pixels.
    pub fn with_objects(mut self, pixels: &'a mut [u32]) -> Result<Self, TargetError> {
        self.objects = self.borrowed(pixels)?;
        Ok(self)
    }

    /// The same with the image of [`Output::Face`] in the caller's memory.
    ///
    /// # Errors
    /// [`TargetError::Length`] if there are not `width * height` pixels.
    pub fn with_faces(mut self, pixels: &'a mut [u32]) -> Result<Self, TargetError> {
        self.faces = self.borrowed(pixels)?;
        Ok(self)
    }

    /// The same with the image of [`Output::Triangle`] in the caller's memory.
    ///
    /// # Errors
    /// [`TargetError::Length`] if there are not `width * height` pixels.
    pub fn with_triangles(mut self, pixels: &'a mut [u32]) -> Result<Self, TargetError> {
        self.triangles = self.borrowed(pixels)?;
        Ok(self)
    }

    fn borrowed<T>(&self, pixels: &'a mut [T]) -> Result<Plane<'a, T>, TargetError> {
        let needed = self.width as usize * self.height as usize;
        if pixels.len() == needed {
            Ok(Plane::Borrowed(pixels))
        } else {
            Err(TargetError::Length { given: pixels.len(), needed })
        }
    }

    /// The same with multisampling: `samples` in each pixel, 1, 2, 4, 8 or 16,
    /// at the standard positions of Direct3D and Vulkan. Coverage and depth are
    /// decided at each; a triangle is shaded once for each pixel, at its centre
    /// if the triangle covers it, else at the lowest-numbered sample that it
    /// covers.
    ///
    /// # Errors
    /// [`TargetError::Samples`] for any other number.
    pub fn with_samples(mut self, samples: u32) -> Result<Self, TargetError> {
        self.pattern = SamplePattern::of(samples).ok_or(TargetError::Samples { samples })?;
        Ok(self)
    }

    /// The same with supersampling: everything is drawn on a grid that is finer
    /// by `samples_per_axis` on both axes, shaded there, and averaged.
    ///
    /// # Errors
    /// [`TargetError::SamplesPerAxis`] if it is 0 or above
    /// [`MAX_SAMPLES_PER_AXIS`].
    pub fn with_samples_per_axis(mut self, samples_per_axis: u32) -> Result<Self, TargetError> {
        if !(1..=MAX_SAMPLES_PER_AXIS).contains(&samples_per_axis) {
            return Err(TargetError::SamplesPerAxis { samples_per_axis });
        }
        self.samples_per_axis = samples_per_axis;
        Ok(self)
    }

    /// Width in pixels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// How many samples supersampling takes along each axis of a pixel.
    #[must_use]
    pub fn samples_per_axis(&self) -> u32 {
        self.samples_per_axis
    }

    /// How many samples multisampling takes in each pixel.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.pattern.count() as u32
    }

    /// Where in each pixel depth and ids are taken: x to the right and y down from
    /// its upper left corner, in pixels. With one sample that is the centre.
    #[must_use]
    pub fn visibility_sample(&self) -> [f64; 2] {
        let axis = self.samples_per_axis;
        let offset = self.pattern.offsets()[0];
        offset.map(|part| (f64::from(axis / 2) + f64::from(part) / 256.0) / f64::from(axis))
    }

    /// Whether any of its images holds colours.
    pub(crate) fn has_colors(&self) -> bool {
        self.srgb8().is_some() || self.unorm8().is_some() || self.linear().is_some()
    }

    pub(crate) fn pattern(&self) -> SamplePattern {
        self.pattern
    }

    /// The image of [`Output::Unorm8`], if requested.
    #[must_use]
    pub fn unorm8(&self) -> Option<&[[u8; 4]]> {
        self.unorm8.pixels()
    }

    /// The image of [`Output::Srgb8`], if requested.
    #[must_use]
    pub fn srgb8(&self) -> Option<&[[u8; 4]]> {
        self.srgb8.pixels()
    }

    /// The image of [`Output::Linear`], if requested.
    #[must_use]
    pub fn linear(&self) -> Option<&[Vec4]> {
        self.linear.pixels()
    }

    /// The image of [`Output::Depth`], if requested.
    #[must_use]
    pub fn depth(&self) -> Option<&[f32]> {
        self.depth.pixels()
    }

    /// The image of [`Output::Object`], if requested.
    #[must_use]
    pub fn objects(&self) -> Option<&[u32]> {
        self.objects.pixels()
    }

    /// The image of [`Output::Face`], if requested.
    #[must_use]
    pub fn faces(&self) -> Option<&[u32]> {
        self.faces.pixels()
    }

    /// The image of [`Output::Triangle`], if requested.
    #[must_use]
    pub fn triangles(&self) -> Option<&[u32]> {
        self.triangles.pixels()
    }

    /// Gives the images away.
    #[must_use]
    pub fn into_images(self) -> TargetImages {
        TargetImages {
            srgb8: self.srgb8.into_owned(),
            unorm8: self.unorm8.into_owned(),
            linear: self.linear.into_owned(),
            depth: self.depth.into_owned(),
            objects: self.objects.into_owned(),
            faces: self.faces.into_owned(),
            triangles: self.triangles.into_owned(),
        }
    }
}

/// The images of a [`Target`], owned; `None` for images that were not requested, or that lie in borrowed
/// memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TargetImages {
    /// See [`Output::Srgb8`].
    pub srgb8: Option<Vec<[u8; 4]>>,
    /// See [`Output::Unorm8`].
    pub unorm8: Option<Vec<[u8; 4]>>,
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
