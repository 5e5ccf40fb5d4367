//! The objects of a scene near an area of an image, and their elements that may lie in it.
//!
//! A small area, such as around the pointer, contains few elements: whole boxes of triangles are skipped, and
//! nothing is stored (`few`). In a large area, the screen positions of all points are computed and stored,
//! and one byte per point records on which side of the area it lies; most elements and triangles are decided
//! from these bytes alone.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::few::Few;
use super::kind::Kind;
use super::object::{Drawn, Object, POINTS};
use super::region::Area;
use super::screen::{Screen, Spot};

/// Of an image, the part from which on an area is large.
const LARGE: usize = 16;

/// On which sides of an area a point lies, of the box of pixels around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sides(u8);

impl Sides {
    const LEFT: u8 = 1;
    const RIGHT: u8 = 2;
    const ABOVE: u8 = 4;
    const BELOW: u8 = 8;
    /// Beyond the far plane.
    const FAR: u8 = 16;
    /// Before the near plane: not on the screen.
    const NOWHERE: u8 = 32;

    pub(super) fn of(spot: &Spot, area: &Area<'_>) -> Self {
        if !spot.is_somewhere() {
            return Self(Self::NOWHERE);
        }
        let [left, right] = [area.columns.start, area.columns.end].map(f64::from);
        let [above, below] = [area.rows.start, area.rows.end].map(f64::from);
        let side = |is_there: bool, side: u8| if is_there { side } else { 0 };
        Self(
            side(spot.at.x < left, Self::LEFT)
                | side(spot.at.x > right, Self::RIGHT)
                | side(spot.at.y < above, Self::ABOVE)
                | side(spot.at.y > below, Self::BELOW)
                | side(!spot.is_in_range(), Self::FAR),
        )
    }

    /// Whether the point lies in the box.
    fn is_inside(self) -> bool {
        self.0 == 0
    }

    /// Whether the near plane cuts what lies between points, of which some are before it.
    fn is_cut(points: &[Self]) -> bool {
        points.iter().any(|point| point.0 == Self::NOWHERE)
    }

    /// Whether all that is between some points lies on one side.
    pub(super) fn is_beside(points: &[Self]) -> bool {
        points.iter().fold(u8::MAX, |sides, point| sides & point.0) != 0
    }
}

/// An object beside an area.
pub(super) struct Nearby<'q> {
    pub(super) object: &'q Object<'q>,
    pub(super) area: &'q Area<'q>,
    screen: &'q Screen,
    /// What may lie in it.
    near: Near<'q>,
}

enum Near<'q> {
    Few(Few),
    /// All of it.
    All {
        /// Of the mesh's vertices.
        vertices: Vec<Sides>,
        /// Which of these belong to something.
        used: &'q [AtomicBool],
    },
}

impl<'q> Nearby<'q> {
    pub(super) fn new(object: &'q Object<'q>, screen: &'q Screen, area: &'q Area<'q>) -> Self {
        let near = if is_large(screen, area) {
            object.keep_vertices(screen);
            let vertices = sides(object.mesh().vertex_count(), area, object.vertices(screen));
            Near::All { vertices, used: object.used() }
        } else {
            Near::Few(Few::new(object, screen, area))
        };
        Self { object, area, screen, near }
    }

    /// How many elements may lie in the area.
    pub(super) fn count(&self, kind: Kind) -> usize {
        match (&self.near, kind) {
            (Near::Few(few), Kind::Vertex) => few.vertices.len(),
            (Near::Few(few), Kind::Edge) => few.edges.len(),
            (Near::All { .. }, _) => kind.count(self.object.mesh()),
        }
    }

    /// One of them.
    #[inline]
    pub(super) fn element(&self, kind: Kind, number: usize) -> usize {
        match (&self.near, kind) {
            (Near::Few(few), Kind::Vertex) => few.vertices[number] as usize,
            (Near::Few(few), Kind::Edge) => few.edges[number] as usize,
            (Near::All { .. }, _) => number,
        }
    }

    /// Where a vertex is that may be in the area and is drawn.
    #[inline]
    pub(super) fn vertex(&self, vertex: usize) -> Option<Spot> {
        let is_near = match &self.near {
            Near::Few(_) => true,
            Near::All { vertices, used } => {
                vertices[vertex].is_inside() && used[vertex].load(Ordering::Relaxed)
            }
        };
        is_near.then(|| self.object.vertices(self.screen)(vertex))
    }

    /// What the near plane leaves of an edge that may pass through the area.
    #[inline]
    pub(super) fn edge(&self, edge: usize) -> Option<[Spot; 2]> {
        let ends = self.object.mesh().edges()[edge];
        let spot = |end: u32| self.object.vertices(self.screen)(end as usize);
        let sides = ends.map(|end| match &self.near {
            Near::Few(_) => Sides::of(&spot(end), self.area),
            Near::All { vertices, .. } => vertices[end as usize],
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
            Near::Few(few) => NearTriangles::Few(&few.triangles),
            Near::All { .. } => {
                drawn.keep_corners(self.screen);
                NearTriangles::All(sides(drawn.corner_count(), self.area, drawn.corners(self.screen)))
            }
        };
        Some(NearbyTriangles { drawn, screen: self.screen, near })
    }
}

/// The triangles of an object beside an area.
pub(super) struct NearbyTriangles<'q> {
    pub(super) drawn: &'q Drawn,
    screen: &'q Screen,
    near: NearTriangles<'q>,
}

enum NearTriangles<'q> {
    /// Those that may lie in it.
    Few(&'q [u32]),
    /// The sides of all corners.
    All(Vec<Sides>),
}

impl NearbyTriangles<'_> {
    /// The places in the list of those that may lie in the area, of a range of triangles.
    pub(super) fn places(&self, triangles: Range<usize>) -> Range<usize> {
        match &self.near {
            NearTriangles::Few(few) => {
                let at = |end: usize| few.partition_point(|&triangle| (triangle as usize) < end);
                at(triangles.start)..at(triangles.end)
            }
            NearTriangles::All(_) => triangles,
        }
    }

    /// The number of the triangle at a place.
    #[inline]
    pub(super) fn number(&self, place: usize) -> usize {
        match &self.near {
            NearTriangles::Few(few) => few[place] as usize,
            NearTriangles::All(_) => place,
        }
    }

    /// Calls `visit` with the triangle at a place if it may be in the area, or with those that
    /// the near plane leaves of it.
    #[inline]
    pub(super) fn pieces(&self, place: usize, visit: impl FnMut(&[Spot; 3])) {
        let triangle = self.number(place);
        let is_near = match &self.near {
            NearTriangles::Few(_) => true,
            NearTriangles::All(sides) => {
                !Sides::is_beside(&self.drawn.triangle(triangle).map(|corner| sides[corner]))
            }
        };
        if is_near {
            self.drawn.pieces(self.screen, triangle, visit);
        }
    }
}

fn is_large(screen: &Screen, area: &Area<'_>) -> bool {
    area.columns.len() * area.rows.len() * LARGE > screen.pixel_count()
}

fn sides(count: usize, area: &Area<'_>, spot: impl Fn(usize) -> Spot + Sync) -> Vec<Sides> {
    let points = (0..count).into_par_iter().with_min_len(POINTS);
    points.map(|point| Sides::of(&spot(point), area)).collect()
}
