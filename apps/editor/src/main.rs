//! The editor: runs scripts of commands on models, without a window.
//!
//! It only assembles: documents and commands come from `trigon-edit`, files from `trigon-io`. What
//! can go wrong becomes one line on standard error and an exit code here.

mod arguments;
mod export;
#[cfg(feature = "window")]
#[expect(dead_code, unused_imports, reason = "for the window, which does not call it yet")]
mod overlay;
#[cfg(feature = "window")]
#[expect(dead_code, unused_imports, reason = "the window that shows the panels comes next")]
mod panel;
#[cfg(feature = "window")]
mod request;
mod run;
#[cfg(feature = "window")]
#[cfg_attr(not(test), expect(dead_code, reason = "for the window, which does not call it yet"))]
mod show;
#[cfg(feature = "window")]
#[expect(dead_code, unused_imports, reason = "the window that starts the tools is merged after them")]
mod tool;

use std::process::ExitCode;

use clap::Parser;

use arguments::Arguments;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if arguments.list_commands {
        print_line(&trigon_edit::command_reference());
        return ExitCode::SUCCESS;
    }
    match run::run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            report("error", &message);
            ExitCode::FAILURE
        }
    }
}

/// A line on standard error.
#[expect(clippy::print_stderr, reason = "programs report here")]
fn report(kind: &str, message: &str) {
    eprintln!("{kind}: {message}");
}

/// A text on standard output. A reader that went away wants no more.
fn print_line(text: &str) {
    use std::io::Write;
    drop(writeln!(std::io::stdout().lock(), "{text}"));
}
