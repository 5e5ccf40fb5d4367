//! Clipping a line segment.

use glam::Vec4;

use super::cut::{Vertex, cut};
use super::{ClipVertex, ClipVolume};

/// Clips a segment in clip space; the ends keep their order.
///
/// The result has the same bits as the edge of a triangle with the same ends. `None` if no length
/// is left, also if only an end touches the volume, and if a position contains NaN or an infinity.
/// See the [module's guarantees](crate::clip).
#[must_use]
pub fn clip_segment(segment: [Vec4; 2], volume: &ClipVolume) -> Option<[ClipVertex<2>; 2]> {
    if !segment.iter().all(|position| position.is_finite()) {
        return None;
    }
    let [start, end] = segment;
    let mut ends = [Vertex::corner(0, start), Vertex::corner(1, end)];
    for half_space in volume.half_spaces() {
        let [from, to] = ends.map(|vertex| half_space.distance(vertex.position));
        if from > 0.0 && to < 0.0 {
            ends[1] = cut(&ends[0], &ends[1], half_space, volume);
        } else if from < 0.0 && to > 0.0 {
            ends[0] = cut(&ends[1], &ends[0], half_space, volume);
        } else if from < 0.0 || to < 0.0 {
            return None;
        }
    }
    Some(ends.map(Vertex::rounded))
}
