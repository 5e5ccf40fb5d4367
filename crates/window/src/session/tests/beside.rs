//! Pictures that are drawn beside the window's thread.

use std::sync::mpsc::{Receiver, channel};
use std::time::Instant;

use super::*;
use trigon_scene::render;

/// A session with a drawing thread, and what rings when a picture is finished.
fn threaded(stage: Stage, handler: &mut Recorder, size: Viewport) -> (Session<'_>, Receiver<()>) {
    let (ring, rung) = channel();
    let mut session = Session::new(
        stage,
        handler,
        Worker::of_thread(move || {
            let _ = ring.send(());
        }),
    );
    session.event(InputEvent::Resized { width: size.width, height: size.height }, ms(0));
    session.start(ms(0));
    (session, rung)
}

/// Lives until it rests.
fn rest(session: &mut Session<'_>, rung: &Receiver<()>, begun: Instant) {
    loop {
        match session.next(begun.elapsed()) {
            Wake::Now => drop(draw(session, begun.elapsed())),
            Wake::At(_) => std::thread::sleep(ms(1)),
            Wake::Never if session.worker.is_busy() => {
                rung.recv_timeout(Duration::from_secs(120)).expect("a picture ends");
                session.collect(begun.elapsed());
            }
            Wake::Never => return,
        }
    }
}

#[test]
fn at_rest_the_window_holds_what_a_picture_file_would() {
    let begun = Instant::now();
    let mut handler = Recorder::default();
    let (mut session, rung) = threaded(stage(), &mut handler, SIZE);
    rest(&mut session, &rung, begun);
    drag(&mut session, PointerButton::Left, DVec2::new(20.0, 5.0), begun.elapsed());
    rest(&mut session, &rung, begun);
    let stage = session.stage();
    let settings = RenderSettings { width: SIZE.width, height: SIZE.height, ..stage.settings.clone() };
    let expected = render(&stage.scene, &stage.camera(), &settings).expect("drawn");
    assert!(session.shown.as_deref() == Some(&expected), "the same bytes");
    assert_eq!(session.next(begun.elapsed() + Duration::from_secs(3600)), Wake::Never, "and it stays so");
}

/// A picture of 256 samples a pixel: more than five seconds on any machine of today.
fn slow_stage() -> Stage {
    let mut stage = Stage::new("slow");
    *stage.scene = trigon_scene::showcase();
    stage.settings.samples_per_axis = 4;
    stage.settings.samples = 16;
    stage
}

/// The 95th of 100 presses must show within 100 ms, while a picture is drawn that
/// takes longer than all of them. On a machine that others keep busy they take longer
/// without any picture, too; beside a picture then not much longer than that.
#[test]
fn a_key_shows_at_once_while_a_picture_takes_seconds() {
    const LARGE: Viewport = Viewport { width: 1920, height: 1080 };
    let begun = Instant::now();
    let mut handler = Recorder::default();
    let (mut session, rung) = threaded(stage(), &mut handler, LARGE);
    rest(&mut session, &rung, begun);
    let alone = presses(&mut session, begun);
    let mut handler = Recorder::default();
    let (mut session, rung) = threaded(slow_stage(), &mut handler, LARGE);
    // The draft comes first; then the full picture is begun.
    draw(&mut session, begun.elapsed());
    rung.recv_timeout(Duration::from_secs(120)).expect("the draft ends");
    session.collect(begun.elapsed());
    while session.next(begun.elapsed()) != Wake::Never {
        draw(&mut session, begun.elapsed());
        std::thread::sleep(ms(1));
    }
    assert!(session.worker.is_busy(), "a picture is under way");
    let beside = presses(&mut session, begun);
    assert!(rung.try_recv().is_err(), "and still is");
    let most = (4 * alone).max(ms(100));
    assert!(beside < most, "{beside:?} beside a picture, {alone:?} without one");
    let cancelled = Instant::now();
    session.event(key_down(5, Key::Character('7')), begun.elapsed());
    session.settle(begun.elapsed());
    rung.recv_timeout(Duration::from_secs(120)).expect("it ends");
    session.collect(begun.elapsed());
    println!("{beside:?} beside, {alone:?} alone, ended after {:?}", cancelled.elapsed());
}

/// The 95th of 100 presses.
fn presses(session: &mut Session<'_>, begun: Instant) -> Duration {
    let mut times: Vec<Duration> = (0..100).map(|press| time_of_press(session, press, begun)).collect();
    times.sort();
    times[94]
}

/// Shows or hides the list of keys, as the window's loop would; returns how long it
/// took until other pixels were in the window.
fn time_of_press(session: &mut Session<'_>, press: u64, begun: Instant) -> Duration {
    let pressed = Instant::now();
    session.event(key_down(press, Key::Character('h')), begun.elapsed());
    session.event(InputEvent::KeyUp(KeyCode(press)), begun.elapsed());
    session.settle(begun.elapsed());
    while pressed.elapsed() < Duration::from_secs(10) {
        if session.next(begun.elapsed()) == Wake::Now && draw(session, begun.elapsed()).is_some() {
            return pressed.elapsed();
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    panic!("press {press} never shows");
}
