//! The destination of finished images: files by their extensions, or standard output.

use std::collections::HashSet;
use std::fs;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use serde_json::Value;
use trigon_io::{
    Pixels, Sequence, WriteError, encode_png, write_apng, write_exr, write_gif, write_jpeg, write_npy,
    write_origin_npy, write_png, write_png16, write_webp,
};
use trigon_scene::Frame;

use crate::args::{Beside, Destination, Format, Request, Subject};
use crate::facts::ImageFacts;
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::report::Reporter;
use crate::stdout::write_json;

/// Where finished images go.
pub(crate) struct Outlet<'a> {
    output: Option<&'a Destination>,
    pub(crate) beside: &'a [Beside],
    pub(crate) folders: Folders<'a>,
    /// The names that no other image may have.
    pub(crate) taken: HashSet<PathBuf>,
    /// What must not be overwritten.
    pub(crate) inputs: Inputs,
    /// All files that were written, in their order.
    pub(crate) written: Vec<OutputFile>,
    /// What is told of each source, if it is kept instead of being written to standard output.
    pub(crate) held_facts: Option<Vec<Value>>,
    reporter: Reporter,
}

/// The folders of the files that are written.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Folders<'a> {
    /// Those of their names, which exist.
    Existing,
    /// Those of their names, which are created.
    Created,
    /// This one for all, under other names: the files are compared and not kept.
    Only(&'a Path),
}

/// A file that was written.
#[derive(Clone, Debug)]
pub(crate) struct OutputFile {
    /// As `--output` has it.
    pub(crate) name: PathBuf,
    /// Where its contents are.
    pub(crate) stored: PathBuf,
}

impl AsRef<Path> for OutputFile {
    fn as_ref(&self) -> &Path {
        &self.name
    }
}

impl<'a> Outlet<'a> {
    /// Of what a request reads, nothing is overwritten.
    pub(crate) fn new(output: Option<&'a Destination>, request: &Request, reporter: Reporter) -> Self {
        let inputs = Inputs::of(request);
        Self {
            output,
            beside: &[],
            folders: Folders::Existing,
            taken: HashSet::new(),
            inputs,
            written: Vec::new(),
            held_facts: None,
            reporter,
        }
    }

    /// Bytes of an image would only garble a terminal.
    pub(crate) fn refuse_terminal(&self) -> Result<(), Failure> {
        if self.output == Some(&Destination::Stdout) && io::stdout().is_terminal() {
            return Err(Failure::Usage(
                "--output - writes an image to standard output, which is a terminal; redirect it (> image.png) or name a file (--output image.png)".to_owned(),
            ));
        }
        Ok(())
    }

    /// Writes an image; returns the file, if it is one.
    pub(crate) fn put(&mut self, subject: Subject<'_>, frame: &Frame) -> Result<Option<PathBuf>, Failure> {
        match self.output {
            None => Ok(None),
            Some(Destination::Stdout) => write_stream(frame).map(|()| None),
            Some(Destination::File(template)) => {
                let path = template.unused(subject);
                let image = self.save(&path, frame, write_file);
                // OpenEXR has them in it.
                let beside = if template.is_exr() { &[] } else { self.beside };
                // One that fails does not keep the others from being written.
                let beside = beside.iter().map(|beside| self.put_beside(*beside, &path, frame));
                let failures = std::iter::once(image).chain(beside).filter_map(Result::err).collect();
                self.first_of(failures)?;
                Ok(Some(path))
            }
        }
    }

    /// The first failure, once the others are reported.
    fn first_of(&self, failures: Vec<Failure>) -> Result<(), Failure> {
        let mut failures = failures.into_iter();
        let first = failures.next();
        failures.for_each(|failure| self.reporter.error(failure));
        first.map_or(Ok(()), Err)
    }

    /// Writes one output to a file of its own, next to the image's.
    fn put_beside(&mut self, beside: Beside, image: &Path, frame: &Frame) -> Result<(), Failure> {
        self.save(&beside.path(image), frame, |path, frame| write_beside(beside, path, frame))?;
        let Some(path) = beside.origin_path(image) else { return Ok(()) };
        let file = self.take(&path)?;
        write_origin_npy(&file.stored, frame).map_err(|error| unwritten(&path, error))?;
        let [x, y, z] = frame.origin.to_array();
        self.said(file, format_args!("add it to the positions: {x}, {y}, {z}"));
        Ok(())
    }

    /// Writes a file and says so. Models of the same name in different folders must
    /// not replace each other's files.
    pub(crate) fn save(
        &mut self,
        path: &Path,
        frame: &Frame,
        write: impl FnOnce(&Path, &Frame) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let file = self.take(path)?;
        write(&file.stored, frame)?;
        let (width, height) = (frame.width, frame.height);
        self.said(file, format_args!("{width}×{height}"));
        Ok(())
    }

    /// Writes a text; an old file of that name is replaced at once or not at all.
    pub(crate) fn save_text(
        &mut self,
        path: &Path,
        text: &str,
        what: std::fmt::Arguments<'_>,
    ) -> Result<(), Failure> {
        let file = self.take(path)?;
        let written = trigon_io::write_atomically(&file.stored, |file| file.write_all(text.as_bytes()));
        written.map_err(|error| unwritten(path, error))?;
        self.said(file, what);
        Ok(())
    }

    /// Writes a GIF or an animated PNG of all frames that `frame` makes.
    pub(crate) fn put_moving(
        &mut self,
        subject: Subject<'_>,
        sequence: &Sequence,
        frame: &mut dyn FnMut(u32) -> Result<Frame, Failure>,
    ) -> Result<(), Failure> {
        let Some(Destination::File(template)) = self.output else { return Ok(()) };
        let path = template.unused(subject);
        let file = self.take(&path)?;
        // What went wrong with a frame, which the writer only passes on.
        let mut failed = None;
        let mut bytes = |number| {
            frame(number).map(|frame| frame.color).map_err(|failure| {
                let error = io::Error::other(failure.to_string());
                failed = Some(failure);
                error
            })
        };
        let is_gif = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gif"));
        let written = if is_gif {
            write_gif(&file.stored, sequence, &mut bytes)
        } else {
            write_apng(&file.stored, sequence, &mut bytes)
        };
        match (failed, written) {
            (Some(failure), _) => return Err(failure),
            (None, written) => written.map_err(|error| unwritten(&path, error))?,
        }
        let Sequence { width, height, frames, .. } = sequence;
        self.said(file, format_args!("{width}×{height}, {frames} frames"));
        Ok(())
    }

    /// Tells what was drawn of a source, if it is kept or `--json` asks for it.
    pub(crate) fn tell<'m>(
        &mut self,
        request: &Request,
        facts: impl FnOnce(&[OutputFile]) -> ImageFacts<'m>,
    ) -> Result<(), Failure> {
        if let Some(held) = &mut self.held_facts {
            held.push(serde_json::to_value(facts(&self.written)).map_err(Failure::work)?);
            return Ok(());
        }
        if request.json { write_json(&facts(&self.written)) } else { Ok(()) }
    }

    /// Reserves a name; returns where the file goes.
    fn take(&mut self, path: &Path) -> Result<OutputFile, Failure> {
        self.inputs.refuse(path)?;
        if self.taken.insert(path.to_owned()) {
            let stored = self.stored(path)?;
            return Ok(OutputFile { name: path.to_owned(), stored });
        }
        Err(Failure::Usage(format!(
            "{}: two images would be written to it; write {{n}} in the name of --output (--output '{{model}}_{{n}}.png'), or {{frame}} for views",
            path.display()
        )))
    }

    /// Where the file of this name goes; its folder exists then, if that is asked for.
    fn stored(&self, name: &Path) -> Result<PathBuf, Failure> {
        match self.folders {
            Folders::Existing => Ok(name.to_owned()),
            Folders::Created => {
                let folder = name.parent().filter(|folder| !folder.as_os_str().is_empty());
                let created = folder.map_or(Ok(()), fs::create_dir_all);
                created.map(|()| name.to_owned()).map_err(|error| {
                    Failure::work(format!(
                        "{}: its folder cannot be created ({error}); check the name and the permissions",
                        name.display()
                    ))
                })
            }
            // The writers go by the extension.
            Folders::Only(folder) => {
                let number = Path::new(&self.taken.len().to_string())
                    .with_extension(name.extension().unwrap_or_default());
                Ok(folder.join(number))
            }
        }
    }

    fn said(&mut self, file: OutputFile, what: std::fmt::Arguments<'_>) {
        self.reporter.info(format_args!("wrote {} ({what})", file.name.display()));
        self.written.push(file);
    }
}

fn write_stream(frame: &Frame) -> Result<(), Failure> {
    encode_png(io::stdout().lock(), frame.width, frame.height, Pixels::Rgba8(&frame.color))
        .map_err(Failure::work)
}

/// Writes an image; an old file of that name is replaced at once or not at all.
pub(crate) fn write_file(path: &Path, frame: &Frame) -> Result<(), Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let (width, height, color) = (frame.width, frame.height, &frame.color);
    let written = match ending.as_deref() {
        Some("exr") => write_exr(path, frame),
        Some("jpg" | "jpeg") => write_jpeg(path, width, height, color),
        Some("webp") => write_webp(path, width, height, color),
        _ => write_png(path, width, height, Pixels::Rgba8(color)),
    };
    written.map_err(|error| unwritten(path, error))
}

/// Writes one output to a file of its own.
fn write_beside(beside: Beside, path: &Path, frame: &Frame) -> Result<(), Failure> {
    let written = match beside.format() {
        Format::Npy => write_npy(path, frame, beside.output),
        Format::Png16 => write_png16(path, frame, beside.output),
    };
    written.map_err(|error| unwritten(path, error))
}

/// Why nothing can be written to a file, if its folder does not exist.
pub(crate) fn missing_folder(path: &Path) -> Option<Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.exists())?;
    Some(Failure::work(format!(
        "{}: the folder {} does not exist; create it, or name another",
        path.display(),
        folder.display()
    )))
}

/// Why a file was not written. That its folder is missing is told before what the system says.
fn unwritten(path: &Path, error: WriteError) -> Failure {
    match (error, missing_folder(path)) {
        (WriteError::File { .. }, Some(failure)) => failure,
        (error @ WriteError::File { .. }, None) => Failure::work(error),
        (other, _) => Failure::work(format!("{}: {other}", path.display())),
    }
}
