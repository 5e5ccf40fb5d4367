//! What a budget has chosen, and what that gives up.

use std::fmt;
use std::time::Duration;

use super::Quality;

/// A quality, and what is foreseen of a picture in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foreseen {
    /// The quality.
    pub quality: Quality,
    /// How long drawing will take.
    pub time: Duration,
    /// How far the picture will be from the reference, as [`rmse`](super::rmse) measures
    /// it; `None` as long as nothing was learnt.
    pub error: Option<f64>,
}

/// What a budget has chosen for the next picture, and what that gives up.
///
/// As text it says so: `2×2 samples, lighting per pixel: about 9.3 ms of 16.0 ms, error
/// about 0.0034 …`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The most accurate quality that fits, or the quickest of all.
    pub chosen: Foreseen,
    /// The time that there is.
    pub limit: Duration,
    /// Whether the choice is foreseen to fit.
    pub fits: bool,
    /// The next more accurate quality, which was given up; `None` if there is none.
    pub given_up: Option<Foreseen>,
    /// What errors are measured against.
    pub reference: Quality,
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// An error with two digits that count.
fn write_error(f: &mut fmt::Formatter<'_>, error: Option<f64>) -> fmt::Result {
    match error {
        Some(error) => write!(f, ", error about {error:.4}"),
        None => Ok(()),
    }
}

impl fmt::Display for Foreseen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (about {:.1} ms", self.quality, milliseconds(self.time))?;
        write_error(f, self.error)?;
        f.write_str(")")
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (time, limit) = (milliseconds(self.chosen.time), milliseconds(self.limit));
        if self.fits {
            write!(f, "{}: about {time:.1} ms of {limit:.1} ms", self.chosen.quality)?;
        } else {
            write!(f, "the fastest setting takes about {time:.1} ms, more than {limit:.1} ms: ")?;
            write!(f, "{}", self.chosen.quality)?;
        }
        write_error(f, self.chosen.error)?;
        match &self.given_up {
            Some(better) => write!(f, "; gave up {better}")?,
            None => f.write_str("; gave up nothing")?,
        }
        if self.chosen.error.is_some() {
            write!(f, "; errors are RMSE in linear light against {}", self.reference)?;
        }
        Ok(())
    }
}
