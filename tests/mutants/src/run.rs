//! Runs the tests against each mutant.

use crate::Folder;
use crate::draw::{Drawn, Sample};
use crate::error::Result;
use crate::process::{End, run_test, say};
use crate::record::{Records, record};
use crate::results::{Found, Outcome, Results, load, save};
use crate::tests_of::{Test, judging};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Tests that run at the same time.
const WORKERS: usize = 2;

/// How much processor time a test may use that takes `usual` without a mutant.
fn limit(usual: Duration) -> Duration {
    Duration::from_secs(20) + usual * 10
}

/// Does the work for each item on all workers, which are told their number; stops at the first error.
pub(crate) fn in_turns<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(usize, &T) -> Result<R> + Sync,
) -> Result<Vec<R>> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for worker in 0..WORKERS {
            let (next, results, work) = (&next, &results, &work);
            scope.spawn(move || {
                while let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let result = work(worker, item);
                    if result.is_err() {
                        next.store(items.len(), Ordering::Relaxed);
                    }
                    results.lock().expect("no worker panics while it holds the lock").push(result);
                }
            });
        }
    });
    results.into_inner().expect("no worker panics while it holds the lock").into_iter().collect()
}

/// Tests the mutants of a crate that have no result yet or survived.
pub(crate) fn run(folder: &Folder, krate: &'static str) -> Result<()> {
    let sample = Sample::load(&folder.state("sample.json"))?;
    say(&format!("trigon-{krate}"));
    let tests = judging(folder, krate)?;
    let records = record(folder, &sample, &tests)?;
    let results = Mutex::new(load(folder, krate)?);
    let open: Vec<(u32, &Drawn)> = sample.of(krate).filter(|(_, mutant)| is_open(&results, mutant)).collect();
    in_turns(&open, |_, (number, mutant)| {
        let mut found = judge(*number, &tests, &records)?;
        say(&format!("{:?}: {}", found.outcome, mutant.identity));
        let mut results = results.lock().expect("no worker panics while it holds the lock");
        let old = results.get(&mutant.identity);
        found.survived_before = old.is_some_and(|old| old.survived_before || !old.outcome.is_detected());
        results.insert(mutant.identity.clone(), found);
        save(folder, krate, &results)
    })?;
    Ok(())
}

fn is_open(results: &Mutex<Results>, mutant: &Drawn) -> bool {
    let results = results.lock().expect("no worker panics while it holds the lock");
    results.get(&mutant.identity).is_none_or(|found| !found.outcome.is_detected())
}

/// Runs the tests that reach a mutant until one fails.
fn judge(number: u32, tests: &[Test], records: &Records) -> Result<Found> {
    let reaching = records.reaching(number, tests);
    for (index, (test, usual)) in reaching.iter().enumerate() {
        let (end, _) = run_test(test, ("TRIGON_MUTANT", &number.to_string()), limit(*usual))?;
        let outcome = match end {
            End::Passed => continue,
            End::Failed => Outcome::Caught,
            End::TimedOut => Outcome::TimedOut,
        };
        return Ok(Found { outcome, by: Some(test.title()), tests: index + 1, survived_before: false });
    }
    let outcome = if reaching.is_empty() { Outcome::NotReached } else { Outcome::Survived };
    Ok(Found { outcome, by: None, tests: reaching.len(), survived_before: false })
}
