//! Rows of a panel: a label and a widget, side by side or, in a narrow panel, one above the other. A changed
//! widget becomes a request.

use std::cell::RefCell;
use std::ops::RangeInclusive;

use trigon_document::mesh::math::color::linear_to_srgb8;
use trigon_document::scene::css_color;
use trigon_document::{Command, Document};
use trigon_window::egui;
use trigon_window::egui::{Context, DragValue, Id, Response, Ui};

use super::form::NumberForm;
use super::unit::Unit;
use crate::request::Request;
use crate::tool::evaluate;

/// Below this width, in points, labels stand above their widgets.
const NARROW: f32 = 230.0;

/// The share of a wide panel that labels take.
const LABEL_SHARE: f32 = 0.42;

/// Whether labels stand above their widgets.
pub(super) fn is_narrow(ui: &Ui) -> bool {
    ui.available_width() < NARROW
}

/// A label with a widget, which is given its width. The widget gets the label as its name.
pub(super) fn row(
    ui: &mut Ui,
    label: &str,
    hover: &str,
    widget: impl FnOnce(&mut Ui, f32) -> Response,
) -> Response {
    let width = ui.available_width();
    let caption = |ui: &mut Ui| drop(hovered(ui.add(egui::Label::new(label).wrap()), hover));
    let response = if is_narrow(ui) {
        caption(ui);
        widget(ui, width)
    } else {
        let labels = egui::vec2((width * LABEL_SHARE).floor(), ui.spacing().interact_size.y);
        let row = ui.horizontal(|ui| {
            let layout = egui::Layout::left_to_right(egui::Align::Center).with_main_wrap(true);
            ui.allocate_ui_with_layout(labels, layout, |ui| {
                ui.set_min_width(labels.x);
                caption(ui);
            });
            let rest = ui.available_width();
            widget(ui, rest)
        });
        row.inner
    };
    hovered(response.accessible_name(label), hover)
}

/// With a text that explains it, if there is one.
pub(super) fn hovered(response: Response, text: &str) -> Response {
    if text.is_empty() { response } else { response.on_hover_text(text) }
}

/// A number that is typed or dragged. Only what a user does changes it: leaving the field
/// does not round it to what is shown.
pub(super) fn number(ui: &mut Ui, width: f32, value: &mut f64, form: &NumberForm, prefix: &str) -> Response {
    let before = *value;
    let mut shown = form.unit.shown(before);
    let text_of = |number| rounded(number, form.unit.digits());
    let bounds = form.unit.shown(form.least)..=form.unit.shown(form.most);
    let rejected = RefCell::new(None);
    let parse = |text: &str| {
        let value = evaluate(text, form.unit.quantity());
        let limit = value.as_ref().ok().and_then(|&value| beyond(value, &bounds)).map(&text_of);
        *rejected.borrow_mut() = match &value {
            Err(error) => Some(format!("{text:?}: {error}")),
            Ok(_) => limit.map(|limit| format!("{text:?} is out of range: {limit} is the limit")),
        };
        value.ok()
    };
    let drag = DragValue::new(&mut shown)
        .custom_parser(parse)
        .range(bounds.clone())
        .clamp_existing_to_range(false)
        .speed(speed(before, form))
        .update_while_editing(false)
        .custom_formatter(|number, _| text_of(number))
        .suffix(form.unit.suffix())
        .prefix(prefix);
    let mut response = ui.add_sized([width, ui.spacing().interact_size.y], drag);
    if let Some(text) = rejected.into_inner() {
        ui.data_mut(|data| data.insert_temp(rejected_id(), text));
    }
    if response.changed() && text_of(shown) == text_of(form.unit.shown(before)) {
        response.flags.remove(egui::response::Flags::CHANGED);
    } else if response.changed() {
        *value = form.unit.value(shown);
    }
    response
}

/// The end of a range beyond which a number lies.
fn beyond(number: f64, range: &RangeInclusive<f64>) -> Option<f64> {
    let limit = number.clamp(*range.start(), *range.end());
    (limit != number).then_some(limit)
}

fn rejected_id() -> Id {
    Id::unique("the text that was no number")
}

/// Why what was typed last into a field for numbers counts for nothing, once.
pub(crate) fn rejected_number(context: &Context) -> Option<String> {
    context.data_mut(|data| data.remove_temp(rejected_id()))
}

/// Values that span a bounded range move through it in some hundred points.
fn speed(value: f64, form: &NumberForm) -> f64 {
    let span = form.most - form.least;
    match form.unit {
        _ if form.is_integer => 0.1,
        Unit::None if span <= 10.0 => span / 200.0,
        unit => unit.speed() * value.abs().max(1.0),
    }
}

/// How many digits of a number are shown: a panel is as wide as its user made it.
const SIGNIFICANT: usize = 6;

/// A number for people: six significant digits, no more than six after the point, and no zeros at the end.
pub(crate) fn written(number: f64) -> String {
    rounded(number, Unit::None.digits())
}

/// The same with another most of digits after the point.
fn rounded(number: f64, digits: usize) -> String {
    let exact = format!("{number:.*e}", SIGNIFICANT - 1);
    let Some((shown, exponent)) = exact.split_once('e') else { return exact };
    let size: i32 = exponent.parse().unwrap_or(0);
    // Beyond these, zeros would fill the panel.
    if !(-5..9).contains(&size) {
        return format!("{}e{exponent}", without_zeros(shown));
    }
    let Ok(after_point) = usize::try_from(SIGNIFICANT as i32 - 1 - size) else {
        // Digits before the point that are not significant are zeros.
        return format!("{:.0}", exact.parse().unwrap_or(number));
    };
    let text = format!("{number:.*}", digits.min(after_point));
    let text = without_zeros(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn without_zeros(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

/// Plain numbers without bounds.
pub(super) fn plain(unit: Unit) -> NumberForm {
    NumberForm { least: f64::NEG_INFINITY, most: f64::INFINITY, is_integer: false, unit }
}

/// A number from 0 to a bound.
pub(super) fn positive(most: f64, unit: Unit) -> NumberForm {
    NumberForm { least: 0.0, most, is_integer: false, unit }
}

/// What numbers of a position, a direction or a rotation are called.
pub(super) const AXES: [&str; 4] = ["X", "Y", "Z", "W"];

/// What those of a colour are called.
pub(super) const CHANNELS: [&str; 4] = ["R", "G", "B", "A"];

/// Three or more numbers under one label, each on its own line. Returns which one was changed, and its
/// response.
pub(super) fn vector(
    ui: &mut Ui,
    label: &str,
    hover: &str,
    values: &mut [f64],
    form: &NumberForm,
    names: [&str; 4],
) -> Option<(usize, Response)> {
    let mut changed = None;
    row(ui, label, hover, |ui, width| {
        let fields = ui.vertical(|ui| {
            for (index, value) in values.iter_mut().enumerate() {
                let axis = names.get(index).copied().unwrap_or_default();
                let response = number(ui, width, value, form, &format!("{axis} "));
                let response = response.accessible_name(format!("{label} {axis}"));
                if response.changed() {
                    changed = Some((index, response));
                }
            }
        });
        fields.response
    });
    changed
}

/// A text in one line, which counts when its field is left, and not after Escape.
pub(super) fn text(ui: &mut Ui, width: f32, text: &mut String) -> Response {
    let id = ui.next_auto_id();
    let before = text.clone();
    let mut shown: String = ui.data(|data| data.get_temp(id)).unwrap_or_else(|| before.clone());
    let field = egui::TextEdit::singleline(&mut shown).id(id).desired_width(width);
    let mut response = ui.add(field);
    response.flags.remove(egui::response::Flags::CHANGED);
    if response.lost_focus() {
        ui.data_mut(|data| data.remove_temp::<String>(id));
        if shown != before && !ui.input(|input| input.key_pressed(egui::Key::Escape)) {
            *text = shown;
            response.mark_changed();
        }
    } else if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, shown));
    }
    response
}

/// Selects all of a field that has just got the keyboard: what is typed replaces it.
pub(crate) fn select_all_at_first(field: &mut egui::text_edit::TextEditOutput) {
    if field.response.gained_focus() {
        let all = egui::text::CCursorRange::select_all(&field.galley);
        field.state.cursor.set_char_range(Some(all));
        field.state.clone().store(&field.response.ctx, field.response.id);
    }
}

/// A list of names to choose from.
pub(super) fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    label: &str,
    hover: &str,
    chosen: &mut T,
    names: &[(T, &str, &str)],
) -> Response {
    let text = names.iter().find(|(value, ..)| value == chosen).map_or("", |(_, name, _)| name);
    row(ui, label, hover, |ui, width| {
        let mut is_changed = false;
        let list = egui::ComboBox::from_id_salt(label).width(width).truncate().selected_text(text);
        let mut response = list
            .show_ui(ui, |ui| {
                for (value, name, hover) in names {
                    is_changed |= hovered(ui.selectable_value(chosen, *value, *name), hover).changed();
                }
            })
            .response;
        if is_changed {
            response.mark_changed();
        }
        response
    })
}

/// Linear red, green and blue as a colour that can be chosen, and as the hexadecimal digits of its sRGB bytes.
pub(super) fn color(ui: &mut Ui, label: &str, hover: &str, value: &mut [f32; 3]) -> Option<Response> {
    /// Of the digits, in points.
    const DIGITS: f32 = 72.0;
    let response = row(ui, label, hover, |ui, width| {
        ui.horizontal(|ui| {
            ui.spacing_mut().interact_size.x = (width - DIGITS - ui.spacing().item_spacing.x).max(24.0);
            let chosen = egui::color_picker::color_edit_button_rgb(ui, value);
            let mut digits = hex(*value);
            let typed = text(ui, DIGITS, &mut digits).accessible_name(format!("{label} hex"));
            match css_color(digits.trim()) {
                Ok(color) if typed.changed() => {
                    *value = color.truncate().to_array();
                    typed
                }
                _ => chosen,
            }
        })
        .inner
    });
    response.changed().then_some(response)
}

/// The sRGB bytes of a linear colour; what is brighter than white counts as white.
pub(super) fn srgb(linear: [f32; 3]) -> [u8; 3] {
    linear.map(linear_to_srgb8)
}

fn hex(linear: [f32; 3]) -> String {
    let [red, green, blue] = srgb(linear);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Requests a command. While a value is dragged, each command replaces the one before, so that the whole drag
/// is undone as one.
pub(super) fn submit(
    ui: &Ui,
    document: &Document,
    response: &Response,
    command: Command,
    requests: &mut Vec<Request>,
) {
    let last = document.history().done().last();
    // A command that was refused has left no entry that could be replaced.
    let is_last = last.is_some_and(|entry| entry.command().name() == command.name());
    let replaces = is_last && is_same_drag(ui, response);
    let pressed = press(ui);
    ui.data_mut(|data| data.insert_temp(response.id, pressed));
    requests.push(if replaces { Request::Adjust(command) } else { Request::Run(command) });
}

/// Whether the button of the pointer has been down since the last change of this widget.
pub(super) fn is_same_drag(ui: &Ui, response: &Response) -> bool {
    let pressed = press(ui);
    pressed.is_some() && ui.data(|data| data.get_temp::<Option<f64>>(response.id)) == Some(pressed)
}

/// When the button that is down was pressed. The widget of a colour opens others, so that it
/// is not dragged itself.
fn press(ui: &Ui) -> Option<f64> {
    ui.input(|input| input.pointer.press_start_time().filter(|_| input.pointer.any_down()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_short() {
        for (number, text) in [
            (1.0, "1"),
            (0.1, "0.1"),
            (f64::from(0.1f32), "0.1"),
            (-0.0, "0"),
            (1e30, "1e30"),
            (1e-7, "1e-7"),
            (1.0 / 3.0, "0.333333"),
            (-12.345_678_9, "-12.3457"),
            (100.0, "100"),
            (999_999.5, "1000000"),
            (12_345_678.0, "12345700"),
            (1.234_567_8e12, "1.23457e12"),
            (-9.87e-9, "-9.87e-9"),
        ] {
            assert_eq!(written(number), text, "{number}");
        }
    }
}
