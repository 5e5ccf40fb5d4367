//! Set-up: primitives become triangles that are ready for the tiles. Triangles are culled and entered in the bins
//! of the tiles that they touch.
//!
//! Vertices come snapped from the vertex stage (`vertex/screen.rs`). A vertex has no point on the grid if its w is
//! below `W_MIN`, or if it lies on the eye's side of the near plane or outside the guard band. Nor has an invalid
//! vertex: a coordinate is NaN or beyond `COORDINATE_MAX`. Triangles with an invalid vertex, and those that lie
//! beyond one plane as a whole, are dropped. Other triangles that have a vertex without a point are cut here, and
//! all corners of the result are snapped here (`Setup::snap`). A corner that was a vertex gets the same point as
//! in the vertex stage, so no gap opens beside a neighbour that is not cut. If the shared edge itself is cut, one
//! of its vertices has no point on the grid, so the neighbour is cut as well.
//!
//! In the order in which a triangle passes through:
//!
//! | file | what it holds |
//! |---|---|
//! | `eight` | culls and bins whole triangles, eight at a time; most triangles need only this file |
//! | `mod` | one triangle at a time ([`Setup::triangle`]): cuts it, snaps the result, culls, bins |
//! | `ears` | cuts the snapped polygon into triangles |
//!
//! Triangles that need no cutting and are small are culled and binned by `eight`. The others go through
//! [`Setup::triangle`] one by one. The result is a record of [`primitive`](crate::primitive).

mod ears;
mod eight;
#[cfg(test)]
mod tests;

pub(crate) use ears::{cut_ears, doubled_area};
pub(crate) use eight::EightPrimitives;

use crate::bin::{Chunk, Entry, Grid};
use crate::primitive::{Corners, CutWeights, Kind, Quad, SetupTriangle, sorted};
use crate::simd::{LANES, Simd, U32, prelude::*};
use crate::vertex::{DrawVertices, ScreenVertex};
use crate::{Culling, clip};
use trigon_math::{ClipVertex, ClipVolume};

/// Sets up primitives of one draw into a chunk.
pub(crate) struct Setup<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) volume: ClipVolume,
    pub(crate) vertices: DrawVertices<'a>,
    /// Ordinal of the draw's first primitive in the frame.
    pub(crate) first: u32,
    pub(crate) culling: Culling,
    pub(crate) chunk: &'a mut Chunk,
}

/// Three vertices of a cut triangle, to be made into a record.
struct PolygonTriangle {
    vertices: [ScreenVertex; 3],
    primitive: u32,
    /// The corner that each column of the weights is for.
    order: [u8; 3],
    front_facing: bool,
}

impl Setup<'_> {
    /// The index of a primitive of the draw in the chunk.
    #[inline(always)]
    pub(crate) fn index_in_chunk(&self, primitive: u32) -> u32 {
        self.first + primitive - self.chunk.ordinals.start
    }

    /// The same for lanes.
    #[inline(always)]
    pub(crate) fn indices_in_chunk<S: Simd>(&self, simd: S, primitives: [u32; LANES]) -> U32<S> {
        // The difference may wrap around; the sum does so once more.
        U32::simd_from(simd, primitives) + self.first.wrapping_sub(self.chunk.ordinals.start)
    }

    /// One triangle of the draw.
    #[inline(never)]
    pub(crate) fn triangle(&mut self, primitive: u32, indices: [u32; 3]) {
        let vertices = indices.map(|index| *self.vertices.get(index));
        if vertices.iter().all(|vertex| vertex.is_snapped()) {
            return self.whole_triangle(primitive, vertices);
        }
        let [a, b, c] = indices.map(|index| self.vertices.outcode(index));
        if a.union(b).union(c).is_invalid() {
            self.chunk.stats.invalid += 1;
        } else if a.intersection(b).intersection(c).hides() {
            self.chunk.stats.outside += 1;
        } else {
            self.cut_triangle(primitive, indices);
        }
    }

    fn whole_triangle(&mut self, primitive: u32, vertices: [ScreenVertex; 3]) {
        let triangle = SetupTriangle::whole(vertices, self.first + primitive);
        let [a, b, c] = vertices.map(ScreenVertex::point);
        let area = trigon_math::orientation_fixed(a, b, c);
        if self.is_culled(area) || self.grid.pixels_of(&triangle).is_none() {
            self.chunk.stats.culled += 1;
            return;
        }
        self.chunk.stats.set_up += 1;
        let entry = Entry::primitive(self.index_in_chunk(primitive));
        self.chunk.push_all(self.grid, &triangle, entry);
    }

    fn cut_triangle(&mut self, primitive: u32, indices: [u32; 3]) {
        let positions = indices.map(|index| self.vertices.position(index));
        let cut = clip::cut_triangle(positions, &self.volume);
        let vertices = cut.polygon.vertices();
        self.chunk.stats.clipped += 1;
        let mut snapped = [ScreenVertex::default(); clip::MOST_VERTICES];
        let Some(screen) = self.snap(vertices, &mut snapped) else {
            self.chunk.stats.outside += 1;
            return;
        };
        // `clip::cut_triangle` sorts the corners, which may have reversed their winding.
        let area = doubled_area(screen) * cut.winding;
        if self.is_culled(area) {
            self.chunk.stats.culled += 1;
            return;
        }
        cut_ears(screen, |ear| {
            let candidate = PolygonTriangle {
                vertices: ear.map(|i| screen[i]),
                primitive,
                order: cut.order,
                front_facing: area < 0,
            };
            self.push(candidate, ear.map(|i| vertices[i].weights));
        });
    }

    /// Snaps the corners of a cut triangle to the sub-pixel grid, the original corners among them
    /// too. Those get the same bits as in the vertex stage (`snap` in `vertex/screen.rs` says why), so
    /// that no gap opens to a neighbour that is not cut. `None` if nothing is left, or a corner lies
    /// outside the grid.
    fn snap<'p>(
        &self,
        vertices: &[ClipVertex],
        snapped: &'p mut [ScreenVertex],
    ) -> Option<&'p [ScreenVertex]> {
        let snapped = &mut snapped[..vertices.len()];
        for (screen, vertex) in snapped.iter_mut().zip(vertices) {
            *screen = ScreenVertex::of(vertex.position, self.grid.viewport)?;
        }
        (snapped.len() >= 3).then_some(snapped)
    }

    fn is_culled(&self, area: i64) -> bool {
        match self.culling {
            Culling::None => area == 0,
            Culling::Back => area >= 0,
            Culling::Front => area <= 0,
        }
    }

    /// Sorts the vertices and keeps the triangle if it can hold a sample of the
    /// view.
    fn push(&mut self, candidate: PolygonTriangle, weights: CutWeights) {
        let order = sorted(candidate.vertices);
        let triangle = SetupTriangle {
            vertices: order.map(|i| candidate.vertices[i]),
            ordinal: self.first + candidate.primitive,
            corners: Corners::Cut { weights: self.chunk.weights.len() as u32, order: candidate.order },
            kind: Kind::Triangle,
            front_facing: candidate.front_facing,
        };
        if triangle.doubled_area() == 0 || self.grid.pixels_of(&triangle).is_none() {
            self.chunk.stats.culled += 1;
            return;
        }
        self.chunk.stats.set_up += 1;
        self.chunk.weights.push(order.map(|i| weights[i]));
        let entry = Entry::extra(self.chunk.extras.len());
        self.chunk.push_all(self.grid, &triangle, entry);
        self.chunk.extras.push(triangle);
    }

    /// Keeps a line or a point if it can hold a sample of the view.
    pub(crate) fn push_quad(&mut self, quad: Quad) {
        if self.chunk.push_quad(self.grid, quad) {
            self.chunk.stats.set_up += 1;
        } else {
            self.chunk.stats.culled += 1;
        }
    }
}
