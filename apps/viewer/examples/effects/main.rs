//! Writes `docs/effects.md`: what each effect adds to an image, why it was on, and what it costs, on five scenes.
//!
//! `cargo run --release -p trigon-viewer --no-default-features --example effects -- docs --instructions`
//!
//! Without `--instructions`, which needs valgrind and takes many minutes, that column is left out.

#[path = "../../../../crates/study/benches/instructions/callgrind.rs"]
mod callgrind;
mod measure;
mod page;
mod subjects;
mod without;

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use callgrind::instructions;
use measure::{Shots, quarters};
use page::{Cost, INTRODUCTION, OTHERS};
use subjects::{SUBJECTS, Subject, shown};
use trigon_camera::Camera;
use trigon_io::{Pixels, write_png};
use trigon_scene::{Effect, EffectPlan, RenderSettings, Scene, render};
use without::without;

const USAGE: &str = "name the folder to write to, such as docs, and --instructions to count them, too";

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["count", subject, shot] => draw_counted(subject, shot.parse()?),
        [folder] => write(Path::new(folder), false),
        [folder, "--instructions"] => write(Path::new(folder), true),
        _ => Err(USAGE.into()),
    }
}

/// Draws one image for callgrind, within which this program then runs.
fn draw_counted(name: &str, shot: usize) -> Result<(), Box<dyn Error>> {
    let (_, made) = SUBJECTS.into_iter().find(|(known, _)| *known == name).ok_or("there is no such scene")?;
    let subject = made();
    let (shots, _) = collect(&subject);
    shots.draw_counted(shot, &subject.camera)
}

fn write(folder: &Path, is_counted: bool) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder.join("effects"))?;
    let mut text = INTRODUCTION.to_owned();
    let mut missing = Effect::ALL.to_vec();
    // Everything is timed first: counting takes longer, and does not need a quiet machine.
    let timed: Result<Vec<Timed>, _> =
        SUBJECTS.into_iter().map(|(name, made)| Timed::new(name, made())).collect();
    for subject in timed? {
        let Timed { name, camera, shots, pairs, rounds } = subject;
        write!(text, "\n## {name}\n\n{}", page::head(is_counted))?;
        missing.retain(|effect| pairs.iter().all(|pair| pair.effect != *effect));
        let counted = if is_counted { shots.count() } else { 0 };
        let count = |shot: usize| instructions(&["count", name, &shot.to_string()]);
        let counts: Result<Vec<f64>, _> = (0..counted).map(count).collect();
        let counts = counts?;
        for pair in &pairs {
            let names = images(name, &camera, pair, folder)?;
            text.push_str(&page::row(pair.effect, &names, &pair.reason, &cost(pair, &rounds, &counts)));
        }
    }
    text.push_str(OTHERS);
    fs::write(folder.join("effects.md"), text)?;
    if missing.is_empty() { Ok(()) } else { Err(format!("no scene shows {missing:?}").into()) }
}

/// A subject whose shots have been timed.
struct Timed {
    name: &'static str,
    camera: Camera,
    shots: Shots,
    pairs: Vec<Pair>,
    rounds: Vec<Vec<f64>>,
}

impl Timed {
    fn new(name: &'static str, subject: Subject) -> Result<Self, Box<dyn Error>> {
        let (shots, pairs) = collect(&subject);
        let rounds = shots.rounds(&subject.camera)?;
        Ok(Self { name, camera: subject.camera, shots, pairs, rounds })
    }
}

/// An effect of a subject, and the numbers of the shots without and with it.
struct Pair {
    effect: Effect,
    reason: String,
    shots: [usize; 2],
    images: [(Scene, RenderSettings); 2],
}

/// All effects that a subject shows, and what has to be drawn for them.
fn collect(subject: &Subject) -> (Shots, Vec<Pair>) {
    let (mut shots, mut pairs) = (Shots::default(), Vec::new());
    for (effect, settings) in shown(subject) {
        let plan = EffectPlan::new(&subject.scene, &subject.camera, &settings);
        if !plan.is_on(effect) {
            continue;
        }
        let off = without(effect, &subject.scene, &settings);
        // The scene is another one where the settings are not.
        let lacks = (off.1 == settings).then_some(effect);
        let numbers = [shots.number(lacks, &off.0, &off.1), shots.number(None, &subject.scene, &settings)];
        let reason = plan.decision(effect).to_string();
        pairs.push(Pair { effect, reason, shots: numbers, images: [off, (subject.scene.clone(), settings)] });
    }
    (shots, pairs)
}

/// Draws both images, and returns the names of their files.
fn images(subject: &str, camera: &Camera, pair: &Pair, folder: &Path) -> Result<[String; 2], Box<dyn Error>> {
    let name = |way: &str| format!("{subject}-{}-{way}.png", pair.effect).to_lowercase().replace(' ', "-");
    let names = ["without", "with"].map(name);
    for ((scene, settings), name) in pair.images.iter().zip(&names) {
        let smooth = RenderSettings { samples_per_axis: 3, width: 240, height: 150, ..settings.clone() };
        let frame = render(scene, camera, &smooth)?;
        let path: PathBuf = folder.join("effects").join(name);
        write_png(path, frame.width, frame.height, Pixels::Rgba8(&frame.color))?;
    }
    Ok(names)
}

/// What an effect costs: the quarters of the times and of their ratios in the same rounds.
fn cost(pair: &Pair, rounds: &[Vec<f64>], counts: &[f64]) -> Cost {
    let [off, on] = pair.shots;
    let times = |shot: usize| quarters(rounds.iter().map(|round| round[shot]).collect());
    Cost {
        without: times(off),
        with: times(on),
        ratio: quarters(rounds.iter().map(|round| round[on] / round[off]).collect()),
        instructions: counts.get(on).zip(counts.get(off)).map(|(on, off)| on / off),
    }
}
