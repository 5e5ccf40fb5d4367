//! Eight triangles in lanes, their vertices sorted, from which records are made.

use super::context::ShadeContext;
use super::layout::flag;
use super::perspective::perspective;
use crate::bin::TriangleRef;
use crate::primitive::{Column, Corners, Kind, SMALL, SetupTriangle, small_lanes, sorted_columns};
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Row, Simd, inlined, lanes_of, prelude::*};

/// Eight triangles, their vertices sorted.
pub(crate) struct SortedTriangles<S: Simd> {
    pub(crate) x: [I32<S>; 3],
    pub(crate) y: [I32<S>; 3],
    pub(crate) depth: [F32<S>; 3],
    pub(crate) inverse_w: [F32<S>; 3],
    /// The corners that the vertices are, or that the columns of cut weights
    /// belong to.
    pub(crate) corners: [Row; 3],
    /// Where the sorted vertices run clockwise on the screen.
    pub(crate) clockwise: Mask<S>,
    /// All but the corners.
    flags: I32<S>,
}

impl<S: Simd> SortedTriangles<S> {
    /// Triangles that are whole primitives.
    #[inline(always)]
    pub(crate) fn whole(simd: S, context: &ShadeContext<'_>, indices: [[u32; 3]; LANES]) -> Self {
        let vertices = context.draw.vertices;
        let columns = [0, 1, 2].each(
            #[inline(always)]
            |corner| {
                let vertices = indices.each(
                    #[inline(always)]
                    |indices| vertices.get(indices[corner]),
                );
                Column::new(simd, vertices, corner as i32)
            },
        );
        let (columns, reversed) = sorted_columns(columns);
        let [x, y] = [
            columns.each(
                #[inline(always)]
                |column| column.x,
            ),
            columns.each(
                #[inline(always)]
                |column| column.y,
            ),
        ];
        let zero = I32::splat(simd, 0);
        let wide = !small_lanes(simd, &columns, SMALL);
        let clockwise = if wide.any_true() {
            clockwise_wide(simd, x, y)
        } else {
            ((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])).simd_gt(zero)
        };
        let bit = inlined(
            #[inline(always)]
            |(mask, bit): (Mask<S>, i32)| mask.select(I32::splat(simd, bit), zero),
        );
        Self {
            x,
            y,
            depth: columns.each(
                #[inline(always)]
                |column| column.depth(),
            ),
            inverse_w: columns.each(
                #[inline(always)]
                |column| column.inverse_w(),
            ),
            corners: columns.each(
                #[inline(always)]
                |column| column.corner.into(),
            ),
            clockwise,
            flags: bit((clockwise ^ reversed, flag::BACK)) | bit((wide, flag::WIDE)) | flag::EDGES,
        }
    }

    /// Triangles of which some were cut, or belong to lines and points.
    #[inline(always)]
    pub(crate) fn made(simd: S, context: &ShadeContext<'_>, refs: [TriangleRef; LANES]) -> Self {
        let triangles = refs.each(
            #[inline(always)]
            |triangle| context.draw.triangle(triangle),
        );
        let column = inlined(
            #[inline(always)]
            |(vertex, member): (usize, usize)| {
                let values = triangles.each_ref().each(
                    #[inline(always)]
                    |triangle| triangle.vertices[vertex].0[member],
                );
                I32::simd_from(simd, values)
            },
        );
        let of_vertices = inlined(
            #[inline(always)]
            |member: usize| {
                [0, 1, 2].each(
                    #[inline(always)]
                    |vertex| column((vertex, member)),
                )
            },
        );
        let (x, y) = (of_vertices(0), of_vertices(1));
        Self {
            x,
            y,
            depth: of_vertices(2).each(
                #[inline(always)]
                |bits| bits.bitcast(),
            ),
            inverse_w: of_vertices(3).each(
                #[inline(always)]
                |bits| bits.bitcast(),
            ),
            corners: [0, 1, 2].each(
                #[inline(always)]
                |vertex| triangles.each_ref().each(|triangle| i32::from(corner_of(triangle, vertex))),
            ),
            clockwise: clockwise_wide(simd, x, y),
            flags: I32::simd_from(simd, triangles.each_ref().each(flags_of)),
        }
    }

    /// All that [`flag`] names.
    #[inline(always)]
    pub(crate) fn flags(&self, simd: S) -> I32<S> {
        let [a, b, c] = self.corners.each(
            #[inline(always)]
            |corner| I32::simd_from(simd, corner),
        );
        self.flags | a | (b << 2) | (c << 4)
    }

    /// The hot columns and the cold ones, without the ids, in a tile that begins at
    /// this pixel.
    #[inline(always)]
    pub(crate) fn heads(&self, simd: S, [left, top]: [i32; 2]) -> [[Row; LANES]; 3] {
        let Self { x, y, depth, inverse_w, clockwise, flags, .. } = self;
        let turned = inlined(
            #[inline(always)]
            |value: I32<S>| clockwise.select(value, -value),
        );
        let point = [x[0] - left * 256, y[0] - top * 256];
        // The edge from vertex 2 to 0, and that from 0 to 1.
        let right = [turned(y[2] - y[0]), turned(y[0] - y[1])];
        let down = [turned(x[0] - x[2]), turned(x[1] - x[0])];
        let (q, scale) = perspective(simd, *inverse_w);
        let both = inlined(
            #[inline(always)]
            |[low, high]: [I32<S>; 2]| (low & 0xffff) | (high << 16),
        );
        let none = I32::splat(simd, 0);
        let special = (*flags & (flag::WIDE | flag::CUT)).simd_gt(none);
        let steps = [both([right[0], down[0]]), both([right[1], down[1]])].each(
            #[inline(always)]
            |steps| special.select(none, steps),
        );
        let bits = [q[0], q[1], q[2], depth[0], depth[1], depth[2], scale].each(
            #[inline(always)]
            |value| value.bitcast::<I32<S>>(),
        );
        let columns = [
            [both(point), steps[0], steps[1], bits[0], bits[1], bits[2], none, none],
            [point[0], point[1], right[0], right[1], down[0], down[1], bits[6], none],
            [bits[3], bits[4], bits[5], none, none, none, none, none],
        ];
        columns.each(
            #[inline(always)]
            |columns| columns.each(Into::into),
        )
    }
}

fn corner_of(triangle: &SetupTriangle, vertex: usize) -> u8 {
    match triangle.corners {
        Corners::Whole(corners) => corners[vertex],
        Corners::Cut { order, .. } | Corners::Ends(order) => order[vertex],
    }
}

fn flags_of(triangle: &SetupTriangle) -> i32 {
    let is_wide = [0, 1].into_iter().any(|axis| {
        let [low, high] = triangle.extent(axis);
        high - low >= SMALL
    });
    let is_cut = !matches!(triangle.corners, Corners::Whole(_));
    let flags = [
        (!triangle.front_facing, flag::BACK),
        (triangle.kind == Kind::Triangle, flag::EDGES),
        (is_wide, flag::WIDE),
        (is_cut, flag::CUT),
    ];
    flags.into_iter().filter(|(is_set, _)| *is_set).fold(0, |flags, (_, flag)| flags | flag)
}

/// Where the vertices run clockwise, for triangles of any size.
#[inline(always)]
fn clockwise_wide<S: Simd>(simd: S, x: [I32<S>; 3], y: [I32<S>; 3]) -> Mask<S> {
    let [ux, uy, vx, vy]: [Row; 4] = [x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]].each(Into::into);
    let sign = lanes_of(
        #[inline(always)]
        |lane| {
            // Differences of up to 2^25: their products are exact in f64.
            let [ux, uy, vx, vy] = [ux, uy, vx, vy].each(
                #[inline(always)]
                |column| f64::from(column[lane]),
            );
            i32::from(ux * vy - uy * vx > 0.0)
        },
    );
    I32::simd_from(simd, sign).simd_gt(I32::splat(simd, 0))
}
