//! Cuts ears off a polygon in the plane, by exact orientation.
//!
//! This is the classical method (Meisters 1975; the treatment of touching corners follows Held's FIST,
//! 2001). An ear is a convex corner whose triangle contains nothing else of the polygon. Two things are
//! particular here:
//! - Corners that lie on the new diagonal block an ear, so a corner in the middle of a straight side is kept
//!   and used.
//! - An outline may touch itself, for example along bridges to holes. If a corner has the same position as a
//!   corner of the ear, the direction of its two sides decides whether it blocks the ear.
//!
//! Corners wait in a queue and are tested again only after a neighbour was removed. Ears are therefore cut
//! all around the polygon in turn, which gives well-shaped triangles on convex polygons, and there are at
//! most three tests per corner.
//!
//! Corners in one place are all near the same ears, so that a polygon that repeats its corners would take quadratic
//! time. One that takes too many tests of such corners is cut into its loops first (`loops`), each of which is in a
//! place once.

use std::cell::Cell;
use std::collections::VecDeque;

use trigon_math::{DVec2, Orientation, orientation};

use super::grid::Grid;
use super::loops::Loops;

/// After so many rounds in which everything was tested afresh, a polygon
/// counts as one that crosses itself.
const MOST_ROUNDS: usize = 8;

/// So many tests of corners that are not alone in their place are made for each corner, before the polygon is cut into
/// its loops.
const TESTS_PER_CORNER: usize = 64;

/// So many such tests take about a second; a polygon whose loops are no outlines of their own, and that
/// takes more, counts as one that crosses itself.
const MOST_TESTS: usize = 1 << 27;

/// Whether a, b, c turn left (y up): exact.
fn is_left_turn(a: DVec2, b: DVec2, c: DVec2) -> bool {
    turn(a, b, c) > 0
}

/// 1 if a, b, c turn left (y up), −1 if right, 0 if they are in one line:
/// exact.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> i32 {
    match orientation(a, b, c) {
        Orientation::CounterClockwise => 1,
        Orientation::Clockwise => -1,
        Orientation::Collinear => 0,
    }
}

/// What is left of the polygon: a ring of corners, and its buffers.
#[derive(Debug, Default)]
pub(super) struct EarCutter {
    previous: Vec<u32>,
    next: Vec<u32>,
    /// Whether a corner is still in the ring.
    present: Vec<bool>,
    left: usize,
    /// Corners that may be ears, and how often their neighbours had changed
    /// when they were queued: entries with an older count are skipped.
    queue: VecDeque<(u32, u32)>,
    changes: Vec<u32>,
    /// Corners that can be in the way: not convex at first, or not alone in
    /// their place. Cutting ears makes no corner less convex.
    blockers: Vec<u32>,
    by_position: Vec<u32>,
    /// Whether a corner is not alone in its place.
    shared: Vec<bool>,
    /// How many tests of such corners are left.
    tests_left: Cell<usize>,
    /// Whether triangles without area or turned over are wanted, too, so that there are n − 2.
    is_complete: bool,
    grid: Grid,
    loops: Loops,
}

/// What to do about the corner in the middle of three.
enum Verdict {
    /// Cut its triangle off.
    Ear,
    /// Leave it out: nothing is between it and its neighbours.
    Needless,
    Keep,
}

impl EarCutter {
    /// Appends the triangles of a polygon that is counter-clockwise (y up).
    pub(super) fn cut(&mut self, points: &[DVec2], triangles: &mut Vec<[u32; 3]>) {
        self.is_complete = false;
        self.cut_any(points, triangles);
    }

    /// The same and what is left out there, in n − 2 triangles in all: those of corners that nothing is between, and
    /// those that are turned over.
    pub(super) fn cut_completely(&mut self, points: &[DVec2], triangles: &mut Vec<[u32; 3]>) {
        self.is_complete = true;
        self.cut_any(points, triangles);
        self.queue_all();
        self.tests_left.set(usize::MAX);
        self.cut_queued(points, triangles, |_, _, _| Verdict::Ear);
    }

    fn cut_any(&mut self, points: &[DVec2], triangles: &mut Vec<[u32; 3]>) {
        let (start, usual) = (triangles.len(), TESTS_PER_CORNER * points.len());
        self.start(points, usual);
        self.cut_ears(points, triangles);
        if self.has_tests_left() {
            self.cut_crossing(points, triangles);
            return;
        }
        triangles.truncate(start);
        // Cut into loops, corners in one place become one.
        if self.is_complete || !self.cut_loops(points, triangles) {
            self.start(points, usual.max(MOST_TESTS));
            self.cut_ears(points, triangles);
            self.cut_crossing(points, triangles);
        }
    }

    fn has_tests_left(&self) -> bool {
        self.tests_left.get() > 0
    }

    /// Cuts ears until none is left.
    fn cut_ears(&mut self, points: &[DVec2], triangles: &mut Vec<[u32; 3]>) {
        for _ in 0..MOST_ROUNDS {
            let before = self.left;
            self.queue_all();
            self.cut_queued(points, triangles, Self::verdict);
            if self.left < 3 || self.left == before || !self.has_tests_left() {
                break;
            }
        }
    }

    /// Cuts what no ear was found in.
    fn cut_crossing(&mut self, points: &[DVec2], triangles: &mut Vec<[u32; 3]>) {
        if self.left >= 3 {
            self.tests_left.set(usize::MAX);
            self.queue_all();
            self.cut_queued(points, triangles, Self::verdict_when_crossing);
        }
    }

    /// Cuts each loop of the polygon by itself. False, and nothing is cut, if one of them runs clockwise: it may be
    /// a hole in another.
    fn cut_loops(&mut self, points: &[DVec2], triangles: &mut Vec<[u32; 3]>) -> bool {
        let mut loops = std::mem::take(&mut self.loops);
        loops.find(points, &self.by_position);
        let are_outlines = loops.are_outlines(points);
        if are_outlines {
            let (mut own, mut cut) = (Vec::new(), Vec::new());
            for corners in loops.all() {
                refill(&mut own, corners.iter().map(|&corner| points[corner as usize]));
                cut.clear();
                self.start(&own, usize::MAX);
                self.cut_ears(&own, &mut cut);
                self.cut_crossing(&own, &mut cut);
                triangles.extend(cut.iter().map(|triangle| triangle.map(|i| corners[i as usize])));
            }
        }
        self.loops = loops;
        are_outlines
    }

    /// Begins with a polygon. `tests`: so many tests of corners that are not alone may be made.
    fn start(&mut self, points: &[DVec2], tests: usize) {
        let count = points.len() as u32;
        self.tests_left.set(tests);
        self.left = points.len();
        refill(&mut self.previous, (0..count).map(|i| (i + count - 1) % count));
        refill(&mut self.next, (0..count).map(|i| (i + 1) % count));
        refill(&mut self.present, (0..count).map(|_| true));
        refill(&mut self.changes, (0..count).map(|_| 0));
        self.find_blockers(points);
        self.grid.fill(points, &self.blockers);
    }

    fn find_blockers(&mut self, points: &[DVec2]) {
        let position = |i: u32| points[i as usize];
        refill(&mut self.by_position, 0..points.len() as u32);
        self.by_position.sort_unstable_by(|&i, &j| {
            let (a, b) = (position(i), position(j));
            let by_x = a.x.partial_cmp(&b.x);
            let by_y = a.y.partial_cmp(&b.y);
            let finite = "the caller has checked that points are finite";
            by_x.expect(finite).then(by_y.expect(finite)).then(i.cmp(&j))
        });
        refill(&mut self.shared, points.iter().map(|_| false));
        for pair in self.by_position.windows(2).filter(|pair| position(pair[0]) == position(pair[1])) {
            pair.iter().for_each(|&i| self.shared[i as usize] = true);
        }
        let all = 0..points.len() as u32;
        refill(&mut self.blockers, all.clone().filter(|&i| self.shared[i as usize]));
        for i in all {
            let (a, c) = (self.previous[i as usize], self.next[i as usize]);
            let convex = is_left_turn(position(a), position(i), position(c));
            if !convex && !self.shared[i as usize] {
                self.blockers.push(i);
            }
        }
    }

    /// Queues what is left of the ring, once round.
    fn queue_all(&mut self) {
        self.queue.clear();
        for corner in 0..self.next.len() {
            if self.present[corner] {
                self.queue.push_back((corner as u32, self.changes[corner]));
            }
        }
    }

    fn cut_queued(
        &mut self,
        points: &[DVec2],
        triangles: &mut Vec<[u32; 3]>,
        verdict: impl Fn(&Self, &[DVec2], [u32; 3]) -> Verdict,
    ) {
        while self.left >= 3
            && self.has_tests_left()
            && let Some((corner, changes)) = self.queue.pop_front()
        {
            if !self.present[corner as usize] || self.changes[corner as usize] != changes {
                continue;
            }
            let before = self.previous[corner as usize];
            let after = self.next[corner as usize];
            match verdict(self, points, [before, corner, after]) {
                Verdict::Ear => {
                    triangles.push([before, corner, after]);
                    self.remove(corner);
                }
                Verdict::Needless => {
                    if self.is_complete {
                        triangles.push([before, corner, after]);
                    }
                    self.remove(corner);
                }
                Verdict::Keep => {}
            }
        }
    }

    /// Takes a corner out of the ring and queues its neighbours again.
    fn remove(&mut self, corner: u32) {
        let before = self.previous[corner as usize];
        let after = self.next[corner as usize];
        self.next[before as usize] = after;
        self.previous[after as usize] = before;
        self.present[corner as usize] = false;
        self.left -= 1;
        for neighbour in [before, after] {
            let changes = &mut self.changes[neighbour as usize];
            *changes += 1;
            self.queue.push_back((neighbour, *changes));
        }
    }

    fn verdict(&self, points: &[DVec2], ear: [u32; 3]) -> Verdict {
        let [a, b, c] = ear.map(|i| points[i as usize]);
        match turn(a, b, c) {
            1 if self.is_free(points, ear) => Verdict::Ear,
            0 if is_spike(a, b, c) => Verdict::Needless,
            _ => Verdict::Keep,
        }
    }

    /// For what is left of a polygon that crosses itself: whatever turns left
    /// is an ear, whatever lies in between.
    fn verdict_when_crossing(&self, points: &[DVec2], ear: [u32; 3]) -> Verdict {
        let [a, b, c] = ear.map(|i| points[i as usize]);
        match turn(a, b, c) {
            1 => Verdict::Ear,
            0 => Verdict::Needless,
            _ => Verdict::Keep,
        }
    }

    /// Whether nothing of the polygon enters the triangle of an ear or touches
    /// its third side.
    fn is_free(&self, points: &[DVec2], ear: [u32; 3]) -> bool {
        let position = |i: u32| points[i as usize];
        let triangle = Triangle(ear.map(position));
        let before = position(self.previous[ear[0] as usize]);
        let after = position(self.next[ear[2] as usize]);
        if triangle.is_entered_towards(before, AT_FIRST_CORNER)
            || triangle.is_entered_towards(after, AT_LAST_CORNER)
        {
            return false;
        }
        let (low, high) = triangle.bounds();
        !self.grid.any(low, high, |i| {
            if self.shared[i as usize] {
                self.tests_left.set(self.tests_left.get().saturating_sub(1));
            }
            let around = [self.previous[i as usize], self.next[i as usize]];
            let point = position(i);
            self.present[i as usize]
                && !ear.contains(&i)
                && low.cmple(point).all()
                && high.cmpge(point).all()
                && triangle.is_entered_at(point, around.map(position))
        })
    }
}

/// On which side of each of a triangle's sides a point is, see [`turn`].
type Sides = [i32; 3];

const AT_FIRST_CORNER: Sides = [0, 1, 0];
const AT_LAST_CORNER: Sides = [1, 0, 0];

/// A counter-clockwise triangle: its sides are ab, bc and the diagonal ca.
struct Triangle([DVec2; 3]);

impl Triangle {
    fn bounds(&self) -> (DVec2, DVec2) {
        let [a, b, c] = self.0;
        (a.min(b).min(c), a.max(b).max(c))
    }

    fn sides(&self, point: DVec2) -> Sides {
        let [a, b, c] = self.0;
        [turn(a, b, point), turn(b, c, point), turn(c, a, point)]
    }

    /// Whether a corner of the polygon at this point, with its neighbours on
    /// the outline, keeps the triangle from being an ear.
    fn is_entered_at(&self, point: DVec2, neighbours: [DVec2; 2]) -> bool {
        match self.sides(point) {
            [.., -1] | [_, -1, _] | [-1, ..] => false,
            // Inside, or within the third side.
            [1, 1, _] => true,
            // At a corner or within one of the other sides, which are the
            // polygon's own: what counts is where the outline goes from here.
            at => neighbours.iter().any(|&to| self.is_entered_towards(to, at)),
        }
    }

    /// Whether the way from a point of the outline, whose sides are given,
    /// towards another leads into the inside of the triangle.
    fn is_entered_towards(&self, to: DVec2, at: Sides) -> bool {
        let sides = self.sides(to);
        (0..3).all(|i| at[i] > 0 || sides[i] > 0)
    }
}

/// Of three points in one line: whether the last one is not ahead of the
/// middle one, so that the two sides lie on each other.
fn is_spike(a: DVec2, b: DVec2, c: DVec2) -> bool {
    (b - a).dot(c - b) <= 0.0
}

fn refill<T>(buffer: &mut Vec<T>, values: impl Iterator<Item = T>) {
    buffer.clear();
    buffer.extend(values);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the usual way and that for crossing polygons say about the second of some points.
    fn verdicts(points: &[DVec2]) -> [char; 2] {
        let mut cutter = EarCutter::default();
        cutter.start(points, usize::MAX);
        let letter = |verdict: Verdict| match verdict {
            Verdict::Ear => 'E',
            Verdict::Needless => 'N',
            Verdict::Keep => 'K',
        };
        [cutter.verdict(points, [0, 1, 2]), cutter.verdict_when_crossing(points, [0, 1, 2])].map(letter)
    }

    #[test]
    fn corners_that_cross_are_cut_whatever_is_in_the_way() {
        type Corners = [[f64; 2]; 4];
        let cases: [(&str, Corners, [char; 2]); 7] = [
            ("a square", [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], ['E', 'E']),
            ("a corner within", [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]], ['K', 'E']),
            ("a corner on the diagonal", [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [0.0, 2.0]], ['K', 'E']),
            ("clockwise", [[0.0, 0.0], [0.0, 4.0], [4.0, 0.0], [5.0, 5.0]], ['K', 'K']),
            ("within a side", [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 2.0]], ['K', 'N']),
            ("the end of a spike", [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 2.0]], ['N', 'N']),
            ("twice in one place", [[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [0.0, 2.0]], ['N', 'N']),
        ];
        for (what, points, expected) in cases {
            assert_eq!(verdicts(&points.map(DVec2::from)), expected, "{what}");
        }
    }
}
