//! What measured qualities cost and how wrong they are: which of them another one dominates, as a table and as a plot.

use std::fmt::Write;
use std::time::Duration;

use super::plot::{BLUE, GREY, LegendEntry, LegendMark, ORANGE, Plot, PlotDot, PlotLine, best_of};
use super::{Preset, Quality};
use crate::effect_settings::{RaySampling, Shadows};
use crate::settings::ShadingModel;

/// The times of several frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TimeSpread {
    /// A quarter of the frames was faster.
    pub low: Duration,
    /// The frame in the middle.
    pub median: Duration,
    /// A quarter of the frames was slower.
    pub high: Duration,
}

impl TimeSpread {
    /// Of these frames; `None` of none.
    #[must_use]
    pub fn of(times: &[Duration]) -> Option<Self> {
        let mut times = times.to_vec();
        times.sort_unstable();
        let last = times.len().checked_sub(1)?;
        let [low, median, high] = [1, 2, 3].map(|quarters| times[last * quarters / 4]);
        Some(Self { low, median, high })
    }
}

/// How a quality compares with all others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// No other one has a median time and an error that are as small, one of them smaller.
    Best,
    /// One has, but the spreads of their times overlap: a repetition may show the opposite.
    Uncertain,
    /// Another one has an error that is as small, and its spread of times lies below that of this one.
    Dominated,
}

impl Standing {
    /// In one word, as tables have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Best => "best",
            Self::Uncertain => "uncertain",
            Self::Dominated => "dominated",
        }
    }
}

/// A measured quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontierDot {
    /// The quality, without what the frame does not request.
    pub quality: Quality,
    /// The preset that is this quality in such a frame.
    pub preset: Option<Preset>,
    /// The times of its frames.
    pub time: TimeSpread,
    /// How many frames were timed, at least 1.
    pub frames: usize,
    /// The [`rmse`](super::rmse) against the reference's image.
    pub error: f64,
    /// How it compares with the others.
    pub standing: Standing,
}

impl FrontierDot {
    /// A short name: the preset, or the samples and what else is unusual.
    #[must_use]
    pub fn name(&self) -> String {
        let Quality { samples_per_axis: axis, samples, .. } = self.quality;
        if let Some(preset) = self.preset {
            return preset.name().to_owned();
        }
        let shading = match self.quality.shading {
            ShadingModel::Flat => ", flat",
            ShadingModel::Gouraud => ", Gouraud",
            ShadingModel::Phong => "",
        };
        let rays = if self.quality.shadows == Shadows::Rays { ", rays" } else { "" };
        format!("{axis}×{axis}×{samples}{shading}{rays}")
    }

    fn milliseconds(&self) -> [f64; 3] {
        let TimeSpread { low, median, high } = self.time;
        [low, median, high].map(|time| time.as_secs_f64() * 1e3)
    }
}

/// The times and errors of the qualities of one image.
///
/// Errors are relative to the image of [`Preset::Reference`] at the same size, not to the exact image: the reference
/// has errors of its own, of which this knows nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Frontier {
    /// In no particular order.
    pub dots: Vec<FrontierDot>,
    /// The error of rounding the reference's light to bytes, as [`rounding_floor`](super::rounding_floor) estimates it.
    /// An image cannot be told from the reference by less.
    pub floor: f64,
    /// The quality that errors are relative to.
    pub reference: Quality,
}

impl Frontier {
    /// Of these dots, whose standing is found here.
    pub(super) fn new(mut dots: Vec<FrontierDot>, floor: f64, reference: Quality) -> Self {
        let points: Vec<[f64; 2]> =
            dots.iter().map(|dot| [dot.time.median.as_secs_f64(), dot.error]).collect();
        let best = best_of(&points);
        let certain = certainly_dominated(&dots);
        for (index, dot) in dots.iter_mut().enumerate() {
            dot.standing = match (best.contains(&index), certain[index]) {
                (true, _) => Standing::Best,
                (false, true) => Standing::Dominated,
                (false, false) => Standing::Uncertain,
            };
        }
        Self { dots, floor, reference }
    }

    /// The best dots, from the fastest to the most accurate.
    #[must_use]
    pub fn best(&self) -> Vec<&FrontierDot> {
        let mut best: Vec<&FrontierDot> =
            self.dots.iter().filter(|dot| dot.standing == Standing::Best).collect();
        best.sort_by(|a, b| a.time.median.cmp(&b.time.median).then(b.error.total_cmp(&a.error)));
        best
    }

    /// What a time per frame buys: the smallest error among the qualities of which three quarters of the frames keep
    /// within the time, or the fastest quality if there is none. `None` if nothing was measured.
    #[must_use]
    pub fn choice(&self, limit: Duration) -> Option<&FrontierDot> {
        let within = self.dots.iter().filter(|dot| dot.time.high <= limit);
        let accurate =
            within.min_by(|a, b| a.error.total_cmp(&b.error).then(a.time.median.cmp(&b.time.median)));
        accurate.or_else(|| self.dots.iter().min_by_key(|dot| dot.time.median))
    }

    /// A table of comma-separated values with a line of titles, from the fastest to the slowest.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text =
            "name,preset,samples per axis,samples,lighting,shadows,occlusion rays,occlusion sampling,\
            soft shadow rays,soft shadow sampling,glass bounces,ms low,ms median,ms high,frames,RMSE against reference,standing\n"
                .to_owned();
        let mut dots: Vec<&FrontierDot> = self.dots.iter().collect();
        dots.sort_by_key(|dot| dot.time.median);
        for dot in dots {
            let Quality { samples_per_axis, samples, occlusion_rays, shadow_rays, glass_bounces, .. } =
                dot.quality;
            let [lighting, shadows] = words(&dot.quality);
            let occlusion = sampling(occlusion_rays, dot.quality.occlusion_sampling);
            let shadow = sampling(shadow_rays, dot.quality.shadow_sampling);
            let [low, median, high] = dot.milliseconds();
            let preset = dot.preset.map_or("", Preset::name);
            // A string takes any text.
            let _ = writeln!(
                text,
                "\"{}\",{preset},{samples_per_axis},{samples},{lighting},{shadows},{occlusion_rays},{occlusion},\
                 {shadow_rays},{shadow},{glass_bounces},{low},{median},{high},{},{},{}",
                dot.name(),
                dot.frames,
                dot.error,
                dot.standing.name()
            );
        }
        text
    }

    /// Error against time, both logarithmic. The title says what was drawn, such as `chair.glb, 1000×600, 2 threads`;
    /// what a time per frame buys has a ring.
    #[must_use]
    pub fn plot(&self, subject: &str, limit: Option<Duration>) -> Plot {
        let choice = limit.and_then(|limit| self.choice(limit)).copied();
        let line = self.best().into_iter().map(|dot| [dot.milliseconds()[1], dot.error]).collect();
        let dots = self.dots.iter().map(|dot| plot_dot(dot, choice.as_ref() == Some(dot)));
        let entry = |text: &str, mark| LegendEntry { text: text.to_owned(), mark };
        let mut legend = vec![
            entry("no other is faster and more accurate", LegendMark::Dot(BLUE)),
            entry("one is, within the spread of times", LegendMark::Circle(BLUE)),
            entry("one certainly is", LegendMark::Dot(GREY)),
        ];
        if let Some(limit) = limit {
            let text = format!("what {:.1} ms per frame buy", limit.as_secs_f64() * 1e3);
            legend.push(entry(&text, LegendMark::Ring(ORANGE)));
        }
        Plot {
            title: format!("Error against time: {subject}"),
            notes: vec![
                "Errors are relative to the preset reference at this size, not to the exact image."
                    .to_owned(),
                "Times are medians; the lines go from the lower to the upper quartile.".to_owned(),
            ],
            axes: ["ms per frame".to_owned(), "RMSE in linear light against reference".to_owned()],
            lines: vec![PlotLine { points: line, color: BLUE, width: 1, disc: 0 }],
            levels: vec![(self.floor, "rounding to 8-bit bytes".to_owned())],
            dots: dots.collect(),
            legend,
            legend_at_right: true,
            ..Plot::default()
        }
    }
}

/// For each dot whether another one is faster beyond doubt and as accurate.
fn certainly_dominated(dots: &[FrontierDot]) -> Vec<bool> {
    let mut by_end: Vec<&FrontierDot> = dots.iter().collect();
    by_end.sort_by_key(|dot| dot.time.high);
    // The smallest error of all that end no later.
    let least = by_end.iter().scan(f64::INFINITY, |least, dot| {
        *least = least.min(dot.error);
        Some(*least)
    });
    let least: Vec<f64> = least.collect();
    let faster = |dot: &FrontierDot| by_end.partition_point(|other| other.time.high < dot.time.low);
    dots.iter().map(|dot| faster(dot).checked_sub(1).is_some_and(|last| least[last] <= dot.error)).collect()
}

fn plot_dot(dot: &FrontierDot, is_choice: bool) -> PlotDot {
    let [low, median, high] = dot.milliseconds();
    let is_named = dot.preset.is_some() || dot.standing == Standing::Best || is_choice;
    PlotDot {
        label: if is_named { dot.name() } else { String::new() },
        is_filled: dot.standing != Standing::Uncertain,
        has_ring: is_choice,
        spread: Some([low, high]),
        ..PlotDot::new([median, dot.error], if dot.standing == Standing::Dominated { GREY } else { BLUE })
    }
}

/// Lighting and shadows, as tables have them.
fn words(quality: &Quality) -> [String; 2] {
    let lighting = match quality.shading {
        ShadingModel::Flat => "per triangle",
        ShadingModel::Gouraud => "per vertex",
        ShadingModel::Phong => "per pixel",
    };
    let shadows = match quality.shadows {
        Shadows::Off => "off".to_owned(),
        Shadows::Maps { resolution } => format!("maps of {resolution} texels"),
        Shadows::Rays => "rays".to_owned(),
    };
    [lighting.to_owned(), shadows]
}

/// Where some rays start, as tables have it.
fn sampling(rays: u32, sampling: RaySampling) -> &'static str {
    match (rays, sampling) {
        (0, _) => "",
        (_, RaySampling::Full) => "full",
        (_, RaySampling::Shared) => "shared",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A quality that no other number has, with its quartiles in milliseconds.
    fn dot(number: u32, [low, median, high]: [u64; 3], error: f64) -> FrontierDot {
        let [low, median, high] = [low, median, high].map(Duration::from_millis);
        let quality = Quality { occlusion_rays: number, ..Preset::Draft.quality() };
        let time = TimeSpread { low, median, high };
        FrontierDot { quality, preset: None, time, frames: 5, error, standing: Standing::Uncertain }
    }

    fn frontier(dots: Vec<FrontierDot>) -> Frontier {
        Frontier::new(dots, 0.001, Preset::Reference.quality())
    }

    #[test]
    fn quarters_of_the_frames_are_faster_and_slower() {
        let ms = Duration::from_millis;
        let spread = TimeSpread::of(&[5, 1, 4, 2, 3].map(ms));
        assert_eq!(spread, Some(TimeSpread { low: ms(2), median: ms(3), high: ms(4) }));
        assert_eq!(TimeSpread::of(&[]), None, "of no frame");
    }

    #[test]
    fn only_what_is_slower_beyond_doubt_is_dominated() {
        let dots = vec![
            dot(0, [2, 3, 4], 0.5),
            dot(1, [4, 5, 6], 0.5),
            dot(2, [5, 6, 7], 0.5),
            dot(3, [5, 6, 7], 0.4),
            dot(4, [1, 1, 9], 0.7),
        ];
        let standings = frontier(dots).dots.iter().map(|dot| dot.standing).collect::<Vec<_>>();
        use Standing::{Best, Dominated, Uncertain};
        assert_eq!(standings, [Best, Uncertain, Dominated, Best, Best]);
    }

    #[test]
    fn a_time_buys_the_most_accurate_that_keeps_within_it() {
        let frontier = frontier(vec![
            dot(0, [2, 3, 4], 0.5),
            dot(1, [4, 5, 6], 0.2),
            dot(2, [4, 5, 9], 0.1),
            dot(3, [1, 1, 1], 0.9),
        ]);
        let choice = |ms| {
            let choice = frontier.choice(Duration::from_millis(ms)).expect("there are some");
            choice.quality.occlusion_rays
        };
        assert_eq!([0, 1, 4, 6, 8, 9].map(choice), [3, 3, 0, 1, 1, 2]);
        let ring = frontier.plot("it", Some(Duration::from_millis(4))).dots;
        assert_eq!(ring.iter().map(|dot| dot.has_ring).collect::<Vec<_>>(), [true, false, false, false]);
    }

    #[test]
    fn tables_and_plots_have_every_quality() {
        let mut preset = dot(1, [4, 5, 6], 0.0);
        (preset.preset, preset.quality) = (Some(Preset::Reference), Preset::Reference.quality());
        let frontier = frontier(vec![preset, dot(0, [2, 3, 4], 0.5)]);
        let csv = frontier.to_csv();
        let lines: Vec<&str> = csv.lines().collect();
        assert_eq!(lines[2], "\"reference\",reference,4,16,per pixel,rays,64,full,64,full,8,4,5,6,5,0,best");
        assert!(lines[1].starts_with("\"1×1×1\",,1,1,per pixel,maps of 2048 texels,0,,0,,4,2,3,4,"), "{csv}");
        let columns = |line: &str| line.split(',').count();
        assert!(lines.iter().all(|line| columns(line) == columns(lines[0])), "{csv}");
        let svg = frontier.plot("a <model>", None).to_svg();
        for text in ["a &lt;model&gt;", "reference (0)", "rounding to 8-bit bytes", "not to the exact image"]
        {
            assert!(svg.contains(text), "{text} is not in {svg}");
        }
        let empty = Frontier { dots: Vec::new(), ..frontier };
        assert!(
            empty.choice(Duration::ZERO).is_none() && empty.plot("", None).to_svg().ends_with("</svg>\n")
        );
    }

    /// Few different values, so that equal ones are frequent.
    fn any_dot() -> impl Strategy<Value = FrontierDot> {
        let error = prop_oneof![Just(0.0), (0_u8..5).prop_map(f64::from), 0.0..1e9];
        ([0_u64..9, 0..9, 0..9], error).prop_map(|(mut times, error)| {
            times.sort_unstable();
            dot(0, times, error)
        })
    }

    proptest! {
        /// Against the definition, by all pairs.
        #[test]
        fn standings_are_as_defined(dots in prop::collection::vec(any_dot(), 0..20)) {
            for dot in &frontier(dots.clone()).dots {
                let is_beaten = dots.iter().any(|other| {
                    let [a, b] = [other, dot].map(|dot| (dot.time.median, dot.error));
                    a.0 <= b.0 && a.1 <= b.1 && (a.0 < b.0 || a.1 < b.1)
                });
                let is_certain =
                    dots.iter().any(|other| other.time.high < dot.time.low && other.error <= dot.error);
                let expected = match (is_beaten, is_certain) {
                    (false, _) => Standing::Best,
                    (true, false) => Standing::Uncertain,
                    (true, true) => Standing::Dominated,
                };
                prop_assert_eq!(dot.standing, expected, "{:?} of {:?}", dot, dots);
                prop_assert!(is_beaten || !is_certain, "what is dominated beyond doubt is beaten in the middle");
            }
        }
    }
}
