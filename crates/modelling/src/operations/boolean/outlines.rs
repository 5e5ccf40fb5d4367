//! The kernel's triangles, joined to polygons again: one for each connected part of a patch where that is a polygon.

use std::collections::{HashMap, HashSet};

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::kernel::PatchedTriangles;
use super::polygons::polygons;
use super::solid::FLATNESS;
use super::surface::{regions, tidied};

/// A polygon: a part of a patch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PatchPolygon {
    pub(super) patch: u32,
    /// Indices of vertices of the triangles that it was joined from: none twice.
    pub(super) vertices: Vec<u32>,
}

impl PatchPolygon {
    /// Its sides: from one vertex to the next.
    pub(super) fn sides(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let next = self.vertices.iter().cycle().skip(1);
        self.vertices.iter().zip(next).map(|(&from, &to)| [from, to])
    }
}

/// The polygons of which a boundary consists, in the order of patches. Vertices for which `is_given` says no are left
/// out where the boundary runs straight through them.
///
/// `None` if some side of a polygon has no opposite one: the triangles were not closed, or not a surface.
pub(super) fn outlines(
    solid: &PatchedTriangles,
    is_given: impl Fn(u32) -> bool,
) -> Option<Vec<PatchPolygon>> {
    let triangles = tidied(solid);
    let mut outlines = Vec::new();
    for region in regions(&triangles) {
        polygons(&region.triangles, |vertices| outlines.push(PatchPolygon { patch: region.patch, vertices }));
    }
    outlines.sort_by_key(|outline| outline.patch);
    leave_out_straight(&mut outlines, &solid.positions, is_given);
    let outlines = without_opposites(outlines);
    is_closed(&outlines).then_some(outlines)
}

/// Leaves out vertices at which two sides meet that run straight on.
///
/// Both polygons there are flat, so their common border is a straight line: nothing adds up.
fn leave_out_straight(outlines: &mut [PatchPolygon], positions: &[DVec3], is_given: impl Fn(u32) -> bool) {
    let mut borders = Borders::of(outlines, positions.len());
    let mut is_left_out = vec![false; positions.len()];
    for vertex in 0..positions.len() as u32 {
        let &[before, after] = &borders.neighbors[vertex as usize][..] else { continue };
        let [a, b, c] = [before, vertex, after].map(|vertex| positions[vertex as usize]);
        if is_straight(a, b, c) && !is_given(vertex) && borders.leave_out(vertex, before, after) {
            is_left_out[vertex as usize] = true;
        }
    }
    for outline in outlines {
        outline.vertices.retain(|&vertex| !is_left_out[vertex as usize]);
    }
}

/// Whether a point lies between two others, on the line through them but for the rounding of its coordinates.
fn is_straight(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let largest = a.abs().max_element().max(c.abs().max_element());
    let direction = (c - a).normalize_or_zero();
    let along = (b - a).dot(direction);
    let across = (b - a - direction * along).length();
    along > 0.0 && along < (c - a).dot(direction) && across <= 2.0 * FLATNESS * largest
}

/// How the sides of all polygons join.
struct Borders {
    /// For each vertex the ends of the sides that begin there.
    neighbors: Vec<SmallVec<[u32; 4]>>,
    /// The polygon of each side.
    owners: HashMap<[u32; 2], usize>,
    /// How many vertices each polygon has.
    sizes: Vec<usize>,
}

impl Borders {
    fn of(outlines: &[PatchPolygon], vertices: usize) -> Self {
        let mut borders = Self {
            neighbors: vec![SmallVec::new(); vertices],
            owners: HashMap::new(),
            sizes: outlines.iter().map(|outline| outline.vertices.len()).collect(),
        };
        for (number, outline) in outlines.iter().enumerate() {
            for [from, to] in outline.sides() {
                borders.neighbors[from as usize].push(to);
                borders.owners.insert([from, to], number);
            }
        }
        borders
    }

    /// Joins the two sides at a vertex, unless a polygon would have too few sides, or two edges the same ends.
    fn leave_out(&mut self, vertex: u32, before: u32, after: u32) -> bool {
        let owner = |from, to| self.owners.get(&[from, to]).copied();
        let (Some(one), Some(other)) = (owner(vertex, after), owner(vertex, before)) else { return false };
        let is_whole = owner(before, vertex) == Some(one) && owner(after, vertex) == Some(other);
        let is_free = owner(before, after).is_none() && owner(after, before).is_none();
        if !is_whole || !is_free || one == other || self.sizes[one].min(self.sizes[other]) <= 3 {
            return false;
        }
        for [from, to] in [[before, vertex], [vertex, after], [after, vertex], [vertex, before]] {
            self.owners.remove(&[from, to]);
        }
        self.owners.extend([([before, after], one), ([after, before], other)]);
        self.sizes[one] -= 1;
        self.sizes[other] -= 1;
        for (end, new) in [(before, after), (after, before)] {
            let neighbors = self.neighbors[end as usize].iter_mut();
            neighbors.filter(|neighbor| **neighbor == vertex).for_each(|neighbor| *neighbor = new);
        }
        self.neighbors[vertex as usize].clear();
        true
    }
}

/// Without pairs of polygons over the same vertices: with nothing between them they bound no volume.
fn without_opposites(outlines: Vec<PatchPolygon>) -> Vec<PatchPolygon> {
    let mut known: HashMap<Vec<u32>, usize> = HashMap::with_capacity(outlines.len());
    let mut is_gone = vec![false; outlines.len()];
    for (number, outline) in outlines.iter().enumerate() {
        let mut set = outline.vertices.clone();
        set.sort_unstable();
        if let Some(other) = known.remove(&set) {
            (is_gone[number], is_gone[other]) = (true, true);
        } else {
            known.insert(set, number);
        }
    }
    outlines.into_iter().zip(is_gone).filter(|(_, is_gone)| !is_gone).map(|(outline, _)| outline).collect()
}

/// Whether each side is there once, and so is its opposite.
fn is_closed(outlines: &[PatchPolygon]) -> bool {
    let count: usize = outlines.iter().map(|outline| outline.vertices.len()).sum();
    let mut sides: HashSet<[u32; 2]> = HashSet::with_capacity(count);
    let is_first = outlines.iter().flat_map(PatchPolygon::sides).all(|side| sides.insert(side));
    is_first && sides.iter().all(|&[from, to]| sides.contains(&[to, from]))
}
