//! Picture mode: models in, PNG files or a PNG stream out. No display needed.

use std::collections::HashSet;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::Instant;

use trigon_io::{Pixels, encode_png, write_png};
use trigon_scene::{Frame, Renderer};

use crate::args::{Destination, Request, Template};
use crate::failure::Failure;
use crate::loading;
use crate::model::{Model, Source};
use crate::report::Reporter;

/// Draws and writes a picture of every source. A source that fails does not
/// keep the others from being drawn; the worst exit code is returned.
pub(crate) fn run(request: &Request, destination: &Destination, reporter: Reporter) -> u8 {
    let mut written = HashSet::new();
    Source::visit_all(request, reporter, |source| {
        draw_one(source, request, destination, &mut written, reporter)
    })
}

fn draw_one(
    source: &Source,
    request: &Request,
    destination: &Destination,
    written: &mut HashSet<PathBuf>,
    reporter: Reporter,
) -> Result<(), Failure> {
    refuse_terminal(destination)?;
    let model = loading::load_aloud(source, request, reporter)?;
    let frame = draw(&model, request, reporter)?;
    match destination {
        Destination::Stdout => write_stream(&frame),
        Destination::File(template) => {
            let path = new_name(template, source.first_file(), written)?;
            write_file(&path, &frame)?;
            reporter.info(format_args!("wrote {} ({}×{})", path.display(), frame.width, frame.height));
            Ok(())
        }
    }
}

fn draw(model: &Model, request: &Request, reporter: Reporter) -> Result<Frame, Failure> {
    let started = Instant::now();
    let shot = model.shot(&request.framing, request.settings.aspect())?;
    let mut renderer = Renderer::new();
    let frame = renderer.render(&model.scene, &shot.camera, &request.settings).map_err(Failure::work)?;
    let title = model.source.title();
    if renderer.stats().pixels_shaded == 0 {
        reporter.warning(format_args!(
            "{title}: nothing of the model is in the picture; look from elsewhere (--view=back), or show faces that point away (--backface-type=visible)"
        ));
    }
    let (milliseconds, faces) = (started.elapsed().as_secs_f64() * 1e3, model.summary().faces);
    reporter.debug(format_args!("drew {title} ({faces} faces) in {milliseconds:.1} ms"));
    Ok(frame)
}

/// Bytes of a picture would only garble a terminal.
fn refuse_terminal(destination: &Destination) -> Result<(), Failure> {
    if *destination == Destination::Stdout && io::stdout().is_terminal() {
        return Err(Failure::Usage(
            "--output - writes a picture to standard output, which is a terminal; redirect it (> picture.png) or name a file (--output picture.png)".to_owned(),
        ));
    }
    Ok(())
}

fn write_stream(frame: &Frame) -> Result<(), Failure> {
    encode_png(io::stdout().lock(), frame.width, frame.height, Pixels::Rgba8(&frame.color))
        .map_err(Failure::work)
}

/// Writes a picture; an old file of that name is replaced at once or not at all.
pub(crate) fn write_file(path: &Path, frame: &Frame) -> Result<(), Failure> {
    write_png(path, frame.width, frame.height, Pixels::Rgba8(&frame.color)).map_err(Failure::work)
}

/// The name of the next picture. Models of the same name in different folders
/// must not replace each other's pictures.
fn new_name(
    template: &Template,
    model: Option<&Path>,
    written: &mut HashSet<PathBuf>,
) -> Result<PathBuf, Failure> {
    let path = template.unused(model);
    if written.insert(path.clone()) {
        return Ok(path);
    }
    Err(Failure::Usage(format!(
        "{}: two models would be written to it; write {{n}} in the name of --output (--output '{{model}}_{{n}}.png')",
        path.display()
    )))
}
