//! The distance of drawn lines from the ideal one.

use super::{Line, Segment};
use crate::field::Field;
use crate::oracle::half_plane;
use std::ops::AddAssign;
use trigon_math::DVec2;

/// The errors of lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineErrors {
    /// Steps along the longer sides.
    pub steps: usize,
    /// Pixels with ink whose centre lies more than half a pixel beside the line.
    pub strays: usize,
    /// Steps without ink where it should be.
    pub gaps: usize,
    /// The sum of squared differences between a pixel's ink and the area that a strip one pixel wide covers
    /// of it.
    pub squares: f64,
    /// The number of pixels in that sum: those up to two pixels beside the line.
    pub pixels: usize,
}

impl LineErrors {
    /// The errors of one segment, drawn in an image that contains it. Its ends are excluded from the
    /// comparison of areas, because there is more than one way to end a line.
    #[must_use]
    pub fn of(line: Line, segment: Segment, size: [usize; 2]) -> Self {
        let mut coverage = Field::new(size, 0.0);
        line.paint(&[segment], &mut coverage);
        let mut errors = Self::default();
        let [from, to] = segment;
        let distance = [0, 1].map(|axis| (to[axis] - from[axis]).abs());
        let along = usize::from(distance[0] < distance[1]);
        let steps = distance[along];
        for step in 0..=steps {
            errors.look_at_step(segment, along, step, &coverage);
            if step > 1 && step < steps - 1 {
                errors.compare_areas(segment, along, step, &coverage);
            }
        }
        errors
    }

    /// The root of the mean square, as a share of a pixel's ink.
    #[must_use]
    pub fn rmse(&self) -> f64 {
        (self.squares / self.pixels as f64).sqrt()
    }

    /// Strays and gaps for a thousand steps.
    #[must_use]
    pub fn wrong_per_mille(&self) -> f64 {
        1e3 * (self.strays + self.gaps) as f64 / self.steps as f64
    }

    fn look_at_step(&mut self, [from, to]: Segment, along: usize, step: i32, coverage: &Field<f32>) {
        let (length, rise) = ((to[along] - from[along]).abs(), to[1 - along] - from[1 - along]);
        let mut is_inked = false;
        for (pixel, across) in column([from, to], along, step, length) {
            // Twice the distance across, times the length: exact.
            let beside = 2 * ((across - from[1 - along]) * length - rise * step).abs();
            let ink = coverage.get(pixel).is_some_and(|&ink| ink > 0.5);
            is_inked |= ink && beside <= length;
            self.strays += usize::from(ink && beside > length);
        }
        self.steps += 1;
        self.gaps += usize::from(!is_inked);
    }

    fn compare_areas(&mut self, [from, to]: Segment, along: usize, step: i32, coverage: &Field<f32>) {
        let vector = |[x, y]: [i32; 2]| DVec2::new(x.into(), y.into());
        let normal = (vector(to) - vector(from)).normalize().perp();
        for (pixel, _) in column([from, to], along, step, (to[along] - from[along]).abs()) {
            let distance = normal.dot(vector(pixel) - vector(from));
            let exact = half_plane::share(normal, distance + 0.5) - half_plane::share(normal, distance - 0.5);
            let ink = f64::from(coverage.get(pixel).copied().unwrap_or(0.0));
            self.squares += (ink - exact) * (ink - exact);
            self.pixels += 1;
        }
    }
}

/// The pixels of a step, up to two beside the line, with their distance across.
fn column(
    [from, to]: Segment,
    along: usize,
    step: i32,
    length: i32,
) -> impl Iterator<Item = ([i32; 2], i32)> {
    let rise = to[1 - along] - from[1 - along];
    let middle = from[1 - along] + (f64::from(rise * step) / f64::from(length)).round() as i32;
    let place = from[along] + (to[along] - from[along]).signum() * step;
    (middle - 2..=middle + 2)
        .map(move |across| (if along == 0 { [place, across] } else { [across, place] }, across))
}

impl AddAssign for LineErrors {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.strays += other.strays;
        self.gaps += other.gaps;
        self.squares += other.squares;
        self.pixels += other.pixels;
    }
}
