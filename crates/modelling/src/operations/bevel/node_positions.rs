//! Positions of nodes: on edges next to beveled ones, or where two rims meet in a face.

use smallvec::{SmallVec, smallvec};
use trigon_math::DVec3;

use super::laid::{Node, WeightTerm};
use super::nodes::Nodes;
use crate::ids::{CornerId, VertexId};

/// The sine of an angle below which two edges count as one line. An edge beside a beveled one then
/// leads almost along it, and would reach the distance of the rim far away or never.
pub(super) const STRAIGHT: f64 = 0.05;

impl Nodes<'_> {
    /// Adds a node on one of the two edges of a corner, at a distance times the width; its number.
    pub(super) fn node_on_edge(
        &mut self,
        vertex: VertexId,
        corner: CornerId,
        is_out: bool,
        distance: f64,
    ) -> u32 {
        let (direction, length) = self.way(corner, is_out);
        let parts = self.parts_toward(corner, is_out, distance, length);
        let sum = self.sum(&parts);
        self.nodes.push(Node { vertex, offset: direction * distance, sum, home: corner });
        self.nodes.len() as u32 - 1
    }

    /// The corner at the other end of one of the two edges of a corner.
    pub(super) fn far_corner(&self, corner: CornerId, is_out: bool) -> CornerId {
        if is_out { self.mesh.next_corner(corner) } else { self.mesh.previous_corner(corner) }
    }

    /// Direction and length of the edge along which a corner is left, or by which it is entered. Both
    /// are zero where there is no direction.
    pub(super) fn way(&self, corner: CornerId, is_out: bool) -> (DVec3, f64) {
        let point = |corner| self.mesh.point(self.mesh.corner_vertex(corner));
        let way = point(self.far_corner(corner, is_out)) - point(corner);
        let length = way.length();
        if length > 0.0 && length.is_finite() { (way / length, length) } else { (DVec3::ZERO, 0.0) }
    }

    /// Where the rims of two beveled edges meet in the one face between them.
    pub(super) fn meeting(&mut self, corner: CornerId) -> (DVec3, SmallVec<[WeightTerm; 4]>) {
        let (out, out_length) = self.way(corner, true);
        let (into, into_length) = self.way(corner, false);
        let rims = [self.rim(corner, true), self.rim(corner, false)];
        let cross = out.cross(into);
        let sine = cross.length();
        if sine > STRAIGHT {
            // At a reflex angle the rims meet on the other side.
            let is_hollow = self.frames.is_hollow(self.mesh, corner, cross);
            let scale = if is_hollow { -1.0 } else { 1.0 } / sine;
            // Along each edge as far as the rim of the other one is from that.
            let [along_out, along_into] = [rims[1] * scale, rims[0] * scale];
            let slopes = [along_out / out_length, along_into / into_length];
            let parts = smallvec![
                self.toward(corner, true, slopes[0]),
                self.toward(corner, false, slopes[1]),
                WeightTerm { corner, base: 1.0, slope: -slopes[0] - slopes[1] },
            ];
            return (out * along_out + into * along_into, parts);
        }
        let rim = 0.5 * (rims[0] + rims[1]);
        if out.dot(into) < 0.0 {
            // One straight line: the rim runs beside it, in the plane of the face.
            let direction = (out - into).normalize_or_zero();
            let (offset, mut parts) = self.frames.beside(self.mesh, corner, direction);
            parts.iter_mut().for_each(|part| part.slope *= rim);
            return (offset * rim, parts);
        }
        (out * rim, self.parts_on_edge(corner, true, rim))
    }

    /// Where the rims of two beveled edges meet that have several faces between them: the one along which the first
    /// corner is left, and the one by which the last is entered. Each rim runs in the plane of the face beside its
    /// edge; if these planes differ, in the middle of the points of both that are nearest to each other.
    pub(super) fn meeting_across(
        &mut self,
        first: CornerId,
        last: CornerId,
    ) -> (DVec3, SmallVec<[WeightTerm; 4]>) {
        let [one, other] = [self.way(first, true).0, self.way(last, false).0];
        let rims = [self.rim(first, true), self.rim(last, false)];
        let (beside_one, mut parts) = self.frames.beside(self.mesh, first, one);
        let (beside_other, parts_other) = self.frames.beside(self.mesh, last, -other);
        let [offset_one, offset_other] = [beside_one * rims[0], beside_other * rims[1]];
        let along = nearest([one, other], offset_other - offset_one);
        parts.iter_mut().for_each(|part| part.slope *= rims[0]);
        parts.extend(parts_other.into_iter().map(|part| WeightTerm { slope: part.slope * rims[1], ..part }));
        for (corner, is_out, along) in [(first, true, along[0]), (last, false, along[1])] {
            // Without the corner itself, which is there already.
            parts.extend(
                self.parts_on_edge(corner, is_out, along)
                    .into_iter()
                    .map(|part| WeightTerm { base: 0.0, ..part }),
            );
        }
        for part in &mut parts {
            (part.base, part.slope) = (0.5 * part.base, 0.5 * part.slope);
        }
        (0.5 * (offset_one + one * along[0] + offset_other + other * along[1]), parts)
    }

    /// In the middle of the places on the first and the last edge between two beveled ones.
    pub(super) fn middle_between(
        &self,
        first: CornerId,
        last: CornerId,
    ) -> (DVec3, SmallVec<[WeightTerm; 4]>) {
        let (one, other) = (self.rim_distance(first, true), self.rim_distance(last, false));
        let mut parts = self.parts_on_edge(first, false, one);
        parts.extend(self.parts_on_edge(last, true, other));
        for part in &mut parts {
            (part.base, part.slope) = (0.5 * part.base, 0.5 * part.slope);
        }
        (0.5 * (self.way(first, false).0 * one + self.way(last, true).0 * other), parts)
    }

    fn toward(&self, corner: CornerId, is_out: bool, slope: f64) -> WeightTerm {
        WeightTerm { corner: self.far_corner(corner, is_out), base: 0.0, slope }
    }

    /// The parts of a place on an edge of a corner, at a distance times the width.
    pub(super) fn parts_on_edge(
        &self,
        corner: CornerId,
        is_out: bool,
        distance: f64,
    ) -> SmallVec<[WeightTerm; 4]> {
        let length = self.way(corner, is_out).1;
        self.parts_toward(corner, is_out, distance, length)
    }

    /// The same where the edge's length is known.
    fn parts_toward(
        &self,
        corner: CornerId,
        is_out: bool,
        distance: f64,
        length: f64,
    ) -> SmallVec<[WeightTerm; 4]> {
        let slope = if length > 0.0 { distance / length } else { 0.0 };
        smallvec![WeightTerm { corner, base: 1.0, slope: -slope }, self.toward(corner, is_out, slope)]
    }

    /// Adds the sum for a place on an edge of a corner.
    pub(super) fn sum_on_edge(&mut self, corner: CornerId, is_out: bool, distance: f64) -> u32 {
        let parts = self.parts_on_edge(corner, is_out, distance);
        self.sum(&parts)
    }
}

/// How far along two unit directions two lines are nearest to each other, from the first points of both, which are
/// apart by `between`. Zero where the lines are almost parallel.
fn nearest([one, other]: [DVec3; 2], between: DVec3) -> [f64; 2] {
    let cosine = one.dot(other);
    let squared_sine = 1.0 - cosine * cosine;
    if squared_sine <= STRAIGHT * STRAIGHT {
        return [0.0; 2];
    }
    let (a, b) = (between.dot(one), between.dot(other));
    [(a - b * cosine) / squared_sine, (a * cosine - b) / squared_sine]
}
