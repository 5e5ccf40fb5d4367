//! The planes of faces, for corners where two edges do not define one.

use std::collections::BTreeMap;

use smallvec::{SmallVec, smallvec};
use trigon_math::DVec3;

use super::laid::WeightTerm;
use crate::blends::in_plane;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};

/// Three corners of a face that lie far from one line, and its normal.
#[derive(Debug, Clone, Copy)]
struct Frame {
    corners: [CornerId; 3],
    /// Not of unit length.
    normal: DVec3,
}

/// The frames of large faces are kept: all their corners may be asked for.
#[derive(Debug, Default)]
pub(super) struct Frames {
    large: BTreeMap<FaceId, Frame>,
}

/// From this many corners on a face is large.
const LARGE: usize = 9;

impl Frames {
    /// Whether a face's angle at a corner is larger than half a turn. `cross` is that of the edges
    /// that leave and enter it.
    pub(super) fn is_hollow(&mut self, mesh: &EditMesh, corner: CornerId, cross: DVec3) -> bool {
        let face = mesh.corner_face(corner);
        mesh.face_size(face) > 3 && self.frame(mesh, face).normal.dot(cross) < 0.0
    }

    /// To the inner side of a straight line through a corner, in the face's plane.
    pub(super) fn beside(
        &mut self,
        mesh: &EditMesh,
        corner: CornerId,
        direction: DVec3,
    ) -> (DVec3, SmallVec<[WeightTerm; 4]>) {
        let frame = self.frame(mesh, mesh.corner_face(corner));
        let offset = frame.normal.cross(direction).normalize_or_zero();
        let mut parts = smallvec![WeightTerm { corner, base: 1.0, slope: 0.0 }];
        let [a, b, c] = frame.corners;
        let point = |corner| mesh.point(mesh.corner_vertex(corner));
        if let Some([beta, gamma]) = in_plane(offset, point(b) - point(a), point(c) - point(a)) {
            for (corner, slope) in [(a, -beta - gamma), (b, beta), (c, gamma)] {
                parts.push(WeightTerm { corner, base: 0.0, slope });
            }
        }
        (offset, parts)
    }

    fn frame(&mut self, mesh: &EditMesh, face: FaceId) -> Frame {
        if mesh.face_size(face) < LARGE {
            return frame_of(mesh, face);
        }
        *self.large.entry(face).or_insert_with(|| frame_of(mesh, face))
    }
}

fn frame_of(mesh: &EditMesh, face: FaceId) -> Frame {
    let first = mesh.face_corners(face).next().expect("a face has corners");
    let point = |corner| mesh.point(mesh.corner_vertex(corner));
    let origin = point(first);
    let mut normal = DVec3::ZERO;
    let mut second = first;
    for corner in mesh.face_corners(face) {
        // Newell's method, about the first corner.
        normal += (point(corner) - origin).cross(point(mesh.next_corner(corner)) - origin);
        if point(corner).distance_squared(origin) > point(second).distance_squared(origin) {
            second = corner;
        }
    }
    let axis = point(second) - origin;
    let area = |corner| axis.cross(point(corner) - origin).length_squared();
    let mut third = first;
    for corner in mesh.face_corners(face) {
        if area(corner) > area(third) {
            third = corner;
        }
    }
    Frame { corners: [first, second, third], normal }
}
