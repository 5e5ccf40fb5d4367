//! Changes of a command line by the steps of scripts and of keys.

use std::path::Path;

use super::line::CommandLine;
use super::line::plain;
use super::script::{STEPS, Step, Steps};
use super::values;

/// Switches that are on unless they are turned off.
const USUALLY_ON: [&str; 1] = ["notifications"];

impl CommandLine {
    /// The same after a step that changes flags; `file` is the one that is shown.
    ///
    /// # Errors
    /// The flags would be invalid.
    pub(crate) fn changed(&self, step: Step, file: Option<&Path>) -> Result<Self, String> {
        let changed = match step {
            Step::Edit(words) => self.with(words),
            Step::Reset(flag) => self.without(&flag),
            Step::Toggle(flag) => self.with([format!("--{flag}={}", !self.is_on(&flag, file))]),
            Step::Increase(flag, up) => self.with([self.increased(&flag, up, file)]),
            Step::Cycle(flag) => self.with([self.next_value(&flag, &self.typed_value(&flag, file))?]),
            other => return Err(format!("{other:?} changes no flag; this is a bug in trigon")),
        };
        changed.raw(file).map_err(|error| plain(&error))?;
        Ok(changed)
    }

    /// The value of a flag as it would be typed; all that was typed for none.
    pub(crate) fn typed_value(&self, flag: &str, file: Option<&Path>) -> String {
        if flag.is_empty() { self.text() } else { self.value(flag, file).unwrap_or_default() }
    }

    /// Whether a switch was turned off.
    #[cfg(feature = "window")]
    pub(crate) fn is_off(&self, flag: &str) -> bool {
        values::switch(&self.typed_value(flag, None)) == Ok(false)
    }

    fn is_on(&self, flag: &str, file: Option<&Path>) -> bool {
        values::switch(&self.typed_value(flag, file)).unwrap_or(USUALLY_ON.contains(&flag))
    }

    fn increased(&self, flag: &str, up: bool, file: Option<&Path>) -> String {
        let steps = STEPS.iter().find(|steps| steps.flag == flag);
        let &Steps { least, most, step, unset, .. } = steps.expect("the line was checked");
        let now = self.typed_value(flag, file).parse::<f64>().unwrap_or(unset);
        let next = (if up { now + step } else { now - step }).clamp(least, most);
        // In steps, without what rounding adds: none is finer than a hundredth.
        format!("--{flag}={}", ((next / step).round() * step * 100.0).round() / 100.0)
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;

    use super::*;

    #[test]
    fn steps_are_round_numbers() {
        let words = ["--opacity=0.3", "--no-config"].map(OsString::from);
        let mut line = CommandLine::new(words).expect("flags");
        for expected in ["0.35", "0.4", "0.45"] {
            line = line.changed(Step::Increase("opacity".to_owned(), true), None).expect("a number");
            assert_eq!(line.typed_value("opacity", None), expected, "a step more");
        }
    }

    /// The light meter has no value that could be typed.
    #[test]
    fn steps_of_the_exposure_begin_at_none() {
        let line = CommandLine::new(["--no-config"].map(OsString::from)).expect("flags");
        let line = line.changed(Step::Increase("exposure".to_owned(), false), None).expect("a number");
        assert_eq!(line.typed_value("exposure", None), "-0.25", "a step less than 0");
    }

    #[test]
    fn switches_are_toggled_however_they_are_spelled() {
        for (typed, flag, expected) in [
            ("", "edges", "true"),
            ("--edges", "edges", "false"),
            ("--edges=Yes", "edges", "false"),
            ("--edges=off", "edges", "true"),
            ("", "notifications", "false"),
            ("--notifications=no", "notifications", "true"),
        ] {
            let words = typed.split_whitespace().chain(["--no-config"]).map(OsString::from);
            let line = CommandLine::new(words).expect("flags");
            let changed = line.changed(Step::Toggle(flag.to_owned()), None).expect("it is a switch");
            assert_eq!(changed.typed_value(flag, None), expected, "{typed:?}: {flag}");
        }
    }
}
