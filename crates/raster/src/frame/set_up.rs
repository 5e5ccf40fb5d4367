//! The stage that sets primitives up and bins them: chunk by chunk.

use super::Plan;
use super::stages::How;
use crate::Culling;
use crate::bin::{Chunk, Grid};
use crate::clip;
use crate::geometry::Shape;
use crate::line::LineStyle;
use crate::pass::Recorded;
use crate::point::PointStyle;
use crate::setup::Setup;
use crate::simd::{Simd, Token, at_level};
use crate::vertex::{DrawVertices, ScreenVertex};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Set-up and binning: every worker takes a chunk at a time.
pub(super) fn set_up(
    pass: &[Recorded<'_>],
    plan: &Plan,
    places: &[ScreenVertex],
    (grid, axis): (&Grid, u32),
    how: How<'_>,
    chunks: &mut [Chunk],
) {
    let many = chunks.len() > 1;
    let rest = Mutex::new(chunks.iter_mut());
    let next = || rest.lock().unwrap_or_else(PoisonError::into_inner).next();
    how.workers.run(many, |_| {
        while let Some(chunk) = next()
            && !how.is_cancelled()
        {
            set_up_chunk(pass, plan, places, (grid, axis), how.token, chunk);
        }
    });
}

/// Sets up the primitives of a chunk that is empty.
pub(super) fn set_up_chunk(
    pass: &[Recorded<'_>],
    plan: &Plan,
    places: &[ScreenVertex],
    (grid, axis): (&Grid, u32),
    token: Token,
    chunk: &mut Chunk,
) {
    for (draw, range) in plan.parts(chunk.ordinals.clone()) {
        let recorded = &pass[draw.draw];
        let vertices = DrawVertices {
            slots: plan.slots(draw),
            places: &places[draw.places.clone()],
            pipeline: recorded.pipeline,
            token,
        };
        let setup = Setup {
            grid,
            volume: &clip::volume(grid.viewport),
            vertices,
            first: draw.ordinals.start,
            culling: Culling::None,
            chunk,
        };
        set_up_part(setup, &recorded.geometry.shape, axis, token, range);
    }
    chunk.sort();
}

/// Sets up some primitives of one draw.
fn set_up_part(mut setup: Setup<'_>, shape: &Shape<'_>, axis: u32, token: Token, range: Range<u32>) {
    let multisampled = setup.grid.pattern.count() > 1;
    match *shape {
        Shape::Triangles { triangles, culling, .. } => {
            setup.culling = culling;
            let triangles = &triangles[range.start as usize..range.end as usize];
            at_level!(token, simd => set_up_triangles(simd, &mut setup, range.start, triangles));
        }
        Shape::Lines { segments, width, outline, toward_eye } => {
            let style = LineStyle::new((width, outline), toward_eye, axis, multisampled);
            for index in range {
                setup.segment(index, segments[index as usize], style);
            }
        }
        Shape::Points { points, sizes, shape, outline, toward_eye } => {
            let style_of = sizes.each(|size| PointStyle::new((size, outline), shape, toward_eye, axis));
            for index in range {
                setup.point(index, points[index as usize], style_of(index));
            }
        }
    }
}

#[inline(always)]
fn set_up_triangles<S: Simd>(simd: S, setup: &mut Setup<'_>, first: u32, triangles: &[[u32; 3]]) {
    for (group, triangles) in triangles.chunks(crate::simd::LANES).enumerate() {
        setup.eight_triangles(simd, first + (group * crate::simd::LANES) as u32, triangles);
    }
}
