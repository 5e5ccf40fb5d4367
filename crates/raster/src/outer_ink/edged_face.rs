//! A triangle and the edges of its face: the distance of a point from the edges, and whether an edge lies in front of
//! the triangle.

use crate::bin::TriangleRef;
use crate::geometry::Geometry;
use crate::ink::EdgePoint;
use crate::primitive::{Corners, DepthPlane, Edge, SetupTriangle};
use crate::vertex::{DrawVertices, ScreenVertex};
use crate::view::FrameView;

/// An edge of a face between two vertices.
#[derive(Clone, Copy, Default)]
struct FaceEdge {
    /// In 1/256 pixel.
    from: [f64; 2],
    way: [f64; 2],
    /// One over the square of the length; 0 where there is none.
    inverse: f64,
    /// The depth at the beginning, and how much more it is at the end.
    depth: f64,
    rise: f64,
    /// See [`Marks`](crate::Marks).
    mark: u8,
}

/// A visible triangle and the edges of the face that it belongs to: slivers beside it may
/// cover no sample, and their edges would not be painted otherwise.
#[derive(Default)]
pub(super) struct EdgedFace {
    /// Places and bits of depths.
    vertices: Vec<[i32; 3]>,
    segments: Vec<FaceEdge>,
    edges: [Edge; 3],
    plane: DepthPlane,
    has_parts: bool,
}

/// The maximum number of triangles of the face that are examined before this one, and after it.
const MOST_PARTS: u32 = 32;

impl FaceEdge {
    fn between(from: ScreenVertex, to: ScreenVertex, mark: u8) -> Self {
        let (start, end) = (from.raw(), to.raw());
        let way = [0, 1].map(|axis| f64::from(end[axis] - start[axis]));
        let length = way[0] * way[0] + way[1] * way[1];
        let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
        let (depth, other) = (f64::from(from.depth()), f64::from(to.depth()));
        Self { from: start.map(f64::from), way, inverse, depth, rise: other - depth, mark }
    }

    fn nearest(&self, point: [f64; 2]) -> EdgePoint {
        let [x, y] = [0, 1].map(|axis| point[axis] - self.from[axis]);
        let share = ((x * self.way[0] + y * self.way[1]) * self.inverse).clamp(0.0, 1.0);
        let [dx, dy] = [x - self.way[0] * share, y - self.way[1] * share];
        EdgePoint {
            distance: (dx * dx + dy * dy).sqrt() / 256.0,
            point: [point[0] - dx, point[1] - dy],
            depth: self.depth + self.rise * share,
            mark: self.mark,
        }
    }
}

impl EdgedFace {
    /// Becomes that of a triangle.
    pub(super) fn set(&mut self, frame: &FrameView<'_>, triangle_ref: TriangleRef) {
        let triangle = frame.triangle(triangle_ref);
        (self.edges, self.plane) = (Edge::of(&triangle), DepthPlane::of(&triangle));
        self.vertices.clear();
        self.vertices.extend(triangle.vertices.each_ref().map(identity));
        self.segments.clear();
        self.has_parts = false;
        let draw = frame.draw_of(triangle_ref);
        let plan = &frame.plan.draws[draw];
        let geometry = &frame.pass[plan.draw()].geometry;
        if !geometry.shows_edges() {
            return;
        }
        let primitive = triangle_ref.ordinal - plan.ordinals.start;
        let (flags, marks) = (geometry.edge_flags(primitive), geometry.side_marks(primitive));
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            // The corner that the side does not meet; none for a side that a cut made.
            let opposite = opposite_corner(frame, triangle_ref, &triangle, [from, to]);
            let side = opposite.map(|corner| (corner + 1) % 3);
            if let Some(side) = side.filter(|&side| flags.contains(side)) {
                let [from, to] = [from, to].map(|vertex| triangle.vertices[vertex]);
                self.segments.push(FaceEdge::between(from, to, marks[side]));
            }
        }
        for part in parts(geometry, primitive) {
            self.has_parts = true;
            self.add(frame.vertices(draw), geometry, part);
        }
    }

    /// Adds another triangle of the face, unless it has to be cut.
    fn add(&mut self, vertices: DrawVertices<'_>, geometry: &Geometry<'_>, primitive: u32) {
        let corners = geometry.corners(primitive).map(|index| *vertices.get(index));
        if !corners.iter().all(|corner| corner.is_snapped()) {
            return;
        }
        for corner in corners.iter().map(identity) {
            if !self.vertices.contains(&corner) {
                self.vertices.push(corner);
            }
        }
        let (flags, marks) = (geometry.edge_flags(primitive), geometry.side_marks(primitive));
        for edge in (0..3).filter(|&edge| flags.contains(edge)) {
            self.segments.push(FaceEdge::between(corners[edge], corners[(edge + 1) % 3], marks[edge]));
        }
    }

    /// Whether the face has more triangles.
    pub(super) fn has_parts(&self) -> bool {
        self.has_parts
    }

    /// The nearest points of the edges to a point in 1/256 pixel.
    pub(super) fn nearest(&self, point: [i32; 2]) -> impl Iterator<Item = EdgePoint> {
        let point = point.map(f64::from);
        self.segments.iter().map(move |segment| segment.nearest(point))
    }

    /// Whether the two faces have a vertex in common: the same point at the same depth.
    pub(super) fn shares_a_vertex(&self, other: &Self) -> bool {
        self.vertices.iter().any(|vertex| other.vertices.contains(vertex))
    }

    /// Whether a point lies in front of the plane.
    pub(super) fn is_behind(&self, at: &EdgePoint) -> bool {
        at.depth > self.depth_at(at.point)
    }

    /// Whether the triangle covers a point that lies behind it.
    pub(super) fn hides(&self, at: &EdgePoint) -> bool {
        let inside = self.edges.iter().all(|edge| {
            let [x, y] = at.point;
            edge.origin as f64 + f64::from(edge.right) * x + f64::from(edge.down) * y > 0.0
        });
        inside && at.depth < self.depth_at(at.point)
    }

    fn depth_at(&self, [x, y]: [f64; 2]) -> f64 {
        let DepthPlane { anchor, value, right, down, .. } = self.plane;
        value + down * (y - f64::from(anchor[1])) + right * (x - f64::from(anchor[0]))
    }
}

/// What distinguishes a vertex from others.
fn identity(vertex: &ScreenVertex) -> [i32; 3] {
    [vertex.0[0], vertex.0[1], vertex.0[2]]
}

/// The other triangles of a face: those around one of its triangles that have the same face number. Each of
/// them finds this one, too. Triangles whose three corners are one vertex are skipped: they only fill a slot.
pub(crate) fn parts(geometry: &Geometry<'_>, primitive: u32) -> impl Iterator<Item = u32> {
    let is_triangle = |part: &u32| {
        let [a, b, c] = geometry.corners(*part);
        a != b || b != c
    };
    slots(geometry, primitive).filter(is_triangle)
}

/// The same with those that only fill a slot: when the face moves, they may become triangles.
pub(crate) fn slots(geometry: &Geometry<'_>, primitive: u32) -> impl Iterator<Item = u32> {
    let face = geometry.face(primitive);
    let end = (geometry.len() as u32).min(primitive + 1 + MOST_PARTS);
    let is_part = move |part: &u32| geometry.face(*part) == face;
    let before = (primitive.saturating_sub(MOST_PARTS)..primitive).rev().take_while(is_part);
    before.chain((primitive + 1..end).take_while(is_part))
}

/// The corner of the primitive that is opposite its side on which two vertices lie.
fn opposite_corner(
    frame: &FrameView<'_>,
    triangle_ref: TriangleRef,
    triangle: &SetupTriangle,
    [from, to]: [usize; 2],
) -> Option<usize> {
    match triangle.corners {
        Corners::Whole(corners) => Some(usize::from(corners[3 - from - to])),
        Corners::Cut { weights, order } => {
            let weights = &frame.chunk_of(triangle_ref).weights[weights as usize];
            let column = (0..3).find(|&column| weights[from][column] == 0.0 && weights[to][column] == 0.0)?;
            Some(usize::from(order[column]))
        }
        // Lines and points are no faces.
        Corners::Ends(_) => None,
    }
}
