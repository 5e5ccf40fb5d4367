//! Triangles of the pass become records that are ready for the tiles: cut where
//! needed, snapped, sorted, culled.

mod ears;
mod triangle;

pub(crate) use ears::{cut_ears, doubled_area};
pub(crate) use triangle::{Corners, Kind, SampleBounds, ScreenVertex, SetupTriangle};

use crate::clip;
use crate::vertex::VertexStore;
use crate::viewport::Viewport;
use crate::{Culling, Stats};
use trigon_math::{ClipVertex, ClipVolume};

/// The weights of a primitive's corners at the vertices of a cut triangle:
/// `[vertex][corner]`.
pub(crate) type CutWeights = [[f32; 3]; 3];

/// What set-up leaves of a run of primitives, in their order.
#[derive(Default)]
pub(crate) struct SetupBatch {
    pub(crate) triangles: Vec<SetupTriangle>,
    pub(crate) weights: Vec<CutWeights>,
    pub(crate) stats: Stats,
}

impl SetupBatch {
    /// Appends a batch that follows.
    pub(crate) fn append(&mut self, mut next: Self) {
        let base = self.weights.len() as u32;
        for triangle in &mut next.triangles {
            if let Corners::Cut { weights, .. } = &mut triangle.corners {
                *weights += base;
            }
        }
        self.triangles.append(&mut next.triangles);
        self.weights.append(&mut next.weights);
        self.stats += next.stats;
    }
}

/// Sets up the primitives of one draw.
pub(crate) struct Setup<'a> {
    pub(crate) viewport: Viewport,
    pub(crate) volume: &'a ClipVolume,
    pub(crate) vertices: &'a VertexStore<'a>,
    pub(crate) draw: u32,
    pub(crate) culling: Culling,
    pub(crate) batch: SetupBatch,
}

/// Three vertices on their way into a record.
pub(crate) struct Candidate {
    pub(crate) vertices: [ScreenVertex; 3],
    pub(crate) primitive: u32,
    pub(crate) corners: [u8; 3],
    pub(crate) kind: Kind,
    pub(crate) front_facing: bool,
}

impl Setup<'_> {
    /// One triangle of the draw.
    pub(crate) fn triangle(&mut self, primitive: u32, indices: [u32; 3]) {
        self.batch.stats.primitives += 1;
        let Some(slots) = self.vertices.slots(indices) else {
            self.batch.stats.invalid += 1;
            return;
        };
        let [a, b, c] = slots.map(|slot| self.vertices.outcode(slot));
        let any = a.union(b).union(c);
        if any.is_invalid() {
            self.batch.stats.invalid += 1;
        } else if a.intersection(b).intersection(c).hides() {
            self.batch.stats.outside += 1;
        } else if any.cuts() {
            self.cut_triangle(primitive, slots);
        } else {
            self.whole_triangle(primitive, slots);
        }
    }

    fn whole_triangle(&mut self, primitive: u32, slots: [usize; 3]) {
        let vertices = slots.map(|slot| self.vertices.screen(slot));
        let [a, b, c] = vertices.map(|v| v.point);
        // Positive is clockwise on the screen.
        let area = trigon_math::orientation_fixed(a, b, c);
        if self.is_culled(area) {
            self.batch.stats.culled += 1;
            return;
        }
        let corners = [0, 1, 2];
        let front_facing = area < 0;
        let candidate = Candidate { vertices, primitive, corners, kind: Kind::Triangle, front_facing };
        self.push(candidate, None);
    }

    fn cut_triangle(&mut self, primitive: u32, slots: [usize; 3]) {
        let positions = slots.map(|slot| self.vertices.position(slot));
        let cut = clip::cut_triangle(positions, self.volume);
        let vertices = cut.polygon.vertices();
        self.batch.stats.clipped += 1;
        let Some(screen) = self.snap(vertices) else {
            self.batch.stats.outside += 1;
            return;
        };
        let points: Vec<_> = screen.iter().map(|v| v.point).collect();
        // Sorting the corners may have turned the triangle over.
        let area = doubled_area(&points) * cut.winding;
        if self.is_culled(area) {
            self.batch.stats.culled += 1;
            return;
        }
        cut_ears(&points, |ear| {
            let candidate = Candidate {
                vertices: ear.map(|i| screen[i]),
                primitive,
                corners: cut.order,
                kind: Kind::Triangle,
                front_facing: area < 0,
            };
            self.push(candidate, Some(ear.map(|i| vertices[i].weights)));
        });
    }

    /// `None` if nothing is left, or a vertex has no place on the grid.
    fn snap(&self, vertices: &[ClipVertex]) -> Option<Vec<ScreenVertex>> {
        let screen = |v: &ClipVertex| ScreenVertex::new(v.position, self.viewport);
        (vertices.len() >= 3).then(|| vertices.iter().map(screen).collect())?
    }

    fn is_culled(&self, area: i64) -> bool {
        match self.culling {
            Culling::None => area == 0,
            Culling::Back => area >= 0,
            Culling::Front => area <= 0,
        }
    }

    /// Sorts the vertices and keeps the record if it can hold a sample of the
    /// view.
    pub(crate) fn push(&mut self, mut candidate: Candidate, weights: Option<CutWeights>) {
        let mut order = [0, 1, 2];
        order.sort_unstable_by_key(|&i| {
            let point = candidate.vertices[i].point;
            (point.y.raw(), point.x.raw())
        });
        candidate.vertices = order.map(|i| candidate.vertices[i]);
        let corners = match weights {
            None => Corners::Whole(order.map(|i| candidate.corners[i])),
            Some(_) => Corners::Cut { weights: self.batch.weights.len() as u32, order: candidate.corners },
        };
        let triangle = SetupTriangle {
            vertices: candidate.vertices,
            draw: self.draw,
            primitive: candidate.primitive,
            corners,
            kind: candidate.kind,
            front_facing: candidate.front_facing,
        };
        if !self.can_be_seen(&triangle) {
            self.batch.stats.culled += 1;
            return;
        }
        self.batch.stats.set_up += 1;
        self.batch.weights.extend(weights.map(|weights| order.map(|i| weights[i])));
        self.batch.triangles.push(triangle);
    }

    fn can_be_seen(&self, triangle: &SetupTriangle) -> bool {
        let Some(SampleBounds { x, y }) = triangle.sample_bounds() else {
            return false;
        };
        let (width, height) = (self.viewport.width as i32, self.viewport.height as i32);
        x[1] >= 0 && y[1] >= 0 && x[0] < width && y[0] < height && triangle.doubled_area() != 0
    }
}
