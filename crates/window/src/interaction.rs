//! Recordings of a window's input as text, to be replayed in a test or sent to somebody else with a bug
//! report.

use std::collections::VecDeque;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::input::InputEvent;

/// The format of the lines below.
const FORMAT: &str = "trigon interaction 1";

/// All input that came to a window, in order, with its time.
///
/// As text: a line that names the format, followed by one line of JSON per event.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interaction {
    steps: VecDeque<Step>,
}

/// One event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Step {
    /// Milliseconds since the window opened.
    ms: f64,
    event: InputEvent,
}

/// A text is not a recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line} is not part of an interaction: {reason}; record it again with this version")]
#[non_exhaustive]
pub struct InteractionError {
    /// From 1.
    pub line: usize,
    /// The reason.
    pub reason: String,
}

impl Interaction {
    /// As text, for saving to a file.
    #[must_use]
    pub fn to_text(&self) -> String {
        let lines = self.steps.iter().map(|step| serde_json::to_string(step).unwrap_or_default());
        std::iter::once(FORMAT.to_owned()).chain(lines).fold(String::new(), |text, line| text + &line + "\n")
    }

    /// From text.
    ///
    /// # Errors
    /// The first line that is not in the format of [`to_text`](Self::to_text).
    pub fn from_text(text: &str) -> Result<Self, InteractionError> {
        let mut lines = text.lines().zip(1..);
        let first = lines.next().map_or("", |(line, _)| line);
        if first != FORMAT {
            let reason = format!("it should be {FORMAT:?}");
            return Err(InteractionError { line: 1, reason });
        }
        let steps = lines.filter(|(line, _)| !line.trim().is_empty()).map(|(text, line)| {
            let step: Step = serde_json::from_str(text)
                .map_err(|error| InteractionError { line, reason: error.to_string() })?;
            let possible = step.ms.is_finite() && (0.0..=1e12).contains(&step.ms);
            let reason = || format!("{} ms is not a valid time", step.ms);
            if possible { Ok(step) } else { Err(InteractionError { line, reason: reason() }) }
        });
        Ok(Self { steps: steps.collect::<Result<_, _>>()? })
    }

    /// Whether nothing is left to replay.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Adds an event.
    pub(crate) fn record(&mut self, event: InputEvent, now: Duration) {
        self.steps.push_back(Step { ms: now.as_secs_f64() * 1e3, event });
    }

    /// The time of the next event.
    pub(crate) fn due(&self) -> Option<Duration> {
        self.steps.front().map(|step| Duration::from_secs_f64(step.ms / 1e3))
    }

    /// The next event with its time, if it is due.
    pub(crate) fn next(&mut self, now: Duration) -> Option<(Duration, InputEvent)> {
        let due = self.due().filter(|due| *due <= now)?;
        self.steps.pop_front().map(|step| (due, step.event))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_that_is_no_interaction_is_refused_by_line() {
        let line = |text: &str| Interaction::from_text(text).err().map(|error| error.line);
        assert_eq!(line(""), Some(1), "nothing");
        assert_eq!(line("trigon interaction 9\n"), Some(1), "another version");
        let head = format!("{FORMAT}\n");
        assert_eq!(line(&head), None, "an interaction of nothing");
        assert_eq!(line(&format!("{head}\n{{}}\n")), Some(3), "no event");
        let endless = format!("{head}{{\"ms\":1e300,\"event\":\"FocusLost\"}}\n");
        assert_eq!(line(&endless), Some(2), "no moment");
    }
}
