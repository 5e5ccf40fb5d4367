//! One unit for all wheels: lines. A notch of a mouse is one line. Touchpads report pixels, dozens of them,
//! and some systems deliver in one event everything that was scrolled while the window was busy.

use trigon_math::DVec2;

/// Logical pixels that count as a line, as in browsers.
const PIXELS_PER_LINE: f64 = 40.0;

/// The limit of a single event.
const MOST_LINES: f64 = 10.0;

/// The window system's report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum WheelDelta {
    Lines(DVec2),
    /// Physical pixels.
    Pixels(DVec2),
}

/// Lines away from the user, within ±10; 0 for what is not finite. `scale` is
/// physical pixels per logical one.
pub(crate) fn wheel_lines(delta: WheelDelta, scale: f64) -> f64 {
    let lines = match delta {
        WheelDelta::Lines(lines) => lines.y,
        WheelDelta::Pixels(pixels) => pixels.y / (PIXELS_PER_LINE * scale),
    };
    if lines.is_finite() { lines.clamp(-MOST_LINES, MOST_LINES) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_touchpad_is_as_fast_as_a_wheel_at_any_scale() {
        let lines = |y| wheel_lines(WheelDelta::Lines(DVec2::new(0.0, y)), 2.0);
        assert_eq!(lines(1.0), 1.0, "a notch is a line at any scale");
        let pixels = |y, scale| wheel_lines(WheelDelta::Pixels(DVec2::new(3.0, y)), scale);
        assert_eq!(pixels(40.0, 1.0), 1.0, "40 pixels are a line");
        assert_eq!(pixels(80.0, 2.0), 1.0, "and 80 of them at twice the scale");
    }

    #[test]
    fn jumps_and_nonsense_are_held_back() {
        let lines = |y| wheel_lines(WheelDelta::Lines(DVec2::new(0.0, y)), 1.0);
        assert_eq!(lines(4000.0), 10.0, "what piled up elsewhere does not count");
        assert_eq!(lines(-4000.0), -10.0, "in either direction");
        assert_eq!(lines(f64::NAN), 0.0, "not a number turns nothing");
    }
}
