//! Image mode: from models to files with images and outputs, a PNG stream or a capture. No display
//! needed.

use std::path::Path;
use std::time::Instant;

use trigon_camera::{Camera, Viewport};
use trigon_io::{Capture, Limits, RgbaImage, Sequence, compare_images, load_image};
use trigon_scene::{Absence, Decision, Effect, Frame, RenderSettings, Renderer};

use crate::args::{Destination, Limit, Mode, Reference, Request, Subject, Template};
use crate::axes;
use crate::facts::{CameraFacts, DrawingFacts, ImageFacts, ModelFacts, names};
use crate::failure::Failure;
use crate::framing::Shot;
use crate::lettering::Lettering;
use crate::loading;
use crate::model::Model;
use crate::outlet::{Outlet, write_file};
use crate::report::Reporter;
use crate::series::Series;
use crate::source::Source;
use crate::stdout::write_json;

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
    let drawing = match output_template(request) {
        Some(template) if template.is_moving() || template.tells_frames_apart() => {
            draw_series(&mut model, request, outlet)?;
            None
        }
        _ => {
            let shot = model.shot_with_scenery(request)?;
            let camera = shot.camera;
            let drawn = draw(&model, &shot, request, reporter)?;
            if let Some(path) = capture {
                outlet.inputs.refuse(path)?;
                keep(&model, camera, &drawn, path, reporter)?;
            }
            let frame = finished(drawn.frame, &model, &camera, request)?;
            Some(DrawingFacts {
                camera: CameraFacts::new(&camera, viewport(&request.settings)),
                positions_origin: frame.positions.as_ref().map(|_| frame.origin.to_array()),
                draw_seconds: drawn.seconds,
                pixels_shaded: drawn.pixels_shaded,
                error: deliver(source, &frame, request, outlet, reporter)?,
            })
        }
    };
    if request.json {
        write_json(&ImageFacts {
            model: ModelFacts::new(&model, &summary),
            drawing,
            width: request.settings.width,
            height: request.settings.height,
            load_seconds: loaded,
            written: names(&outlet.written[before..]),
        })?;
    }
    Ok(())
}

fn viewport(settings: &RenderSettings) -> Viewport {
    Viewport { width: settings.width, height: settings.height }
}

fn output_template(request: &Request) -> Option<&Template> {
    match &request.mode {
        Mode::Image { output: Some(Destination::File(template)), .. } => Some(template),
        _ => None,
    }
}

/// An image, and how it came about.
struct Drawn {
    frame: Frame,
    settings: RenderSettings,
    seconds: f64,
    pixels_shaded: u64,
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
    let subject = Subject { model: source.image_subject(), frame: 0 };
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

/// Draws image after image, to as many files or to one.
fn draw_series(model: &mut Model, request: &Request, outlet: &mut Outlet<'_>) -> Result<(), Failure> {
    let series = Series::new(model, request)?;
    request.scenery.add_to(&mut model.scene);
    let mut renderer = Renderer::new(request.settings.clone());
    let subject = model.source.clone();
    let subject = |frame| Subject { model: subject.image_subject(), frame };
    let mut draw = |number| -> Result<Frame, Failure> {
        let camera = series.set(&mut model.scene, number);
        // A pose may come nearer than the first one, and lines beside the model may, too.
        let camera = request.framing.with_wider_clip_planes(&camera, &model.scene);
        let frame = renderer.render(&model.scene, &camera).map_err(Failure::work)?;
        finished(frame, model, &camera, request)
    };
    if output_template(request).is_some_and(Template::is_moving) {
        let sequence = Sequence {
            width: request.settings.width,
            height: request.settings.height,
            frames: series.frames(),
            frames_per_second: request.sequence.rate,
        };
        return outlet.put_moving(subject(0), &sequence, &mut draw);
    }
    (0..series.frames()).try_for_each(|number| outlet.put(subject(number), &draw(number)?).map(drop))
}

/// What is drawn and written over an image.
pub(crate) fn finished(
    mut frame: Frame,
    model: &Model,
    camera: &Camera,
    request: &Request,
) -> Result<Frame, Failure> {
    let overlay = &request.overlay;
    if overlay.shows_axes {
        axes::draw(&mut frame, camera, overlay.axes, &request.settings)?;
    }
    let environment = request.environment.as_ref().and_then(|file| file.file_name());
    let environment =
        environment.filter(|_| overlay.environment_name).map(|name| name.to_string_lossy().into_owned());
    let mut left = if overlay.metadata { model.summary().lines() } else { Vec::new() };
    if overlay.tree {
        left.extend(model.tree());
    }
    let text = Lettering {
        top: overlay.name.then(|| model.source.title()).into_iter().collect(),
        left,
        below: environment.into_iter().collect(),
    };
    text.write(&mut frame, overlay.text_scale)?;
    Ok(frame)
}

/// An image, and the settings that it was drawn with.
fn draw(model: &Model, shot: &Shot, request: &Request, reporter: Reporter) -> Result<Drawn, Failure> {
    let (started, camera) = (Instant::now(), &shot.camera);
    let mut renderer = Renderer::new(request.settings.clone());
    renderer.settings_mut().outputs.origin = shot.positions_origin();
    let frame = match &request.limit {
        None => renderer.render(&model.scene, camera).map_err(Failure::work)?,
        Some(limit) => draw_within(limit, model, camera, &mut renderer, reporter)?,
    };
    let title = model.source.title();
    let pixels_shaded = renderer.stats().pixels_shaded;
    if pixels_shaded == 0 {
        reporter.warning(format_args!(
            "{title}: the model is not in view; look from another side (--view=back), or show faces that point away (--backface-type=visible)"
        ));
    }
    warn_of_opaque_glass(&renderer, &title, reporter);
    let (seconds, faces) = (started.elapsed().as_secs_f64(), model.face_count());
    reporter.debug(format_args!("drew {title} ({faces} faces) in {:.1} ms", seconds * 1e3));
    Ok(Drawn { frame, settings: renderer.settings().clone(), seconds, pixels_shaded })
}

/// Glass that is drawn as if it were opaque looks like china.
fn warn_of_opaque_glass(renderer: &Renderer, title: &str, reporter: Reporter) {
    let decision = renderer.plan().map(|plan| plan.decision(Effect::Refraction));
    if let Some(Decision::Off(absence @ (Absence::GlassNotAsked(_) | Absence::GlassLitOtherwise(_)))) =
        decision
    {
        reporter.warning(format_args!(
            "{title}: what is behind glass is not drawn, because {absence}; leave out --bounces=0, --shading and --reflection"
        ));
    }
}

/// The most accurate image that fits into a time; says what that gives up.
fn draw_within(
    limit: &Limit,
    model: &Model,
    camera: &Camera,
    renderer: &mut Renderer,
    reporter: Reporter,
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
