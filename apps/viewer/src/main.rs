//! The viewer: shows models in a window, or renders them to image files.
//!
//! It only assembles: flags come from [`args`], scenes from `trigon-io`, images from
//! `trigon-scene`, the window from `trigon-window`. Errors become one line on standard error and an
//! exit code here.

mod args;
mod axes;
mod batch;
mod check;
mod compare;
mod drawing;
mod exact_camera;
mod explain;
mod facts;
mod failure;
mod folders;
mod framing;
mod frontier;
mod image;
mod image_series;
mod inputs;
mod ladder;
mod lettering;
mod lists;
mod loading;
mod look;
mod model;
mod moment;
mod outlet;
mod pixel;
mod replay;
mod report;
mod scenery;
mod scripted;
mod series;
mod source;
mod state;
mod stdout;
#[cfg(feature = "window")]
mod window;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use crate::args::{BatchArgs, CommandLine, HelpLength, Mode, RawArgs, Request};
use crate::report::{Level, Reporter};

fn main() -> ExitCode {
    if let Err(error) = trigon_io::end_on_signals() {
        Reporter::new(Level::Warning)
            .warning(format_args!("temporary files may stay when this program is interrupted ({error})"));
    }
    let mut words = std::env::args_os().skip(1).peekable();
    if words.next_if(|word| word == "batch").is_some() {
        return ExitCode::from(draw_batch(words));
    }
    let read = CommandLine::new(words).and_then(|line| Ok((line.raw(None)?, line)));
    let (raw, line) = match read {
        Ok(read) => read,
        Err(answer) => return ExitCode::from(said_by_clap(&answer)),
    };
    if let Some(length) = raw.help {
        return ExitCode::from(help(length, Reporter::new(raw.verbose)));
    }
    let file = raw.files.iter().chain(&raw.input).next();
    let mut request = match Request::from_line(&line, file.map(PathBuf::as_path)) {
        Ok(request) => request,
        Err(mistake) => return ExitCode::from(said_by_clap(&mistake)),
    };
    let reporter = Reporter::new(request.level);
    for warning in &request.ignored {
        reporter.warning(warning);
    }
    if let Err(failure) = loading::light(&mut request, reporter) {
        reporter.error(&failure);
        return ExitCode::from(failure.exit_code());
    }
    ExitCode::from(match &request.mode {
        Mode::Image { output, capture } => {
            let run = if request.script.is_some() { scripted::run } else { image::run };
            run(&request, output.as_ref(), capture.as_deref(), reporter)
        }
        Mode::Compare { other, output } => compare::run(&request, other, output, reporter),
        Mode::Replay { capture, output } => replay::run(capture, output.as_ref(), &request, reporter),
        Mode::Window => look_at(&request, reporter),
        Mode::Explain(explanation) => explain::run(&request, *explanation, reporter),
        Mode::Frontier(output) => frontier::run(&request, output, reporter),
        Mode::ExplainPixel(at) => pixel::run(&request, *at, reporter),
        Mode::Check(purpose) => check::run(&request, *purpose, reporter),
        Mode::Inspect => lists::inspect(&request, reporter),
        Mode::ListReaders => lists::readers(reporter),
        Mode::ListBindings => list_bindings(&request, reporter),
        Mode::ListBackends => lists::backends(reporter),
    })
}

/// `trigon-viewer batch`: draws a list of jobs.
fn draw_batch(words: impl Iterator<Item = OsString>) -> u8 {
    let name = OsString::from("trigon-viewer batch");
    match BatchArgs::try_parse_from(std::iter::once(name).chain(words)) {
        Ok(args) => batch::run(&args),
        Err(answer) => said_by_clap(&answer),
    }
}

/// A mistake on standard error, or the version on standard output; returns the exit code.
fn said_by_clap(answer: &clap::Error) -> u8 {
    if answer.use_stderr() {
        // Nobody listens on a closed standard error.
        let _ = answer.print();
        return answer.exit_code() as u8;
    }
    let text = answer.render().to_string();
    stdout::print_lines(text.lines().map(str::to_owned), Reporter::new(Level::Error))
}

/// The help on standard output.
fn help(length: HelpLength, reporter: Reporter) -> u8 {
    let mut command = RawArgs::command();
    let text = match length {
        HelpLength::Short => args::short_help(&command),
        HelpLength::All => command.render_long_help().to_string(),
    };
    stdout::print_lines(text.lines().map(str::to_owned), reporter)
}

/// `--list-bindings`: the keys under their headings.
#[cfg(feature = "window")]
fn list_bindings(request: &Request, reporter: Reporter) -> u8 {
    stdout::print_lines(window::bindings(request, reporter), reporter)
}

#[cfg(not(feature = "window"))]
fn list_bindings(_: &Request, reporter: Reporter) -> u8 {
    reporter.error("this trigon-viewer was built without its window, so there are no keys; build it with the feature `window`");
    1
}

#[cfg(feature = "window")]
fn look_at(request: &Request, reporter: Reporter) -> u8 {
    window::run(request, reporter)
}

#[cfg(not(feature = "window"))]
fn look_at(_: &Request, reporter: Reporter) -> u8 {
    reporter.error("this trigon-viewer was built without its window; write an image instead with --output image.png, or build it with the feature `window`");
    1
}
