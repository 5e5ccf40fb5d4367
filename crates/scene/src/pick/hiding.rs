//! Which points of elements are hidden by faces that they do not belong to.
//!
//! The points are sorted into the pixels that they lie in. Then every triangle that is drawn
//! visits the points of the pixels around it: it hides those that lie within it on the
//! screen and behind it. Each triangle is read once, and a triangle as small as a pixel asks
//! few points, so that the time grows with triangles and points, not with their product. All
//! of it is decided at the points themselves, in f64: no pixel's centre is taken for them.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
use trigon_math::DVec2;

use super::object::{Drawn, Facing, Object};
use super::region::Area;
use super::screen::{Screen, Spot};
use crate::frame::Frame;

/// Triangles that a thread takes at a time.
const TRIANGLES: usize = 4096;

/// A point of an element that lies in a region.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) spot: Spot,
    /// The index of the node.
    pub(super) object: u32,
    pub(super) element: u32,
}

/// The points of elements, sorted by the pixels that they lie in.
pub(super) struct Hiding<'p> {
    screen: &'p Screen,
    frame: &'p Frame,
    columns: Range<u32>,
    rows: Range<u32>,
    /// For each pixel where its points begin, and the end of the last one's.
    starts: Vec<u32>,
    points: Vec<Point>,
    hidden: Vec<AtomicBool>,
}

/// A candidate in its pixel.
#[derive(Clone, Copy)]
struct Point {
    at: DVec2,
    /// Faces hide it that are nearer than this.
    depth: f64,
    candidate: u32,
}

impl<'p> Hiding<'p> {
    /// The candidates have to lie in the area. There have to be fewer than `u32::MAX`.
    pub(super) fn new(
        (screen, frame): (&'p Screen, &'p Frame),
        area: &Area<'_>,
        candidates: &[Candidate],
    ) -> Self {
        let (columns, rows) = (area.columns.clone(), area.rows.clone());
        let pixel = |candidate: &Candidate| {
            let at = candidate.spot.at;
            let [column, row] = [at.x as u32 - columns.start, at.y as u32 - rows.start];
            row as usize * columns.len() + column as usize
        };
        let mut starts = vec![0_u32; columns.len() * rows.len() + 1];
        candidates.iter().for_each(|candidate| starts[pixel(candidate)] += 1);
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        // Now each is where the next pixel's points begin; they are put in from the back.
        let nothing = Point { at: DVec2::ZERO, depth: 0.0, candidate: 0 };
        let mut points = vec![nothing; candidates.len()];
        for (number, candidate) in candidates.iter().enumerate().rev() {
            let start = &mut starts[pixel(candidate)];
            *start -= 1;
            let Spot { at, depth } = candidate.spot;
            let depth = screen.hiding_depth(depth);
            points[*start as usize] = Point { at, depth, candidate: number as u32 };
        }
        let hidden = points.iter().map(|_| AtomicBool::new(false)).collect();
        Self { screen, frame, columns, rows, starts, points, hidden }
    }

    /// Lets the faces of an object hide points. `is_own` tells whether a candidate
    /// belongs to a face of that object.
    pub(super) fn hide(&self, object: &Object<'_>, is_own: impl Fn(u32, u32) -> bool + Sync) {
        let Some(drawn) = object.drawn() else { return };
        let corners = drawn.corners(self.screen);
        for (facing, triangles) in drawn.runs() {
            let wins = |face: u32, at: DVec2| facing.is_opaque || self.wins(object, face, at);
            let hides = |face: u32, point: &Point| wins(face, point.at) && !is_own(face, point.candidate);
            triangles.into_par_iter().with_min_len(TRIANGLES).for_each(|triangle| {
                self.visit((drawn, facing), corners, triangle, &hides);
            });
        }
    }

    /// The candidates that nothing hides, by their numbers.
    pub(super) fn seen(&self) -> impl Iterator<Item = usize> + '_ {
        let points = self.points.iter().zip(&self.hidden);
        points
            .filter(|(_, hidden)| !hidden.load(Ordering::Relaxed))
            .map(|(point, _)| point.candidate as usize)
    }

    /// Whether the picture shows a face in the pixel of a point.
    fn wins(&self, object: &Object<'_>, face: u32, at: DVec2) -> bool {
        let pixel = at.y as usize * self.frame.width as usize + at.x as usize;
        let id = |ids: &Option<Vec<u32>>| ids.as_ref().and_then(|ids| ids.get(pixel).copied());
        id(&self.frame.object_ids) == Some(object.node.index() as u32)
            && id(&self.frame.face_ids) == Some(face)
    }

    fn visit(
        &self,
        (drawn, facing): (&Drawn, Facing),
        corners: &[Spot],
        triangle: usize,
        hides: &impl Fn(u32, &Point) -> bool,
    ) {
        drawn.pieces((self.screen, corners), triangle, |piece| {
            let Some((columns, rows)) = self.pixels(piece) else { return };
            let [a, b, c] = piece.map(|spot| spot.at);
            let area = (b - a).perp_dot(c - a);
            if !facing.draws(area) {
                return;
            }
            let nearest = piece.iter().fold(f64::NEG_INFINITY, |nearest, spot| nearest.max(spot.depth));
            for row in rows {
                for number in self.points_of(row, &columns) {
                    let point = &self.points[number];
                    if nearest > point.depth
                        && !self.hidden[number].load(Ordering::Relaxed)
                        && depth_at(piece, point.at).is_some_and(|depth| depth > point.depth)
                        && hides(drawn.face(triangle), point)
                    {
                        self.hidden[number].store(true, Ordering::Relaxed);
                    }
                }
            }
        });
    }

    /// The pixels around a triangle; `None` where it lies beside the area.
    fn pixels(&self, piece: &[Spot; 3]) -> Option<(Range<u32>, Range<u32>)> {
        let [a, b, c] = piece.map(|spot| spot.at);
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        let within = |min: f64, max: f64, pixels: &Range<u32>| {
            // The casts saturate.
            let (start, end) =
                ((min as u32).max(pixels.start), (max as u32).saturating_add(1).min(pixels.end));
            (max >= 0.0 && start < end).then_some(start..end)
        };
        Some((within(min.x, max.x, &self.columns)?, within(min.y, max.y, &self.rows)?))
    }

    /// The points of some pixels of a row.
    fn points_of(&self, row: u32, columns: &Range<u32>) -> Range<usize> {
        let first = (row - self.rows.start) as usize * self.columns.len();
        let [start, end] = [columns.start, columns.end]
            .map(|column| self.starts[first + (column - self.columns.start) as usize] as usize);
        start..end
    }
}

/// How deep a triangle is at a point of the screen; `None` where it is not.
#[inline]
pub(super) fn depth_at(piece: &[Spot; 3], at: DVec2) -> Option<f64> {
    let [a, b, c] = piece.map(|spot| spot.at - at);
    // Twice the areas between the point and each side: the shares of the corners.
    let shares = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
    let inside = shares.iter().all(|&share| share >= 0.0) || shares.iter().all(|&share| share <= 0.0);
    let sum: f64 = shares.iter().sum();
    if !inside || sum == 0.0 {
        return None;
    }
    let [a, b, c] = piece.map(|spot| spot.depth);
    Some((shares[0] * a + shares[1] * b + shares[2] * c) / sum)
}
