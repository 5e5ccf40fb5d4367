//! Plots with logarithmic axes.

use super::figures::Row;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::combinators::LogCoord;
use plotters::prelude::*;
use std::error::Error;
use std::io;
use std::path::Path;
use trigon_math::elementary;

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
        let of_case = rows.iter().filter(|row| row.case == case);
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
        let root = SVGBackend::new(path, (760, 480)).into_drawing_area();
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

    /// Whole powers of ten about the positive values; what is 0 goes to the lower end.
    fn range(&self, axis: usize) -> [f64; 2] {
        let values: Vec<f64> = match &self.kind {
            Kind::Trade(points) => points.iter().map(|(_, point)| point[axis]).collect(),
            Kind::Growth(lines) => lines.iter().flat_map(|(_, line)| line).map(|point| point[axis]).collect(),
        };
        let positive = values.iter().copied().filter(|value| *value > 0.0);
        let (low, high) = positive.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        let decade = |value: f64| elementary::pow(10.0, value);
        if !low.is_finite() {
            return [0.1, 10.0];
        }
        [decade(elementary::log10(low / 1.5).floor()), decade(elementary::log10(high * 1.5).ceil())]
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

type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;
type Area<'b> = DrawingArea<SVGBackend<'b>, plotters::coord::Shift>;

fn draw_trade(
    chart: &mut Chart<'_>,
    root: &Area<'_>,
    points: &[(String, [f64; 2])],
    lowest: f64,
) -> Result<(), Box<dyn Error>> {
    let place = |[x, y]: [f64; 2]| (x, if y > 0.0 { y } else { lowest });
    let mut best: Vec<(f64, f64)> =
        points.iter().filter(|(_, point)| is_best(*point, points)).map(|(_, point)| place(*point)).collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart.draw_series(LineSeries::new(best, BLUE.mix(0.4)))?;
    let mut labels: Vec<(i32, i32, String)> = Vec::new();
    for (name, point) in points {
        let color = if is_best(*point, points) { BLUE } else { BLACK };
        chart.draw_series([Circle::new(place(*point), 4, color.filled())])?;
        let zero = if point[1] > 0.0 { "" } else { " (0)" };
        let (x, y) = chart.backend_coord(&place(*point));
        labels.push((x, y, format!("{name}{zero}")));
    }
    labels.sort();
    let mut taken: Vec<(i32, i32, i32)> = Vec::new();
    for (x, y, label) in labels {
        const HEIGHT: i32 = 14;
        /// Within the axes.
        const LABELS: std::ops::Range<i32> = 40..405;
        let width = label.chars().count() as i32 * 7;
        let left = if x + 8 + width > 750 { x - 8 - width } else { x + 8 };
        let is_free = |top: i32| {
            taken.iter().all(|&(l, r, t)| left + width < l || r < left || (t - top).abs() >= HEIGHT)
        };
        let tops = (0..40).flat_map(|step| [y - 7 - step * 4, y - 7 + step * 4]);
        let top = tops.filter(|top| LABELS.contains(top)).find(|&top| is_free(top)).unwrap_or(y - 7);
        taken.push((left, left + width, top));
        root.draw(&Text::new(label, (left, top), ("sans-serif", 13)))?;
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
        chart
            .draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(2)))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], color.stroke_width(2)));
        chart.draw_series(points.into_iter().map(|point| Circle::new(point, 3, color.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}
