//! Plots with two logarithmic axes, such as error against time, as SVG. Labels lie next to their points, without
//! overlapping each other or any point. They are white with dark letters, and so can be read on any page.
//!
//! ```
//! use trigon_scene::quality::plot::{BLUE, Plot, PlotDot};
//!
//! let dot = |name: &str, at| PlotDot { label: name.to_owned(), ..PlotDot::new(at, BLUE) };
//! let plot = Plot {
//!     title: "Error against time".to_owned(),
//!     axes: ["ms".to_owned(), "RMSE".to_owned()],
//!     dots: vec![dot("draft", [1.2, 0.02]), dot("high", [9.0, 0.001])],
//!     ..Plot::default()
//! };
//! let svg = plot.to_svg();
//! assert!(svg.starts_with("<svg") && svg.contains(">draft</text>"));
//! ```

mod axis;
mod draw;
mod labels;
mod svg;

pub use axis::{AxisTick, LogAxis};

/// Red, green and blue of sRGB.
pub type Color = [u8; 3];

/// Of what is best.
pub const BLUE: Color = [0x1f, 0x5f, 0xbf];
/// Of what something else beats.
pub const GREY: Color = [0x9a, 0x9a, 0x9a];
/// Of what is neither.
pub const BLACK: Color = [0x22, 0x22, 0x22];
/// Of what was chosen.
pub const ORANGE: Color = [0xd9, 0x6a, 0x00];
/// Of several lines, in this order.
pub const SERIES: [Color; 8] = [
    [0xd6, 0x27, 0x28],
    [0x2c, 0x8f, 0x2c],
    [0xc7, 0x9a, 0x00],
    [0x1f, 0x5f, 0xbf],
    [0xe5, 0x7a, 0x1a],
    [0x8a, 0x2b, 0xa8],
    [0x12, 0xa0, 0xb0],
    [0xd0, 0x3f, 0xb0],
];

/// A plot with two logarithmic axes. Its default is an empty one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// Lines of smaller letters below the title.
    pub notes: Vec<String>,
    /// What lies to the right, and upwards, with their units.
    pub axes: [String; 2],
    /// Whether the axes end at powers of ten, which leaves space for a legend.
    pub by_decades: bool,
    /// Below the dots.
    pub lines: Vec<PlotLine>,
    /// Values of the upright axis that are lines from left to right, with a name.
    pub levels: Vec<(f64, String)>,
    /// The dots.
    pub dots: Vec<PlotDot>,
    /// What the colours mean, if that has to be said.
    pub legend: Vec<LegendEntry>,
    /// Whether the legend is in the upper right corner, rather than the left one.
    pub legend_at_right: bool,
}

/// A line through points.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotLine {
    /// The points. A value that is not greater than 0 lies at the lower end of its axis.
    pub points: Vec<[f64; 2]>,
    /// The colour.
    pub color: Color,
    /// In pixels.
    pub width: u32,
    /// The radius of the discs at its points, in pixels; 0 for none.
    pub disc: u32,
}

/// A point, with what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotDot {
    /// Where it is, as for [`PlotLine::points`].
    pub at: [f64; 2],
    /// Beside it; empty for none.
    pub label: String,
    /// The colour.
    pub color: Color,
    /// Whether it is a disc rather than a circle.
    pub is_filled: bool,
    /// Whether there is another circle around it.
    pub has_ring: bool,
    /// From where to where its value to the right may lie.
    pub spread: Option<[f64; 2]>,
}

/// What a colour means.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    /// What it says.
    pub text: String,
    /// How it is drawn.
    pub mark: LegendMark,
}

/// How something is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LegendMark {
    /// As dots of this colour.
    Dot(Color),
    /// As circles of this colour.
    Circle(Color),
    /// As circles of this colour around dots.
    Ring(Color),
    /// As a line of this colour and this width in pixels.
    Line(Color, u32),
}

impl PlotDot {
    /// A disc without a label.
    #[must_use]
    pub fn new(at: [f64; 2], color: Color) -> Self {
        Self { at, label: String::new(), color, is_filled: true, has_ring: false, spread: None }
    }
}

impl Plot {
    /// The axis to the right, and the upright one.
    #[must_use]
    pub fn log_axes(&self) -> [LogAxis; 2] {
        [0, 1].map(|axis| {
            let lines = self.lines.iter().flat_map(|line| &line.points).map(|point| point[axis]);
            let dots = self.dots.iter().map(|dot| dot.at[axis]);
            let levels = self.levels.iter().map(|(value, _)| *value).filter(|_| axis == 1);
            let values = lines.chain(dots).chain(levels);
            if self.by_decades { LogAxis::around_by_decades(values) } else { LogAxis::around(values) }
        })
    }

    /// The plot as the text of an SVG file.
    #[must_use]
    pub fn to_svg(&self) -> String {
        draw::svg(self)
    }
}

/// The indices of the points that no other beats, by rising `x`: none is as small in both values, and smaller in one. Of
/// equal points all are among them. Points with a value that is no number are left out.
///
/// ```
/// use trigon_scene::quality::plot::best_of;
///
/// assert_eq!(best_of(&[[2.0, 7.0], [2.0, 5.0], [1.0, 9.0], [3.0, 5.0]]), [2, 1]);
/// ```
#[must_use]
pub fn best_of(points: &[[f64; 2]]) -> Vec<usize> {
    let is_number = |index: &usize| points[*index].iter().all(|value| !value.is_nan());
    let mut order: Vec<usize> = (0..points.len()).filter(is_number).collect();
    // −0 is 0 here, as for `<`.
    let by = |a: f64, b: f64| a.partial_cmp(&b).expect("both are numbers");
    order.sort_by(|&a, &b| by(points[a][0], points[b][0]).then(by(points[a][1], points[b][1])));
    let mut best: Vec<usize> = Vec::new();
    for index in order {
        let is_best = best
            .last()
            .is_none_or(|&last| points[index][1] < points[last][1] || points[index] == points[last]);
        if is_best {
            best.push(index);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_best_have_nothing_better_on_both_axes() {
        let points = [[1.0, 9.0], [2.0, 5.0], [2.0, 7.0], [3.0, 5.0], [4.0, 1.0], [4.0, 1.0]];
        assert_eq!(best_of(&points), [0, 1, 4, 5], "equal ones are both the best");
        assert_eq!(best_of(&[[f64::NAN, 0.0], [1.0, f64::INFINITY]]), [1], "without what is no number");
    }

    /// Few different numbers, so that equal ones are frequent.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![4 => (0_u8..6).prop_map(f64::from), 1 => any::<f64>(), 1 => Just(-0.0)]
    }

    proptest! {
        #[test]
        fn the_best_are_those_of_all_pairs(points in prop::collection::vec([number(), number()], 0..20)) {
            let beats = |[u, v]: [f64; 2], [x, y]: [f64; 2]| u <= x && v <= y && (u < x || v < y);
            let best = best_of(&points);
            for (index, &point) in points.iter().enumerate() {
                let is_number = !point[0].is_nan() && !point[1].is_nan();
                let is_best = is_number && !points.iter().any(|&other| beats(other, point));
                prop_assert_eq!(best.contains(&index), is_best, "{:?} of {:?}", point, points);
            }
            prop_assert!(best.is_sorted_by(|&a, &b| points[a][0] <= points[b][0]));
        }

    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        /// Any numbers and texts give a file with balanced elements, and each dot and label in it.
        #[test]
        fn files_are_well_formed(
            points in prop::collection::vec([number(), number()], 0..12),
            name in any::<String>(),
            by_decades in any::<bool>(),
        ) {
            let dot = |&at: &[f64; 2]| PlotDot {
                label: name.clone(),
                spread: Some([0.5 * at[0], f64::INFINITY]),
                has_ring: at[0] > 2.0,
                ..PlotDot::new(at, GREY)
            };
            let plot = Plot {
                title: name.clone(),
                notes: vec![name.clone()],
                axes: [name.clone(), name.clone()],
                by_decades,
                lines: vec![PlotLine { points: points.clone(), color: BLUE, width: 1, disc: 2 }],
                levels: points.iter().map(|point| (point[1], name.clone())).take(2).collect(),
                dots: points.iter().map(dot).collect(),
                legend: vec![LegendEntry { text: name.clone(), mark: LegendMark::Line(BLUE, 2) }],
                legend_at_right: by_decades,
            };
            let svg = plot.to_svg();
            prop_assert!(check_well_formed(&svg).is_ok(), "{:?}: {svg}", check_well_formed(&svg));
            prop_assert!(svg.matches("<circle").count() >= 2 * points.len(), "discs and dots");
            prop_assert!(!svg.contains("NaN") || name.contains("NaN"), "{svg}");
            prop_assert!(!svg.contains("\"inf") && !svg.contains(",inf"), "{svg}");
        }
    }

    /// Whether elements are closed in order, and attributes and texts have no stray characters.
    fn check_well_formed(text: &str) -> Result<(), String> {
        let (mut open, mut rest) = (Vec::new(), text);
        while let Some(start) = rest.find('<') {
            let between = &rest[..start];
            if between.contains('>') || (open.is_empty() && !between.trim().is_empty()) {
                return Err(format!("stray text {between:?}"));
            }
            let (tag, after) = rest[start + 1..].split_once('>').ok_or("an element has no end")?;
            match (tag.strip_prefix('/'), tag.strip_suffix('/')) {
                (Some(name), _) if open.pop() != Some(name) => return Err(format!("{name} is closed")),
                (None, None) => open.push(tag.split(' ').next().expect("there is a first part")),
                _ => {}
            }
            if tag.matches('"').count() % 2 != 0 || tag.contains('<') {
                return Err(format!("attributes of {tag:?}"));
            }
            rest = after;
        }
        let controls = text.chars().any(|letter| letter.is_control() && letter != '\n');
        let entities = text.split('&').skip(1);
        let is_known =
            |after: &str| ["amp;", "lt;", "gt;", "quot;"].iter().any(|name| after.starts_with(name));
        if !open.is_empty() || controls || !entities.into_iter().all(is_known) || !rest.trim().is_empty() {
            return Err(format!("{open:?} are open, or a character is not allowed"));
        }
        Ok(())
    }
}
