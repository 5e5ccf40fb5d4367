//! Runs a triangle's pipeline for one pixel.

use crate::bin::TriangleRef;
use crate::fragments::{Job, ShadePoint};
use crate::outer_ink::OuterInk;
use crate::shade::{JobList, Shading, mask_jobs, shade_jobs_with};
use crate::tile_buffer::TileArea;
use crate::view::FrameView;
use trigon_math::Vec4;

/// A pixel in its tile.
#[derive(Clone, Copy)]
pub(super) struct PixelInTile {
    pub(super) area: TileArea,
    pub(super) at: [usize; 2],
}

impl PixelInTile {
    /// The pixel alone, as fragments of one triangle are shaded.
    fn alone(&self, frame: &FrameView<'_>) -> (Job, ShadePoint) {
        let point = ShadePoint::anywhere(TileArea::index_of(self.at), frame.is_multisampled(), 0);
        (Job { triangle: 0, points: 0..1 }, point)
    }
}

/// Whether a masked triangle exists at a pixel that it covers, or at one of the
/// pixel's samples.
pub(super) fn mask(
    frame: &FrameView<'_>,
    pixel: PixelInTile,
    sample: Option<usize>,
    triangle: TriangleRef,
) -> bool {
    let (job, point) = pixel.alone(frame);
    let at = |sample| ShadePoint::at_sample(TileArea::index_of(pixel.at), sample, 0);
    let point = sample.map_or(point, at);
    let mut passed = [0];
    let list = JobList { triangles: &[triangle], jobs: &[job], points: &[point] };
    mask_jobs(frame, &pixel.area, &mut Shading::new(), list, &mut passed);
    passed != [0]
}

/// The colour of a triangle at a pixel that it covers, with edges that others paint there.
pub(super) fn color(
    frame: &FrameView<'_>,
    pixel: PixelInTile,
    triangle: TriangleRef,
    outer: &OuterInk,
) -> Vec4 {
    let (job, point) = pixel.alone(frame);
    let mut colors = [[0.0; 4]];
    let list = JobList { triangles: &[triangle], jobs: &[job], points: &[point] };
    shade_jobs_with(frame, &pixel.area, &mut Shading::new(), list, &mut colors, outer.covered());
    Vec4::from_array(colors[0])
}
