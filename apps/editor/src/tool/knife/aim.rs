//! Where a pointer aims that is held to angles in the image, or to an axis.

use trigon_document::mesh::math::DVec2;

/// To which angles segments are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum AngleSnap {
    /// To none.
    #[default]
    Free,
    /// To steps of 30° from the horizontal of the image.
    Screen,
    /// To steps of 30° from the segment before, or from the horizontal where there is none.
    Previous,
}

impl AngleSnap {
    /// The next one, as the key A goes through them.
    pub(super) fn next(self) -> Self {
        match self {
            Self::Free => Self::Screen,
            Self::Screen => Self::Previous,
            Self::Previous => Self::Free,
        }
    }

    /// For the status line.
    pub(super) fn status(self) -> &'static str {
        match self {
            Self::Free => "",
            Self::Screen => " at 30° steps of the image",
            Self::Previous => " at 30° steps of the last line",
        }
    }
}

/// Lines at 0°, 30°, … 150°, of unit length: √3/2 is rounded.
const LINES: [DVec2; 6] = {
    const HALF: f64 = 0.5;
    const ROOT: f64 = 0.866_025_403_784_438_6;
    [
        DVec2::new(1.0, 0.0),
        DVec2::new(ROOT, HALF),
        DVec2::new(HALF, ROOT),
        DVec2::new(0.0, 1.0),
        DVec2::new(-HALF, ROOT),
        DVec2::new(-ROOT, HALF),
    ]
};

/// The point nearest to the pointer on the lines through the last point whose angles with a direction are multiples of
/// 30°; of equally near ones on the line of the smallest angle. The pointer itself if the direction has no length.
pub(super) fn at_angle_steps(last: DVec2, direction: DVec2, pointer: DVec2) -> DVec2 {
    let Some(base) = direction.try_normalize() else { return pointer };
    let lines = LINES.map(|line| base.rotate(line));
    let reach = |line: &DVec2| line.dot(pointer - last).abs();
    let best = lines.into_iter().reduce(|best, line| if reach(&line) > reach(&best) { line } else { best });
    best.map_or(pointer, |line| along(last, line, pointer))
}

/// The point nearest to the pointer on the line through the last point in a direction. The pointer itself if that has no
/// length.
pub(super) fn along(last: DVec2, direction: DVec2, pointer: DVec2) -> DVec2 {
    direction.try_normalize().map_or(pointer, |line| last + line * line.dot(pointer - last))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_pointer_is_held_to_the_nearest_of_twelve_ways() {
        let last = DVec2::new(100.0, 50.0);
        let near = |pointer: [f64; 2]| at_angle_steps(last, DVec2::X, last + DVec2::from(pointer)) - last;
        assert_eq!(near([40.0, 3.0]), DVec2::new(40.0, 0.0), "level");
        assert_eq!(near([-40.0, 3.0]), DVec2::new(-40.0, 0.0), "backwards");
        assert_eq!(near([-1.0, -20.0]), DVec2::new(0.0, -20.0), "upright");
        let at_60 = near([10.0, 18.0]);
        // tan 60° = √3.
        assert!((at_60.y / at_60.x - 3.0_f64.sqrt()).abs() < 1e-12, "{at_60}");
        assert_eq!(at_angle_steps(last, DVec2::ZERO, DVec2::ONE), DVec2::ONE, "no direction holds nothing");
        assert_eq!(near([0.0, 0.0]), DVec2::ZERO, "on the last point");
    }

    #[test]
    fn a_segment_at_a_right_angle_to_the_last_one_stays_there() {
        let last = DVec2::new(3.0, 4.0);
        let direction = DVec2::new(3.0, 4.0);
        let held = at_angle_steps(last, direction, last + DVec2::new(-8.0, 6.2)) - last;
        assert!(held.dot(direction).abs() < 1e-12 && held.x < 0.0, "{held}");
    }

    proptest! {
        /// The angle is a multiple of 30°, and the pointer is moved by at most the sine of 15° of its distance.
        #[test]
        fn angles_are_steps_and_no_step_is_nearer(
            last in prop::array::uniform2(-500.0f64..500.0),
            direction in prop::array::uniform2(-1.0f64..1.0),
            pointer in prop::array::uniform2(-500.0f64..500.0),
        ) {
            let [last, direction, pointer] = [last, direction, pointer].map(DVec2::from);
            prop_assume!(direction.length() > 0.01 && pointer.distance(last) > 1.0);
            let held = at_angle_steps(last, direction, pointer);
            prop_assume!(held.distance(last) > 1e-6);
            let angle = direction.angle_to(held - last).to_degrees();
            let steps = angle / 30.0;
            prop_assert!((steps - steps.round()).abs() < 1e-6, "{angle}");
            let sine = (6.0_f64.sqrt() - 2.0_f64.sqrt()) / 4.0;
            prop_assert!(held.distance(pointer) <= pointer.distance(last) * sine * (1.0 + 1e-9));
        }

        #[test]
        fn a_pointer_along_a_line_is_on_it_and_nearest(
            direction in prop::array::uniform2(-1.0f64..1.0), pointer in prop::array::uniform2(-500.0f64..500.0)
        ) {
            let [direction, pointer] = [direction, pointer].map(DVec2::from);
            prop_assume!(direction.length() > 0.01);
            let held = along(DVec2::ONE, direction, pointer) - DVec2::ONE;
            prop_assert!(held.perp_dot(direction).abs() < 1e-9);
            prop_assert!((pointer - DVec2::ONE - held).dot(direction).abs() < 1e-9);
        }
    }
}
