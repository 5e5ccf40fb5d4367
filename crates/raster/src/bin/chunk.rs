//! A run of the frame's primitives, set up and sorted into tiles.

use super::{Grid, TileRange};
use crate::line::Stroke;
use crate::setup::{CutWeights, Kind, SetupTriangle};
use crate::simd::{Each, LANES, Mask, Simd, U32, append, prelude::*};
use crate::{Stats, Surface};
use std::ops::Range;

/// A triangle of a chunk: a primitive of it that is drawn as it is, or one of
/// the triangles made from a cut primitive, a line or a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Entry(u32);

impl Entry {
    const EXTRA: u32 = 1 << 31;

    /// The primitive at this place in the chunk, as it is.
    #[inline(always)]
    pub(crate) fn primitive(place: u32) -> Self {
        Self(place)
    }

    /// A triangle of the chunk's own.
    #[inline(always)]
    pub(crate) fn extra(index: usize) -> Self {
        Self(index as u32 | Self::EXTRA)
    }

    /// The place of a primitive in its chunk; `Err` with the index among the
    /// chunk's own triangles.
    #[inline(always)]
    pub(crate) fn place(self) -> Result<u32, usize> {
        if self.0 & Self::EXTRA == 0 { Ok(self.0) } else { Err((self.0 & !Self::EXTRA) as usize) }
    }
}

/// A triangle of a frame: a primitive that is drawn as it is, or one that its
/// chunk keeps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The primitive's ordinal in the frame.
    pub(crate) ordinal: u32,
    extra: u32,
}

impl Place {
    const WHOLE: u32 = u32::MAX;

    /// Whether it is simply a primitive.
    #[inline(always)]
    pub(crate) fn is_whole(self) -> bool {
        self.extra == Self::WHOLE
    }

    /// Its index among the chunk's own triangles.
    #[inline(always)]
    pub(crate) fn extra(self) -> Option<usize> {
        (!self.is_whole()).then_some(self.extra as usize)
    }
}

/// A triangle over many tiles, so that it is not listed in each.
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
    pub(crate) surface: Surface,
    /// Triangles that are not just primitives.
    pub(crate) extras: Vec<SetupTriangle>,
    /// Weights of the corners at the vertices of cut triangles.
    pub(crate) weights: Vec<CutWeights>,
    /// What the anti-aliased lines and points cover.
    strokes: Vec<Stroke>,
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
    /// Empties the chunk for another frame and keeps its memory.
    pub(crate) fn reset(&mut self, ordinals: Range<u32>, surface: Surface) {
        self.ordinals = ordinals;
        self.surface = surface;
        self.extras.clear();
        self.weights.clear();
        self.strokes.clear();
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

    /// Notes that some of eight primitives may have samples in one tile each.
    #[inline(always)]
    pub(crate) fn push_some<S: Simd>(&mut self, mask: Mask<S>, tiles: U32<S>, places: U32<S>) {
        let count = mask.to_bitmask().count_ones() as usize;
        let [tiles, places]: [[u32; LANES]; 2] = [tiles.compress(mask).into(), places.compress(mask).into()];
        append(&mut self.tiles, &tiles, count);
        append(&mut self.pushed, &places.each(Entry::primitive), count);
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

    /// Keeps a stroke for the triangles around it.
    pub(crate) fn keep_stroke(&mut self, stroke: Stroke) -> Kind {
        self.strokes.push(stroke);
        Kind::Stroke(self.strokes.len() as u32 - 1)
    }

    /// One of its strokes.
    pub(crate) fn stroke(&self, index: u32) -> &Stroke {
        &self.strokes[index as usize]
    }

    /// The stroke that one of the chunk's own triangles lies around.
    pub(crate) fn stroke_of(&self, extra: usize) -> Option<&Stroke> {
        match self.extras[extra].kind {
            Kind::Stroke(index) => Some(self.stroke(index)),
            _ => None,
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
        let Some(place) = tile.checked_sub(self.first_tile).map(|place| place as usize) else {
            return &[];
        };
        match (self.starts.get(place), self.starts.get(place + 1)) {
            (Some(&start), Some(&end)) => &self.entries[start as usize..end as usize],
            _ => &[],
        }
    }

    /// Appends the triangles of a tile to `places`, in the order of the
    /// primitives.
    pub(crate) fn collect(&self, grid: &Grid, tile: u32, places: &mut Vec<Place>) {
        let listed = self.listed(tile);
        if self.large.is_empty() {
            places.extend(listed.iter().map(|&entry| self.place(entry)));
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
                places.push(self.place(entry));
            }
            places.push(self.place(large.entry));
        }
        places.extend(listed.map(|entry| self.place(entry)));
    }

    /// The triangle of an entry.
    #[inline(always)]
    fn place(&self, entry: Entry) -> Place {
        match entry.place() {
            Ok(at) => Place { ordinal: self.ordinals.start + at, extra: Place::WHOLE },
            Err(extra) => Place { ordinal: self.extras[extra].ordinal, extra: extra as u32 },
        }
    }

    /// All triangles that any tile lists, in the order of the primitives.
    pub(crate) fn all(&self) -> impl Iterator<Item = Place> {
        let mut entries: Vec<_> =
            self.large.iter().map(|large| large.entry).chain(self.entries.clone()).collect();
        entries.sort_unstable_by_key(|&entry| (self.primitive(entry), entry.0));
        entries.dedup();
        entries.into_iter().map(|entry| self.place(entry))
    }

    /// The place in the chunk of the primitive that a triangle belongs to.
    #[inline]
    pub(crate) fn primitive(&self, entry: Entry) -> u32 {
        match entry.place() {
            Ok(place) => place,
            Err(extra) => self.extras[extra].ordinal - self.ordinals.start,
        }
    }

    /// Whether no tile has anything to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty() && self.large.is_empty()
    }
}
