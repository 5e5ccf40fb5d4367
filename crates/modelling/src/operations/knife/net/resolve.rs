//! Where lines of a net cross or touch.

use std::collections::{BTreeMap, BTreeSet};

use trigon_math::{DVec2, DVec3, Orientation, orientation};

use super::{FaceNet, line};
use crate::ids::CornerId;

/// Rounding a crossing moves the lines there a little, so that others may cross them: it ends after very few rounds.
const ROUNDS: usize = 32;

/// What a round found.
#[derive(Default)]
struct LineMeetings {
    /// For each line the points on it.
    points: BTreeMap<[u32; 2], Vec<u32>>,
    /// Pairs of lines that cross.
    crossings: Vec<[[u32; 2]; 2]>,
    /// Lines that cross the outline, or end on a side of it where it has no point.
    leaving: BTreeSet<[u32; 2]>,
}

impl FaceNet {
    /// Gives lines that cross or touch a point there, and leaves out those that cross the outline.
    pub(super) fn resolve(&mut self) {
        for round in 0.. {
            self.set_apart_sides();
            let mut meetings = self.meetings();
            if round == ROUNDS {
                meetings.leaving.extend(meetings.crossings.drain(..).map(|[_, other]| other));
                meetings.leaving.extend(std::mem::take(&mut meetings.points).into_keys());
            }
            let LineMeetings { mut points, crossings, leaving } = meetings;
            self.leave_out(&leaving.iter().copied().collect::<Vec<_>>());
            let crossings: Vec<_> = crossings
                .into_iter()
                .filter(|pair| !pair.iter().any(|line| leaving.contains(line)))
                .collect();
            points.retain(|line, _| !leaving.contains(line));
            if leaving.is_empty() && points.is_empty() && crossings.is_empty() {
                return;
            }
            for pair in crossings {
                let point = self.crossing(pair);
                pair.into_iter().for_each(|line| points.entry(line).or_default().push(point));
            }
            for (line, points) in points {
                self.split(line, points);
            }
        }
    }

    /// Lines between neighbours of the outline are no cuts.
    fn set_apart_sides(&mut self) {
        let sides: Vec<[u32; 2]> = self.sides().collect();
        self.along.extend(sides.into_iter().filter(|side| self.lines.remove(side)));
    }

    fn meetings(&self) -> LineMeetings {
        let lines: Vec<[u32; 2]> = self.sides().chain(self.lines.iter().copied()).collect();
        let segments: Vec<[DVec2; 2]> = lines.iter().map(|&line| self.ends(line)).collect();
        let mut meetings = LineMeetings::default();
        for_each_near_pair(&segments, |one, other| {
            let [one, other] = [one.min(other), one.max(other)];
            // Sides of the outline are the first lines.
            if other >= self.outline {
                self.add_meeting(lines[one], one < self.outline, lines[other], &mut meetings);
            }
            true
        });
        for points in meetings.points.values_mut() {
            points.sort_unstable();
            points.dedup();
        }
        meetings.crossings.sort_unstable();
        meetings
    }

    /// How a side of the outline or a line meets a line.
    fn add_meeting(&self, one: [u32; 2], is_side: bool, other: [u32; 2], meetings: &mut LineMeetings) {
        for point in one {
            if !other.contains(&point) && is_between(self.ends(other), self.flat[point as usize]) {
                meetings.points.entry(other).or_default().push(point);
            }
        }
        for point in other {
            if !one.contains(&point) && is_between(self.ends(one), self.flat[point as usize]) {
                if is_side {
                    meetings.leaving.insert(other);
                } else {
                    meetings.points.entry(one).or_default().push(point);
                }
            }
        }
        if do_cross(self.ends(one), self.ends(other)) {
            if is_side {
                meetings.leaving.insert(other);
            } else {
                meetings.crossings.push([one, other]);
            }
        }
    }

    /// The point at which two lines cross, rounded: halfway between both.
    fn crossing(&mut self, pair: [[u32; 2]; 2]) -> u32 {
        let [[a, b], [c, d]] = pair.map(|line| self.ends(line));
        let turn = |from: DVec2, to: DVec2, at: DVec2| (to - from).perp_dot(at - from);
        let share = |from: f64, to: f64| (from / (from - to)).clamp(0.0, 1.0);
        let shares = [share(turn(c, d, a), turn(c, d, b)), share(turn(a, b, c), turn(a, b, d))];
        let shares = shares.map(|share| if share.is_finite() { share } else { 0.5 });
        // The values of all four ends, half from each line.
        let mut parts: BTreeMap<CornerId, f64> = BTreeMap::new();
        let mut position = DVec3::ZERO;
        for ([from, to], share) in pair.into_iter().zip(shares) {
            for (end, weight) in [(from, (1.0 - share) / 2.0), (to, share / 2.0)] {
                let end = &self.points[end as usize];
                position += end.position.as_dvec3() * weight;
                end.parts
                    .iter()
                    .for_each(|&(corner, part)| *parts.entry(corner).or_default() += part * weight);
            }
        }
        self.point(position.as_vec3(), || parts.into_iter().collect())
    }

    /// Replaces a line by those between points on it.
    fn split(&mut self, [a, b]: [u32; 2], mut points: Vec<u32>) {
        self.lines.remove(&[a, b]);
        let [from, to] = self.ends([a, b]);
        let along = |&point: &u32| (to - from).dot(self.flat[point as usize] - from);
        points.sort_by(|one, other| along(one).total_cmp(&along(other)).then(one.cmp(other)));
        points.dedup();
        let mut before = a;
        for point in points.into_iter().chain([b]) {
            self.lines.extend(line(before, point));
            before = point;
        }
    }

    /// Whether a new line would touch no point and no line but at its ends.
    pub(super) fn is_free(&self, new: [u32; 2]) -> bool {
        let segment = self.ends(new);
        let mut all = self.sides().chain(self.lines.iter().copied());
        !all.any(|line| {
            let own = self.ends(line);
            line == new
                || do_cross(segment, own)
                || line.iter().any(|&point| is_between(segment, self.flat[point as usize]))
                || new.iter().any(|&point| is_between(own, self.flat[point as usize]))
        })
    }
}

/// Whether a polygon runs counter-clockwise, and none of its sides touches another but its neighbours at their common
/// ends.
pub(super) fn is_simple_polygon(outline: &[DVec2]) -> bool {
    let count = outline.len();
    let at = |index: usize| outline[index % count];
    let sides: Vec<[DVec2; 2]> = (0..count).map(|index| [at(index), at(index + 1)]).collect();
    let area: f64 = sides.iter().map(|[from, to]| (*from - at(0)).perp_dot(*to - at(0))).sum();
    let has_spike = (0..count).any(|index| {
        let [a, b, c] = [at(index), at(index + 1), at(index + 2)];
        a == b || a == c || is_between([a, b], c) || is_between([b, c], a)
    });
    let mut is_simple = count >= 3 && area > 0.0 && !has_spike;
    for_each_near_pair(&sides, |one, other| {
        let are_neighbors = (one + 1) % count == other || (other + 1) % count == one;
        is_simple &= are_neighbors || !do_meet(sides[one], sides[other]);
        is_simple
    });
    is_simple
}

/// Calls back with each pair of segments whose boxes touch, until that says false.
fn for_each_near_pair(segments: &[[DVec2; 2]], mut call: impl FnMut(usize, usize) -> bool) {
    let boxes: Vec<[DVec2; 2]> = segments.iter().map(|[a, b]| [a.min(*b), a.max(*b)]).collect();
    let mut order: Vec<usize> = (0..segments.len()).collect();
    order.sort_by(|&a, &b| boxes[a][0].x.total_cmp(&boxes[b][0].x).then(a.cmp(&b)));
    for (index, &one) in order.iter().enumerate() {
        let near = order[index + 1..].iter().take_while(|&&other| boxes[other][0].x <= boxes[one][1].x);
        for &other in near {
            let is_near = boxes[one][0].y <= boxes[other][1].y && boxes[other][0].y <= boxes[one][1].y;
            if is_near && !call(one, other) {
                return;
            }
        }
    }
}

/// Whether a point lies on a segment, but not in one of its ends.
fn is_between([from, to]: [DVec2; 2], at: DVec2) -> bool {
    let is_within = from.min(to).cmple(at).all() && at.cmple(from.max(to)).all();
    is_within && at != from && at != to && orientation(from, to, at) == Orientation::Collinear
}

/// Whether two segments cross in a point within both.
fn do_cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let opposite =
        |one: Orientation, other: Orientation| one != Orientation::Collinear && other == one.reversed();
    opposite(orientation(a, b, c), orientation(a, b, d))
        && opposite(orientation(c, d, a), orientation(c, d, b))
}

/// Whether two segments have a point in common.
fn do_meet(one: [DVec2; 2], other: [DVec2; 2]) -> bool {
    do_cross(one, other)
        || one.iter().any(|&end| other.contains(&end) || is_between(other, end))
        || other.iter().any(|&end| is_between(one, end))
}
