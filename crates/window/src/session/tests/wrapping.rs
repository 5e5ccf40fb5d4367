//! A drag beyond a border of the window.

use super::*;
use crate::input::{Hands, Input, Taken};

/// Adds up how far the pointer goes, as a tool does.
#[derive(Default)]
struct Dragged {
    last: Option<DVec2>,
    way: DVec2,
    jumps: usize,
}

impl Handler for Dragged {
    fn input(&mut self, _: &mut Stage, input: &Input, hands: Hands) -> Taken {
        if let (Input::PointerMoved, Some(to)) = (input, hands.pointer) {
            let from = self.last.replace(to).unwrap_or(to);
            self.way += to - from;
        }
        Taken::Yes
    }

    fn pointer_jumped(&mut self, _: &mut Stage, to: DVec2) {
        self.last = Some(to);
        self.jumps += 1;
    }
}

fn dragged(moves: impl Fn(&mut Session<'_>)) -> Dragged {
    let mut handler = Dragged::default();
    let mut stage = stage();
    stage.wraps_pointer = true;
    let mut session = Session::new(stage, &mut handler, Worker::of_caller());
    session.event(InputEvent::Resized { width: 200, height: 100 }, ms(0));
    session.start(ms(0));
    moves(&mut session);
    handler
}

fn move_to(session: &mut Session<'_>, x: f64) {
    session.event(InputEvent::PointerMoved(DVec2::new(x, 50.0)), ms(1));
}

#[test]
fn a_drag_goes_on_from_the_other_side() {
    let handler = dragged(|session| {
        move_to(session, 150.0);
        assert_eq!(session.take_pointer_place(), None, "far from all borders");
        move_to(session, 199.0);
        assert_eq!(session.take_pointer_place(), Some(DVec2::new(4.0, 50.0)), "to the left");
        // One more was under way before the pointer was put there.
        move_to(session, 198.0);
        move_to(session, 6.0);
        assert_eq!(session.take_pointer_place(), None, "once");
        move_to(session, 16.0);
    });
    assert_eq!(handler.jumps, 1);
    assert_eq!(handler.way, DVec2::X * (48.0 + 12.0), "the way across the window is none");
}

#[test]
fn where_the_system_refuses_the_pointer_stays() {
    let handler = dragged(|session| {
        move_to(session, 199.0);
        session.pointer_stays();
        assert!(!session.keeps_pointer(), "and may leave the window");
        move_to(session, 100.0);
        move_to(session, 199.0);
        assert_eq!(session.take_pointer_place(), None, "it is not asked again");
        move_to(session, 4.0);
    });
    assert_eq!((handler.jumps, handler.way.x), (0, -195.0), "a movement like all others");
}
