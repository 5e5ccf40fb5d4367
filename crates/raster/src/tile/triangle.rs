//! A triangle prepared for one tile: which samples it covers, and at which depths.

use crate::bin::{Grid, TriangleRef};
use crate::primitive::{DepthPlane, Edge, Kind, SetupTriangle};
use crate::simd::{I32, LANES, Mask, Simd, lanes_of, prelude::*};
use crate::tile_buffer::{MAX_SIDE, TileArea, lane_point};
use crate::view::FrameView;
use crate::viewport::MAX_SAMPLES;

/// What coverage needs of a triangle in one tile.
///
/// Edge functions, with the bias of the top-left rule ([`Edge::bias`]), are divided by 256 and
/// rounded down, which keeps every sign. The values of one sample in different pixels differ by
/// multiples of 256 (a pixel is 256 steps), so the divided ones differ exactly by the steps for
/// 1/256 pixel. Where an edge crosses the tile, its values in the tile then fit 32 bits: within the
/// guard band an edge spans at most 2^24 steps on each axis, and a tile's samples at most 63.94 pixels,
/// so values differ by at most (2^24 + 2^24) · 63.94 < 2^31. Only wide lines can exceed that
/// ([`Special`]). An edge with the whole tile on its inner side is dropped: its values and steps stay
/// zero, which is inside.
pub(crate) struct TileTriangle {
    /// For each sample of a pixel the edge functions at the tile's first pixel.
    pub(crate) starts: [[i32; 3]; MAX_SAMPLES],
    /// The least and the greatest of those of all samples.
    pub(crate) range: [[i32; 3]; 2],
    /// Steps of the divided values for a pixel to the right and downwards.
    pub(crate) right: [i32; 3],
    pub(crate) down: [i32; 3],
    /// First and last column and row of the tile that may have a sample in the triangle.
    pub(crate) columns: [i32; 2],
    pub(crate) rows: [i32; 2],
    pub(crate) depth: DepthPlane,
    /// What the values above cannot decide.
    pub(crate) special: Option<Special>,
}

/// The exceptions: the widest lines, whose edge functions do not fit 32 bits,
/// and discs.
pub(crate) struct Special {
    edges: [Edge; 3],
    disc: Option<Disc>,
}

impl Special {
    /// Whether a point in 1/256 pixel is covered.
    pub(crate) fn covers(&self, point: [i32; 2]) -> bool {
        self.edges.iter().all(|edge| edge.at(point) + edge.bias() >= 0)
            && self.disc.is_none_or(|disc| disc.covers(point))
    }

    /// Which pixels of a group are covered, from the point of the first one's sample.
    #[cold]
    pub(crate) fn covers_group<S: Simd>(&self, simd: S, point: [i32; 2]) -> Mask<S> {
        let lanes: [i32; LANES] = lanes_of(|lane| i32::from(self.covers(lane_point(point, lane))));
        simd.vectorize(
            #[inline(always)]
            || I32::simd_from(simd, lanes).simd_gt(I32::splat(simd, 0)),
        )
    }
}

/// The round outline of a point.
#[derive(Clone, Copy)]
struct Disc {
    /// Twice the centre, in 1/256 pixel.
    center: [i64; 2],
    diameter: i64,
}

impl Disc {
    fn new(triangle: &SetupTriangle) -> Option<Self> {
        // Each half of the square has the square's bounding box.
        let axis = |i: usize| triangle.extent(i).map(i64::from);
        let ([left, right], [top, bottom]) = (axis(0), axis(1));
        (triangle.kind == Kind::RoundPoint)
            .then_some(Self { center: [left + right, top + bottom], diameter: right - left })
    }

    /// Whether a point is in the disc. Points exactly on the circle are not.
    fn covers(&self, point: [i32; 2]) -> bool {
        let [dx, dy] = [0, 1].map(|axis| 2 * i64::from(point[axis]) - self.center[axis]);
        dx * dx + dy * dy < self.diameter * self.diameter
    }
}

impl TileTriangle {
    /// `None` if the triangle covers no sample of the tile.
    pub(crate) fn new(triangle: &SetupTriangle, grid: &Grid, area: &TileArea) -> Option<Self> {
        let range = |axis: usize| {
            let [first, last] = grid.pattern.pixels_between(triangle.extent(axis))?;
            let first = (first - area.origin[axis]).max(0);
            let last = (last - area.origin[axis]).min(area.padded()[axis] as i32 - 1);
            (first <= last).then_some([first, last])
        };
        let (columns, rows) = (range(0)?, range(1)?);
        let mut covering = Self {
            starts: [[0; 3]; MAX_SAMPLES],
            range: [[0; 3]; 2],
            right: [0; 3],
            down: [0; 3],
            columns,
            rows,
            depth: DepthPlane::of(triangle),
            special: None,
        };
        let edges = Edge::of(triangle);
        let mut wide = false;
        for (k, edge) in edges.iter().enumerate() {
            wide |= covering.edge(k, edge, grid, area)?;
        }
        let disc = Disc::new(triangle);
        covering.special = (wide || disc.is_some()).then_some(Special { edges, disc });
        Some(covering)
    }

    /// Whether a block, whose first pixel is given, lies outside one of the edges, and
    /// whether inside all of them.
    #[inline(always)]
    pub(crate) fn block_sides(&self, [x, y]: [i32; 2]) -> [bool; 2] {
        if self.special.is_some() {
            return [false, false];
        }
        let (mut outside, mut inside) = (false, true);
        // `grow` and `shrink` lead from the block's first pixel to those with the greatest and the least
        // value; its last pixels are 7 steps away. `range` makes both bounds hold at every sample. Sums
        // may wrap around, but each result is a value of the edge in the tile, which fits 32 bits.
        for k in 0..3 {
            let (right, down) = (self.right[k], self.down[k]);
            let at = right.wrapping_mul(x).wrapping_add(down.wrapping_mul(y));
            let far = |step: i32| step.wrapping_mul(7);
            let grow = far(right.max(0)).wrapping_add(far(down.max(0)));
            let shrink = far(right.min(0)).wrapping_add(far(down.min(0)));
            let [least, greatest] = self.range.map(|starts| starts[k].wrapping_add(at));
            outside |= greatest.wrapping_add(grow) < 0;
            inside &= least.wrapping_add(shrink) >= 0;
        }
        [outside, inside]
    }

    /// Whether the sample of a pixel of the tile, which lies at a point in 1/256
    /// pixel, is covered.
    #[inline]
    pub(crate) fn covers(&self, [x, y]: [i32; 2], sample: usize, point: [i32; 2]) -> bool {
        if let Some(special) = &self.special {
            return special.covers(point);
        }
        let value = |k: usize| {
            // Partial sums may wrap around; the sum fits.
            let steps = self.right[k].wrapping_mul(x).wrapping_add(self.down[k].wrapping_mul(y));
            self.starts[sample][k].wrapping_add(steps)
        };
        value(0) | value(1) | value(2) >= 0
    }

    /// Adds an edge; `None` if all of the tile lies outside of it, true if it
    /// needs more than 32 bits.
    fn edge(&mut self, k: usize, edge: &Edge, grid: &Grid, area: &TileArea) -> Option<bool> {
        let corner = area.origin.map(|v| v * 256);
        let [low, high] = grid.pattern.reach();
        let last = (MAX_SIDE as i32 - 1) * 256;
        let [least, greatest] = edge.range(corner.map(|v| v + low), corner.map(|v| v + last + high));
        if greatest + edge.bias() < 0 {
            return None;
        }
        if least + edge.bias() >= 0 {
            return Some(false);
        }
        (self.right[k], self.down[k]) = (edge.right, edge.down);
        for (start, offset) in self.starts.iter_mut().zip(grid.pattern.offsets()) {
            let point = [corner[0] + offset[0], corner[1] + offset[1]];
            // The edge crosses the tile, so no value in it is further from 0
            // than the span.
            start[k] = ((edge.at(point) + edge.bias()) >> 8) as i32;
        }
        let starts = || self.starts[..grid.pattern.count()].iter().map(|start| start[k]);
        let [low, high] = &mut self.range;
        (low[k], high[k]) = (starts().fold(i32::MAX, i32::min), starts().fold(i32::MIN, i32::max));
        Some((greatest - least) >> 8 >= i64::from(i32::MAX))
    }
}

/// One triangle of the tile.
pub(crate) fn single(frame: &FrameView<'_>, area: &TileArea, triangle: TriangleRef) -> Option<TileTriangle> {
    covering_apart(frame, area, &frame.triangle(triangle))
}

/// Not inlined, so that it is compiled once.
#[inline(never)]
pub(super) fn covering_apart(
    frame: &FrameView<'_>,
    area: &TileArea,
    triangle: &SetupTriangle,
) -> Option<TileTriangle> {
    TileTriangle::new(triangle, &frame.grid, area)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{SimdLevel, at_level};
    use crate::tile::sides::Sides;
    use crate::viewport::SamplePattern;
    use crate::viewport::Viewport;
    use proptest::prelude::*;

    fn area(size: [usize; 2]) -> TileArea {
        TileArea { origin: [64, 128], size, margin: [0, 0] }
    }

    /// Holds what a tile knows of a triangle against its edges, asked at every sample.
    fn check(triangle: &SetupTriangle, samples: u32, area: &TileArea) {
        let pattern = SamplePattern::of(samples).unwrap();
        let grid = Grid::new(Viewport { width: 1024, height: 1024 }, pattern, 64);
        let edges = Edge::of(triangle);
        let [[left, right], [top, bottom]] = [0, 1].map(|axis| triangle.extent(axis).map(i64::from));
        let exact = |[x, y]: [i32; 2]| {
            let [dx, dy] = [2 * i64::from(x) - left - right, 2 * i64::from(y) - top - bottom];
            let within = dx * dx + dy * dy < (right - left) * (right - left);
            edges.iter().all(|edge| edge.at([x, y]) + edge.bias() >= 0)
                && (triangle.kind != Kind::RoundPoint || within)
        };
        let covering = TileTriangle::new(triangle, &grid, area);
        if let Some(covering) = covering.as_ref().filter(|covering| covering.special.is_none()) {
            check_eight(covering);
        }
        let [columns, rows] = area.padded().map(|side| side as i32);
        for block in (0..rows / 8).flat_map(|y| (0..columns / 8).map(move |x| [x * 8, y * 8])) {
            let sides = covering.as_ref().map(|covering| covering.block_sides(block));
            for pixel in (0..64).map(|i| [block[0] + i % 8, block[1] + i / 8]) {
                for (sample, &offset) in pattern.offsets().iter().enumerate() {
                    let point = area.point(pixel, offset);
                    let covered = exact(point);
                    let Some(covering) = &covering else {
                        assert!(!covered, "{point:?} of a tile that it was to be beside of");
                        continue;
                    };
                    assert_eq!(covering.covers(pixel, sample, point), covered, "{point:?}");
                    let [outside, inside] = sides.expect("as the tile's");
                    assert!(!(outside && covered), "{point:?} of a block outside");
                    assert!(covered || !inside, "{point:?} of a block inside");
                }
            }
        }
    }

    /// Holds what is known of eight blocks and of eight groups against each block, and against the edges at the pixels of
    /// each group.
    fn check_eight(covering: &TileTriangle) {
        let TileTriangle { right, down, range: [_, greatest], .. } = covering;
        let steps =
            |k: usize, [x, y]: [i32; 2]| right[k].wrapping_mul(x).wrapping_add(down[k].wrapping_mul(y));
        let blocks = (0..8).flat_map(|y| (0..8).map(move |x| [8 * x, 8 * y]));
        for (token, block) in SimdLevel::ALL
            .into_iter()
            .filter_map(SimdLevel::token)
            .flat_map(|token| blocks.clone().map(move |block| (token, block)))
        {
            let group = |group: i32| [block[0] + group % 2 * 4, block[1] + group / 2 * 2];
            let firsts: [[i32; LANES]; 3] =
                [0, 1, 2].map(|k| std::array::from_fn(|lane| steps(k, group(lane as i32))));
            let ([outside, inside], groups) = at_level!(token, simd => {
                let sides = Sides::new(simd, covering);
                let firsts = firsts.map(|values| I32::simd_from(simd, values));
                (sides.blocks(simd, covering, block[1]), sides.groups(simd, firsts))
            });
            let sides = [outside, inside].map(|bits| bits >> (block[0] / 8) & 1 != 0);
            assert_eq!(sides, covering.block_sides(block), "block {block:?} at {token:?}");
            for number in 0..8 {
                let [x, y] = group(number);
                let pixels = (0..8).map(|i| [x + i % 4, y + i / 4]);
                let is_inside =
                    |k: usize| pixels.clone().any(|pixel| greatest[k].wrapping_add(steps(k, pixel)) >= 0);
                let expected = (0..3).all(is_inside);
                assert_eq!(groups >> number & 1 != 0, expected, "group {number} of {block:?} at {token:?}");
            }
        }
    }

    /// Samples and positions beside them, many at corners of blocks.
    fn position() -> impl Strategy<Value = [i32; 2]> {
        let corner = prop_oneof![
            (0..4).prop_map(|block| 8 * block * 256 + 128),
            (0..4).prop_map(|block| { (8 * block + 7) * 256 + 128 })
        ];
        let any = -2000..10_000_i32;
        let axis = || prop_oneof![2 => corner.clone(), 1 => any.clone()];
        [axis(), axis()].prop_map(|[x, y]| [x + 64 * 256, y + 128 * 256])
    }

    /// Triangles with an edge through a position, and discs around it.
    fn triangle() -> impl Strategy<Value = SetupTriangle> {
        let reach = prop::sample::select(vec![300, 2500, 30_000, 1 << 20, 1 << 24]);
        let way = (reach, 0..4_u8).prop_flat_map(|(reach, kind)| {
            let along = [-reach..=reach, -reach..=reach];
            (along.clone(), along).prop_map(move |([x, y], other)| match kind {
                0 => ([x, 0], other),
                1 => ([x, x], other),
                _ => ([x, y], other),
            })
        });
        let edge = (position(), way).prop_map(|([x, y], ([dx, dy], [cx, cy]))| {
            SetupTriangle::on_grid([[x - dx, y - dy], [x + dx, y + dy], [x + cx, y + cy]])
        });
        let disc = (position(), 1..40_i32, any::<bool>()).prop_map(|([x, y], half, upper)| {
            let [left, right, top, bottom] = [x - half * 256, x + half * 256, y - half * 256, y + half * 256];
            let other = if upper { [right, top] } else { [left, bottom] };
            let triangle = SetupTriangle::on_grid([[left, top], other, [right, bottom]]);
            SetupTriangle { kind: Kind::RoundPoint, ..triangle }
        });
        prop_oneof![3 => edge, 1 => disc].prop_filter("an area", |triangle| triangle.doubled_area() != 0)
    }

    proptest! {
        #[test]
        fn a_tile_knows_what_edges_say(
            triangle in triangle(),
            samples in prop_oneof![2 => Just(1_u32), 1 => Just(4), 1 => Just(16)],
            size in [1..=32_usize, 1..=32_usize],
        ) {
            check(&triangle, samples, &area(size));
        }
    }

    #[test]
    fn edges_through_a_corner_of_a_tile_are_told_from_those_beside_it() {
        for corner in [[0, 0], [63, 0], [0, 63], [63, 63]] {
            let [x, y] = [(64 + corner[0]) * 256 + 128, (128 + corner[1]) * 256 + 128];
            for [dx, dy] in [[0, 1], [1, 0], [1, 1], [1, -1]].map(|way| way.map(|axis| axis * 30_000)) {
                for [cx, cy] in [[dy, -dx], [-dy, dx]] {
                    let points = [[x - dx, y - dy], [x + dx, y + dy], [x + cx, y + cy]];
                    check(&SetupTriangle::on_grid(points), 1, &area([64, 64]));
                }
            }
        }
    }

    /// From one corner of a tile to the other, first an edge whose values just fit 32 bits,
    /// then some whose do not.
    #[test]
    fn the_steepest_edges_do_not_wrap() {
        let span = |reach: i64| (4 * reach * 63 * 256) >> 8;
        let most = i64::from(i32::MAX);
        assert!(span(8_475_000) < most && span(8_475_000) / 63 * 64 > most, "but a pixel");
        // Just beside the first sample, so that the edge crosses the tile.
        let [x, y] = [64 * 256 + 129, 128 * 256 + 129];
        for reach in [8_475_000, 8_600_000, 16_000_000] {
            let edge = [[x - reach, y + reach], [x + reach, y - reach]];
            for third in [[x + reach, y + reach], [x - reach, y - reach]] {
                check(&SetupTriangle::on_grid([edge[0], edge[1], third]), 1, &area([64, 64]));
            }
        }
    }
}
