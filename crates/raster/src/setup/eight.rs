//! Culling and binning of whole triangles, eight at a time with one in each lane.
//!
//! Triangles that need cutting, or whose edge functions need more than 32 bits, are handled one
//! by one instead ([`Setup::triangle`]).
//!
//! [`EightPrimitives`] are up to eight primitives of one draw that are set up together.

use super::Setup;
use crate::Culling;
use crate::bin::Entry;
use crate::primitive::SMALL;
use crate::simd::{I32, InlineMap, LANES, Mask, Simd, lanes_of, prelude::*, transposed};
use crate::vertex::ScreenVertex;

/// What eight triangles look like on the screen.
struct ScreenTriangles<S: Simd> {
    /// x and y of the corners.
    corners: [[I32<S>; 2]; 3],
    /// Least and greatest coordinates, by axis.
    extent: [[I32<S>; 2]; 2],
    /// Twice the signed area, where small.
    area: I32<S>,
    /// The lanes whose triangles can be handled here: all vertices are snapped, and the bounding box is
    /// smaller than [`SMALL`] on both axes.
    plain: Mask<S>,
}

impl<S: Simd> ScreenTriangles<S> {
    #[inline(always)]
    fn new(simd: S, vertices: [[&ScreenVertex; LANES]; 3]) -> Self {
        let [a, b, c] = vertices.each(
            #[inline(always)]
            |vertices| {
                transposed(
                    simd,
                    vertices.each(
                        #[inline(always)]
                        |vertex| &vertex.0,
                    ),
                )
            },
        );
        // A vertex that is not snapped has a coordinate that no vertex on the grid has.
        let nowhere = I32::splat(simd, ScreenVertex::NOWHERE);
        let special = a[0].simd_eq(nowhere) | b[0].simd_eq(nowhere) | c[0].simd_eq(nowhere);
        let extent = [0, 1].each(
            #[inline(always)]
            |axis| {
                let [a, b, c] = [a[axis], b[axis], c[axis]];
                [a.min(b).min(c), a.max(b).max(c)]
            },
        );
        let small = I32::splat(simd, SMALL);
        let [x, y] = extent.each(
            #[inline(always)]
            |[low, high]| (high - low).simd_lt(small),
        );
        // Twice the signed area, positive if clockwise on the screen. It may overflow in lanes
        // that are not small, where it is not used.
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let corners = [[a[0], a[1]], [b[0], b[1]], [c[0], c[1]]];
        Self { corners, extent, area, plain: !special & x & y }
    }
}

impl<S: Simd> ScreenTriangles<S> {
    /// The lanes whose triangles cover none of the centres of the 2×2 pixels that begin at
    /// `first`. Many triangles of a fine mesh lie between all centres; they are culled here, before
    /// any tile lists them.
    #[inline(always)]
    fn miss(&self, simd: S, first: [I32<S>; 2]) -> Mask<S> {
        let zero = I32::splat(simd, 0);
        let clockwise = self.area.simd_gt(zero);
        let point = first.each(
            #[inline(always)]
            |pixel| (pixel << 8) + 128,
        );
        // One value for each of the four centres. Its sign bit is set once the centre lies
        // outside any edge, because the values of all edges are combined by OR.
        let mut outside = [zero; 4];
        let [a, b, c] = self.corners;
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let steps = [from[1] - to[1], to[0] - from[0]];
            let [right, down] = steps.each(
                #[inline(always)]
                |step| clockwise.select(step, -step),
            );
            // The top-left rule: for edges that do not own the points on them, the value is one
            // less, so that the sign alone decides.
            let inclusive = right.simd_gt(zero) | (right.simd_eq(zero) & down.simd_gt(zero));
            let value = right * (point[0] - from[0]) + down * (point[1] - from[1]);
            let value = value - inclusive.select(zero, I32::splat(simd, 1));
            let (right, down) = (right << 8, down << 8);
            let values = [value, value + right, value + down, value + right + down];
            for (outside, value) in outside.iter_mut().zip(values) {
                *outside |= value;
            }
        }
        let [a, b, c, d] = outside;
        (a & b & c & d).simd_lt(zero)
    }
}

impl Setup<'_> {
    /// Up to eight triangles of the draw.
    #[inline(always)]
    pub(crate) fn eight_triangles<S: Simd>(&mut self, simd: S, triangles: &EightPrimitives<'_, [u32; 3]>) {
        let vertices = [0, 1, 2].each(
            #[inline(always)]
            |corner| {
                lanes_of(
                    #[inline(always)]
                    |lane| self.vertices.get(triangles.indices[lane][corner]),
                )
            },
        );
        let eight = ScreenTriangles::new(simd, vertices);
        let lanes = triangles.lanes();
        let plain = eight.plain.to_bitmask() & lanes;
        let (drawn, pixels) = self.visible(simd, &eight, plain);
        self.chunk.stats.culled += u64::from((plain & !drawn).count_ones());
        self.chunk.stats.set_up += u64::from(drawn.count_ones());
        if plain == lanes && self.push_together(simd, triangles.numbers, drawn, pixels) {
            return;
        }
        let [columns, rows] = pixels.each(
            #[inline(always)]
            |range| range.each(<[i32; LANES]>::from),
        );
        // One after the other, because tiles list their triangles in the order of primitives.
        let mut rest = drawn | (lanes & !plain);
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize % LANES;
            rest &= rest - 1;
            let primitive = triangles.numbers[lane];
            if plain >> lane & 1 != 0 {
                let ends = |[begin, end]: &[[i32; LANES]; 2]| [begin[lane], end[lane]];
                self.push_box(primitive, ends(&columns), ends(&rows));
            } else {
                self.triangle(primitive, *triangles.indices[lane]);
            }
        }
    }

    /// The `plain` lanes that may be visible, and the first and last columns and rows in which they may have
    /// samples.
    #[inline(always)]
    fn visible<S: Simd>(&self, simd: S, eight: &ScreenTriangles<S>, plain: u64) -> (u64, [[I32<S>; 2]; 2]) {
        let zero = I32::splat(simd, 0);
        let faces = match self.culling {
            Culling::None => !eight.area.simd_eq(zero),
            Culling::Back => eight.area.simd_lt(zero),
            Culling::Front => eight.area.simd_gt(zero),
        };
        let grid = self.grid;
        let [least, greatest] = grid.pattern.reach();
        let mut visible = faces;
        let pixels = [(0, grid.viewport.width), (1, grid.viewport.height)].each(
            #[inline(always)]
            |(axis, side)| {
                // The first and last pixel whose samples can lie between the extremes. A pixel's
                // samples lie at offsets from `least` to `greatest`, in 1/256 pixel.
                let [low, high] = eight.extent[axis];
                let begin = (low + (255 - greatest)) >> 8;
                let end = (high - least) >> 8;
                visible = visible & begin.simd_le(end) & end.simd_ge(zero);
                visible &= begin.simd_lt(I32::splat(simd, side as i32));
                [begin, end]
            },
        );
        if grid.pattern.count() == 1 {
            let [x, y] = pixels.each(
                #[inline(always)]
                |[begin, end]| (end - begin).simd_le(I32::splat(simd, 1)),
            );
            visible &= !(x & y & eight.miss(simd, [pixels[0][0], pixels[1][0]]));
        }
        (visible.to_bitmask() & plain, pixels)
    }

    /// Bins the drawn triangles if each of them lies in a single tile, which small ones mostly do.
    /// Returns false, and does nothing, if any does not.
    #[inline(always)]
    fn push_together<S: Simd>(
        &mut self,
        simd: S,
        primitives: [u32; LANES],
        drawn: u64,
        pixels: [[I32<S>; 2]; 2],
    ) -> bool {
        let grid = self.grid;
        let apron = grid.apron as i32;
        let [columns, rows] = [(0, grid.viewport.width), (1, grid.viewport.height)].each(
            #[inline(always)]
            |(axis, side)| {
                let [begin, end] = pixels[axis];
                [(begin - apron).max(0), (end + apron).min(side as i32 - 1)].each(
                    #[inline(always)]
                    |pixel| grid.tiles_at(pixel),
                )
            },
        );
        let drawn = Mask::from_bitmask(simd, drawn);
        let alone = columns[0].simd_eq(columns[1]) & rows[0].simd_eq(rows[1]);
        if (drawn & !alone).any_true() {
            return false;
        }
        let tiles = (rows[0] * grid.columns as i32 + columns[0]).bitcast();
        let indices = self.indices_in_chunk(simd, primitives);
        self.chunk.push_some(drawn, tiles, indices, Entry::primitive);
        true
    }

    /// Bins a small triangle by its bounding box: at most two tiles each way,
    /// more only where tiles are smaller than usual.
    #[inline(always)]
    fn push_box(&mut self, primitive: u32, columns: [i32; 2], rows: [i32; 2]) {
        let tiles = self.grid.tiles_that_see(columns, rows);
        let entry = Entry::primitive(self.index_in_chunk(primitive));
        for row in tiles.rows {
            for column in tiles.columns.clone() {
                self.chunk.push(row * self.grid.columns + column, entry);
            }
        }
    }
}

/// One primitive in each lane; unused lanes repeat the last one.
pub(crate) struct EightPrimitives<'p, T> {
    /// Their numbers in the draw, increasing.
    pub(crate) numbers: [u32; LANES],
    /// The indices of their vertices.
    pub(crate) indices: [&'p T; LANES],
    count: usize,
}

impl<'p, T> EightPrimitives<'p, T> {
    /// Consecutive ones from `first` on; at least one.
    #[inline(always)]
    pub(crate) fn consecutive(first: u32, indices: &'p [T]) -> Self {
        // Nearly always eight.
        if let Some(eight) = indices.first_chunk::<LANES>() {
            let numbers = lanes_of(
                #[inline(always)]
                |lane| first + lane as u32,
            );
            return Self { numbers, indices: eight.each_ref(), count: LANES };
        }
        let last = indices.len() - 1;
        let numbers = lanes_of(
            #[inline(always)]
            |lane| first + lane.min(last) as u32,
        );
        let indices = lanes_of(
            #[inline(always)]
            |lane| &indices[lane.min(last)],
        );
        Self { numbers, indices, count: last + 1 }
    }

    /// Those with the given numbers, at least one, of all of the draw.
    #[inline(always)]
    pub(crate) fn listed(numbers: &[u32], all: &'p [T]) -> Self {
        let last = numbers.len() - 1;
        let numbers = lanes_of(
            #[inline(always)]
            |lane| numbers[lane.min(last)],
        );
        let indices = numbers.each(
            #[inline(always)]
            |number| &all[number as usize],
        );
        Self { numbers, indices, count: last + 1 }
    }

    /// A bit for each lane that is used.
    #[inline(always)]
    pub(crate) fn lanes(&self) -> u64 {
        (1 << self.count) - 1
    }
}
