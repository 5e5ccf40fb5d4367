//! A window's life without a window.

mod beside;
mod coarse;
mod first_contact;
mod offers;
mod ownership;
mod picks;
mod refinement;
mod replay;
mod wrapping;

use std::sync::mpsc::Receiver;

use super::*;
use crate::input::{Key, KeyCode, KeyPress, PointerButton, Press};
use crate::keymap::{Action, Keymap};
use crate::worker::gate::Gate;
use proptest::prelude::*;
use trigon_camera::AxisView;
use trigon_mesh::primitives;
use trigon_scene::{Frame, Material, RenderSettings};

const SIZE: Viewport = Viewport { width: 96, height: 64 };

const fn ms(ms: u64) -> Duration {
    Duration::from_millis(ms)
}

fn stage() -> Stage {
    let mut stage = Stage::new("test");
    stage.scene.add_object("left", primitives::cube(1.0), Material::default());
    let right = stage.scene.add_object("right", primitives::cube(1.0), Material::default());
    stage.scene.node_mut(right).expect("just added").transform.translate(DVec3::X * 2.0);
    stage.set_home_direction(DVec3::NEG_Z);
    stage
}

/// Remembers what it was told, and animates for as long as it is set to.
#[derive(Default)]
struct Recorder {
    told: Vec<String>,
    frames_left: usize,
}

impl Handler for Recorder {
    fn start(&mut self, stage: &mut Stage) {
        self.told.push("start".into());
        stage.keymap.bind('g', "grid", Action::Command, "grid");
    }

    fn frame(&mut self, _: &mut Stage, tick: Tick) -> AnimationState {
        self.told.push(format!("frame {}", tick.delta.as_millis()));
        self.frames_left = self.frames_left.saturating_sub(1);
        if self.frames_left > 0 { AnimationState::Running } else { AnimationState::Resting }
    }

    fn command(&mut self, stage: &mut Stage, name: &str) {
        self.told.push(name.into());
        stage.request_image(RenderSettings::new(5, 4));
        stage.set_title("commanded");
    }

    fn dropped(&mut self, _: &mut Stage, paths: Vec<PathBuf>, _: Modifiers) {
        self.told.push(format!("{} dropped", paths.len()));
    }

    fn image(&mut self, stage: &mut Stage, frame: Frame) {
        self.told.push(format!("image {}x{}", frame.width, frame.height));
        stage.exit();
    }

    fn woken(&mut self, stage: &mut Stage) {
        self.told.push("woken".into());
        self.frames_left = 3;
        stage.animate();
    }
}

/// A session of a window that has just opened.
fn session_of<'h>(stage: Stage, handler: &'h mut Recorder, worker: Worker) -> Session<'h> {
    let mut session = Session::new(stage, handler, worker);
    session.event(InputEvent::Resized { width: SIZE.width, height: SIZE.height }, ms(0));
    session.start(ms(0));
    session
}

/// A session that has begun.
fn started(handler: &mut Recorder) -> Session<'_> {
    let session = session_of(stage(), handler, Worker::of_caller());
    assert_eq!(session.next(ms(0)), Wake::Now, "there is an image to draw");
    session
}

/// A session that has come to rest: a draft, a full image, and what the interface
/// needs to find its place.
fn begun(handler: &mut Recorder) -> Session<'_> {
    let mut session = started(handler);
    run(&mut session, ms(0));
    session
}

/// What is in the window after a frame; `None` if nothing of it has changed.
fn draw(session: &mut Session<'_>, now: Duration) -> Option<Vec<[u8; 4]>> {
    session.draw(now, &|| now).map(|canvas| canvas.pixels().to_vec())
}

/// Draws whenever the session asks for it until it asks no more; returns when
/// the window changed.
fn run(session: &mut Session<'_>, start: Duration) -> Vec<Duration> {
    let (mut now, mut times) = (start, Vec::new());
    for _ in 0..10_000 {
        match session.next(now) {
            Wake::Now => times.extend(draw(session, now).map(|_| now)),
            Wake::At(later) => now = later,
            Wake::Never => return times,
        }
    }
    panic!("it never comes to rest");
}

/// Lives with a worker on other threads until something is so, or it rests; returns that
/// moment. Time stands still while an image is drawn, and goes on to whatever is next.
/// An image that is finished as soon as it is begun is taken over before `rung` reports it, so the
/// condition is checked first.
fn live_until(
    session: &mut Session<'_>,
    rung: &Receiver<()>,
    start: Duration,
    is_so: impl Fn(&Session<'_>) -> bool,
) -> Duration {
    let mut now = start;
    while !is_so(session) {
        if session.worker.is_busy() {
            rung.recv().expect("whatever is begun ends");
            session.collect(now);
            continue;
        }
        match session.next(now) {
            Wake::Now => drop(draw(session, now)),
            Wake::At(later) => now = later,
            Wake::Never => break,
        }
    }
    now
}

/// Lives with a worker on other threads until it rests.
fn rest_beside(session: &mut Session<'_>, rung: &Receiver<()>, start: Duration) -> Duration {
    live_until(session, rung, start, |_| false)
}

fn key_down(code: u64, key: Key) -> InputEvent {
    InputEvent::KeyDown(KeyPress { code: KeyCode(code), logical: Some(key), physical: None, repeat: false })
}

fn drag(session: &mut Session<'_>, button: PointerButton, way: DVec2, now: Duration) {
    let from = SIZE.size() * 0.5;
    session.event(InputEvent::PointerMoved(from), now);
    session.event(InputEvent::Button(button, Press::Down), now);
    session.event(InputEvent::PointerMoved(from + way), now);
    session.event(InputEvent::Button(button, Press::Up), now);
}

#[test]
fn at_rest_nothing_is_asked_for() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    assert_eq!(session.next(ms(1)), Wake::Never, "one frame, and it is done");
    session.event(InputEvent::PointerMoved(DVec2::new(3.0, 3.0)), ms(2));
    session.event(InputEvent::Modifiers(Modifiers::SHIFT), ms(2));
    session.event(key_down(1, Key::Character('j')), ms(2));
    session.event(InputEvent::KeyUp(KeyCode(1)), ms(2));
    assert_eq!(
        session.next(ms(3)),
        Wake::Never,
        "a pointer that passes and a key without meaning change nothing"
    );
}

#[test]
fn a_drag_is_drawn_at_once_and_refined_once() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let before = session.stage.orbit;
    drag(&mut session, PointerButton::Left, DVec2::new(20.0, 0.0), ms(1000));
    assert_ne!(session.stage.orbit, before, "it turned");
    assert_eq!(run(&mut session, ms(1000)), [ms(1000), ms(1150)], "a draft, a full frame, and rest");
}

#[test]
fn the_mouse_does_what_the_keymap_says() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let start = session.stage.orbit;
    drag(&mut session, PointerButton::Middle, DVec2::new(20.0, 0.0), ms(1));
    assert_eq!(session.stage.orbit.orientation(), start.orientation(), "panning does not turn");
    assert_ne!(session.stage.orbit.target(), start.target(), "it moves");
    drag(&mut session, PointerButton::Right, DVec2::new(0.0, -20.0), ms(2));
    assert!(session.stage.orbit.distance() < start.distance(), "right and up is closer");
    session.event(InputEvent::Modifiers(Modifiers::CTRL), ms(3));
    let target = session.stage.orbit.target();
    drag(&mut session, PointerButton::Left, DVec2::new(0.0, 20.0), ms(3));
    assert_eq!(session.stage.orbit.target(), target, "rolling keeps the target");
    assert_ne!(session.stage.orbit.orientation(), start.orientation(), "and turns the image");
}

#[test]
fn wheel_and_control_zoom_to_the_pointer() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    // A pixel of the right-hand cube.
    let at = DVec2::new(70.0, 32.0);
    session.event(InputEvent::PointerMoved(at), ms(1));
    session.event(InputEvent::Modifiers(Modifiers::CTRL), ms(1));
    let (hit, point) = session.stage.pick(at).expect("a cube is there");
    (0..5).for_each(|_| session.event(InputEvent::Wheel(1.0), ms(2)));
    let projector = trigon_camera::Projector::new(&session.stage.camera(), SIZE);
    let now_at = projector.to_screen(point).expect("before the eye");
    assert!(now_at.distance(at) < 1e-3, "the point went from {at} to {now_at}");
    assert_eq!(session.stage.pick(at).map(|(hit, _)| hit), Some(hit), "and still the same face is there");
}

#[test]
fn clicks_select_what_is_seen() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let mut click = |at: DVec2| {
        session.event(InputEvent::PointerMoved(at), ms(1));
        session.event(InputEvent::Button(PointerButton::Left, Press::Down), ms(1));
        session.event(InputEvent::Button(PointerButton::Left, Press::Up), ms(1));
        let id = session.stage.selection;
        id.and_then(|id| session.stage.scene.node(id)).map(|node| node.name.clone())
    };
    assert_eq!(click(DVec2::new(20.0, 32.0)), Some("left".into()), "the cube on the left");
    assert_eq!(click(DVec2::new(75.0, 32.0)), Some("right".into()), "the other one");
    assert_eq!(click(DVec2::new(1.0, 1.0)), None, "background selects nothing");
}

#[test]
fn held_keys_move_until_they_are_released_or_the_focus_is_lost() {
    for end in [InputEvent::KeyUp(KeyCode(7)), InputEvent::FocusLost] {
        let mut handler = Recorder::default();
        let mut session = begun(&mut handler);
        let start = session.stage.orbit;
        session.event(key_down(7, Key::Left), ms(1000));
        for now in (1000..1500).step_by(17).map(ms) {
            assert_ne!(session.next(now), Wake::Never, "frames go on while a key is down");
            draw(&mut session, now);
        }
        assert_ne!(session.stage.orbit, start, "the camera moved");
        session.event(end.clone(), ms(1500));
        let stopped = session.stage.orbit;
        let last = run(&mut session, ms(1500));
        assert_eq!(session.stage.orbit, stopped, "{end:?} stops it");
        assert!(last.len() <= 2, "and the image comes to rest: {last:?}");
    }
}

#[test]
fn object_keys_move_the_selected_object_only() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    session.event(key_down(1, Key::Tab), ms(1));
    let id = session.stage.selection.expect("Tab selects the first object");
    let position = |session: &Session<'_>| session.stage.scene.world_transform(id).translation;
    let before = position(&session);
    session.event(InputEvent::Modifiers(Modifiers::ALT), ms(2));
    session.event(key_down(2, Key::Right), ms(2));
    (0..10).for_each(|i| drop(draw(&mut session, ms(20 + 17 * i))));
    let moved = position(&session) - before;
    assert!(moved.x > 0.0 && moved.y.abs() < 1e-12, "to the right: {moved}");
    let other = session.stage.scene.nodes().iter().find(|&(other, _)| other != id).expect("two cubes");
    assert_eq!(other.1.transform.translation(), DVec3::X * 2.0, "the other one stays");
}

#[test]
fn an_animation_runs_at_its_pace_and_ends() {
    let mut handler = Recorder { frames_left: 4, ..Recorder::default() };
    let mut session = started(&mut handler);
    let times = run(&mut session, ms(0));
    session.woken(ms(5000));
    let again = run(&mut session, ms(5000));
    // A frame in which no pixel differs is not presented.
    assert!(times.len() >= 2 && again.len() >= 2, "{times:?}, {again:?}");
    let frames = handler.told.iter().filter(|told| told.starts_with("frame")).count();
    assert_eq!(frames, 4 + 3, "as many as it asked for: {:?}", handler.told);
    assert!(!handler.told.contains(&"frame 5000".into()), "a pause is no long frame: {:?}", handler.told);
}

#[test]
fn the_handler_hears_of_everything_that_is_its_own() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    session.event(InputEvent::FileDropped("a.obj".into()), ms(1));
    session.event(InputEvent::FileDropped("b.obj".into()), ms(1));
    session.settle(ms(1));
    session.settle(ms(2));
    session.event(key_down(3, Key::Character('g')), ms(3));
    assert!(session.is_over(), "the image's receiver asked to exit");
    assert_eq!(session.stage.title(), "commanded", "and the title changed");
    let expected = ["start", "frame 16", "2 dropped", "grid", "image 5x4"];
    assert_eq!(handler.told, expected, "each once, in order");
}

#[test]
fn keys_change_the_view_and_the_sheet() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let plain = session.canvas().pixels().to_vec();
    session.event(key_down(1, Key::Character('h')), ms(1000));
    assert_eq!(session.next(ms(1000)), Wake::Now, "the sheet is to be drawn");
    run(&mut session, ms(1000));
    assert!(session.canvas().pixels() != plain, "it is there");
    session.event(key_down(2, Key::Escape), ms(3000));
    run(&mut session, ms(3000));
    assert!(session.canvas().pixels() == plain, "and gone without a trace");

    session.event(key_down(3, Key::Character('7')), ms(6000));
    let points: Vec<_> = session.stage.scene.visible_points().collect();
    let fitted = |view| {
        let mut orbit = session.stage.orbit;
        orbit.set_view(view);
        orbit.fit_points(&points, session.stage.viewport().aspect(), trigon_camera::DEFAULT_MARGIN);
        orbit
    };
    let [top, front] = [AxisView::Top, AxisView::Front].map(fitted);
    assert_eq!(session.stage.orbit, top, "7 is the top view");
    let code = KeyPress {
        code: KeyCode(4),
        logical: Some(Key::Character('&')),
        physical: Some(Key::Character('1')),
        repeat: false,
    };
    session.event(InputEvent::KeyDown(code), ms(6100));
    assert_eq!(session.stage.orbit, front, "digits work where the layout hides them behind Shift");
    session.event(key_down(5, Key::Enter), ms(6200));
    session.event(InputEvent::CloseRequested, ms(6300));
    assert!(session.is_over(), "the close button closes");
}

#[test]
fn a_minimized_window_sleeps_and_comes_back() {
    let mut handler = Recorder { frames_left: 1_000_000, ..Recorder::default() };
    let mut session = started(&mut handler);
    draw(&mut session, ms(10));
    assert_ne!(session.next(ms(20)), Wake::Never, "an animation runs");
    session.event(InputEvent::Resized { width: 0, height: 0 }, ms(30));
    assert_eq!(session.next(ms(40)), Wake::Never, "but not while nothing is seen");
    assert!(draw(&mut session, ms(40)).is_none(), "even if the system asks for a frame");
    session.event(InputEvent::Resized { width: 1, height: 1 }, ms(50));
    assert_eq!(draw(&mut session, ms(60)).map(|pixels| pixels.len()), Some(1), "the smallest window");
    session.event(InputEvent::Hidden, ms(70));
    assert_eq!(session.next(ms(80)), Wake::Never, "covered is as good as minimized");
    session.event(InputEvent::Shown, ms(90));
    assert_ne!(session.next(ms(90)), Wake::Never, "and seen again");
}

#[test]
fn a_new_size_and_scale_are_followed() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    session.event(InputEvent::Resized { width: 50, height: 70 }, ms(10));
    session.event(InputEvent::Scaled(2.0), ms(10));
    assert_eq!(
        draw(&mut session, ms(20)).map(|pixels| pixels.len()),
        Some(50 * 70),
        "as large as the window"
    );
    for nonsense in [0.0, -1.0, f64::NAN] {
        session.event(InputEvent::Scaled(nonsense), ms(30));
        assert_eq!(session.stage.scale(), 2.0, "{nonsense} is no scale");
    }
}

fn any_event() -> impl Strategy<Value = InputEvent> {
    let point = (-10.0..110.0, -10.0..80.0).prop_map(|(x, y)| DVec2::new(x, y));
    let button = prop::sample::select(vec![PointerButton::Left, PointerButton::Middle, PointerButton::Right]);
    let modifiers = prop::sample::select(vec![
        Modifiers::NONE,
        Modifiers::CTRL,
        Modifiers::SHIFT,
        Modifiers::ALT,
        Modifiers::ALT | Modifiers::SHIFT,
    ]);
    let keys = Keymap::default().bindings().to_vec();
    let sizes = prop::sample::select(vec![(0, 0), (1, 1), (40, 0), (SIZE.width, SIZE.height)]);
    prop_oneof![
        4 => point.prop_map(InputEvent::PointerMoved),
        4 => (button, any::<bool>())
            .prop_map(|(button, down)| InputEvent::Button(button, if down { Press::Down } else { Press::Up })),
        1 => (-10.0..10.0).prop_map(InputEvent::Wheel),
        1 => (-3.0..3.0).prop_map(InputEvent::Pinch),
        4 => (0u64..4, prop::sample::select(keys)).prop_map(|(code, binding)| key_down(code, binding.chord.key)),
        2 => (0u64..4).prop_map(|code| InputEvent::KeyUp(KeyCode(code))),
        2 => modifiers.prop_map(InputEvent::Modifiers),
        1 => Just(InputEvent::FocusLost),
        1 => sizes.prop_map(|(width, height)| InputEvent::Resized { width, height }),
        1 => prop_oneof![Just(InputEvent::Hidden), Just(InputEvent::Shown)],
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn whatever_happens_it_comes_to_rest_and_can_be_seen(events in prop::collection::vec(any_event(), 1..60)) {
        let mut handler = Recorder::default();
        let mut session = begun(&mut handler);
        for (event, now) in events.into_iter().zip((1000..).step_by(7).map(ms)) {
            session.event(event, now);
            if session.next(now) == Wake::Now {
                draw(&mut session, now);
            }
        }
        for event in [
            InputEvent::FocusLost,
            InputEvent::Shown,
            InputEvent::Resized { width: SIZE.width, height: SIZE.height },
            key_down(9, Key::Enter),
        ] {
            session.event(event, ms(5000));
        }
        run(&mut session, ms(5000));
        prop_assert_eq!(session.next(ms(60_000)), Wake::Never, "at rest");
        let bounds = session.stage.scene.bounds();
        prop_assert!(bounds.min.is_finite() && bounds.max.is_finite(), "objects are somewhere: {:?}", bounds);
        prop_assert!(session.stage.camera().position.is_finite(), "and so is the camera");
    }
}
