//! The lines that all algorithms draw, and the image that they paint.

use trigon_classic::Field;

/// A segment between the centres of two pixels.
pub type Segment = [[i32; 2]; 2];

/// Adds ink to a pixel, if it is in the image.
#[inline]
pub(super) fn paint(coverage: &mut Field<f32>, pixel: [i32; 2], share: f32) {
    if let Some(sum) = coverage.get_mut(pixel) {
        *sum += share;
    }
}
