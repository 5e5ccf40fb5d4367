//! Better and better images at rest, and how far they are from the best.

use std::sync::Mutex;

use super::*;
use crate::drawer::Drawer;
use crate::pacing::{Progress, Quality};
use crate::refinement::{Comparison, Refinement};
use crate::worker::Purpose;
use trigon_camera::Camera;
use trigon_scene::quality::Preset;
use trigon_scene::{Cancel, Scene, render};

/// Two cubes with one sample a pixel, which are refined to the reference if that is said.
fn coarse_stage(refinement: Refinement) -> Stage {
    let mut stage = stage();
    stage.settings.samples_per_axis = 1;
    stage.refinement = refinement;
    stage
}

fn opened(stage: Stage, handler: &mut Recorder) -> Session<'_> {
    session_of(stage, handler, Worker::of_caller())
}

/// What an image file would hold.
fn file(stage: &Stage, preset: Option<Preset>) -> Frame {
    let outputs = crate::shown::OUTPUTS;
    let mut settings =
        RenderSettings { width: SIZE.width, height: SIZE.height, outputs, ..stage.settings.clone() };
    if let Some(preset) = preset {
        preset.apply(&mut settings);
    }
    render(&stage.scene, &stage.camera(), &settings).expect("drawn")
}

#[test]
fn at_rest_the_image_becomes_the_reference_and_then_nothing_runs() {
    let mut handler = Recorder::default();
    let mut session = opened(coarse_stage(Refinement::Reference), &mut handler);
    let (mut now, mut seen, mut notes) = (ms(0), Vec::new(), Vec::new());
    while let Wake::Now | Wake::At(_) = session.next(now) {
        if let Wake::At(later) = session.next(now) {
            now = later;
        }
        draw(&mut session, now);
        let shown = session.shown.clone().expect("an image");
        if seen.last() != Some(&shown) {
            seen.push(shown);
            notes.push(session.stage.progress());
        }
    }
    // The draft, which is in full size here, is what the settings give.
    let expected = [None, Some(Preset::Standard), Some(Preset::High), Some(Preset::Reference)];
    assert_eq!(seen.len(), expected.len(), "{notes:?}");
    for (shown, preset) in seen.iter().zip(expected) {
        assert!(**shown == file(&session.stage, preset), "the bytes of an image file, {preset:?}");
    }
    let refining = |step| Some(Progress::Refining { step, of: 4, seconds: 0 });
    assert_eq!(notes[1..], [refining(3), refining(4), None], "what is still to come");
    assert_eq!(session.next(now + Duration::from_secs(3600)), Wake::Never, "silence");
}

/// Between a draft and the rays of every sample, which take long, comes an image whose pixels share theirs.
#[test]
fn rays_are_shared_until_those_of_every_sample_are_there() {
    let (mut handler, mut stage) = (Recorder::default(), coarse_stage(Refinement::Settings));
    let floor = stage.scene.add_object("floor", primitives::cube(4.0), Material::default());
    stage.scene.node_mut(floor).expect("just added").transform.translate(DVec3::NEG_Y * 2.5);
    stage.set_home_direction(DVec3::new(0.0, -1.0, -1.0));
    stage.settings.effects.ambient_occlusion = Some(trigon_scene::AmbientOcclusion::new(16, 1.0));
    let mut session = opened(stage, &mut handler);
    let (mut now, mut seen) = (ms(0), Vec::new());
    while let wake @ (Wake::Now | Wake::At(_)) = session.next(now) {
        if let Wake::At(later) = wake {
            now = later;
        }
        draw(&mut session, now);
        let shown = session.shown.clone().expect("an image");
        if seen.last() != Some(&shown) {
            assert!(session.gallery.report().is_none() || seen.len() == 2, "only the image at rest is timed");
            seen.push(shown);
        }
    }
    let drawn = |settings: &RenderSettings| render(&session.stage.scene, &session.stage.camera(), settings);
    let stage = &session.stage;
    let [draft, preview] = [stage.draft_settings(1.0), stage.preview_settings().expect("16 rays")];
    let expected = [draft, preview, stage.ladder()[0].clone()];
    assert_eq!(seen.len(), expected.len());
    for (shown, settings) in seen.iter().zip(expected) {
        assert!(**shown == drawn(&settings).expect("drawn"), "{:?}", settings.effects.ambient_occlusion);
    }
}

#[test]
fn refining_can_be_switched_on_and_off_and_shows_what_is_there() {
    let mut handler = Recorder::default();
    let mut session = opened(coarse_stage(Refinement::Settings), &mut handler);
    run(&mut session, ms(0));
    let (coarse, reference) = (file(&session.stage, None), file(&session.stage, Some(Preset::Reference)));
    assert!(session.shown.as_deref() == Some(&coarse), "as the settings say, and no better");
    session.stage.refinement = Refinement::Reference;
    session.woken(ms(1000));
    session.animation = AnimationState::Resting;
    run(&mut session, ms(1000));
    assert!(session.shown.as_deref() == Some(&reference), "refined");
    session.stage.refinement = Refinement::Settings;
    session.note(ms(9000));
    assert!(session.shown.as_deref() == Some(&coarse), "it is still there: nothing has to be drawn");
    assert!(!session.worker.is_busy(), "nothing is");
}

#[test]
fn the_difference_is_shown_with_its_figures_and_a_legend() {
    let mut handler = Recorder::default();
    let mut session = opened(coarse_stage(Refinement::Settings), &mut handler);
    run(&mut session, ms(0));
    let plain = session.canvas().pixels().to_vec();
    assert_eq!(session.stage.quality_report().and_then(|report| report.difference), None, "nobody asked");
    session.stage.comparison = Comparison::Shown;
    session.note(ms(1000));
    run(&mut session, ms(1000));
    let map = session.canvas().pixels().to_vec();
    let report = session.stage.quality_report().expect("at rest");
    let difference = report.difference.expect("compared");
    let (coarse, reference) = (file(&session.stage, None), file(&session.stage, Some(Preset::Reference)));
    let pairs = coarse.color.as_chunks::<4>().0.iter().zip(reference.color.as_chunks::<4>().0);
    let differing = pairs.filter(|(one, other)| one != other).count();
    assert!(differing > 50, "outlines are jagged with one sample: {differing}");
    assert_eq!(
        difference.share,
        differing as f64 / f64::from(SIZE.width * SIZE.height),
        "as many are marked"
    );
    assert!(map != plain, "the map is to be seen");
    session.stage.comparison = Comparison::Measured;
    session.note(ms(2000));
    run(&mut session, ms(2000));
    assert!(session.canvas().pixels() == plain, "and gone without a trace");
    assert!(session.stage.quality_report().is_some_and(|r| r.difference.is_some()), "the figures stay");
    session.event(key_down(1, Key::Character('7')), ms(3000));
    assert_eq!(session.stage.quality_report(), None, "until something else is seen");
}

/// A movement, or an image that somebody waits for, comes before a better one.
#[test]
fn refining_keeps_nobody_waiting() {
    let mut handler = Recorder::default();
    let gate = Gate::default();
    // The fourth and last step is the reference.
    let (worker, rung) = gate.worker(|purpose| purpose == Purpose::Window(Quality::Full(3)));
    let mut session = session_of(coarse_stage(Refinement::Reference), &mut handler, worker);
    let last = Some(Progress::Refining { step: 4, of: 4, seconds: 0 });
    let is_at_reference = |session: &Session<'_>| {
        session.worker.is_busy() && session.pacing.is_refining() && session.stage.progress() == last
    };
    let now = live_until(&mut session, &rung, ms(0), is_at_reference);
    assert!(is_at_reference(&session), "the reference is under way");
    session.event(key_down(3, Key::Character('g')), now);
    while !session.is_over() {
        rung.recv().expect("whoever asked for the image has it in the end");
        session.collect(now);
    }
    draw(&mut session, now + ms(20));
    assert!(is_at_reference(&session), "and refining goes on");
    session.event(key_down(4, Key::Character('7')), now + ms(30));
    session.settle(now + ms(30));
    assert!(!session.worker.is_busy(), "it is given up at once");
    assert_eq!(session.stage.progress(), None, "another view has to be drawn first");
    gate.open();
    rest_beside(&mut session, &rung, now + ms(30));
    let expected = file(&session.stage, Some(Preset::Reference));
    assert!(session.shown.as_deref() == Some(&expected), "and is refined in its turn");
}

/// Paints everything in one colour, or refuses, and counts.
struct Flat(Mutex<u32>, Result<u8, String>);

impl Drawer for Flat {
    fn draw(&self, _: &Scene, _: &Camera, settings: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        *self.0.lock().expect("nobody panics") += 1;
        let RenderSettings { width, height, .. } = *settings;
        let color = vec![self.1.clone()?; 4 * width as usize * height as usize];
        Ok(Frame { width, height, color, ..Frame::default() })
    }
}

#[test]
fn another_drawer_is_used_at_rest_and_compared_with_the_renderer() {
    let mut handler = Recorder::default();
    let mut session = opened(coarse_stage(Refinement::Reference), &mut handler);
    let drawer = Arc::new(Flat(Mutex::default(), Ok(255)));
    session.stage.drawer = Some(drawer.clone());
    session.stage.comparison = Comparison::Measured;
    session.note(ms(0));
    run(&mut session, ms(0));
    assert!(session.shown.as_deref().is_some_and(|frame| frame.color[0] == 255), "its image stays");
    let report = session.stage.quality_report().expect("at rest");
    assert!(
        report.difference.is_some_and(|difference| difference.share > 0.5),
        "it is far from the right one"
    );
    assert_eq!(*drawer.0.lock().expect("nobody panics"), 1, "drawn once");
    session.stage.drawer = Some(Arc::new(Flat(Mutex::default(), Err("only convex bodies".into()))));
    session.note(ms(5000));
    for now in (5000..5500).step_by(17).map(ms) {
        draw(&mut session, now);
    }
    let said = session.stage.overlay.messages(ms(5500)).join(" ");
    assert!(said.contains("only convex bodies"), "its reason is told: {said}");
    run(&mut session, ms(5500));
    assert_eq!(session.next(ms(99_000)), Wake::Never, "and it is not asked again and again");
}

/// With the reference and ambient occlusion the window showed nothing for minutes.
#[test]
fn drafts_cast_few_rays() {
    let mut stage = stage();
    stage.settings.effects.shadows = trigon_scene::Shadows::Rays;
    let occlusion = trigon_scene::AmbientOcclusion::new(256, 1.0);
    stage.settings.effects.ambient_occlusion = Some(occlusion);
    let draft = trigon_scene::quality::Quality::of(&stage.draft_settings(1.0));
    assert_eq!(draft, Preset::Draft.quality(), "as the preset for drafts says");
    stage.settings.effects.ambient_occlusion = None;
    let plain = stage.draft_settings(1.0).effects;
    assert_eq!(plain.ambient_occlusion, None, "and nothing is added");
}
