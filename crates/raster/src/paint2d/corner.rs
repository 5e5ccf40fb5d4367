//! A vertex on the sub-pixel grid, and the triangles of a mesh made of such vertices.

use super::{Mesh, Vertex};
use trigon_math::{Fixed, FixedPoint};

/// A vertex whose position is on the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct SnappedVertex {
    pub(super) point: FixedPoint,
    pub(super) uv: [f32; 2],
    pub(super) color: [u8; 4],
}

/// The vertex's point; `None` if it has none: not a number, or out of range.
#[inline(always)]
pub(super) fn snap(vertex: &Vertex) -> Option<FixedPoint> {
    let [x, y] = vertex.position;
    Some(FixedPoint::new(Fixed::from_f32(x)?, Fixed::from_f32(y)?))
}

/// All triangles of a mesh whose vertices are snapped to `points`; `None` for
/// those with an index or a point missing.
#[inline(always)]
pub(super) fn triangles<'a>(
    mesh: &'a Mesh<'a>,
    points: &'a [Option<FixedPoint>],
) -> impl Iterator<Item = Option<[SnappedVertex; 3]>> {
    let corner = |index: u32| {
        let vertex = mesh.vertices.get(index as usize)?;
        let point = (*points.get(index as usize)?)?;
        Some(SnappedVertex { point, uv: vertex.uv, color: vertex.color })
    };
    mesh.indices.chunks(3).map(move |indices| {
        let &[a, b, c] = indices.first_chunk::<3>()?;
        Some([corner(a)?, corner(b)?, corner(c)?])
    })
}
