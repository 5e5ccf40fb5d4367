//! The destination of finished images: files by their extensions, or standard output.

use std::collections::HashSet;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use trigon_io::{
    Pixels, Sequence, WriteError, encode_png, write_apng, write_exr, write_gif, write_jpeg, write_npy,
    write_origin_npy, write_png, write_png16, write_webp,
};
use trigon_scene::Frame;

use crate::args::{Beside, Destination, Format, Request, Subject};
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::report::Reporter;

/// Where finished images go.
pub(crate) struct Outlet<'a> {
    output: Option<&'a Destination>,
    pub(crate) beside: &'a [Beside],
    taken: HashSet<PathBuf>,
    /// What must not be overwritten.
    pub(crate) inputs: Inputs,
    /// All files that were written, in their order.
    pub(crate) written: Vec<PathBuf>,
    reporter: Reporter,
}

impl<'a> Outlet<'a> {
    /// Of what a request reads, nothing is overwritten.
    pub(crate) fn new(output: Option<&'a Destination>, request: &Request, reporter: Reporter) -> Self {
        let inputs = Inputs::of(request);
        Self { output, beside: &[], taken: HashSet::new(), inputs, written: Vec::new(), reporter }
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
        self.take(&path)?;
        write_origin_npy(&path, frame).map_err(|error| unwritten(&path, error))?;
        let [x, y, z] = frame.origin.to_array();
        self.said(&path, format_args!("add it to the positions: {x}, {y}, {z}"));
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
        self.take(path)?;
        write(path, frame)?;
        let (width, height) = (frame.width, frame.height);
        self.said(path, format_args!("{width}×{height}"));
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
        self.take(&path)?;
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
            write_gif(&path, sequence, &mut bytes)
        } else {
            write_apng(&path, sequence, &mut bytes)
        };
        match (failed, written) {
            (Some(failure), _) => return Err(failure),
            (None, written) => written.map_err(|error| unwritten(&path, error))?,
        }
        let Sequence { width, height, frames, .. } = sequence;
        self.said(&path, format_args!("{width}×{height}, {frames} frames"));
        Ok(())
    }

    fn take(&mut self, path: &Path) -> Result<(), Failure> {
        self.inputs.refuse(path)?;
        if self.taken.insert(path.to_owned()) {
            return Ok(());
        }
        Err(Failure::Usage(format!(
            "{}: two images would be written to it; write {{n}} in the name of --output (--output '{{model}}_{{n}}.png'), or {{frame}} for views",
            path.display()
        )))
    }

    fn said(&mut self, path: &Path, what: std::fmt::Arguments<'_>) {
        self.reporter.info(format_args!("wrote {} ({what})", path.display()));
        self.written.push(path.to_owned());
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

/// Why a file was not written. That its folder is missing is told before what the system says.
fn unwritten(path: &Path, error: WriteError) -> Failure {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    match (error, folder) {
        (WriteError::File { .. }, Some(folder)) if !folder.exists() => Failure::work(format!(
            "{}: the folder {} does not exist; create it, or name another",
            path.display(),
            folder.display()
        )),
        (error @ WriteError::File { .. }, _) => Failure::work(error),
        (other, _) => Failure::work(format!("{}: {other}", path.display())),
    }
}
