//! Vectors whose lanes belong to triangles of their own: small triangles share
//! them.

use super::run::Batch;
use super::weights::{TriangleLanes, VertexColumns};
use super::{CornerValues, LaneTriangles, ShadeContext, Work};
use crate::setup::{Column, small_lanes, sorted_columns};
use crate::simd::{Each, I32, LANES, Mask, Simd, lanes_of, prelude::*};

/// Pixels that wait until they fill a vector.
#[derive(Default)]
pub(super) struct Mixed {
    waiting: [(u32, Work); 2 * LANES],
    count: usize,
}

impl Mixed {
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.count >= LANES
    }

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Adds fewer than a vector's pixels of one triangle.
    #[inline(always)]
    pub(super) fn extend(&mut self, place: u32, work: &[Work]) {
        for &work in work {
            self.waiting[self.count] = (place, work);
            self.count += 1;
        }
    }

    /// Takes up to a vector's pixels out.
    #[inline(always)]
    fn take(&mut self) -> ([(u32, Work); LANES], usize) {
        let count = self.count.min(LANES);
        let taken = lanes_of(
            #[inline(always)]
            |lane| self.waiting[lane.min(count - 1)],
        );
        self.waiting.copy_within(LANES.., 0);
        self.count -= count;
        (taken, count)
    }
}

/// Makes the next vector of `waiting` pixels ready.
#[inline(always)]
pub(super) fn mixed<'w, 'f, S: Simd>(
    simd: S,
    context: &ShadeContext<'f>,
    (waiting, together): (&mut Mixed, &'w mut [Work; LANES]),
    values: &mut [CornerValues],
) -> (Batch<'f, S>, &'w [Work]) {
    // Apart, so that it is compiled once for all pipelines.
    simd.vectorize(
        #[inline(always)]
        || prepare(simd, context, (waiting, together), values),
    )
}

#[inline(always)]
fn prepare<'w, 'f, S: Simd>(
    simd: S,
    context: &ShadeContext<'f>,
    (waiting, together): (&mut Mixed, &'w mut [Work; LANES]),
    values: &mut [CornerValues],
) -> (Batch<'f, S>, &'w [Work]) {
    let (taken, count) = waiting.take();
    *together = taken.each(
        #[inline(always)]
        |(_, work)| work,
    );
    let primitives = taken.each(
        #[inline(always)]
        |(place, _)| context.primitive(place),
    );
    let geometry = context.geometry();
    let indices = primitives.each(
        #[inline(always)]
        |primitive| geometry.corners(primitive),
    );
    let vertices = context.vertices();
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
    let corners: [[i32; LANES]; 3] = [0, 1, 2].each(
        #[inline(always)]
        |i| columns[i].corner.into(),
    );
    let stride = values.len();
    if stride > 0 {
        let rows: [[&[f32]; LANES]; 3] = corners.each(
            #[inline(always)]
            |corner| {
                lanes_of(
                    #[inline(always)]
                    |lane| context.varyings_of(indices[lane][corner[lane] as usize], stride),
                )
            },
        );
        for (index, value) in values.iter_mut().enumerate() {
            *value = CornerValues::new(
                simd,
                rows.each(
                    #[inline(always)]
                    |rows| {
                        rows.each(
                            #[inline(always)]
                            |row| row[index],
                        )
                    },
                ),
            );
        }
    }
    let clockwise = clockwise(simd, &columns);
    let backs = (clockwise ^ reversed).to_bitmask();
    let triangles = LaneTriangles { geometry, primitives, corners, backs, has_edges: true };
    let wide = !small_lanes(simd, &columns);
    let vertices = VertexColumns {
        x: columns.each(
            #[inline(always)]
            |column| column.x,
        ),
        y: columns.each(
            #[inline(always)]
            |column| column.y,
        ),
        depth: columns.each(
            #[inline(always)]
            |column| column.depth(),
        ),
        inverse_w: columns.each(
            #[inline(always)]
            |column| column.inverse_w(),
        ),
    };
    let triangle = TriangleLanes::new(simd, vertices, wide.any_true());
    (Batch { triangle, triangles }, &together[..count])
}

/// Where the sorted vertices run clockwise on the screen.
#[inline(always)]
fn clockwise<S: Simd>(simd: S, [a, b, c]: &[Column<S>; 3]) -> Mask<S> {
    // Differences of up to 2^25 fit f64 products exactly; f32 would not do.
    let [ux, uy, vx, vy]: [[i32; LANES]; 4] = [b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y].each(Into::into);
    let sign: [i32; LANES] = lanes_of(
        #[inline(always)]
        |lane| {
            let [ux, uy, vx, vy] = [ux, uy, vx, vy].each(
                #[inline(always)]
                |column| f64::from(column[lane]),
            );
            i32::from(ux * vy - uy * vx > 0.0)
        },
    );
    I32::simd_from(simd, sign).simd_gt(I32::splat(simd, 0))
}
