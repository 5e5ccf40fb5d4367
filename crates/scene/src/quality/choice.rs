//! The quality that a time budget chose, and the settings that it reduced.

use std::fmt;
use std::time::Duration;

use super::Quality;

/// A quality with the predicted time and error of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Prediction {
    /// The quality.
    pub quality: Quality,
    /// The predicted time.
    pub time: Duration,
    /// The predicted error relative to the reference, as [`rmse`](super::rmse) measures it; `None`
    /// until something was learnt.
    pub error: Option<f64>,
}

/// The choice of a budget for the next frame, and what it gave up.
///
/// Its `Display` is such a line: `2×2 samples, lighting per pixel: about 9.3 ms of 16.0 ms, error
/// about 0.0034 …`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The most accurate quality that fits, or the fastest of all.
    pub chosen: Prediction,
    /// The available time.
    pub limit: Duration,
    /// Whether the choice is predicted to fit.
    pub fits: bool,
    /// The next more accurate quality, which was given up; `None` if there is none.
    pub given_up: Option<Prediction>,
    /// The quality that errors are relative to.
    pub reference: Quality,
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// An error with two significant digits.
fn write_error(f: &mut fmt::Formatter<'_>, error: Option<f64>) -> fmt::Result {
    match error {
        Some(error) => write!(f, ", error about {error:.4}"),
        None => Ok(()),
    }
}

impl fmt::Display for Prediction {
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
