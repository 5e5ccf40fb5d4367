//! Which pixels make a line?

use super::*;
use crate::line::{Line, LineErrors, Outline, OutlineErrors, star};
use trigon_classic::Field;

const WRONG: &str = "strays and gaps, ‰ of steps";
pub(in crate::report) const RMSE: &str = "RMSE of coverage";
pub(in crate::report) const TIME: &str = "ns per pixel of length";
const OUTSIDE: &str = "outline beside the fill, ‰";

pub(in crate::report) const CASE: &str = "a star of lines";
const OUTLINES: &str = "outlines of triangles";

pub(super) fn measure(effort: Effort) -> Chapter {
    let mut rows = of_lines(effort);
    rows.extend(of_outlines());
    Chapter {
        name: "line",
        title: "Which pixels make a line?",
        text: "Lines one pixel wide in all directions (source B). A stray lies more than half a pixel beside the line, a gap is a \
               step along the longer side without a pixel. Coverage is compared with the area that a strip of one pixel's width \
               has in each pixel. Then outlines of filled triangles: how much of them lies beside the fill (source B accepts it).",
        findings: findings(&rows),
        plots: vec![Plot::trade("lines", &rows, CASE, [TIME, RMSE])],
        images: vec![image()],
        rows,
    }
}

fn of_lines(effort: Effort) -> Vec<Row> {
    const SIZE: [usize; 2] = [256; 2];
    const RADIUS: i32 = 120;
    let lines = &star(SIZE[0], RADIUS);
    let times =
        nanoseconds(effort.rounds(), &Line::ALL, |line| -> Box<dyn FnMut()> { line.repeated(lines, SIZE) });
    let row = |(&line, time): (&Line, Spread)| {
        let mut errors = LineErrors::default();
        lines.iter().for_each(|&segment| errors += LineErrors::of(line, segment, SIZE));
        let row = Row::new(CASE, line.name()).sized(SIZE).with(RMSE, errors.rmse());
        let is_sharp = ![Line::Wu, Line::EngineSmooth].contains(&line);
        let row = if is_sharp { row.with(WRONG, errors.wrong_per_mille()) } else { row };
        row.timed(TIME, time.per(lines.len() * RADIUS as usize))
    };
    Line::ALL.iter().zip(times).map(row).collect()
}

fn of_outlines() -> Vec<Row> {
    let row = |outline: Outline| {
        let mut errors = OutlineErrors::default();
        for i in 0..40 {
            let corners = [[20 + i, 10], [230 - 2 * i, 40 + 4 * i], [60 + i, 240 - 3 * i]];
            errors += outline.errors(corners, [256; 2]);
        }
        Row::new(OUTLINES, outline.name()).sized([256; 2]).with(OUTSIDE, errors.per_mille())
    };
    Outline::ALL.map(row).to_vec()
}

/// Lines in three ways, and an outline that leaves its fill.
fn image() -> ImageRow {
    const SIZE: [usize; 2] = [48; 2];
    let lines: Vec<_> = [[46, 3], [45, 20], [30, 46], [4, 44]].map(|end| [[2, 2], end]).to_vec();
    let mut panels = [Line::Naive, Line::Bresenham, Line::EngineSmooth]
        .map(|line| {
            let mut ink = Field::new(SIZE, 0.0);
            line.paint(&lines, &mut ink);
            ink.map(|&ink| grey(f64::from(ink).min(1.0)))
        })
        .to_vec();
    let (fill, outline) = Outline::Source.draw([[4, 4], [44, 17], [15, 43]], SIZE);
    panels.push(Field::from_fn(SIZE, |position| match (fill[position], outline[position]) {
        (false, true) => [230, 50, 40],
        (true, true) => [240, 200, 40],
        (true, false) => [60, 90, 140],
        (false, false) => [0; 3],
    }));
    let caption = "Naive, Bresenham, anti-aliased; an outline (yellow) over its fill as source B draws them: red pixels are beside it";
    ImageRow::new("lines", caption, panels)
}

pub(super) fn headlines() -> Vec<Headline> {
    let of = |lines: [Line; 2]| Headline::within(CASE, lines.map(Line::name), [TIME, RMSE]);
    vec![
        of([Line::Engine, Line::Bresenham])
            .meaning("Both draw the same pixels; the engine also tests depth, sorts and resolves."),
        of([Line::Wu, Line::Bresenham]),
        of([Line::EngineSmooth, Line::Wu]),
    ]
}

pub(super) fn findings(rows: &[Row]) -> Vec<String> {
    let of = |line: Line, quantity: &str| value(rows, CASE, line.name(), quantity);
    let outside = |outline: Outline| number(value(rows, OUTLINES, outline.name(), OUTSIDE));
    vec![
        format!(
            "The naive form misses {} of a thousand steps; DDA and Bresenham draw the same pixels on lines this short. After \
             thousands of additions DDA strays, Bresenham never does.",
            number(of(Line::Naive, WRONG)),
        ),
        format!(
            "Of outlines over filled triangles {} ‰ lie beside the fill in source B's way, {} ‰ with the engine's own lines; if \
             the face paints its edges, {}.",
            outside(Outline::Source),
            outside(Outline::EngineLines),
            outside(Outline::EngineFaces),
        ),
    ]
}
