//! Joints of translucent segments: of the segments that share a vertex only one paints a sample, so that a
//! polyline does not blend its joints twice.

use crate::bin::TriangleRef;
use crate::geometry::Shape;
use crate::pass::RecordedDraw;
use crate::primitive::SetupTriangle;
use crate::tile::TileView;
use crate::view::FrameView;
use std::ops::Range;

/// An end of a segment: its draw, its vertex, the segment, and one of its
/// triangles in the tile.
type Joint = [u32; 4];

/// The ends of all segments of a tile, in order.
#[derive(Default)]
pub(super) struct Joints(Vec<Joint>);

impl Joints {
    /// Lists the segments among a tile's triangles.
    pub(super) fn collect(&mut self, tile: &TileView<'_>, triangles: Range<usize>) {
        self.0.clear();
        let is_lines = |draw: &RecordedDraw<'_>| matches!(draw.geometry.shape, Shape::Lines { .. });
        if tile.frame.pass.iter().any(is_lines) {
            let ends = |index| Some(Segment::of(tile.frame, tile.triangles[index])?.ends(index));
            self.0.extend(triangles.filter_map(ends).flatten());
            self.0.sort_unstable();
        }
    }

    /// The triangles of other segments that share a vertex with that of a
    /// triangle and come near it; whether they belong to later segments, too.
    pub(super) fn beside<'j>(
        &'j self,
        tile: TileView<'j>,
        index: usize,
    ) -> impl Iterator<Item = (usize, bool)> + 'j {
        let segment = if self.0.is_empty() { None } else { Segment::of(tile.frame, tile.triangles[index]) };
        let ends = segment.map(|segment| segment.ends(index));
        let extent = move |index: usize| extents(&tile.frame.triangle(tile.triangles[index]));
        let own = ends.map(|_| extent(index));
        ends.into_iter().flatten().flat_map(move |[draw, vertex, primitive, _]| {
            let start = self.0.partition_point(|joint| *joint < [draw, vertex, 0, 0]);
            let here = self.0[start..].iter().take_while(move |joint| joint[..2] == [draw, vertex]);
            let others = here.filter(move |joint| joint[2] != primitive);
            others
                .filter(move |joint| own.is_some_and(|own| meet(own, extent(joint[3] as usize))))
                .map(move |joint| (joint[3] as usize, joint[2] > primitive))
        })
    }
}

/// A segment, by one of its triangles.
struct Segment {
    draw: u32,
    primitive: u32,
    vertices: [u32; 2],
}

impl Segment {
    fn of(frame: &FrameView<'_>, triangle: TriangleRef) -> Option<Self> {
        triangle.part()?;
        let plan = &frame.plan.draws[frame.draw_of(triangle)];
        let geometry = &frame.pass[plan.draw].geometry;
        let segment = || {
            let primitive = triangle.ordinal - plan.ordinals.start;
            let [from, to, _] = geometry.corners(primitive);
            Self { draw: plan.draw as u32, primitive, vertices: [from, to] }
        };
        matches!(geometry.shape, Shape::Lines { .. }).then(segment)
    }

    fn ends(&self, index: usize) -> [Joint; 2] {
        self.vertices.map(|vertex| [self.draw, vertex, self.primitive, index as u32])
    }
}

/// Whether a sample is painted by another segment that is joined to this one: the
/// other covers more of it, or as much and is the later one.
#[inline(always)]
pub(super) fn prevails(other: f32, is_later: bool, own: f32) -> bool {
    other > own || (other == own && is_later)
}

/// The share of a sample that a triangle covers.
#[derive(Clone, Copy)]
pub(crate) struct SampleShare {
    pub(crate) triangle: TriangleRef,
    pub(crate) coverage: f32,
}

/// Whether a triangle leaves a sample to another one.
pub(crate) fn leaves(frame: &FrameView<'_>, own: SampleShare, other: SampleShare) -> bool {
    let segments = Segment::of(frame, own.triangle).zip(Segment::of(frame, other.triangle));
    segments.is_some_and(|(a, b)| {
        let joined = a.draw == b.draw && a.vertices.iter().any(|vertex| b.vertices.contains(vertex));
        joined && prevails(other.coverage, b.primitive > a.primitive, own.coverage)
    })
}

/// Ranges of columns and of rows.
type Extents = [[i32; 2]; 2];

fn extents(triangle: &SetupTriangle) -> Extents {
    [0, 1].map(|axis| triangle.extent(axis))
}

fn meet(a: Extents, b: Extents) -> bool {
    (0..2).all(|axis| a[axis][0] <= b[axis][1] && b[axis][0] <= a[axis][1])
}
