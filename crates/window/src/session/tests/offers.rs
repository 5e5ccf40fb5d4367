//! What the application is offered, and what becomes of what it takes or leaves.

use super::*;
use crate::input::{Hands, Input, InputOwner, Taken};
use crate::keymap::Keymap;
use egui::Event;

/// A panel on the left with a text field, and a tool that takes what `takes` says.
struct Tool {
    takes: fn(&Input, Hands) -> bool,
    offered: Vec<(Input, Hands)>,
    text: String,
    clicks: u32,
}

impl Tool {
    fn new(takes: fn(&Input, Hands) -> bool) -> Self {
        Self { takes, offered: Vec::new(), text: String::new(), clicks: 0 }
    }

    fn inputs(&self) -> Vec<Input> {
        self.offered.iter().map(|&(input, _)| input).collect()
    }
}

impl Handler for Tool {
    fn input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        self.offered.push((*input, hands));
        if (self.takes)(input, hands) {
            stage.set_title("taken");
            return Taken::Yes;
        }
        Taken::No
    }

    fn interface(&mut self, _: &mut Stage, ui: &mut egui::Ui) {
        egui::Panel::left("panel").exact_size(100.0).resizable(false).show(ui, |ui| {
            ui.text_edit_singleline(&mut self.text);
            self.clicks += u32::from(ui.button("press").clicked());
        });
    }
}

const WINDOW: Viewport = Viewport { width: 300, height: 200 };
/// On the text field, on the button, and on the cube on the right in the middle of the view.
const FIELD: DVec2 = DVec2::new(40.0, 16.0);
const BUTTON: DVec2 = DVec2::new(24.0, 40.0);
const VIEW: DVec2 = DVec2::new(200.0, 100.0);

fn opened(handler: &mut Tool) -> Session<'_> {
    let mut session = Session::new(stage(), handler, Worker::of_caller());
    session.event(InputEvent::Resized { width: WINDOW.width, height: WINDOW.height }, ms(0));
    session.start(ms(0));
    run(&mut session, ms(0));
    session
}

fn move_to(session: &mut Session<'_>, to: DVec2, now: Duration) {
    session.event(InputEvent::Interface(Event::PointerMoved(egui::pos2(to.x as f32, to.y as f32))), now);
    session.event(InputEvent::PointerMoved(to), now);
    run(session, now);
}

/// Presses or releases the left button where the pointer was moved to.
fn press(session: &mut Session<'_>, at: DVec2, press: Press, now: Duration) {
    let event = Event::PointerButton {
        pos: egui::pos2(at.x as f32, at.y as f32),
        button: egui::PointerButton::Primary,
        pressed: press == Press::Down,
        modifiers: egui::Modifiers::NONE,
    };
    session.event(InputEvent::Interface(event), now);
    session.event(InputEvent::Button(PointerButton::Left, press), now);
    run(session, now);
}

fn click(session: &mut Session<'_>, at: DVec2, now: Duration) {
    move_to(session, at, now);
    press(session, at, Press::Down, now);
    press(session, at, Press::Up, now);
}

fn tab(repeat: bool) -> InputEvent {
    InputEvent::KeyDown(KeyPress { code: KeyCode(1), logical: Some(Key::Tab), physical: None, repeat })
}

#[test]
fn a_button_that_was_taken_is_the_applications_until_its_release_over_panels_too() {
    let mut handler = Tool::new(|input, _| !matches!(input, Input::Key { .. }));
    let mut session = opened(&mut handler);
    let view = session.stage.orbit;
    move_to(&mut session, VIEW, ms(1000));
    press(&mut session, VIEW, Press::Down, ms(2000));
    move_to(&mut session, BUTTON, ms(3000));
    press(&mut session, BUTTON, Press::Up, ms(4000));
    assert_eq!(session.stage.orbit, view, "the camera did not turn");
    assert_eq!(session.stage.selection, None, "and nothing was clicked");
    assert_eq!(session.stage.title(), "taken", "what it changed is there");
    press(&mut session, BUTTON, Press::Down, ms(5000));
    press(&mut session, BUTTON, Press::Up, ms(5000));
    drop(session);
    let left = PointerButton::Left;
    let expected = [Input::PointerMoved, Input::Pressed(left), Input::PointerMoved, Input::Released(left)];
    assert_eq!(handler.inputs(), expected, "the last press was the panel's");
    assert_eq!(handler.offered[3].1.pointer, Some(BUTTON), "with the place of the pointer");
    assert_eq!(handler.clicks, 1, "the button of the panel was clicked once, and not by the drag");
}

#[test]
fn what_the_application_leaves_goes_to_camera_and_keymap() {
    let mut handler = Tool::new(|_, _| false);
    let mut session = opened(&mut handler);
    let view = session.stage.orbit;
    move_to(&mut session, VIEW, ms(1000));
    press(&mut session, VIEW, Press::Down, ms(2000));
    move_to(&mut session, VIEW + DVec2::X * 30.0, ms(3000));
    press(&mut session, VIEW + DVec2::X * 30.0, Press::Up, ms(4000));
    assert_ne!(session.stage.orbit, view, "the drag turned the camera");
    let turned = session.stage.orbit;
    session.event(InputEvent::Wheel(1.0), ms(5000));
    assert!(session.stage.orbit.distance() < turned.distance(), "the wheel zooms");
    session.event(tab(false), ms(6000));
    assert!(session.stage.selection.is_some(), "and Tab selects");
    drop(session);
    let offered = handler.inputs();
    assert_eq!(offered[..2], [Input::PointerMoved, Input::Pressed(PointerButton::Left)], "all was offered");
    assert_eq!(offered[2], Input::Wheel(1.0), "but not what belonged to the drag of the camera");
}

#[test]
fn a_click_that_was_no_drag_is_offered_with_the_modifiers_of_its_press() {
    let mut handler = Tool::new(|input, _| matches!(input, Input::Clicked(_)));
    let mut session = opened(&mut handler);
    session.event(InputEvent::Modifiers(Modifiers::ALT), ms(500));
    move_to(&mut session, VIEW, ms(1000));
    press(&mut session, VIEW, Press::Down, ms(2000));
    session.event(InputEvent::Modifiers(Modifiers::NONE), ms(2500));
    press(&mut session, VIEW, Press::Up, ms(3000));
    assert_eq!(session.stage.selection, None, "the keymap's click did not follow");
    drop(session);
    let hands = Hands { pointer: Some(VIEW), modifiers: Modifiers::ALT };
    let clicked = (Input::Clicked(PointerButton::Left), hands);
    assert_eq!(handler.offered.last(), Some(&clicked), "where and how it was pressed");
}

#[test]
fn tab_reaches_the_application_unless_a_widget_has_the_keyboard() {
    let mut handler = Tool::new(|input, _| matches!(input, Input::Key { .. }));
    let mut session = opened(&mut handler);
    session.event(tab(false), ms(1000));
    session.event(tab(true), ms(1500));
    session.event(InputEvent::KeyUp(KeyCode(1)), ms(2000));
    assert_eq!(session.stage.selection, None, "the keymap did not get it");
    assert!(!session.interface.wants_keyboard(), "nor did the interface");
    click(&mut session, FIELD, ms(3000));
    session.event(tab(false), ms(4000));
    session.event(InputEvent::KeyUp(KeyCode(1)), ms(4100));
    drop(session);
    let key = |repeat| Input::Key { logical: Some(Key::Tab), physical: None, repeat };
    let released = Input::KeyReleased { logical: Some(Key::Tab), physical: None };
    let expected = [key(false), key(true), released];
    let keys: Vec<_> =
        handler.inputs().into_iter().filter(|input| !matches!(input, Input::PointerMoved)).collect();
    assert_eq!(keys, expected, "with its repetition and its release, and not while a field is typed into");
}

#[test]
fn a_running_tool_owns_the_pointer_over_panels_and_the_keys_of_text_fields() {
    let mut handler = Tool::new(|_, _| true);
    let mut session = opened(&mut handler);
    click(&mut session, FIELD, ms(1000));
    assert!(session.interface.wants_keyboard(), "the field has the keyboard");
    session.stage.input_owner = InputOwner::Application;
    session.event(InputEvent::Interface(Event::Text("x".into())), ms(2000));
    session.event(key_down(5, Key::Character('x')), ms(2000));
    click(&mut session, BUTTON, ms(3000));
    session.event(InputEvent::Wheel(1.0), ms(4000));
    session.stage.input_owner = InputOwner::Interface;
    click(&mut session, BUTTON, ms(5000));
    drop(session);
    assert_eq!((handler.text.as_str(), handler.clicks), ("", 1), "only the last click was the panel's");
    let left = PointerButton::Left;
    let expected = [
        Input::Key { logical: Some(Key::Character('x')), physical: None, repeat: false },
        Input::Pressed(left),
        Input::Released(left),
        Input::Wheel(1.0),
    ];
    let told: Vec<_> =
        handler.inputs().into_iter().filter(|input| !matches!(input, Input::PointerMoved)).collect();
    assert_eq!(told, expected, "the tool got the rest");
}

#[test]
fn a_lost_focus_ends_what_was_taken() {
    let mut handler = Tool::new(|input, _| matches!(input, Input::Pressed(_) | Input::Key { .. }));
    let mut session = opened(&mut handler);
    move_to(&mut session, VIEW, ms(1000));
    press(&mut session, VIEW, Press::Down, ms(2000));
    session.event(tab(false), ms(2500));
    session.event(InputEvent::FocusLost, ms(3000));
    session.event(InputEvent::KeyUp(KeyCode(1)), ms(3500));
    press(&mut session, VIEW, Press::Up, ms(4000));
    drop(session);
    assert_eq!(handler.inputs().last(), Some(&Input::FocusLost), "no release follows");
}

#[test]
fn an_application_with_a_keymap_of_its_own_has_none_of_the_windows() {
    let mut handler = Tool::new(|_, _| false);
    let mut session = opened(&mut handler);
    session.stage.keymap = Keymap::empty();
    let (view, style) = (session.stage.orbit, session.stage.settings.style);
    for (code, key) in ['h', 'e', '7', '5', 'k', 'a', '.'].into_iter().enumerate() {
        session.event(key_down(code as u64, Key::Character(key)), ms(1000));
    }
    for (code, key) in [Key::Tab, Key::Enter, Key::Left, Key::Function(6)].into_iter().enumerate() {
        session.event(key_down(100 + code as u64, key), ms(1000));
    }
    click(&mut session, VIEW, ms(2000));
    for button in [PointerButton::Left, PointerButton::Middle, PointerButton::Right] {
        drag(&mut session, button, DVec2::new(20.0, 9.0), ms(3000));
    }
    assert_eq!((session.stage.orbit, session.stage.settings.style), (view, style), "nothing changed");
    assert_eq!((session.stage.selection, session.stage.cheat_sheet), (None, Visibility::Hidden), "at all");
}

#[test]
fn a_pinch_magnifies_the_view_unless_the_application_takes_it() {
    for is_taken in [false, true] {
        let mut handler = Tool::new(|_, _| false);
        if is_taken {
            handler.takes = |input, _| matches!(input, Input::Pinch(_));
        }
        let larger = if is_taken { 1.0 } else { std::f64::consts::E };
        let mut session = opened(&mut handler);
        move_to(&mut session, VIEW, ms(1000));
        let before = session.stage.orbit.distance();
        session.event(InputEvent::Pinch(1.0), ms(2000));
        let found = before / session.stage.orbit.distance();
        assert!((found - larger).abs() < 1e-9, "{found} times as large, not {larger}");
        drop(session);
        assert_eq!(handler.inputs().last(), Some(&Input::Pinch(1.0)), "it was asked first");
    }
}
