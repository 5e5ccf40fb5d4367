//! Plots with logarithmic axes. Labels lie next to their points, without overlapping each other or any point.

use std::error::Error;
use std::io;
use std::path::Path;

use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use trigon_math::elementary;

use super::chapter::Row;

/// Width and height in pixels.
const SIZE: (i32, i32) = (840, 540);

/// One plot.
pub(super) struct Plot {
    name: &'static str,
    pub(super) title: String,
    axes: [String; 2],
    kind: Kind,
}

enum Kind {
    /// Named points; those with nothing better on both axes are marked.
    Trade(Vec<(String, [f64; 2])>),
    /// Named lines.
    Growth(Vec<(String, Vec<[f64; 2]>)>),
}

impl Plot {
    /// What each variant of a case costs, to the right, and how wrong it is, upwards.
    pub(super) fn trade(name: &'static str, rows: &[Row], case: &str, [time, error]: [&str; 2]) -> Self {
        let of_case = rows.iter().filter(|row| row.case == case && row.is_listed);
        let point = |row: &Row| Some((row.variant.clone(), [row.value(time)?, row.value(error)?]));
        Self {
            name,
            title: format!("Error against time: {case}"),
            axes: [time, error].map(str::to_owned),
            kind: Kind::Trade(of_case.filter_map(point).collect()),
        }
    }

    /// How something grows.
    pub(super) fn growth(
        name: &'static str,
        title: &str,
        axes: [&str; 2],
        lines: Vec<(String, Vec<[f64; 2]>)>,
    ) -> Self {
        Self { name, title: title.to_owned(), axes: axes.map(str::to_owned), kind: Kind::Growth(lines) }
    }

    pub(super) fn file(&self, chapter: &str) -> String {
        format!("accuracy-{chapter}-{}.svg", self.name)
    }

    pub(super) fn write(&self, path: &Path) -> io::Result<()> {
        self.draw(path).map_err(|error| io::Error::other(error.to_string()))
    }

    fn draw(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let root = SVGBackend::new(path, (SIZE.0 as u32, SIZE.1 as u32)).into_drawing_area();
        root.fill(&WHITE)?;
        let [x, y] = [0, 1].map(|axis| self.range(axis));
        let mut chart = ChartBuilder::on(&root)
            .margin(14)
            .caption(&self.title, ("sans-serif", 18))
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d((x[0]..x[1]).log_scale(), (y[0]..y[1]).log_scale())?;
        let mesh = (&self.axes[0], &self.axes[1]);
        chart
            .configure_mesh()
            .x_desc(mesh.0)
            .y_desc(mesh.1)
            .x_label_formatter(&|value| power(*value))
            .y_label_formatter(&|value| power(*value))
            .light_line_style(WHITE)
            .draw()?;
        match &self.kind {
            Kind::Trade(points) => draw_trade(&mut chart, &root, points, y[0])?,
            Kind::Growth(lines) => draw_growth(&mut chart, lines)?,
        }
        Ok(root.present()?)
    }

    /// 1, 2 or 5 times a power of ten about the positive values; what is 0 goes to the lower end.
    /// With lines whole powers of ten, which leave room for the list of their names.
    fn range(&self, axis: usize) -> [f64; 2] {
        let values: Vec<f64> = match &self.kind {
            Kind::Trade(points) => points.iter().map(|(_, point)| point[axis]).collect(),
            Kind::Growth(lines) => lines.iter().flat_map(|(_, line)| line).map(|point| point[axis]).collect(),
        };
        let positive = values.iter().copied().filter(|value| *value > 0.0);
        let (low, high) = positive.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        if !low.is_finite() {
            return [0.1, 10.0];
        }
        let decade = |value: f64| elementary::pow(10.0, elementary::log10(value).floor());
        let [below, above] = [low / 1.3, high * 1.3];
        if matches!(self.kind, Kind::Growth(_)) {
            return [decade(below), 10.0 * decade(above)];
        }
        let first = [5.0, 2.0].map(|step| step * decade(below)).into_iter().find(|step| *step <= below);
        let last = [2.0, 5.0].map(|step| step * decade(above)).into_iter().find(|step| *step >= above);
        [first.unwrap_or(decade(below)), last.unwrap_or(10.0 * decade(above))]
    }
}

/// A number at an axis.
fn power(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        format!("{}", (value * 1e6).round() / 1e6)
    } else {
        format!("{value:.0e}")
    }
}

/// Where labels may be.
const WITHIN_AXES: LabelBox = LabelBox { left: 82, top: 42, right: SIZE.0 - 18, bottom: SIZE.1 - 62 };

type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;
type Area<'b> = DrawingArea<SVGBackend<'b>, plotters::coord::Shift>;

fn draw_trade(
    chart: &mut Chart<'_>,
    root: &Area<'_>,
    points: &[(String, [f64; 2])],
    lowest: f64,
) -> Result<(), Box<dyn Error>> {
    let pixel = |[x, y]: [f64; 2]| (x, if y > 0.0 { y } else { lowest });
    let mut best: Vec<(f64, f64)> =
        points.iter().filter(|(_, point)| is_best(*point, points)).map(|(_, point)| pixel(*point)).collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart.draw_series(LineSeries::new(best, BLUE.mix(0.4)))?;
    let mut labels = Vec::new();
    let mut centres = Vec::new();
    for (name, point) in points {
        let color = if is_best(*point, points) { BLUE } else { BLACK };
        chart.draw_series([Circle::new(pixel(*point), 4, color.filled())])?;
        let zero = if point[1] > 0.0 { "" } else { " (0)" };
        labels.push(format!("{name}{zero}"));
        centres.push(<[i32; 2]>::from(chart.backend_coord(&pixel(*point))));
    }
    draw_labels(root, &labels, &centres)
}

/// Each label beside its point, with a line between them where it had to go farther.
fn draw_labels(root: &Area<'_>, labels: &[String], centres: &[[i32; 2]]) -> Result<(), Box<dyn Error>> {
    const HEIGHT: i32 = 14;
    /// No letter of the font is wider.
    const LETTER: i32 = 7;
    /// From where a line says whose label it is.
    const FAR: i32 = 12;
    let widths: Vec<i32> = labels.iter().map(|label| label.chars().count() as i32 * LETTER).collect();
    let positions = label_boxes(centres, &widths, HEIGHT, WITHIN_AXES);
    for ((label, pixel), &[x, y]) in labels.iter().zip(positions).zip(centres) {
        let [u, v] = pixel.nearest([x, y]);
        if (u - x).pow(2) + (v - y).pow(2) > FAR.pow(2) {
            root.draw(&PathElement::new([(x, y), (u, v)], BLACK.mix(0.4)))?;
        }
        root.draw(&Text::new(label.as_str(), (pixel.left, pixel.top), ("sans-serif", 13)))?;
    }
    Ok(())
}

/// Whether no other point is better on one axis and as good on the other.
fn is_best([x, y]: [f64; 2], points: &[(String, [f64; 2])]) -> bool {
    !points.iter().any(|(_, [u, v])| *u <= x && *v <= y && (*u < x || *v < y))
}

fn draw_growth<'a>(chart: &mut Chart<'a>, lines: &[(String, Vec<[f64; 2]>)]) -> Result<(), Box<dyn Error>> {
    for (index, (name, line)) in lines.iter().enumerate() {
        let color = Palette99::pick(index).to_rgba();
        let points: Vec<(f64, f64)> = line.iter().map(|&[x, y]| (x, y)).collect();
        // A later line in the same place leaves a rim of this one.
        let hidden = lines[index + 1..].iter().filter(|(_, other)| is_near(line, other)).count();
        let width = 2 + 4 * hidden as u32;
        chart
            .draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(width)))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], color.stroke_width(width)));
        chart.draw_series(
            points.into_iter().map(|point| Circle::new(point, 2 + width as i32 / 2, color.filled())),
        )?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}

/// Whether two lines can hardly be told apart.
fn is_near(line: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let is_near = |a: f64, b: f64| (a - b).abs() <= 0.1 * a.abs();
    line.len() == other.len()
        && line.iter().zip(other).all(|(a, b)| (0..2).all(|axis| is_near(a[axis], b[axis])))
}

/// A rectangle in whole pixels: its left, top, right and lower edge, the last two outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LabelBox {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

impl LabelBox {
    fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn contains(&self, other: &Self) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }

    /// The pixel in it that is nearest to a point.
    pub(super) fn nearest(&self, [x, y]: [i32; 2]) -> [i32; 2] {
        [x.clamp(self.left, self.right - 1), y.clamp(self.top, self.bottom - 1)]
    }

    /// The square of the distance to a point.
    fn distance(&self, [x, y]: [i32; 2]) -> i32 {
        let [u, v] = self.nearest([x, y]);
        (u - x).pow(2) + (v - y).pow(2)
    }
}

/// How far a point reaches from its centre, with some air.
const REACH: i32 = 6;

/// How much farther, as a square of pixels, the usual place may be than another one: what
/// most labels keep to is found at a glance.
const ELSEWHERE: i32 = 100;

/// The places of labels of these widths and this height beside their points, in the order of
/// the points: for each, from left to right, the nearest place in `area` that is clear of all
/// points and of the labels before.
///
/// Where there is no such place the label goes to the right of its point.
pub(super) fn label_boxes(points: &[[i32; 2]], widths: &[i32], height: i32, area: LabelBox) -> Vec<LabelBox> {
    let around = |[x, y]: [i32; 2]| LabelBox {
        left: x - REACH,
        top: y - REACH,
        right: x + REACH + 1,
        bottom: y + REACH + 1,
    };
    let obstacles: Vec<LabelBox> = points.iter().map(|&point| around(point)).collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&index| points[index]);
    let mut positions: Vec<Option<LabelBox>> = vec![None; points.len()];
    for index in order {
        let (point, width) = (points[index], widths[index]);
        let label = |left: i32, top: i32| LabelBox { left, top, right: left + width, bottom: top + height };
        let is_free = |label: &LabelBox| {
            area.contains(label)
                && !obstacles.iter().chain(positions.iter().flatten()).any(|other| other.overlaps(label))
        };
        let beside = label(point[0] + REACH + 2, point[1] - height / 2);
        let rows = (area.top..area.bottom).step_by(3);
        let columns = [beside.left, point[0] - REACH - 2 - width, point[0] - width / 2];
        let shifted = (area.left..area.right).step_by(9);
        let best = rows
            .flat_map(|top| columns.into_iter().chain(shifted.clone()).map(move |left| (left, top)))
            .map(|(left, top)| label(left, top))
            .chain([beside])
            .filter(is_free)
            .min_by_key(|label| {
                let elsewhere = if *label == beside { 0 } else { ELSEWHERE };
                (label.distance(point) + elsewhere, label.top, label.left)
            });
        positions[index] = Some(best.unwrap_or(beside));
    }
    positions.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn trade(points: &[[f64; 2]]) -> Plot {
        let row = |(number, [time, error]): (usize, &[f64; 2])| {
            Row::new("case", format!("way {number}")).with("time", *time).with("error", *error)
        };
        let rows: Vec<Row> = points.iter().enumerate().map(row).collect();
        Plot::trade("name", &rows, "case", ["time", "error"])
    }

    #[test]
    fn axes_end_at_1_2_or_5_of_a_decade_with_room_about_the_values() {
        for (values, expected) in [
            ([2.0, 30.0], [1.0, 50.0]),
            ([3.0, 16.0], [2.0, 50.0]),
            ([8.0, 8.0], [5.0, 20.0]),
            ([0.1, 0.2], [0.05, 0.5]),
            ([1.2, 70.0], [0.5, 100.0]),
            ([1.4, 80.0], [1.0, 200.0]),
        ] {
            let range = trade(&values.map(|value| [value, 1.0])).range(0);
            for (found, expected) in range.into_iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 1e-9, "{range:?} about {values:?}");
            }
        }
        let plot = trade(&[[1.0, 0.0], [1.0, 30.0], [1.0, 2.0]]);
        assert!((plot.range(1)[0] - 1.0).abs() < 1e-9, "0 has no logarithm: {:?}", plot.range(1));
        assert_eq!(trade(&[[1.0, 0.0]]).range(1), [0.1, 10.0], "without any value");
    }

    #[test]
    fn lines_have_whole_decades_and_room_for_their_names() {
        let line = |name: &str, points: &[[f64; 2]]| (name.to_owned(), points.to_vec());
        let lines = vec![line("one", &[[2.0, 0.3], [30.0, 40.0]]), line("other", &[[0.5, 3.0]])];
        let plot = Plot::growth("name", "title", ["x", "y"], lines);
        for (axis, expected) in [[0.1, 100.0], [0.1, 100.0]].into_iter().enumerate() {
            for (found, expected) in plot.range(axis).into_iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 1e-9, "{:?} of axis {axis}", plot.range(axis));
            }
        }
        assert_eq!(plot.file("line"), "accuracy-line-name.svg");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plot.svg");
        plot.write(&path).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        for word in ["title", "one", "other"] {
            assert!(text.contains(&format!("\n{word}\n")), "it says {word}");
        }
        assert_eq!(text.matches("<circle").count(), 3, "a circle at each point");
    }

    #[test]
    fn the_best_have_nothing_better_on_both_axes() {
        let named = |point: [f64; 2]| (String::new(), point);
        let points = [[1.0, 9.0], [2.0, 5.0], [2.0, 7.0], [3.0, 5.0], [4.0, 1.0], [4.0, 1.0]].map(named);
        let best = points.each_ref().map(|(_, point)| is_best(*point, &points));
        assert_eq!(best, [true, true, false, false, true, true], "equal ones are both the best");
    }

    #[test]
    fn lines_within_a_tenth_cannot_be_told_apart() {
        let line = [[1.0, 10.0], [2.0, 100.0]];
        assert!(is_near(&line, &[[1.0, 11.0], [2.0, 91.0]]));
        assert!(
            !is_near(&line, &[[1.0, 11.5], [2.0, 100.0]]) && !is_near(&line, &[[1.2, 10.0], [2.0, 100.0]])
        );
        assert!(!is_near(&line, &line[..1]), "not a part of it");
    }

    #[test]
    fn numbers_at_axes_are_short() {
        let written = [0.001, 0.02, 1.0, 20.0, 50000.0, 1e5, 5e-4].map(power);
        assert_eq!(written, ["0.001", "0.02", "1", "20", "50000", "1e5", "5e-4"]);
    }

    const AREA: LabelBox = LabelBox { left: 80, top: 40, right: 750, bottom: 420 };

    proptest! {
        /// Sixteen variants are more than any plot has; they may lie all in one place.
        #[test]
        fn no_label_covers_a_label_or_a_point(
            points in prop::collection::vec([80..750, 40..420], 1..16),
            gathered in any::<bool>(),
            widths in prop::collection::vec(20..170, 16),
        ) {
            let near = |[x, y]: [i32; 2]| if gathered { [400 + x % 20, 200 + y % 20] } else { [x, y] };
            let points: Vec<[i32; 2]> = points.into_iter().map(near).collect();
            let positions = label_boxes(&points, &widths, 14, AREA);
            prop_assert_eq!(positions.len(), points.len());
            for (index, label) in positions.iter().enumerate() {
                prop_assert!(AREA.contains(label), "{:?}", label);
                prop_assert_eq!(label.right - label.left, widths[index]);
                let covers = |[x, y]: [i32; 2]| label.distance([x, y]) == 0;
                prop_assert!(!points.iter().any(|&point| covers(point)), "{:?} covers a point", label);
                let others = positions[..index].iter();
                prop_assert!(!others.clone().any(|other| other.overlaps(label)), "{:?} covers a label", label);
            }
        }
    }

    #[test]
    fn a_label_with_room_is_to_the_right_of_its_point() {
        let positions = label_boxes(&[[300, 200]], &[60], 14, AREA);
        assert_eq!(positions, [LabelBox { left: 308, top: 193, right: 368, bottom: 207 }]);
    }
}
