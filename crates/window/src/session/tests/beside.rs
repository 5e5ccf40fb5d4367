//! Images that are drawn beside the window's thread.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::channel;

use super::*;
use crate::pacing::Quality;
use crate::worker::Purpose;
use trigon_scene::render;

/// What an image file would hold.
fn file(stage: &Stage) -> Frame {
    let outputs = crate::shown::OUTPUTS;
    let settings =
        RenderSettings { width: SIZE.width, height: SIZE.height, outputs, ..stage.settings.clone() };
    render(&stage.scene, &stage.camera(), &settings).expect("drawn")
}

#[test]
fn at_rest_the_window_holds_what_an_image_file_would() {
    // What images take by the worker's clock: drafts are small where they take long.
    for took in [ms(0), ms(500)] {
        let ((ring, rung), moments) = (channel(), Arc::new(AtomicU32::new(0)));
        let clock = move || took * moments.fetch_add(1, Ordering::Relaxed);
        let mut handler = Recorder::default();
        let ring = move || {
            // Fails when the test is over.
            let _ = ring.send(());
        };
        let worker = Worker::of_threads(ring, clock);
        let mut session = session_of(stage(), &mut handler, worker);
        let now = rest_beside(&mut session, &rung, ms(0)) + ms(1000);
        drag(&mut session, PointerButton::Left, DVec2::new(20.0, 5.0), now);
        let now = rest_beside(&mut session, &rung, now);
        assert_eq!(session.stage().report().render, took, "as the clock says");
        assert!(session.shown.as_deref() == Some(&file(session.stage())), "the same bytes");
        assert_eq!(session.next(now + Duration::from_secs(3600)), Wake::Never, "and it stays so");
    }
}

/// Shows or hides the list of keys; whether other pixels are then in the window, drawn
/// whenever the session asks for it.
fn shows_a_key(session: &mut Session<'_>, press: u64, now: Duration) -> bool {
    // Letters are searched for in the open list.
    let key = if press.is_multiple_of(2) { Key::Character('h') } else { Key::Escape };
    session.event(key_down(press, key), now);
    session.event(InputEvent::KeyUp(KeyCode(press)), now);
    session.settle(now);
    let before = session.canvas().pixels().to_vec();
    let frames = (0..10).map(|frame| now + ms(17) * frame);
    for now in frames {
        if session.next(now) == Wake::Now {
            draw(session, now);
        }
    }
    session.canvas().pixels() != before
}

/// However long an image takes: the one as the settings say is not finished before the
/// test opens the gate.
#[test]
fn keys_show_while_an_image_is_drawn() {
    let gate = Gate::default();
    let (worker, rung) = gate.worker(|purpose| purpose == Purpose::Window(Quality::Full(0)));
    let mut handler = Recorder::default();
    let mut session = session_of(stage(), &mut handler, worker);
    let is_drawn_in_full = |session: &Session<'_>| session.worker.is_busy() && session.shown.is_some();
    live_until(&mut session, &rung, ms(0), is_drawn_in_full);
    for press in 0..6 {
        assert!(shows_a_key(&mut session, press, ms(1000 * (press + 1))), "press {press}");
        assert!(is_drawn_in_full(&session), "the image is still under way after press {press}");
    }
    session.event(key_down(7, Key::Character('7')), ms(8000));
    session.settle(ms(8000));
    assert!(session.worker.is_busy(), "another view waits until it has been given up");
    gate.open();
    rest_beside(&mut session, &rung, ms(8000));
    assert!(session.shown.as_deref() == Some(&file(session.stage())), "and is drawn then");
}
