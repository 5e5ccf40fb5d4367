//! Who gets what: the interface first, then camera and objects.

use super::*;
use egui::Event;

/// A panel on the left with a text field and a button.
#[derive(Default)]
struct Panel {
    text: String,
    clicks: u32,
    passes: u32,
    turns_edges_on: bool,
}

const PANEL: f32 = 100.0;
const WINDOW: Viewport = Viewport { width: 300, height: 200 };

impl Handler for Panel {
    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        self.passes += 1;
        egui::Panel::left("panel").exact_size(PANEL).resizable(false).show(ui, |ui| {
            ui.text_edit_singleline(&mut self.text);
            if ui.button("press").clicked() {
                self.clicks += 1;
                if self.turns_edges_on {
                    stage.settings.style = trigon_scene::Style::SurfaceWithEdges;
                }
            }
        });
    }
}

fn opened(handler: &mut Panel) -> Session<'_> {
    let mut session = Session::new(stage(), handler, Worker::of_caller());
    session.event(InputEvent::Resized { width: WINDOW.width, height: WINDOW.height }, ms(0));
    session.start(ms(0));
    run(&mut session, ms(0));
    session
}

/// As the shell tells it: the interface's form, then ours.
fn move_to(session: &mut Session<'_>, x: f64, y: f64, now: Duration) {
    session.event(InputEvent::Interface(Event::PointerMoved(egui::pos2(x as f32, y as f32))), now);
    session.event(InputEvent::PointerMoved(DVec2::new(x, y)), now);
    run(session, now);
}

fn press(session: &mut Session<'_>, (x, y): (f64, f64), press: Press, now: Duration) {
    let event = Event::PointerButton {
        pos: egui::pos2(x as f32, y as f32),
        button: egui::PointerButton::Primary,
        pressed: press == Press::Down,
        modifiers: egui::Modifiers::NONE,
    };
    session.event(InputEvent::Interface(event), now);
    session.event(InputEvent::Button(PointerButton::Left, press), now);
    run(session, now);
}

fn click(session: &mut Session<'_>, (x, y): (f64, f64), now: Duration) {
    move_to(session, x, y, now);
    press(session, (x, y), Press::Down, now);
    press(session, (x, y), Press::Up, now);
}

fn type_letter(session: &mut Session<'_>, letter: char, now: Duration) {
    session.event(InputEvent::Interface(Event::Text(letter.into())), now);
    session.event(key_down(u64::from(letter), Key::Character(letter)), now);
    session.event(InputEvent::KeyUp(KeyCode(u64::from(letter))), now);
    run(session, now);
}

/// In the panel: the middle of the text field and of the button.
const FIELD: (f64, f64) = (40.0, 16.0);
const BUTTON: (f64, f64) = (24.0, 40.0);

#[test]
fn drags_belong_to_whoever_they_began_on() {
    let mut handler = Panel::default();
    let mut session = opened(&mut handler);
    let start = session.stage.orbit;
    move_to(&mut session, 40.0, 150.0, ms(1000));
    press(&mut session, (40.0, 150.0), Press::Down, ms(2000));
    move_to(&mut session, 250.0, 150.0, ms(3000));
    assert_eq!(session.stage.orbit, start, "begun on the panel: nothing turns");
    press(&mut session, (250.0, 150.0), Press::Up, ms(4000));
    press(&mut session, (250.0, 150.0), Press::Down, ms(5000));
    move_to(&mut session, 40.0, 150.0, ms(6000));
    let turned = session.stage.orbit;
    assert_ne!(turned, start, "begun beside it: it turns, over the panel, too");
    press(&mut session, (40.0, 150.0), Press::Up, ms(7000));
    move_to(&mut session, 250.0, 100.0, ms(8000));
    assert_eq!(session.stage.orbit, turned, "the release was heard over the panel");
    session.event(InputEvent::PointerMoved(DVec2::new(40.0, 150.0)), ms(9000));
    session.event(InputEvent::Wheel(3.0), ms(10000));
    assert_eq!(session.stage.orbit, turned, "a wheel over the panel scrolls the panel");
    session.event(InputEvent::PointerMoved(DVec2::new(250.0, 150.0)), ms(11000));
    session.event(InputEvent::Wheel(3.0), ms(12000));
    assert!(session.stage.orbit.distance() < turned.distance(), "beside it, it zooms");
}

#[test]
fn keys_go_to_a_text_field_that_is_typed_into() {
    let mut handler = Panel::default();
    let mut session = opened(&mut handler);
    type_letter(&mut session, 'h', ms(1000));
    assert_eq!(session.stage.cheat_sheet, Visibility::Shown, "H is a key of the window");
    type_letter(&mut session, 's', ms(1200));
    assert_eq!(session.stage.command_search, "s", "a letter of its search from the moment it opens");
    session.event(key_down(1, Key::Escape), ms(1500));
    run(&mut session, ms(1500));
    assert_eq!(session.stage.cheat_sheet, Visibility::Hidden, "Escape closes it");
    assert!(!session.interface.wants_keyboard(), "and keys are the window's again");
    click(&mut session, FIELD, ms(2000));
    type_letter(&mut session, 'h', ms(3000));
    assert_eq!(session.stage.cheat_sheet, Visibility::Hidden, "and now a letter");
    click(&mut session, (250.0, 100.0), ms(4000));
    type_letter(&mut session, 'h', ms(5000));
    assert_eq!(session.stage.cheat_sheet, Visibility::Shown, "a click beside the field leaves it");
    drop(session);
    assert_eq!(handler.text, "h", "typed once");
}

#[test]
fn what_a_widget_changes_is_drawn_and_what_it_does_not_is_not() {
    let mut handler = Panel { turns_edges_on: true, ..Panel::default() };
    let mut session = opened(&mut handler);
    let (image, subject) = (session.shown.clone(), session.subject.clone());
    move_to(&mut session, BUTTON.0, BUTTON.1, ms(1000));
    assert!(session.subject == subject, "passing over a widget draws no image");
    click(&mut session, BUTTON, ms(2000));
    run(&mut session, ms(2000));
    assert!(session.subject != subject, "the edges are on");
    assert!(session.shown != image, "and to be seen");
    drop(session);
    assert_eq!(handler.clicks, 1, "one click");
}

#[test]
fn the_keyboard_finds_into_the_interface_and_out_of_it() {
    let mut handler = Panel::default();
    let mut session = opened(&mut handler);
    assert!(!session.interface.wants_keyboard(), "at first keys are the window's");
    session.event(key_down(1, Key::Function(6)), ms(1000));
    run(&mut session, ms(1000));
    assert!(session.interface.wants_keyboard(), "F6 gives them to the first widget");
    let (key, modifiers) = (egui::Key::Escape, egui::Modifiers::NONE);
    let escape = Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    session.event(InputEvent::Interface(escape), ms(2000));
    run(&mut session, ms(2000));
    assert!(!session.interface.wants_keyboard(), "Escape gives them back");
}

#[test]
fn commands_are_chosen_from_the_list() {
    let mut handler = Panel::default();
    let mut session = opened(&mut handler);
    session.stage.cheat_sheet = Visibility::Shown;
    session.stage.command_search = "orthographic".into();
    session.interface_requested_redraw(ms(1000));
    run(&mut session, ms(1000));
    let before = session.stage.orbit;
    // The only row of the window in the middle: its button is found by trying.
    let points = (60..140).step_by(6).map(|y| (200.0, f64::from(y)));
    points.for_each(|at| {
        if session.stage.orbit == before {
            click(&mut session, at, ms(2000));
        }
    });
    let mut expected = before;
    expected.toggle_orthographic();
    assert_eq!(session.stage.orbit, expected, "a click is as good as the key");
}

#[test]
fn screen_readers_learn_names_and_press_buttons() {
    use egui::accesskit::{Action, ActionRequest, TreeId, TreeUpdate};
    let mut handler = Panel::default();
    let mut session = opened(&mut handler);
    let names = |update: &TreeUpdate| -> Vec<_> {
        update.nodes.iter().filter_map(|(id, node)| Some((node.label()?.to_owned(), *id))).collect()
    };
    assert!(session.interface().take_output().accesskit_update.is_none(), "nobody has asked");
    session.interface().context().enable_accesskit();
    session.event(key_down(9, Key::Tab), ms(1000));
    run(&mut session, ms(1000));
    let told = session.interface().take_output().accesskit_update.expect("now somebody has");
    let names = names(&told);
    assert!(names.iter().any(|(name, _)| name == "3D view: test; selected: left"), "the image: {names:?}");
    assert!(names.iter().any(|(name, _)| name == "test"), "and the window: {names:?}");
    let (_, button) = names.iter().find(|(name, _)| name == "press").expect("the button has a name");
    let request =
        ActionRequest { action: Action::Click, target_tree: TreeId::ROOT, target_node: *button, data: None };
    session.event(InputEvent::Interface(Event::AccessKitActionRequest(request)), ms(2000));
    run(&mut session, ms(2000));
    drop(session);
    assert_eq!(handler.clicks, 1, "as if it had been clicked");
}

/// A loader's progress, for example: nothing happens in the window itself.
#[test]
fn what_another_thread_has_changed_in_the_interface_is_shown_when_it_asks_for_that() {
    let text = std::cell::Cell::new("10 %");
    let interface = |_: &mut Stage, ui: &mut egui::Ui| {
        egui::Panel::top("progress").show(ui, |ui| ui.label(text.get()));
    };
    let mut handler = crate::handler::Closures { interface: Some(Box::new(interface)), ..Default::default() };
    let mut session = Session::new(stage(), &mut handler, Worker::of_caller());
    session.event(InputEvent::Resized { width: SIZE.width, height: SIZE.height }, ms(0));
    session.start(ms(0));
    run(&mut session, ms(0));
    let (before, image) = (session.canvas().pixels().to_vec(), session.shown.clone());
    text.set("90 %");
    assert_eq!(session.next(ms(1000)), Wake::Never, "nobody knows");
    session.interface_requested_redraw(ms(1000));
    assert_eq!(run(&mut session, ms(1000)), [ms(1000)], "one frame");
    assert!(session.canvas().pixels() != before, "the other text is there");
    assert!(session.shown == image, "over the same image");
}

/// Letters came before the list was drawn, and were keys.
#[test]
fn letters_typed_before_the_list_of_keys_is_drawn_are_searched_for() {
    let mut handler = Panel::default();
    let mut session = opened(&mut handler);
    let settings = session.stage.settings.clone();
    session.event(key_down(1, Key::Character('h')), ms(1000));
    for letter in "save".chars() {
        session.event(InputEvent::Interface(Event::Text(letter.into())), ms(1000));
        session.event(key_down(u64::from(letter), Key::Character(letter)), ms(1000));
    }
    run(&mut session, ms(1000));
    assert_eq!(session.stage.command_search, "save", "all of them");
    assert!(session.stage.settings == settings, "no letter was a key");
}
