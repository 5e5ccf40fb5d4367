//! Whether a straight cut stays inside a face.

use trigon_math::{AxisProjection, DVec2, DVec3, Orientation, area_vector, orientation};

use crate::edit_mesh::EditMesh;
use crate::ids::CornerId;

impl EditMesh {
    /// Whether the straight line between two corners of a face runs inside the face and crosses
    /// none of its sides, seen along the axis along which the face is seen largest: exact. A face without
    /// area or with a position that is not finite has no inside that a line could leave.
    pub(super) fn is_cut_inside(&self, from: CornerId, to: CornerId) -> bool {
        let face = self.corner_face(from);
        let point = |corner: CornerId| self.point(self.corner_vertex(corner));
        let normal = area_vector(self.face_corners(face).map(point));
        if !normal.is_finite() || normal == DVec3::ZERO {
            return true;
        }
        let view = AxisProjection::against(normal);
        let flat = |corner: CornerId| view.project(point(corner));
        let (start, end) = (flat(from), flat(to));
        let is_inside_at = |corner: CornerId, target: DVec2| {
            let [before, here, after] =
                [self.previous_corner(corner), corner, self.next_corner(corner)].map(flat);
            let left = |a: DVec2, b: DVec2, c: DVec2| orientation(a, b, c) == Orientation::CounterClockwise;
            let is_convex = orientation(before, here, after) != Orientation::Clockwise;
            if is_convex {
                left(here, after, target) && left(before, here, target)
            } else {
                left(here, after, target) || left(before, here, target)
            }
        };
        let crosses = |corner: CornerId| {
            let (a, b) = (flat(corner), flat(self.next_corner(corner)));
            let sides = [orientation(start, end, a), orientation(start, end, b)];
            let others = [orientation(a, b, start), orientation(a, b, end)];
            is_opposite(sides) && is_opposite(others)
        };
        is_inside_at(from, end) && is_inside_at(to, start) && !self.face_corners(face).any(crosses)
    }
}

fn is_opposite(orientations: [Orientation; 2]) -> bool {
    use Orientation::{Clockwise, CounterClockwise};
    matches!(orientations, [Clockwise, CounterClockwise] | [CounterClockwise, Clockwise])
}
