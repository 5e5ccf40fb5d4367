//! Regions of the image as a user draws them.

use trigon_window::scene::math::DVec2;

use super::lens::Answer;

/// Coordinates of some thousand pixels, rounded some times.
const ROUNDING: f64 = 1e-9;

/// In physical pixels.
#[derive(Debug)]
pub(super) enum Shape {
    Box([DVec2; 2]),
    Circle(DVec2, f64),
    /// By the even-odd rule.
    Lasso(Vec<DVec2>),
}

impl Shape {
    /// Whether a point lies in it.
    pub(super) fn contains(&self, point: DVec2) -> Answer {
        match self {
            Self::Box([min, max]) => Answer::of((point - *min).min(*max - point).min_element(), ROUNDING),
            Self::Circle(center, radius) => Answer::of(radius - point.distance(*center), ROUNDING),
            Self::Lasso(corners) => {
                let sides = || (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]);
                let beside = |[from, to]: [DVec2; 2]| {
                    let share = (point - from).dot(to - from) / (to - from).length_squared();
                    point.distance(from.lerp(to, share.clamp(0.0, 1.0)))
                };
                if sides().map(beside).fold(f64::INFINITY, f64::min) < ROUNDING {
                    return Answer::Open;
                }
                let is_right = |[from, to]: &[DVec2; 2]| {
                    let crosses = (from.y > point.y) != (to.y > point.y);
                    crosses && from.x + (point.y - from.y) / (to.y - from.y) * (to.x - from.x) > point.x
                };
                if sides().filter(is_right).count() % 2 == 1 { Answer::Yes } else { Answer::No }
            }
        }
    }
}
