//! The vertices of up to eight whole primitives. Unused lanes repeat the first.

use crate::bin::TriangleRef;
use crate::simd::{InlineMap, LANES, lanes_of};
use crate::vertex::ScreenVertex;
use crate::view::FrameView;

/// The vertices of up to eight whole primitives of one draw.
#[inline(always)]
pub(super) fn corners_of_one<'f>(
    frame: &FrameView<'f>,
    triangles: &[TriangleRef],
) -> [[&'f ScreenVertex; LANES]; 3] {
    let draw = frame.draw_of(triangles[0]);
    let plan = &frame.plan.draws[draw];
    let (vertices, geometry) = (frame.vertices(draw), &frame.pass[plan.draw()].geometry);
    let corners: [[u32; 3]; LANES] = lanes_of(
        #[inline(always)]
        |lane| {
            let triangle = triangles.get(lane).unwrap_or(&triangles[0]);
            geometry.corners(triangle.ordinal - plan.ordinals.start)
        },
    );
    [0, 1, 2].each(
        #[inline(always)]
        |corner| {
            corners.each(
                #[inline(always)]
                |corners| vertices.get(corners[corner]),
            )
        },
    )
}

/// The vertices of up to eight whole primitives of several draws.
///
/// Not inlined: few tiles need it.
#[inline(never)]
pub(super) fn corners_of_several<'f>(
    frame: &FrameView<'f>,
    triangles: &[TriangleRef],
) -> [[&'f ScreenVertex; LANES]; 3] {
    let corners = lanes_of(|lane| frame.corners(*triangles.get(lane).unwrap_or(&triangles[0])));
    [0, 1, 2].each(|corner| corners.each(|corners| corners[corner]))
}
