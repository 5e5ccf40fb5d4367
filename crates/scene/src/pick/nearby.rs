//! The objects of a scene near an area of an image, and their elements that may lie in the area.
//!
//! A small area, such as around the pointer, contains few elements: whole boxes of triangles are skipped, and nothing is
//! stored (`small_region`). In a large area, the screen positions of all points are computed and stored. One byte per
//! point ([`Sides`]) records on which side of the area the point lies; most elements and triangles are decided from these
//! bytes alone. [`Kind`] names the points at which a vertex or an edge must be visible.

use std::ops::Range;

use trigon_mesh::Mesh;
use trigon_raster::simd::LANES;

use super::object::{DrawnTriangles, PickObject};
use super::region::{Area, Sides};
use super::screen::{Screen, Spot, nearer_first};
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

/// What has points of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Vertex,
    Edge,
}

impl Kind {
    /// How many of them a mesh has.
    pub(super) fn count(self, mesh: &Mesh) -> usize {
        match self {
            Self::Vertex => mesh.vertex_count(),
            Self::Edge => mesh.edge_count(),
        }
    }

    /// Whether a face has this vertex, or this edge as one of its sides.
    pub(super) fn belongs(self, mesh: &Mesh, face: u32, element: u32) -> bool {
        match self {
            Self::Vertex => mesh.face_vertices(face as usize).contains(&element),
            Self::Edge => {
                mesh.face_corners(face as usize).any(|corner| mesh.corner_edge(corner) == Some(element))
            }
        }
    }

    /// Calls `visit` with the points of an element that lie in the area.
    #[inline]
    pub(super) fn points(self, nearby: &Nearby<'_>, element: usize, mut visit: impl FnMut(Spot)) {
        let mut keep = |spot: Spot| {
            if spot.is_in_range() && nearby.area.contains(spot.at) {
                visit(spot);
            }
        };
        match self {
            Self::Vertex => nearby.vertex(element).into_iter().for_each(keep),
            Self::Edge => {
                if let Some(line) = nearby.edge(element) {
                    own_points(&line, nearby.area, &mut keep);
                }
            }
        }
    }
}

/// The points of a line that make an edge seen: where it crosses the middles of columns
/// of pixels, or of rows where it is steeper; where it crosses none, its own middle. Those
/// beside the area are left out.
fn own_points(line: &[Spot; 2], area: &Area<'_>, mut visit: impl FnMut(Spot)) {
    let [start, end] = nearer_first(*line, |spot| spot.at);
    let way = end.at - start.at;
    let (axis, pixels) = if way.x.abs() >= way.y.abs() { (0, &area.columns) } else { (1, &area.rows) };
    let (from, to) = (start.at[axis], end.at[axis]);
    let (low, high) = if from < to { (from, to) } else { (to, from) };
    let (first, last) = (-floor(0.5 - low), floor(high - 0.5));
    if first > last || low == high {
        visit(start.towards(&end, 0.5));
        return;
    }
    // The casts saturate.
    let inside = (first as u32).max(pixels.start)..(last as u32).saturating_add(1).min(pixels.end);
    if last < 0.0 {
        return;
    }
    for pixel in inside {
        let middle = f64::from(pixel) + 0.5;
        let mut spot = start.towards(&end, (middle - from) / (to - from));
        spot.at[axis] = middle;
        visit(spot);
    }
}

/// The largest whole number up to one; near those numbers whose size no image has.
/// Where the processor has no instruction for it, this takes less than a call.
#[inline]
fn floor(number: f64) -> f64 {
    let whole = number as i64 as f64;
    if whole > number { whole - 1.0 } else { whole }
}
