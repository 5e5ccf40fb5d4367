//! Recorded sessions give the same images again.

use super::*;
use crate::interaction::Interaction;

/// Does what was recorded, and draws whenever it is time to; returns all that was to be
/// seen.
fn replay(mut interaction: Interaction) -> Vec<Vec<[u8; 4]>> {
    let mut handler = Recorder::default();
    let mut session = Session::new(stage(), &mut handler, Worker::of_caller());
    let (mut now, mut seen) = (ms(0), Vec::new());
    while let Some((_, event)) = interaction.next(now) {
        session.event(event, now);
    }
    session.start(now);
    for _ in 0..10_000 {
        while let Some((_, event)) = interaction.next(now) {
            session.event(event, now);
        }
        session.settle(now);
        now = match (session.next(now), interaction.due()) {
            (Wake::Now, _) => {
                seen.extend(draw(&mut session, now));
                continue;
            }
            (Wake::At(later), Some(due)) => later.min(due),
            (Wake::At(later), None) => later,
            (Wake::Never, Some(due)) => due,
            (Wake::Never, None) => return seen,
        };
    }
    panic!("it never comes to rest");
}

#[test]
fn a_recorded_session_gives_the_same_images() {
    let mut handler = Recorder::default();
    let mut session = Session::new(stage(), &mut handler, Worker::of_caller());
    session.record();
    session.event(InputEvent::Resized { width: SIZE.width, height: SIZE.height }, ms(0));
    session.start(ms(0));
    run(&mut session, ms(0));
    let moved = egui::Event::PointerMoved(egui::pos2(20.25, 9.5));
    session.event(InputEvent::Interface(moved), ms(900));
    drag(&mut session, PointerButton::Left, DVec2::new(21.5, 4.25), ms(1000));
    run(&mut session, ms(1000));
    session.event(InputEvent::Modifiers(Modifiers::CTRL), ms(4000));
    session.event(InputEvent::Wheel(1.5), ms(4000));
    session.event(key_down(3, Key::Character('7')), ms(4100));
    session.event(InputEvent::FocusLost, ms(4200));
    session.event(key_down(3, Key::Character('e')), ms(4300));
    run(&mut session, ms(4300));
    let recorded = session.take_recorded().expect("it was recorded");
    let read = Interaction::from_text(&recorded.to_text()).expect("as it was written");
    assert_eq!(read, recorded, "through text and back");
    let (one, other) = (replay(recorded), replay(read));
    assert!(one.len() > 5, "there was something to see: {} frames", one.len());
    assert!(one == other, "the same frames");
    assert_eq!(one.last().expect("a last frame"), session.canvas().pixels(), "which end as the first time");
}

/// A replay zoomed further than the hands had, because its frames took longer.
#[test]
fn held_keys_move_as_far_whenever_frames_are_drawn() {
    let end = |frame_time: usize| {
        let mut handler = Recorder::default();
        let mut session = begun(&mut handler);
        let start = session.stage.orbit;
        let mut frames = (1000..2000).step_by(frame_time).map(ms);
        for (at, event) in [
            (1003, key_down(7, Key::Left)),
            (1250, key_down(8, Key::PageUp)),
            (1502, InputEvent::KeyUp(KeyCode(7))),
            (1733, InputEvent::KeyUp(KeyCode(8))),
        ] {
            frames.by_ref().take_while(|now| *now < ms(at)).for_each(|now| drop(draw(&mut session, now)));
            session.event(event, ms(at));
        }
        assert_ne!(session.stage.orbit, start, "they move");
        session.stage.orbit
    };
    assert_eq!(end(16), end(390), "to the bit");
    assert_eq!(end(16), end(7), "to the bit");
}
