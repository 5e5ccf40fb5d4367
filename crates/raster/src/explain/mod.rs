//! Explained pixels: every triangle that reaches the pixel, its exact edge values, its depth, and which one
//! is visible by what margin.
//!
//! The values come from the stages that draw: vertices, set-up, edge functions, coverage, depth, masks, colours and
//! the order of layers. Only the comparison of depths is repeated, sample by sample, so that its outcome can be
//! reported.

mod fragment;
mod trial;

pub use fragment::{EdgeExplanation, FragmentExplanation, PrimitiveKind, SampleExplanation, Verdict};

use crate::resolve::mean;
use crate::{Pass, Rasterizer, Target};
use trial::Trial;
use trigon_math::Vec4;

/// Why a pixel looks as it does.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PixelExplanation {
    /// Column and row in the target.
    pub pixel: [u32; 2],
    /// Its samples: with supersampling pixel by pixel of the finer grid, row by
    /// row, and in each by number.
    pub samples: Vec<SampleExplanation>,
    /// The sample that the target's depth and ids come from.
    pub reported: usize,
    /// The pixel's colour: linear light, premultiplied; the mean of the samples.
    pub color: Vec4,
}

impl PixelExplanation {
    /// The sample that the target's depth and ids come from.
    #[must_use]
    pub fn reported(&self) -> &SampleExplanation {
        &self.samples[self.reported]
    }
}

impl Rasterizer {
    /// Explains the pixel in column `x` and row `y` of the image that
    /// [`draw`](Self::draw) would make of the pass in this target. Only the target's
    /// size and samples matter. `None` outside the target.
    ///
    /// The explanation lists every triangle that covers a sample of the pixel, and
    /// those that miss a sample within their bounding box. Triangles that were
    /// culled earlier are not listed: by their facing, for having no area, or for
    /// covering no sample of the image. The pass's scissor is ignored.
    ///
    /// Costs as much as all stages before the tiles, and one visit of each triangle.
    ///
    /// ```
    /// # use trigon_raster::{*, math::Vec4};
    /// # struct Triangle;
    /// # impl Pipeline for Triangle {
    /// #     type Varyings = ();
    /// #     fn vertex_count(&self) -> usize { 3 }
    /// #     fn vertex(&self, index: usize) -> VertexOutput<()> {
    /// #         let [x, y] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]][index];
    /// #         VertexOutput { position: Vec4::new(x, y, 0.5, 1.0), varyings: () }
    /// #     }
    /// #     fn fragment(&self, _: &Fragment<()>) -> Vec4 { Vec4::ONE }
    /// # }
    /// let mut pass = Pass::new();
    /// pass.triangles(Draw::new(&Triangle, &[[0, 1, 2]]));
    /// let target = Target::new(10, 5, &[])?;
    /// let pixel = Rasterizer::default().explain_pixel(&pass, &target, 7, 0).expect("inside of the target");
    /// let fragment = &pixel.samples[0].fragments[0];
    /// assert!(matches!(fragment.verdict, Verdict::OutsideEdge(2)), "left of the edge from corner 2 to 0");
    /// # Ok::<(), TargetError>(())
    /// ```
    pub fn explain_pixel(
        &mut self,
        pass: &Pass<'_>,
        target: &Target<'_>,
        x: u32,
        y: u32,
    ) -> Option<PixelExplanation> {
        if x >= target.width() || y >= target.height() {
            return None;
        }
        let frame = self.prepare(pass, target);
        let trial = Trial::new(&frame);
        let axis = frame.supersampling;
        let cells = (0..axis * axis).map(|i| [x * axis + i % axis, y * axis + i / axis]);
        let count = frame.grid.pattern.count();
        let samples: Vec<_> = cells
            .flat_map(|cell| (0..count).map(move |sample| (cell, sample)))
            .map(|(cell, number)| trial.sample(cell, number))
            .collect();
        let cells = samples.chunks(count);
        let colors = cells.map(|samples| mean(samples.iter().map(|sample| sample.color), count));
        let color = mean(colors, (axis * axis) as usize);
        let middle = (axis / 2 * axis + axis / 2) as usize;
        Some(PixelExplanation { pixel: [x, y], samples, reported: middle * count, color })
    }
}
