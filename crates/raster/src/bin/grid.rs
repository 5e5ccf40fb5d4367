//! The tiles of a frame, and which of them a triangle may have samples in.

use crate::primitive::{Edge, SetupTriangle};
use crate::simd::{F32, I32, Simd, prelude::*};
use crate::viewport::{SamplePattern, Viewport};
use std::ops::Range;

/// `columns * rows` squares of `size` pixels, numbered row by row. Each also reads a margin of `apron` pixels
/// on all sides, as far as the image extends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) viewport: Viewport,
    pub(crate) pattern: SamplePattern,
    pub(crate) size: u32,
    pub(crate) apron: u32,
    pub(crate) columns: u32,
    /// 2^32 / size, rounded up: a product with it divides.
    reciprocal: u64,
    /// 1 / size.
    inverse: f32,
}

/// A rectangle of tiles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TileRange {
    pub(crate) columns: Range<u32>,
    pub(crate) rows: Range<u32>,
}

impl TileRange {
    /// How many tiles there are.
    pub(crate) fn len(&self) -> usize {
        self.columns.len() * self.rows.len()
    }

    /// The column and row of the tile with this number, counted row by row.
    pub(crate) fn get(&self, number: u32) -> Option<[u32; 2]> {
        let width = self.columns.len() as u32;
        let at = |number: u32| [self.columns.start + number % width, self.rows.start + number / width];
        ((number as usize) < self.len()).then(|| at(number))
    }
}

impl Grid {
    pub(crate) fn new(viewport: Viewport, pattern: SamplePattern, size: u32) -> Self {
        let columns = viewport.width.div_ceil(size);
        let reciprocal = (1_u64 << 32).div_ceil(u64::from(size));
        Self { viewport, pattern, size, apron: 0, columns, reciprocal, inverse: 1.0 / size as f32 }
    }

    /// The same, and its tiles see more.
    pub(crate) fn with_apron(self, apron: u32) -> Self {
        Self { apron, ..self }
    }

    /// The column or row of tiles that a pixel lies in.
    #[inline(always)]
    pub(crate) fn tile_of(&self, pixel: u32) -> u32 {
        ((u64::from(pixel) * self.reciprocal) >> 32) as u32
    }

    /// [`tile_of`](Self::tile_of), for lanes.
    #[inline(always)]
    pub(crate) fn tiles_at<S: Simd>(&self, pixels: I32<S>) -> I32<S> {
        // A centre lies half a pixel from the next tile, and the product within 2^-7 pixels.
        ((pixels.to_float::<F32<S>>() + 0.5) * self.inverse).to_int()
    }

    /// The tiles that hold these pixels, ends included and not empty; what lies
    /// outside of the view is left out.
    #[inline]
    pub(crate) fn tiles_of(&self, columns: [i32; 2], rows: [i32; 2]) -> TileRange {
        let tiles = |[first, last]: [i32; 2], side: u32| {
            let last = last.min(side as i32 - 1);
            self.tile_of(first.max(0) as u32)..self.tile_of(last as u32) + 1
        };
        TileRange { columns: tiles(columns, self.viewport.width), rows: tiles(rows, self.viewport.height) }
    }

    /// The tiles that see these pixels.
    #[inline]
    pub(crate) fn tiles_that_see(&self, columns: [i32; 2], rows: [i32; 2]) -> TileRange {
        let apron = self.apron as i32;
        let wider = |[first, last]: [i32; 2]| [first - apron, last + apron];
        self.tiles_of(wider(columns), wider(rows))
    }

    /// The pixels in view that may hold a sample of the triangle; `None` if
    /// there are none.
    #[inline]
    pub(crate) fn pixels_of(&self, triangle: &SetupTriangle) -> Option<[[i32; 2]; 2]> {
        self.pixels_between([triangle.extent(0), triangle.extent(1)])
    }

    /// The pixels in view that may hold a sample between coordinates of both axes; `None` if
    /// there are none.
    #[inline]
    pub(crate) fn pixels_between(&self, [columns, rows]: [[i32; 2]; 2]) -> Option<[[i32; 2]; 2]> {
        let columns = self.pattern.pixels_between(columns)?;
        let rows = self.pattern.pixels_between(rows)?;
        let meets = |[first, last]: [i32; 2], side: u32| first < side as i32 && last >= 0;
        (meets(columns, self.viewport.width) && meets(rows, self.viewport.height)).then_some([columns, rows])
    }

    /// The smallest rectangle around all samples that a tile reads, in 1/256 pixel.
    pub(crate) fn reach_of_tile(&self, tile: [u32; 2]) -> [[i32; 2]; 2] {
        let [least, greatest] = self.pattern.reach();
        let apron = self.apron as i32 * 256;
        let first = tile.map(|v| (v * self.size) as i32 * 256);
        let last = (self.size as i32 - 1) * 256 + greatest + apron;
        [first.map(|v| v + least - apron), first.map(|v| v + last)]
    }

    /// The tiles that a triangle may have samples in: those of its bounding box,
    /// without those that lie outside one of its edges.
    pub(crate) fn for_each_tile(&self, triangle: &SetupTriangle, mut visit: impl FnMut(u32)) {
        let Some([columns, rows]) = self.pixels_of(triangle) else {
            return;
        };
        let TileRange { columns, rows } = self.tiles_that_see(columns, rows);
        let few = columns.len() + rows.len() <= 3;
        let edges = (!few).then(|| Edge::of(triangle));
        for row in rows {
            let columns = match &edges {
                None => columns.clone(),
                Some(edges) => self.columns_inside(edges, columns.clone(), row),
            };
            for column in columns {
                visit(row * self.columns + column);
            }
        }
    }

    /// Visits those of some tiles that lie outside none of the edges until `visit` says that
    /// it is enough; false if it did.
    pub(crate) fn tiles_between(
        &self,
        edges: &[Edge],
        TileRange { columns, rows }: TileRange,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        rows.into_iter().all(|row| {
            let mut columns = self.columns_inside(edges, columns.clone(), row);
            columns.all(|column| visit(row * self.columns + column))
        })
    }

    /// Those tiles of a row that lie outside none of the edges.
    ///
    /// The greatest value of an edge in a tile grows by the same step from tile to
    /// tile, so its sign changes at one column, which a division finds exactly: a
    /// long thin triangle costs as much as the tiles that it crosses, not as those
    /// of its bounding box.
    fn columns_inside(&self, edges: &[Edge], columns: Range<u32>, row: u32) -> Range<u32> {
        let (mut first, mut last) = (i64::from(columns.start), i64::from(columns.end) - 1);
        for edge in edges {
            let [low, high] = self.reach_of_tile([0, row]);
            let greatest = edge.range(low, high)[1] + edge.bias();
            let step = i64::from(edge.right) * 256 * i64::from(self.size);
            match step.signum() {
                1 => first = first.max(-greatest.div_euclid(step)),
                -1 => last = last.min(greatest.div_euclid(-step)),
                _ if greatest < 0 => last = -1,
                _ => {}
            }
        }
        if first <= last { first as u32..last as u32 + 1 } else { 0..0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{LANES, SimdLevel, at_level, lane_numbers};
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = [i32; 2]> {
        let (near, far) = (-20_000..60_000, -(1 << 23)..1 << 24);
        prop_oneof![3 => [near.clone(), near], 1 => [far.clone(), far]]
    }

    #[test]
    fn a_product_divides_every_pixel_number() {
        for size in 1..=64 {
            let grid = Grid::new(Viewport { width: 1, height: 1 }, SamplePattern::SINGLE, size);
            for pixel in 0..1 << 16 {
                assert_eq!(grid.tile_of(pixel), pixel / size, "{pixel} / {size}");
            }
            let token = SimdLevel::best().token().expect("the best level is there");
            for first in (0..1 << 16).step_by(LANES) {
                let tiles: [i32; LANES] = at_level!(token, simd => {
                    grid.tiles_at(lane_numbers(simd) + first).into()
                });
                let expected: [i32; LANES] = std::array::from_fn(|lane| (first + lane as i32) / size as i32);
                assert_eq!(tiles, expected, "{first} / {size}");
            }
        }
    }

    proptest! {
        /// Asking every tile of the image whether it lies outside an edge.
        #[test]
        fn a_triangle_is_in_the_tiles_that_no_edge_shuts_out(
            points in [point(), point(), point()],
            size in prop_oneof![Just(8_u32), Just(63), Just(64)],
        ) {
            let triangle = SetupTriangle::on_grid(points);
            prop_assume!(triangle.doubled_area() != 0);
            let grid = Grid::new(Viewport { width: 200, height: 150 }, SamplePattern::SINGLE, size);
            let mut binned = Vec::new();
            let Some([x, y]) = grid.pixels_of(&triangle) else { return Ok(()) };
            grid.for_each_tile(&triangle, |tile| binned.push(tile));
            for tile in 0..grid.columns * grid.viewport.height.div_ceil(size) {
                let position = [tile % grid.columns, tile / grid.columns];
                let corner = position.map(|v| (v * size) as i32);
                let [low, high] = grid.reach_of_tile(position);
                let reached = |edge: &Edge| edge.range(low, high)[1] + edge.bias() >= 0;
                let inside = Edge::of(&triangle).iter().all(reached);
                let meets = |[first, last]: [i32; 2], at: i32| first < at + size as i32 && at <= last;
                let expected = inside && meets(x, corner[0]) && meets(y, corner[1]);
                let found = binned.contains(&tile);
                prop_assert!(found || !expected, "tile {} is missing", tile);
                prop_assert!(expected || !found || binned.len() <= 2, "tile {} is in vain", tile);
            }
        }
    }
}
