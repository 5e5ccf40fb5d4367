//! Cuts a target into bands of rows: disjoint mutable slices, each behind a lock that is held only while a finished tile
//! is copied in. Tiles can thus be drawn in any order on any thread, without `unsafe`.
//!
//! An image of a target is a [`Plane`]: absent, owned by the target, or borrowed from the caller.

use super::Target;
use std::sync::{Mutex, MutexGuard, PoisonError};
use trigon_math::Vec4;

/// The most bands: the highest target in bands of the least height.
const MAX_BANDS: usize = (super::MAX_TARGET_SIZE / LEAST_HEIGHT) as usize;

const LEAST_HEIGHT: u32 = 32;

/// The rows of one band in each output; empty if an output was not requested.
#[derive(Default)]
pub(crate) struct Band<'t> {
    pub(crate) srgb8: &'t mut [[u8; 4]],
    pub(crate) unorm8: &'t mut [[u8; 4]],
    pub(crate) linear: &'t mut [Vec4],
    pub(crate) depth: &'t mut [f32],
    pub(crate) objects: &'t mut [u32],
    pub(crate) faces: &'t mut [u32],
    pub(crate) triangles: &'t mut [u32],
}

/// All bands of a target. In place, as it is made for every frame.
pub(crate) struct Bands<'t> {
    bands: [Mutex<Band<'t>>; MAX_BANDS],
    height: u32,
    width: u32,
}

impl<'t> Bands<'t> {
    /// Bands of whole rows of tiles, which are `tile` pixels high.
    pub(crate) fn new(target: &'t mut Target<'_>, tile: u32) -> Self {
        let height = LEAST_HEIGHT.next_multiple_of(tile);
        let width = target.width;
        let size = width as usize * height as usize;
        let mut srgb8 = target.srgb8.pixels_mut().chunks_mut(size);
        let mut unorm8 = target.unorm8.pixels_mut().chunks_mut(size);
        let mut linear = target.linear.pixels_mut().chunks_mut(size);
        let mut depth = target.depth.pixels_mut().chunks_mut(size);
        let mut objects = target.objects.pixels_mut().chunks_mut(size);
        let mut faces = target.faces.pixels_mut().chunks_mut(size);
        let mut triangles = target.triangles.pixels_mut().chunks_mut(size);
        let bands = std::array::from_fn(|_| {
            Mutex::new(Band {
                srgb8: srgb8.next().unwrap_or_default(),
                unorm8: unorm8.next().unwrap_or_default(),
                linear: linear.next().unwrap_or_default(),
                depth: depth.next().unwrap_or_default(),
                objects: objects.next().unwrap_or_default(),
                faces: faces.next().unwrap_or_default(),
                triangles: triangles.next().unwrap_or_default(),
            })
        });
        Self { bands, height, width }
    }

    /// The band that holds a row, and the index in it of that row's pixel in
    /// column `x`.
    pub(crate) fn lock(&self, [x, y]: [u32; 2]) -> (MutexGuard<'_, Band<'t>>, usize) {
        let band = &self.bands[(y / self.height) as usize];
        // Rows are whole whatever became of the thread that wrote others.
        let band = band.lock().unwrap_or_else(PoisonError::into_inner);
        (band, ((y % self.height) * self.width + x) as usize)
    }

    /// Pixels in a row.
    pub(crate) fn width(&self) -> usize {
        self.width as usize
    }
}

/// An image, row-major.
pub(super) enum Plane<'a, T> {
    Owned(Vec<T>),
    Borrowed(&'a mut [T]),
}

impl<T: Clone> Plane<'_, T> {
    /// An owned image, without pixels if it is empty. `None` if there is not enough memory.
    pub(super) fn owned(pixels: usize, value: T) -> Option<Self> {
        let mut image = Vec::new();
        image.try_reserve_exact(pixels).ok()?;
        image.resize(pixels, value);
        Some(Self::Owned(image))
    }
}

impl<T> Plane<'_, T> {
    pub(super) fn pixels(&self) -> Option<&[T]> {
        let pixels = match self {
            Self::Owned(image) => image.as_slice(),
            Self::Borrowed(image) => image,
        };
        (!pixels.is_empty()).then_some(pixels)
    }

    fn pixels_mut(&mut self) -> &mut [T] {
        match self {
            Self::Owned(image) => image,
            Self::Borrowed(image) => image,
        }
    }

    pub(super) fn into_owned(self) -> Option<Vec<T>> {
        match self {
            Self::Owned(image) => (!image.is_empty()).then_some(image),
            Self::Borrowed(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Output;

    #[test]
    fn every_pixel_lies_in_one_band() {
        let mut target = Target::new(70, 133, &[Output::Object]).unwrap();
        {
            let bands = Bands::new(&mut target, 21);
            for y in 0..133 {
                for x in 0..70 {
                    let (mut band, index) = bands.lock([x, y]);
                    band.objects[index] = y * 70 + x;
                }
            }
        }
        let ids = target.objects().unwrap();
        assert!(ids.iter().enumerate().all(|(index, &id)| id as usize == index), "each where it belongs");
    }
}
