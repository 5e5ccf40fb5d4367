//! What accuracy costs in time: every question measured, in one report.
//!
//! Errors are the same wherever the report is made; times are those of the machine that
//! makes it, medians of runs in turn.

mod chapters;
mod figures;
mod headline;
mod labels;
mod markdown;
mod picture;
mod plot;

#[cfg(test)]
mod tests;

use crate::field::Field;
use chapters::CHAPTERS;
use figures::Row;
use headline::Headline;
use picture::Picture;
use plot::Plot;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

/// How long measuring may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effort {
    /// Less than a minute: fewer runs, smaller pictures.
    Quick,
    /// Some minutes.
    #[default]
    Full,
    /// Everything once, to see that it works.
    #[cfg(test)]
    Once,
}

impl Effort {
    /// One of two numbers.
    fn pick<T>(self, quick: T, full: T) -> T {
        if self == Self::Full { full } else { quick }
    }

    /// How often everything is timed.
    fn rounds(self) -> usize {
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
struct Question {
    /// In file names.
    name: &'static str,
    measure: fn(Effort) -> Chapter,
    /// What stands under "In short" of it.
    headlines: fn() -> Vec<Headline>,
}

/// One question, and what was found.
struct Chapter {
    /// In file names.
    name: &'static str,
    title: &'static str,
    /// What is compared, and in which units.
    text: &'static str,
    rows: Vec<Row>,
    plots: Vec<Plot>,
    pictures: Vec<Picture>,
    /// What else a reader should know, with figures that are not divided by each other.
    findings: Vec<String>,
}

/// A chapter with its headlines in words.
struct Answer {
    chapter: Chapter,
    sentences: Vec<String>,
}

impl Answer {
    fn measure(question: &Question, effort: Effort) -> Self {
        let chapter = (question.measure)(effort);
        let sentences =
            (question.headlines)().iter().map(|headline| headline.sentence(&chapter.rows)).collect();
        Self { chapter, sentences }
    }
}

/// How far measuring has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is measured next.
    pub chapter: &'static str,
    /// Chapters that are done.
    pub done: usize,
    /// All chapters.
    pub of: usize,
}

/// All answers.
pub struct Report {
    effort: Effort,
    answers: Vec<Answer>,
}

impl Report {
    /// Measures everything. `progress` is told before each chapter.
    pub fn measure(effort: Effort, progress: impl FnMut(Progress)) -> Self {
        Self::of(&CHAPTERS, effort, progress)
    }

    /// Measures some chapters.
    fn of(chapters: &[Question], effort: Effort, mut progress: impl FnMut(Progress)) -> Self {
        let of = chapters.len();
        let measure = |(done, question): (usize, &Question)| {
            progress(Progress { chapter: question.name, done, of });
            Answer::measure(question, effort)
        };
        Self { effort, answers: chapters.iter().enumerate().map(measure).collect() }
    }

    /// Writes `report.md`, `results.csv` and the folder `images`, which the report shows.
    ///
    /// # Errors
    /// What the file system says.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let images = folder.join("images");
        fs::create_dir_all(&images)?;
        for Answer { chapter, .. } in &self.answers {
            for plot in &chapter.plots {
                plot.write(&images.join(plot.file(chapter.name)))?;
            }
            for picture in &chapter.pictures {
                picture.write(&images.join(picture.file(chapter.name)))?;
            }
        }
        let mut csv = io::BufWriter::new(File::create(folder.join("results.csv"))?);
        markdown::write_csv(&self.answers, &mut csv)?;
        csv.flush()?;
        fs::write(folder.join("report.md"), markdown::report(self.effort, &self.answers))
    }
}

/// Grey values, 0 to 1 of linear light, as bytes.
fn grey(light: f64) -> [u8; 3] {
    [trigon_math::color::linear_to_srgb8(light as f32); 3]
}

/// How wrong something is, from black over red and yellow to white, 1 and above.
fn heat(error: f64) -> [u8; 3] {
    [0.0, 1.0, 2.0].map(|start| ((error * 3.0 - start).clamp(0.0, 1.0) * 255.0) as u8)
}

/// A colour for a number, to tell neighbours apart.
fn tint(number: u32) -> [u8; 3] {
    let bits = u64::from(number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    [16, 32, 48].map(|shift| 64 + (bits >> shift & 0x7f) as u8)
}

/// The faces of a picture in colours; nothing is dark.
fn tinted(faces: &Field<u32>) -> Field<[u8; 3]> {
    faces.map(|&face| if face == u32::MAX { [24; 3] } else { tint(face) })
}
