//! Which mutants each test reaches, and how long it takes.

use crate::draw::Sample;
use crate::error::{Error, Result, at};
use crate::process::{End, run_test, say};
use crate::tests_of::Test;
use crate::{Folder, run};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::Duration;

/// What a test did while no mutant was active.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Recorded {
    /// Of the program.
    version: u64,
    passes: bool,
    pub(crate) milliseconds: u64,
    /// Numbers of mutants.
    reached: Vec<u32>,
}

/// By the tests' titles.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Records(BTreeMap<String, Recorded>);

/// No test of the suite takes longer without a mutant.
const LIMIT: Duration = Duration::from_secs(1800);

impl Records {
    fn load(path: &Path) -> Result<Self> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = at(path, fs::read_to_string(path))?;
        serde_json::from_str(&text).map_err(|error| Error::Json { path: path.to_owned(), error })
    }

    fn save(&self, path: &Path) -> Result<()> {
        let text =
            serde_json::to_string(self).map_err(|error| Error::Json { path: path.to_owned(), error })?;
        at(path, fs::write(path, text))
    }

    /// The tests that reach a mutant and pass without it, the shortest first.
    pub(crate) fn reaching<'t>(&self, mutant: u32, tests: &'t [Test]) -> Vec<(&'t Test, Duration)> {
        let record = |test: &'t Test| Some((test, self.0.get(&test.title())?));
        let mut found: Vec<(&Test, Duration)> = tests
            .iter()
            .filter_map(record)
            .filter(|(_, record)| record.passes && record.reached.contains(&mutant))
            .map(|(test, record)| (test, Duration::from_millis(record.milliseconds)))
            .collect();
        found.sort_by_key(|(_, time)| *time);
        found
    }
}

/// Runs those tests once whose program is new.
pub(crate) fn record(folder: &Folder, sample: &Sample, tests: &[Test]) -> Result<Records> {
    let path = folder.state("records.json");
    let mut records = Records::load(&path)?;
    let is_known = |test: &&Test| records.0.get(&test.title()).is_some_and(|old| old.version == test.version);
    let new: Vec<&Test> = tests.iter().filter(|test| !is_known(test)).collect();
    say(&format!("{} of {} tests are run without mutants", new.len(), tests.len()));
    run::in_turns(&new, |worker, test| {
        let found = record_one(folder, worker, sample, test)?;
        Ok((test.title(), found))
    })?
    .into_iter()
    .for_each(|(title, found)| {
        if !found.passes {
            say(&format!("{title} fails without a mutant and is left out"));
        }
        records.0.insert(title, found);
    });
    records.save(&path)?;
    Ok(records)
}

fn record_one(folder: &Folder, worker: usize, sample: &Sample, test: &Test) -> Result<Recorded> {
    let path = folder.state(&format!("reached-{worker}.txt"));
    at(&path, fs::write(&path, ""))?;
    let absolute = at(&path, path.canonicalize())?;
    let variable = ("TRIGON_MUTANTS_REACHED", &*absolute.to_string_lossy());
    let (end, time) = run_test(test, variable, LIMIT)?;
    let text = at(&path, fs::read_to_string(&path))?;
    let numbers = text.lines().filter_map(|line| line.parse().ok());
    let mut reached: Vec<u32> = numbers.filter(|number| *number as usize <= sample.drawn.len()).collect();
    // A test's child processes write, too.
    reached.sort_unstable();
    reached.dedup();
    let milliseconds = u64::try_from(time.as_millis()).unwrap_or(u64::MAX);
    Ok(Recorded { version: test.version, passes: end == End::Passed, milliseconds, reached })
}
