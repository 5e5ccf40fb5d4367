//! Hidden lines: the parts of edges that bodies hide.
//!
//! The rays from all points of an edge to the eye form a strip with two parameters: t along the edge from 0
//! to 1, and α ≥ 0 towards the eye. The planes of a body cut a convex polygon out of the strip; the edge is
//! hidden between the smallest and the largest t of that polygon.

use super::body::{ConvexBody, convex_bodies};
use super::{NotConvex, Scene};
use crate::{Body, DEPTH_LIMIT};
use std::collections::BTreeMap;

/// A part of an edge, in 1/256 pixel.
pub type Line = [[f64; 3]; 2];

/// The parts of edges that are seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lines {
    /// Each from end to end.
    pub lines: Vec<Line>,
    /// Edges against planes.
    pub tests: u64,
}

/// The lines that Roberts' algorithm shows of a scene's edges.
///
/// # Errors
/// A body that is not convex.
pub fn visible_lines(scene: &Scene) -> Result<Lines, NotConvex> {
    let bodies = convex_bodies(scene)?;
    let mut drawing = Lines::default();
    for (number, (body, planes)) in scene.bodies().iter().zip(&bodies).enumerate() {
        for edge in edges_toward_eye(body, planes) {
            let [from, to] = edge.map(|corner| body.corners[corner].map(f64::from));
            let others = bodies.iter().enumerate().filter(|(other, _)| *other != number);
            let hidden = others.filter_map(|(_, other)| hidden_part([from, to], other, &mut drawing.tests));
            let visible = visible_parts(hidden.collect());
            let point = |t: f64| [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * t);
            drawing.lines.extend(visible.into_iter().map(|part| part.map(point)));
        }
    }
    Ok(drawing)
}

/// The edges of triangles that the body does not hide itself, each once.
fn edges_toward_eye(body: &Body, convex: &ConvexBody) -> Vec<[usize; 2]> {
    let mut edges = BTreeMap::new();
    for (&[a, b, c], plane) in body.triangles.iter().zip(&convex.planes) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *edges.entry([from.min(to), from.max(to)]).or_insert(false) |= plane.faces_eye();
        }
    }
    edges.into_iter().filter(|(_, faces_eye)| *faces_eye).map(|(edge, _)| edge).collect()
}

/// Between which t a body hides an edge.
fn hidden_part([from, to]: Line, body: &ConvexBody, tests: &mut u64) -> Option<[f64; 2]> {
    // The eye lies beyond all bodies.
    let eye = f64::from(DEPTH_LIMIT);
    let mut polygon = vec![[0.0, 0.0], [1.0, 0.0], [1.0, eye], [0.0, eye]];
    let along = [0, 1, 2].map(|i| to[i] - from[i]);
    for plane in &body.planes {
        *tests += 1;
        let (start, by_t, by_alpha) =
            (plane.value_at(from), plane.change_along(along), plane.change_toward_eye());
        polygon = clipped(&polygon, |[t, alpha]| start + by_t * t + by_alpha * alpha);
        if polygon.is_empty() {
            return None;
        }
    }
    let least = polygon.iter().map(|point| point[0]).fold(f64::INFINITY, f64::min);
    let greatest = polygon.iter().map(|point| point[0]).fold(f64::NEG_INFINITY, f64::max);
    (least < greatest).then_some([least, greatest])
}

/// What of a convex polygon lies on the positive side of a line (I. E. Sutherland and G.
/// W. Hodgman, "Reentrant polygon clipping", 1974).
fn clipped(polygon: &[[f64; 2]], value: impl Fn([f64; 2]) -> f64) -> Vec<[f64; 2]> {
    let mut inside = Vec::with_capacity(polygon.len() + 1);
    for (index, &point) in polygon.iter().enumerate() {
        let next = polygon[(index + 1) % polygon.len()];
        let (here, there) = (value(point), value(next));
        if here > 0.0 {
            inside.push(point);
        }
        if (here > 0.0) != (there > 0.0) {
            let share = here / (here - there);
            inside.push([0, 1].map(|i| point[i] + (next[i] - point[i]) * share));
        }
    }
    inside
}

/// What is left of 0 to 1.
fn visible_parts(mut hidden: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    hidden.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut visible = Vec::new();
    let mut reached = 0.0;
    for [from, to] in hidden {
        if from > reached {
            visible.push([reached, from]);
        }
        reached = to.max(reached);
    }
    if reached < 1.0 {
        visible.push([reached, 1.0]);
    }
    visible
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_parts_are_taken_away_once() {
        let parts = visible_parts(vec![[0.5, 0.75], [0.25, 0.6], [0.9, 1.0]]);
        assert_eq!(parts, [[0.0, 0.25], [0.75, 0.9]], "overlapping parts, and one at the end");
        assert_eq!(visible_parts(vec![[0.0, 1.0]]), [[0.0; 2]; 0], "all hidden");
    }
}
