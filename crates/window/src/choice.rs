//! Lists from which one entry is chosen, with the mouse or the arrow keys.

use egui::{ComboBox, EventFilter, Key, Modifiers, Response, Ui};

/// Shows a closed list of named options, of which one is current. Up and Down choose the neighbour while
/// it has the keyboard, open or closed. Returns the option that was chosen, if another one was.
pub fn choose<T: Clone + PartialEq>(
    ui: &mut Ui,
    list: ComboBox,
    options: &[(String, T)],
    current: &T,
) -> (Response, Option<T>) {
    let mut chosen = None;
    let list = list.show_ui(ui, |ui| {
        for (name, option) in options {
            if ui.selectable_label(option == current, name).clicked() {
                chosen = Some(option.clone());
            }
        }
    });
    let response = list.response;
    if response.has_focus() {
        // Otherwise arrows would go to the widgets above and below.
        let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let index = options.iter().position(|(_, option)| option == current);
        let next = step(ui, index, options.len());
        chosen = chosen.or_else(|| next.and_then(|next| options.get(next)).map(|(_, option)| option.clone()));
    }
    (response, chosen.filter(|chosen| chosen != current))
}

/// The option that arrows lead to, from the current one if there is one.
fn step(ui: &mut Ui, index: Option<usize>, count: usize) -> Option<usize> {
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let (down, up) = (pressed(Key::ArrowDown), pressed(Key::ArrowUp));
    match (down, up, index) {
        (true, _, Some(index)) => Some((index + 1).min(count.saturating_sub(1))),
        (_, true, Some(index)) => Some(index.saturating_sub(1)),
        (true, _, None) => Some(0),
        (_, true, None) => count.checked_sub(1),
        (false, false, _) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Context, Event, Pos2, RawInput, Rect, vec2};

    /// A pass in which keys are pressed; returns the list and what was chosen.
    fn pass(context: &Context, keys: &[Key], current: char) -> (Response, Option<char>) {
        let options = ['a', 'b', 'c'].map(|option| (format!("option {option}"), option));
        let press = |&key| {
            let modifiers = Modifiers::NONE;
            Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
        };
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(300.0, 200.0))),
            events: keys.iter().map(press).collect(),
            ..RawInput::default()
        };
        let mut shown = None;
        let mut output = context.run_ui(input, |ui| {
            shown =
                Some(choose(ui, ComboBox::from_id_salt("list").selected_text("current"), &options, &current));
        });
        output.textures_delta.clear();
        shown.expect("it was shown")
    }

    #[test]
    fn arrows_choose_the_neighbour() {
        let context = Context::default();
        let (list, chosen) = pass(&context, &[Key::ArrowDown], 'a');
        assert_eq!(chosen, None, "without the keyboard nothing is chosen");
        list.request_focus();
        pass(&context, &[], 'a');
        let chosen = |key, current| pass(&context, &[key], current).1;
        assert_eq!(chosen(Key::ArrowDown, 'a'), Some('b'), "down");
        assert_eq!(chosen(Key::ArrowUp, 'b'), Some('a'), "up");
        assert_eq!(chosen(Key::ArrowUp, 'a'), None, "the first one stays");
        assert_eq!(chosen(Key::ArrowDown, 'c'), None, "and so does the last");
        assert_eq!(chosen(Key::ArrowDown, 'x'), Some('a'), "from something else to the first");
        assert!(pass(&context, &[], 'a').0.has_focus(), "arrows went nowhere else");
    }
}
