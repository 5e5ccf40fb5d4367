//! The command line.

use std::path::PathBuf;

use clap::Parser;

/// Edit polygon meshes and scenes, in a window or by a script.
///
/// Without --run a window opens on the files. A script is a list of commands as JSON; --list-commands tells all
/// of them. The result is written whole or not at all, and a file that it replaces is kept with `.bak` at the
/// end of its name. Exit codes: 0 done, 1 something failed, 2 wrong usage.
#[derive(Debug, Parser)]
#[command(name = "trigon-editor", version)]
pub(crate) struct Arguments {
    /// The model or scene to edit; a window starts with a cube if none is given, a script with an empty scene.
    #[arg(value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,

    /// The script to run, without a window.
    #[arg(long, value_name = "SCRIPT", requires = "output")]
    pub(crate) run: Option<PathBuf>,

    /// Where the result of a script goes: a GLB that other programs open, too.
    #[arg(long, short, value_name = "FILE", requires = "run")]
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

    /// Tell all keys of the window as a keymap file, to be changed and kept in the configuration folder as
    /// trigon/editor-keymap.json.
    #[cfg(feature = "window")]
    #[arg(long)]
    pub(crate) print_keymap: bool,
}
