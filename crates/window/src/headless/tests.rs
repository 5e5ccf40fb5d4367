//! A window without a display is worked as one with a display is.

use super::*;
use crate::handler::Closures;
use crate::input::{Chord, Key, PointerButton};
use trigon_mesh::primitives;
use trigon_scene::Material;

const SIZE: Viewport = Viewport { width: 320, height: 240 };

fn stage() -> Stage {
    let mut stage = Stage::new("test");
    stage.scene.add_object("cube", primitives::cube(1.0), Material::default());
    stage
}

/// A panel with a button that renames the window, and a text field.
fn application(text: &mut String) -> Closures<'_> {
    let interface = |stage: &mut Stage, ui: &mut egui::Ui| {
        egui::Panel::top("bar").show(ui, |ui| {
            if ui.button("Press").clicked() {
                stage.set_title("pressed");
            }
            ui.add_enabled(false, egui::Button::new("Grey"));
            ui.text_edit_singleline(text);
        });
    };
    Closures { interface: Some(Box::new(interface)), ..Closures::default() }
}

fn click(window: &mut HeadlessWindow<'_>, at: DVec2) {
    window.move_to(at);
    window.press(PointerButton::Left);
    window.release(PointerButton::Left);
}

#[test]
fn widgets_are_found_by_label_and_pressed_by_the_mouse() {
    let mut text = String::new();
    let mut application = application(&mut text);
    let mut window = HeadlessWindow::open(stage(), &mut application, SIZE);
    let [button] = &window.widgets("Press")[..] else { panic!("one button") };
    let at = button.center;
    assert!(window.widgets("Grey")[0].is_disabled, "and one that cannot be pressed");
    click(&mut window, at);
    assert_eq!(window.stage().title(), "pressed", "the button was");
    let field = window.all_widgets();
    assert!(field.iter().any(|widget| widget.label == "Press"), "widgets: {field:?}");
}

#[test]
fn a_drag_turns_the_camera_and_what_is_done_is_recorded() {
    let mut text = String::new();
    let mut application = application(&mut text);
    let mut window = HeadlessWindow::open(stage(), &mut application, SIZE);
    let before = (window.stage().orbit, window.pixels());
    window.move_to(DVec2::new(160.0, 160.0));
    assert!(!window.is_on_interface(), "the image is there");
    window.press(PointerButton::Left);
    window.move_to(DVec2::new(220.0, 150.0));
    window.release(PointerButton::Left);
    assert_ne!(window.stage().orbit, before.0, "it turned");
    assert!(window.pixels() != before.1, "which is to be seen");
    assert!(!window.take_recorded().is_empty(), "and can be played again");
}

#[test]
fn keys_type_what_they_stand_for_into_the_field_that_has_the_keyboard() {
    let mut text = String::new();
    {
        let mut application = application(&mut text);
        let mut window = HeadlessWindow::open(stage(), &mut application, SIZE);
        // Into the interface, and from the button to the field.
        let ways = [Key::Function(6), Key::Tab];
        let typed = [Key::Character('a'), Key::Space, Key::Numpad('7'), Key::Left, Key::Space];
        ways.into_iter().chain(typed).for_each(|key| window.key(key.into()));
        window.key(Chord::new(Modifiers::CTRL, Key::Character('j')));
    }
    assert_eq!(text, "a  7", "what is held with Ctrl is no text, and arrows are none");
}
