//! Joins triangles to polygons that visit each of their vertices once.

use std::collections::{HashMap, HashSet, VecDeque};

use super::surface::sides;

/// Joins connected triangles in a plane: to one polygon where their border is one, otherwise, as around a hole, to
/// several.
pub(super) fn polygons(triangles: &[[u32; 3]], mut add: impl FnMut(Vec<u32>)) {
    match border(triangles) {
        Some(outline) => add(outline),
        None => Growth::of(triangles).for_each(add),
    }
}

/// The border of triangles that form a disc whose border visits each vertex once.
fn border(triangles: &[[u32; 3]]) -> Option<Vec<u32>> {
    if let [triangle] = triangles {
        return Some(triangle.to_vec());
    }
    let all: HashSet<[u32; 2]> = triangles.iter().flat_map(|&triangle| sides(triangle)).collect();
    let is_outer = |&[from, to]: &[u32; 2]| !all.contains(&[to, from]);
    let outer: Vec<[u32; 2]> =
        triangles.iter().flat_map(|&triangle| sides(triangle)).filter(is_outer).collect();
    let next: HashMap<u32, u32> = outer.iter().map(|&[from, to]| (from, to)).collect();
    let first = outer.first()?[0];
    let mut outline = vec![first];
    let mut here = *next.get(&first)?;
    while here != first && outline.len() <= outer.len() {
        outline.push(here);
        here = *next.get(&here)?;
    }
    let vertices: HashSet<u32> = triangles.iter().flatten().copied().collect();
    // Euler's formula: with holes or handles there are more triangles.
    let is_disc = triangles.len() + outline.len() + 2 == 2 * vertices.len();
    (outline.len() == outer.len() && is_disc).then_some(outline)
}

/// Polygons that grow by a triangle at a time.
struct Growth<'t> {
    triangles: &'t [[u32; 3]],
    owners: HashMap<[u32; 2], usize>,
    is_placed: Vec<bool>,
}

impl<'t> Growth<'t> {
    fn of(triangles: &'t [[u32; 3]]) -> Self {
        let mut owners = HashMap::with_capacity(3 * triangles.len());
        for (number, &triangle) in triangles.iter().enumerate() {
            owners.extend(sides(triangle).map(|side| (side, number)));
        }
        Self { triangles, owners, is_placed: vec![false; triangles.len()] }
    }

    fn for_each(mut self, mut add: impl FnMut(Vec<u32>)) {
        for seed in 0..self.triangles.len() {
            if !self.is_placed[seed] {
                add(self.grown(seed));
            }
        }
    }

    /// The polygon that grows from a triangle.
    fn grown(&mut self, seed: usize) -> Vec<u32> {
        self.is_placed[seed] = true;
        let mut ring = GrowingPolygon::of(self.triangles[seed]);
        let mut waiting: VecDeque<[u32; 2]> = sides(self.triangles[seed]).into();
        while let Some([from, to]) = waiting.pop_front() {
            let owner = self.owners.get(&[to, from]).copied().filter(|&owner| !self.is_placed[owner]);
            let Some(owner) = owner.filter(|_| ring.next.get(&from) == Some(&to)) else { continue };
            let tip = self.triangles[owner].into_iter().find(|&vertex| vertex != from && vertex != to);
            if let Some(tip) = tip.filter(|&tip| ring.take_in([from, to], tip)) {
                self.is_placed[owner] = true;
                waiting.extend([[from, tip], [tip, to]]);
            }
        }
        ring.vertices()
    }
}

/// A polygon as a ring of vertices.
struct GrowingPolygon {
    first: u32,
    next: HashMap<u32, u32>,
}

impl GrowingPolygon {
    fn of([a, b, c]: [u32; 3]) -> Self {
        Self { first: a, next: [(a, b), (b, c), (c, a)].into() }
    }

    /// Takes in the triangle beyond a side, with this third vertex. False where the ring would visit a vertex twice.
    fn take_in(&mut self, [from, to]: [u32; 2], tip: u32) -> bool {
        let Some(&after_tip) = self.next.get(&tip) else {
            self.next.extend([(from, tip), (tip, to)]);
            return true;
        };
        if self.next.len() <= 3 {
            return false;
        }
        if self.next.get(&to) == Some(&tip) {
            // All around `to` is in the ring then.
            self.next.remove(&to);
            self.next.insert(from, tip);
            self.first = tip;
            return true;
        }
        if after_tip == from {
            self.next.remove(&from);
            self.next.insert(tip, to);
            self.first = tip;
            return true;
        }
        false
    }

    fn vertices(&self) -> Vec<u32> {
        let mut vertices = Vec::with_capacity(self.next.len());
        let mut here = self.first;
        while vertices.len() < self.next.len() {
            vertices.push(here);
            here = self.next[&here];
        }
        vertices
    }
}
