//! A chapter of the report: a question, and its text, tables and plots.

use super::figures::Row;
use super::headline::Headline;
use super::image_row::ImageRow;
use super::plot::Plot;

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

    /// The number of timed runs.
    pub(super) fn rounds(self) -> usize {
        match self {
            Self::Quick => 5,
            Self::Full => 15,
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
