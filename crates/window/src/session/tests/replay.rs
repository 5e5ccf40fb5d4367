//! Recorded sessions give the same pictures again.

use super::*;
use crate::interaction::Interaction;

/// Does what was recorded, and draws whenever it is time to; returns all that was to be
/// seen.
fn replay(mut interaction: Interaction) -> Vec<Vec<[u8; 4]>> {
    let mut handler = Recorder::default();
    let mut session = Session::new(stage(), &mut handler, Worker::of_caller());
    let (mut now, mut seen) = (ms(0), Vec::new());
    while let Some(event) = interaction.next(now) {
        session.event(event, now);
    }
    session.start(now);
    for _ in 0..10_000 {
        while let Some(event) = interaction.next(now) {
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
fn a_recorded_session_gives_the_same_pictures() {
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
