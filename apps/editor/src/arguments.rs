//! The command line.

use std::path::PathBuf;

use clap::Parser;
use trigon_io::UpAxis;

/// Edit polygon meshes and scenes, in a window or by a script.
///
/// Without --run a window opens on the files. A script is a list of commands as JSON, such as
/// `[{"op":"add_object","object":{"shape":"cube","edge":2}},{"op":"translate","offset":[0,1,0]}]`; it starts with the
/// file that is given, or with nothing. --list-commands tells all commands, with a longer example. The result is written whole or not at all, and a file that it replaces is kept with `.bak` at the
/// end of its name. Exit codes: 0 done, 1 something failed, 2 wrong usage.
#[derive(Debug, Default, Parser)]
#[command(name = "trigon-editor", version)]
pub(crate) struct Arguments {
    /// The model or scene to edit; a window starts with a cube if none is given, a script with an empty scene.
    #[arg(value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,

    /// The script to run, without a window.
    #[arg(long, value_name = "SCRIPT", requires = "output")]
    pub(crate) run: Option<PathBuf>,

    /// Where the result of a script goes: .glb, .obj, .ply, .stl, .off or .3mf
    ///
    /// A .glb is the editor's own file, which other programs open, too; the others, and a .glb with
    /// one of --up, --scale, --selection-only and --no-modifiers, are for other programs alone, and what they cannot
    /// hold is said. Materials and images of an .obj lie beside it.
    #[arg(long, short, value_name = "FILE", requires = "run")]
    pub(crate) output: Option<PathBuf>,

    /// Write the file although something of the loaded one would be lost.
    #[arg(long)]
    pub(crate) accept_losses: bool,

    /// Which axis is up in the result: +X, -X, +Y, -Y, +Z or -Z [default: +Z for .stl and .3mf, +Y for others].
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub(crate) up: Option<UpAxis>,

    /// Which axis is up in the files that are opened or imported [default: +Z in .stl and .3mf, +Y in others].
    ///
    /// The editor itself has +Y up: files with another axis are turned, without rounding.
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub(crate) import_up: Option<UpAxis>,

    /// Units of the result per metre, such as 1000 for millimetres.
    #[arg(long, value_name = "FACTOR", value_parser = scale)]
    pub(crate) scale: Option<f64>,

    /// Write the objects only that are selected when the script ends.
    #[arg(long)]
    pub(crate) selection_only: bool,

    /// Write meshes as they are edited, without their modifiers.
    #[arg(long)]
    pub(crate) no_modifiers: bool,

    /// Cut polygons into triangles.
    #[arg(long)]
    pub(crate) triangulate: bool,

    /// Write .ply and .stl as text instead of binary.
    #[arg(long)]
    pub(crate) ascii: bool,

    /// How many GiB of memory a command may let a mesh take [default: 4].
    ///
    /// A command for which that is too little is refused before it begins.
    #[arg(long, value_name = "GIB", value_parser = gibibytes)]
    pub(crate) memory: Option<u64>,

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

/// In bytes.
fn gibibytes(text: &str) -> Result<u64, String> {
    let number = text.parse().ok().filter(|number: &f64| *number > 0.0 && number.is_finite());
    let bytes = number.map(|number| (number * f64::from(1 << 30)) as u64);
    bytes.ok_or_else(|| "write a number greater than 0, such as 16".to_owned())
}

fn scale(text: &str) -> Result<f64, String> {
    let factor = text.parse().ok().filter(|factor: &f64| *factor > 0.0 && factor.is_finite());
    factor.ok_or_else(|| "write a number greater than 0, such as 1000".to_owned())
}
