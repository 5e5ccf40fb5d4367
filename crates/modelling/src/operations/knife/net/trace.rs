//! The outlines of the parts into which a net divides its face.

use std::cmp::Ordering;
use std::collections::HashSet;

use trigon_math::{DVec2, Orientation, orientation};

use super::FaceNet;

impl FaceNet {
    /// For each point the points to which lines and sides run, counter-clockwise.
    pub(super) fn neighbors(&self) -> Vec<Vec<u32>> {
        let mut neighbors: Vec<Vec<u32>> = vec![Vec::new(); self.flat.len()];
        for [a, b] in self.sides().chain(self.lines.iter().copied()) {
            neighbors[a as usize].push(b);
            neighbors[b as usize].push(a);
        }
        for (point, around) in neighbors.iter_mut().enumerate() {
            let center = self.flat[point];
            around.sort_by(|&a, &b| by_angle(center, self.flat[a as usize], self.flat[b as usize]));
        }
        neighbors
    }

    /// The walks around all parts, which are on their left. Points repeat where the net is not joined yet.
    pub(super) fn trace(&self) -> Vec<Vec<u32>> {
        let neighbors = self.neighbors();
        let count = self.outline as u32;
        // Around the outside of the face.
        let mut walked: HashSet<[u32; 2]> = (0..count).map(|index| [(index + 1) % count, index]).collect();
        let mut walks = Vec::new();
        for start in 0..neighbors.len() as u32 {
            for &first in &neighbors[start as usize] {
                let mut walk = Vec::new();
                let mut step = [start, first];
                while walked.insert(step) {
                    walk.push(step[0]);
                    step = next_step(&neighbors, step);
                }
                if !walk.is_empty() {
                    walks.push(walk);
                }
            }
        }
        walks
    }
}

/// The step after another one around the part on its left.
fn next_step(neighbors: &[Vec<u32>], [from, here]: [u32; 2]) -> [u32; 2] {
    let around = &neighbors[here as usize];
    let back = around.iter().position(|&point| point == from).unwrap_or_default();
    [here, around[(back + around.len() - 1) % around.len()]]
}

/// The order of two directions from a point, counter-clockwise from that of the first coordinate.
fn by_angle(center: DVec2, a: DVec2, b: DVec2) -> Ordering {
    let is_below = |at: DVec2| at.y < center.y || (at.y == center.y && at.x < center.x);
    is_below(a).cmp(&is_below(b)).then_with(|| match orientation(center, a, b) {
        Orientation::CounterClockwise => Ordering::Less,
        Orientation::Collinear => Ordering::Equal,
        Orientation::Clockwise => Ordering::Greater,
    })
}
