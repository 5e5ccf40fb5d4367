//! Picture mode: models in, files of pictures and outputs, a PNG stream or a capture
//! out. No display needed.

use std::collections::HashSet;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::Instant;

use trigon_camera::Camera;
use trigon_io::{Capture, Pixels, WriteError, encode_png, write_exr, write_npy, write_png, write_png16};
use trigon_scene::{Frame, RenderSettings, Renderer};

use crate::args::{Beside, Destination, Format, Limit, Request};
use crate::failure::Failure;
use crate::loading;
use crate::model::{Model, Source};
use crate::report::Reporter;

/// Draws and writes a picture of every source. A source that fails does not
/// keep the others from being drawn; the worst exit code is returned.
pub(crate) fn run(
    request: &Request,
    output: Option<&Destination>,
    capture: Option<&Path>,
    reporter: Reporter,
) -> u8 {
    let mut outlet = Outlet { beside: &request.outputs, ..Outlet::new(output, reporter) };
    Source::visit_all(request, reporter, |source| draw_one(source, request, capture, &mut outlet, reporter))
}

fn draw_one(
    source: &Source,
    request: &Request,
    capture: Option<&Path>,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<(), Failure> {
    outlet.refuse_terminal()?;
    let model = loading::load_aloud(source, request, reporter)?;
    let camera = model.shot(&request.framing, request.settings.aspect())?.camera;
    let (frame, settings) = draw(&model, &camera, request, reporter)?;
    outlet.put(source.first_file(), &frame)?;
    let Some(path) = capture else { return Ok(()) };
    let capture = Capture::new(model.scene, camera, settings, &frame);
    capture.write(path).map_err(Failure::work)?;
    reporter.info(format_args!("captured {} ({:016x})", path.display(), capture.picture_hash()));
    Ok(())
}

/// A picture, and the settings that it was drawn with.
fn draw(
    model: &Model,
    camera: &Camera,
    request: &Request,
    reporter: Reporter,
) -> Result<(Frame, RenderSettings), Failure> {
    let started = Instant::now();
    let mut renderer = Renderer::new(request.settings.clone());
    let frame = match &request.limit {
        None => renderer.render(&model.scene, camera).map_err(Failure::work)?,
        Some(limit) => draw_within(limit, model, camera, (&mut renderer, reporter))?,
    };
    let title = model.source.title();
    if renderer.stats().pixels_shaded == 0 {
        reporter.warning(format_args!(
            "{title}: nothing of the model is in the picture; look from elsewhere (--view=back), or show faces that point away (--backface-type=visible)"
        ));
    }
    let (milliseconds, faces) = (started.elapsed().as_secs_f64() * 1e3, model.face_count());
    reporter.debug(format_args!("drew {title} ({faces} faces) in {milliseconds:.1} ms"));
    Ok((frame, renderer.settings().clone()))
}

/// The most accurate picture that fits into a time; says what that gives up.
fn draw_within(
    limit: &Limit,
    model: &Model,
    camera: &Camera,
    (renderer, reporter): (&mut Renderer, Reporter),
) -> Result<Frame, Failure> {
    let (mut budget, started) = (limit.budget(), Instant::now());
    let clock = &mut || started.elapsed();
    budget.calibrate(renderer, &model.scene, camera, clock).map_err(Failure::work)?;
    let drawing = started.elapsed();
    let (frame, choice) = budget.render(renderer, &model.scene, camera, clock).map_err(Failure::work)?;
    let took = (started.elapsed() - drawing).as_secs_f64() * 1e3;
    reporter.info(format_args!("{}: {choice}; took {took:.1} ms", model.source.title()));
    Ok(frame)
}

/// Where finished pictures go.
pub(crate) struct Outlet<'a> {
    output: Option<&'a Destination>,
    beside: &'a [Beside],
    written: HashSet<PathBuf>,
    reporter: Reporter,
}

impl<'a> Outlet<'a> {
    pub(crate) fn new(output: Option<&'a Destination>, reporter: Reporter) -> Self {
        Self { output, beside: &[], written: HashSet::new(), reporter }
    }

    /// Bytes of a picture would only garble a terminal.
    pub(crate) fn refuse_terminal(&self) -> Result<(), Failure> {
        if self.output == Some(&Destination::Stdout) && io::stdout().is_terminal() {
            return Err(Failure::Usage(
                "--output - writes a picture to standard output, which is a terminal; redirect it (> picture.png) or name a file (--output picture.png)".to_owned(),
            ));
        }
        Ok(())
    }

    /// Writes a picture of what a file holds.
    pub(crate) fn put(&mut self, file: Option<&Path>, frame: &Frame) -> Result<(), Failure> {
        match self.output {
            None => Ok(()),
            Some(Destination::Stdout) => write_stream(frame),
            Some(Destination::File(template)) => {
                let path = template.unused(file);
                self.save(&path, frame, write_file)?;
                // OpenEXR has them in it.
                let beside = if template.is_exr() { &[] } else { self.beside };
                beside.iter().try_for_each(|beside| {
                    self.save(&beside.path(&path), frame, |path, frame| write_beside(*beside, path, frame))
                })
            }
        }
    }

    /// Writes a file and says so. Models of the same name in different folders must
    /// not replace each other's files.
    fn save(
        &mut self,
        path: &Path,
        frame: &Frame,
        write: impl FnOnce(&Path, &Frame) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if !self.written.insert(path.to_owned()) {
            return Err(Failure::Usage(format!(
                "{}: two models would be written to it; write {{n}} in the name of --output (--output '{{model}}_{{n}}.png')",
                path.display()
            )));
        }
        write(path, frame)?;
        let (width, height) = (frame.width, frame.height);
        self.reporter.info(format_args!("wrote {} ({width}×{height})", path.display()));
        Ok(())
    }
}

fn write_stream(frame: &Frame) -> Result<(), Failure> {
    encode_png(io::stdout().lock(), frame.width, frame.height, Pixels::Rgba8(&frame.color))
        .map_err(Failure::work)
}

/// Writes a picture; an old file of that name is replaced at once or not at all.
pub(crate) fn write_file(path: &Path, frame: &Frame) -> Result<(), Failure> {
    let is_exr = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"));
    let written = if is_exr {
        write_exr(path, frame)
    } else {
        write_png(path, frame.width, frame.height, Pixels::Rgba8(&frame.color))
    };
    written.map_err(Failure::work)
}

/// Writes one output to a file of its own.
fn write_beside(beside: Beside, path: &Path, frame: &Frame) -> Result<(), Failure> {
    let written = match beside.format() {
        Format::Npy => write_npy(path, frame, beside.output),
        Format::Png16 => write_png16(path, frame, beside.output),
    };
    written.map_err(|error| match error {
        WriteError::File { .. } => Failure::work(error),
        unwritable => Failure::work(format!("{}: {unwritable}", path.display())),
    })
}
