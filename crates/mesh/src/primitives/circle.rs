//! Points on the unit circle.

use std::f64::consts::FRAC_PI_2;

use trigon_math::{DVec2, DVec3, Vec2, elementary};

/// The point after `part` of `parts` of a full turn, counter-clockwise from
/// (1, 0). Quarter turns are exact, so that round objects touch their bounds.
pub(super) fn turned(part: u32, parts: u32) -> DVec2 {
    let quarters = 4 * u64::from(part);
    let parts = u64::from(parts);
    let angle = (quarters % parts) as f64 / parts as f64 * FRAC_PI_2;
    let (sin, cos) = elementary::sin_cos(angle);
    match (quarters / parts) % 4 {
        0 => DVec2::new(cos, sin),
        1 => DVec2::new(-sin, cos),
        2 => DVec2::new(-cos, -sin),
        _ => DVec2::new(sin, -cos),
    }
}

/// A point of the plane that is seen from above (x right, y away) as a point
/// in space, where +Y is up and away is −Z.
pub(super) fn on_ground(point: DVec2) -> DVec3 {
    DVec3::new(point.x, 0.0, -point.y)
}

/// Where a point of the unit circle (y up) is in an image (v down) that the
/// circle just fits in.
pub(super) fn in_image(point: DVec2) -> Vec2 {
    DVec2::new(0.5 + 0.5 * point.x, 0.5 - 0.5 * point.y).as_vec2()
}

/// The corners of a regular polygon in an image, counter-clockwise, its first
/// one at the top.
pub(super) fn regular_polygon<const N: usize>() -> [Vec2; N] {
    std::array::from_fn(|i| in_image(turned(i as u32, N as u32).perp()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_on_the_circle_and_quarters_are_exact() {
        for parts in 3..100 {
            for part in 0..parts {
                let length = turned(part, parts).length();
                assert!((length - 1.0).abs() < 1e-15, "{part} of {parts}: {length}");
            }
        }
        let quarters = [0, 1, 2, 3].map(|part| turned(part, 4));
        assert_eq!(quarters, [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y], "quarter turns");
    }
}
