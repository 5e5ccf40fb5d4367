//! Lines of any width between points anywhere: beyond two opposite sides of the guard band, one side, or none.

use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::{BlendMode, Lines, Pass, Smoothing};

use super::huge::far_corner;
use crate::coverage_support::{SIDE, Values, draw, pixel};
use crate::effort::cases;

/// What the corners of a line's outline may be off by: see `huge::TOLERANCE`, and a snap more for the outline itself.
const OFF: f64 = 1.0 / 70.0;

/// What the shape says of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    Inside,
    Outside,
    /// Within what rounding moves the outline by.
    Undecided,
}

impl Side {
    /// Of a distance from the outline, positive inside.
    fn of(depth: f64, off: f64) -> Self {
        if depth > off {
            Self::Inside
        } else if depth < -off {
            Self::Outside
        } else {
            Self::Undecided
        }
    }

    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Outside, _) | (_, Self::Outside) => Self::Outside,
            (Self::Inside, Self::Inside) => Self::Inside,
            _ => Self::Undecided,
        }
    }
}

/// A line between two places in pixels.
#[derive(Debug)]
pub(crate) struct Line {
    ends: [[f64; 2]; 2],
    width: f64,
}

impl Line {
    pub(crate) fn new(ends: [Vec4; 2], width: f32) -> Self {
        let half = f64::from(SIDE) / 2.0;
        let place = |end: Vec4| {
            let [x, y, _, w] = end.to_array().map(f64::from);
            [(1.0 + x / w) * half, (1.0 - y / w) * half]
        };
        // Wider than 4096 pixels is none, nor thinner than one.
        let width = if width.is_nan() { 1.0 } else { f64::from(width.clamp(1.0, 4096.0)) };
        Self { ends: ends.map(place), width }
    }

    /// Holds the pixels of an image of [`SIDE`] that show a sharp line to its shape.
    pub(crate) fn check(&self, shown: &[bool]) {
        // Of a line that is shorter than snapping moves its ends there is no direction.
        if self.length() <= 0.1 {
            return;
        }
        for (index, &shown) in shown.iter().enumerate() {
            let expected = self.sharp(centre(index));
            let is_right = expected == Side::Undecided || shown == (expected == Side::Inside);
            assert!(is_right, "{self:?} at {:?}: {shown}, {expected:?}", pixel(index));
        }
    }

    fn span(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.ends[1][axis] - self.ends[0][axis])
    }

    fn length(&self) -> f64 {
        let [x, y] = self.span();
        (x * x + y * y).sqrt()
    }

    /// How far a point's place along the line and across it may be off. What turns a short line by a hair moves what is
    /// far from it by more; a line that is cut is as long as from the image to the guard band.
    fn off(&self, point: [f64; 2]) -> f64 {
        let from_end = |end: [f64; 2]| (end[0] - point[0]).abs().max((end[1] - point[1]).abs());
        let reach = from_end(self.ends[0]).min(from_end(self.ends[1])).min(30_000.0) + self.width;
        OFF * (1.0 + 2.0 * reach / self.length().min(30_000.0))
    }

    /// The distance from the line through both ends.
    fn distance(&self, point: [f64; 2]) -> f64 {
        let ([x, y], from) = (self.span(), self.ends[0]);
        (x * (point[1] - from[1]) - y * (point[0] - from[0])).abs() / self.length()
    }

    /// Whether a sharp line covers a point, if it is cut at its ends along the other axis than this.
    fn covers(&self, point: [f64; 2], major: usize) -> Side {
        let (off, span) = (self.off(point), self.span());
        // A line of one pixel has that across the other axis, wider ones across themselves.
        let is_single = self.width == 1.0;
        let across = if is_single {
            self.distance(point) * self.length() / span[major].abs()
        } else {
            self.distance(point)
        };
        let [low, high] =
            [self.ends[0][major].min(self.ends[1][major]), self.ends[0][major].max(self.ends[1][major])];
        let along = (point[major] - low + self.width / 2.0).min(high + self.width / 2.0 - point[major]);
        Side::of(self.width / 2.0 - across, off).and(Side::of(along, off))
    }

    fn sharp(&self, point: [f64; 2]) -> Side {
        let [x, y] = self.span().map(f64::abs);
        let [horizontal, vertical] = [0, 1].map(|major| self.covers(point, major));
        if (x - y).abs() <= 4.0 * OFF + 1e-6 * x {
            // Which axis is the longer one depends on rounding.
            if horizontal == vertical { horizontal } else { Side::Undecided }
        } else if x > y {
            horizontal
        } else {
            vertical
        }
    }

    /// The coverage of an anti-aliased line of `width`, by the distance from the segment.
    fn smooth(&self, point: [f64; 2], width: f64) -> f64 {
        let ([x, y], from) = (self.span(), self.ends[0]);
        let share = ((point[0] - from[0]) * x + (point[1] - from[1]) * y) / (x * x + y * y);
        let distance = if (0.0..=1.0).contains(&share) {
            self.distance(point)
        } else {
            let end = self.ends[usize::from(share > 1.0)];
            ((end[0] - point[0]) * (end[0] - point[0]) + (end[1] - point[1]) * (end[1] - point[1])).sqrt()
        };
        (width / 2.0 + 0.5 - distance).min(width).clamp(0.0, 1.0)
    }
}

fn width() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => 1.0_f32..40.0, 2 => 40.0_f32..4096.0, 1 => Just(1.0), 1 => Just(4096.0),
        1 => any::<u32>().prop_map(f32::from_bits)
    ]
}

/// Two ends: anywhere, or so that the line between them passes near the image and both are as far away as they like.
fn ends() -> impl Strategy<Value = [Vec4; 2]> {
    let through = ([-1.5_f32..1.5, -1.5_f32..1.5], [-1.0_f32..1.0, -1.0_f32..1.0]);
    let far = || prop_oneof![0.1_f32..3.0, 900.0_f32..1100.0, 1e3_f32..1e7];
    let opposite = (through, [far(), far()], [0.25_f32..8.0, 0.25_f32..8.0]).prop_map(
        |(([x, y], [dx, dy]), [before, after], [v, w])| {
            let end = |by: f32, w: f32| Vec4::new((x + dx * by) * w, (y + dy * by) * w, 0.125, w);
            [end(-before, v), end(after, w)]
        },
    );
    prop_oneof![3 => opposite, 1 => [far_corner(), far_corner()]]
}

fn centre(index: usize) -> [f64; 2] {
    pixel(index).map(|at| f64::from(at) + 0.5)
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn lines_of_any_width_cover_their_outline_however_far_their_ends_are(ends in ends(), width in width()) {
        let pipeline = Values::ones(ends);
        for segment in [[0, 1], [1, 0]] {
            let mut pass = Pass::new();
            let segments = [segment];
            pass.lines(Lines { width, blend_mode: BlendMode::Translucent, ..Lines::new(&pipeline, &segments) });
            let linear = draw(&pass).linear.expect("asked for");
            Line::new(ends, width).check(&linear.iter().map(|color| color.x == 1.0).collect::<Vec<_>>());
        }
    }

    #[test]
    fn anti_aliased_lines_cover_by_their_distance_however_far_their_ends_are(ends in ends(), width in width()) {
        let line = Line::new(ends, width);
        prop_assume!(line.length() > 0.1);
        let width = if width.is_nan() { 1.0 } else { width.clamp(0.0, 4096.0) };
        let pipeline = Values::ones(ends);
        let mut pass = Pass::new();
        pass.lines(Lines { width, smoothing: Smoothing::AntiAliased, ..Lines::new(&pipeline, &[[0, 1]]) });
        for (index, color) in draw(&pass).linear.expect("asked for").iter().enumerate() {
            let expected = line.smooth(centre(index), f64::from(width));
            let error = (f64::from(color.x) - expected).abs();
            prop_assert!(error <= line.off(centre(index)), "{} instead of {expected} at {:?}", color.x, pixel(index));
        }
    }
}
