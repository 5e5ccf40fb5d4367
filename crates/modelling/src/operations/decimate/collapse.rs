//! Rounds of collapses: the cheapest edges first, until enough triangles are gone.
//!
//! Within a round, both vertices of a collapse stay as they are afterwards, so that the costs of all other edges stay
//! right.

use fixedbitset::FixedBitSet;
use smallvec::SmallVec;
use trigon_math::DVec3;

use super::candidates::{Adjacency, Collapse, Pair, candidate, index_of, order, pairs};
use super::surface::{Merge, ReducedTriangle, Surface};
use crate::edit_mesh::EditMesh;
use crate::ids::NONE;

/// The least cosine between the normals of a triangle before and after.
const LEAST_COSINE: f64 = 0.2;

/// Edges at vertices with more triangles do not collapse, which would take long.
const MOST_TRIANGLES: usize = 256;

/// A round goes on to edges that cost this many times what the last one needed should.
const SLACK: f64 = 1.5;

/// When to end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Goal {
    /// This many triangles, or less.
    pub(super) triangles: usize,
    /// No collapse has a greater error: the square of a length.
    pub(super) error: f64,
}

/// Reduces the triangles. The largest error: the square of a length.
pub(super) fn reduce(mesh: &EditMesh, surface: &mut Surface, goal: Goal) -> f64 {
    let mut largest = 0.0;
    while surface.triangles.len() > goal.triangles {
        let adjacency = Adjacency::of(surface);
        let pairs = pairs(surface, &adjacency);
        let order = order(surface, &pairs, goal.error);
        let before = surface.triangles.len();
        let mut round = CollapseRound {
            mesh,
            adjacency,
            is_done: FixedBitSet::with_capacity(surface.points.len()),
            near: vec![NONE; surface.points.len()],
            stamp: 0,
            removed: 0,
            surface,
        };
        largest = round.run(&pairs, &order, goal, largest);
        let removed = round.removed;
        surface.triangles.retain(|triangle| triangle.face != NONE);
        // What is left is held by features; the last edges of a large mesh would take a round each.
        if removed * 2000 < before.max(1) || removed == 0 {
            break;
        }
    }
    largest
}

type Few = SmallVec<[u32; 16]>;

struct CollapseRound<'a> {
    mesh: &'a EditMesh,
    surface: &'a mut Surface,
    adjacency: Adjacency,
    /// Vertices that have collapsed.
    is_done: FixedBitSet,
    /// Marks of vertices: which collapse looked at them.
    near: Vec<u32>,
    stamp: u32,
    removed: usize,
}

impl CollapseRound<'_> {
    /// Collapses edges in order. The largest error, or the given one.
    fn run(&mut self, pairs: &[Pair], order: &[u64], goal: Goal, mut largest: f64) -> f64 {
        let all = self.surface.triangles.len();
        let wanted = (all - goal.triangles).div_ceil(2);
        let cost = |key: u64| f64::from(f32::from_bits((key >> 32) as u32));
        let limit =
            order.get(wanted.min(order.len().saturating_sub(1))).map_or(0.0, |&key| SLACK * cost(key));
        // Each round shall do a good part of the work.
        let least = (all / 64).min(wanted);
        for &key in order {
            if all - self.removed <= goal.triangles || cost(key) > limit && self.removed > least {
                break;
            }
            let pair = pairs[key as u32 as usize];
            if pair.ends.iter().any(|&vertex| self.is_done[vertex as usize]) {
                continue;
            }
            let candidate = candidate(self.surface, pair).expect("it was one");
            if self.collapse(&candidate) && candidate.error > largest {
                largest = candidate.error;
            }
        }
        largest
    }

    /// The triangles that are left at a vertex.
    fn triangles_at(&self, vertex: u32) -> Few {
        let is_left = |&&number: &&u32| self.surface.triangles[number as usize].face != NONE;
        self.adjacency.at(vertex).iter().filter(is_left).copied().collect()
    }

    fn collapse(&mut self, candidate: &Collapse) -> bool {
        let Collapse { retained, gone, point, .. } = *candidate;
        if [retained, gone].iter().any(|&vertex| self.adjacency.at(vertex).len() > MOST_TRIANGLES) {
            return false;
        }
        let [at_retained, at_gone] = [retained, gone].map(|vertex| self.triangles_at(vertex));
        let is_possible = self.preserves_topology(candidate, &at_retained, &at_gone)
            && self.preserves_sides(retained, gone, point, &at_retained)
            && self.preserves_sides(gone, retained, point, &at_gone)
            && self.stays_apart(retained, &at_gone);
        if is_possible {
            self.apply(candidate, &at_retained, &at_gone);
        }
        is_possible
    }

    /// The link condition: both vertices have no other neighbours in common than those of triangles at the edge, and no
    /// two triangles would come to lie on one another (T. Dey, H. Edelsbrunner, S. Guha, D. Nekhayev, "Topology Preserving
    /// Edge Contraction", 1999).
    fn preserves_topology(
        &mut self,
        &Collapse { retained, gone, .. }: &Collapse,
        at_retained: &[u32],
        at_gone: &[u32],
    ) -> bool {
        self.stamp += 3;
        let (visited, common, apex) = (self.stamp, self.stamp + 1, self.stamp + 2);
        for &number in at_retained {
            let vertices = self.surface.triangles[number as usize].vertices;
            vertices.iter().for_each(|&vertex| self.near[vertex as usize] = visited);
        }
        let mut in_common = 0;
        for &number in at_gone {
            let vertices = self.surface.triangles[number as usize].vertices;
            for &vertex in vertices.iter().filter(|&&vertex| vertex != gone && vertex != retained) {
                if self.near[vertex as usize] == visited {
                    self.near[vertex as usize] = common;
                    in_common += 1;
                }
            }
        }
        let mut shared = 0;
        for &number in at_gone {
            let vertices = self.surface.triangles[number as usize].vertices;
            if !vertices.contains(&retained) {
                continue;
            }
            shared += 1;
            for &vertex in vertices.iter().filter(|&&vertex| vertex != gone && vertex != retained) {
                // Of two triangles on one another.
                if self.near[vertex as usize] == apex {
                    return false;
                }
                self.near[vertex as usize] = apex;
            }
        }
        // Of a triangle by itself nothing would be left.
        if in_common != shared || at_retained.len() + at_gone.len() <= 2 * shared {
            return false;
        }
        let is_among_common = |triangle: &ReducedTriangle, than: u32| {
            triangle.vertices.iter().all(|&vertex| vertex == than || self.near[vertex as usize] == apex)
        };
        !at_gone.iter().any(|&number| {
            let triangle = &self.surface.triangles[number as usize];
            is_among_common(triangle, gone)
                && at_retained.iter().any(|&other| {
                    let other = &self.surface.triangles[other as usize];
                    is_among_common(other, retained)
                        && triangle
                            .vertices
                            .iter()
                            .all(|&vertex| vertex == gone || other.vertices.contains(&vertex))
                })
        })
    }

    /// Whether no triangle at a vertex turns over, or loses its area, if that moves; but for those at another vertex.
    fn preserves_sides(&self, moved: u32, than: u32, to: DVec3, triangles: &[u32]) -> bool {
        if self.surface.points[moved as usize] == to {
            return true;
        }
        triangles.iter().map(|&number| &self.surface.triangles[number as usize]).all(|triangle| {
            if triangle.vertices.contains(&than) {
                return true;
            }
            let first = index_of(&triangle.vertices, moved);
            let point = |i: usize| self.surface.points[triangle.vertices[(first + i) % 3] as usize];
            let (from, a, b) = (point(0), point(1), point(2));
            let normal = |apex: DVec3| (a - apex).cross(b - apex);
            let (before, after) = (normal(from), normal(to));
            let least = LEAST_COSINE * before.length() * after.length();
            before == DVec3::ZERO || after.dot(before) > least
        })
    }

    /// Whether what comes to a vertex of other faces meets none of these.
    fn stays_apart(&self, retained: u32, at_gone: &[u32]) -> bool {
        if !self.surface.is_outside[retained as usize] {
            return true;
        }
        let id = |vertex: u32| self.surface.vertices[vertex as usize];
        let meets = |&vertex: &u32| {
            // Marked by the link condition: those beside the retained vertex are its neighbours already.
            self.surface.is_outside[vertex as usize]
                && vertex != retained
                && self.near[vertex as usize] < self.stamp
                && self.mesh.find_edge(id(vertex), id(retained)).is_some()
        };
        let is_all_outside = |triangle: &ReducedTriangle| {
            !triangle.vertices.contains(&retained)
                && triangle
                    .vertices
                    .iter()
                    .filter(|&&vertex| self.surface.is_outside[vertex as usize])
                    .count()
                    == 2
        };
        let mut triangles = at_gone.iter().map(|&number| &self.surface.triangles[number as usize]);
        triangles.all(|triangle| !triangle.vertices.iter().any(&meets) && !is_all_outside(triangle))
    }

    fn apply(&mut self, candidate: &Collapse, at_retained: &[u32], at_gone: &[u32]) {
        let Collapse { retained, gone, point, .. } = *candidate;
        let surface = &mut *self.surface;
        let part = part_of(surface.points[retained as usize], surface.points[gone as usize], point);
        surface.merges.push(Merge { retained, gone, part });
        surface.points[retained as usize] = point;
        let other = surface.quadrics[gone as usize];
        surface.quadrics[retained as usize] += other;
        surface.values.merge_vertices(retained, gone);
        if !surface.allowances.is_empty() {
            // As the weight of the vertex will be.
            let [own, other] = [retained, gone].map(|vertex| surface.allowances[vertex as usize]);
            surface.allowances[retained as usize] = own * (1.0 - part) + other * part;
        }
        let mut wedges: SmallVec<[[u32; 2]; 4]> = SmallVec::new();
        for &number in at_gone {
            if surface.triangles[number as usize].vertices.contains(&retained) {
                self.removed += 1;
                surface.remove(number, [retained, gone], [at_retained, at_gone], &mut wedges);
            }
        }
        for &[retained, gone] in &wedges {
            surface.values.merges.push(Merge { retained, gone, part });
        }
        for &number in at_gone {
            surface.move_triangle(number, [retained, gone], &wedges);
        }
        [retained, gone].iter().for_each(|&vertex| self.is_done.insert(vertex as usize));
    }
}

/// Which part of the way from one point to another is nearest to a third one.
fn part_of(from: DVec3, to: DVec3, point: DVec3) -> f64 {
    let way = to - from;
    let part = (point - from).dot(way) / way.length_squared();
    if part > 0.0 { part.min(1.0) } else { 0.0 }
}

impl Surface {
    /// Removes a triangle at a collapsed edge. If one of its two other sides is a feature, what becomes of both is one.
    fn remove(
        &mut self,
        number: u32,
        [retained, gone]: [u32; 2],
        [at_retained, at_gone]: [&[u32]; 2],
        wedges: &mut SmallVec<[[u32; 2]; 4]>,
    ) {
        let triangle = self.triangles[number as usize];
        self.triangles[number as usize].face = NONE;
        let [one, two] = [retained, gone].map(|vertex| index_of(&triangle.vertices, vertex));
        if let Some(of) = self.values.of.get(triangle.face as usize) {
            let pair = [of[one], of[two]];
            if !wedges.iter().any(|known| known[1] == pair[1]) {
                wedges.push(pair);
            }
        }
        let apex = triangle.vertices[3 - one - two];
        let feature = [retained, gone].into_iter().find_map(|vertex| {
            let feature = triangle.features[side_of(&triangle.vertices, vertex, apex)?];
            (feature != NONE).then_some(feature)
        });
        let Some(feature) = feature else { return };
        for (vertex, triangles) in [(retained, at_retained), (gone, at_gone)] {
            for &other in triangles {
                let other = &mut self.triangles[other as usize];
                if let Some(side) = side_of(&other.vertices, vertex, apex).filter(|_| other.face != NONE) {
                    other.features[side] = feature;
                }
            }
        }
    }

    /// Gives a triangle the retained vertex of a collapsed edge.
    fn move_triangle(&mut self, number: u32, [retained, gone]: [u32; 2], wedges: &[[u32; 2]]) {
        let triangle = &mut self.triangles[number as usize];
        if triangle.face == NONE {
            return;
        }
        let corner = index_of(&triangle.vertices, gone);
        triangle.vertices[corner] = retained;
        if let Some(of) = self.values.of.get_mut(triangle.face as usize)
            && let Some(pair) = wedges.iter().find(|pair| pair[1] == of[corner])
        {
            of[corner] = pair[0];
        }
    }
}

/// The side of a triangle between two vertices.
fn side_of(vertices: &[u32; 3], a: u32, b: u32) -> Option<usize> {
    (0..3).find(|&side| {
        let ends = [vertices[side], vertices[(side + 1) % 3]];
        ends == [a, b] || ends == [b, a]
    })
}
