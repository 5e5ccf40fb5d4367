//! Cuts a polygon that comes back to a place into loops that are in each place once.
//!
//! A polygon that touches itself in corners, and whose loops all run counter-clockwise, is these loops side
//! by side. One that runs clockwise is a hole, which belongs to the loop around it.

use trigon_math::DVec2;

use super::ears::turn;

/// Not on the way.
const NOWHERE: u32 = u32::MAX;

/// The loops of a polygon, one after another.
#[derive(Debug, Default)]
pub(super) struct Loops {
    corners: Vec<u32>,
    /// Where each ends.
    ends: Vec<u32>,
    /// The way since the last loop was cut off.
    way: Vec<u32>,
    /// The number of the place of each corner.
    position_ids: Vec<u32>,
    /// For each place where on the way it is.
    on_way: Vec<u32>,
}

impl Loops {
    /// Finds those with at least three corners. `by_place` has all corners, those in one place next to each other.
    pub(super) fn find(&mut self, points: &[DVec2], by_position: &[u32]) {
        self.corners.clear();
        self.ends.clear();
        self.way.clear();
        self.number_positions(points, by_position);
        for corner in 0..points.len() as u32 {
            let position = self.position_ids[corner as usize] as usize;
            match self.on_way[position] {
                NOWHERE => {
                    self.on_way[position] = self.way.len() as u32;
                    self.way.push(corner);
                }
                start => self.cut_off(start as usize),
            }
        }
        self.cut_off(0);
    }

    fn number_positions(&mut self, points: &[DVec2], by_position: &[u32]) {
        self.position_ids.clear();
        self.position_ids.resize(points.len(), 0);
        let mut number = 0;
        for (rank, &corner) in by_position.iter().enumerate() {
            let is_new = rank > 0 && points[by_position[rank - 1] as usize] != points[corner as usize];
            number += u32::from(is_new);
            self.position_ids[corner as usize] = number;
        }
        self.on_way.clear();
        self.on_way.resize(points.len(), NOWHERE);
    }

    /// The way from a place on comes back to it. That place stays on the way.
    fn cut_off(&mut self, start: usize) {
        let found = &self.way[start..];
        if found.len() >= 3 {
            self.corners.extend_from_slice(found);
            self.ends.push(self.corners.len() as u32);
        }
        for &corner in found.iter().skip(1) {
            self.on_way[self.position_ids[corner as usize] as usize] = NOWHERE;
        }
        self.way.truncate(start + 1);
    }

    /// The corners of each loop.
    pub(super) fn all(&self) -> impl Iterator<Item = &[u32]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let corners = &self.corners[start as usize..end as usize];
            start = end;
            corners
        })
    }

    /// Whether all run counter-clockwise (y up), or have no area.
    pub(super) fn are_outlines(&self, points: &[DVec2]) -> bool {
        self.all().all(|corners| is_outline(points, corners))
    }
}

/// An outline turns left at its first place from the left, or nowhere.
fn is_outline(points: &[DVec2], corners: &[u32]) -> bool {
    let position = |at: usize| points[corners[at % corners.len()] as usize];
    let count = corners.len();
    let turn_at = |at: usize| turn(position(at + count - 1), position(at), position(at + 1));
    let is_before = |a: DVec2, b: DVec2| a.x < b.x || (a.x == b.x && a.y < b.y);
    let first =
        (1..count).fold(0, |first, at| if is_before(position(at), position(first)) { at } else { first });
    match turn_at(first) {
        0 => (0..count).all(|at| turn_at(at) == 0),
        turn => turn > 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangulate::ears::EarCutter;

    fn points(position_ids: &[[i32; 2]]) -> Vec<DVec2> {
        position_ids.iter().map(|&[x, y]| DVec2::new(x.into(), y.into())).collect()
    }

    fn loops(points: &[DVec2]) -> Loops {
        let mut by_position: Vec<u32> = (0..points.len() as u32).collect();
        by_position.sort_by_key(|&i| (points[i as usize].x as i64, points[i as usize].y as i64));
        let mut loops = Loops::default();
        loops.find(points, &by_position);
        loops
    }

    #[test]
    fn a_polygon_that_comes_back_is_its_loops() {
        let flower = points(&[[0, 0], [2, 0], [2, 1], [0, 0], [0, 2], [-1, 2], [0, 0], [-2, -1], [-1, -2]]);
        let loops = loops(&flower);
        let found: Vec<&[u32]> = loops.all().collect();
        assert_eq!(found, [[0, 1, 2], [0, 4, 5], [0, 7, 8]], "three petals");
        assert!(loops.are_outlines(&flower), "counter-clockwise");
    }

    #[test]
    fn a_hole_is_no_outline() {
        let ring = points(&[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0], [1, 1], [1, 2], [2, 1], [1, 1]]);
        assert!(!loops(&ring).are_outlines(&ring), "clockwise");
    }

    /// All of these took time in proportion to the square of their corners: 30,000 took 20 seconds.
    #[test]
    fn corners_that_repeat_take_linear_time() {
        let square = [[0, 0], [4, 0], [4, 4], [0, 4]];
        let round = points(&square.repeat(7500));
        let petals =
            points(&(0..10_000).flat_map(|i| [[0, 0], [20_000, i], [20_000, i + 1]]).collect::<Vec<_>>());
        let back: Vec<[i32; 2]> = square.iter().rev().copied().collect();
        let both_ways = [square.repeat(300), back.repeat(100)].concat();
        let cases = [(round, Some(15_000)), (petals, Some(10_000)), (points(&both_ways), None)];
        for (corners, count) in cases {
            let (mut cutter, mut triangles) = (EarCutter::default(), Vec::new());
            cutter.cut(&corners, &mut triangles);
            assert!(triangles.len() <= corners.len() - 2, "{} triangles", triangles.len());
            assert!(count.is_none_or(|count| count == triangles.len()), "{} triangles", triangles.len());
            let area = |[a, b, c]: [u32; 3]| {
                let position = |i: u32| corners[i as usize];
                (position(b) - position(a)).perp_dot(position(c) - position(a))
            };
            assert!(triangles.iter().all(|&triangle| area(triangle) > 0.0), "none is turned over");
        }
    }
}
