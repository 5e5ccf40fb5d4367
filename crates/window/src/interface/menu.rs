//! The menu at the pointer, which lists the bindings that the keymap marks for it.

use egui::{Context, Ui, pos2};

use crate::keymap::{Binding, Keymap, MenuEntry};
use crate::popup::{PopupEnd, popup_entry, popup_menu};
use crate::stage::Stage;

/// Shows it if it is open. Returns what was chosen.
pub(super) fn show(context: &Context, stage: &mut Stage) -> Option<Binding> {
    let menu = stage.menu.as_mut()?;
    let points = context.pixels_per_point();
    let requested = menu.requested_at.map(|at| pos2(at.x as f32 / points, at.y as f32 / points));
    let mut at = menu.at.or(requested);
    // At its own place it is as new as at the pointer, to the click that opened it.
    let is_new = menu.at.is_none();
    let end = popup_menu(context, "menu", &mut at, |ui| entries(ui, &stage.keymap));
    menu.at = at;
    match end {
        PopupEnd::Closed if !is_new => {
            stage.menu = None;
            // It is gone from the next frame on.
            context.request_repaint();
        }
        PopupEnd::Open | PopupEnd::Closed => {}
        PopupEnd::Chosen(binding) => {
            stage.menu = None;
            context.request_repaint();
            return Some(binding);
        }
    }
    None
}

fn entries(ui: &mut Ui, keymap: &Keymap) -> Option<Binding> {
    let mut chosen = None;
    for entry in keymap.menu() {
        let (MenuEntry::Command { label, .. }, Some(binding)) = entry else {
            ui.separator();
            continue;
        };
        if popup_entry(ui, label, &binding.chord.to_string(), true).clicked() {
            chosen = Some(binding.clone());
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::Menu;
    use egui::{Rect, Vec2};
    use trigon_math::DVec2;

    #[test]
    fn a_menu_opens_where_it_was_asked_for_on_any_screen() {
        for points in [1.0, 2.0] {
            let (context, mut stage) = (Context::default(), Stage::new("test"));
            stage.menu = Some(Menu { requested_at: Some(DVec2::new(101.0, 60.0)), at: None });
            context.set_pixels_per_point(points);
            let screen_rect = Some(Rect::from_min_size(egui::Pos2::ZERO, Vec2::splat(4000.0)));
            for _ in 0..2 {
                let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
                let mut output = context.run_ui(input, |ui| {
                    assert!(show(ui.ctx(), &mut stage).is_none(), "nothing is chosen");
                });
                output.textures_delta.clear();
            }
            let at = stage.menu.expect("it stays open").at;
            assert_eq!(at, Some(pos2(101.0 / points, 60.0 / points)), "{points} pixels to a point");
        }
    }
}
