//! The stage that sets primitives up and bins them: chunk by chunk.

use super::options::FrameOptions;
use crate::Culling;
use crate::bin::{Chunk, EarlierEntries, Grid, MovingChunk};
use crate::clip;
use crate::geometry::{PointSizes, Shape};
use crate::line::LineStyle;
use crate::pass::Recorded;
use crate::point::{PlainPoints, PointStyle};
use crate::setup::{EightPrimitives, Setup};
use crate::simd::{LANES, Simd, Token, at_level};
use crate::vertex::{DrawVertices, ScreenVertex};
use crate::view::{DrawPlan, Plan};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// What set-up reads.
#[derive(Clone, Copy)]
pub(super) struct SetUp<'a> {
    pub(super) pass: &'a [Recorded<'a>],
    pub(super) plan: &'a Plan,
    pub(super) places: &'a [ScreenVertex],
    pub(super) grid: &'a Grid,
    /// Internal pixels for each pixel of the target and axis.
    pub(super) axis: u32,
    pub(super) token: Token,
}

impl SetUp<'_> {
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

    /// Sets up those primitives of a chunk again that were moved, and what is set up with
    /// them. `earlier` is room to be used again.
    pub(super) fn moved(&self, chunk: &mut Chunk, moved: &[bool], earlier: &mut EarlierEntries) {
        if !chunk.set_aside(earlier) {
            chunk.reset(chunk.ordinals.clone(), chunk.blend_mode);
            return self.chunk(chunk);
        }
        for (draw, range) in self.plan.parts(chunk.ordinals.clone()) {
            let mut setup = self.part(draw, chunk);
            let place = setup.index_in_chunk(range.start);
            let moved = &moved[place as usize..place as usize + range.len()];
            let marks = (moved, &mut *earlier);
            let (token, indices) = (self.token, range.start as usize..range.end as usize);
            match (&self.pass[draw.draw].geometry.shape, self.plan.points(draw)) {
                (&Shape::Triangles { triangles, culling, .. }, _) => {
                    setup.culling = culling;
                    let triangles = (range.start, &triangles[indices]);
                    at_level!(token, simd => set_up_moved_triangles(simd, &mut setup, triangles, marks));
                }
                (&Shape::Points { points, sizes, .. }, Some(plain)) => {
                    let points = (range.start, &points[indices]);
                    let looks = (plain, &sizes);
                    at_level!(token, simd => set_up_moved_points(simd, &mut setup, (points, looks), marks));
                }
                // No tile lists any other line or point so far.
                _ => self.set_up_part(setup, draw, range),
            }
        }
        chunk.sort();
    }

    /// Sets up the primitives that move, which are listed apart from those of their chunk.
    pub(super) fn apart(&self, chunk: &Chunk, moving: &mut MovingChunk) {
        moving.begin(chunk);
        let (places, listed) = moving.parts();
        let mut numbers = Vec::with_capacity(places.len());
        for (draw, range) in self.plan.parts(chunk.ordinals.clone()) {
            let first = draw.ordinals.start.wrapping_sub(chunk.ordinals.start);
            let number =
                |&place: &u32| Some(place.wrapping_sub(first)).filter(|number| range.contains(number));
            numbers.clear();
            numbers.extend(places.iter().filter_map(number));
            let (token, mut setup) = (self.token, self.part(draw, listed));
            match (&self.pass[draw.draw].geometry.shape, self.plan.points(draw)) {
                (&Shape::Triangles { triangles, culling, .. }, _) => {
                    setup.culling = culling;
                    at_level!(token, simd => set_up_listed_triangles(simd, &mut setup, (&numbers, triangles)));
                }
                (&Shape::Points { points, sizes, .. }, Some(plain)) => {
                    let looks = (plain, &sizes);
                    at_level!(token, simd => set_up_listed_points(simd, &mut setup, (&numbers, points), looks));
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
            places: &self.places[draw.places.clone()],
            pipeline: self.pass[draw.draw].pipeline,
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
        match (&self.pass[draw.draw].geometry.shape, self.plan.points(draw)) {
            (&Shape::Triangles { triangles, culling, .. }, _) => {
                setup.culling = culling;
                let triangles = &triangles[indices];
                at_level!(token, simd => set_up_triangles(simd, &mut setup, range.start, triangles));
            }
            (&Shape::Lines { segments, width, smoothing, depth_bias }, _) => {
                let style = LineStyle::new((width, smoothing), depth_bias, axis, multisampled);
                for index in range {
                    setup.segment(index, segments[index as usize], style);
                }
            }
            (&Shape::Points { points, sizes, .. }, Some(plain)) => {
                let points = (range.start, &points[indices]);
                at_level!(token, simd => set_up_points(simd, &mut setup, points, (plain, &sizes)));
            }
            (&Shape::Points { points, sizes, shape, smoothing, depth_bias }, None) => {
                let style_of = sizes.each(|size| PointStyle::new((size, smoothing), shape, depth_bias, axis));
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
    (first, points): (u32, &[u32]),
    looks: (&PlainPoints, &PointSizes<'_>),
) {
    for (group, points) in points.chunks(LANES).enumerate() {
        let first = first + (group * LANES) as u32;
        setup.eight_points(simd, &EightPrimitives::consecutive(first, points), looks);
    }
}

/// Sets up triangles of a draw by their numbers.
#[inline(always)]
fn set_up_listed_triangles<S: Simd>(
    simd: S,
    setup: &mut Setup<'_>,
    (numbers, triangles): (&[u32], &[[u32; 3]]),
) {
    for numbers in numbers.chunks(LANES) {
        setup.eight_triangles(simd, &EightPrimitives::listed(numbers, triangles));
    }
}

/// Sets up points of a draw by their numbers.
#[inline(always)]
fn set_up_listed_points<S: Simd>(
    simd: S,
    setup: &mut Setup<'_>,
    (numbers, points): (&[u32], &[u32]),
    looks: (&PlainPoints, &PointSizes<'_>),
) {
    for numbers in numbers.chunks(LANES) {
        setup.eight_points(simd, &EightPrimitives::listed(numbers, points), looks);
    }
}

/// [`set_up_triangles`] where some were moved.
#[inline(always)]
fn set_up_moved_triangles<S: Simd>(
    simd: S,
    setup: &mut Setup<'_>,
    triangles: (u32, &[[u32; 3]]),
    marks: (&[bool], &mut EarlierEntries),
) {
    set_up_moved(
        setup,
        triangles,
        marks,
        #[inline(always)]
        |setup, first, triangles| {
            setup.eight_triangles(simd, &EightPrimitives::consecutive(first, triangles));
        },
    );
}

/// [`set_up_points`] where some were moved.
#[inline(always)]
fn set_up_moved_points<S: Simd>(
    simd: S,
    setup: &mut Setup<'_>,
    (points, looks): ((u32, &[u32]), (&PlainPoints, &PointSizes<'_>)),
    marks: (&[bool], &mut EarlierEntries),
) {
    set_up_moved(
        setup,
        points,
        marks,
        #[inline(always)]
        |setup, first, points| {
            setup.eight_points(simd, &EightPrimitives::consecutive(first, points), looks);
        },
    );
}

/// Sets up those groups of eight primitives that have moved ones; what the others are listed by is
/// kept.
#[inline(always)]
fn set_up_moved<T>(
    setup: &mut Setup<'_>,
    (first, primitives): (u32, &[T]),
    (moved, earlier): (&[bool], &mut EarlierEntries),
    mut set_up: impl FnMut(&mut Setup<'_>, u32, &[T]),
) {
    let place = setup.index_in_chunk(first);
    let mut kept = 0;
    let groups = primitives.chunks(LANES).zip(moved.chunks(LANES));
    for ((primitives, moved), at) in groups.zip((0..).step_by(LANES)) {
        if moved.contains(&true) {
            setup.chunk.take_back(earlier, place + kept..place + at);
            set_up(setup, first + at, primitives);
            kept = at + primitives.len() as u32;
        }
    }
    setup.chunk.take_back(earlier, place + kept..place + primitives.len() as u32);
}
