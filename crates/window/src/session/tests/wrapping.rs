//! A drag beyond a border of the window.

use super::*;
use crate::input::{Hands, Input, Taken};

/// Adds up how far the pointer goes, as a tool does.
#[derive(Default)]
struct Dragged {
    last: Option<DVec2>,
    way: DVec2,
    moves: usize,
    jumps: usize,
}

impl Handler for Dragged {
    fn input(&mut self, _: &mut Stage, input: &Input, hands: Hands) -> Taken {
        if let (Input::PointerMoved, Some(to)) = (input, hands.pointer) {
            let from = self.last.replace(to).unwrap_or(to);
            self.way += to - from;
            self.moves += 1;
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
        assert_eq!(session.take_pointer_position(), None, "far from all borders");
        session.settle(ms(1));
        move_to(session, 199.0);
        assert_eq!(session.take_pointer_position(), Some(DVec2::new(4.0, 50.0)), "to the left");
        // One more was under way before the pointer was put there.
        move_to(session, 198.0);
        move_to(session, 6.0);
        assert_eq!(session.take_pointer_position(), None, "once");
        move_to(session, 16.0);
        session.settle(ms(2));
    });
    assert_eq!(handler.jumps, 1);
    assert_eq!(handler.way, DVec2::X * (48.0 + 12.0), "the way across the window is none");
}

#[test]
fn where_the_system_refuses_the_pointer_stays() {
    let handler = dragged(|session| {
        move_to(session, 199.0);
        session.settle(ms(1));
        session.pointer_stays();
        assert!(!session.keeps_pointer(), "and may leave the window");
        move_to(session, 100.0);
        move_to(session, 199.0);
        assert_eq!(session.take_pointer_position(), None, "it is not asked again");
        move_to(session, 4.0);
        session.settle(ms(2));
    });
    assert_eq!((handler.jumps, handler.way.x), (0, -195.0), "a movement like all others");
}

/// A mouse that reports a thousand movements a second kept the window from drawing: each of them moved all vertices.
#[test]
fn movements_that_arrive_together_are_one() {
    let handler = dragged(|session| {
        (0..100).for_each(|step| move_to(session, 50.0 + f64::from(step)));
        session.settle(ms(2));
        session.settle(ms(3));
        (0..10).for_each(|step| move_to(session, 150.0 - f64::from(step)));
        // A key, with the pointer where it has come to.
        session.event(InputEvent::Modifiers(Modifiers::SHIFT), ms(4));
        move_to(session, 100.0);
    });
    assert_eq!((handler.moves, handler.way.x), (2, 141.0 - 149.0), "one for all, one before the key");
}

#[test]
fn each_movement_counts_where_the_way_matters() {
    let mut handler = Dragged::default();
    let mut session = Session::new(stage(), &mut handler, Worker::of_caller());
    session.event(InputEvent::Resized { width: 200, height: 100 }, ms(0));
    session.start(ms(0));
    (0..100).for_each(|step| move_to(&mut session, 50.0 + f64::from(step)));
    assert_eq!(handler.moves, 100, "as for a lasso");
}

/// A drag while the first draft waits at a gate.
fn dragged_beside_a_draft(moves: impl FnOnce(&mut Session<'_>, &Gate, &Receiver<()>)) -> Dragged {
    let gate = Gate::default();
    let (worker, rung) = gate.worker(|_| true);
    let (mut handler, mut stage) = (Dragged::default(), stage());
    stage.wraps_pointer = true;
    let mut session = Session::new(stage, &mut handler, worker);
    session.event(InputEvent::Resized { width: 200, height: 100 }, ms(0));
    session.start(ms(0));
    assert!(session.draw(ms(0), &|| ms(0)).is_some(), "the draft is begun");
    moves(&mut session, &gate, &rung);
    gate.open();
    drop(session);
    handler
}

/// The next image shows where the pointer is when the one before is finished.
#[test]
fn movements_wait_for_the_draft_under_way() {
    let handler = dragged_beside_a_draft(|session, gate, rung| {
        for time in 1..50 {
            session.event(InputEvent::PointerMoved(DVec2::new(50.0 + time as f64, 50.0)), ms(time));
            session.settle(ms(time));
        }
        assert!(session.has_moved, "nobody was told");
        gate.open();
        rung.recv().expect("it is finished");
        session.collect(ms(50));
        assert!(!session.has_moved, "but now");
    });
    assert_eq!((handler.moves, handler.last), (1, Some(DVec2::new(99.0, 50.0))), "once");
}

/// An image that takes long must not keep the numbers of a tool from changing.
#[test]
fn movements_do_not_wait_for_a_draft_that_takes_long() {
    let handler = dragged_beside_a_draft(|session, _, _| {
        for time in [10, 500] {
            session.event(InputEvent::PointerMoved(DVec2::new(50.0, 50.0)), ms(time));
            session.settle(ms(time));
            assert_eq!(session.has_moved, time == 10, "after {time} ms");
        }
    });
    assert_eq!(handler.moves, 1, "of the one that waited, too");
}
