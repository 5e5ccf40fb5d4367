//! The pictures at the head of the page: log error against log time, every setting a dot. Those that another one beats are grey, the
//! others joined by a line, and those that matter have their names.

use trigon_scene::quality::plot::{
    BLUE, Color, GREY, LegendEntry, LegendMark, ORANGE, Plot, PlotDot, PlotLine, best_of,
};

/// What a setting is to the reader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// One of many.
    Plain,
    /// A preset.
    Preset,
    /// One from which a time budget chooses.
    Candidate,
    /// Another renderer.
    Rival,
}

/// A setting with its time and its error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dot {
    pub(super) name: String,
    pub(super) point: [f64; 2],
    pub(super) mark: Mark,
}

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Panel {
    /// In its file's name.
    pub(super) name: &'static str,
    pub(super) title: String,
    pub(super) axes: [&'static str; 2],
    pub(super) dots: Vec<Dot>,
    /// The error of the right image as bytes.
    pub(super) floor: f64,
}

/// Of other renderers.
const PURPLE: Color = [0xb4, 0x3c, 0xa0];

/// Of the line through the best.
const FAINT_BLUE: Color = [0xa5, 0xbf, 0xe5];

impl Panel {
    /// The file in the folder of images.
    pub(super) fn file(&self) -> String {
        format!("accuracy-frontier-{}.svg", self.name)
    }

    /// The text of the file.
    pub(super) fn svg(&self) -> String {
        let points: Vec<[f64; 2]> = self.dots.iter().map(|dot| dot.point).collect();
        let best = best_of(&points);
        let has_rivals = self.dots.iter().any(|dot| dot.mark == Mark::Rival);
        let line = PlotLine {
            points: best.iter().map(|&index| points[index]).collect(),
            color: FAINT_BLUE,
            width: 1,
            disc: 0,
        };
        let dots = self.dots.iter().enumerate().map(|(index, dot)| dot.drawn(best.contains(&index)));
        let plot = Plot {
            title: self.title.clone(),
            axes: self.axes.map(str::to_owned),
            // One line would join the settings of different renderers.
            lines: if has_rivals { Vec::new() } else { vec![line] },
            levels: vec![(self.floor, "the right image as bytes".to_owned())],
            dots: dots.collect(),
            legend: self.legend(),
            legend_at_right: true,
            ..Plot::default()
        };
        plot.to_svg()
    }

    fn legend(&self) -> Vec<LegendEntry> {
        let all = [
            (Mark::Preset, "presets", LegendMark::Dot(ORANGE)),
            (Mark::Candidate, "what a time budget chooses from", LegendMark::Ring(ORANGE)),
            (Mark::Candidate, "others, beaten by none", LegendMark::Dot(BLUE)),
            (Mark::Candidate, "others, beaten by another one", LegendMark::Dot(GREY)),
            (Mark::Rival, "other renderers", LegendMark::Dot(PURPLE)),
        ];
        let has = |mark: Mark| self.dots.iter().any(|dot| dot.mark == mark);
        let entries = all.into_iter().filter(|(mark, ..)| has(*mark));
        entries.map(|(_, text, mark)| LegendEntry { text: text.to_owned(), mark }).collect()
    }
}

impl Dot {
    fn drawn(&self, is_best: bool) -> PlotDot {
        let color = match self.mark {
            Mark::Rival => PURPLE,
            Mark::Preset => ORANGE,
            Mark::Plain | Mark::Candidate if is_best => BLUE,
            Mark::Plain | Mark::Candidate => GREY,
        };
        let is_named = matches!(self.mark, Mark::Preset | Mark::Rival);
        let label = if is_named { self.name.clone() } else { String::new() };
        PlotDot { label, has_ring: self.mark == Mark::Candidate, ..PlotDot::new(self.point, color) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_is_a_dot_and_some_have_names() {
        let dot = |name: &str, point, mark| Dot { name: name.to_owned(), point, mark };
        let dots = vec![
            dot("one", [1.0, 0.1], Mark::Plain),
            dot("two", [2.0, 0.05], Mark::Preset),
            dot("three", [3.0, 0.06], Mark::Candidate),
            dot("four", [4.0, 0.02], Mark::Rival),
        ];
        let panel =
            Panel { name: "all", title: "title".to_owned(), axes: ["time", "error"], dots, floor: 0.01 };
        let text = panel.svg();
        assert_eq!(panel.file(), "accuracy-frontier-all.svg");
        assert!(text.matches("<circle").count() >= 4, "{text}");
        for (name, is_there) in [("two", true), ("four", true), ("one", false), ("three", false)] {
            assert_eq!(text.contains(&format!(">{name}<")), is_there, "{name}");
        }
    }
}
