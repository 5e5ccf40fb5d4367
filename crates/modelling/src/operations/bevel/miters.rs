//! Miters: where two rims meet in one face, a curve or a patch replaces the point.

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::laid::{Arc, Insertion, Move, Node, Round, Stop, WeightTerm};
use super::node_positions::STRAIGHT;
use super::nodes::{Layout, Nodes};
use super::settings::{InnerMiter, OuterMiter};
use crate::ids::{CornerId, EdgeId, NONE};

/// A place in the plane of a corner's two edges: its offset from the vertex, and the parts of its values.
type WeightedOffset = (DVec3, SmallVec<[WeightTerm; 4]>);

/// Two beveled edges of a corner, in the corner's face.
struct Meeting {
    /// The directions of the edge along which the corner is left and of the one by which it is entered.
    out: DVec3,
    into: DVec3,
    /// The distances of their rims, on the face's side; negative at a reflex angle, which lies on the other
    /// side of each edge than the other edge.
    rims: [f64; 2],
    sine: f64,
}

impl Nodes<'_> {
    /// Lays a miter between two beveled edges of one face, if the settings request one for its angle.
    /// Returns whether it did.
    pub(super) fn fill_with_miter(&mut self, round: &Round, layout: &mut Layout, from: usize) -> bool {
        let corner = layout.corners[from];
        let Some(meeting) = self.beveled_corner(corner) else { return false };
        let is_reflex = meeting.rims[0] < 0.0;
        let at_meeting = meeting.along([0.0, 0.0]);
        let offsets: SmallVec<[DVec3; 3]> = match (is_reflex, self.rims.outer_miter, self.rims.inner_miter) {
            // As far as the foot of the vertex on each rim.
            (true, OuterMiter::Arc, _) => SmallVec::from_slice(&meeting.feet()),
            (true, OuterMiter::Patch, _) => {
                let [first, last] = meeting.feet();
                SmallVec::from_slice(&[first, at_meeting, last])
            }
            (false, _, InnerMiter::Arc) => {
                let [out, into] = meeting.rims;
                SmallVec::from_slice(&[meeting.along([into, 0.0]), meeting.along([0.0, out])])
            }
            _ => return false,
        };
        let offsets: SmallVec<[WeightedOffset; 3]> =
            offsets.into_iter().map(|offset| self.offset_in_corner(corner, &meeting, offset)).collect();
        let controls: SmallVec<[DVec3; 2]> = match offsets.len() {
            2 => SmallVec::from_slice(&[at_meeting]),
            // A straight curve has its control point in the middle.
            _ => offsets.windows(2).map(|pair| 0.5 * (pair[0].0 + pair[1].0)).collect(),
        };
        let controls: SmallVec<[WeightedOffset; 2]> =
            controls.into_iter().map(|offset| self.offset_in_corner(corner, &meeting, offset)).collect();
        self.add_miter(round, layout, from, [&offsets, &controls]);
        true
    }

    /// Adds the nodes of a miter in order, with the curves between them.
    fn add_miter(
        &mut self,
        round: &Round,
        layout: &mut Layout,
        from: usize,
        [offsets, controls]: [&[WeightedOffset]; 2],
    ) {
        let (vertex, corner) = (layout.vertex, layout.corners[from]);
        let first = self.nodes.len() as u32;
        for (offset, parts) in offsets {
            let sum = self.sum(parts);
            self.nodes.push(Node { vertex, offset: *offset, sum, home: corner });
        }
        let last = self.nodes.len() as u32 - 1;
        let sum_of = |nodes: &Self, node: u32| nodes.nodes[node as usize].sum;
        let [first_sum, last_sum] = [first, last].map(|node| sum_of(self, node));
        let first_arc = self.arcs.len() as u32;
        for (node, (control, parts)) in (first..).zip(controls) {
            let control_sum = self.sum(parts);
            self.arcs.push(Arc { first: node, last: node + 1, control: *control, control_sum, home: corner });
            let arc = self.arcs.len() as u32 - 1;
            let edge = EdgeId(NONE);
            layout
                .miters
                .push((from, Stop { edge, beveled: NONE, right: node, left: node, arc, is_reversed: false }));
        }
        layout.stops[from].left = first;
        layout.stops[from + 1].right = last;
        (layout.sums[from], layout.entered_sums[from]) = (first_sum, last_sum);
        self.moves.push(Move { corner, node: first, sum: first_sum });
        // The face comes from the other edge: the last node is the first on its way.
        for node in (first + 1..=last).rev() {
            let (before, sum, arc) = (corner, sum_of(self, node), first_arc + node - first - 1);
            let is_continuous = round.is_continuous;
            self.insertions.push(Insertion { before, node, sum, arc, is_reversed: true, is_continuous });
        }
    }

    /// The two beveled edges of a corner; `None` if they are almost one line.
    fn beveled_corner(&mut self, corner: CornerId) -> Option<Meeting> {
        let (out, into) = (self.way(corner, true).0, self.way(corner, false).0);
        let cross = out.cross(into);
        let sine = cross.length();
        if sine <= STRAIGHT {
            return None;
        }
        let side = if self.frames.is_hollow(self.mesh, corner, cross) { -1.0 } else { 1.0 };
        let rims = [true, false].map(|is_out| side * self.rim(corner, is_out));
        Some(Meeting { out, into, rims, sine })
    }

    /// The values of a place in the plane of a corner's edges.
    fn offset_in_corner(&self, corner: CornerId, meeting: &Meeting, offset: DVec3) -> WeightedOffset {
        let Meeting { out, into, sine, .. } = *meeting;
        // The offset is alpha out + beta into.
        let cosine = out.dot(into);
        let (a, b) = (offset.dot(out), offset.dot(into));
        let [alpha, beta] = [a - cosine * b, b - cosine * a].map(|value| value / (sine * sine));
        let slopes = [(true, alpha), (false, beta)]
            .map(|(is_out, part)| (self.far_corner(corner, is_out), part / self.way(corner, is_out).1));
        let mut parts = SmallVec::new();
        parts.push(WeightTerm { corner, base: 1.0, slope: -slopes[0].1 - slopes[1].1 });
        parts.extend(slopes.map(|(corner, slope)| WeightTerm { corner, base: 0.0, slope }));
        (offset, parts)
    }
}

impl Meeting {
    /// Where both rims meet, and from there along either.
    fn along(&self, [along_out, along_into]: [f64; 2]) -> DVec3 {
        let [out, into] = self.rims;
        self.out * (into / self.sine + along_out) + self.into * (out / self.sine + along_into)
    }

    /// The feet of the vertex on both rims.
    fn feet(&self) -> [DVec3; 2] {
        let cosine = self.out.dot(self.into);
        let across = [self.into - self.out * cosine, self.out - self.into * cosine];
        [across[0] * (self.rims[0] / self.sine), across[1] * (self.rims[1] / self.sine)]
    }
}
