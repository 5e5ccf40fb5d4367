//! The editor: a window on a document, or scripts of commands without one. It is a library, so that its
//! program and its benchmarks ([`measured_editor`]) share the code.
//!
//! It only assembles: documents and commands come from `trigon-document`, files from `trigon-io`.
//! Errors become one line on standard error and an exit code here.

mod arguments;
mod export;
#[cfg(feature = "window")]
mod icon;
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
mod up;
#[cfg(feature = "window")]
mod uv;
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
    if let Err(error) = trigon_io::end_on_signals() {
        report("warning", &format!("temporary files may stay when this program is interrupted ({error})"));
    }
    let result = match Arguments::try_parse() {
        Ok(arguments) => done(&arguments),
        Err(mistake) if mistake.use_stderr() => mistake.exit(),
        Err(answer) => print(&answer.render().to_string()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            report("error", &message);
            ExitCode::FAILURE
        }
    }
}

fn done(arguments: &Arguments) -> Result<(), String> {
    if arguments.list_commands {
        return print(&format!("{}\n", trigon_document::command_reference()));
    }
    #[cfg(feature = "window")]
    if arguments.print_keymap {
        return print(&format!("{}\n", window::keymap()));
    }
    if arguments.run.is_some() { run::run(arguments) } else { edit(arguments) }
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
fn print(text: &str) -> Result<(), String> {
    use std::io::{ErrorKind, Write, stdout};
    let mut stdout = stdout().lock();
    // What is left in the buffer would be written at the end of the program, where nobody is told of an error.
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!(
            "standard output cannot be written ({error}); check that its destination is writable and has room"
        )),
        _ => Ok(()),
    }
}
