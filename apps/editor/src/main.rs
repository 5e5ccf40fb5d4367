//! The editor's program; see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    trigon_editor::main()
}
