//! A row of the table, and the files that its case makes.

use std::path::Path;

use trigon_io::{LoadOptions, Loaded, Pixels, encode_png, load};

/// Whose statement it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    Mtl,
}

/// What shows the statement.
#[derive(Clone, Copy, Debug)]
pub(super) enum Case {
    /// Lines of a file that is complete otherwise.
    Lines(&'static str),
    /// A whole file; lines that begin with `> ` are the statement, the others stand
    /// there without it, too.
    File(&'static str),
}

/// What comes of it.
#[derive(Clone, Copy)]
pub(super) enum Effect {
    /// It is read: what it becomes, and a look at the scene.
    Read(&'static str, fn(&Loaded) -> bool),
    /// The scene is the same without it, and why.
    Left(&'static str),
    /// The file is refused.
    Refused,
}

/// A statement, or a way to write it.
pub(super) struct Row {
    pub(super) statement: &'static str,
    pub(super) case: Case,
    pub(super) effect: Effect,
    /// Every warning, or the error.
    pub(super) says: Vec<&'static str>,
}

impl Row {
    /// The statements and options that it is about, as its file has them.
    pub(super) fn keywords(&self) -> Vec<&'static str> {
        let lines: Vec<&str> = match self.case {
            Case::Lines(text) => text.split('\n').collect(),
            Case::File(text) => text.split('\n').filter_map(|line| line.strip_prefix("> ")).collect(),
        };
        let is_option = |word: &&str| word.starts_with('-');
        let keywords = |line: &'static str| {
            let mut words = line.split_whitespace();
            words.next().into_iter().chain(words.filter(is_option))
        };
        lines.into_iter().flat_map(keywords).collect()
    }

    /// With a warning, or with one more.
    pub(super) fn says(mut self, warning: &'static str) -> Self {
        self.says.push(warning);
        self
    }
}

/// A statement that is read.
pub(super) fn read(
    statement: &'static str,
    case: Case,
    becomes: &'static str,
    holds: fn(&Loaded) -> bool,
) -> Row {
    Row { statement, case, effect: Effect::Read(becomes, holds), says: Vec::new() }
}

/// A statement that leaves the scene as it is.
pub(super) fn left(statement: &'static str, case: Case, reason: &'static str) -> Row {
    Row { statement, case, effect: Effect::Left(reason), says: Vec::new() }
}

/// A statement that ends the reading.
pub(super) fn refused(statement: &'static str, case: Case, error: &'static str) -> Row {
    Row { statement, case, effect: Effect::Refused, says: vec![error] }
}

/// What stands before the lines of an OBJ's case, which begin at line 8.
const OBJ_HEAD: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
/// What stands after them.
const OBJ_TAIL: &str = "f 1/1/1 2/1/1 3/1/1 4/1/1\n";
/// The library of that file.
const LIBRARY: &str = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nnewmtl image\nmap_Kd color.png\n";
/// What stands before the lines of a library's case, which begin at line 2.
const MTL_HEAD: &str = "newmtl m\n";
/// The model that shows the library.
const MODEL: &str =
    "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

/// The two files of a case.
pub(super) struct Sample {
    pub(super) model: String,
    pub(super) library: String,
}

impl Sample {
    pub(super) fn with(format: Format, case: &Case) -> Self {
        Self::new(format, case, |line| line)
    }

    /// The same files with empty lines instead of the statement.
    pub(super) fn without(format: Format, case: &Case) -> Self {
        Self::new(format, case, |_| "")
    }

    fn new(format: Format, case: &Case, marked: fn(&'static str) -> &'static str) -> Self {
        let lines = |text: &'static str| -> String {
            text.split('\n').map(|line| format!("{}\n", marked(line))).collect()
        };
        let file = match (format, case) {
            (Format::Obj, Case::Lines(text)) => format!("{OBJ_HEAD}{}{OBJ_TAIL}", lines(text)),
            (Format::Mtl, Case::Lines(text)) => format!("{MTL_HEAD}{}", lines(text)),
            (_, Case::File(text)) => text
                .split('\n')
                .map(|line| format!("{}\n", line.strip_prefix("> ").map_or(line, marked)))
                .collect(),
        };
        match format {
            Format::Obj => Self { model: file, library: LIBRARY.to_owned() },
            Format::Mtl => Self { model: MODEL.to_owned(), library: file },
        }
    }

    /// Loads the files from a folder that has some images, too. The messages name
    /// files without the folder.
    pub(super) fn load(&self) -> Result<(Loaded, Vec<String>), String> {
        let dir = tempfile::tempdir().expect("a folder");
        write_images(dir.path());
        std::fs::write(dir.path().join("a.obj"), &self.model).expect("a model");
        std::fs::write(dir.path().join("m.mtl"), &self.library).expect("a library");
        std::fs::write(dir.path().join("more.mtl"), "newmtl red\nKd 0 1 0\n").expect("a library");
        let folder = format!("{}/", dir.path().display());
        let brief = |message: String| message.replace(&folder, "");
        let loaded = load(dir.path().join("a.obj"), &LoadOptions::default());
        let loaded = loaded.map_err(|error| brief(error.to_string()))?;
        let warnings = loaded.warnings.iter().map(|warning| brief(warning.to_string())).collect();
        Ok((loaded, warnings))
    }
}

/// Colours, directions, heights, and grey. Not by `write_png`, which waits for the disk.
fn write_images(folder: &Path) {
    const COLORS: [u8; 12] = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];
    let write = |name: &str, side: u32, pixels: &[u8]| {
        let mut bytes = Vec::new();
        encode_png(&mut bytes, side, side, Pixels::Rgb8(pixels)).expect("memory takes it");
        std::fs::write(folder.join(name), bytes).expect("an image");
    };
    write("color.png", 2, &COLORS);
    write("normals.png", 1, &[128, 128, 255]);
    write("heights.png", 1, &[51, 51, 51]);
    write("grey.png", 1, &[51, 51, 51]);
}
