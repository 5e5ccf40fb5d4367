//! Messages of the program: one line per fact, on standard error, so that standard output is free
//! for images and lists.

use std::fmt::Display;
use std::io::{self, Write};

use clap::ValueEnum;

/// How much is said. Each level says what the ones below it say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub(crate) enum Level {
    /// Nothing at all; the exit code has to do
    Quiet,
    /// Why something failed
    Error,
    /// What is missing or odd
    Warning,
    /// What was done
    Info,
    /// How, and how long it took
    Debug,
}

/// Says things up to a level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reporter {
    level: Level,
}

impl Reporter {
    pub(crate) fn new(level: Level) -> Self {
        Self { level }
    }

    pub(crate) fn error(self, what: impl Display) {
        self.say(Level::Error, format_args!("error: {what}"));
    }

    pub(crate) fn warning(self, what: impl Display) {
        self.say(Level::Warning, format_args!("warning: {what}"));
    }

    pub(crate) fn info(self, what: impl Display) {
        self.say(Level::Info, what);
    }

    pub(crate) fn debug(self, what: impl Display) {
        self.say(Level::Debug, what);
    }

    fn say(self, level: Level, what: impl Display) {
        if self.level >= level {
            // Nobody listens on a closed standard error; that is no failure.
            let _ = writeln!(io::stderr().lock(), "trigon-viewer: {what}");
        }
    }
}
