//! The context of shading: the draw, the tile, and the pixels.

use crate::BlendMode;
use crate::bin::TriangleRef;
use crate::draw::{Marks, Overlap};
use crate::draw_view::DrawView;
use crate::geometry::{Geometry, Shape};
use crate::ink::Ink;
use crate::simd::{I32, Mask, Simd, U32, prelude::*};
use crate::tile_buffer::TileArea;
use crate::vertex::Slots;
use crate::viewport::SamplePattern;
use std::ops::Range;

/// What shading needs of one draw in one tile.
#[derive(Clone, Copy)]
pub(crate) struct ShadeContext<'f> {
    pub(crate) draw: DrawView<'f>,
    /// The varyings of the draw's vertices.
    pub(crate) varyings: DrawVaryings<'f>,
    /// How many varyings a vertex has.
    pub(crate) varying_count: usize,
    /// See [`AnyPipeline::is_flat`](crate::pipeline::AnyPipeline::is_flat).
    pub(crate) is_flat: bool,
    /// See [`AnyPipeline::reads_all`](crate::pipeline::AnyPipeline::reads_all).
    pub(crate) reads_all: bool,
    /// What paints edges and marks in the frame, if anything does.
    pub(crate) frame_ink: Option<&'f Ink>,
    pub(crate) pattern: SamplePattern,
    /// Internal pixels for each pixel of the target and axis.
    pub(crate) supersampling: u32,
    pub(crate) area: TileArea,
    /// The tile's triangles.
    pub(crate) triangles: &'f [TriangleRef],
    /// What edges of other faces cover, by the number of the pixel, if anything.
    pub(crate) outer: Option<&'f [Overlap]>,
}

impl<'f> ShadeContext<'f> {
    #[inline(always)]
    pub(crate) fn geometry(&self) -> &'f Geometry<'f> {
        self.draw.geometry
    }

    /// What paints the edges of the draw's faces, if anything does.
    #[inline(always)]
    pub(crate) fn ink(&self) -> Option<&'f Ink> {
        self.frame_ink.filter(|ink| ink.has_lines() && self.geometry().shows_edges())
    }

    /// What is marked of the draw's triangles, if marks are painted.
    #[inline(always)]
    pub(crate) fn marks(&self) -> Option<&'f Marks<'f>> {
        let is_painted = self.frame_ink.is_some_and(Ink::has_marks);
        if is_painted { self.geometry().marks() } else { None }
    }

    /// What paints over the draw's colours: edges, its own or those of others, or marks.
    #[inline(always)]
    pub(crate) fn ink_over(&self) -> Option<&'f Ink> {
        let has_any = || self.ink().is_some() || self.outer.is_some() || self.marks().is_some();
        self.frame_ink.filter(|_| has_any())
    }

    /// Whether the draw is of lines or points that have one colour each and no mask, which
    /// might ask for more.
    pub(crate) fn has_flat_marks(&self) -> bool {
        let Geometry { shape, blend_mode, .. } = self.geometry();
        self.is_flat
            && !matches!(shape, Shape::Triangles { .. })
            && matches!(blend_mode, BlendMode::Opaque | BlendMode::Overlay | BlendMode::Translucent)
    }

    /// The same, and nothing in the tile is painted over them.
    pub(crate) fn is_of_plain_marks(&self) -> bool {
        self.has_flat_marks() && self.outer.is_none()
    }
}

/// Looks up varyings by the indices that a draw uses.
#[derive(Clone, Copy)]
pub(crate) struct DrawVaryings<'f> {
    pub(crate) slots: Slots<'f>,
    pub(crate) values: &'f [f32],
    pub(crate) stride: usize,
}

impl<'f> DrawVaryings<'f> {
    /// The varyings of a vertex that exists.
    #[inline(always)]
    pub(crate) fn of(&self, index: u32) -> &'f [f32] {
        &self.values[self.slots.of(index) * self.stride..][..self.stride]
    }
}

/// A pixel to be shaded: where in the tile, at which of its points, and where
/// the result goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ShadePoint {
    /// Index of the pixel in the tile; bit 12 is set if the triangle may not
    /// cover the pixel's centre; from bit 13 on one more than the number of a sample:
    /// the one that it is to be, or with bit 12 one that the triangle covers.
    spot: u32,
    pub(crate) output: u32,
}

impl ShadePoint {
    const PARTLY: u32 = 12;
    const SAMPLE: u32 = 13;

    /// At the centre if the triangle covers it, else at the lowest-numbered
    /// sample that it covers; `partly` if the centre may not be covered.
    #[inline(always)]
    pub(crate) fn anywhere(pixel: usize, partly: bool, output: usize) -> Self {
        Self { spot: pixel as u32 | u32::from(partly) << Self::PARTLY, output: output as u32 }
    }

    /// As [`anywhere`](Self::anywhere) gives it for a triangle that may not cover the
    /// centre, and covers a sample for sure.
    #[inline(always)]
    pub(crate) fn covering(pixel: usize, sample: usize, output: usize) -> Self {
        let spot = pixel as u32 | 1 << Self::PARTLY | (sample as u32 + 1) << Self::SAMPLE;
        Self { spot, output: output as u32 }
    }

    /// [`covering`](Self::covering), for the spots of lanes.
    #[inline(always)]
    pub(crate) fn covering_lanes<S: Simd>(pixels: U32<S>, sample: usize) -> U32<S> {
        pixels | (1 << Self::PARTLY | (sample as u32 + 1) << Self::SAMPLE)
    }

    /// At one of the pixel's samples.
    #[inline(always)]
    pub(crate) fn at_sample(pixel: usize, sample: usize, output: usize) -> Self {
        Self { spot: pixel as u32 | (sample as u32 + 1) << Self::SAMPLE, output: output as u32 }
    }

    /// The pixel and where in it, as one number.
    #[inline(always)]
    pub(crate) fn spot(self) -> u32 {
        self.spot
    }

    /// The number of the pixel of a [`spot`](Self::spot).
    #[inline(always)]
    pub(crate) fn pixel_of(spot: u32) -> usize {
        (spot & ((1 << Self::PARTLY) - 1)) as usize
    }

    /// The corners of eight pixels in 1/256 pixel from the tile's; and, unless all
    /// are shaded at their centres for sure, where in them they are shaded.
    #[inline(always)]
    pub(crate) fn corners<S: Simd>(spots: U32<S>) -> ([I32<S>; 2], Option<Spots<S>>) {
        let simd = spots.token();
        let spots: I32<S> = spots.bitcast();
        let partly = I32::splat(simd, 1 << Self::PARTLY);
        let [x, y] = TileArea::pixels_at(spots & ((1 << Self::PARTLY) - 1));
        let elsewhere = spots
            .simd_ge(partly)
            .any_true()
            .then(|| Spots { partly: (spots & partly).simd_eq(partly), samples: spots >> Self::SAMPLE });
        ([x << 8, y << 8], elsewhere)
    }
}

/// Where in eight pixels triangles are shaded.
pub(crate) struct Spots<S: Simd> {
    /// At the centre if the triangle covers it, else at the lowest-numbered sample that
    /// it covers.
    pub(crate) partly: Mask<S>,
    /// One more than the number of the sample that it is to be, or of one that is
    /// covered for sure; 0 where neither is known.
    pub(crate) samples: I32<S>,
}

/// The pixels of one triangle in a list of [`ShadePoint`].
#[derive(Clone, Debug)]
pub(crate) struct Job {
    /// Index of the triangle among the tile's.
    pub(crate) triangle: u32,
    pub(crate) points: Range<usize>,
}
