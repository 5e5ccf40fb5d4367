//! What happened to each mutant, kept while a run is going on and between runs.

use crate::Folder;
use crate::error::{Error, Result, at};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Outcome {
    /// A test failed.
    Caught,
    /// A test did not end.
    TimedOut,
    /// All tests that reach the mutant passed.
    Survived,
    /// No test reaches the mutant.
    NotReached,
}

impl Outcome {
    pub(crate) fn is_detected(self) -> bool {
        matches!(self, Self::Caught | Self::TimedOut)
    }
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Found {
    pub(crate) outcome: Outcome,
    /// The test that failed or did not end.
    pub(crate) by: Option<String>,
    /// How many tests were run.
    pub(crate) tests: usize,
    /// Survived a run of an earlier build, and was caught by a test that was written since.
    #[serde(default)]
    pub(crate) survived_before: bool,
}

/// By the mutants' identities.
pub(crate) type Results = BTreeMap<String, Found>;

fn name(krate: &str) -> String {
    format!("results-{krate}.json")
}

pub(crate) fn load(folder: &Folder, krate: &str) -> Result<Results> {
    let path = folder.state(&name(krate));
    if !path.exists() {
        return Ok(Results::new());
    }
    let text = at(&path, fs::read_to_string(&path))?;
    serde_json::from_str(&text).map_err(|error| Error::Json { path, error })
}

pub(crate) fn save(folder: &Folder, krate: &str, results: &Results) -> Result<()> {
    let path = folder.state(&name(krate));
    let text =
        serde_json::to_string_pretty(results).map_err(|error| Error::Json { path: path.clone(), error })?;
    at(&path, fs::write(&path, text))
}

/// Removes the results of a crate, so that the next run tests all of its mutants.
pub(crate) fn forget(folder: &Folder, krate: &str) -> Result<()> {
    save(folder, krate, &Results::new())
}
