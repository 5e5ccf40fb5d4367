//! Vectors whose lanes all belong to one triangle.

use super::run::Batch;
use super::weights::{TriangleLanes, VertexColumns};
use super::{CornerValues, LaneTriangles, ShadeContext};
use crate::setup::{Corners, Kind, SMALL, SetupTriangle};
use crate::simd::{Each, F32, I32, LANES, Simd, prelude::*};

/// Makes a triangle ready, and its varyings in `values`.
#[inline(always)]
pub(super) fn uniform<'f, S: Simd>(
    simd: S,
    context: &ShadeContext<'f>,
    place: u32,
    values: &mut [CornerValues],
) -> Batch<'f, S> {
    // Apart, so that it is compiled once for all pipelines.
    simd.vectorize(
        #[inline(always)]
        || prepare(simd, context, place, values),
    )
}

#[inline(always)]
fn prepare<'f, S: Simd>(
    simd: S,
    context: &ShadeContext<'f>,
    place: u32,
    values: &mut [CornerValues],
) -> Batch<'f, S> {
    let place = context.places[place as usize];
    let triangle = context.frame.triangle(place);
    let mut lanes = TriangleLanes::new(simd, columns(simd, &triangle), is_wide(&triangle));
    let corners = match triangle.corners {
        Corners::Whole(corners) => corners,
        Corners::Cut { weights, order } => {
            lanes = lanes.cut(&context.chunk(place).weights[weights as usize]);
            order
        }
    };
    let primitive = triangle.ordinal - context.plan().ordinals.start;
    load_values(simd, context, (primitive, corners), values);
    let triangles = LaneTriangles {
        geometry: context.geometry(),
        primitives: [primitive; LANES],
        corners: corners.each(
            #[inline(always)]
            |corner| [i32::from(corner); LANES],
        ),
        backs: if triangle.front_facing { 0 } else { u64::MAX },
        has_edges: triangle.kind == Kind::Triangle,
    };
    Batch { triangle: lanes, triangles }
}

#[inline(always)]
fn columns<S: Simd>(simd: S, triangle: &SetupTriangle) -> VertexColumns<S> {
    VertexColumns {
        x: triangle.vertices.each(
            #[inline(always)]
            |vertex| I32::splat(simd, vertex.raw()[0]),
        ),
        y: triangle.vertices.each(
            #[inline(always)]
            |vertex| I32::splat(simd, vertex.raw()[1]),
        ),
        depth: triangle.vertices.each(
            #[inline(always)]
            |vertex| F32::splat(simd, vertex.depth()),
        ),
        inverse_w: triangle.vertices.each(
            #[inline(always)]
            |vertex| F32::splat(simd, vertex.inverse_w()),
        ),
    }
}

fn is_wide(triangle: &SetupTriangle) -> bool {
    [0, 1]
        .each(
            #[inline(always)]
            |axis| triangle.extent(axis),
        )
        .iter()
        .any(|[low, high]| high - low >= SMALL)
}

#[inline(always)]
fn load_values<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    (primitive, corners): (u32, [u8; 3]),
    values: &mut [CornerValues],
) {
    let stride = values.len();
    if stride == 0 {
        return;
    }
    let indices = context.geometry().corners(primitive);
    let rows = corners.each(
        #[inline(always)]
        |corner| context.varyings_of(indices[usize::from(corner)], stride),
    );
    for (index, value) in values.iter_mut().enumerate() {
        *value = CornerValues::new(
            simd,
            rows.each(
                #[inline(always)]
                |row| [row[index]; LANES],
            ),
        );
    }
}
