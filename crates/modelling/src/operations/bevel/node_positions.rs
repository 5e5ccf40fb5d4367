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

    /// Where the rims of two beveled edges meet that have several faces between them, given their corners: the one
    /// edge leaves the first, the other enters the last. The rims run in the planes of the faces beside their edges;
    /// what is in the middle of the points of both that are nearest to each other is projected onto a face between
    /// them, so that it stays on the surface.
    pub(super) fn meeting_across(&mut self, corners: &[CornerId]) -> (DVec3, SmallVec<[WeightTerm; 4]>) {
        let (first, last) = (corners[0], corners[corners.len() - 1]);
        let [one, other] = [self.way(first, true).0, self.way(last, false).0];
        let beside_one = self.frames.beside(self.mesh, first, one).0 * self.rim(first, true);
        let beside_other = self.frames.beside(self.mesh, last, -other).0 * self.rim(last, false);
        let along = nearest([one, other], beside_other - beside_one);
        let meeting = 0.5 * (beside_one + one * along[0] + beside_other + other * along[1]);
        let in_corners = corners[1..corners.len() - 1].iter().filter_map(|&corner| {
            let along = self.along_sides(corner, meeting)?;
            Some((corner, along))
        });
        // The face in whose angle it is, or that it misses least.
        let best = in_corners.max_by(|(_, a), (_, b)| a[0].min(a[1]).total_cmp(&b[0].min(b[1])));
        let Some((corner, along)) = best else { return self.middle_between(first, last) };
        let sides = [true, false].map(|is_out| self.way(corner, is_out));
        let slopes = [along[0] / sides[0].1, along[1] / sides[1].1];
        let parts = smallvec![
            self.toward(corner, true, slopes[0]),
            self.toward(corner, false, slopes[1]),
            WeightTerm { corner, base: 1.0, slope: -slopes[0] - slopes[1] },
        ];
        (sides[0].0 * along[0] + sides[1].0 * along[1], parts)
    }

    /// How far along the two sides of a corner an offset is, projected onto their plane. `None` if they are almost one
    /// line.
    fn along_sides(&self, corner: CornerId, offset: DVec3) -> Option<[f64; 2]> {
        let [out, into] = [true, false].map(|is_out| self.way(corner, is_out).0);
        let cosine = out.dot(into);
        let squared_sine = 1.0 - cosine * cosine;
        let (a, b) = (offset.dot(out), offset.dot(into));
        let along = [a - cosine * b, b - cosine * a].map(|value| value / squared_sine);
        (squared_sine > STRAIGHT * STRAIGHT && out != DVec3::ZERO && into != DVec3::ZERO).then_some(along)
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
