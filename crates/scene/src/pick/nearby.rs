//! The objects of a scene near an area of an image, and their elements that may lie in it.
//!
//! A small area, such as around the pointer, contains few elements: whole boxes of triangles are skipped, and
//! nothing is stored (`small_region`). In a large area, the screen positions of all points are computed and stored,
//! and one byte per point records on which side of the area it lies; most elements and triangles are decided
//! from these bytes alone.

use std::ops::Range;

use trigon_raster::simd::LANES;

use super::kind::Kind;
use super::object::{DrawnTriangles, PickObject};
use super::region::Area;
use super::screen::{Screen, Spot};
use super::sides::Sides;
use super::small_region::SmallRegion;

/// Of an image, the part from which on an area is large.
const LARGE: usize = 16;

/// An object beside an area.
pub(super) struct Nearby<'q> {
    pub(super) object: &'q PickObject<'q>,
    pub(super) area: &'q Area<'q>,
    screen: &'q Screen,
    /// What may lie in it.
    near: Near<'q>,
}

enum Near<'q> {
    SmallRegion(SmallRegion),
    /// All of it.
    All {
        /// Of the mesh's vertices, and some more.
        vertices: Vec<[Sides; LANES]>,
        /// Which of these belong to something.
        used: &'q [bool],
    },
}

impl<'q> Nearby<'q> {
    pub(super) fn new(object: &'q PickObject<'q>, screen: &'q Screen, area: &'q Area<'q>) -> Self {
        let near = if is_large(screen, area) {
            let vertices = object.vertex_sides(screen, area);
            Near::All { vertices, used: object.used() }
        } else {
            Near::SmallRegion(SmallRegion::new(object, screen, area))
        };
        Self { object, area, screen, near }
    }

    /// How many elements may lie in the area.
    pub(super) fn count(&self, kind: Kind) -> usize {
        match (&self.near, kind) {
            (Near::SmallRegion(region), Kind::Vertex) => region.vertices.len(),
            (Near::SmallRegion(region), Kind::Edge) => region.edges.len(),
            (Near::All { .. }, _) => kind.count(self.object.mesh()),
        }
    }

    /// One of them.
    #[inline]
    pub(super) fn element(&self, kind: Kind, number: usize) -> usize {
        match (&self.near, kind) {
            (Near::SmallRegion(region), Kind::Vertex) => region.vertices[number] as usize,
            (Near::SmallRegion(region), Kind::Edge) => region.edges[number] as usize,
            (Near::All { .. }, _) => number,
        }
    }

    /// Where a vertex is that may be in the area and is drawn.
    #[inline]
    pub(super) fn vertex(&self, vertex: usize) -> Option<Spot> {
        let is_near = match &self.near {
            Near::SmallRegion(_) => true,
            Near::All { vertices, used } => vertices.as_flattened()[vertex].is_inside() && used[vertex],
        };
        is_near.then(|| self.object.vertices(self.screen)(vertex))
    }

    /// What the near plane leaves of an edge that may pass through the area.
    #[inline]
    pub(super) fn edge(&self, edge: usize) -> Option<[Spot; 2]> {
        let ends = self.object.mesh().edges()[edge];
        let spot = |end: u32| self.object.vertices(self.screen)(end as usize);
        let sides = ends.map(|end| match &self.near {
            Near::SmallRegion(_) => Sides::of(&spot(end), self.area),
            Near::All { vertices, .. } => vertices.as_flattened()[end as usize],
        });
        if Sides::is_beside(&sides) {
            return None;
        }
        if Sides::is_cut(&sides) {
            return self.object.cut_line(self.screen, ends);
        }
        Some(ends.map(spot))
    }

    /// Its triangles, if any can be in view.
    pub(super) fn triangles(&self) -> Option<NearbyTriangles<'_>> {
        let drawn = self.object.drawn()?;
        let near = match &self.near {
            Near::SmallRegion(region) => NearTriangles::SmallRegion(&region.triangles),
            Near::All { vertices, .. } => match drawn.corner_vertices(self.object) {
                Some(corners) => NearTriangles::OfVertices { corners, sides: vertices.as_flattened() },
                None => NearTriangles::All(drawn.corner_sides(self.screen, self.area)),
            },
        };
        Some(NearbyTriangles { drawn, object: self.object, screen: self.screen, near })
    }
}

/// The triangles of an object beside an area.
pub(super) struct NearbyTriangles<'q> {
    pub(super) drawn: &'q DrawnTriangles,
    object: &'q PickObject<'q>,
    screen: &'q Screen,
    near: NearTriangles<'q>,
}

enum NearTriangles<'q> {
    /// Those that may lie in it.
    SmallRegion(&'q [u32]),
    /// All of them, by the sides of the mesh's vertices.
    OfVertices {
        /// The vertex of each corner.
        corners: &'q [u32],
        sides: &'q [Sides],
    },
    /// All of them, by the sides of all corners, and some more.
    All(Vec<[Sides; LANES]>),
}

impl NearbyTriangles<'_> {
    /// The places in the list of those that may lie in the area, of a range of triangles.
    pub(super) fn indices(&self, triangles: Range<usize>) -> Range<usize> {
        match &self.near {
            NearTriangles::SmallRegion(region) => {
                let at = |end: usize| region.partition_point(|&triangle| (triangle as usize) < end);
                at(triangles.start)..at(triangles.end)
            }
            NearTriangles::OfVertices { .. } | NearTriangles::All(_) => triangles,
        }
    }

    /// The number of the triangle at a place.
    #[inline]
    pub(super) fn number(&self, index: usize) -> usize {
        match &self.near {
            NearTriangles::SmallRegion(region) => region[index] as usize,
            NearTriangles::OfVertices { .. } | NearTriangles::All(_) => index,
        }
    }

    /// Calls `visit` with the triangle at a place if it may be in the area, or with those that
    /// the near plane leaves of it.
    #[inline]
    pub(super) fn pieces(&self, index: usize, visit: impl FnMut(&[Spot; 3])) {
        let triangle = self.number(index);
        let [a, b, c] = self.drawn.triangle(triangle);
        // Not by `map`, which would be calls here.
        let spots = match &self.near {
            NearTriangles::SmallRegion(_) => {
                let at = self.drawn.corners(self.screen);
                [at(a), at(b), at(c)]
            }
            NearTriangles::OfVertices { corners, sides } => {
                let [a, b, c] = [corners[a] as usize, corners[b] as usize, corners[c] as usize];
                if Sides::is_beside(&[sides[a], sides[b], sides[c]]) {
                    return;
                }
                let at = self.object.vertices(self.screen);
                [at(a), at(b), at(c)]
            }
            NearTriangles::All(sides) => {
                let sides = sides.as_flattened();
                if Sides::is_beside(&[sides[a], sides[b], sides[c]]) {
                    return;
                }
                let at = self.drawn.corners(self.screen);
                [at(a), at(b), at(c)]
            }
        };
        self.drawn.pieces(self.screen, triangle, spots, visit);
    }
}

fn is_large(screen: &Screen, area: &Area<'_>) -> bool {
    area.columns.len() * area.rows.len() * LARGE > screen.pixel_count()
}
