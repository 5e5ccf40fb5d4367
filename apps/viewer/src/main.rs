//! The viewer: looks at models in a window, or turns them into picture files.
//!
//! It only assembles: flags come from [`args`], scenes from `trigon-io`,
//! pictures from `trigon-scene`, the window from `trigon-window`. What can go
//! wrong becomes one line on standard error and an exit code here.

mod args;
mod explain;
mod failure;
mod framing;
mod lists;
mod loading;
mod look;
mod model;
mod moment;
mod picture;
mod replay;
mod report;
mod study;
#[cfg(feature = "window")]
mod window;

use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};

use crate::args::{Command, Mode, RawArgs, Request};
use crate::report::Reporter;

fn main() -> ExitCode {
    let raw = RawArgs::parse();
    if let Some(Command::Study(arguments)) = &raw.command {
        return ExitCode::from(study::run(arguments, Reporter::new(raw.verbose)));
    }
    let mut request = Request::new(raw)
        .unwrap_or_else(|message| RawArgs::command().error(ErrorKind::ArgumentConflict, message).exit());
    let reporter = Reporter::new(request.level);
    for flag in &request.ignored {
        reporter.warning(format_args!("{flag} is ignored: trigon draws on the CPU and has no such choice"));
    }
    if let Err(failure) = loading::light(&mut request, reporter) {
        reporter.error(&failure);
        return ExitCode::from(failure.exit_code());
    }
    ExitCode::from(match &request.mode {
        Mode::Picture { output, capture } => {
            picture::run(&request, output.as_ref(), capture.as_deref(), reporter)
        }
        Mode::Replay { capture, output } => replay::run(capture, output.as_ref(), &request, reporter),
        Mode::Window => look_at(&request, reporter),
        Mode::Explain(explanation) => explain::run(&request, *explanation, reporter),
        Mode::Inspect => lists::inspect(&request, reporter),
        Mode::ListReaders => lists::readers(reporter),
        Mode::ListBindings => lists::bindings(reporter),
    })
}

#[cfg(feature = "window")]
fn look_at(request: &Request, reporter: Reporter) -> u8 {
    window::run(request, reporter)
}

#[cfg(not(feature = "window"))]
fn look_at(_: &Request, reporter: Reporter) -> u8 {
    reporter.error("this trigon-viewer was built without its window; write a picture instead with --output picture.png, or build it with the feature `window`");
    1
}
