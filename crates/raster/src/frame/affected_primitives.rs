//! Which primitives of a chunk look different when vertices have changed, and which lie elsewhere.

use super::DrawChange;
use super::bits::is_set;
use super::changed_vertices::{ChangedVertices, VertexBits};
use crate::bin::Chunk;
use crate::geometry::{Geometry, Shape};
use crate::outer_ink::parts;
use crate::pass::RecordedDraw;
use crate::vertex::Slots;
use crate::view::Plan;
use std::ops::Range;

/// Primitives that are left out together.
const BLOCK: usize = 64;

/// What was found out about each primitive of a chunk.
#[derive(Default)]
pub(super) struct AffectedPrimitives {
    /// Whether it looks different.
    pub(super) differs: Vec<bool>,
    /// Whether it lies elsewhere.
    pub(super) is_moved: Vec<bool>,
    /// Whether any does.
    pub(super) any_differs: bool,
    pub(super) any_moved: bool,
}

impl AffectedPrimitives {
    /// Starts with `count` primitives, none of them affected.
    fn reset(&mut self, count: usize) {
        (self.any_differs, self.any_moved) = (false, false);
        for flags in [&mut self.differs, &mut self.is_moved] {
            flags.clear();
            flags.resize(count, false);
        }
    }

    fn note_different(&mut self, index: usize) {
        (self.differs[index], self.any_differs) = (true, true);
    }

    /// It also looks different.
    fn note_moved(&mut self, index: usize) {
        self.note_different(index);
        (self.is_moved[index], self.any_moved) = (true, true);
    }
}

/// What the search for affected primitives reads.
#[derive(Clone, Copy)]
pub(super) struct AffectedSearch<'a> {
    pub(super) pass: &'a [RecordedDraw<'a>],
    pub(super) plan: &'a Plan,
    pub(super) vertices: &'a ChangedVertices,
    pub(super) changes: &'a [DrawChange<'a>],
    /// Whether edges of faces are painted: then a face looks different as a whole.
    pub(super) has_edges: bool,
}

impl AffectedSearch<'_> {
    /// Finds the affected primitives of a chunk.
    pub(super) fn find(&self, chunk: &Chunk, affected: &mut AffectedPrimitives) {
        affected.reset(chunk.ordinals.len());
        for (draw, range) in self.plan.parts(chunk.ordinals.clone()) {
            if range.is_empty() {
                continue;
            }
            // Draws without triangles end where they begin.
            let number = self.plan.draws.partition_point(|other| other.ordinals.end <= draw.ordinals.start);
            let search = DrawSearch {
                slots: self.plan.slots(draw),
                geometry: &self.pass[draw.draw].geometry,
                change: self.changes[draw.draw],
                vertices: self.vertices.of_draw(number),
                first: (draw.ordinals.start + range.start - chunk.ordinals.start) as usize,
                range,
            };
            match search.geometry.shape {
                Shape::Triangles { triangles, .. } => {
                    search.find_triangles(triangles, self.has_edges, affected);
                }
                Shape::Lines { segments, .. } => search.find_others(segments, affected),
                Shape::Points { points, .. } => search.find_others(points.as_chunks::<1>().0, affected),
            }
        }
    }
}

/// Looks for affected primitives among some of a draw.
struct DrawSearch<'a> {
    slots: Slots<'a>,
    geometry: &'a Geometry<'a>,
    /// With the primitives that are known to look different.
    change: DrawChange<'a>,
    vertices: VertexBits<'a>,
    /// The primitives of the draw that are examined.
    range: Range<u32>,
    /// The index of the first of them in the chunk.
    first: usize,
}

impl DrawSearch<'_> {
    /// Flags triangles, and the others of their faces if these have edges.
    fn find_triangles(&self, triangles: &[[u32; 3]], has_edges: bool, affected: &mut AffectedPrimitives) {
        if !has_edges {
            return self.find_others(triangles, affected);
        }
        let mut seeds = Vec::new();
        self.for_each_changed(triangles, |triangle, is_moved| {
            seeds.push(triangle);
            if is_moved {
                affected.note_moved(self.index(triangle));
            }
        });
        let reshaped = within(self.change.reshaped, &self.range);
        reshaped.iter().for_each(|&triangle| affected.note_moved(self.index(triangle)));
        seeds.extend(reshaped);
        seeds.extend(within(self.change.recolored, &self.range));
        self.add_beside(&mut seeds);
        for seed in seeds {
            let own = parts(self.geometry, seed).chain([seed]).filter(|part| self.range.contains(part));
            own.for_each(|part| affected.note_different(self.index(part)));
        }
    }

    /// Flags primitives that have nothing to do with others.
    fn find_others<const N: usize>(&self, primitives: &[[u32; N]], affected: &mut AffectedPrimitives) {
        self.for_each_changed(primitives, |primitive, is_moved| match is_moved {
            true => affected.note_moved(self.index(primitive)),
            false => affected.note_different(self.index(primitive)),
        });
        let recolored = within(self.change.recolored, &self.range);
        recolored.iter().for_each(|&primitive| affected.note_different(self.index(primitive)));
        let reshaped = within(self.change.reshaped, &self.range);
        reshaped.iter().for_each(|&primitive| affected.note_moved(self.index(primitive)));
    }

    /// Visits the primitives of which a vertex has changed, and whether one was moved.
    fn for_each_changed<const N: usize>(&self, primitives: &[[u32; N]], mut visit: impl FnMut(u32, bool)) {
        let VertexBits { least, greatest, changed, moved } = self.vertices;
        // Mostly only colours change.
        let range = if least <= greatest { self.range.clone() } else { 0..0 };
        let primitives = &primitives[range.start as usize..range.end as usize];
        for (block, first) in primitives.chunks(BLOCK).zip((range.start..).step_by(BLOCK)) {
            // Without a way out after each, several are tested at once.
            let is_near = |any: bool, &vertex: &u32| any | (vertex >= least) & (vertex <= greatest);
            if !block.as_flattened().iter().fold(false, is_near) {
                continue;
            }
            for (&corners, primitive) in block.iter().zip(first..) {
                if self.has(changed, corners) {
                    visit(primitive, self.has(moved, corners));
                }
            }
        }
    }

    /// Adds triangles beside the range that belong to faces in it, and look different.
    fn add_beside(&self, seeds: &mut Vec<u32>) {
        let ends = [self.range.start, self.range.end - 1].map(|end| parts(self.geometry, end));
        let is_beside = |triangle: &u32| {
            let is_listed = |list: &[u32]| list.binary_search(triangle).is_ok();
            !self.range.contains(triangle)
                && (self.has(self.vertices.changed, self.geometry.corners(*triangle))
                    || is_listed(self.change.reshaped)
                    || is_listed(self.change.recolored))
        };
        seeds.extend(ends.into_iter().flatten().filter(is_beside));
    }

    /// The index in the chunk of a primitive of the draw.
    #[inline(always)]
    fn index(&self, primitive: u32) -> usize {
        self.first + (primitive - self.range.start) as usize
    }

    /// Whether the bit of a corner is set.
    #[inline(always)]
    fn has<const N: usize>(&self, bits: &[u64], corners: [u32; N]) -> bool {
        corners.iter().fold(false, |any, &corner| any | is_set(bits, self.slots.of(corner)))
    }
}

/// Those of some increasing numbers that lie in a range.
fn within<'a>(list: &'a [u32], range: &Range<u32>) -> &'a [u32] {
    let at = |at: u32| list.partition_point(|&number| number < at);
    &list[at(range.start)..at(range.end)]
}
