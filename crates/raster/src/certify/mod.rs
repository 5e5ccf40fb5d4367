//! Certified pixels: those that provably keep their bytes if everything that the image was made from is off by
//! no more than given bounds.
//!
//! # What is proven
//! Let a second pass differ from the first only in these ways:
//! - Each vertex lies within [`Tolerance::position`] of its position on the screen, on each axis, before it is
//!   snapped. If a primitive is cut, this holds for the corners that it has after the cut. A vertex that lies
//!   beyond the near plane, or so far outside that its primitive is cut, is beyond it in the second pass, too.
//! - Each vertex's depth, as the vertex stage computes it, is within [`Tolerance::depth_ulps`] units in the last
//!   place.
//! - If a pixel shows the same fragments, its linear colour before encoding is within [`Tolerance::color`] in each
//!   component. (How far colours can be off for other reasons depends on the pipelines, which must bound it
//!   themselves.) The background is exact.
//! - Alpha masks may give any result. Indices, ids, kinds of surfaces, sizes and the target are the same.
//!
//! Then a certified pixel has in both passes the same visible triangle at each of its samples, the same translucent
//! layers in the same order, and the same bytes.
//!
//! # How
//! Snapping adds less than one unit of the grid, so snapped vertices differ by at most
//! `D = ⌊256 · position⌋ + 1` units. Two cases are possible for a primitive at a sample:
//! - It *may cover* the sample, if the sample lies within `D`, on both axes, of a side of the outline.
//! - Otherwise it *certainly covers* it or *certainly misses* it, as in the first pass. No side passes over the
//!   sample however the corners move within `D`. The outline therefore still winds around the sample once or not at
//!   all, and so do the triangles into which it is cut.
//!
//! A primitive whose facing may change, or that a plane may cut in one pass only, never certainly covers, but may
//! hide others. The same holds for lines, at all samples near them.
//!
//! If the primitive covers the sample, its depth there is a convex combination of its vertices' depths. In the
//! unmoved primitive the same weights belong to a point that is at most `D` away on each axis. With `Z` the plane of
//! the unmoved depths, the new depth therefore differs by at most `D (|Z_x| + |Z_y|)` plus the difference of the
//! vertices' depths. It also stays within the range of the vertices' depths. The rounding of the engine's own planes,
//! for which `DepthPlane` states a bound, is added.
//!
//! The visible triangle of a sample is proven if it certainly covers the sample, is opaque, and lies wholly nearer
//! than every opaque or masked primitive that may cover the sample. A translucent layer in front of it must certainly
//! cover the sample, and the depth ranges of the layers must not overlap. With several samples a fragment is shaded
//! at the centre or at a sample that it covers. Then the centre must be certain, too, and no diagonal along which an
//! outline is cut into triangles may lie near the pixel. Bytes are proven if both ends of the range of colours have
//! the same bytes.
//!
//! Where a pass paints edges of faces, a pixel also shows edges of faces that are visible in pixels around it, so all
//! of those pixels must be proven.
//!
//! # What is never certified
//! - pixels that show masked fragments or lines,
//! - pixels with a sample near an edge that may be visible, also an edge between two triangles of one face,
//! - pixels where surfaces intersect or coincide.

mod certificate;
mod gather;
mod outline;
mod tile;

pub use certificate::{Certainty, Certificate, Tolerance};

use crate::{Output, Pass, Rasterizer, Target, TargetError};
use certificate::TargetCodes;
use gather::Bins;
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
        let codes = TargetCodes::of(target, tolerance.color());
        if codes.is_requested() {
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
