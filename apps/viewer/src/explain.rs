//! `--explain`: which effects a model needs, why, and what they cost.

use std::time::Instant;

use trigon_camera::Camera;
use trigon_scene::{EffectPlan, Frame, RenderSettings, Renderer, Scene};

use crate::args::{Explanation, Request};
use crate::failure::Failure;
use crate::loading;
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::write_lines;

/// Images of which the quickest counts.
const REPETITIONS: usize = 5;

/// Explains every source; the worst exit code is returned.
pub(crate) fn run(request: &Request, explanation: Explanation, reporter: Reporter) -> u8 {
    Source::visit_all(request, reporter, |source, request| explain(source, request, explanation, reporter))
}

fn explain(
    source: &Source,
    request: &Request,
    explanation: Explanation,
    reporter: Reporter,
) -> Result<(), Failure> {
    let model = loading::load_aloud(source, request, reporter)?;
    let camera = model.shot(&request.framing, request.settings.aspect())?.camera;
    let (scene, settings) = (&model.scene, &request.settings);
    let plan = EffectPlan::new(scene, &camera, settings);
    let table = match explanation {
        Explanation::Reasons => plan.to_string(),
        Explanation::Time => timed(scene, &camera, settings, &plan)?,
    };
    write_lines(std::iter::once(source.title()).chain(table.lines().map(str::to_owned)))
}

/// The plan, and how much longer an image takes with each effect than without it.
fn timed(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    plan: &EffectPlan,
) -> Result<String, Failure> {
    let whole = milliseconds(scene, camera, settings)?;
    let mut table = format!("an image takes {whole:.2} ms\n");
    for (effect, decision) in plan.iter() {
        let cost = match effect.left_out(scene, settings).filter(|_| plan.is_on(effect)) {
            Some((scene, settings)) => {
                let less = whole - milliseconds(&scene, camera, &settings)?;
                format!(" ({less:+.2} ms, {:+.0} %)", less / whole * 100.0)
            }
            None => String::new(),
        };
        table.push_str(&format!("{effect}: {decision}{cost}\n"));
    }
    Ok(table)
}

/// The shortest of several images, after one that fills caches.
fn milliseconds(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Result<f64, Failure> {
    let (mut renderer, mut frame) = (Renderer::new(settings.clone()), Frame::default());
    let mut shortest = f64::INFINITY;
    for repetition in 0..=REPETITIONS {
        let start = Instant::now();
        renderer.render_into(scene, camera, &mut frame).map_err(Failure::work)?;
        let time = start.elapsed().as_secs_f64() * 1e3;
        if repetition > 0 && time < shortest {
            shortest = time;
        }
    }
    Ok(shortest)
}
