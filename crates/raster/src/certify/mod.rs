//! Certified pixels: those that are proven to stay as they are when everything
//! that the image was made from is off by no more than stated bounds.
//!
//! # What is proven
//! Let a second pass differ from the first so that
//! - each vertex lies within [`Tolerance::position`] of its place on the screen,
//!   on each axis, before it is snapped; of a primitive that is cut this is said
//!   of the corners that it has after that, and a vertex that lies beyond the near
//!   plane, or too far outside to be drawn whole, stays there;
//! - each vertex's depth, as the vertex stage computes it, is within
//!   [`Tolerance::depth_ulps`] units in the last place;
//! - each pixel's linear colour, before it is encoded, is within
//!   [`Tolerance::color`] in each component *if* the pixel still sees the same
//!   fragments (what they look like is the pipelines' business, and bounding it
//!   theirs, too). The mean of samples is off by no more than the samples are. The
//!   background is exact;
//! - masks answer as they like; indices, ids, surfaces, sizes and the target are
//!   the same.
//!
//! Then a certified pixel has the same winner at each of its samples, the same
//! translucent layers in the same order, and the same bytes.
//!
//! # How
//! Snapped vertices move by at most `D = ⌊256 · position⌋ + 1` units of the grid,
//! as rounding adds less than one. So at each sample a primitive
//! - *may cover* it, if the sample lies within `D`, on both axes, of a side of the
//!   outline;
//! - *certainly covers* or *misses* it, else, as it does unmoved: however the
//!   corners move there, no side ever runs over the sample, so the outline keeps
//!   winding around it once or not at all, and so do the triangles that it is cut
//!   into.
//!
//! A primitive whose facing may turn over, or that a plane may come to cut, is
//! never certain to cover, but may still hide others. So do lines, by all that is
//! near them.
//!
//! Where it covers the sample, its depth there is a convex combination of its
//! vertices' depths. The same weights belong to a point of the unmoved primitive
//! that is at most `D` away on each axis. So with `Z` the plane of the unmoved
//! depths, the new depth is within `D (|Z_x| + |Z_y|)` plus what the vertices'
//! depths are off, and within the range of the vertices' depths. To that the
//! rounding of the engine's own planes is added, for which
//! `DepthPlane` states a bound.
//!
//! A sample's winner is proven if it certainly covers the sample, is opaque, and
//! lies wholly nearer than all that may cover it, be it opaque or masked. A
//! translucent layer in front of the winner must certainly cover the sample, and
//! the ranges of the layers must not meet. With several samples a fragment is
//! shaded at the centre or else at a sample that it covers, so what is seen must
//! be certain about the centre, too, and no diagonal along which an outline is cut
//! into triangles may come near the pixel. Bytes are proven if both ends of the
//! range of colours are encoded the same.
//!
//! Where a pass paints edges of faces, a pixel shows the edges of what pixels around it see,
//! too, so all of those must be proven.
//!
//! # What is never certified
//! Pixels that show masked fragments or lines, or whose samples lie near an edge
//! that may be visible, also one between two triangles of a face; and where
//! surfaces lie in each other.

mod bins;
mod certificate;
mod codes;
mod contender;
mod gather;
mod outline;
mod tile;
mod tolerance;

pub use certificate::{Certainty, Certificate};
pub use tolerance::Tolerance;

use crate::{Output, Pass, Rasterizer, Target, TargetError};
use bins::Bins;
use codes::Codes;
use tile::TileCertainty;

impl Rasterizer {
    /// Proves which pixels of the image that [`draw`](Self::draw) would make of the
    /// pass in this target do not change if everything is off by no more than
    /// `tolerance`. Bytes are checked in the encodings that the target keeps; its
    /// content does not matter. Pixels outside the pass's scissor are not drawn and
    /// count as certified.
    ///
    /// Draws the image once more for its colours, then visits each primitive again
    /// on the calling thread.
    ///
    /// # Errors
    /// [`TargetError::Memory`] if there is not enough for an image of colours.
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
    /// #     fn fragment(&self, _: &Fragment<()>) -> Vec4 { Vec4::new(0.3, 0.3, 0.3, 1.0) }
    /// # }
    /// let mut pass = Pass::new();
    /// pass.triangles(Draw::new(&Triangle, &[[0, 1, 2]]));
    /// // The triangle's long edge goes right through the centres of pixels.
    /// let target = Target::new(8, 8, &[Output::Srgb8])?;
    /// let certificate = Rasterizer::default().certify(&pass, &target, Tolerance::default())?;
    /// assert_eq!(certificate.certainty(3, 4), Certainty::Visibility);
    /// assert_eq!(certificate.count(Certainty::Certified), 56);
    /// # Ok::<(), TargetError>(())
    /// ```
    pub fn certify(
        &mut self,
        pass: &Pass<'_>,
        target: &Target<'_>,
        tolerance: Tolerance,
    ) -> Result<Certificate, TargetError> {
        let mut certificate = self.certify_visibility(pass, target, tolerance);
        let codes = Codes::of(target, tolerance.color());
        if codes.is_asked() {
            let colors = Target::new(target.width(), target.height(), &[Output::Linear])?;
            let colors = colors.with_samples_per_axis(target.samples_per_axis())?;
            let mut colors = colors.with_samples(target.samples())?;
            self.draw(pass, &mut colors);
            certificate.doubt_colors(colors.linear().unwrap_or_default(), &codes);
        }
        Ok(certificate)
    }

    fn certify_visibility(
        &mut self,
        pass: &Pass<'_>,
        target: &Target<'_>,
        tolerance: Tolerance,
    ) -> Certificate {
        let frame = self.prepare(pass, target);
        let contenders = gather::contenders(&frame, tolerance);
        let bins = Bins::new(&frame, &contenders);
        let mut certificate = Certificate::new([target.width(), target.height()]);
        let tiles = frame.tiles();
        for number in 0..tiles.len() as u32 {
            let [column, row] = tiles.get(number).expect("below their number");
            let area = frame.area(row * frame.grid.columns + column);
            let outlines = bins.of([column, row]).map(|&i| contenders.outline(i as usize));
            let tile = TileCertainty::of(&frame, &area, outlines.collect());
            certificate.note(&frame, &area, &tile);
        }
        certificate
    }
}
