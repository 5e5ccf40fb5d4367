//! The area of a pixel on one side of a line, in closed form.

use trigon_math::DVec2;

/// The fraction of a pixel, from 0 to 1, on the inner side of a line: `normal` points there and has length 1,
/// and the pixel's centre lies `distance` pixels inside.
///
/// The fraction as a function of the distance is the integral of the convolution of two boxes, as wide as the
/// components of the normal: a parabola, a straight line and a parabola. It is rounded in `f64`, by at most
/// 2⁻⁵⁰.
#[must_use]
pub fn share(normal: DVec2, distance: f64) -> f64 {
    let DVec2 { x, y } = normal.abs();
    let (long, short) = if x > y { (x, y) } else { (y, x) };
    let (reach, straight) = ((long + short) / 2.0, (long - short) / 2.0);
    let to_corner = reach - distance.abs();
    let outer = if to_corner <= 0.0 {
        0.0
    } else if distance.abs() <= straight {
        0.5 - distance.abs() / long
    } else {
        to_corner * to_corner / (2.0 * long * short)
    };
    if distance < 0.0 { outer } else { 1.0 - outer }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::{STEPS, area};
    use num_traits::ToPrimitive;

    /// Large triangles with one edge across the pixel.
    #[test]
    fn the_closed_form_is_the_area() {
        for [dx, dy] in [[7000, 100], [7000, 6999], [3, 7000], [-2000, 7000], [5000, -5000]] {
            for offset in (-260..260).step_by(13) {
                let from = [-dx + 128 + offset, -dy + 128];
                let to = [dx + 128 + offset, dy + 128];
                let beyond = [to[0] - 3 * dy, to[1] + 3 * dx];
                let before = [from[0] - 3 * dy, from[1] + 3 * dx];
                let halves = [[from, to, beyond], [from, beyond, before]];
                let exact: f64 =
                    halves.map(|half| area::in_pixel(half, [0, 0]).to_f64().unwrap()).iter().sum();
                let normal = DVec2::new(-f64::from(dy), f64::from(dx)).normalize();
                let inside = normal.dot(DVec2::new(-f64::from(offset), 0.0)) / f64::from(STEPS);
                let found = share(normal, inside);
                assert!((found - exact).abs() < 1e-13, "{dx}, {dy}, {offset}: {found} instead of {exact}");
            }
        }
    }
}
