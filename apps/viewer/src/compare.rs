//! `--compare`: two models seen by one camera: side by side, and where they differ.

use std::path::Path;

use trigon_camera::Camera;
use trigon_io::{ImageDifference, RgbaImage, compare_images};
use trigon_scene::{Frame, RenderSettings, Renderer, Scene};

use crate::args::{Destination, Request, Subject};
use crate::facts::names;
use crate::failure::Failure;
use crate::loading;
use crate::outlet::{Outlet, OutputFile};
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::report_failure;
use crate::stdout::write_json;

/// Writes both models beside each other and beside a map of their differences; returns the exit code, 3 if there are
/// any.
pub(crate) fn run(request: &Request, other: &Path, output: &Destination, reporter: Reporter) -> u8 {
    let mut outlet = Outlet::new(Some(output), request, reporter);
    match compared(request, other, &mut outlet, reporter) {
        Ok(()) => 0,
        Err(failure) => {
            let source = Source::Files(request.files.clone());
            // Models that differ have their line already.
            let as_json = request.json && !matches!(failure, Failure::Mismatch(_));
            report_failure(&source, &failure, as_json, reporter)
        }
    }
}

/// The one model that another one is compared with.
pub(crate) fn only_source(request: &Request) -> Result<Source, Failure> {
    let mut sources = Source::all(request);
    if sources.len() > 1 {
        return Err(Failure::Usage(
            "--compare compares one model with another; name one file beside it".to_owned(),
        ));
    }
    Ok(sources.remove(0))
}

fn compared(
    request: &Request,
    other: &Path,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<(), Failure> {
    outlet.refuse_terminal()?;
    let source = only_source(request)?;
    let mut model = loading::load_aloud(&source, request, reporter)?;
    let mut changed = loading::load_aloud(&Source::Files(vec![other.to_owned()]), request, reporter)?;
    if changed.scene.turn_to(model.scene.up).is_some() {
        let up = model.scene.up;
        reporter.warning(format_args!("{} was turned: {up} is up in {}", other.display(), source.title()));
    }
    outlet.inputs.add(model.files.iter().chain(&changed.files));
    let shot = model.shot_with(&changed.scene, &request.framing, request.settings.aspect())?;
    let mut camera = shot.camera;
    for scene in [&mut model.scene, &mut changed.scene] {
        request.scenery.add_to(scene);
        camera = request.framing.with_wider_clip_planes(&camera, scene);
    }
    let [one, two] = draw_both([&model.scene, &changed.scene], &camera, &request.settings)?;
    let difference = difference(&one, &two);
    let heat = frame_of(&difference.image);
    let subject = Subject { model: source.image_subject(), ..Subject::default() };
    outlet.put(subject, &beside(&[&one, &two, &heat]))?;
    if request.json {
        write_json(&facts(&source, other, &difference, &outlet.written))?;
    }
    if difference.different_pixels == 0 {
        reporter.info(format_args!("{}: no pixel differs from {}", source.title(), other.display()));
        return Ok(());
    }
    Err(Failure::Mismatch(format!("{} and {}: {}", source.title(), other.display(), said(&difference))))
}

fn facts(
    source: &Source,
    other: &Path,
    difference: &ImageDifference,
    written: &[OutputFile],
) -> serde_json::Value {
    serde_json::json!({
        "file": source.first_file().map(Path::to_string_lossy), "other": other.to_string_lossy(), "error": difference.error,
        "different_pixels": difference.different_pixels, "largest": difference.largest, "written": names(written),
    })
}

/// "the error is 0.012; 531 pixels differ, by up to 200 of 255"
pub(crate) fn said(difference: &ImageDifference) -> String {
    format!(
        "the error is {:.6}; {} pixels differ, by up to {} of 255",
        difference.error, difference.different_pixels, difference.largest
    )
}

/// How far apart two images of one size are.
pub(crate) fn difference(one: &Frame, other: &Frame) -> ImageDifference {
    let [one, other] = [one, other].map(image_of);
    compare_images(&one, &other).expect("both were drawn with the same settings")
}

fn image_of(frame: &Frame) -> RgbaImage {
    RgbaImage { width: frame.width, height: frame.height, rgba: frame.color.clone() }
}

pub(crate) fn frame_of(image: &RgbaImage) -> Frame {
    Frame { width: image.width, height: image.height, color: image.rgba.clone(), ..Frame::default() }
}

/// Frames of one height beside each other.
pub(crate) fn beside(frames: &[&Frame]) -> Frame {
    let width = frames.iter().map(|frame| frame.width).sum();
    let height = frames.first().map_or(0, |frame| frame.height);
    let mut color = Vec::with_capacity(4 * width as usize * height as usize);
    for y in 0..height as usize {
        for frame in frames {
            let row = 4 * frame.width as usize;
            color.extend_from_slice(&frame.color[y * row..(y + 1) * row]);
        }
    }
    Frame { width, height, color, ..Frame::default() }
}

/// Draws two scenes as one camera sees them.
pub(crate) fn draw_both(
    scenes: [&Scene; 2],
    camera: &Camera,
    settings: &RenderSettings,
) -> Result<[Frame; 2], Failure> {
    let mut renderer = Renderer::new(settings.clone());
    let [one, other] = scenes.map(|scene| renderer.render(scene, camera).map_err(Failure::work));
    Ok([one?, other?])
}
