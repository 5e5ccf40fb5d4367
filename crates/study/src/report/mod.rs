//! The report "What accuracy costs": measurements for every question.
//!
//! Errors are the same on every machine. Times are those of the machine that writes the report: medians of
//! interleaved runs.

mod chapter;
mod chapters;
mod headline;
mod markdown;
mod plot;

#[cfg(test)]
mod published;
#[cfg(test)]
mod tests;

pub use chapter::Effort;

use chapter::{Answer, Question};
use chapters::CHAPTERS;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

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
            for image in &chapter.images {
                image.write(&images.join(image.file(chapter.name)))?;
            }
        }
        let mut csv = io::BufWriter::new(File::create(folder.join("results.csv"))?);
        markdown::write_csv(&self.answers, &mut csv)?;
        csv.flush()?;
        fs::write(folder.join("report.md"), markdown::report(self.effort, &self.answers))
    }
}
