//! The editor: a window on a document, or scripts of commands without one. It is a library, so that its
//! program and its benchmarks ([`measured_editor`]) share the code.
//!
//! It only assembles: documents and commands come from `trigon-edit`, files from `trigon-io`.
//! Errors become one line on standard error and an exit code here.

mod arguments;
mod export;
#[cfg(feature = "window")]
mod overlay;
#[cfg(feature = "window")]
mod panel;
mod report;
#[cfg(feature = "window")]
mod request;
mod run;
#[cfg(feature = "window")]
mod show;
#[cfg(feature = "window")]
mod tool;
#[cfg(feature = "window")]
mod window;

use std::process::ExitCode;

use clap::Parser;

use arguments::Arguments;
use report::report;

#[cfg(feature = "window")]
pub use window::measured_editor;

/// The program: parses the command line and runs it.
#[must_use]
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if arguments.list_commands {
        print_line(&trigon_edit::command_reference());
        return ExitCode::SUCCESS;
    }
    #[cfg(feature = "window")]
    if arguments.print_keymap {
        print_line(&window::keymap());
        return ExitCode::SUCCESS;
    }
    let result = if arguments.run.is_some() { run::run(&arguments) } else { edit(&arguments) };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            report("error", &message);
            ExitCode::FAILURE
        }
    }
}

#[cfg(feature = "window")]
fn edit(arguments: &Arguments) -> Result<(), String> {
    window::run(arguments)
}

#[cfg(not(feature = "window"))]
fn edit(_: &Arguments) -> Result<(), String> {
    Err("this trigon-editor was built without its window; run a script with --run script.json --output FILE, or build it with the feature `window`".into())
}

/// Text on standard output. A reader that closed the pipe is no error.
fn print_line(text: &str) {
    use std::io::Write;
    drop(writeln!(std::io::stdout().lock(), "{text}"));
}
