//! What ambient occlusion and soft shadows cost, and how far they are from 1,024 rays in f64 at every pixel: with rays at
//! every sample, with rays that pixels share, and soft shadows by maps.
//!
//! `cargo bench -p trigon-study --bench occlusion [-- shadows] [FILE …]` draws the built-in scenes, or models. Each image of 480×300
//! pixels has one sample a pixel and one thread. Times are those of the scene in its own light, all settings in turn.
//! Errors are root mean squares over all surfaces, of white matt surfaces in light from all around, or over those that the sun lights,
//! where 1 is the light of a surface that faces it.

#![expect(clippy::print_stdout, reason = "a program that prints what it measures")]

mod scenes;
mod shadows;
mod truth;

use std::error::Error;
use std::num::NonZeroUsize;
use std::time::Instant;

use scenes::Subject;
use trigon_math::Vec3;
use trigon_scene::{
    AmbientOcclusion, Background, Effect, Exposure, Frame, Lighting, Outputs, RaySampling, RenderSettings,
    Renderer,
};

/// What is compared; the first one is the measure of errors.
const KINDS: [(u32, RaySampling); 6] = [
    (16, RaySampling::Full),
    (64, RaySampling::Full),
    (16, RaySampling::Shared),
    (32, RaySampling::Shared),
    (64, RaySampling::Shared),
    (128, RaySampling::Shared),
];

/// How often each image is timed.
const ROUNDS: usize = 15;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo adds an option of its own.
    let mut files: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let of_shadows = files.first().is_some_and(|word| word == "shadows");
    files.drain(..usize::from(of_shadows));
    for subject in scenes::all(&files)? {
        println!("{}: {} triangles", subject.name, subject.triangles().len());
        if of_shadows { shadows::report(&subject)? } else { report(&subject)? }
    }
    Ok(())
}

fn report(subject: &Subject) -> Result<(), Box<dyn Error>> {
    let white = subject.in_white();
    let truth = truth::openness(&surfaces(&white)?, &white);
    let errors = KINDS.iter().map(|&kind| Ok(error(&light(&white, kind)?, &truth)));
    let errors: Vec<f64> = errors.collect::<Result<_, Box<dyn Error>>>()?;
    let kinds: Vec<Option<(u32, RaySampling)>> = std::iter::once(None).chain(KINDS.map(Some)).collect();
    let kinds: Vec<RenderSettings> = kinds.iter().map(|kind| settings(subject, *kind, false)).collect();
    let costs = costs(subject, &kinds, Effect::AmbientOcclusion)?;
    println!("  without: {:.2} ms", costs[0].milliseconds);
    for (((count, sampling), error), cost) in KINDS.iter().zip(&errors).zip(&costs[1..]) {
        let Cost { milliseconds, rays, .. } = cost;
        let (more, relative) = ((cost.ratio - 1.0) * 100.0, error / errors[0]);
        println!(
            "  {sampling:?} {count}: {milliseconds:.2} ms, +{more:.0} %, {rays} rays, error {error:.4}, {relative:.2} of the first",
        );
    }
    Ok(())
}

/// What an image takes.
struct Cost {
    /// The median.
    milliseconds: f64,
    /// The median ratio to the first kind in the same round.
    ratio: f64,
    rays: u64,
}

fn costs(subject: &Subject, kinds: &[RenderSettings], effect: Effect) -> Result<Vec<Cost>, Box<dyn Error>> {
    let mut renderers: Vec<(Renderer, Frame)> =
        kinds.iter().map(|kind| (Renderer::new(kind.clone()), Frame::default())).collect();
    let mut rounds: Vec<Vec<f64>> = Vec::new();
    for round in 0..=ROUNDS {
        let mut times = Vec::new();
        for (renderer, frame) in &mut renderers {
            let start = Instant::now();
            renderer.render_into(&subject.scene, &subject.camera, frame)?;
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        // The first one fills caches.
        if round > 0 {
            rounds.push(times);
        }
    }
    let of = |kind: usize| {
        let ratio = median(rounds.iter().map(|times| times[kind] / times[0]).collect());
        let milliseconds = median(rounds.iter().map(|times| times[kind]).collect());
        Cost { milliseconds, ratio, rays: renderers[kind].0.effect_counts(effect).rays }
    };
    Ok((0..kinds.len()).map(of).collect())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The visible points of a subject, with their normals.
fn surfaces(subject: &Subject) -> Result<Frame, Box<dyn Error>> {
    let mut settings = settings(subject, None, true);
    settings.outputs = Outputs { positions: true, normals: true, ..Outputs::default() };
    Ok(Renderer::new(settings).render(&subject.scene, &subject.camera)?)
}

/// The light of each pixel.
fn light(white: &Subject, kind: (u32, RaySampling)) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut settings = settings(white, Some(kind), true);
    settings.outputs.radiance = true;
    let frame = Renderer::new(settings).render(&white.scene, &white.camera)?;
    Ok(frame.radiance.iter().flatten().map(|light| f64::from(light.x)).collect())
}

fn settings(subject: &Subject, kind: Option<(u32, RaySampling)>, is_white: bool) -> RenderSettings {
    let mut settings = RenderSettings {
        samples_per_axis: 1,
        threads: NonZeroUsize::new(1),
        background: Background::Color(Vec3::ZERO),
        ..RenderSettings::new(480, 300)
    };
    if is_white {
        (settings.lighting, settings.effects.exposure) = (Lighting::Scene, Exposure::Stops(0.0));
    }
    settings.effects.ambient_occlusion = kind.map(|(rays, sampling)| AmbientOcclusion {
        sampling,
        ..AmbientOcclusion::new(rays, subject.distance as f32)
    });
    settings
}

/// Of what is a number.
fn error(light: &[f64], truth: &[Option<f64>]) -> f64 {
    let differences = light.iter().zip(truth).filter_map(|(light, truth)| Some(light - (*truth)?));
    let differences = differences.filter(|off| !off.is_nan());
    let (sum, count) = differences.fold((0.0, 0.0), |(sum, count), off| (sum + off * off, count + 1.0));
    (sum / count).sqrt()
}
