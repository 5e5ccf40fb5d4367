//! A convex body as a matrix of planes.

use super::{NotConvex, Scene};
use crate::scene::{Body, Corner};

/// A plane in whole numbers, with the body on its positive side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
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
    pub(super) fn value_at(&self, point: [f64; 3]) -> f64 {
        self.offset as f64 + (0..3).map(|i| self.normal[i] as f64 * point[i]).sum::<f64>()
    }

    /// How the value changes along a direction.
    pub(super) fn change_along(&self, direction: [f64; 3]) -> f64 {
        (0..3).map(|i| self.normal[i] as f64 * direction[i]).sum()
    }

    /// How the value changes towards the eye.
    pub(super) fn change_toward_eye(&self) -> f64 {
        self.normal[2] as f64
    }

    /// Whether the plane's outside is seen: the product of the view vector
    /// (0, 0, -1) with the matrix of the body is positive.
    pub(super) fn faces_eye(&self) -> bool {
        self.normal[2] < 0
    }

    fn reversed(self) -> Self {
        Self { normal: self.normal.map(|part| -part), offset: -self.offset }
    }
}

/// A body that lies on one side of each of its faces.
pub(super) struct ConvexBody {
    /// One for each triangle, in order.
    pub(super) planes: Vec<Plane>,
}

impl ConvexBody {
    /// The matrix of a body; `number` is for the message.
    pub(super) fn new(number: usize, body: &Body) -> Result<Self, NotConvex> {
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
    pub(super) fn hides(&self, point: [f64; 3], tests: &mut u64) -> bool {
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
pub(super) fn convex_bodies(scene: &Scene) -> Result<Vec<ConvexBody>, NotConvex> {
    scene.bodies().iter().enumerate().map(|(number, body)| ConvexBody::new(number, body)).collect()
}
