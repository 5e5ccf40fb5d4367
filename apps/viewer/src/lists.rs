//! Text on standard output: lists of formats and keys, and the contents of a file.

use std::io::{self, Write};

use serde::Serialize;

use crate::args::Request;
use crate::facts::ModelFacts;
use crate::failure::Failure;
use crate::loading;
use crate::report::Reporter;
use crate::source::Source;

/// `--list-readers`: one line per format.
pub(crate) fn readers(reporter: Reporter) -> u8 {
    let line = |reader: &trigon_io::Reader| {
        let endings: Vec<String> = reader.extensions.iter().map(|ending| format!(".{ending}")).collect();
        format!("{:12} {:24} {}", endings.join(" "), reader.name, reader.reads)
    };
    print_lines(trigon_io::readers().map(line), reporter)
}

/// `--list-rendering-backends`: the one that there is.
pub(crate) fn backends(reporter: Reporter) -> u8 {
    let levels = trigon_scene::SimdLevel::ALL.into_iter().filter(|level| level.is_supported());
    let levels: Vec<String> = levels.map(|level| level.to_string()).collect();
    print_lines([format!("cpu: available, with {} (--simd)", levels.join(", "))], reporter)
}

/// One JSON object on a line of standard output; returns the exit code.
pub(crate) fn json_line(facts: &impl Serialize, reporter: Reporter) -> u8 {
    exit_code(write_json(facts), reporter)
}

/// One JSON object on a line of standard output.
pub(crate) fn write_json(facts: &impl Serialize) -> Result<(), Failure> {
    let mut stdout = io::BufWriter::new(io::stdout().lock());
    let written = serde_json::to_writer(&mut stdout, facts).map_err(io::Error::from);
    told(written.and_then(|()| writeln!(stdout)).and_then(|()| stdout.flush()))
}

/// `--no-render`: what is in each file.
pub(crate) fn inspect(request: &Request, reporter: Reporter) -> u8 {
    let mut unwritten = 0;
    let unread = Source::visit_all(request, reporter, |source, request| {
        let model = loading::load_aloud(source, request, reporter)?;
        if request.json {
            let facts = ModelFacts::new(&model, &model.summary());
            unwritten = unwritten.max(json_line(&facts, reporter));
            return Ok(());
        }
        let facts = model.summary().lines().into_iter().chain(model.choices());
        let facts = facts.map(|fact| format!("  {fact}"));
        let code = print_lines(std::iter::once(source.title()).chain(facts), reporter);
        unwritten = unwritten.max(code);
        Ok(())
    });
    unread.max(unwritten)
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
    told(written.and_then(|()| stdout.flush()))
}

/// Why standard output was not written; whoever closes it early wanted no more.
fn told(written: io::Result<()>) -> Result<(), Failure> {
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
