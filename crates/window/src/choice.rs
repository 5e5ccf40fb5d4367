//! Lists from which one entry is chosen, with the mouse or the arrow keys.

use egui::{ComboBox, Context, EventFilter, FocusDirection, Id, Key, Modifiers, Response, Ui};

/// Shows a list of named options, of which one is current. While it is closed and has the keyboard, Up and Down choose
/// the neighbour. In the open list they only lead from entry to entry, beginning with the current one; Enter and the
/// space bar choose, and Escape closes it. Returns the option that was chosen, if another one was.
pub fn choose<T: Clone + PartialEq>(
    ui: &mut Ui,
    list: ComboBox<'_>,
    options: &[(String, T)],
    current: &T,
) -> (Response, Option<T>) {
    let index = options.iter().position(|(_, option)| option == current);
    let mut walk = Walk::resume(ui, index);
    let shown = list.show_ui(ui, |ui| walk.show_entries(ui, options));
    let response = shown.response;
    let is_open = shown.inner.is_some();
    walk.pause(ui.ctx(), is_open);
    let index = match shown.inner {
        Some(chosen) => {
            hold_keyboard(ui.ctx(), &response);
            chosen
        }
        None if response.has_focus() => {
            // Otherwise arrows would go to the widgets above and below.
            keep_keys(ui.ctx(), &response, EventFilter { vertical_arrows: true, ..EventFilter::default() });
            let step = arrows(ui);
            (step != 0).then(|| stepped(index, step, options.len()))
        }
        None => None,
    };
    let chosen = index.and_then(|index| options.get(index)).map(|(_, option)| option.clone());
    (response, chosen.filter(|chosen| chosen != current))
}

/// The way that arrows take through an open list. The keyboard stays with the list itself: where each entry had it in
/// turn, arrows that came before the first entry had it were lost.
struct Walk {
    /// Where it is kept from pass to pass.
    id: Id,
    /// The entry that arrows have led to.
    at: Option<usize>,
    /// Whether that one is chosen.
    is_confirmed: bool,
}

impl Walk {
    /// That of the list that is shown next, if it was open in the last pass; else one that begins with the current entry.
    fn resume(ui: &mut Ui, current: Option<usize>) -> Self {
        let id = ui.next_auto_id().with("the entry that arrows have led to");
        let known: Option<Option<usize>> = ui.data(|data| data.get_temp(id));
        // Taken before the list is shown, which Enter would close.
        let confirms = known.is_some() && (pressed(ui, Key::Enter) + pressed(ui, Key::Space) > 0);
        Self { id, at: known.unwrap_or(current), is_confirmed: confirms }
    }

    /// Returns the entry that was chosen.
    fn show_entries<T>(&mut self, ui: &mut Ui, options: &[(String, T)]) -> Option<usize> {
        let step = arrows(ui);
        if step != 0 {
            self.at = Some(stepped(self.at, step, options.len()));
        }
        let mut chosen = self.at.filter(|_| self.is_confirmed);
        for (index, (name, _)) in options.iter().enumerate() {
            let is_here = self.at == Some(index);
            let entry = ui.selectable_label(is_here, name);
            if is_here && step != 0 {
                entry.scroll_to_me(None);
            }
            if entry.clicked() {
                chosen = Some(index);
            }
        }
        if chosen.is_some() {
            ui.close();
        }
        chosen
    }

    fn pause(self, context: &Context, is_open: bool) {
        context.data_mut(|data| {
            if is_open {
                data.insert_temp(self.id, self.at);
            } else {
                data.remove::<Option<usize>>(self.id);
            }
        });
    }
}

/// Keeps all keys that would lead elsewhere with an open list, also one that the mouse has opened.
fn hold_keyboard(context: &Context, list: &Response) {
    if !list.has_focus() {
        list.request_focus();
    }
    // In the first pass that the list has the keyboard, egui has taken arrows for itself.
    context.memory_mut(|memory| memory.move_focus(FocusDirection::None));
    keep_keys(
        context,
        list,
        EventFilter { tab: true, horizontal_arrows: true, vertical_arrows: true, escape: true },
    );
}

fn keep_keys(context: &Context, list: &Response, keys: EventFilter) {
    context.memory_mut(|memory| memory.set_focus_lock_filter(list.id, keys));
}

/// How many entries down the arrows lead that were pressed.
fn arrows(ui: &mut Ui) -> isize {
    pressed(ui, Key::ArrowDown) - pressed(ui, Key::ArrowUp)
}

/// How often a key was pressed.
fn pressed(ui: &mut Ui, key: Key) -> isize {
    ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)) as isize
}

/// The entry that arrows lead to; from none to the first or the last.
fn stepped(from: Option<usize>, step: isize, count: usize) -> usize {
    let last = count.saturating_sub(1);
    match from {
        Some(from) => from.saturating_add_signed(step).min(last),
        None if step > 0 => 0,
        None => last,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Event, Popup, Pos2, RawInput, Rect, vec2};

    /// A pass in which keys are pressed; returns the list and what was chosen. Below the list is a slider, which arrows
    /// would move.
    fn pass(context: &Context, keys: &[Key], current: char) -> (Response, Option<char>) {
        let press = |&key| {
            let modifiers = Modifiers::NONE;
            Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
        };
        pass_of(context, keys.iter().map(press).collect(), current)
    }

    fn pass_of(context: &Context, events: Vec<Event>, current: char) -> (Response, Option<char>) {
        let options = ['a', 'b', 'c'].map(|option| (format!("option {option}"), option));
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(300.0, 200.0))),
            events,
            ..RawInput::default()
        };
        let (mut shown, mut value) = (None, 3);
        let mut output = context.run_ui(input, |ui| {
            let list = ComboBox::from_id_salt("list").selected_text("current");
            let (list, chosen) = choose(ui, list, &options, &current);
            // The first of the passes of a frame has its events.
            let before = shown.take().and_then(|(_, chosen)| chosen);
            shown = Some((list, before.or(chosen)));
            ui.add(egui::Slider::new(&mut value, 0..=9).vertical());
        });
        output.textures_delta.clear();
        assert_eq!(value, 3, "the slider");
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
        pass(&context, &[], 'a').0.request_focus();
        pass(&context, &[], 'a');
        let chosen = |keys: &[Key]| pass(&context, keys, 'a').1;
        assert_eq!(chosen(&[Key::Enter]), None, "it opens");
        assert!(Popup::is_any_open(&context), "it is open");
        for keys in [&[Key::ArrowDown][..], &[Key::ArrowDown, Key::ArrowDown], &[Key::ArrowUp]] {
            assert_eq!(chosen(keys), None, "{keys:?} only leads to another entry");
        }
        assert!(Popup::is_any_open(&context), "it is still open");
        assert_eq!(chosen(&[Key::Enter]), Some('b'), "two further at most, and back by one");
        pass(&context, &[], 'b');
        assert!(!Popup::is_any_open(&context), "it is closed");
        assert!(pass(&context, &[], 'b').0.has_focus(), "and can be opened again");
        chosen(&[Key::Space]);
        chosen(&[Key::ArrowDown]);
        assert_eq!(chosen(&[Key::Escape]), None, "Escape leaves it as it was");
        pass(&context, &[], 'a');
        assert!(!Popup::is_any_open(&context), "and closes it");
        chosen(&[Key::Enter]);
        assert_eq!(chosen(&[Key::Enter]), None, "the next time it begins with the current one again");
    }

    /// The first arrows were lost, or moved what lies below the list.
    #[test]
    fn arrows_lead_through_a_list_that_the_mouse_has_opened() {
        let context = Context::default();
        let at = pass(&context, &[], 'a').0.rect.center();
        let button = |pressed| {
            let (button, modifiers) = (egui::PointerButton::Primary, Modifiers::NONE);
            Event::PointerButton { pos: at, button, pressed, modifiers }
        };
        pass_of(&context, vec![Event::PointerMoved(at)], 'a');
        pass_of(&context, vec![button(true)], 'a');
        pass_of(&context, vec![button(false)], 'a');
        assert!(Popup::is_any_open(&context), "a click opens it");
        for key in [Key::ArrowDown, Key::ArrowLeft, Key::ArrowDown, Key::Tab] {
            assert_eq!(pass(&context, &[key], 'a').1, None, "{key:?} chooses nothing");
        }
        assert!(Popup::is_any_open(&context), "it stays open");
        assert_eq!(pass(&context, &[Key::Enter], 'a').1, Some('c'), "both arrows counted");
    }
}
