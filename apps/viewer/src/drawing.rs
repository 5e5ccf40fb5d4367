//! Draws one image of a model: within the time budget, with what is drawn and written over it.

use std::time::Instant;

use trigon_camera::{Camera, FisheyeCamera, FisheyeLens};
use trigon_scene::{Absence, Decision, Effect, Frame, Omission, RenderSettings, Renderer};

use crate::args::{Limit, Request};
use crate::axes;
use crate::failure::Failure;
use crate::framing::Shot;
use crate::lettering::Lettering;
use crate::model::Model;
use crate::report::Reporter;

/// An image, and how it came about.
pub(crate) struct Drawn {
    pub(crate) frame: Frame,
    pub(crate) settings: RenderSettings,
    pub(crate) seconds: f64,
    pub(crate) pixels_shaded: u64,
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

/// Draws an image with the renderer's settings; through a lens in place of the camera's projection, if there is one.
pub(crate) fn draw(
    model: &Model,
    shot: &Shot,
    lens: Option<&FisheyeLens>,
    renderer: &mut Renderer,
    request: &Request,
    reporter: Reporter,
) -> Result<Drawn, Failure> {
    let (started, camera) = (Instant::now(), &shot.camera);
    renderer.settings_mut().outputs.origin = shot.positions_origin();
    let frame = match (&request.limit, lens) {
        (None, None) => renderer.render(&model.scene, camera).map_err(Failure::work)?,
        (None, Some(lens)) => {
            renderer.render_fisheye(&model.scene, &FisheyeCamera::at(camera, *lens)).map_err(Failure::work)?
        }
        (Some(_), Some(_)) => {
            return Err(Failure::Usage(
                "a fisheye lens has no time budget; leave out --time-budget, and set --preset".to_owned(),
            ));
        }
        (Some(limit), None) => draw_within(limit, model, camera, renderer, reporter)?,
    };
    let seconds = started.elapsed().as_secs_f64();
    let (title, faces) = (model.source.title(), model.face_count());
    reporter.debug(format_args!("drew {title} ({faces} faces) in {:.1} ms", seconds * 1e3));
    let pixels_shaded = renderer.stats().pixels_shaded;
    Ok(Drawn { frame, settings: renderer.settings().clone(), seconds, pixels_shaded })
}

/// What a fisheye lens leaves out.
pub(crate) fn warn_of_omissions(model: &Model, settings: &RenderSettings, reporter: Reporter) {
    for omission in Omission::all(&model.scene, settings) {
        reporter.warning(format_args!("{}: {omission}", model.source.title()));
    }
}

/// Glass that is drawn as if it were opaque looks like china.
pub(crate) fn warn_of_opaque_glass(renderer: &Renderer, title: &str, reporter: Reporter) {
    let decision = renderer.plan().map(|plan| plan.decision(Effect::Refraction));
    if let Some(Decision::Off(absence @ (Absence::GlassNotRequested(_) | Absence::GlassLitOtherwise(_)))) =
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
