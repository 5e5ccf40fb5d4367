//! Cuts what reaches beyond the near plane, w > 0, or the guard band; most
//! primitives never come here.
//!
//! The far plane cuts nothing: samples behind it are dropped by their depth.
//! The sides of the view cut nothing: the tiles end there.

mod outcode;

pub(crate) use outcode::{Outcode, W_MIN};

use trigon_math::{DVec4, Vec4};

/// The planes in the order in which they cut.
const PLANES: [Outcode; 6] =
    [Outcode::W, Outcode::NEAR, Outcode::GUARD[0], Outcode::GUARD[1], Outcode::GUARD[2], Outcode::GUARD[3]];

/// A vertex of a cut primitive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutVertex {
    pub(crate) position: Vec4,
    /// The shares of the primitive's corners, in the polygon's order.
    pub(crate) weights: [f32; 3],
}

/// What is left of a triangle.
pub(crate) struct CutPolygon {
    /// Convex, up to rounding; empty if nothing is left.
    pub(crate) vertices: Vec<CutVertex>,
    /// Which corner of the triangle each weight is for.
    pub(crate) order: [u8; 3],
    /// -1 if `order` turns the triangle over, else 1.
    pub(crate) winding: i64,
}

#[derive(Clone, Copy)]
struct Vertex {
    position: DVec4,
    weights: [f64; 3],
}

/// Cuts a triangle by those of the `planes` that some vertex lies beyond.
///
/// The corners are sorted by their coordinates first, so that the result does
/// not depend on how they were given. An edge is cut from its inner to its
/// outer end, plane by plane in a fixed order, so two triangles that share it
/// get the same points, to the bit.
pub(crate) fn cut_triangle(positions: [Vec4; 3], planes: Outcode, guard: [f32; 2]) -> CutPolygon {
    let (order, winding) = sorted(positions);
    let mut polygon: Vec<Vertex> = (0..3).map(|k| corner(positions[usize::from(order[k])], k)).collect();
    for plane in PLANES.into_iter().filter(|&plane| planes.contains(plane)) {
        polygon = cut_by(&polygon, |position| distance(plane, position, guard));
    }
    let vertices = polygon.iter().map(Vertex::rounded).collect();
    CutPolygon { vertices, order, winding }
}

/// Cuts a segment likewise; the third weight is 0. `None` if nothing is left.
pub(crate) fn cut_segment(positions: [Vec4; 2], planes: Outcode, guard: [f32; 2]) -> Option<[CutVertex; 2]> {
    let mut ends = [corner(positions[0], 0), corner(positions[1], 1)];
    for plane in PLANES.into_iter().filter(|&plane| planes.contains(plane)) {
        let distances = ends.map(|end| distance(plane, end.position, guard));
        match distances.map(|d| d >= 0.0) {
            [true, true] => {}
            [true, false] => ends[1] = cut_point((ends[0], distances[0]), (ends[1], distances[1])),
            [false, true] => ends[0] = cut_point((ends[1], distances[1]), (ends[0], distances[0])),
            [false, false] => return None,
        }
    }
    Some(ends.map(|end| end.rounded()))
}

impl Vertex {
    fn rounded(&self) -> CutVertex {
        let weights = self.weights.map(|weight| weight as f32);
        CutVertex { position: self.position.as_vec4(), weights }
    }
}

fn corner(position: Vec4, index: usize) -> Vertex {
    let mut weights = [0.0; 3];
    weights[index] = 1.0;
    Vertex { position: position.as_dvec4(), weights }
}

/// The order of the corners by their coordinates, and whether it is an even
/// permutation (1) or an odd one (-1).
fn sorted(positions: [Vec4; 3]) -> ([u8; 3], i64) {
    let mut order = [0_u8, 1, 2];
    let mut winding = 1;
    let follows = |a: u8, b: u8| {
        let (a, b) = (positions[usize::from(a)].to_array(), positions[usize::from(b)].to_array());
        let differing = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
        differing.is_some_and(std::cmp::Ordering::is_gt)
    };
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if follows(order[i], order[j]) {
            order.swap(i, j);
            winding = -winding;
        }
    }
    (order, winding)
}

/// How far inside a plane a position lies; not negative inside.
fn distance(plane: Outcode, position: DVec4, guard: [f32; 2]) -> f64 {
    let DVec4 { x, y, z, w } = position;
    let (guard_x, guard_y) = (f64::from(guard[0]) * w, f64::from(guard[1]) * w);
    match plane {
        Outcode::W => w - f64::from(W_MIN),
        Outcode::NEAR => w - z,
        plane if plane == Outcode::GUARD[0] => guard_x + x,
        plane if plane == Outcode::GUARD[1] => guard_x - x,
        plane if plane == Outcode::GUARD[2] => guard_y + y,
        _ => guard_y - y,
    }
}

/// The part of a convex polygon where `distance` is not negative (Sutherland
/// and Hodgman, "Reentrant Polygon Clipping", 1974).
fn cut_by(polygon: &[Vertex], distance: impl Fn(DVec4) -> f64) -> Vec<Vertex> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    let measured: Vec<_> = polygon.iter().map(|&vertex| (vertex, distance(vertex.position))).collect();
    for (i, &from) in measured.iter().enumerate() {
        let to = measured[(i + 1) % measured.len()];
        if from.1 >= 0.0 {
            kept.push(from.0);
        }
        match (from.1 >= 0.0, to.1 >= 0.0) {
            (true, false) => kept.push(cut_point(from, to)),
            (false, true) => kept.push(cut_point(to, from)),
            _ => {}
        }
    }
    kept
}

/// Where the edge from an inner to an outer vertex meets the plane.
fn cut_point((inner, inside): (Vertex, f64), (outer, outside): (Vertex, f64)) -> Vertex {
    let share = inside / (inside - outside);
    let along = |from: f64, to: f64| from + (to - from) * share;
    let position = DVec4::from_array(std::array::from_fn(|i| along(inner.position[i], outer.position[i])));
    Vertex { position, weights: std::array::from_fn(|i| along(inner.weights[i], outer.weights[i])) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewport::Viewport;
    use proptest::prelude::*;

    const VIEWPORT: Viewport = Viewport { width: 100, height: 50 };

    fn union(positions: &[Vec4]) -> Outcode {
        let guard = VIEWPORT.guard();
        let codes = positions.iter().map(|&position| Outcode::new(position, guard));
        codes.reduce(Outcode::union).unwrap()
    }

    fn cut(positions: [Vec4; 3]) -> CutPolygon {
        cut_triangle(positions, union(&positions), VIEWPORT.guard())
    }

    fn position() -> impl Strategy<Value = Vec4> {
        let coordinate = prop_oneof![-4.0_f32..4.0, -4e5_f32..4e5];
        (coordinate.clone(), coordinate, -3.0_f32..3.0, -2.0_f32..2.0)
            .prop_map(|(x, y, z, w)| Vec4::new(x, y, z, w))
    }

    proptest! {
        #[test]
        fn what_is_left_lies_inside(positions in [position(), position(), position()]) {
            let polygon = cut(positions);
            prop_assert!(polygon.vertices.len() <= crate::setup::MAX_VERTICES);
            for vertex in polygon.vertices {
                let p = vertex.position.as_dvec4();
                let scale = p.abs().max_element() + 4e5;
                for plane in PLANES {
                    let distance = distance(plane, p, VIEWPORT.guard());
                    prop_assert!(distance >= -1e-5 * scale, "{p} is {distance} outside of {plane:?}");
                }
                let sum: f32 = vertex.weights.iter().sum();
                prop_assert!((sum - 1.0).abs() < 1e-5 && vertex.weights.iter().all(|w| *w >= -1e-6));
            }
        }

        #[test]
        fn the_order_of_the_corners_does_not_matter(positions in [position(), position(), position()]) {
            let points = |positions| {
                let polygon = cut(positions);
                let bits = |v: &CutVertex| v.position.to_array().map(f32::to_bits);
                polygon.vertices.iter().map(bits).collect::<Vec<_>>()
            };
            let [a, b, c] = positions;
            prop_assert_eq!(points([a, b, c]), points([c, a, b]));
            prop_assert_eq!(points([a, b, c]), points([b, a, c]));
        }

        #[test]
        fn a_segment_is_cut_like_an_edge(a in position(), b in position(), c in position()) {
            let planes = union(&[a, b, c]);
            let polygon = cut_triangle([a, b, c], planes, VIEWPORT.guard());
            if let Some(ends) = cut_segment([a, b], planes, VIEWPORT.guard()) {
                for end in ends {
                    let found = polygon.vertices.iter().any(|v| v.position == end.position);
                    prop_assert!(found, "{} is a vertex of the polygon", end.position);
                }
            }
        }
    }
}
