//! Plots with logarithmic axes: what each variant of a case costs, and how something grows.

use std::io;
use std::path::Path;

use trigon_scene::quality::plot::{
    BLACK, BLUE, LegendEntry, LegendMark, Plot as LogPlot, PlotDot, PlotLine, SERIES, best_of,
};

use super::chapter::Row;

/// One plot.
pub(super) struct Plot {
    name: &'static str,
    pub(super) title: String,
    plot: LogPlot,
}

impl Plot {
    fn new(name: &'static str, title: String, axes: [&str; 2], plot: LogPlot) -> Self {
        let axes = axes.map(str::to_owned);
        Self { name, title: title.clone(), plot: LogPlot { title, axes, ..plot } }
    }

    /// What each variant of a case costs, to the right, and how wrong it is, upwards. Those with nothing better on both
    /// axes are marked.
    pub(super) fn trade(name: &'static str, rows: &[Row], case: &str, [time, error]: [&str; 2]) -> Self {
        let of_case = rows.iter().filter(|row| row.case == case && row.is_listed);
        let point = |row: &Row| Some((row.variant.clone(), [row.value(time)?, row.value(error)?]));
        let (names, points): (Vec<String>, Vec<[f64; 2]>) = of_case.filter_map(point).unzip();
        let best = best_of(&points);
        let line = best.iter().map(|&index| points[index]).collect();
        let dot = |(index, label): (usize, String)| {
            let color = if best.contains(&index) { BLUE } else { BLACK };
            PlotDot { label, ..PlotDot::new(points[index], color) }
        };
        let plot = LogPlot {
            lines: vec![PlotLine { points: line, color: FAINT_BLUE, width: 1, disc: 0 }],
            dots: names.into_iter().enumerate().map(dot).collect(),
            ..LogPlot::default()
        };
        Self::new(name, format!("Error against time: {case}"), [time, error], plot)
    }

    /// How something grows.
    pub(super) fn growth(
        name: &'static str,
        title: &str,
        axes: [&str; 2],
        lines: Vec<(String, Vec<[f64; 2]>)>,
    ) -> Self {
        let (mut drawn, mut legend) = (Vec::new(), Vec::new());
        for (index, (text, points)) in lines.iter().enumerate() {
            let color = SERIES[index % SERIES.len()];
            // A later line in the same place leaves a rim of this one.
            let hidden = lines[index + 1..].iter().filter(|(_, other)| is_near(points, other)).count();
            let width = 2 + 4 * hidden as u32;
            drawn.push(PlotLine { points: points.clone(), color, width, disc: 2 + width / 2 });
            legend.push(LegendEntry { text: text.clone(), mark: LegendMark::Line(color, width) });
        }
        let plot = LogPlot { by_decades: true, lines: drawn, legend, ..LogPlot::default() };
        Self::new(name, title.to_owned(), axes, plot)
    }

    pub(super) fn file(&self, chapter: &str) -> String {
        format!("accuracy-{chapter}-{}.svg", self.name)
    }

    pub(super) fn write(&self, path: &Path) -> io::Result<()> {
        std::fs::write(path, self.plot.to_svg())
    }
}

/// Of the line through the best.
const FAINT_BLUE: [u8; 3] = [0xa5, 0xbf, 0xe5];

/// Whether two lines can hardly be told apart.
fn is_near(line: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let is_near = |a: f64, b: f64| (a - b).abs() <= 0.1 * a.abs();
    line.len() == other.len()
        && line.iter().zip(other).all(|(a, b)| (0..2).all(|axis| is_near(a[axis], b[axis])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_whole_decades_and_their_names() {
        let line = |name: &str, points: &[[f64; 2]]| (name.to_owned(), points.to_vec());
        let lines = vec![line("one", &[[2.0, 0.3], [30.0, 40.0]]), line("other", &[[0.5, 3.0]])];
        let plot = Plot::growth("name", "title", ["x", "y"], lines);
        assert_eq!(plot.plot.log_axes().map(|axis| axis.ends()), [[0.1, 100.0]; 2]);
        assert_eq!(plot.file("line"), "accuracy-line-name.svg");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plot.svg");
        plot.write(&path).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        for word in ["title", "one", "other"] {
            assert!(text.contains(&format!(">{word}<")), "it says {word}");
        }
        assert_eq!(text.matches("<circle").count(), 3, "a circle at each point");
    }

    #[test]
    fn the_best_of_a_case_are_joined() {
        let row = |name: &str, [time, error]: [f64; 2]| {
            Row::new("case", name).with("time", time).with("error", error)
        };
        let rows = [row("slow", [9.0, 2.0]), row("fine", [5.0, 0.0]), row("fast", [1.0, 7.0])];
        let plot = Plot::trade("name", &rows, "case", ["time", "error"]).plot;
        assert_eq!(plot.lines[0].points, [[1.0, 7.0], [5.0, 0.0]]);
        assert_eq!(plot.dots.iter().map(|dot| dot.color).collect::<Vec<_>>(), [BLACK, BLUE, BLUE]);
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
}
