//! What accuracy costs in time: every question measured, in one report.
//!
//! Errors are the same wherever the report is made; times are those of the machine that
//! makes it, medians of runs in turn.

mod chapters;
mod figures;
mod labels;
mod markdown;
mod picture;
mod plot;

#[cfg(test)]
mod tests;

use crate::field::Field;
use chapters::CHAPTERS;
use figures::Row;
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
}

impl Effort {
    /// One of two numbers.
    fn pick<T>(self, quick: T, full: T) -> T {
        if self == Self::Quick { quick } else { full }
    }

    /// How often everything is timed.
    fn rounds(self) -> usize {
        self.pick(5, 15)
    }
}

/// A name, and who measures.
type Question = (&'static str, fn(Effort) -> Chapter);

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
    /// What a reader should know, with figures.
    findings: Vec<String>,
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
    chapters: Vec<Chapter>,
}

impl Report {
    /// Measures everything. `progress` is told before each chapter.
    pub fn measure(effort: Effort, progress: impl FnMut(Progress)) -> Self {
        Self::of(&CHAPTERS, effort, progress)
    }

    /// Measures some chapters.
    fn of(chapters: &[Question], effort: Effort, mut progress: impl FnMut(Progress)) -> Self {
        let of = chapters.len();
        let measure = |(done, &(chapter, measure)): (usize, &Question)| {
            progress(Progress { chapter, done, of });
            measure(effort)
        };
        Self { effort, chapters: chapters.iter().enumerate().map(measure).collect() }
    }

    /// Writes `report.md`, `results.csv` and the folder `images`, which the report shows.
    ///
    /// # Errors
    /// What the file system says.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let images = folder.join("images");
        fs::create_dir_all(&images)?;
        for chapter in &self.chapters {
            for plot in &chapter.plots {
                plot.write(&images.join(plot.file(chapter.name)))?;
            }
            for picture in &chapter.pictures {
                picture.write(&images.join(picture.file(chapter.name)))?;
            }
        }
        let mut csv = io::BufWriter::new(File::create(folder.join("results.csv"))?);
        markdown::write_csv(&self.chapters, &mut csv)?;
        csv.flush()?;
        fs::write(folder.join("report.md"), markdown::report(self.effort, &self.chapters))
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
