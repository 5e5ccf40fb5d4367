//! Clipping a triangle.

use glam::Vec4;

use super::cut::{Vertex, cut};
use super::{ClipVolume, HalfSpace, Outcode};

/// A vertex of a clipped triangle, or of a segment with `CORNERS` = 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVertex<const CORNERS: usize = 3> {
    /// In clip space.
    pub position: Vec4,
    /// The weight of each original corner, each in `[0, 1]`. For an attribute that is linear in
    /// clip space (every vertex attribute), the value here is the sum of the corners' values times
    /// these weights.
    pub weights: [f32; CORNERS],
}

/// One additional vertex per half-space.
const CAPACITY: usize = 3 + HalfSpace::COUNT;

/// The result of clipping a triangle: a convex polygon with the winding of the triangle, or
/// nothing. Neighbouring vertices may coincide after rounding.
#[derive(Clone, Copy, Debug)]
pub struct ClipPolygon {
    vertices: [ClipVertex; CAPACITY],
    count: usize,
}

impl ClipPolygon {
    const EMPTY: Self =
        Self { vertices: [ClipVertex { position: Vec4::ZERO, weights: [0.0; 3] }; CAPACITY], count: 0 };

    /// The vertices: none, or from 3 to 3 plus the number of half-spaces.
    #[must_use]
    pub fn vertices(&self) -> &[ClipVertex] {
        &self.vertices[..self.count]
    }

    /// Whether nothing is left.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// Clips a triangle in clip space.
///
/// Empty if no area is left, also if only a corner or an edge touches the volume, and if a position
/// contains NaN or an infinity. See the [module's guarantees](crate::clip).
///
/// ```
/// use trigon_math::{ClipVolume, HalfSpace, Vec4, clip_triangle};
///
/// let volume = ClipVolume::before_the_eye(1e-6).unwrap().with(HalfSpace::NEAR);
/// // The near plane is z = w: the third corner is before it.
/// let triangle = [
///     Vec4::new(-1.0, 0.0, 1.0, 3.0),
///     Vec4::new(1.0, 0.0, 1.0, 3.0),
///     Vec4::new(0.0, 1.0, 1.0, -1.0),
/// ];
/// let polygon = clip_triangle(triangle, &volume);
/// let positions: Vec<Vec4> = polygon.vertices().iter().map(|v| v.position).collect();
/// assert_eq!(positions[..2], triangle[..2]);
/// assert_eq!(positions[2..], [Vec4::new(0.5, 0.5, 1.0, 1.0), Vec4::new(-0.5, 0.5, 1.0, 1.0)]);
/// assert_eq!(polygon.vertices()[2].weights, [0.0, 0.5, 0.5]);
/// ```
#[must_use]
pub fn clip_triangle(triangle: [Vec4; 3], volume: &ClipVolume) -> ClipPolygon {
    let codes = triangle.map(|position| volume.outcode(position));
    let finite = triangle.iter().all(|position| position.is_finite());
    if !finite || codes[0] & codes[1] & codes[2] != Outcode::INSIDE {
        return ClipPolygon::EMPTY;
    }
    let mut polygon = Polygon::new(triangle);
    if codes[0] | codes[1] | codes[2] != Outcode::INSIDE {
        for half_space in volume.half_spaces() {
            polygon = polygon.clipped(half_space, volume);
        }
    }
    polygon.rounded()
}

/// The intermediate polygon.
struct Polygon {
    vertices: [Vertex<3>; CAPACITY],
    count: usize,
}

impl Polygon {
    fn new([a, b, c]: [Vec4; 3]) -> Self {
        let mut polygon = Self { vertices: [Vertex::corner(0, a); CAPACITY], count: 1 };
        polygon.push(Vertex::corner(1, b));
        polygon.push(Vertex::corner(2, c));
        polygon
    }

    fn push(&mut self, vertex: Vertex<3>) {
        self.vertices[self.count] = vertex;
        self.count += 1;
    }

    fn clipped(&self, half_space: HalfSpace, volume: &ClipVolume) -> Self {
        let mut result = Self { vertices: self.vertices, count: 0 };
        for index in 0..self.count {
            let next = if index + 1 < self.count { index + 1 } else { 0 };
            let (start, end) = (&self.vertices[index], &self.vertices[next]);
            let from = half_space.distance(start.position);
            let to = half_space.distance(end.position);
            if from >= 0.0 {
                result.push(*start);
            }
            // A vertex on the boundary is its own cut point.
            if from > 0.0 && to < 0.0 {
                result.push(cut(start, end, half_space, volume));
            } else if from < 0.0 && to > 0.0 {
                result.push(cut(end, start, half_space, volume));
            }
        }
        result
    }

    fn rounded(&self) -> ClipPolygon {
        let mut result = ClipPolygon::EMPTY;
        if self.count >= 3 {
            for (rounded, vertex) in result.vertices.iter_mut().zip(&self.vertices[..self.count]) {
                *rounded = vertex.rounded();
            }
            result.count = self.count;
        }
        result
    }
}
