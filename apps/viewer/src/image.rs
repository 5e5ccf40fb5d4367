//! Image mode: from models to files with images and outputs, a PNG stream or a capture. No display
//! needed.

use std::path::Path;
use std::time::Instant;

use trigon_camera::{Camera, Viewport};
use trigon_io::{Capture, Limits, RgbaImage, compare_images, load_image};
use trigon_scene::{Frame, RenderSettings, Renderer};

use crate::args::{Destination, Mode, Reference, Request, Subject, Template};
use crate::drawing::{Drawn, draw, finished, warn_of_opaque_glass};
use crate::facts::{CameraFacts, DrawingFacts, ImageFacts, ModelFacts, names};
use crate::failure::Failure;
use crate::image_series::draw_series;
use crate::loading;
use crate::model::Model;
use crate::outlet::{Outlet, write_file};
use crate::report::Reporter;
use crate::source::Source;

/// Draws and writes an image of every source. A source that fails does not
/// keep the others from being drawn; the worst exit code is returned.
pub(crate) fn run(
    request: &Request,
    output: Option<&Destination>,
    capture: Option<&Path>,
    reporter: Reporter,
) -> u8 {
    let mut outlet = Outlet::new(output, request, reporter);
    outlet.beside = &request.outputs;
    Source::visit_all(request, reporter, |source, request| {
        draw_source(source, request, capture, &mut outlet, reporter)
    })
}

/// Draws what is asked for of one source, and writes it.
pub(crate) fn draw_source(
    source: &Source,
    request: &Request,
    capture: Option<&Path>,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<(), Failure> {
    outlet.refuse_terminal()?;
    let started = Instant::now();
    let mut model = loading::load_aloud(source, request, reporter)?;
    outlet.inputs.add(&model.files);
    let loaded = started.elapsed().as_secs_f64();
    let before = outlet.written.len();
    let summary = model.summary();
    let (mut views, mut drawing, mut failed) = (Vec::new(), None, None);
    match output_template(request) {
        Some(template) if template.is_moving() || template.tells_frames_apart() => {
            (views, failed) = draw_series(&mut model, request, outlet, reporter)?;
        }
        _ => drawing = Some(draw_single(&mut model, request, capture, outlet, reporter)?),
    }
    outlet.tell(request, |written| ImageFacts {
        model: ModelFacts::new(&model, &summary),
        drawing,
        views,
        width: request.settings.width,
        height: request.settings.height,
        load_seconds: loaded,
        written: names(&written[before..]),
    })?;
    failed.map_or(Ok(()), Err)
}

/// Draws one image, and delivers it.
fn draw_single(
    model: &mut Model,
    request: &Request,
    capture: Option<&Path>,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<DrawingFacts, Failure> {
    let shot = model.shot_with_scenery(request)?;
    let camera = shot.camera;
    let mut renderer = Renderer::new(request.settings.clone());
    let drawn = draw(model, &shot, None, &mut renderer, request, reporter)?;
    let title = model.source.title();
    if drawn.pixels_shaded == 0 {
        reporter.warning(format_args!("{title}: {NOT_IN_VIEW}"));
    }
    warn_of_opaque_glass(&renderer, &title, reporter);
    if let Some(path) = capture {
        outlet.inputs.refuse(path)?;
        keep(model, camera, &drawn, path, reporter)?;
    }
    let frame = finished(drawn.frame, model, &camera, request)?;
    Ok(DrawingFacts {
        camera: CameraFacts::new(&camera, None, viewport(&request.settings)),
        positions_origin: frame.positions.as_ref().map(|_| frame.origin.to_array()),
        draw_seconds: drawn.seconds,
        pixels_shaded: drawn.pixels_shaded,
        error: deliver(&model.source, &frame, request, outlet, reporter)?,
    })
}

/// What to do about an image without the model.
const NOT_IN_VIEW: &str = "the model is not in view; look from another side (--view=back), or show faces that point away (--backface-type=visible)";

fn viewport(settings: &RenderSettings) -> Viewport {
    Viewport { width: settings.width, height: settings.height }
}

fn output_template(request: &Request) -> Option<&Template> {
    match &request.mode {
        Mode::Image { output: Some(Destination::File(template)), .. } => Some(template),
        _ => None,
    }
}

/// Writes what draws the image again.
fn keep(
    model: &Model,
    camera: Camera,
    drawn: &Drawn,
    path: &Path,
    reporter: Reporter,
) -> Result<(), Failure> {
    let capture = Capture::new(model.scene.clone(), camera, drawn.settings.clone(), &drawn.frame);
    capture.write(path).map_err(Failure::work)?;
    reporter.info(format_args!("captured {} ({:016x})", path.display(), capture.image_hash()));
    Ok(())
}

/// Writes an image, if there is nothing to compare it with or it differs. Returns how far
/// it is from that.
fn deliver(
    source: &Source,
    frame: &Frame,
    request: &Request,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<Option<f64>, Failure> {
    let subject = Subject { model: source.image_subject(), ..Subject::default() };
    let Some(reference) = &request.reference else {
        outlet.put(subject, frame)?;
        return Ok(None);
    };
    let name = reference.file.display();
    if !reference.file.exists() {
        let written = outlet.put(subject, frame)?;
        let remedy = match written {
            Some(path) => format!("{} was written: rename it to that if it is right", path.display()),
            None => "write one with --output, look at it, and give it that name".to_owned(),
        };
        return Err(Failure::Mismatch(format!("{name}: there is no image to compare with; {remedy}")));
    }
    compare(reference, subject, frame, outlet, reporter).map(Some)
}

/// Compares an image; one that differs is written, and where it differs beside it.
fn compare(
    reference: &Reference,
    subject: Subject<'_>,
    frame: &Frame,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<f64, Failure> {
    let wanted = load_image(&reference.file, &Limits::default()).map_err(Failure::work)?;
    let (name, threshold) = (reference.file.display(), reference.threshold);
    let drawn = RgbaImage { width: frame.width, height: frame.height, rgba: frame.color.clone() };
    let difference = match compare_images(&drawn, &wanted) {
        Ok(difference) => difference,
        Err(sizes) => {
            outlet.put(subject, frame)?;
            return Err(Failure::Mismatch(format!("{name}: {sizes}")));
        }
    };
    let (error, pixels) = (difference.error, difference.different_pixels);
    if error <= threshold {
        reporter.info(format_args!(
            "{name}: the error is {error:.6}, within {threshold} ({pixels} pixels differ)"
        ));
        return Ok(error);
    }
    let RgbaImage { width, height, rgba } = difference.image;
    if let Some(path) = outlet.put(subject, frame)? {
        let path = path.with_extension("diff.png");
        outlet.inputs.refuse(&path)?;
        write_file(&path, &Frame { width, height, color: rgba, ..Frame::default() })?;
        reporter.info(format_args!("wrote {} (where they differ)", path.display()));
    }
    Err(Failure::Mismatch(format!(
        "{name}: the error is {error:.6}, more than --reference-threshold={threshold}; {pixels} pixels differ, by up to {} of 255",
        difference.largest
    )))
}
