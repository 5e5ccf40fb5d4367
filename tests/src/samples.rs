//! How many samples the pictures of tests have.

use trigon_raster::{Output, Target};

/// How many samples a target has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Samples {
    /// By supersampling, along each side of a pixel.
    pub(crate) per_axis: u32,
    /// By multisampling, at the standard positions.
    pub(crate) per_pixel: u32,
}

impl Samples {
    pub(crate) const ONE: Self = Self { per_axis: 1, per_pixel: 1 };

    /// A target with these samples.
    pub(crate) fn target(self, [width, height]: [u32; 2], outputs: &[Output]) -> Target<'static> {
        let target = Target::new(width, height, outputs).expect("the size is in range");
        let target = target.with_samples_per_axis(self.per_axis).expect("the number is in range");
        target.with_samples(self.per_pixel).expect("a standard pattern")
    }
}
