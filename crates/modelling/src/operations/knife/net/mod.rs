//! The lines of a cut within one face, as seen along the axis along which the face is seen largest: a graph of points
//! and straight lines, and the parts into which it divides the face.
//!
//! 1. `resolve`: lines that cross or touch get a point there. Lines that leave the face are left out.
//! 2. Lines that end within the face are left out, from their ends on.
//! 3. `join`: what is not connected to the outline by two ways is, by the shortest lines that cross nothing: then every
//!    part is a simple polygon.
//! 4. `trace`: the outlines of the parts.
//!
//! All decisions are exact: positions are those that vertices will have, and dropping a coordinate rounds nothing.

mod join;
mod resolve;
mod trace;

use std::collections::{BTreeSet, HashMap};

use trigon_math::{AxisProjection, DVec2, DisjointSets, Orientation, Vec3, orientation};

use crate::ids::CornerId;
use crate::operations::boolean::position_key;

/// Corners of a face and their weights, which add up to 1: what values in a position of the face are made of.
pub(super) type CornerParts = Vec<(CornerId, f64)>;

/// A point of a net.
#[derive(Debug, Clone)]
pub(super) struct NetPoint {
    pub(super) position: Vec3,
    pub(super) parts: CornerParts,
}

/// The lines of a cut within a face.
#[derive(Debug)]
pub(super) struct FaceNet {
    view: AxisProjection,
    /// The outline first.
    points: Vec<NetPoint>,
    /// As they are seen; the outline runs counter-clockwise.
    flat: Vec<DVec2>,
    by_position: HashMap<[u32; 3], u32>,
    /// How many points the outline has.
    outline: usize,
    /// Pairs of points, the smaller first.
    lines: BTreeSet<[u32; 2]>,
    /// Lines that run along the outline.
    along: BTreeSet<[u32; 2]>,
    /// Lines that were left out.
    left_out: Vec<[u32; 2]>,
}

/// The parts of a face.
#[derive(Debug, Default)]
pub(super) struct NetParts {
    /// The points: the outline, and those within the face at which lines meet.
    pub(super) points: Vec<NetPoint>,
    /// How many points the outline has.
    pub(super) outline: usize,
    /// The lines of the cut, as pairs of points, with those along the outline.
    pub(super) cuts: Vec<[u32; 2]>,
    /// How many lines divide the face, with those that join loops to the outline.
    pub(super) lines: usize,
    /// The outlines of the parts, as points; none if the face stays whole.
    pub(super) parts: Vec<Vec<u32>>,
    /// How many connected pieces of lines were left out.
    pub(super) left_out: usize,
}

impl FaceNet {
    /// A net without lines. `None` if the outline crosses or touches itself as it is seen, or is not finite.
    pub(super) fn new(outline: Vec<NetPoint>) -> Option<Self> {
        let positions: Vec<Vec3> = outline.iter().map(|point| point.position).collect();
        let view = AxisProjection::of(&positions);
        let flat: Vec<DVec2> = positions.iter().map(|position| view.project(position.as_dvec3())).collect();
        let is_finite = positions.iter().all(|position| position.is_finite());
        if !is_finite || !resolve::is_simple_polygon(&flat) {
            return None;
        }
        let by_position =
            positions.iter().zip(0..).map(|(&position, index)| (position_key(position), index)).collect();
        Some(Self {
            view,
            outline: outline.len(),
            points: outline,
            flat,
            by_position,
            lines: BTreeSet::new(),
            along: BTreeSet::new(),
            left_out: Vec::new(),
        })
    }

    /// Adds a straight line between two points.
    pub(super) fn add_line(&mut self, [from, to]: [u32; 2]) {
        self.lines.extend(line(from, to));
    }

    /// The parts, after all lines were added. `None` if nothing joins a loop of lines to the outline: there are too
    /// many.
    pub(super) fn divide(mut self) -> Option<NetParts> {
        self.resolve();
        self.leave_out_outside();
        self.leave_out_loose();
        let left_out = self.count_left_out();
        self.leave_out_points();
        let cuts: Vec<[u32; 2]> = self.lines.union(&self.along).copied().collect();
        let mut parts = Vec::new();
        if !self.lines.is_empty() {
            self.join_all()?;
            parts = self.trace();
        }
        let (points, outline, lines) = (self.points, self.outline, self.lines.len());
        Some(NetParts { points, outline, cuts, lines, parts, left_out })
    }

    /// Leaves out points within the face at which no line is, and numbers the others without gaps.
    fn leave_out_points(&mut self) {
        let used: BTreeSet<u32> =
            (0..self.outline as u32).chain(self.lines.iter().flatten().copied()).collect();
        let mut numbers = vec![0; self.points.len()];
        used.iter().zip(0..).for_each(|(&point, number)| numbers[point as usize] = number);
        let renumbered = |line: &[u32; 2]| line.map(|point| numbers[point as usize]);
        self.lines = self.lines.iter().map(renumbered).collect();
        self.points = used.iter().map(|&point| self.points[point as usize].clone()).collect();
        self.flat = used.iter().map(|&point| self.flat[point as usize]).collect();
    }

    /// The point in a position: of the outline, or within the face. It is added if there is none.
    pub(super) fn point(&mut self, position: Vec3, parts: impl FnOnce() -> CornerParts) -> u32 {
        let next = self.points.len() as u32;
        let index = *self.by_position.entry(position_key(position)).or_insert(next);
        if index == next {
            self.points.push(NetPoint { position, parts: parts() });
            self.flat.push(self.view.project(position.as_dvec3()));
        }
        index
    }

    /// The sides of the outline, the smaller point first.
    fn sides(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let count = self.outline as u32;
        (0..count).filter_map(move |index| line(index, (index + 1) % count))
    }

    fn is_on_outline(&self, point: u32) -> bool {
        (point as usize) < self.outline
    }

    fn ends(&self, [a, b]: [u32; 2]) -> [DVec2; 2] {
        [self.flat[a as usize], self.flat[b as usize]]
    }

    /// Leaves out lines of which no part is inside the face. None crosses the outline.
    fn leave_out_outside(&mut self) {
        let is_inside: Vec<bool> = (self.outline..self.flat.len())
            .map(|point| contains(&self.flat[..self.outline], self.flat[point]))
            .collect();
        let is_line_inside = |&[a, b]: &[u32; 2]| match (self.is_on_outline(a), self.is_on_outline(b)) {
            (true, true) => self.begins_inside(a, self.flat[b as usize]),
            _ => [a, b]
                .into_iter()
                .all(|point| self.is_on_outline(point) || is_inside[point as usize - self.outline]),
        };
        let outside: Vec<[u32; 2]> =
            self.lines.iter().copied().filter(|line| !is_line_inside(line)).collect();
        self.leave_out(&outside);
    }

    fn leave_out(&mut self, lines: &[[u32; 2]]) {
        for line in lines {
            if self.lines.remove(line) {
                self.left_out.push(*line);
            }
        }
    }

    /// Whether the way from a point of the outline to another position begins inside the outline.
    fn begins_inside(&self, point: u32, target: DVec2) -> bool {
        let (count, index) = (self.outline, point as usize);
        let [before, here, after] = [index + count - 1, index, index + 1].map(|at| self.flat[at % count]);
        let left = |a: DVec2, b: DVec2| orientation(a, b, target) == Orientation::CounterClockwise;
        match orientation(before, here, after) {
            Orientation::Clockwise => left(here, after) || left(before, here),
            _ => left(here, after) && left(before, here),
        }
    }

    /// Leaves out lines with an end within the face at which no other line is, until there is none.
    fn leave_out_loose(&mut self) {
        let mut lines_at: Vec<Vec<u32>> = vec![Vec::new(); self.points.len()];
        for &[a, b] in &self.lines {
            lines_at[a as usize].push(b);
            lines_at[b as usize].push(a);
        }
        let mut waiting: Vec<u32> = (self.outline as u32..self.points.len() as u32).collect();
        while let Some(end) = waiting.pop() {
            let &[other] = &lines_at[end as usize][..] else { continue };
            if self.is_on_outline(end) {
                continue;
            }
            lines_at[end as usize].clear();
            lines_at[other as usize].retain(|&point| point != end);
            self.leave_out(&line(end, other).map_or(vec![], |line| vec![line]));
            waiting.push(other);
        }
    }

    /// How many connected pieces were left out; what stays, and the outline, connects nothing.
    fn count_left_out(&self) -> usize {
        let mut is_used = vec![false; self.points.len()];
        is_used[..self.outline].fill(true);
        self.lines.iter().flatten().for_each(|&point| is_used[point as usize] = true);
        let mut sets = DisjointSets::new(self.points.len() + self.left_out.len());
        for (number, line) in self.left_out.iter().enumerate() {
            let own = (self.points.len() + number) as u32;
            for &point in line.iter().filter(|&&point| !is_used[point as usize]) {
                sets.join(point, own);
            }
        }
        let roots = (0..self.left_out.len()).map(|number| sets.root((self.points.len() + number) as u32));
        roots.collect::<BTreeSet<u32>>().len()
    }
}

/// The line between two points, the smaller first; none from a point to itself.
fn line(a: u32, b: u32) -> Option<[u32; 2]> {
    (a != b).then(|| [a.min(b), a.max(b)])
}

/// Whether a point that is not on the outline of a polygon is inside it, by the even-odd rule.
pub(super) fn contains(outline: &[DVec2], at: DVec2) -> bool {
    let sides = outline.iter().zip(outline.iter().cycle().skip(1));
    let crossed = sides.filter(|&(&from, &to)| {
        let is_left_of_it =
            if to.y > from.y { Orientation::CounterClockwise } else { Orientation::Clockwise };
        (from.y > at.y) != (to.y > at.y) && orientation(from, to, at) == is_left_of_it
    });
    crossed.count() % 2 == 1
}
