//! The stage that sets primitives up and bins them: chunk by chunk.

use super::layout::FrameOptions;
use crate::bin::{Chunk, Grid, MovingChunk};
use crate::geometry::{PointSizes, Shape};
use crate::line::LineStyle;
use crate::pass::RecordedDraw;
use crate::point::{PlainPoints, PointStyle};
use crate::setup::{EightPrimitives, Setup};
use crate::simd::{LANES, Simd, Token, at_level};
use crate::vertex::{DrawVertices, ScreenVertex};
use crate::view::{DrawPlan, Plan};
use crate::{Culling, clip};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// What set-up reads.
#[derive(Clone, Copy)]
pub(super) struct SetUpContext<'a> {
    pub(super) pass: &'a [RecordedDraw<'a>],
    pub(super) plan: &'a Plan,
    pub(super) screen_vertices: &'a [ScreenVertex],
    pub(super) grid: &'a Grid,
    /// Internal pixels for each pixel of the target and axis.
    pub(super) axis: u32,
    pub(super) token: Token,
}

impl SetUpContext<'_> {
    /// Set-up and binning: every worker takes a chunk at a time.
    pub(super) fn all(&self, options: FrameOptions<'_>, chunks: &mut [Chunk]) {
        let many = chunks.len() > 1;
        let rest = Mutex::new(chunks.iter_mut());
        let next = || rest.lock().unwrap_or_else(PoisonError::into_inner).next();
        options.workers.run(many, |_| {
            while let Some(chunk) = next()
                && !options.is_cancelled()
            {
                self.chunk(chunk);
            }
        });
    }

    /// Sets up the primitives of a chunk that is empty.
    pub(super) fn chunk(&self, chunk: &mut Chunk) {
        for (draw, range) in self.plan.parts(chunk.ordinals.clone()) {
            self.set_up_part(self.part(draw, chunk), draw, range);
        }
        chunk.sort();
    }

    /// Sets up the primitives of a chunk that is not empty.
    pub(super) fn again(&self, chunk: &mut Chunk) {
        chunk.reset(chunk.ordinals.clone(), chunk.blend_mode);
        self.chunk(chunk);
    }

    /// Sets up the primitives that move, which are listed apart from those of their chunk.
    pub(super) fn apart(&self, chunk: &Chunk, moving: &mut MovingChunk) {
        moving.begin(chunk);
        let (indices, listed) = moving.parts();
        let mut numbers = Vec::with_capacity(indices.len());
        for (draw, range) in self.plan.parts(chunk.ordinals.clone()) {
            let first = draw.ordinals.start.wrapping_sub(chunk.ordinals.start);
            let number =
                |&index: &u32| Some(index.wrapping_sub(first)).filter(|number| range.contains(number));
            numbers.clear();
            numbers.extend(indices.iter().filter_map(number));
            let (token, mut setup) = (self.token, self.part(draw, listed));
            match (&self.pass[draw.draw()].geometry.shape, self.plan.points(draw)) {
                (&Shape::Triangles { triangles, culling, .. }, _) => {
                    setup.culling = culling;
                    at_level!(token, simd => set_up_listed_triangles(simd, &mut setup, &numbers, triangles));
                }
                (&Shape::Points { points, sizes, .. }, Some(plain)) => {
                    at_level!(token, simd => set_up_listed_points(simd, &mut setup, &numbers, points, plain, &sizes));
                }
                // None of these is ever listed apart.
                _ => {}
            }
        }
        listed.sort();
    }

    /// The set-up of one draw's primitives.
    fn part<'s>(&'s self, draw: &DrawPlan, chunk: &'s mut Chunk) -> Setup<'s> {
        let vertices = DrawVertices {
            slots: self.plan.slots(draw),
            screen_vertices: &self.screen_vertices[draw.screen_vertices()],
            pipeline: self.pass[draw.draw()].pipeline,
            token: self.token,
        };
        Setup {
            grid: self.grid,
            volume: clip::volume(self.grid.viewport),
            vertices,
            first: draw.ordinals.start,
            culling: Culling::None,
            chunk,
        }
    }

    /// Sets up some primitives of one draw.
    fn set_up_part(&self, mut setup: Setup<'_>, draw: &DrawPlan, range: Range<u32>) {
        let Self { axis, token, .. } = *self;
        let multisampled = setup.grid.pattern.count() > 1;
        let indices = range.start as usize..range.end as usize;
        match (&self.pass[draw.draw()].geometry.shape, self.plan.points(draw)) {
            (&Shape::Triangles { triangles, culling, .. }, _) => {
                setup.culling = culling;
                let triangles = &triangles[indices];
                at_level!(token, simd => set_up_triangles(simd, &mut setup, range.start, triangles));
            }
            (&Shape::Lines { segments, width, smoothing, depth_bias }, _) => {
                let style = LineStyle::new(width, smoothing, depth_bias, axis, multisampled);
                for index in range {
                    setup.segment(index, segments[index as usize], style);
                }
            }
            (&Shape::Points { points, sizes, .. }, Some(plain)) => {
                let points = &points[indices];
                at_level!(token, simd => set_up_points(simd, &mut setup, range.start, points, plain, &sizes));
            }
            (&Shape::Points { points, sizes, shape, smoothing, depth_bias }, None) => {
                let style_of = sizes.each(|size| PointStyle::new(size, smoothing, shape, depth_bias, axis));
                for index in range {
                    setup.point(index, points[index as usize], style_of(index));
                }
            }
        }
    }
}

#[inline(always)]
fn set_up_triangles<S: Simd>(simd: S, setup: &mut Setup<'_>, first: u32, triangles: &[[u32; 3]]) {
    for (group, triangles) in triangles.chunks(LANES).enumerate() {
        let first = first + (group * LANES) as u32;
        setup.eight_triangles(simd, &EightPrimitives::consecutive(first, triangles));
    }
}

#[inline(always)]
fn set_up_points<S: Simd>(
    simd: S,
    setup: &mut Setup<'_>,
    first: u32,
    points: &[u32],
    plain: &PlainPoints,
    sizes: &PointSizes<'_>,
) {
    for (group, points) in points.chunks(LANES).enumerate() {
        let first = first + (group * LANES) as u32;
        setup.eight_points(simd, &EightPrimitives::consecutive(first, points), plain, sizes);
    }
}

/// Sets up triangles of a draw by their numbers.
#[inline(always)]
fn set_up_listed_triangles<S: Simd>(simd: S, setup: &mut Setup<'_>, numbers: &[u32], triangles: &[[u32; 3]]) {
    for numbers in numbers.chunks(LANES) {
        setup.eight_triangles(simd, &EightPrimitives::listed(numbers, triangles));
    }
}

/// Sets up points of a draw by their numbers.
#[inline(always)]
fn set_up_listed_points<S: Simd>(
    simd: S,
    setup: &mut Setup<'_>,
    numbers: &[u32],
    points: &[u32],
    plain: &PlainPoints,
    sizes: &PointSizes<'_>,
) {
    for numbers in numbers.chunks(LANES) {
        setup.eight_points(simd, &EightPrimitives::listed(numbers, points), plain, sizes);
    }
}
