//! The report "What a millisecond buys", and its appendix with the measurements for every question.
//!
//! Errors are the same on every machine. Times are those of the machine that writes the report: medians of runs in random order, in
//! several sittings.

mod chapter;
mod chapters;
mod frontier_plot;
mod header;
mod headline;
mod markdown;
mod page;
mod plot;
mod stale;

#[cfg(test)]
mod published;
#[cfg(test)]
mod tests;

pub use chapter::Effort;
pub use header::{Header, Load, Moment};
pub use stale::{Age, ages};

use chapter::{Answer, Question, Row};
use chapters::CHAPTERS;
use page::Recorded;
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
        Self { answers: chapters.iter().enumerate().map(measure).collect() }
    }

    /// Writes `accuracy.md`, its appendix `accuracy-appendix.md`, all rows as `accuracy.csv`, and the folder `images`, which both
    /// show.
    ///
    /// # Errors
    /// What the file system says.
    pub fn write(&self, folder: &Path, header: &Header) -> io::Result<()> {
        self.write_appendix(folder, header)?;
        let recorded = self.recorded(header);
        for panel in page::panels(&recorded) {
            fs::write(folder.join("images").join(panel.file()), panel.svg())?;
        }
        fs::write(folder.join("accuracy.md"), page::page(&recorded))
    }

    /// All but the page and its picture.
    fn write_appendix(&self, folder: &Path, header: &Header) -> io::Result<()> {
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
        let mut csv = io::BufWriter::new(File::create(folder.join("accuracy.csv"))?);
        csv.write_all(header.lines().as_bytes())?;
        markdown::write_csv(&self.answers, &mut csv)?;
        csv.flush()?;
        fs::write(folder.join(page::APPENDIX), markdown::appendix(header, &self.answers))
    }

    fn recorded<'a>(&'a self, header: &'a Header) -> Recorded<'a> {
        let rows = |name: &str| -> &[Row] {
            let answer = self.answers.iter().find(|answer| answer.chapter.name == name);
            answer.map_or(&[], |answer| &answer.chapter.rows)
        };
        Recorded {
            header,
            frames: rows("frames"),
            effects: rows("effects"),
            line: rows("line"),
            rivals: rows("rivals"),
        }
    }
}
