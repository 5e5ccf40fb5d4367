//! What shading has to know: the frame, the tile, and which pixels.

use crate::Surface;
use crate::bin::Place;
use crate::frame::{DrawPlan, FrameView};
use crate::geometry::{Geometry, Shape};
use crate::ink::{Ink, Marks, Overlap};
use crate::simd::{I32, Mask, Simd, U32, prelude::*};
use crate::tile::TileArea;
use crate::vertex::{DrawVertices, Slots};
use std::ops::Range;

/// What a shader has to know of the frame.
#[derive(Clone, Copy)]
pub(crate) struct ShadeContext<'f> {
    pub(crate) frame: &'f FrameView<'f>,
    pub(crate) area: TileArea,
    /// The tile's triangles.
    pub(crate) places: &'f [Place],
    /// Index of the draw among the frame's plans.
    pub(crate) draw: usize,
    /// What edges of other faces cover, by the number of the pixel, if anything.
    pub(crate) outer: Option<&'f [Overlap]>,
}

impl<'f> ShadeContext<'f> {
    #[inline(always)]
    pub(crate) fn plan(&self) -> &'f DrawPlan {
        &self.frame.plan.draws[self.draw]
    }

    #[inline(always)]
    pub(crate) fn geometry(&self) -> &'f Geometry<'f> {
        &self.frame.pass[self.plan().draw].geometry
    }

    /// What paints the edges of the draw's faces, if anything does.
    #[inline(always)]
    pub(crate) fn ink(&self) -> Option<&'f Ink> {
        self.frame.ink.as_ref().filter(|ink| ink.has_lines() && self.geometry().shows_edges())
    }

    /// What is marked of the draw's triangles, if marks are painted.
    #[inline(always)]
    pub(crate) fn marks(&self) -> Option<&'f Marks<'f>> {
        let is_painted = self.frame.ink.as_ref().is_some_and(Ink::has_marks);
        if is_painted { self.geometry().marks() } else { None }
    }

    /// What paints over the draw's colours: edges, its own or those of others, or marks.
    #[inline(always)]
    pub(crate) fn ink_over(&self) -> Option<&'f Ink> {
        let ink = self.frame.ink.as_ref();
        ink.filter(|_| self.ink().is_some() || self.outer.is_some() || self.marks().is_some())
    }

    #[inline(always)]
    pub(crate) fn vertices(&self) -> DrawVertices<'f> {
        self.frame.vertices(self.draw)
    }

    /// The varyings of the draw's vertices.
    #[inline(always)]
    pub(crate) fn varyings(&self) -> DrawVaryings<'f> {
        let (plan, stride) = (self.plan(), self.frame.pipeline(self.draw).stride());
        let values = &self.frame.varyings[plan.varyings..plan.varyings + plan.used.len() * stride];
        DrawVaryings { slots: self.frame.plan.slots(plan), values, stride }
    }

    /// Whether the draw is of lines or points that have one colour each and no mask, which
    /// might ask for more.
    pub(crate) fn has_flat_marks(&self) -> bool {
        let Geometry { shape, surface, .. } = self.geometry();
        self.frame.pipeline(self.draw).is_flat()
            && !matches!(shape, Shape::Triangles { .. })
            && matches!(surface, Surface::Opaque | Surface::Overlay | Surface::Translucent)
    }

    /// How many varyings a vertex has.
    #[inline(always)]
    pub(crate) fn varying_count(&self) -> usize {
        self.frame.pipeline(self.draw).varyings()
    }
}

/// Looks up varyings by the indices that a draw uses.
#[derive(Clone, Copy)]
pub(crate) struct DrawVaryings<'f> {
    slots: Slots<'f>,
    values: &'f [f32],
    stride: usize,
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
pub(crate) struct Work {
    /// Index of the pixel in the tile; bit 12 is set if the triangle may not
    /// cover the pixel's centre; from bit 13 on one more than the number of a sample:
    /// the one that it is to be, or with bit 12 one that the triangle covers.
    spot: u32,
    pub(crate) output: u32,
}

impl Work {
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

/// The pixels of one triangle in a list of [`Work`].
#[derive(Clone, Debug)]
pub(crate) struct Job {
    /// Index of the triangle among the tile's.
    pub(crate) place: u32,
    pub(crate) work: Range<usize>,
}
