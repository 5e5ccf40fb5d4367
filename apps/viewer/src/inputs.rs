//! The files that a command reads: none of them is overwritten.

use std::path::{Path, PathBuf};

use trigon_io::FileIdentity;

use crate::args::{Mode, Request};
use crate::failure::Failure;

/// The files that a command reads, by what they are: an output may have another name of the same file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inputs(Vec<(FileIdentity, PathBuf)>);

impl Inputs {
    /// What the command line names. The files that models refer to are [added](Self::add) when they are read.
    pub(crate) fn of(request: &Request) -> Self {
        let of_mode = match &request.mode {
            Mode::Replay { capture, .. } => Some(capture),
            Mode::Compare { other, .. } => Some(other),
            _ => None,
        };
        let reference = request.reference.as_ref().map(|reference| &reference.file);
        let played = request.window.interaction_play.as_ref();
        let cameras = request.sequence.cameras.as_ref();
        // Those of a model of COLMAP are in a folder.
        let colmap = ["cameras.txt", "images.txt"].map(|name| cameras.map(|folder| folder.join(name)));
        let named =
            [of_mode, cameras, reference, request.environment.as_ref(), request.script.as_ref(), played];
        let mut inputs = Self::default();
        inputs.add(&request.files);
        inputs.add(named.into_iter().flatten());
        inputs.add(colmap.iter().flatten());
        inputs.add(request.look.textures.files());
        inputs.add(request.line.files());
        inputs
    }

    /// Adds files that were read. Those that are not there, such as standard input, are no files.
    pub(crate) fn add<'a>(&mut self, files: impl IntoIterator<Item = &'a PathBuf>) {
        let known = files.into_iter().filter_map(|file| Some((FileIdentity::of(file).ok()?, file.clone())));
        self.0.extend(known);
    }

    /// Those that are files, by name.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = self.0.iter().map(|(_, path)| path.clone()).collect();
        files.retain(|path| path.is_file());
        files.sort();
        files.dedup();
        files
    }

    /// Refuses an output that is one of them.
    pub(crate) fn refuse(&self, output: &Path) -> Result<(), Failure> {
        let identity = FileIdentity::of(output).ok();
        let Some((_, input)) = self.0.iter().find(|(known, _)| identity.as_ref() == Some(known)) else {
            return Ok(());
        };
        let is_same = if input == output { String::new() } else { format!(" (it is {})", input.display()) };
        Err(Failure::Usage(format!(
            "{}: is read by this very command{is_same} and would be lost; write to another file",
            output.display()
        )))
    }
}
