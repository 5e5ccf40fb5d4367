//! Roberts' algorithm (L. G. Roberts, "Machine perception of three-dimensional solids", MIT Lincoln
//! Laboratory TR 315, 1963) as in source D (row D5). A body is a matrix of planes with its inside on their
//! positive side. Planes that face away are hidden by the body itself. The remaining faces are compared with
//! every other body: a point is hidden if the ray from it to the eye passes through one.
//!
//! The work grows with the square of the number of bodies: no boxes and no depth order reduce the
//! comparisons.

use std::collections::BTreeMap;

use super::scene::{Body, Corner, STEPS_PER_PIXEL};
use super::{DEPTH_LIMIT, Drawing, NotConvex, Scene, Surface};

/// The faces that are seen: the points of faces that no other body hides.
pub(super) fn draw(scene: &Scene) -> Result<Drawing, NotConvex> {
    let bodies = convex_bodies(scene)?;
    let mut drawing = Drawing::empty(scene.size());
    let faces_toward_eye = bodies.iter().flat_map(|body| body.planes.iter().map(|plane| plane.faces_eye()));
    for ((number, face), _) in scene.faces().zip(faces_toward_eye).filter(|(_, faces_eye)| *faces_eye) {
        let Some(surface) = Surface::new(face) else { continue };
        surface.each_pixel(scene.limits(), |pixel, depth| {
            let [x, y] = pixel.map(|part| f64::from(part * STEPS_PER_PIXEL + STEPS_PER_PIXEL / 2));
            let point = [x, y, depth];
            let others = bodies.iter().enumerate().filter(|(other, _)| *other != face.body);
            let mut hiding = others.filter(|(_, body)| body.hides(point, &mut drawing.tests));
            if hiding.next().is_none() {
                drawing.faces[pixel.map(|part| part as usize)] = number;
            }
        });
    }
    Ok(drawing)
}

/// A plane in whole numbers, with the body on its positive side.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: [i64; 3],
    offset: i64,
}

impl Plane {
    /// Through three corners. Exact: corners are below 2¹⁸, so a normal is below 2³⁸ and
    /// the value at a corner below 2⁵⁸.
    fn through([a, b, c]: [Corner; 3]) -> Self {
        let [u, v] = [b, c].map(|corner| [0, 1, 2].map(|i| i64::from(corner[i]) - i64::from(a[i])));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let plane = Self { normal, offset: 0 };
        Self { offset: -plane.value(a), ..plane }
    }

    /// Positive on the side of the body.
    fn value(&self, corner: Corner) -> i64 {
        self.offset + (0..3).map(|i| self.normal[i] * i64::from(corner[i])).sum::<i64>()
    }

    /// The same for any point, rounded.
    fn value_at(&self, point: [f64; 3]) -> f64 {
        self.offset as f64 + (0..3).map(|i| self.normal[i] as f64 * point[i]).sum::<f64>()
    }

    /// How the value changes along a direction.
    fn change_along(&self, direction: [f64; 3]) -> f64 {
        (0..3).map(|i| self.normal[i] as f64 * direction[i]).sum()
    }

    /// How the value changes towards the eye.
    fn change_toward_eye(&self) -> f64 {
        self.normal[2] as f64
    }

    /// Whether the plane's outside is seen: the product of the view vector
    /// (0, 0, -1) with the matrix of the body is positive.
    fn faces_eye(&self) -> bool {
        self.normal[2] < 0
    }

    fn reversed(self) -> Self {
        Self { normal: self.normal.map(|part| -part), offset: -self.offset }
    }
}

/// A body that lies on one side of each of its faces.
struct ConvexBody {
    /// One for each triangle, in order.
    planes: Vec<Plane>,
}

impl ConvexBody {
    /// The matrix of a body; `number` is for the message.
    fn new(number: usize, body: &Body) -> Result<Self, NotConvex> {
        let plane = |(triangle, corners): (usize, &[usize; 3])| {
            let plane = Plane::through(corners.map(|corner| body.corners[corner]));
            // A point inside: the middle of all corners, times their number.
            let inside: i128 = body.corners.iter().map(|&corner| i128::from(plane.value(corner))).sum();
            let plane = if inside < 0 { plane.reversed() } else { plane };
            match body.corners.iter().position(|&corner| plane.value(corner) < 0) {
                Some(corner) => Err(NotConvex { body: number, triangle, corner }),
                None => Ok(plane),
            }
        };
        let planes = body.triangles.iter().enumerate().map(plane).collect::<Result<_, _>>()?;
        Ok(Self { planes })
    }

    /// Whether the ray from a point to the eye passes through the body; counts the
    /// planes that were asked.
    fn hides(&self, point: [f64; 3], tests: &mut u64) -> bool {
        let (mut from, mut to) = (0.0_f64, f64::INFINITY);
        for plane in &self.planes {
            *tests += 1;
            let (value, change) = (plane.value_at(point), plane.change_toward_eye());
            if change == 0.0 && value <= 0.0 {
                return false;
            }
            let border = -value / change;
            if change > 0.0 {
                from = from.max(border);
            } else if change < 0.0 {
                to = to.min(border);
            }
            if from >= to {
                return false;
            }
        }
        true
    }
}

/// The bodies of a scene as matrices of planes.
fn convex_bodies(scene: &Scene) -> Result<Vec<ConvexBody>, NotConvex> {
    scene.bodies().iter().enumerate().map(|(number, body)| ConvexBody::new(number, body)).collect()
}

/// Hidden lines: the parts of edges that bodies hide.
///
/// The rays from all points of an edge to the eye form a strip with two parameters: t along the edge from 0
/// to 1, and α ≥ 0 towards the eye. The planes of a body cut a convex polygon out of the strip; the edge is
/// hidden between the smallest and the largest t of that polygon.
///
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
