//! The distance of drawn lines from the ideal one, and whether the outline of a triangle matches its fill
//! (source row B3).

use std::ops::AddAssign;

use trigon_classic::Field;
use trigon_math::{DVec2, Vec2};

use super::{Line, Segment, algorithms};
use crate::engine::{Corners, Engine};
use crate::fill::{Fill, FillCanvas};
use crate::oracle::half_plane;

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
    let position = from[along] + (to[along] - from[along]).signum() * step;
    (middle - 2..=middle + 2)
        .map(move |across| (if along == 0 { [position, across] } else { [across, position] }, across))
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

/// A method of filling a triangle and drawing its outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outline {
    /// As the source does: scanlines, and lines along the longer side.
    Source,
    /// The renderer's triangle, and the renderer's lines on it.
    EngineLines,
    /// The renderer's triangle, which paints its own edges.
    EngineFaces,
}

/// Counts the pixels of outlines that lie outside their triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OutlineErrors {
    /// Pixels of outlines.
    pub outline: usize,
    /// Pixels of outlines that the fill does not cover.
    pub outside: usize,
}

impl OutlineErrors {
    /// Pixels beside the fill for a thousand of the outline.
    #[must_use]
    pub fn per_mille(&self) -> f64 {
        1e3 * self.outside as f64 / self.outline as f64
    }
}

impl AddAssign for OutlineErrors {
    fn add_assign(&mut self, other: Self) {
        self.outline += other.outline;
        self.outside += other.outside;
    }
}

impl Outline {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Source, Self::EngineLines, Self::EngineFaces];

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Source => "scanlines and DDA",
            Self::EngineLines => "engine, lines over faces",
            Self::EngineFaces => "engine, faces with edges",
        }
    }

    /// Draws a triangle between the centres of pixels with its outline, and compares.
    #[must_use]
    pub fn errors(self, corners: [[i32; 2]; 3], size: [usize; 2]) -> OutlineErrors {
        let (fill, outline) = self.draw(corners, size);
        let pixels = || outline.pixels().filter(|(_, is_outline)| **is_outline);
        OutlineErrors {
            outline: pixels().count(),
            outside: pixels().filter(|(position, _)| !fill[*position]).count(),
        }
    }

    /// The pixels of the fill and of the outline.
    #[must_use]
    pub fn draw(self, corners: [[i32; 2]; 3], size: [usize; 2]) -> (Field<bool>, Field<bool>) {
        let triangle = corners.map(|[x, y]| Vec2::new(x as f32 + 0.5, y as f32 + 0.5));
        let sides = [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]);
        let filled = |fill: Fill| {
            let mut canvas = FillCanvas::new(size);
            fill.paint(&[triangle], &mut canvas);
            canvas.pixels().map(|pixel| pixel.count > 0)
        };
        match self {
            Self::Source => (filled(Fill::Scanlines), walked(&sides, size)),
            Self::EngineLines => {
                let mut ink = Field::new(size, 0.0);
                Line::Engine.paint(&sides, &mut ink);
                (filled(Fill::Engine), ink.map(|&ink| ink > 0.0))
            }
            Self::EngineFaces => {
                let visible = Engine::default().edges(&Corners::flat(&[triangle], size), size);
                (visible.map(|color| color.x > 0.0), visible.map(|color| color.y > 0.0))
            }
        }
    }
}

fn walked(sides: &[Segment], size: [usize; 2]) -> Field<bool> {
    let mut outline = Field::new(size, false);
    for pixel in sides.iter().flat_map(|&side| algorithms::pixels(side)) {
        if let Some(is_outline) = outline.get_mut(pixel) {
            *is_outline = true;
        }
    }
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [40, 40];

    /// The errors of ink that is given for each pixel.
    fn errors(segment: Segment, ink: impl Fn([usize; 2]) -> f32) -> LineErrors {
        let (coverage, mut errors) = (Field::from_fn(SIZE, ink), LineErrors::default());
        let [from, to] = segment;
        let along = usize::from((to[0] - from[0]).abs() < (to[1] - from[1]).abs());
        let steps = (to[along] - from[along]).abs();
        for step in 0..=steps {
            errors.look_at_step(segment, along, step, &coverage);
            errors.compare_areas(segment, along, step, &coverage);
        }
        errors
    }

    /// Lines in all directions.
    const SEGMENTS: [Segment; 6] = [
        [[5, 6], [30, 6]],
        [[5, 6], [30, 20]],
        [[30, 20], [5, 6]],
        [[8, 4], [12, 33]],
        [[33, 8], [30, 36]],
        [[7, 30], [30, 7]],
    ];

    /// How far a pixel lies beside a line, in pixels across its length.
    fn beside([from, to]: Segment, [x, y]: [usize; 2]) -> f64 {
        let [dx, dy] = [0, 1].map(|axis| f64::from(to[axis] - from[axis]));
        let (x, y) = (x as f64 - f64::from(from[0]), y as f64 - f64::from(from[1]));
        (x * dy - y * dx).abs() / dx.abs().max(dy.abs())
    }

    #[test]
    fn a_line_without_ink_has_gaps_only() {
        for segment in SEGMENTS {
            let LineErrors { steps, strays, gaps, .. } = errors(segment, |_| 0.0);
            let [from, to] = segment;
            let length = (to[0] - from[0]).abs().max((to[1] - from[1]).abs());
            assert_eq!((steps, strays, gaps), (length as usize + 1, 0, length as usize + 1), "{segment:?}");
        }
    }

    #[test]
    fn ink_within_half_a_pixel_is_right_and_all_other_strays() {
        for segment in SEGMENTS {
            let LineErrors { strays, gaps, .. } =
                errors(segment, |pixel| f32::from(u8::from(beside(segment, pixel) <= 0.5)));
            assert_eq!((strays, gaps), (0, 0), "{segment:?}");
            // Five pixels are looked at in each step; one or two of them are the line's.
            let LineErrors { steps, strays, gaps, pixels, .. } = errors(segment, |_| 1.0);
            assert_eq!((gaps, pixels), (0, 5 * steps), "{segment:?}");
            assert!((3 * steps..=4 * steps).contains(&strays), "{segment:?}: {strays} of {steps}");
            let faint = errors(segment, |_| 0.4);
            assert_eq!((faint.strays, faint.gaps), (0, steps), "{segment:?}: faint ink is none");
        }
    }

    #[test]
    fn level_lines_cover_their_pixels_and_diagonal_ones_parts() {
        let level = SEGMENTS[0];
        let right = errors(level, |[_, y]| if y == 6 { 1.0 } else { 0.0 });
        assert!(right.squares < 1e-12 && right.rmse() < 1e-6, "{right:?}");
        let half = errors(level, |[_, y]| if y == 6 { 0.5 } else { 0.0 });
        // A fifth of the pixels is off by a half.
        assert!((half.rmse() - 0.05_f64.sqrt()).abs() < 1e-6, "{}", half.rmse());
        // A strip one wide along the diagonal covers all but two corners of its pixels, each a right-angled
        // triangle whose height is (√2 - 1) / 2.
        let height = (2.0_f64.sqrt() - 1.0) / 2.0;
        let corner = height * height;
        let off = errors(SEGMENTS[5], |[x, y]| if x + y == 37 { 1.0 - 2.0 * corner as f32 } else { 0.0 });
        let beside = errors(SEGMENTS[5], |_| 0.0);
        let steps = off.steps as f64;
        // What is left is beside those pixels.
        assert!(off.squares < beside.squares, "{off:?} {beside:?}");
        let share = 1.0 - 2.0 * corner;
        let inked = share * share * steps;
        assert!((beside.squares - off.squares - inked).abs() < 1e-3 * steps, "{off:?} {beside:?}");
    }

    #[test]
    fn errors_add_up_and_are_told_per_step() {
        let one = LineErrors { steps: 10, strays: 2, gaps: 3, squares: 0.5, pixels: 7 };
        let other = LineErrors { steps: 30, strays: 4, gaps: 1, squares: 1.5, pixels: 1 };
        let mut sum = one;
        sum += other;
        assert_eq!(sum, LineErrors { steps: 40, strays: 6, gaps: 4, squares: 2.0, pixels: 8 });
        assert_eq!((sum.wrong_per_mille(), sum.rmse()), (250.0, 0.5));
    }
}
