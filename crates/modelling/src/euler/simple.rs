//! Outlines that visit a vertex twice, and the simple faces of which they consist.
//!
//! Files have faces whose outline runs along an edge and back (spikes), that touch themselves in a vertex (lobes), or
//! that have a hole at the end of a bridge; merging vertices makes others. Every face of an [`EditMesh`] visits each of
//! its vertices once, so what comes from a file and what an operation makes goes through here:
//!
//! 1. Spikes are left out; they have no area.
//! 2. Loops that run around side by side become a face each.
//! 3. Anything else, such as a hole, is cut into triangles, and these are united again as long as no vertex repeats.
//!
//! The area vector stays the same throughout, and so do the sides that do not run along an edge and back.

use std::collections::{HashMap, VecDeque};

use smallvec::SmallVec;
use trigon_math::{AxisProjection, DVec2, Vec3};
use trigon_mesh::Triangulator;

use super::parts::{Divided, PartPoint, Parts};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, NONE, VertexId};
use crate::numbering::sorted_once;

/// Whether an outline visits each of its vertices once.
pub(crate) fn is_simple(vertices: &[VertexId]) -> bool {
    /// So few are compared one by one.
    const FEW: usize = 12;
    if vertices.len() <= FEW {
        return vertices.iter().enumerate().all(|(i, vertex)| !vertices[..i].contains(vertex));
    }
    let mut sorted: SmallVec<[VertexId; 64]> = vertices.into();
    sorted.sort_unstable();
    sorted.windows(2).all(|pair| pair[0] != pair[1])
}

/// The simple outlines of which any closed walk consists, as indices into it: none if it encloses nothing.
pub(crate) fn simple_parts(vertices: &[VertexId], position: impl Fn(VertexId) -> Vec3) -> Parts {
    without_doubles(&parts_of(vertices, position), vertices)
}

/// The same; two of them may have the same vertices.
fn parts_of(vertices: &[VertexId], position: impl Fn(VertexId) -> Vec3) -> Parts {
    let walk = without_spikes(vertices);
    let mut parts = Parts::default();
    if walk.len() < 3 {
        return parts;
    }
    let loops = loops_of(&walk, vertices);
    if loops.len() == 1 || lie_side_by_side(&walk, &loops, |index| position(vertices[index as usize])) {
        loops.iter().for_each(|outline| parts.push(outline.iter().copied()));
    } else {
        cut_and_unite(&walk, vertices, &position, &mut parts);
    }
    parts
}

/// The indices of a walk without those where it turns back or stays.
fn without_spikes(vertices: &[VertexId]) -> Vec<u32> {
    let at = |index: u32| vertices[index as usize];
    let mut walk: VecDeque<u32> = VecDeque::with_capacity(vertices.len());
    for index in 0..vertices.len() as u32 {
        let count = walk.len();
        if count > 0 && at(walk[count - 1]) == at(index) {
            continue;
        }
        if count > 1 && at(walk[count - 2]) == at(index) {
            walk.pop_back();
        } else {
            walk.push_back(index);
        }
    }
    // Where it closes, the same.
    while walk.len() > 1 {
        let last = walk.len() - 1;
        if at(walk[last]) == at(walk[0]) || at(walk[last - 1]) == at(walk[0]) {
            walk.pop_back();
        } else if at(walk[last]) == at(walk[1]) {
            walk.pop_front();
        } else {
            break;
        }
    }
    walk.into()
}

/// Cuts a loop off wherever the walk comes back to a vertex. None visits one twice.
fn loops_of(walk: &[u32], vertices: &[VertexId]) -> Vec<Vec<u32>> {
    let mut loops = Vec::new();
    let mut way: Vec<u32> = Vec::new();
    let mut on_way: HashMap<VertexId, usize> = HashMap::with_capacity(walk.len());
    for &index in walk {
        let vertex = vertices[index as usize];
        if let Some(&start) = on_way.get(&vertex) {
            for gone in &way[start + 1..] {
                on_way.remove(&vertices[*gone as usize]);
            }
            // That vertex stays on the way.
            let tail: Vec<u32> = way.drain(start + 1..).collect();
            let outline: Vec<u32> = std::iter::once(way[start]).chain(tail).collect();
            way[start] = index;
            loops.push(outline);
        } else {
            on_way.insert(vertex, way.len());
            way.push(index);
        }
    }
    loops.push(way);
    loops.retain(|outline| outline.len() >= 3);
    loops
}

/// Whether no loop turns the other way than the whole: as a hole in another one does.
fn lie_side_by_side(walk: &[u32], loops: &[Vec<u32>], position: impl Fn(u32) -> Vec3) -> bool {
    let positions: Vec<Vec3> = walk.iter().map(|&index| position(index)).collect();
    let view = AxisProjection::of(&positions);
    let flat = |index: u32| view.project(position(index).as_dvec3());
    let area = |outline: &Vec<u32>| -> f64 {
        let origin = flat(outline[0]);
        let arm = |index: u32| flat(index) - origin;
        outline.windows(2).map(|pair| DVec2::perp_dot(arm(pair[0]), arm(pair[1]))).sum()
    };
    // Nothing is known about what is not finite.
    loops.iter().all(|outline| area(outline) >= 0.0 || area(outline).is_nan())
}

/// Cuts a walk into triangles, and unites neighbours as long as no vertex repeats.
fn cut_and_unite(
    walk: &[u32],
    vertices: &[VertexId],
    position: &impl Fn(VertexId) -> Vec3,
    parts: &mut Parts,
) {
    let vertex = |point: u32| vertices[walk[point as usize] as usize];
    let positions: Vec<Vec3> = (0..walk.len() as u32).map(|point| position(vertex(point))).collect();
    let mut triangles = Vec::with_capacity(walk.len());
    Triangulator::default().complete_polygon(&positions, &mut triangles);
    // The border of one with two different vertices runs along an edge and back.
    triangles.retain(|triangle| is_simple(&triangle.map(vertex)));
    let sides = |triangle: [u32; 3]| [0, 1, 2].map(|i| [triangle[i], triangle[(i + 1) % 3]]);
    let mut owners: HashMap<[u32; 2], usize> = HashMap::with_capacity(3 * triangles.len());
    for (number, &triangle) in triangles.iter().enumerate() {
        owners.extend(sides(triangle).map(|side| (side, number)));
    }
    let mut is_placed = vec![false; triangles.len()];
    for seed in 0..triangles.len() {
        if std::mem::replace(&mut is_placed[seed], true) {
            continue;
        }
        let mut points: Vec<u32> = triangles[seed].to_vec();
        let mut known: HashMap<VertexId, ()> = points.iter().map(|&point| (vertex(point), ())).collect();
        let mut waiting = vec![seed];
        while let Some(here) = waiting.pop() {
            for [from, to] in sides(triangles[here]) {
                let Some(&there) = owners.get(&[to, from]) else { continue };
                // The triangles of a polygon form a tree, so each adds one point.
                let tip = triangles[there].into_iter().find(|&point| point != from && point != to);
                let Some(tip) = tip.filter(|_| !is_placed[there]) else { continue };
                if known.insert(vertex(tip), ()).is_none() {
                    is_placed[there] = true;
                    points.push(tip);
                    waiting.push(there);
                }
            }
        }
        // In the order of the walk they are the outline of the part.
        points.sort_unstable();
        parts.push(points.into_iter().map(|point| walk[point as usize]));
    }
}

/// Of outlines over the same vertices, the first.
fn without_doubles(parts: &Parts, vertices: &[VertexId]) -> Parts {
    let mut known: Vec<Vec<VertexId>> = Vec::with_capacity(parts.len());
    let mut distinct = Parts::default();
    if parts.len() < 2 {
        return parts.clone();
    }
    for outline in parts.iter() {
        let set = sorted_once(outline.iter().map(|&index| vertices[index as usize]).collect());
        if let Err(slot) = known.binary_search(&set) {
            known.insert(slot, set);
            distinct.push(outline.iter().copied());
        }
    }
    distinct
}

impl EditMesh {
    /// Gives a face's corners other vertices, one for each, and makes simple faces of the outline: the first keeps
    /// the id, and corners their values. None if it encloses nothing. Old edges stay.
    pub(crate) fn lay_simple_parts(
        &mut self,
        face: FaceId,
        corners: &[CornerId],
        vertices: &[VertexId],
    ) -> SmallVec<[FaceId; 2]> {
        let parts = simple_parts(vertices, |vertex| self.position(vertex));
        for &corner in corners {
            self.unlink_at_edge(corner.0);
            self.corners.write(corner.0).edge = NONE;
        }
        let mut points: Vec<PartPoint> = corners
            .iter()
            .zip(vertices)
            .map(|(&corner, &vertex)| PartPoint { vertex, corner, is_taken: false })
            .collect();
        for point in &points {
            self.corners.write(point.corner.0).vertex = point.vertex.0;
        }
        let mut divided = Divided::default();
        self.divide_face(face, &mut points, &parts, &mut divided);
        for point in points.iter().filter(|point| !point.is_taken) {
            self.free_corner(point.corner.0);
        }
        if divided.faces.is_empty() {
            self.free_face(face.0);
        }
        divided.faces.into()
    }

    /// A face over these vertices, in any order, but for some faces.
    pub(crate) fn face_over(
        &self,
        vertices: &[VertexId],
        is_left_out: impl Fn(FaceId) -> bool,
    ) -> Option<FaceId> {
        // Where fewest edges end, fewest faces are.
        let mut fewest = (usize::MAX, *vertices.first()?);
        for &vertex in vertices {
            let count = self.vertex_edges(vertex).take(fewest.0).count();
            if count < fewest.0 {
                fewest = (count, vertex);
            }
        }
        let wanted = sorted_once(vertices.to_vec());
        self.vertex_faces(fewest.1)
            .filter(|&face| self.face_size(face) == wanted.len() && !is_left_out(face))
            .find(|&face| sorted_once(self.face_vertices(face).collect()) == wanted)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::area_vector;

    use super::*;

    fn at(places: &[[f32; 2]], vertex: VertexId) -> Vec3 {
        let [x, y] = places[vertex.0 as usize];
        Vec3::new(x, y, 0.0)
    }

    /// The parts of a walk over vertices in the plane.
    fn parts(places: &[[f32; 2]], walk: &[u32]) -> Vec<Vec<u32>> {
        let vertices: Vec<VertexId> = walk.iter().map(|&vertex| VertexId(vertex)).collect();
        let parts = simple_parts(&vertices, |vertex| at(places, vertex));
        parts.iter().map(|part| part.iter().map(|&index| walk[index as usize]).collect()).collect()
    }

    const PLACES: [[f32; 2]; 8] =
        [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]];

    #[test]
    fn spikes_go_lobes_come_apart_and_holes_are_cut() {
        assert_eq!(parts(&PLACES, &[0, 1, 2, 3]), [[0, 1, 2, 3]], "a square");
        assert_eq!(parts(&PLACES, &[0, 1, 2, 6, 2, 3]), [[0, 1, 2, 3]], "with a spike");
        assert_eq!(parts(&PLACES, &[4, 0, 1, 2, 3, 0]), [[0, 1, 2, 3]], "that is where it closes");
        assert_eq!(parts(&PLACES, &[0, 1, 0, 2]), Vec::<Vec<u32>>::new(), "nothing but spikes");
        assert_eq!(parts(&PLACES, &[0, 1, 0, 1, 2]), [[0, 1, 2]], "there and back");
        assert_eq!(
            parts(&PLACES, &[0, 1, 4, 2, 3, 4]),
            [[4, 2, 3], [0, 1, 4]],
            "two lobes, the one that closes first"
        );
        assert_eq!(parts(&PLACES, &[0, 1, 2, 0, 1, 2]), [[0, 1, 2]], "twice around");
        let keyhole = parts(&PLACES, &[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]);
        assert!(keyhole.len() > 1 && keyhole.len() < 4, "a hole needs a cut: {keyhole:?}");
    }

    /// Twice the area of an outline.
    fn doubled_area(places: &[[f32; 2]], outline: impl Iterator<Item = u32>) -> f64 {
        2.0 * area_vector(outline.map(|vertex| at(places, VertexId(vertex)).as_dvec3())).z
    }

    proptest! {
        /// Round a few vertices again and again.
        #[test]
        fn parts_of_any_walk_are_simple_and_have_its_area(
            walk in prop::collection::vec(0..8_u32, 3..24), places in prop::array::uniform8(prop::array::uniform2(-4i8..4)),
        ) {
            let places = places.map(|place| place.map(f32::from));
            let found = parts(&places, &walk);
            let mut sets: Vec<Vec<u32>> = found.iter().map(|part| sorted_once(part.clone())).collect();
            for (part, set) in found.iter().zip(&sets) {
                prop_assert!(part.len() >= 3 && set.len() == part.len(), "{part:?}");
            }
            sets.sort_unstable();
            prop_assert!(sets.windows(2).all(|pair| pair[0] != pair[1]), "doubled: {found:?}");
            let vertices: Vec<VertexId> = walk.iter().map(|&vertex| VertexId(vertex)).collect();
            let all = parts_of(&vertices, |vertex| at(&places, vertex));
            let sum: f64 = all.iter().map(|part| doubled_area(&places, part.iter().map(|&i| walk[i as usize]))).sum();
            prop_assert_eq!(sum, doubled_area(&places, walk.iter().copied()), "{:?}", found);
        }
    }
}
