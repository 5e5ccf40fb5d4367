//! The objects of a scene beside an area of a picture: on which side of it each of their
//! points lies, so that what lies beside it as a whole is passed over at once.
//!
//! A byte a point is all that elements and triangles look up before they are near. In a small area,
//! such as around a cursor, few are: where their points are is found again for each of them, and
//! nothing else is kept. In a large one many are, and where all points are is kept.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::object::{Drawn, Object, POINTS};
use super::region::Area;
use super::screen::{Screen, Spot};

/// Of a picture, the part from which on an area is large.
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

    fn of(spot: &Spot, area: &Area<'_>) -> Self {
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
    fn is_beside(points: &[Self]) -> bool {
        points.iter().fold(u8::MAX, |sides, point| sides & point.0) != 0
    }
}

/// An object beside an area.
pub(super) struct Nearby<'q> {
    pub(super) object: &'q Object<'q>,
    pub(super) area: &'q Area<'q>,
    screen: &'q Screen,
    /// Of the mesh's vertices.
    vertices: Vec<Sides>,
    /// Which of these belong to something.
    used: &'q [AtomicBool],
}

impl<'q> Nearby<'q> {
    pub(super) fn new(object: &'q Object<'q>, screen: &'q Screen, area: &'q Area<'q>) -> Self {
        if is_large(screen, area) {
            object.keep_vertices(screen);
        }
        let vertex = object.vertices(screen);
        let vertices = sides(object.mesh().vertex_count(), area, vertex);
        Self { object, area, screen, vertices, used: object.used() }
    }

    /// Where a vertex is that may be in the area and is drawn.
    #[inline]
    pub(super) fn vertex(&self, vertex: usize) -> Option<Spot> {
        let is_near = self.vertices[vertex].is_inside() && self.used[vertex].load(Ordering::Relaxed);
        is_near.then(|| self.object.vertices(self.screen)(vertex))
    }

    /// What the near plane leaves of an edge that may pass through the area.
    #[inline]
    pub(super) fn edge(&self, edge: usize) -> Option<[Spot; 2]> {
        let ends = self.object.mesh().edges()[edge];
        let sides = ends.map(|end| self.vertices[end as usize]);
        if Sides::is_beside(&sides) {
            return None;
        }
        if Sides::is_cut(&sides) {
            return self.object.cut_line(self.screen, ends);
        }
        Some(ends.map(|end| self.object.vertices(self.screen)(end as usize)))
    }

    /// Its triangles, if any can be in view.
    pub(super) fn triangles(&self) -> Option<NearbyTriangles<'q>> {
        let drawn = self.object.drawn()?;
        if is_large(self.screen, self.area) {
            drawn.keep_corners(self.screen);
        }
        let corners = sides(drawn.corner_count(), self.area, drawn.corners(self.screen));
        Some(NearbyTriangles { drawn, screen: self.screen, corners })
    }
}

/// The triangles of an object beside an area.
pub(super) struct NearbyTriangles<'q> {
    pub(super) drawn: &'q Drawn,
    screen: &'q Screen,
    corners: Vec<Sides>,
}

impl NearbyTriangles<'_> {
    /// Calls `visit` with a triangle if it may be in the area, or with those that the near
    /// plane leaves of it.
    #[inline]
    pub(super) fn pieces(&self, triangle: usize, visit: impl FnMut(&[Spot; 3])) {
        let sides = self.drawn.triangle(triangle).map(|corner| self.corners[corner]);
        if !Sides::is_beside(&sides) {
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
