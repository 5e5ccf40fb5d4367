//! Up to eight small triangles of a tile, prepared at once: one triangle in each lane.
//!
//! A triangle is small if its bounding box is less than 96 pixels wide and high ([`SMALL`]):
//! then its edge functions fit in 32 bits anywhere in the tile.

use super::TileTriangle;
use crate::primitive::{Column, DepthPlane, owns_boundary, small_lanes, sorted_columns};
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, greater, inlined, lesser, prelude::*, widened};
use crate::tile_buffer::TileArea;
use crate::vertex::ScreenVertex;
use crate::viewport::{MAX_SAMPLES, SamplePattern};
use fearless_simd::f64x4;

/// What [`TileTriangle`] needs, for eight small triangles.
pub(super) struct EightTriangles {
    /// Edge functions at the tile's corner, with the bias of the top-left rule.
    pub(super) corner: [[i32; LANES]; 3],
    /// The same at the first sample of the tile's first pixel, divided by 256 and rounded down.
    pub(super) first: [[i32; LANES]; 3],
    /// Steps of `corner` for 1/256 pixel; also those of `first` for a whole pixel.
    pub(super) right: [[i32; LANES]; 3],
    pub(super) down: [[i32; LANES]; 3],
    /// First and last columns and rows of pixels in the tile that may have a sample in the triangle.
    pub(super) pixels: [[[i32; LANES]; 2]; 2],
    /// The first vertices in 1/256 pixel, and their depths.
    pub(super) anchor: [[i32; LANES]; 2],
    pub(super) value: [f32; LANES],
    /// Steps of depth for 1/256 pixel to the right and downwards.
    pub(super) slopes: [[f64; LANES]; 2],
    /// The depths of the farthest vertices.
    pub(super) low: [f32; LANES],
    /// The depths of the nearest vertices: a greater depth is nearer.
    pub(super) high: [f32; LANES],
    /// The lanes whose triangles are small.
    pub(super) small: u64,
    /// Those of them that may have samples in the tile.
    pub(super) live: u64,
    /// The lanes whose triangles have at most [`TINY`] pixels each way in the tile.
    tiny: u64,
    /// Whether all triangles are small, and those that are live have at most [`MICRO`] pixels each
    /// way in the tile.
    pub(super) micro: bool,
    /// The lanes whose triangles are slivers, once they are looked for.
    pub(super) slivers: Slivers,
    /// The index of the first among the tile's triangles.
    pub(super) index: u32,
}

/// Which of eight triangles are slivers.
#[derive(Default)]
pub(super) struct Slivers {
    pub(super) lanes: u64,
    /// Those that may cover two pixels of a column.
    pub(super) wide: u64,
    /// Those of which the major axis is the vertical one.
    pub(super) steep: u64,
}

/// In 1/256 pixel; more than [`primitive::SMALL`](crate::primitive::SMALL), for numbers of 16 bits. The sides of a small triangle are less than 1.5 · 2^14 on each axis, and its vertices less than a tile
/// farther, 2.5 · 2^14, from any sample of a tile that its box touches: the two products of an edge function add up to
/// less than 2 · 3.75 · 2^28 < 2^31.
const SMALL: i32 = 96 << 8;

/// Small triangles whose bounding box has at most this many pixels each way in the tile go through the
/// kernel `tiny`: testing whole blocks against their edges costs more than it saves.
const TINY: i32 = 24;

/// Small triangles whose bounding box has at most this many pixels each way in the tile go through the
/// kernel `micro`, if that holds for all triangles that were prepared together.
pub(super) const MICRO: i32 = 4;

impl EightTriangles {
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        simd: S,
        area: &TileArea,
        pattern: SamplePattern,
        vertices: [[&ScreenVertex; LANES]; 3],
        count: usize,
        index: u32,
    ) -> Self {
        let [a, b, c] = vertices;
        let columns = [(a, 0), (b, 1), (c, 2)].each(
            #[inline(always)]
            |(vertices, corner)| Column::new(simd, vertices, corner),
        );
        // Each lane's vertices in the order of (y, x), so that the results do not depend on the
        // order in which the draw lists them.
        let ([a, b, c], _) = sorted_columns(columns);
        let zero = I32::splat(simd, 0);
        // Twice the signed areas: edges are turned so that all triangles are positive inside.
        let area_of = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        let clockwise = area_of.simd_gt(zero);
        let origin = area.origin.each(
            #[inline(always)]
            |v| v * 256,
        );
        let edges = [(b, c), (c, a), (a, b)].each(
            #[inline(always)]
            |(from, to)| edge(simd, from, to, clockwise, origin),
        );
        let [za, zb, zc] = [a, b, c].each(
            #[inline(always)]
            |column| column.depth(),
        );
        let Pixels { ranges, live, tiny, micro } = pixels(simd, area, pattern, [a, b, c]);
        let small = small_lanes(simd, &[a, b, c], SMALL).to_bitmask() & ((1 << count) - 1);
        let live = live.to_bitmask() & small;
        Self {
            corner: edges.each(
                #[inline(always)]
                |[corner, _, _]| corner.into(),
            ),
            first: edges.each(
                #[inline(always)]
                |[corner, right, down]| {
                    // Dividing by 256 and rounding down keeps every sign. The values of one sample
                    // in different pixels differ by multiples of 256 (a pixel is 256 steps), so the
                    // divided ones differ exactly by `right` and `down` for a pixel.
                    let [x, y] = pattern.offsets()[0];
                    ((corner + right * x + down * y) >> 8).into()
                },
            ),
            right: edges.each(
                #[inline(always)]
                |[_, right, _]| right.into(),
            ),
            down: edges.each(
                #[inline(always)]
                |[_, _, down]| down.into(),
            ),
            pixels: ranges,
            anchor: [a.x.into(), a.y.into()],
            value: za.into(),
            slopes: depth_slopes(simd, [a, b, c]),
            low: lesser(lesser(za, zb), zc).into(),
            high: greater(greater(za, zb), zc).into(),
            small,
            live,
            tiny: tiny.to_bitmask(),
            micro: small.count_ones() as usize == count && live & !micro.to_bitmask() == 0,
            slivers: Slivers::default(),
            index,
        }
    }

    /// Whether the triangle of a lane is for the kernels `tiny` and `multisample`.
    #[inline(always)]
    pub(super) fn is_tiny(&self, lane: usize) -> bool {
        self.live & self.tiny & 1 << lane != 0
    }

    #[inline(always)]
    fn plane(&self, lane: usize) -> DepthPlane {
        DepthPlane {
            anchor: [self.anchor[0][lane], self.anchor[1][lane]],
            value: f64::from(self.value[lane]),
            right: self.slopes[0][lane],
            down: self.slopes[1][lane],
            low: self.low[lane],
            high: self.high[lane],
        }
    }

    /// The triangle of one lane; `None` if it has no sample in the tile.
    #[inline(always)]
    pub(super) fn covering(&self, lane: usize, offsets: &[[i32; 2]]) -> Option<TileTriangle> {
        if self.live >> lane & 1 == 0 {
            return None;
        }
        let [corner, right, down] = [&self.corner, &self.right, &self.down].each(
            #[inline(always)]
            |columns| {
                columns.each_ref().each(
                    #[inline(always)]
                    |column| column[lane],
                )
            },
        );
        let mut starts = [[0; 3]; MAX_SAMPLES];
        let mut range = [[i32::MAX; 3], [i32::MIN; 3]];
        for (start, [x, y]) in starts.iter_mut().zip(offsets) {
            *start = [0, 1, 2].each(
                #[inline(always)]
                |k| (corner[k] + right[k] * x + down[k] * y) >> 8,
            );
            for k in 0..3 {
                range[0][k] = range[0][k].min(start[k]);
                range[1][k] = range[1][k].max(start[k]);
            }
        }
        Some(TileTriangle {
            starts,
            range,
            right,
            down,
            columns: self.pixels[0].each(
                #[inline(always)]
                |column| column[lane],
            ),
            rows: self.pixels[1].each(
                #[inline(always)]
                |column| column[lane],
            ),
            depth: self.plane(lane),
            special: None,
        })
    }
}

/// An edge function at the tile's corner, with the bias of the top-left rule, and its steps for
/// 1/256 pixel to the right and downwards.
#[inline(always)]
fn edge<S: Simd>(
    simd: S,
    from: Column<S>,
    to: Column<S>,
    clockwise: Mask<S>,
    origin: [i32; 2],
) -> [I32<S>; 3] {
    let turned = inlined(
        #[inline(always)]
        |value: I32<S>| clockwise.select(value, -value),
    );
    let (right, down) = (turned(from.y - to.y), turned(to.x - from.x));
    let value =
        right * (I32::splat(simd, origin[0]) - from.x) + down * (I32::splat(simd, origin[1]) - from.y);
    // Samples exactly on a left or top edge belong to the triangle. For all other edges the value
    // is made one less, so that "not negative" means inside for every edge.
    let bias = owns_boundary(right, down).select(I32::splat(simd, 0), I32::splat(simd, 1));
    [value - bias, right, down]
}

/// Pixels of the tile that may have a sample in the triangles.
struct Pixels<S: Simd> {
    /// First and last columns and rows.
    ranges: [[[i32; LANES]; 2]; 2],
    /// Where there are any.
    live: Mask<S>,
    /// Where they are at most [`TINY`], and at most [`MICRO`], each way.
    tiny: Mask<S>,
    micro: Mask<S>,
}

#[inline(always)]
fn pixels<S: Simd>(simd: S, area: &TileArea, pattern: SamplePattern, [a, b, c]: [Column<S>; 3]) -> Pixels<S> {
    let columns = range(simd, area, pattern, 0, [a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x)]);
    let rows = range(simd, area, pattern, 1, [a.y, c.y]);
    let live = columns[0].simd_le(columns[1]) & rows[0].simd_le(rows[1]);
    let within = [TINY, MICRO].each(
        #[inline(always)]
        |most| {
            let most = I32::splat(simd, most);
            (columns[1] - columns[0]).simd_lt(most) & (rows[1] - rows[0]).simd_lt(most)
        },
    );
    let ranges = [columns, rows].each(
        #[inline(always)]
        |range| range.each(Into::into),
    );
    Pixels { ranges, live, tiny: within[0], micro: within[1] }
}

/// The first and last pixel on an axis that may have a sample between two
/// coordinates.
#[inline(always)]
fn range<S: Simd>(
    simd: S,
    area: &TileArea,
    pattern: SamplePattern,
    axis: usize,
    [low, high]: [I32<S>; 2],
) -> [I32<S>; 2] {
    let [least, greatest] = pattern.reach();
    let first = ((low + (255 - greatest)) >> 8) - area.origin[axis];
    let last = ((high - least) >> 8) - area.origin[axis];
    let end = I32::splat(simd, area.padded()[axis] as i32 - 1);
    [first.max(I32::splat(simd, 0)), last.min(end)]
}

/// The steps of the planes of depth, by the formula of
/// `slopes` in `primitive/planes.rs`. The sides of small triangles are exact in
/// f32, so converting them to f64 by way of f32 is exact.
#[inline(always)]
fn depth_slopes<S: Simd>(simd: S, [a, b, c]: [Column<S>; 3]) -> [[f64; LANES]; 2] {
    let [ux, uy, vx, vy] = [b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y].each(
        #[inline(always)]
        |step| widened(step.to_float::<F32<S>>()),
    );
    let [za, zb, zc] = [a, b, c].each(
        #[inline(always)]
        |column| widened(column.depth()),
    );
    let mut result = [[0.0; LANES]; 2];
    for half in 0..2 {
        let [ux, uy, vx, vy] = [ux[half], uy[half], vx[half], vy[half]];
        let (zu, zv) = (zb[half] - za[half], zc[half] - za[half]);
        let inverse = f64x4::splat(simd, 1.0) / (ux * vy - uy * vx);
        let right = (zu * vy - zv * uy) * inverse;
        let down = (zv * ux - zu * vx) * inverse;
        let lanes = half * 4..half * 4 + 4;
        right.store_slice(&mut result[0][lanes.clone()]);
        down.store_slice(&mut result[1][lanes]);
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bin::Grid;
    use crate::primitive::SetupTriangle;
    use crate::simd::{SimdLevel, at_level};
    use crate::viewport::Viewport;
    use proptest::prelude::*;

    proptest! {
        /// Against triangles prepared one by one, value by value; also where corners lie above each other or side by side.
        #[test]
        fn eight_at_once_are_as_one_by_one(
            points: [[[u16; 2]; 3]; 8],
            depths: [[f32; 3]; 8],
            steps in prop_oneof![Just(1), Just(1 << 10)],
            samples in prop_oneof![Just(1), Just(4), Just(16)],
        ) {
            let pattern = SamplePattern::of(samples).unwrap();
            let grid = Grid::new(Viewport { width: 300, height: 300 }, pattern, 64);
            let area = TileArea { origin: [64, 128], size: [64, 60], margin: [0, 0] };
            let vertices: [[ScreenVertex; 3]; 8] = std::array::from_fn(|lane| {
                std::array::from_fn(|corner| {
                    let coordinate = |i: usize| i32::from(points[lane][corner][i]) * 2 / 5 / steps * steps;
                    let point = [0, 1].map(|i| coordinate(i) + area.origin[i] * 256 - 3000);
                    let vertex = SetupTriangle::on_grid([point; 3]).vertices[0];
                    vertex.with_depth(depths[lane][corner].abs().fract())
                })
            });
            for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
                let columns = [0, 1, 2].map(|corner| std::array::from_fn(|lane| &vertices[lane][corner]));
                let eight = at_level!(token, simd => EightTriangles::new(simd, &area, pattern, columns, 8, 0));
                for (lane, &vertices) in vertices.iter().enumerate() {
                    let triangle = SetupTriangle::whole(vertices, 0);
                    if eight.small >> lane & 1 == 0 || triangle.doubled_area() == 0 {
                        continue;
                    }
                    let Some(single) = TileTriangle::new(&triangle, &grid, &area) else {
                        continue;
                    };
                    let ours = eight.covering(lane, pattern.offsets()).expect("it is live");
                    prop_assert_eq!((ours.columns, ours.rows), (single.columns, single.rows));
                    let bits = |plane: &DepthPlane| {
                        (plane.anchor, plane.value, plane.right.to_bits(), plane.down.to_bits(), plane.low, plane.high)
                    };
                    prop_assert_eq!(bits(&ours.depth), bits(&single.depth));
                    for y in single.rows[0]..=single.rows[1] {
                        for x in single.columns[0]..=single.columns[1] {
                            for sample in 0..pattern.count() {
                                let covers = |covering: &TileTriangle| covering.covers([x, y], sample, [0, 0]);
                                prop_assert_eq!(covers(&ours), covers(&single), "{} {} {}", x, y, sample);
                            }
                        }
                    }
                }
            }
        }
    }
}
