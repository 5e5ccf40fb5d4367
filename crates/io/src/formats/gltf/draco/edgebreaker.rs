//! Triangles that are stored as a walk over the surface (EdgeBreaker, Rossignac 1999), rebuilt from
//! the last triangle of the walk to the first.

use std::collections::HashMap;

use super::Stream;
use super::attributes::{MeshShape, Tables};
use super::attributes::{Numbered, number_points};
use super::corners::{CornerTable, NONE, next, previous};
use super::corners::{read_seams, split_at_seams};
use super::symbols::Bits;
use super::symbols::Budget;
use super::symbols::Failure;
use super::walk::{Symbol, Walk, WalkHeader};
use crate::formats::gltf::stream::Broken;

pub(super) fn read_triangles(stream: &mut Stream<'_>, budget: &mut Budget) -> Result<MeshShape, Failure> {
    let header = WalkHeader::read(stream)?;
    // The table, the points, and a table for each kind of attribute.
    budget.spend(header.faces.saturating_mul(12))?;
    budget.spend(header.faces.saturating_mul(7 * usize::from(header.seam_kinds)))?;
    budget.spend(header.most_vertices.saturating_mul(4))?;
    let joins = read_joins(stream, &header, budget)?;
    let mut walk = Walk::read(stream, &header, budget)?;
    let mut builder = Builder::new(&header, joins);
    for number in 0..header.symbols {
        let symbol = walk.symbol()?;
        builder.add(number, symbol, &mut walk, budget)?;
    }
    builder.close(&mut walk)?;
    let seams = read_seams(&builder.table, &mut walk.seams);
    if seams.is_empty() {
        builder.remove_merged()?;
    }
    let Builder { table: positions, is_closed, .. } = builder;
    let attributes = seams.into_iter().map(|seams| split_at_seams(&positions, seams)).collect();
    let tables = Tables { positions, attributes };
    let Numbered { points, triangles } = number_points(&tables, &is_closed)?;
    Ok(MeshShape { points, triangles, tables: Some(tables) })
}

/// A place where the walk split, so that two parts join when it is rebuilt.
struct Join {
    /// The symbol after which the corner of the other part is known, counted from the last.
    source: u32,
    /// The symbol that joins.
    split: u32,
    is_right: bool,
}

fn read_joins(
    stream: &mut Stream<'_>,
    header: &WalkHeader,
    budget: &mut Budget,
) -> Result<Vec<Join>, Failure> {
    let count = stream.varint()? as usize;
    if count > header.faces {
        return Err("its walk splits too often".into());
    }
    budget.spend(3 * count)?;
    let mut joins = Vec::with_capacity(count);
    let mut last: u32 = 0;
    for _ in 0..count {
        let source = last.checked_add(stream.varint()?);
        let source = source.filter(|&source| source < header.symbols).ok_or(WRONG_JOIN)?;
        let split = source.checked_sub(stream.varint()?).ok_or(WRONG_JOIN)?;
        joins.push(Join { source, split, is_right: false });
        last = source;
    }
    if count > 0 {
        let mut bits = Bits::new(stream.0);
        for join in &mut joins {
            join.is_right = bits.take(1)? == 1;
        }
        stream.0 = bits.rest();
    }
    Ok(joins)
}

const WRONG_JOIN: Broken = "its walk splits at a triangle that does not exist";
const WRONG_WALK: Broken = "its walk joins triangles that are not free";

/// The mesh under construction.
struct Builder {
    table: CornerTable,
    /// Whether the triangles around each vertex close.
    is_closed: Vec<bool>,
    most_vertices: usize,
    symbols: u32,
    faces: u32,
    /// The corner where the walk stands in each part, the current part last.
    active: Vec<u32>,
    /// In increasing order.
    joins: Vec<Join>,
    /// The corners of other parts, by the symbol that joins them.
    waiting: HashMap<u32, u32>,
    /// The vertices that turned out to be others.
    merged: Vec<u32>,
}

impl Builder {
    fn new(header: &WalkHeader, joins: Vec<Join>) -> Self {
        Self {
            table: CornerTable::with_triangles(header.faces),
            is_closed: vec![false; header.most_vertices],
            most_vertices: header.most_vertices,
            symbols: header.symbols,
            faces: 0,
            active: Vec::new(),
            joins,
            waiting: HashMap::new(),
            merged: Vec::new(),
        }
    }

    fn add(
        &mut self,
        number: u32,
        symbol: Symbol,
        walk: &mut Walk<'_>,
        budget: &mut Budget,
    ) -> Result<(), Failure> {
        // There are as many triangles as symbols, or more.
        let corner = 3 * self.faces;
        self.faces += 1;
        match symbol {
            Symbol::Close => self.close_vertex(corner)?,
            Symbol::Left | Symbol::Right => self.extend(corner, symbol)?,
            Symbol::Split => self.join(number, corner, walk, budget)?,
            Symbol::End => self.start(corner)?,
        }
        walk.stand_at(corner, &self.table);
        if matches!(symbol, Symbol::Left | Symbol::Right | Symbol::End) {
            self.note_joins(number, corner)?;
        }
        Ok(())
    }

    /// The corner where the walk stands.
    fn top(&self) -> Result<u32, Broken> {
        self.active.last().copied().ok_or("its walk starts nowhere")
    }

    fn push_vertex(&mut self, corner: u32) -> Result<u32, Broken> {
        let vertex = self.table.first.len();
        if vertex >= self.most_vertices {
            return Err("its walk has more vertices than it says");
        }
        self.table.first.push(corner);
        Ok(vertex as u32)
    }

    /// Joins triangles across an edge that both have free.
    fn connect(&mut self, corner: u32, other: u32) -> Result<(), Broken> {
        if corner == other || other == NONE || self.table.opposite(other) != NONE {
            return Err(WRONG_WALK);
        }
        self.table.opposites[corner as usize] = other;
        self.table.opposites[other as usize] = corner;
        Ok(())
    }

    fn set_vertices(&mut self, corner: u32, vertices: [u32; 3]) -> Result<(), Broken> {
        if vertices.contains(&NONE) {
            return Err(WRONG_WALK);
        }
        self.table.vertices[corner as usize..][..3].copy_from_slice(&vertices);
        Ok(())
    }

    /// The corner that faces the free edge to the left of a vertex.
    fn facing_left_of(&self, vertex: u32) -> u32 {
        next(self.table.first(vertex))
    }

    fn close_vertex(&mut self, corner: u32) -> Result<(), Broken> {
        let a = self.top()?;
        let middle = self.table.vertex(next(a));
        let b = self.facing_left_of(middle);
        if a == b {
            return Err(WRONG_WALK);
        }
        let (before, after) = (self.table.vertex(previous(a)), self.table.vertex(next(b)));
        if middle == before || middle == after {
            return Err(WRONG_WALK);
        }
        self.connect(corner + 1, a)?;
        self.connect(corner + 2, b)?;
        self.set_vertices(corner, [middle, after, before])?;
        self.table.first[before as usize] = corner + 2;
        self.is_closed[middle as usize] = true;
        *self.active.last_mut().expect("it has a top") = corner;
        Ok(())
    }

    fn extend(&mut self, corner: u32, symbol: Symbol) -> Result<(), Broken> {
        let a = self.top()?;
        let (left, right) = (self.table.vertex(next(a)), self.table.vertex(previous(a)));
        let (tip, at_right) = match symbol {
            Symbol::Right => (corner + 2, corner),
            _ => (corner + 1, corner + 2),
        };
        self.connect(tip, a)?;
        let new = self.push_vertex(tip)?;
        let vertices = match symbol {
            Symbol::Right => [right, left, new],
            _ => [left, new, right],
        };
        self.set_vertices(corner, vertices)?;
        self.table.first[right as usize] = at_right;
        *self.active.last_mut().expect("it has a top") = corner;
        Ok(())
    }

    /// Joins the current part with another one, at a vertex of each that is the same.
    fn join(
        &mut self,
        number: u32,
        corner: u32,
        walk: &mut Walk<'_>,
        budget: &mut Budget,
    ) -> Result<(), Failure> {
        let b = self.active.pop().ok_or("its walk starts nowhere")?;
        self.active.extend(self.waiting.remove(&number));
        let a = self.top()?;
        if a == b {
            return Err(WRONG_WALK.into());
        }
        self.connect(corner + 2, a)?;
        self.connect(corner + 1, b)?;
        let (retained, gone) = (self.table.vertex(previous(a)), self.table.vertex(next(b)));
        let behind = self.table.vertex(previous(b));
        self.set_vertices(corner, [retained, self.table.vertex(next(a)), behind])?;
        self.table.first[behind as usize] = corner + 2;
        walk.merge(retained, gone);
        self.table.first[retained as usize] = self.table.first(gone);
        self.rename(next(b), retained, budget)?;
        self.table.first[gone as usize] = NONE;
        self.merged.push(gone);
        *self.active.last_mut().expect("it has a top") = corner;
        Ok(())
    }

    /// Gives a vertex to a corner and to those left of it.
    fn rename(&mut self, start: u32, vertex: u32, budget: &mut Budget) -> Result<(), Failure> {
        let (mut corner, mut steps) = (start, 0);
        while corner != NONE {
            self.table.vertices[corner as usize] = vertex;
            corner = self.table.swing_left(corner);
            steps += 1;
            if corner == start {
                return Err(WRONG_WALK.into());
            }
        }
        // Vertices with many triangles may be merged again and again.
        budget.spend(steps)
    }

    fn start(&mut self, corner: u32) -> Result<(), Broken> {
        let vertices =
            [self.push_vertex(corner)?, self.push_vertex(corner + 1)?, self.push_vertex(corner + 2)?];
        self.set_vertices(corner, vertices)?;
        self.active.push(corner);
        Ok(())
    }

    /// Notes the corners that later symbols join with other parts.
    fn note_joins(&mut self, number: u32, corner: u32) -> Result<(), Broken> {
        let from_end = self.symbols - number - 1;
        while let Some(join) = self.joins.pop_if(|join| join.source >= from_end) {
            if join.source > from_end {
                return Err(WRONG_JOIN);
            }
            let free = if join.is_right { next(corner) } else { previous(corner) };
            self.waiting.insert(self.symbols - join.split - 1, free);
        }
        Ok(())
    }

    /// Adds the triangles that close the last hole of parts.
    fn close(&mut self, walk: &mut Walk<'_>) -> Result<(), Broken> {
        let all = self.table.vertices.len() as u32;
        while let Some(a) = self.active.pop() {
            if !walk.closes.take() {
                continue;
            }
            let corner = 3 * self.faces;
            if corner >= all {
                return Err("its walk has more triangles than it says");
            }
            self.faces += 1;
            let first = self.table.vertex(next(a));
            let b = self.facing_left_of(first);
            let second = self.table.vertex(next(b));
            let c = self.facing_left_of(second);
            let third = self.table.vertex(next(c));
            self.connect(corner, a)?;
            self.connect(corner + 1, b)?;
            self.connect(corner + 2, c)?;
            self.set_vertices(corner, [second, third, first])?;
            for vertex in [first, second, third] {
                self.is_closed[vertex as usize] = true;
            }
        }
        if 3 * self.faces < all {
            return Err("its walk has fewer triangles than it says");
        }
        Ok(())
    }

    /// Moves the last vertices to the places of those that were merged. Only meshes without seams
    /// keep the numbers of vertices.
    fn remove_merged(&mut self) -> Result<(), Broken> {
        for gone in std::mem::take(&mut self.merged) {
            while self.table.first.last() == Some(&NONE) {
                self.table.first.pop();
            }
            let last = self.table.first.len().saturating_sub(1) as u32;
            if last < gone {
                continue;
            }
            let corners: Vec<u32> = self.table.around(self.table.first(last)).collect();
            for corner in corners {
                if self.table.vertex(corner) != last {
                    return Err(WRONG_WALK);
                }
                self.table.vertices[corner as usize] = gone;
            }
            self.table.first[gone as usize] = self.table.first(last);
            self.table.first.pop();
        }
        Ok(())
    }
}
