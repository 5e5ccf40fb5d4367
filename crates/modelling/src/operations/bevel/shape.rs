//! The complete plan of a bevel: vertices, faces, and values of their corners.

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::laid::{End, Laid, Node, Round, Stop};
use super::profile::Profile;
use crate::blends::CornerBlends;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, NONE};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// Grids are laid where at most this many bevels meet: each of their points is a sum over all.
const MOST_IN_GRID: usize = 32;

/// A corner to be made.
#[derive(Debug, Clone, Copy)]
pub(super) struct NewCorner {
    /// The number of its vertex in [`Plan::positions`].
    pub(super) point: u32,
    /// The number of the sum that it gets as its values.
    pub(super) sum: u32,
    /// The old corner with the normal of the old face that it touches, or `NONE`.
    pub(super) beside: CornerId,
}

/// Some new corners of a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run<T> {
    /// Where they end in [`Plan::corners`]; they begin where those before end.
    pub(super) end: usize,
    pub(super) of: T,
}

/// What a bevel will make.
pub(super) struct Blueprint {
    pub(super) laid: Laid,
    pub(super) blends: CornerBlends,
    /// Of the new vertices: first the nodes, then the points of curves and grids.
    pub(super) positions: Vec<DVec3>,
    /// The sum that is each new vertex's value.
    pub(super) point_sums: Vec<u32>,
    /// The old corner of the face in whose plane each new vertex lies, or `NONE`.
    pub(super) point_homes: Vec<CornerId>,
    /// For each curve, its first point between its ends.
    inner: Vec<u32>,
    pub(super) segments: usize,
    /// The corners of insertions, and after these of new faces.
    pub(super) corners: Vec<NewCorner>,
    /// Before which old corners some come.
    pub(super) insertions: Vec<Run<CornerId>>,
    /// New faces, and the faces from which they have their material.
    pub(super) faces: Vec<Run<FaceId>>,
}

/// A blueprint while it is drawn.
pub(super) struct Plan<'m> {
    pub(super) mesh: &'m EditMesh,
    pub(super) out: Blueprint,
    /// For each point of a curve the weights of its first end, its last and its control point.
    weights: Vec<[f64; 3]>,
    scratch: Vec<(CornerId, f64)>,
}

/// Refuses what 32-bit indices cannot name, or takes too much memory.
pub(super) fn check_size(mesh: &EditMesh, laid: &Laid, segments: usize) -> Result<(), Refusal> {
    let nodes = laid.rounds.iter().map(|round| (round.nodes[1] - round.nodes[0]) as u64);
    let corners = most_corners(laid.ends.len() as u64, nodes, segments as u64);
    let most = u64::from(u32::MAX / 2);
    if mesh.corner_capacity() as u64 + corners >= most {
        return Err(Refusal::TooMany);
    }
    // Grids of quads have a vertex and two edges for each face.
    let faces = corners / 4;
    mesh.check_capacity_for(NewElements { vertices: faces, edges: 2 * faces, corners, faces })
}

/// At least as many as there will be new corners: four for each segment of an edge, and for each point of a grid
/// at each node.
fn most_corners(edges: u64, nodes: impl Iterator<Item = u64>, segments: u64) -> u64 {
    let grid = (segments + 1) * (segments + 1);
    4 * (edges * segments + nodes.sum::<u64>() * grid)
}

impl<'m> Plan<'m> {
    pub(super) fn draw(mesh: &'m EditMesh, laid: Laid, profile: &Profile, width: f64) -> Blueprint {
        // Each new face along an edge has four corners; polygons at vertices need fewer.
        let targets = laid.moves.len() + 2 * laid.insertions.len() + 4 * laid.ends.len();
        let mut blends = CornerBlends::with_capacity(laid.parts.len(), laid.sums.len(), targets);
        let mut start = 0;
        for &end in &laid.sums {
            let parts = &laid.parts[start as usize..end as usize];
            blends.sum(parts.iter().map(|part| (part.corner, part.base + part.slope * width)));
            start = end;
        }
        let position = |node: &Node| mesh.point(node.vertex) + node.offset * width;
        let mut plan = Self {
            mesh,
            out: Blueprint {
                positions: laid.nodes.iter().map(position).collect(),
                point_sums: laid.nodes.iter().map(|node| node.sum).collect(),
                point_homes: laid.nodes.iter().map(|node| node.home).collect(),
                inner: Vec::with_capacity(laid.arcs.len()),
                laid,
                blends,
                segments: profile.segments(),
                corners: Vec::new(),
                insertions: Vec::new(),
                faces: Vec::new(),
            },
            weights: (0..=profile.segments()).map(|step| curve_weights(profile, step)).collect(),
            scratch: Vec::new(),
        };
        plan.add_curves(width);
        plan.add_insertions();
        for edge in 0..plan.out.laid.ends.len() {
            plan.add_strip(edge);
        }
        for round in 0..plan.out.laid.rounds.len() {
            let round = plan.out.laid.rounds[round];
            plan.add_middle(&round, profile, width);
        }
        plan.out
    }

    /// The points of curves between their ends.
    fn add_curves(&mut self, width: f64) {
        for i in 0..self.out.laid.arcs.len() {
            let arc = self.out.laid.arcs[i];
            self.out.inner.push(self.out.positions.len() as u32);
            if arc.first == arc.last {
                continue;
            }
            let [first, last] = [arc.first, arc.last].map(|node| self.out.positions[node as usize]);
            let control = self.control(i as u32, width);
            let sums = [arc.first, arc.last].map(|node| self.out.point_sums[node as usize]);
            for step in 1..self.out.segments {
                let [a, b, c] = self.weights[step];
                let sum = self.combine([(sums[0], a), (sums[1], b), (arc.control_sum, c)]);
                self.add_point(first * a + last * b + control * c, sum, arc.home);
            }
        }
    }

    /// Where the tangents at the ends of a curve meet.
    pub(super) fn control(&self, arc: u32, width: f64) -> DVec3 {
        let arc = &self.out.laid.arcs[arc as usize];
        self.mesh.point(self.out.laid.nodes[arc.first as usize].vertex) + arc.control * width
    }

    pub(super) fn add_point(&mut self, position: DVec3, sum: u32, home: CornerId) -> u32 {
        self.out.positions.push(position);
        self.out.point_sums.push(sum);
        self.out.point_homes.push(home);
        self.out.positions.len() as u32 - 1
    }

    /// A sum of sums; weights add up to 1.
    pub(super) fn combine(&mut self, terms: impl IntoIterator<Item = (u32, f64)>) -> u32 {
        self.scratch.clear();
        for (sum, weight) in terms {
            if weight != 0.0 {
                self.scratch.extend(self.out.blends.parts(sum).map(|(corner, part)| (corner, part * weight)));
            }
        }
        self.out.blends.sum(self.scratch.drain(..))
    }

    /// The value of a point as the face of an old corner at the same vertex continues.
    pub(super) fn value_beside(&mut self, corner: CornerId, point: u32) -> u32 {
        let way = self.out.positions[point as usize] - self.mesh.point(self.mesh.corner_vertex(corner));
        self.out.blends.sum(self.mesh.parts_beside(corner, way))
    }

    /// A corner of a new face at a vertex, next to an old corner there.
    pub(super) fn corner_in_middle(&mut self, round: &Round, home: CornerId, point: u32) -> NewCorner {
        let is_continuous = round.is_continuous;
        let sum =
            if is_continuous { self.out.point_sums[point as usize] } else { self.value_beside(home, point) };
        NewCorner { point, sum, beside: self.out.point_homes[point as usize] }
    }

    /// The corners that come before old ones where an old face has two nodes.
    fn add_insertions(&mut self) {
        for i in 0..self.out.laid.insertions.len() {
            let insertion = self.out.laid.insertions[i];
            let beside = insertion.before;
            self.out.corners.push(NewCorner { point: insertion.node, sum: insertion.sum, beside });
            if insertion.arc != NONE {
                for step in 1..self.out.segments {
                    let point = self.out.curve_point(insertion.arc, insertion.is_reversed, step);
                    let sum = if insertion.is_continuous {
                        self.out.point_sums[point as usize]
                    } else {
                        self.value_beside(insertion.before, point)
                    };
                    self.out.corners.push(NewCorner { point, sum, beside });
                }
            }
            // All corners before the same one are one run.
            let next = self.out.laid.insertions.get(i + 1);
            if next.is_none_or(|next| next.before != beside) {
                self.out.insertions.push(Run { end: self.out.corners.len(), of: beside });
            }
        }
    }

    /// The faces along a beveled edge, from its left to its right.
    fn add_strip(&mut self, edge: usize) {
        let [start, end] = self.out.laid.ends[edge];
        let sides = [start.left_corner, start.right_corner].map(|corner| self.mesh.corner_face(corner));
        let count = self.out.segments;
        for step in 0..count {
            // From its other end, left is right.
            let is_left = step < count.div_ceil(2);
            let corners = [
                self.strip_corner(&end, count - step, !is_left),
                self.strip_corner(&start, step, is_left),
                self.strip_corner(&start, step + 1, is_left),
                self.strip_corner(&end, count - step - 1, !is_left),
            ];
            self.add_face(corners, sides[usize::from(!is_left)]);
        }
    }

    /// A corner of a face along an edge: on the curve at one of its ends, with the values of one side
    /// where texture coordinates are cut at the edge.
    fn strip_corner(&mut self, end: &End, step: usize, is_left: bool) -> NewCorner {
        let point = self.out.curve_point(end.arc, end.is_reversed, step);
        let (is_first, is_last) = (step == 0, step == self.out.segments);
        let is_cut = !end.is_continuous && !self.mesh.have_same_uvs(end.left_corner, end.right_corner);
        let sum = if is_first && (is_left || !is_cut) {
            end.left_sum
        } else if is_last && (!is_left || !is_cut) {
            end.right_sum
        } else if is_cut {
            self.value_beside(if is_left { end.left_corner } else { end.right_corner }, point)
        } else if end.is_continuous {
            self.out.point_sums[point as usize]
        } else {
            // Each rim as the face beside it knows it.
            let [a, b, c] = self.weights[step];
            self.combine([(end.left_sum, a), (end.right_sum, b), (end.control_sum, c)])
        };
        let beside = match (is_first, is_last) {
            (true, _) => end.left_corner,
            (_, true) => end.right_corner,
            _ => CornerId(NONE),
        };
        NewCorner { point, sum, beside }
    }

    /// Adds a face, without corners at the same point as the one before.
    pub(super) fn add_face(&mut self, corners: impl IntoIterator<Item = NewCorner>, material: FaceId) {
        let start = self.out.corners.len();
        for corner in corners {
            if self.out.corners.len() == start
                || self.out.corners[self.out.corners.len() - 1].point != corner.point
            {
                self.out.corners.push(corner);
            }
        }
        let is_closed =
            |corners: &[NewCorner]| corners.len() > 1 && corners[0].point == corners[corners.len() - 1].point;
        while is_closed(&self.out.corners[start..]) {
            self.out.corners.pop();
        }
        if self.out.corners.len() - start < 3 {
            self.out.corners.truncate(start);
            return;
        }
        self.out.faces.push(Run { end: self.out.corners.len(), of: material });
    }

    /// What fills the middle where a vertex was.
    fn add_middle(&mut self, round: &Round, profile: &Profile, width: f64) {
        let count = round.nodes[1] - round.nodes[0];
        if count < 3 {
            return;
        }
        if self.out.segments > 1 && round.is_round && count <= MOST_IN_GRID {
            self.add_grid(round, profile, width);
        } else {
            self.add_polygon(round);
        }
    }

    /// The stops of a fan.
    pub(super) fn stops(&self, round: &Round) -> SmallVec<[Stop; 8]> {
        self.out.laid.stops[round.stops[0]..round.stops[1]].into()
    }

    fn add_polygon(&mut self, round: &Round) {
        let stops = self.stops(round);
        let mut points = SmallVec::<[u32; 16]>::new();
        let push = |points: &mut SmallVec<[u32; 16]>, point| {
            if points.last() != Some(&point) {
                points.push(point);
            }
        };
        for stop in &stops {
            push(&mut points, stop.right);
            if stop.arc != NONE {
                for step in 1..self.out.segments {
                    push(&mut points, self.out.curve_point(stop.arc, stop.is_reversed, step));
                }
            }
            if stop.beveled != NONE {
                push(&mut points, stop.left);
            }
        }
        let home = self.out.laid.nodes[round.nodes[0]].home;
        let corners: SmallVec<[NewCorner; 16]> =
            points.into_iter().map(|point| self.corner_in_middle(round, home, point)).collect();
        self.add_face(corners, self.mesh.corner_face(home));
    }
}

impl Blueprint {
    /// A point of a curve, counted from its first or its last end.
    pub(super) fn curve_point(&self, arc: u32, is_reversed: bool, step: usize) -> u32 {
        let step = if is_reversed { self.segments - step } else { step };
        let ends = &self.laid.arcs[arc as usize];
        if step == 0 || ends.first == ends.last {
            ends.first
        } else if step == self.segments {
            ends.last
        } else {
            self.inner[arc as usize] + step as u32 - 1
        }
    }
}

/// The weights of the ends and the control point of a curve. With x and y along the tangents, the point
/// is `o + x (first - o) + y (last - o)`, where `o = first + last - control` lies opposite the
/// control point.
fn curve_weights(profile: &Profile, step: usize) -> [f64; 3] {
    let point = profile.point(step);
    [1.0 - point.y, 1.0 - point.x, point.x + point.y - 1.0]
}

#[cfg(test)]
mod tests {
    use super::most_corners;

    #[test]
    fn corners_are_counted_before_they_are_made() {
        assert_eq!(most_corners(3, std::iter::empty(), 5), 60, "four in each of fifteen strips");
        assert_eq!(most_corners(0, [2, 3].into_iter(), 4), 500, "four at each of five grids of 25 points");
        assert_eq!(most_corners(3, std::iter::once(2), 1), 44, "three strips and two grids of four points");
    }
}
