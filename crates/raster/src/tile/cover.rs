//! One triangle in one tile: which samples it covers and how deep they lie,
//! eight at a time.

use super::Edge;
use crate::setup::{Kind, SampleBounds, SetupTriangle};

/// The distance between rows of a tile's scratch, and the most samples that a
/// tile has in a row.
pub(crate) const STRIDE: usize = 64;

/// Samples that are decided together: a run in a row, starting at a multiple
/// of this. Fixed by the layout and not by the machine.
pub(crate) const LANES: usize = 8;

/// Where a tile lies in the sample grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileArea {
    /// The first sample.
    pub(crate) origin: [i32; 2],
    /// Samples in a row and in a column, at most [`STRIDE`].
    pub(crate) size: [usize; 2],
}

/// A rectangle of samples within a tile, ends included.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    pub(crate) columns: [usize; 2],
    pub(crate) rows: [usize; 2],
}

impl TileArea {
    /// All samples of the tile.
    pub(crate) fn whole(&self) -> Region {
        Region { columns: [0, self.size[0] - 1], rows: [0, self.size[1] - 1] }
    }
}

impl Region {
    /// Both halves, one above or beside the other; `None` if there is only one
    /// sample.
    pub(crate) fn halves(self) -> Option<[Self; 2]> {
        let Self { columns, rows } = self;
        let cut = |[first, last]: [usize; 2]| {
            let middle = first + (last - first) / 2;
            [[first, middle], [middle + 1, last]]
        };
        if rows[0] < rows[1] {
            Some(cut(rows).map(|rows| Self { columns, rows }))
        } else if columns[0] < columns[1] {
            Some(cut(columns).map(|columns| Self { columns, rows }))
        } else {
            None
        }
    }
}

/// A run of eight samples of a tile.
pub(crate) struct Lanes {
    /// The first sample's column and row in the tile.
    pub(crate) x: usize,
    pub(crate) y: usize,
    /// Not negative where the triangle covers the sample.
    pub(crate) sign: [i32; LANES],
    /// Depth, meaningful where covered.
    pub(crate) depth: [f32; LANES],
}

/// An edge function's sign on the samples of a tile.
#[derive(Clone, Copy, Default)]
struct Sign {
    start: i64,
    right: i32,
    down: i32,
}

/// A triangle as one tile sees it.
pub(crate) struct TileTriangle {
    signs: [Sign; 3],
    /// Whether the signs need more than 32 bits.
    wide: bool,
    edges: [Edge; 3],
    /// Whether the edge functions fit 32 bits on all covered samples.
    small: bool,
    depth: DepthPlane,
    disc: Option<Disc>,
    /// First and last column and row, within the tile.
    columns: [usize; 2],
    rows: [usize; 2],
}

/// How depth comes from the edge functions.
pub(crate) struct DepthPlane {
    inverse_area: f32,
    vertices: [f32; 3],
    range: [f32; 2],
}

impl DepthPlane {
    pub(crate) fn new(triangle: &SetupTriangle) -> Self {
        let vertices = triangle.vertices.map(|v| v.depth);
        let [a, b, c] = vertices;
        let low = |a: f32, b: f32| if b < a { b } else { a };
        let high = |a: f32, b: f32| if b > a { b } else { a };
        Self {
            inverse_area: 1.0 / triangle.doubled_area().abs() as f32,
            vertices,
            range: [low(low(a, b), c), high(high(a, b), c)],
        }
    }

    /// The weights of the vertices where the edge functions have these values.
    #[inline(always)]
    pub(crate) fn weights(&self, edges: [f32; 3]) -> [f32; 3] {
        edges.map(|edge| edge * self.inverse_area)
    }

    /// The depth for these weights: not beyond the vertices', and so exactly
    /// theirs where they agree.
    #[inline(always)]
    pub(crate) fn at(&self, [u, v, w]: [f32; 3]) -> f32 {
        let [a, b, c] = self.vertices;
        let depth = u * a + v * b + w * c;
        let depth = if depth < self.range[0] { self.range[0] } else { depth };
        if depth > self.range[1] { self.range[1] } else { depth }
    }
}

/// The round outline of a point.
#[derive(Clone, Copy)]
struct Disc {
    /// Twice the centre, relative to the centre of the tile's first sample, in
    /// units of the grid.
    centre: [i64; 2],
    /// Twice the diameter's half.
    diameter: i64,
}

impl Disc {
    fn new(triangle: &SetupTriangle, origin: [i32; 2]) -> Option<Self> {
        if triangle.kind != Kind::RoundPoint {
            return None;
        }
        // Each half of the square has the square's bounding box.
        let axis = |i: usize| {
            let raw = triangle.vertices.map(|v| i64::from([v.point.x, v.point.y][i].raw()));
            let (low, high) = (raw[0].min(raw[1]).min(raw[2]), raw[0].max(raw[1]).max(raw[2]));
            let first = i64::from(origin[i]) * 256 + 128;
            (low + high - 2 * first, high - low)
        };
        let ((x, diameter), (y, _)) = (axis(0), axis(1));
        Some(Self { centre: [x, y], diameter })
    }

    #[inline]
    fn covers(&self, x: usize, y: usize) -> bool {
        let [dx, dy] = [512 * x as i64 - self.centre[0], 512 * y as i64 - self.centre[1]];
        dx * dx + dy * dy < self.diameter * self.diameter
    }
}

impl TileTriangle {
    /// `None` if the triangle covers no sample of the `region` of the tile.
    pub(crate) fn new(triangle: &SetupTriangle, area: TileArea, region: Region) -> Option<Self> {
        let SampleBounds { x, y } = triangle.sample_bounds()?;
        let clipped = |[first, last]: [i32; 2], axis: usize, [least, most]: [usize; 2]| {
            let first = (first - area.origin[axis]).max(least as i32);
            let last = (last - area.origin[axis]).min(most as i32);
            (first <= last).then_some([first as usize, last as usize])
        };
        let columns = clipped(x, 0, region.columns)?;
        let rows = clipped(y, 1, region.rows)?;
        let edges = Edge::of(triangle);
        let mut signs = [Sign::default(); 3];
        let mut wide = false;
        for (sign, edge) in signs.iter_mut().zip(&edges) {
            let [least, greatest] = edge.range(area.origin, STRIDE as u32);
            if greatest + edge.bias() < 0 {
                return None;
            }
            if least + edge.bias() >= 0 {
                continue;
            }
            let start = (edge.at(area.origin) + edge.bias()) >> 8;
            *sign = Sign { start, right: edge.right, down: edge.down };
            // The edge crosses the tile, so no value on it is further from 0
            // than this span.
            wide |= (greatest - least) >> 8 > i64::from(i32::MAX) - 1;
        }
        let edges = edges.map(|edge| Edge { origin: edge.at(area.origin), ..edge });
        Some(Self {
            signs,
            wide,
            edges,
            small: triangle.doubled_area().abs() <= i64::from(i32::MAX),
            depth: DepthPlane::new(triangle),
            disc: Disc::new(triangle, area.origin),
            columns,
            rows,
        })
    }

    /// Visits the runs of samples that may be covered, block by block of 8 by
    /// 8; blocks that lie outside an edge are left out as a whole.
    #[inline(always)]
    pub(crate) fn for_each_run(&self, mut visit: impl FnMut(Lanes)) {
        let blocks = |[first, last]: [usize; 2]| first / LANES..=last / LANES;
        for block_y in blocks(self.rows) {
            let top = (block_y * LANES).max(self.rows[0]);
            let bottom = (block_y * LANES + LANES - 1).min(self.rows[1]);
            for block_x in blocks(self.columns) {
                let x = block_x * LANES;
                if self.block_is_outside(x, block_y * LANES) {
                    continue;
                }
                for y in top..=bottom {
                    visit(self.lanes(x, y));
                }
            }
        }
    }

    /// As [`for_each_run`](Self::for_each_run), sample by covered sample: index
    /// in the scratch and depth.
    pub(crate) fn for_each_sample(&self, mut visit: impl FnMut(usize, f32)) {
        self.for_each_run(|lanes| {
            for lane in 0..LANES {
                let x = lanes.x + lane;
                if lanes.sign[lane] >= 0 && self.columns[0] <= x && x <= self.columns[1] {
                    visit(lanes.y * STRIDE + x, lanes.depth[lane]);
                }
            }
        });
    }

    #[inline(always)]
    fn block_is_outside(&self, x: usize, y: usize) -> bool {
        const LAST: i64 = LANES as i64 - 1;
        self.signs.iter().any(|sign| {
            let (right, down) = (i64::from(sign.right), i64::from(sign.down));
            let x = x as i64 + if right > 0 { LAST } else { 0 };
            let y = y as i64 + if down > 0 { LAST } else { 0 };
            sign.start + right * x + down * y < 0
        })
    }

    #[inline(always)]
    fn lanes(&self, x: usize, y: usize) -> Lanes {
        let mut sign = if self.wide { self.wide_signs(x, y) } else { self.signs(x, y) };
        if let Some(disc) = &self.disc {
            for (lane, sign) in sign.iter_mut().enumerate() {
                *sign = if disc.covers(x + lane, y) { *sign } else { -1 };
            }
        }
        Lanes { x, y, sign, depth: self.depths(x, y) }
    }

    /// Exact: where an edge crosses the tile its values over 256 fit 32 bits,
    /// though the partial sums may wrap around.
    #[inline(always)]
    fn signs(&self, x: usize, y: usize) -> [i32; LANES] {
        let starts = self.signs.map(|sign| {
            let right = sign.right.wrapping_mul(x as i32);
            let down = sign.down.wrapping_mul(y as i32);
            (sign.start as i32).wrapping_add(right).wrapping_add(down)
        });
        let [a, b, c] = self.signs;
        std::array::from_fn(|lane| {
            let at = |start: i32, sign: Sign| start.wrapping_add(sign.right.wrapping_mul(lane as i32));
            at(starts[0], a) | at(starts[1], b) | at(starts[2], c)
        })
    }

    /// The same in 64 bits, for lines of extreme width.
    #[cold]
    fn wide_signs(&self, x: usize, y: usize) -> [i32; LANES] {
        std::array::from_fn(|lane| {
            let at = |sign: &Sign| {
                let (right, down) = (i64::from(sign.right), i64::from(sign.down));
                sign.start + right * (x + lane) as i64 + down * y as i64
            };
            let all = self.signs.iter().fold(0, |all, sign| all | at(sign));
            if all < 0 { -1 } else { 0 }
        })
    }

    /// Depths from the exact edge functions. On covered samples these lie
    /// within 0 and the area, so 32 bits are enough for small triangles; others
    /// wrap around and are not looked at.
    #[inline(always)]
    fn depths(&self, x: usize, y: usize) -> [f32; LANES] {
        let starts = self.edges.map(|edge| edge.at([x as i32, y as i32]));
        let [a, b, c] = self.edges.map(|edge| edge.right);
        if self.small {
            let [d, e, f] = starts.map(|start| start as i32);
            return std::array::from_fn(|lane| {
                let at = |start: i32, right: i32| {
                    start.wrapping_add(right.wrapping_mul(256).wrapping_mul(lane as i32)) as f32
                };
                self.depth.at(self.depth.weights([at(d, a), at(e, b), at(f, c)]))
            });
        }
        let [d, e, f] = starts;
        std::array::from_fn(|lane| {
            let at = |start: i64, right: i32| (start + i64::from(right) * 256 * lane as i64) as f32;
            self.depth.at(self.depth.weights([at(d, a), at(e, b), at(f, c)]))
        })
    }
}
