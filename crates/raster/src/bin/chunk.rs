//! A chunk: consecutive primitives of the frame, set up and sorted into tiles. Primitives that move from frame to
//! frame can be set up and listed apart from the others of their chunk ([`MovingChunk`]).

use super::triangle_ref::{Entry, Listed, TriangleRef};
use super::{Grid, TileRange};
use crate::primitive::{Corners, CutWeights, DetailIndex, Edge, Quad, QuadDetail, SetupTriangle, Stroke};
use crate::simd::{InlineMap, LANES, Mask, Simd, U32, append, prelude::*};
use crate::{BlendMode, Stats};
use std::ops::Range;

/// A triangle, line or point over many tiles, so that it is not listed in each.
struct Large {
    entry: Entry,
    tiles: TileRange,
}

/// From this many tiles on a triangle is kept once for all, so that a triangle
/// takes a bounded amount of memory whatever its size.
const LARGE: usize = 64;

/// Some primitives of one kind of surface, in the order of the frame.
#[derive(Default)]
pub(crate) struct Chunk {
    /// Ordinals of its primitives in the frame.
    pub(crate) ordinals: Range<u32>,
    pub(crate) blend_mode: BlendMode,
    /// Triangles that are not just primitives.
    pub(crate) extras: Vec<SetupTriangle>,
    /// Weights of the corners at the vertices of those.
    pub(crate) weights: Vec<CutWeights>,
    /// Lines and points.
    quads: Vec<Quad>,
    /// What only some of them have.
    details: Vec<QuadDetail>,
    pub(crate) stats: Stats,
    /// A tile and an entry for each time that a triangle is listed, in the order of the
    /// primitives.
    tiles: Vec<u32>,
    pushed: Vec<Entry>,
    large: Vec<Large>,
    /// The first tile that has entries, and where each tile's entries start.
    first_tile: u32,
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

impl Chunk {
    /// The chunk of a triangle among those of a frame, which are in the order of their ordinals.
    pub(crate) fn of(chunks: &[Self], triangle: TriangleRef) -> &Self {
        &chunks[chunks.partition_point(|chunk| chunk.ordinals.end <= triangle.ordinal)]
    }

    /// Empties the chunk for another frame and keeps its memory.
    pub(crate) fn reset(&mut self, ordinals: Range<u32>, blend_mode: BlendMode) {
        self.ordinals = ordinals;
        self.blend_mode = blend_mode;
        self.extras.clear();
        self.weights.clear();
        self.quads.clear();
        self.details.clear();
        self.stats = Stats::default();
        self.tiles.clear();
        self.pushed.clear();
        self.large.clear();
        self.starts.clear();
        self.entries.clear();
    }

    /// Notes that a triangle may have samples in one tile.
    #[inline(always)]
    pub(crate) fn push(&mut self, tile: u32, entry: Entry) {
        self.tiles.push(tile);
        self.pushed.push(entry);
    }

    /// Notes that some of eight primitives, which become entries, may have samples in one tile each.
    #[inline(always)]
    pub(crate) fn push_some<S: Simd>(
        &mut self,
        mask: Mask<S>,
        tiles: U32<S>,
        indices: U32<S>,
        entry: fn(u32) -> Entry,
    ) {
        let count = mask.to_bitmask().count_ones() as usize;
        let [tiles, indices]: [[u32; LANES]; 2] =
            [tiles.compress(mask).into(), indices.compress(mask).into()];
        append(&mut self.tiles, &tiles, count);
        append(&mut self.pushed, &indices.each(entry), count);
    }

    /// Notes all tiles that a triangle may have samples in.
    pub(crate) fn push_all(&mut self, grid: &Grid, triangle: &SetupTriangle, entry: Entry) {
        let Some([columns, rows]) = grid.pixels_of(triangle) else {
            return;
        };
        let tiles = grid.tiles_that_see(columns, rows);
        if tiles.len() >= LARGE {
            self.large.push(Large { entry, tiles });
        } else {
            grid.for_each_tile(triangle, |tile| self.push(tile, entry));
        }
    }

    /// Keeps a line or a point and notes all tiles that it may have samples in; false if
    /// there are none.
    pub(crate) fn push_quad(&mut self, grid: &Grid, quad: Quad) -> bool {
        let Some([columns, rows]) = grid.pixels_between([quad.extent(0), quad.extent(1)]) else {
            return false;
        };
        let entry = Entry::quad(self.quads.len());
        let tiles = grid.tiles_that_see(columns, rows);
        if tiles.len() == 1 {
            self.push(tiles.rows.start * grid.columns + tiles.columns.start, entry);
        } else {
            let count = self.tiles.len();
            let sides = Edge::sides(&quad);
            let is_large = !grid.tiles_between(&sides, tiles.clone(), |tile| {
                self.push(tile, entry);
                self.tiles.len() - count < LARGE
            });
            if is_large {
                self.tiles.truncate(count);
                self.pushed.truncate(count);
                self.large.push(Large { entry, tiles });
            } else if self.tiles.len() == count {
                return false;
            }
        }
        self.quads.push(quad);
        true
    }

    /// Keeps what only some lines and points have.
    pub(crate) fn keep(&mut self, detail: QuadDetail) -> Option<DetailIndex> {
        let index = DetailIndex::new(self.details.len());
        self.details.push(detail);
        index
    }

    fn detail(&self, quad: &Quad) -> Option<&QuadDetail> {
        quad.detail.map(|index| &self.details[index.get()])
    }

    /// The line or point that a triangle is half of.
    #[inline(always)]
    pub(crate) fn quad(&self, triangle: TriangleRef) -> Option<&Quad> {
        triangle.quad().map(|(index, _)| &self.quads[index])
    }

    /// The triangle of a reference that is not a whole primitive; `None` if it is.
    pub(crate) fn made(&self, triangle: TriangleRef) -> Option<SetupTriangle> {
        match triangle.quad() {
            Some((index, half)) => Some(self.quads[index].half(half)),
            None => triangle.extra().map(|extra| self.extras[extra]),
        }
    }

    /// The stroke of the anti-aliased line or point that a triangle is half of.
    pub(crate) fn stroke_of(&self, triangle: TriangleRef) -> Option<&Stroke> {
        self.detail(self.quad(triangle)?)?.stroke.as_ref()
    }

    /// The weights of the primitive's corners at the vertices of a triangle, unless those
    /// are its corners.
    pub(crate) fn weights_of(&self, triangle: TriangleRef) -> Option<CutWeights> {
        if let Some((index, half)) = triangle.quad() {
            let quad = &self.quads[index];
            let ends = self.detail(quad).map_or(QuadDetail::WHOLE, |detail| detail.weights);
            return quad.weights(half, ends);
        }
        match self.extras[triangle.extra()?].corners {
            Corners::Cut { weights, .. } => Some(self.weights[weights as usize]),
            Corners::Whole(_) | Corners::Ends(_) => None,
        }
    }

    /// How many triangles are listed.
    pub(crate) fn binned(&self) -> u64 {
        (self.tiles.len() + self.large.len()) as u64
    }

    /// Sorts the entries by tile, each tile's in their order, by counting.
    pub(crate) fn sort(&mut self) {
        let tiles = self.tiles.iter().copied();
        let (Some(first), Some(last)) = (tiles.clone().min(), tiles.max()) else {
            return;
        };
        self.first_tile = first;
        // One more than there are tiles, and one before that the filling in
        // moves to its place.
        self.starts.resize((last - first) as usize + 3, 0);
        for &tile in &self.tiles {
            self.starts[(tile - first) as usize + 2] += 1;
        }
        for tile in 1..self.starts.len() {
            self.starts[tile] += self.starts[tile - 1];
        }
        self.entries.resize(self.pushed.len(), Entry(0));
        for (&tile, &entry) in self.tiles.iter().zip(&self.pushed) {
            let next = &mut self.starts[(tile - first) as usize + 1];
            self.entries[*next as usize] = entry;
            *next += 1;
        }
    }

    /// The triangles listed for a tile, without the large ones.
    fn listed(&self, tile: u32) -> &[Entry] {
        let Some(index) = tile.checked_sub(self.first_tile).map(|index| index as usize) else {
            return &[];
        };
        match (self.starts.get(index), self.starts.get(index + 1)) {
            (Some(&start), Some(&end)) => &self.entries[start as usize..end as usize],
            _ => &[],
        }
    }

    /// Appends the triangles of a tile to `triangles`, in the order of the
    /// primitives.
    pub(crate) fn collect(&self, grid: &Grid, tile: u32, triangles: &mut Vec<TriangleRef>) {
        let listed = self.listed(tile);
        if self.large.is_empty() {
            if self.extras.is_empty() && self.quads.is_empty() {
                triangles.extend(listed.iter().map(|&entry| TriangleRef::whole(self.ordinals.start, entry)));
            } else {
                listed.iter().for_each(|&entry| self.append(entry, triangles));
            }
            return;
        }
        let (column, row) = (tile % grid.columns, tile / grid.columns);
        let reaches =
            |large: &&Large| large.tiles.columns.contains(&column) && large.tiles.rows.contains(&row);
        let mut listed = listed.iter().copied().peekable();
        for large in self.large.iter().filter(reaches) {
            while let Some(entry) =
                listed.next_if(|entry| self.primitive(*entry) < self.primitive(large.entry))
            {
                self.append(entry, triangles);
            }
            self.append(large.entry, triangles);
        }
        listed.for_each(|entry| self.append(entry, triangles));
    }

    /// Appends the triangles of an entry.
    #[inline(always)]
    fn append(&self, entry: Entry, triangles: &mut Vec<TriangleRef>) {
        triangles.push(self.triangle(entry));
        if let Listed::Quad(index) = entry.listed() {
            triangles.push(TriangleRef::half(self.quads[index].ordinal, index, 1));
        }
    }

    /// The only triangle of an entry, or the first of two.
    #[inline(always)]
    fn triangle(&self, entry: Entry) -> TriangleRef {
        match entry.listed() {
            Listed::Primitive(_) => TriangleRef::whole(self.ordinals.start, entry),
            Listed::Extra(extra) => TriangleRef { ordinal: self.extras[extra].ordinal, extra: extra as u32 },
            Listed::Quad(index) => TriangleRef::half(self.quads[index].ordinal, index, 0),
        }
    }

    /// Whether the primitives that were set up, `count` of them, are triangles and points that are drawn as they
    /// are, and each of them is either culled or listed by a tile.
    pub(super) fn is_plain(&self, count: usize) -> bool {
        let Stats { culled, set_up, clipped, .. } = self.stats;
        self.extras.is_empty()
            && self.quads.is_empty()
            && self.large.is_empty()
            && clipped == 0
            && culled + set_up == count as u64
            // A triangle between the samples of all tiles is in none, and would be missed.
            && primitives_of(&self.pushed) == set_up
    }

    /// Drops primitives, given by their indices in the chunk, from what tiles list. The chunk must be
    /// [plain](Self::is_plain).
    fn drop_listed(&mut self, indices: &[u32]) {
        let mut dropped = indices.iter().copied().peekable();
        let mut count = 0;
        for at in 0..self.pushed.len() {
            let index = self.pushed[at].index();
            while dropped.next_if(|&dropped| dropped < index).is_some() {}
            if dropped.peek() != Some(&index) {
                (self.tiles[count], self.pushed[count]) = (self.tiles[at], self.pushed[at]);
                count += 1;
            }
        }
        self.tiles.truncate(count);
        self.pushed.truncate(count);
        self.stats.set_up = primitives_of(&self.pushed);
        self.stats.culled = (self.ordinals.len() - indices.len()) as u64 - self.stats.set_up;
        self.starts.clear();
        self.entries.clear();
        self.sort();
    }

    /// Visits the tiles that list primitives for which a test of their index in the chunk holds; some tiles
    /// more than once.
    pub(crate) fn for_each_tile_of(
        &self,
        grid: &Grid,
        is_one: impl Fn(u32) -> bool,
        mut visit: impl FnMut(u32),
    ) {
        for (starts, tile) in self.starts.windows(2).zip(self.first_tile..) {
            let entries = &self.entries[starts[0] as usize..starts[1] as usize];
            if entries.iter().any(|&entry| is_one(self.primitive(entry))) {
                visit(tile);
            }
        }
        for Large { tiles, .. } in self.large.iter().filter(|large| is_one(self.primitive(large.entry))) {
            let columns = tiles.columns.clone();
            tiles
                .rows
                .clone()
                .for_each(|row| columns.clone().for_each(|column| visit(row * grid.columns + column)));
        }
    }

    /// All triangles that any tile lists, in the order of the primitives.
    pub(crate) fn all(&self) -> Vec<TriangleRef> {
        let mut entries: Vec<_> =
            self.large.iter().map(|large| large.entry).chain(self.entries.clone()).collect();
        entries.sort_unstable_by_key(|&entry| (self.primitive(entry), entry.0));
        entries.dedup();
        let mut triangles = Vec::new();
        entries.into_iter().for_each(|entry| self.append(entry, &mut triangles));
        triangles
    }

    /// The index in the chunk of the primitive that a triangle belongs to.
    #[inline]
    pub(crate) fn primitive(&self, entry: Entry) -> u32 {
        match entry.listed() {
            Listed::Primitive(index) => index,
            Listed::Extra(extra) => self.extras[extra].ordinal - self.ordinals.start,
            Listed::Quad(index) => self.quads[index].ordinal - self.ordinals.start,
        }
    }

    /// Whether no tile has anything to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty() && self.large.is_empty()
    }
}

/// How many primitives have entries, of a list in their order.
fn primitives_of(entries: &[Entry]) -> u64 {
    let again = entries.windows(2).filter(|pair| pair[0] == pair[1]).count();
    (entries.len() - again) as u64
}

/// The moving primitives of a chunk.
#[derive(Default)]
pub(crate) struct MovingChunk {
    /// Their indices in the chunk, increasing.
    indices: Vec<u32>,
    /// What tiles list of them. Entries name the same indices as those of the chunk itself.
    pub(crate) listed: Chunk,
}

impl MovingChunk {
    /// Whether [`take`](Self::take) may take primitives of a chunk.
    pub(crate) fn can_take(&self, chunk: &Chunk) -> bool {
        chunk.is_plain(chunk.ordinals.len() - self.indices.len())
    }

    /// Takes primitives from a chunk, by their indices, those that are here already included. They must be set
    /// up next.
    pub(crate) fn take(&mut self, chunk: &mut Chunk, indices: Vec<u32>) {
        if !indices.is_empty() {
            chunk.drop_listed(&indices);
        }
        self.indices = indices;
    }

    /// Starts to set them up.
    pub(crate) fn begin(&mut self, chunk: &Chunk) {
        self.listed.reset(chunk.ordinals.clone(), chunk.blend_mode);
    }

    /// The indices in the chunk of the primitives, increasing.
    pub(crate) fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// Their indices, and what tiles list of them.
    pub(crate) fn parts(&mut self) -> (&[u32], &mut Chunk) {
        (&self.indices, &mut self.listed)
    }

    /// Whether all of them were set up as [`take`](Self::take) requires it.
    pub(crate) fn is_plain(&self) -> bool {
        self.listed.is_plain(self.indices.len())
    }

    /// Visits all tiles that list any of them; some more than once.
    pub(crate) fn for_each_tile(&self, grid: &Grid, visit: impl FnMut(u32)) {
        self.listed.for_each_tile_of(grid, |_| true, visit);
    }
}
