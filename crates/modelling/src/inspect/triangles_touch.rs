//! Whether two triangles in space have a point in common.
//!
//! Two triangles touch if an edge of one intersects the other. The signs of volumes decide this (T. Möller and B.
//! Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997). Triangles in one plane are compared in that
//! plane.

use trigon_math::{DVec2, DVec3, Orientation, orientation};

type Triangle = [DVec3; 3];

/// Whether two triangles with areas touch or cross.
pub(super) fn triangles_touch(a: Triangle, b: Triangle) -> bool {
    let (from_b, from_a) = (distances(a, b), distances(b, a));
    if is_one_side(from_b) || is_one_side(from_a) {
        return false;
    }
    if from_b == [0.0; 3] || from_a == [0.0; 3] {
        return overlap_in_plane(a, b);
    }
    any_edge_meets(a, from_b, b) || any_edge_meets(b, from_a, a)
}

/// Of each corner of one triangle, the distance from the plane of another, times twice its area.
fn distances(corners: Triangle, plane: Triangle) -> [f64; 3] {
    let [a, b, c] = plane;
    let normal = (b - a).cross(c - a);
    corners.map(|corner| normal.dot(corner - a))
}

fn is_one_side(distances: [f64; 3]) -> bool {
    distances.iter().all(|&distance| distance > 0.0) || distances.iter().all(|&distance| distance < 0.0)
}

/// Whether an edge of a triangle meets another, given the distances of its corners from that.
fn any_edge_meets(edges: Triangle, distances: [f64; 3], other: Triangle) -> bool {
    [(0, 1), (1, 2), (2, 0)].into_iter().any(|(from, to)| {
        let crosses = distances[from].min(distances[to]) <= 0.0 && distances[from].max(distances[to]) >= 0.0;
        let lies_in_plane = distances[from] == 0.0 && distances[to] == 0.0;
        crosses
            && if lies_in_plane {
                segment_meets_in_plane([edges[from], edges[to]], other)
            } else {
                line_meets(edges[from], edges[to], other)
            }
    })
}

/// Whether the line through two points, which crosses the plane of a triangle, meets it: all edges
/// pass on the same side.
fn line_meets(from: DVec3, to: DVec3, triangle: Triangle) -> bool {
    let [a, b, c] = triangle.map(|corner| corner - from);
    let along = to - from;
    let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|side| along.dot(side));
    sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
}

/// Drops the coordinate along which a triangle is seen largest.
fn flat(viewed: Triangle) -> impl Fn(DVec3) -> DVec2 {
    let [a, b, c] = viewed;
    let axis = (b - a).cross(c - a).abs().max_position();
    move |point| match axis {
        0 => DVec2::new(point.y, point.z),
        1 => DVec2::new(point.z, point.x),
        _ => DVec2::new(point.x, point.y),
    }
}

fn overlap_in_plane(a: Triangle, b: Triangle) -> bool {
    let edges = [[a[0], a[1]], [a[1], a[2]], [a[2], a[0]]];
    let flatten = flat(b);
    edges.into_iter().any(|edge| segment_meets_in_plane(edge, b)) || contains(a.map(&flatten), flatten(b[0]))
}

/// Whether a segment in the plane of a triangle meets it.
fn segment_meets_in_plane(segment: [DVec3; 2], triangle: Triangle) -> bool {
    let flatten = flat(triangle);
    let [from, to] = segment.map(&flatten);
    let [a, b, c] = triangle.map(&flatten);
    contains([a, b, c], from)
        || [[a, b], [b, c], [c, a]].into_iter().any(|edge| segments_meet([from, to], edge))
}

fn contains([a, b, c]: [DVec2; 3], point: DVec2) -> bool {
    let turns = [orientation(a, b, point), orientation(b, c, point), orientation(c, a, point)];
    !turns.contains(&Orientation::Clockwise) || !turns.contains(&Orientation::CounterClockwise)
}

fn segments_meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let (from_c, from_d) = (orientation(a, b, c), orientation(a, b, d));
    let (from_a, from_b) = (orientation(c, d, a), orientation(c, d, b));
    let crosses = |one: Orientation, two| one != two || one == Orientation::Collinear;
    // On one line all turns are collinear, and their boxes tell; otherwise these tell no more.
    let boxes_overlap = a.min(b).cmple(c.max(d)).all() && c.min(d).cmple(a.max(b)).all();
    boxes_overlap && crosses(from_c, from_d) && crosses(from_a, from_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn touches(other: [[f64; 3]; 3]) -> bool {
        let other = other.map(DVec3::from_array);
        let all = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0], [1, 0, 2], [0, 2, 1]];
        let results: Vec<bool> = all
            .iter()
            .flat_map(|order| {
                let turned = order.map(|corner| other[corner]);
                [triangles_touch(FLOOR, turned), triangles_touch(turned, FLOOR)]
            })
            .collect();
        assert!(results.iter().all(|&result| result == results[0]), "in any order: {results:?}");
        results[0]
    }

    #[test]
    fn triangles_cross_touch_or_miss() {
        assert!(touches([[0.2, 0.2, -1.0], [0.3, 0.2, 1.0], [0.2, 0.3, 1.0]]), "through the middle");
        assert!(touches([[0.2, 0.2, 0.0], [0.3, 0.2, 1.0], [0.2, 0.3, 1.0]]), "a tip on it");
        assert!(touches([[0.5, 0.5, -1.0], [0.5, 0.5, 1.0], [2.0, 2.0, 0.0]]), "at an edge");
        assert!(!touches([[0.6, 0.6, -1.0], [0.6, 0.6, 1.0], [2.0, 2.0, 0.0]]), "past an edge");
        assert!(!touches([[0.2, 0.2, 1e-9], [0.3, 0.2, 1.0], [0.2, 0.3, 1.0]]), "just above");
        assert!(!touches([[2.0, 2.0, -1.0], [3.0, 2.0, 1.0], [2.0, 3.0, 1.0]]), "beside");
    }

    #[test]
    fn triangles_in_one_plane_overlap_or_not() {
        assert!(touches([[0.1, 0.1, 0.0], [0.2, 0.1, 0.0], [0.1, 0.2, 0.0]]), "inside");
        assert!(touches([[-5.0, -5.0, 0.0], [9.0, -5.0, 0.0], [-5.0, 9.0, 0.0]]), "around");
        assert!(touches([[0.4, 0.4, 0.0], [2.0, 2.0, 0.0], [0.0, 3.0, 0.0]]), "across");
        assert!(touches([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]), "at a tip");
        assert!(touches([[0.2, 0.0, 0.0], [0.4, 0.0, 0.0], [0.3, -1.0, 0.0]]), "along an edge");
        assert!(!touches([[0.6, 0.6, 0.0], [2.0, 0.6, 0.0], [0.6, 2.0, 0.0]]), "beside");
        assert!(!touches([[1.5, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]), "on the same line");
        assert!(touches([[0.2, 0.2, 0.0], [0.4, 0.2, 0.0], [0.3, 0.2, 1.0]]), "upright on it");
    }
}
