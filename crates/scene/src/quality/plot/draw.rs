//! Where everything of a plot lies, and how it is drawn.

use super::labels::{LabelBox, LabelLayout};
use super::svg::{Anchor, Letters, PixelPoint, Stroke, Svg};
use super::{BLACK, Color, GREY, LegendEntry, LegendMark, LogAxis, Plot};

/// Width and height in pixels.
const SIZE: [i32; 2] = [840, 540];

/// Of lines at ticks.
const GRID: Color = [0xe4, 0xe4, 0xe4];

/// Few letters of labels are wider, in pixels; but for signs such as ×.
const LETTER: i32 = 7;
const SIGN: i32 = 10;

/// The height of a line of small letters.
const LINE: i32 = 16;

/// More notes leave no space for the plot.
const MOST_NOTES: usize = 8;

/// The radius of dots.
const DOT: f64 = 4.0;

/// A plot, its axes and where they are.
struct PlotLayout<'a> {
    plot: &'a Plot,
    axes: [LogAxis; 2],
    /// Between the axes.
    area: LabelBox,
}

pub(super) fn svg(plot: &Plot) -> String {
    let top = 42 + LINE * plot.notes.len().min(MOST_NOTES) as i32;
    let area = LabelBox { left: 78, top, right: SIZE[0] - 18, bottom: SIZE[1] - 56 };
    let layout = PlotLayout { plot, axes: plot.log_axes(), area };
    let mut svg = Svg::new(SIZE, &plot.title);
    layout.draw_texts(&mut svg);
    layout.draw_grid(&mut svg);
    let mut obstacles = layout.draw_levels(&mut svg);
    obstacles.extend(layout.legend_box());
    obstacles.extend(layout.mark_boxes());
    layout.draw_lines(&mut svg);
    layout.draw_dots(&mut svg);
    layout.draw_labels(&mut svg, &obstacles);
    layout.draw_legend(&mut svg);
    svg.finish()
}

fn letters(size: u32, anchor: Anchor) -> Letters {
    Letters { size, color: BLACK, anchor, goes_up: false }
}

/// A width that holds a text in small letters, if an image can.
fn width_of(text: &str) -> i32 {
    let letters = text.chars().take(SIZE[0] as usize);
    letters.map(|letter| if letter.is_ascii() { LETTER } else { SIGN }).sum()
}

impl PlotLayout<'_> {
    fn pixel(&self, at: [f64; 2]) -> PixelPoint {
        let LabelBox { left, top, right, bottom } = self.area;
        let [x, y] = [0, 1].map(|axis| self.axes[axis].position(at[axis]));
        [f64::from(left) + x * f64::from(right - left), f64::from(bottom) - y * f64::from(bottom - top)]
    }

    fn draw_texts(&self, svg: &mut Svg) {
        let LabelBox { left, top, right, bottom } = self.area;
        let [middle, center] = [(left + right) / 2, (top + bottom) / 2].map(f64::from);
        let width = f64::from(SIZE[0]);
        svg.text([0.5 * width, 26.0], letters(16, Anchor::Middle), &self.plot.title);
        for (note, line) in self.plot.notes.iter().take(MOST_NOTES).zip(1..) {
            svg.text([0.5 * width, f64::from(26 + LINE * line)], letters(11, Anchor::Middle), note);
        }
        let [along, up] = &self.plot.axes;
        svg.text([middle, f64::from(SIZE[1] - 14)], letters(12, Anchor::Middle), along);
        svg.text([20.0, center], Letters { goes_up: true, ..letters(12, Anchor::Middle) }, up);
    }

    fn draw_grid(&self, svg: &mut Svg) {
        let [[low, _], [_, high]] = self.axes.map(|axis| axis.ends());
        let [bottom, top] = [f64::from(self.area.bottom), f64::from(self.area.top)];
        let [left, right] = [f64::from(self.area.left), f64::from(self.area.right)];
        for tick in self.axes[0].ticks() {
            let [x, _] = self.pixel([tick.value, high]);
            if let Some(label) = &tick.label {
                svg.lines(&[[x, bottom], [x, top]], Stroke::new(GRID, 1.0));
                svg.text([x, bottom + 18.0], letters(11, Anchor::Middle), label);
            }
            svg.lines(&[[x, bottom], [x, bottom + 4.0]], Stroke::new(GREY, 1.0));
        }
        for tick in self.axes[1].ticks() {
            let [_, y] = self.pixel([low, tick.value]);
            if let Some(label) = &tick.label {
                svg.lines(&[[left, y], [right, y]], Stroke::new(GRID, 1.0));
                svg.text([left - 8.0, y + 4.0], letters(11, Anchor::End), label);
            }
            svg.lines(&[[left - 4.0, y], [left, y]], Stroke::new(GREY, 1.0));
        }
        svg.lines(&[[left, top], [left, bottom], [right, bottom]], Stroke::new(BLACK, 1.0));
    }

    /// Returns where their names are.
    fn draw_levels(&self, svg: &mut Svg) -> Vec<LabelBox> {
        let mut boxes = Vec::new();
        for (value, name) in &self.plot.levels {
            let [_, y] = self.pixel([0.0, *value]);
            let [left, right] = [self.area.left, self.area.right].map(f64::from);
            svg.lines(&[[left, y], [right, y]], Stroke { is_dashed: true, ..Stroke::new(BLACK, 1.0) });
            svg.text([left + 6.0, y - 5.0], letters(11, Anchor::Start), name);
            let [left, foot] = [self.area.left, y as i32];
            boxes.push(LabelBox {
                left,
                top: foot - LINE,
                right: left + 6 + width_of(name),
                bottom: foot + 2,
            });
        }
        boxes
    }

    fn draw_lines(&self, svg: &mut Svg) {
        for line in &self.plot.lines {
            let points: Vec<PixelPoint> = line.points.iter().map(|&point| self.pixel(point)).collect();
            svg.lines(&points, Stroke::new(line.color, f64::from(line.width)));
            for &point in points.iter().filter(|_| line.disc > 0) {
                svg.circle(point, f64::from(line.disc), [line.color; 2]);
            }
        }
    }

    fn draw_dots(&self, svg: &mut Svg) {
        for dot in &self.plot.dots {
            if let Some(spread) = dot.spread {
                let ends = spread.map(|time| self.pixel([time, dot.at[1]]));
                svg.lines(&ends, Stroke::new(dot.color, 1.0));
            }
        }
        for dot in &self.plot.dots {
            let center = self.pixel(dot.at);
            let fill = if dot.is_filled { dot.color } else { [0xff; 3] };
            svg.circle(center, DOT, [fill, dot.color]);
            if dot.has_ring {
                svg.ring(center, DOT + 4.0, super::ORANGE);
            }
        }
    }

    /// Each label beside its dot, with a line between them where it had to go farther.
    fn draw_labels(&self, svg: &mut Svg, obstacles: &[LabelBox]) {
        /// From where a line says whose label it is.
        const FAR: i32 = 12;
        let pixel = |at: [f64; 2]| self.pixel(at).map(|value| value.round() as i32);
        let (named, others): (Vec<_>, Vec<_>) = self.plot.dots.iter().partition(|dot| !dot.label.is_empty());
        let label = |zero: bool, label: &str| format!("{label}{}", if zero { " (0)" } else { "" });
        let labels: Vec<String> = named.iter().map(|dot| label(dot.at[1] == 0.0, &dot.label)).collect();
        let widths: Vec<i32> = labels.iter().map(|label| width_of(label)).collect();
        let centers: Vec<[i32; 2]> = named.iter().map(|dot| pixel(dot.at)).collect();
        let others: Vec<[i32; 2]> = others.iter().map(|dot| pixel(dot.at)).collect();
        let LabelBox { left, top, right, bottom } = self.area;
        let area = LabelBox { left: left + 4, top, right, bottom: bottom - 4 };
        let layout = LabelLayout { others: &others, obstacles, height: 14, area };
        let boxes = layout.boxes(&centers, &widths);
        for ((label, pixel), center) in labels.iter().zip(boxes).zip(centers) {
            if pixel.square_distance(center) > FAR.pow(2) {
                let ends = [center, pixel.nearest(center)].map(|end| end.map(f64::from));
                svg.lines(&ends, Stroke::new(GREY, 1.0));
            }
            let foot = [pixel.left, pixel.top + 11].map(f64::from);
            svg.text(foot, letters(11, Anchor::Start), label);
        }
    }

    /// What is drawn around dots: spreads and rings.
    fn mark_boxes(&self) -> impl Iterator<Item = LabelBox> {
        const RING: i32 = DOT as i32 + 6;
        self.plot.dots.iter().flat_map(|dot| {
            let [x, y] = self.pixel(dot.at).map(|value| value.round() as i32);
            let ring = dot.has_ring.then_some(LabelBox {
                left: x - RING,
                top: y - RING,
                right: x + RING,
                bottom: y + RING,
            });
            let spread = dot.spread.map(|spread| {
                let [left, right] = spread.map(|value| self.pixel([value, dot.at[1]])[0].round() as i32);
                LabelBox { left, top: y - 1, right: right + 1, bottom: y + 2 }
            });
            ring.into_iter().chain(spread)
        })
    }

    fn legend_box(&self) -> Option<LabelBox> {
        let legend = &self.plot.legend;
        let widest = legend.iter().map(|entry| width_of(&entry.text)).max()?;
        let [width, height] =
            [(widest + 44).min(self.area.right - self.area.left), LINE * legend.len() as i32 + 10];
        let left = if self.plot.legend_at_right { self.area.right - width - 6 } else { self.area.left + 8 };
        let top = self.area.top + 6;
        Some(LabelBox { left, top, right: left + width, bottom: top + height })
    }

    fn draw_legend(&self, svg: &mut Svg) {
        let Some(LabelBox { left, top, right, bottom }) = self.legend_box() else { return };
        let corner = [left, top].map(f64::from);
        svg.panel(corner, [right - left, bottom - top].map(f64::from));
        for (LegendEntry { text, mark }, line) in self.plot.legend.iter().zip(0..) {
            let y = corner[1] + f64::from(5 + LINE * line + LINE / 2);
            let middle = [corner[0] + 18.0, y];
            match *mark {
                LegendMark::Dot(color) => svg.circle(middle, DOT, [color; 2]),
                LegendMark::Circle(color) => svg.circle(middle, DOT, [[0xff; 3], color]),
                LegendMark::Ring(color) => svg.ring(middle, DOT + 3.0, color),
                LegendMark::Line(color, width) => {
                    let ends = [[middle[0] - 10.0, y], [middle[0] + 10.0, y]];
                    svg.lines(&ends, Stroke::new(color, f64::from(width)));
                }
            }
            svg.text([corner[0] + 36.0, y + 4.0], letters(11, Anchor::Start), text);
        }
    }
}
