//! Programs that are run: cargo, and one test at a time.

use crate::error::{Error, Result, at};
use crate::tests_of::Test;
use crate::{CRATES, Folder};
use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::Duration;

/// Progress, for the person who waits.
#[expect(clippy::print_stderr, reason = "a program that says what it is doing")]
pub(crate) fn say(text: &str) {
    eprintln!("{text}");
}

/// A cargo command for these crates in the copy. Warnings of all mutants are in its output, so it is not shown.
fn cargo(folder: &Folder, command: &str, crates: &[&str]) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.args([command, "--message-format=json", "--quiet", "--lib"]);
    for krate in crates {
        cargo.args(["-p", &format!("trigon-{krate}")]);
    }
    if crates.contains(&"window") {
        cargo.args(["--features", "trigon-window/kittest"]);
    }
    cargo.current_dir(folder.tree()).env("CARGO_TARGET_DIR", folder.target()).env("CARGO_INCREMENTAL", "0");
    cargo
}

fn output(mut cargo: Command, errors: &Path) -> Result<(String, bool)> {
    let log = at(errors, File::create(errors))?;
    let output = cargo.stderr(log).output();
    let failed =
        |error: std::io::Error| Error::Program { program: "cargo".into(), message: error.to_string() };
    let output = output.map_err(failed)?;
    Ok((String::from_utf8_lossy(&output.stdout).into_owned(), output.status.success()))
}

/// The compiler's messages about the mutated crates.
pub(crate) fn check(folder: &Folder, crates: &[&str]) -> Result<String> {
    let mut command = cargo(folder, "check", crates);
    command.arg("--keep-going");
    Ok(output(command, &folder.state("cargo.log"))?.0)
}

/// Builds the crates' test programs, for all crates also those of the workspace, and keeps cargo's list of them.
pub(crate) fn build_tests(folder: &Folder, crates: &[&str]) -> Result<()> {
    let mut command = cargo(folder, "test", crates);
    command.args(["--no-run", "--bins", "--tests"]);
    if crates.len() == CRATES.len() {
        command.args(["-p", "trigon-tests"]);
    }
    let log = folder.state("cargo.log");
    let (messages, succeeds) = output(command, &log)?;
    if !succeeds {
        return Err(Error::Compile(format!("see {}, or run cargo test in the copy", log.display())));
    }
    let path = folder.state("artifacts.jsonl");
    let artifacts = messages.lines().filter(|line| line.contains("\"reason\":\"compiler-artifact\""));
    at(&path, std::fs::write(&path, artifacts.collect::<Vec<_>>().join("\n")))
}

/// So many times its limit of processor time a test may take on the clock.
const PATIENCE: u32 = 10;

/// How a test ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    Passed,
    Failed,
    TimedOut,
}

/// Runs one test alone, with a variable that says what the switches do. The limit is one of processor time, so a loaded
/// machine ends no test that would pass. A test that waits for ever uses none: after [`PATIENCE`] times the limit it is
/// ended, too.
pub(crate) fn run_test(test: &Test, variable: (&str, &str), limit: Duration) -> Result<(End, Duration)> {
    let failed = |error: std::io::Error| Error::File { path: test.program.clone(), error };
    // Mutants that allocate without end must not take the machine with them.
    let mut command = Command::new("sh");
    command
        .args(["-c", "ulimit -v 16000000; ulimit -t \"$0\"; exec \"$@\""])
        .arg(limit.as_secs().to_string())
        .arg(&test.program)
        .args(["--exact", &test.name, "--test-threads=1"])
        .current_dir(&test.home)
        .env("CARGO_MANIFEST_DIR", &test.home)
        // Every process draws the same cases and leaves none behind; the first failure is enough.
        .env("PROPTEST_RNG_SEED", crate::draw::SEED.to_string())
        .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "1")
        .env("PROPTEST_MAX_SHRINK_ITERS", "0")
        .env(variable.0, variable.1)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    // A group that can be ended with all that the test starts. Elsewhere the program is built, but cannot run.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let mut child = command.spawn().map_err(failed)?;
    let (status, time) = wait(&mut child, limit * PATIENCE).map_err(failed)?;
    let end = match status {
        Some(status) if status.success() => End::Passed,
        Some(status) if has_run_out(status) => End::TimedOut,
        Some(_) => End::Failed,
        None => End::TimedOut,
    };
    Ok((end, time))
}

/// Whether a program was ended because it had used its processor time.
fn has_run_out(status: ExitStatus) -> bool {
    /// SIGXCPU on Linux and macOS.
    const OUT_OF_TIME: i32 = 24;
    #[cfg(unix)]
    let signal = std::os::unix::process::ExitStatusExt::signal(&status);
    #[cfg(not(unix))]
    let (signal, _) = (None, status);
    signal == Some(OUT_OF_TIME)
}

/// How the child ended, and after how long; `None` after the limit: then the test and all that it started are
/// ended. Pauses are added up instead of looking at a clock, which goes on while the machine sleeps.
fn wait(child: &mut Child, limit: Duration) -> std::io::Result<(Option<ExitStatus>, Duration)> {
    let (mut pause, mut waited) = (Duration::from_millis(1), Duration::ZERO);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok((Some(status), waited));
        }
        if waited > limit {
            let group = format!("-{}", child.id());
            Command::new("kill").args(["-KILL", "--", &group]).status()?;
            child.wait()?;
            return Ok((None, waited));
        }
        thread::sleep(pause);
        waited += pause;
        pause = (pause * 2).min(Duration::from_millis(20));
    }
}
