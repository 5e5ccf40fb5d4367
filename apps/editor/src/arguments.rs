//! The command line.

use std::path::PathBuf;

use clap::Parser;

/// Edit polygon meshes and scenes by a script, without a window.
///
/// A script is a list of commands as JSON; --list-commands tells all of them. The result is written whole or
/// not at all, and a file that it replaces is kept with `.bak` at the end of its name. Exit
/// codes: 0 done, 1 something failed, 2 wrong usage.
#[derive(Debug, Parser)]
#[command(name = "trigon-editor", version)]
pub(crate) struct Arguments {
    /// The model or scene to edit; an empty scene if none is given.
    pub(crate) file: Option<PathBuf>,

    /// The script to run.
    #[arg(long, value_name = "SCRIPT", required_unless_present = "list_commands")]
    pub(crate) run: Option<PathBuf>,

    /// Where the result goes: a GLB that other programs open, too.
    #[arg(long, short, value_name = "FILE", required_unless_present = "list_commands")]
    pub(crate) output: Option<PathBuf>,

    /// Write the file although something of the loaded one would be lost.
    #[arg(long)]
    pub(crate) accept_losses: bool,

    /// Say nothing but errors.
    #[arg(long, short)]
    pub(crate) quiet: bool,

    /// Tell all commands with their parameters, as Markdown.
    #[arg(long)]
    pub(crate) list_commands: bool,
}
