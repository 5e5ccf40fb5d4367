//! Measures how accurately other renderers, and trigon, draw the [`workloads`](crate::workloads).
//!
//! Every image is compared with the same [`Exact`] image: the workload's definition evaluated in `f64`, by
//! rays, with camera, light and texture implemented again. It shares no code with the engine, and reads only
//! vertices, triangles and colours from the workloads. Errors are separated:
//!
//! - *Outlines*: pixels where several surfaces meet, and that show the wrong one. That is coverage, and depth where one
//!   surface hides another.
//! - *Within surfaces*: pixels whose neighbours show the same surface. What differs there is depth in [flat
//!   colours](crate::workloads::Shading::Flat), and interpolation, light or texture elsewhere.
//! - *The whole image*: against the mean of 256 rays through each pixel, which is what more samples come closer to.

mod errors;
mod exact;

use std::fmt::Write as _;

use self::errors::Centres;

pub use errors::Errors;
pub use exact::{Exact, Pixel};

/// A renderer's errors in a workload.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// In the names of files, such as `euc-0.5.3`.
    pub renderer: String,
    /// The workload's name.
    pub workload: String,
    /// What is wrong with its image.
    pub errors: Errors,
}

/// A renderer's time for a frame of a workload.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    /// As in [`Measured`].
    pub renderer: String,
    /// The workload's name.
    pub workload: String,
    /// How many threads drew.
    pub threads: usize,
    /// Milliseconds: a quarter of the frames took less than the first, half of them less than the second, and a quarter of them
    /// more than the third.
    pub quarters: [f64; 3],
}

impl Measured {
    /// The first line of the file.
    pub const HEAD: &str = "renderer,workload,image,wrong at outlines,wrong within,within,worst within";

    /// A line of the file.
    #[must_use]
    pub fn line(&self) -> String {
        let Errors { image, centres } = self.errors;
        let mut line = format!("{},{},{image}", self.renderer, self.workload);
        let numbers = centres.map_or([None; 4], |centres| {
            let Centres { wrong_at_outlines, wrong_within, within, worst_within } = centres;
            [wrong_at_outlines, wrong_within, within, worst_within].map(Some)
        });
        for number in numbers {
            let _ = write!(line, ",{}", number.map_or_else(String::new, |number| number.to_string()));
        }
        line
    }

    fn read(line: &str) -> Option<Self> {
        let [renderer, workload, numbers @ ..] = &line.split(',').collect::<Vec<_>>()[..] else {
            return None;
        };
        let number = |index: usize| numbers.get(index)?.parse::<f64>().ok();
        let centres = |wrong_at_outlines| {
            Some(Centres {
                wrong_at_outlines,
                wrong_within: number(2)?,
                within: number(3)?,
                worst_within: number(4)?,
            })
        };
        let errors = Errors { image: number(0)?, centres: number(1).and_then(centres) };
        Some(Self { renderer: (*renderer).to_owned(), workload: (*workload).to_owned(), errors })
    }
}

impl Timed {
    fn read(line: &str) -> Option<Self> {
        let [renderer, workload, threads, low, median, high] = line.split(',').collect::<Vec<_>>()[..] else {
            return None;
        };
        let quarters = [low.parse().ok()?, median.parse().ok()?, high.parse().ok()?];
        let threads = threads.parse().ok()?;
        Some(Self { renderer: renderer.to_owned(), workload: workload.to_owned(), threads, quarters })
    }
}

/// All errors that were published.
///
/// # Panics
/// The file, which is built in, has a line that cannot be read.
#[must_use]
pub fn measured() -> Vec<Measured> {
    lines(include_str!("../../rivals/errors.csv")).map(|line| Measured::read(line).expect(line)).collect()
}

/// All times that were published.
///
/// # Panics
/// The file, which is built in, has a line that cannot be read.
#[must_use]
pub fn timed() -> Vec<Timed> {
    lines(include_str!("../../rivals/times.csv")).map(|line| Timed::read(line).expect(line)).collect()
}

/// When, of which commit and on which machine the times were measured.
#[must_use]
pub fn timed_on() -> &'static str {
    let line = include_str!("../../rivals/times.csv").lines().next().unwrap_or_default();
    line.trim_start_matches("# ")
}

fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.starts_with('#')).skip(1)
}

#[cfg(test)]
mod tests;
