//! The symbols of the walk over a surface: how each triangle joins those before it.

use super::Stream;
use super::corners::{CornerTable, NONE, next, previous};
use super::symbols::Bits;
use super::symbols::Budget;
use super::symbols::Failure;
use super::symbols::LikelyBits;
use super::symbols::read_symbols;
use crate::formats::gltf::stream::Broken;

/// How a triangle joins those before it, as Rossignac's EdgeBreaker (1999) names the cases.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Symbol {
    /// At two edges: it closes the triangles around a vertex.
    Close,
    /// At two edges: it joins two parts.
    Split,
    /// At its left edge, with a new vertex.
    Left,
    /// At its right edge, with a new vertex.
    Right,
    /// At none: it starts a part.
    End,
}

/// The symbols in the order in which they are numbered.
const NUMBERED: [Symbol; 5] = [Symbol::Close, Symbol::Split, Symbol::Left, Symbol::Right, Symbol::End];

/// How many neighbours of a vertex are told apart when the next symbol is stored.
const FEWEST_NEIGHBOURS: u32 = 2;
const MOST_NEIGHBOURS: u32 = 7;

/// The numbers before a walk.
pub(super) struct WalkHeader {
    /// How symbols are stored.
    pub(super) walk_kind: u8,
    pub(super) faces: usize,
    /// How many kinds of attributes have seams of their own.
    pub(super) seam_kinds: u8,
    pub(super) symbols: u32,
    /// The maximum number of vertices, with those that are merged on the way.
    pub(super) most_vertices: usize,
}

impl WalkHeader {
    pub(super) fn read(stream: &mut Stream<'_>) -> Result<Self, Broken> {
        let walk_kind = stream.byte()?;
        let (vertices, faces) = (stream.varint()?, stream.varint()?);
        let seam_kinds = stream.byte()?;
        let (symbols, splits) = (stream.varint()?, stream.varint()?);
        // Each part has at most one triangle without a symbol, and at least three with.
        if faces < symbols || faces - symbols > symbols / 3 || splits > symbols {
            return Err("its triangles are not as many as its walk has");
        }
        if faces > NONE / 3 || vertices > 3 * faces {
            return Err("it has too many vertices");
        }
        let most_vertices = vertices as usize + splits as usize;
        Ok(Self { walk_kind, faces: faces as usize, seam_kinds, symbols, most_vertices })
    }
}

/// Everything that the stream holds about a walk.
pub(super) struct Walk<'b> {
    symbols: Symbols<'b>,
    /// Of each part: whether a triangle closes its last hole.
    pub(super) closes: LikelyBits<'b>,
    /// Of each kind of attribute: whether an edge is a seam.
    pub(super) seams: Vec<LikelyBits<'b>>,
}

enum Symbols<'b> {
    /// One after the other.
    Plain(Bits<'b>),
    /// Apart for each number of neighbours of the vertex where the walk stands.
    ByNeighbours(ByNeighbours),
}

struct ByNeighbours {
    /// The symbols for each number of neighbours, the last one first.
    lists: Vec<Vec<u32>>,
    /// How many neighbours each vertex has so far.
    neighbours: Vec<u32>,
    /// The list of the next symbol; none before the first.
    list: Option<usize>,
    last: Symbol,
}

impl<'b> Walk<'b> {
    pub(super) fn read(
        stream: &mut Stream<'b>,
        header: &WalkHeader,
        budget: &mut Budget,
    ) -> Result<Self, Failure> {
        let plain = match header.walk_kind {
            0 => Some(Symbols::Plain(Bits::new(stream.counted_bytes()?))),
            2 => None,
            _ => return Err(Failure::Foreign("a walk of an old kind")),
        };
        let closes = LikelyBits::open(stream)?;
        let seams = (0..header.seam_kinds).map(|_| LikelyBits::open(stream)).collect::<Result<_, _>>()?;
        let symbols = match plain {
            Some(plain) => plain,
            None => Symbols::ByNeighbours(ByNeighbours::read(stream, header, budget)?),
        };
        Ok(Self { symbols, closes, seams })
    }

    pub(super) fn symbol(&mut self) -> Result<Symbol, Broken> {
        match &mut self.symbols {
            Symbols::Plain(bits) => match bits.take(1)? {
                0 => Ok(Symbol::Close),
                _ => Ok(NUMBERED[1 + bits.take(2)? as usize]),
            },
            Symbols::ByNeighbours(lists) => lists.symbol(),
        }
    }

    /// Tells where the walk stands after a symbol.
    pub(super) fn stand_at(&mut self, corner: u32, table: &CornerTable) {
        if let Symbols::ByNeighbours(lists) = &mut self.symbols {
            lists.stand_at(corner, table);
        }
    }

    /// Tells that one vertex turned out to be another.
    pub(super) fn merge(&mut self, vertex: u32, gone: u32) {
        if let Symbols::ByNeighbours(ByNeighbours { neighbours, .. }) = &mut self.symbols {
            neighbours[vertex as usize] = neighbours[vertex as usize].wrapping_add(neighbours[gone as usize]);
        }
    }
}

impl ByNeighbours {
    fn read(stream: &mut Stream<'_>, header: &WalkHeader, budget: &mut Budget) -> Result<Self, Failure> {
        budget.spend(header.most_vertices)?;
        let mut lists = Vec::new();
        for _ in FEWEST_NEIGHBOURS..=MOST_NEIGHBOURS {
            let count = stream.varint()? as usize;
            lists.push(read_symbols(stream, count, 1, budget)?);
        }
        Ok(Self { lists, neighbours: vec![0; header.most_vertices], list: None, last: Symbol::End })
    }

    fn symbol(&mut self) -> Result<Symbol, Broken> {
        if let Some(list) = self.list {
            let number = self.lists[list].pop().ok_or("its walk has too few symbols")?;
            self.last = *NUMBERED.get(number as usize).ok_or("its walk has an unknown symbol")?;
        }
        Ok(self.last)
    }

    fn stand_at(&mut self, corner: u32, table: &CornerTable) {
        let added = match self.last {
            Symbol::Close | Symbol::Split => [0, 1, 1],
            Symbol::Right => [1, 1, 2],
            Symbol::Left => [1, 2, 1],
            Symbol::End => [2, 2, 2],
        };
        for (corner, added) in [corner, next(corner), previous(corner)].into_iter().zip(added) {
            let count = &mut self.neighbours[table.vertex(corner) as usize];
            *count = count.wrapping_add(added);
        }
        let here = self.neighbours[table.vertex(next(corner)) as usize];
        self.list = Some((here.clamp(FEWEST_NEIGHBOURS, MOST_NEIGHBOURS) - FEWEST_NEIGHBOURS) as usize);
    }
}
