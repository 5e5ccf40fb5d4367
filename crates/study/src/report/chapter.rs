//! A chapter of the report: a question, and its text, tables and plots. Measured values have a form from
//! which tables, plots and files are made.

use super::headline::Headline;
use super::markdown::ImageRow;
use super::plot::Plot;
use crate::measure::Spread;

/// How much time measuring may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effort {
    /// Less than a minute: fewer runs, smaller images.
    Quick,
    /// Some minutes.
    #[default]
    Full,
    /// Everything once, as a test.
    #[cfg(test)]
    Once,
}

impl Effort {
    /// One of two numbers.
    pub(super) fn pick<T>(self, quick: T, full: T) -> T {
        if self == Self::Full { full } else { quick }
    }

    /// The number of timed runs in a sitting.
    pub(super) fn rounds(self) -> usize {
        match self {
            Self::Quick => 3,
            Self::Full => 3,
            #[cfg(test)]
            Self::Once => 1,
        }
    }
}

/// A question that a chapter answers.
#[derive(Clone, Copy)]
pub(super) struct Question {
    /// In file names.
    pub(super) name: &'static str,
    pub(super) measure: fn(Effort) -> Chapter,
    /// Its sentences under "In short".
    pub(super) headlines: fn() -> Vec<Headline>,
}

/// The results for one question.
pub(super) struct Chapter {
    /// In file names.
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// The comparison, with its units.
    pub(super) text: &'static str,
    pub(super) rows: Vec<Row>,
    pub(super) plots: Vec<Plot>,
    pub(super) images: Vec<ImageRow>,
    /// Further notes for the reader, with figures that are not divided by each other.
    pub(super) findings: Vec<String>,
}

/// A chapter with its headlines in words.
pub(super) struct Answer {
    pub(super) chapter: Chapter,
    pub(super) sentences: Vec<String>,
}

impl Answer {
    pub(super) fn measure(question: &Question, effort: Effort) -> Self {
        let chapter = (question.measure)(effort);
        let sentences =
            (question.headlines)().iter().map(|headline| headline.sentence(&chapter.rows)).collect();
        Self { chapter, sentences }
    }
}

/// What one variant gave in one case, and under which conditions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    /// The table that it stands in.
    pub(super) case: String,
    /// Its name there.
    pub(super) variant: String,
    pub(super) conditions: Conditions,
    pub(super) values: Vec<Value>,
    /// Whether tables and plots show it; the file has it in any case.
    pub(super) is_listed: bool,
}

/// All that two rows may differ in. Only rows that differ in exactly one of these are compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Conditions {
    /// What does the work, with its settings.
    pub(super) algorithm: String,
    pub(super) threads: usize,
    /// What is drawn, or worked on.
    pub(super) geometry: String,
    /// Of the image, in pixels; 0 where there is none.
    pub(super) resolution: [usize; 2],
    pub(super) warmth: Warmth,
}

/// What a timed run finds ready.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Warmth {
    /// Memory, threads and trees are kept from run to run.
    Warm,
    /// They are made in each run.
    BuiltAnew,
}

impl Conditions {
    /// The names of the conditions in files.
    pub(super) const NAMES: [&'static str; 5] = ["algorithm", "threads", "geometry", "resolution", "warmth"];

    /// The conditions in words, in the order of their names; empty where there is nothing to say.
    pub(super) fn words(&self) -> [String; 5] {
        let [width, height] = self.resolution;
        let resolution = if width * height > 0 { format!("{width}×{height} pixels") } else { String::new() };
        let threads =
            if self.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", self.threads) };
        let warmth = match self.warmth {
            Warmth::Warm => "warm",
            Warmth::BuiltAnew => "built anew in each run",
        };
        [self.algorithm.clone(), threads, self.geometry.clone(), resolution, warmth.to_owned()]
    }
}

/// One number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Value {
    /// What it tells, and its unit: the head of a column.
    pub(super) quantity: &'static str,
    pub(super) value: f64,
    /// Between which values half of the runs lay.
    pub(super) range: Option<[f64; 2]>,
}

impl Row {
    /// A row of a table, with one thread and warm, its algorithm and its geometry named like it.
    pub(super) fn new(case: impl Into<String>, variant: impl Into<String>) -> Self {
        let (case, variant) = (case.into(), variant.into());
        let conditions = Conditions {
            algorithm: variant.clone(),
            threads: 1,
            geometry: case.clone(),
            resolution: [0; 2],
            warmth: Warmth::Warm,
        };
        Self { case, variant, conditions, values: Vec::new(), is_listed: true }
    }

    /// Of an image of so many pixels.
    pub(super) fn sized(mut self, resolution: [usize; 2]) -> Self {
        self.conditions.resolution = resolution;
        self
    }

    /// By an algorithm that the row is not named after.
    pub(super) fn by(mut self, algorithm: impl Into<String>) -> Self {
        self.conditions.algorithm = algorithm.into();
        self
    }

    /// Of something that the table is not named after.
    pub(super) fn of(mut self, geometry: impl Into<String>) -> Self {
        self.conditions.geometry = geometry.into();
        self
    }

    /// With several threads.
    pub(super) fn with_threads(mut self, threads: usize) -> Self {
        self.conditions.threads = threads;
        self
    }

    /// With nothing kept from run to run.
    pub(super) fn built_anew(mut self) -> Self {
        self.conditions.warmth = Warmth::BuiltAnew;
        self
    }

    /// With a number.
    pub(super) fn with(mut self, quantity: &'static str, value: f64) -> Self {
        self.values.push(Value { quantity, value, range: None });
        self
    }

    /// With a time.
    pub(super) fn timed(mut self, quantity: &'static str, time: Spread) -> Self {
        let Spread { low, median, high } = time;
        self.values.push(Value { quantity, value: median, range: Some([low, high]) });
        self
    }

    pub(super) fn value(&self, quantity: &str) -> Option<f64> {
        self.found(quantity).map(|found| found.value)
    }

    /// Between which values half of the runs lay.
    pub(super) fn quartiles(&self, quantity: &str) -> Option<[f64; 2]> {
        self.found(quantity)?.range
    }

    fn found(&self, quantity: &str) -> Option<&Value> {
        self.values.iter().find(|value| value.quantity == quantity)
    }
}

/// A number of a variant in a case; no number if it was not measured.
pub(super) fn value(rows: &[Row], case: &str, variant: &str, quantity: &str) -> f64 {
    let mut found = rows.iter().filter(|row| row.case == case && row.variant == variant);
    found.find_map(|row| row.value(quantity)).unwrap_or(f64::NAN)
}

/// Quartiles in words, after their median.
pub(super) fn quartile_words(quartiles: Option<[f64; 2]>) -> String {
    quartiles.map_or_else(String::new, |[low, high]| format!(" ({}–{})", number(low), number(high)))
}

/// Three digits that count, without an exponent where people can do without.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        "–".to_owned()
    } else if !(1e-4..1e7).contains(&size) {
        format!("{value:.2e}")
    } else {
        let before = trigon_math::elementary::log10(size).floor();
        let after = (2.0 - before).max(0.0) as usize;
        format!("{value:.after$}")
    }
}
