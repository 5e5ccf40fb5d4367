//! Where translucent segments meet: of those that share a vertex only one
//! paints a sample, so that a polyline draws each joint once.

use crate::bin::Place;
use crate::frame::FrameView;
use crate::setup::Kind;

/// An end of a segment: its draw, its vertex, and the segment.
type Joint = [u32; 3];

/// The ends of all segments at a sample, in order.
#[derive(Default)]
pub(crate) struct Joints(Vec<Joint>);

impl Joints {
    pub(crate) fn collect(&mut self, frame: &FrameView<'_>, places: impl Iterator<Item = Place>) {
        self.0.clear();
        for place in places {
            self.0.extend(ends(frame, place).into_iter().flatten());
        }
        self.0.sort_unstable();
    }

    /// Whether a triangle is of a segment that leaves this sample to a later one
    /// of the same draw that it is joined to.
    pub(crate) fn leaves(&self, frame: &FrameView<'_>, place: Place) -> bool {
        ends(frame, place).into_iter().flatten().any(|[draw, vertex, primitive]| {
            // The last that meets in this vertex; the segment itself is among them.
            let after = self.0.partition_point(|joint| *joint <= [draw, vertex, u32::MAX]);
            self.0[after - 1][2] > primitive
        })
    }
}

/// The two ends of a line's triangle.
fn ends(frame: &FrameView<'_>, place: Place) -> Option<[Joint; 2]> {
    let triangle = &frame.chunk_of(place).extras[place.extra()?];
    let ends = || {
        let draw = frame.draw_of(place);
        let plan = &frame.plan.draws[draw];
        let primitive = triangle.ordinal - plan.ordinals.start;
        let [from, to, _] = frame.pass[plan.draw].geometry.corners(primitive);
        [from, to].map(|vertex| [plan.draw as u32, vertex, primitive])
    };
    (triangle.kind == Kind::Line).then(ends)
}
