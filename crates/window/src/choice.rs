//! Lists from which one entry is chosen, with the mouse or the arrow keys.

use egui::{ComboBox, EventFilter, Key, Modifiers, Response, Ui};

/// Shows a list of named options, of which one is current. While it is closed and has the keyboard, Up and Down choose
/// the neighbour. In the open list they only lead from entry to entry, beginning with the current one; Enter chooses, and
/// Escape closes it. Returns the option that was chosen, if another one was.
pub fn choose<T: Clone + PartialEq>(
    ui: &mut Ui,
    list: ComboBox,
    options: &[(String, T)],
    current: &T,
) -> (Response, Option<T>) {
    let index = options.iter().position(|(_, option)| option == current);
    let list = list.show_ui(ui, |ui| {
        let entry =
            |(place, (name, _)): (usize, &(String, T))| ui.selectable_label(index == Some(place), name);
        let entries: Vec<Response> = options.iter().enumerate().map(entry).collect();
        walk(ui, &entries, index)
    });
    let response = list.response;
    let place = match list.inner {
        Some(picked) => picked.map(|Picked { place, by }| {
            if by == Picker::Key {
                response.request_focus();
            }
            place
        }),
        None if response.has_focus() => {
            keep_arrows(ui, &response);
            step(ui, index, options.len())
        }
        None => None,
    };
    let chosen = place.and_then(|place| options.get(place)).map(|(_, option)| option.clone());
    (response, chosen.filter(|chosen| chosen != current))
}

/// An entry of an open list that was chosen.
struct Picked {
    place: usize,
    by: Picker,
}

/// What chose it.
#[derive(PartialEq)]
enum Picker {
    Pointer,
    Key,
}

/// Leads arrows from entry to entry of an open list. Returns which one was chosen.
fn walk(ui: &mut Ui, entries: &[Response], current: Option<usize>) -> Option<Picked> {
    if let Some(place) = entries.iter().position(Response::clicked) {
        let by = if ui.input(|input| input.pointer.any_click()) { Picker::Pointer } else { Picker::Key };
        ui.close();
        return Some(Picked { place, by });
    }
    let focused = entries.iter().position(Response::has_focus);
    let next = match focused {
        Some(place) => {
            keep_arrows(ui, &entries[place]);
            step(ui, focused, entries.len())
        }
        // It was just opened.
        None => Some(current.unwrap_or(0)),
    };
    if let Some(entry) = next.and_then(|next| entries.get(next)) {
        entry.request_focus();
        entry.scroll_to_me(None);
    }
    None
}

/// Otherwise arrows would go to the widgets above and below.
fn keep_arrows(ui: &Ui, widget: &Response) {
    let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(widget.id, filter));
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

    /// They changed the model while somebody was still looking for an entry.
    #[test]
    fn arrows_in_an_open_list_choose_nothing_until_enter_is_pressed() {
        let context = Context::default();
        let (list, _) = pass(&context, &[], 'a');
        list.request_focus();
        pass(&context, &[], 'a');
        let chosen = |key: Option<Key>| pass(&context, key.as_slice(), 'a').1;
        assert_eq!(chosen(Some(Key::Enter)), None, "it opens");
        assert!(egui::Popup::is_any_open(&context), "it is open");
        assert_eq!(chosen(None), None, "the current entry gets the keyboard");
        for key in [Key::ArrowDown, Key::ArrowDown, Key::ArrowDown, Key::ArrowUp] {
            assert_eq!(chosen(Some(key)), None, "{key:?} only leads to another entry");
        }
        assert!(egui::Popup::is_any_open(&context), "it is still open");
        assert_eq!(chosen(Some(Key::Enter)), Some('b'), "two further at most, and back by one");
        pass(&context, &[], 'b');
        assert!(!egui::Popup::is_any_open(&context), "it is closed");
        assert!(pass(&context, &[], 'b').0.has_focus(), "and can be opened again");
        chosen(Some(Key::Enter));
        chosen(Some(Key::ArrowDown));
        assert_eq!(chosen(Some(Key::Escape)), None, "Escape leaves it as it was");
        chosen(None);
        assert!(!egui::Popup::is_any_open(&context), "and closes it");
    }
}
