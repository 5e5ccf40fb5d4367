//! Standard output: lines of text, lines of JSON, and the line of an input that failed.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;

use crate::failure::Failure;
use crate::report::Reporter;
use crate::source::Source;

/// One JSON object on a line of standard output; returns the exit code.
pub(crate) fn json_line(facts: &impl Serialize, reporter: Reporter) -> u8 {
    exit_code(write_json(facts), reporter)
}

/// One JSON object on a line of standard output.
pub(crate) fn write_json(facts: &impl Serialize) -> Result<(), Failure> {
    let mut stdout = io::BufWriter::new(io::stdout().lock());
    let written = serde_json::to_writer(&mut stdout, facts).map_err(io::Error::from);
    report(written.and_then(|()| writeln!(stdout)).and_then(|()| stdout.flush()))
}

/// Writes lines to standard output; returns the exit code.
pub(crate) fn print_lines(lines: impl IntoIterator<Item = String>, reporter: Reporter) -> u8 {
    exit_code(write_lines(lines), reporter)
}

/// Writes lines to standard output.
pub(crate) fn write_lines(lines: impl IntoIterator<Item = String>) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    let written = lines.into_iter().try_for_each(|line| writeln!(stdout, "{line}"));
    // What is left in the buffer would be written at the end of the program, where nobody is told of an error.
    report(written.and_then(|()| stdout.flush()))
}

/// Why standard output was not written; whoever closes it early wanted no more.
fn report(written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::work(format!(
            "standard output cannot be written ({error}); check that its destination is writable and has room"
        ))),
        _ => Ok(()),
    }
}

fn exit_code(written: Result<(), Failure>, reporter: Reporter) -> u8 {
    match written {
        Ok(()) => 0,
        Err(failure) => {
            reporter.error(&failure);
            failure.exit_code()
        }
    }
}

/// Why there is nothing about an input.
#[derive(Serialize)]
struct FailureFacts {
    file: Option<String>,
    failure: String,
    exit_code: u8,
}

/// Reports a failure, with `as_json` also on a line of its own, so that there is one for each input. Returns
/// the exit code.
pub(crate) fn report_failure(source: &Source, failure: &Failure, as_json: bool, reporter: Reporter) -> u8 {
    if let Failure::Reported(exit_code) = failure {
        return *exit_code;
    }
    reporter.error(failure);
    let exit_code = failure.exit_code();
    exit_code.max(if as_json { write_failure(source.first_file(), failure, reporter) } else { 0 })
}

/// Writes the line of an input of which there is nothing to tell; returns the exit code of writing.
pub(crate) fn write_failure(file: Option<&Path>, failure: &Failure, reporter: Reporter) -> u8 {
    let file = file.map(|file| file.to_string_lossy().into_owned());
    let facts = FailureFacts { file, failure: failure.to_string(), exit_code: failure.exit_code() };
    json_line(&facts, reporter)
}
