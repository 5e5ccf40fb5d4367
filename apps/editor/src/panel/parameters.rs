//! Widgets for the parameters of any command, by their forms.

use serde_json::Value;
use trigon_document::ElementKind;
use trigon_window::egui::{self, Response, Ui};

use super::ShownDocument;
use super::form::KeyOrder;
use super::form::{self, Form, NumberForm, Variant};
use super::row::{AXES, CHANNELS, hovered, number, row, text, vector};
use super::spatial::Spatial;
use super::unit::Unit;
use crate::up::Up;

/// Shows the parameters of a group in their order. Tells whether one was changed.
pub(super) fn group(
    ui: &mut Ui,
    shown: ShownDocument<'_>,
    schema: &'static Value,
    value: &mut Value,
    order: &KeyOrder,
) -> bool {
    group_in(ui, shown, schema, value, order, Unit::None)
}

/// Shows the parameters of the variant that a value is, which stays that variant. Tells whether one was changed.
pub(super) fn of_variant(
    ui: &mut Ui,
    shown: ShownDocument<'_>,
    property: &'static Value,
    value: &mut Value,
    order: &KeyOrder,
) -> bool {
    let Form::Variants(tag, variants) = form::form(property, Unit::None) else { return false };
    let Some(variant) = variants.iter().find(|variant| value[tag] == variant.name) else { return false };
    group_in(ui, shown, variant.schema, value, order, Unit::of_comment(variant.description))
}

fn group_in(
    ui: &mut Ui,
    shown: ShownDocument<'_>,
    schema: &'static Value,
    value: &mut Value,
    order: &KeyOrder,
    unit: Unit,
) -> bool {
    let properties = schema["properties"].as_object().into_iter().flatten();
    // Nobody reads bytes as text.
    let is_shown = |property: &Value| property["const"].is_null() && property["contentEncoding"].is_null();
    let mut properties: Vec<_> = properties.filter(|(_, property)| is_shown(property)).collect();
    properties.sort_by_key(|(name, _)| order.index_of(name));
    let mut is_changed = false;
    for (name, property) in properties {
        let form = form::form(property, unit);
        let spatial = Spatial::of(name, form.count(), value);
        let parameter = Parameter { name, property, shown, spatial, order: order.within(name) };
        ui.push_id(name, |ui| is_changed |= parameter.show(ui, &form, &mut value[name]));
    }
    is_changed
}

/// One of them.
struct Parameter<'p> {
    name: &'p str,
    property: &'static Value,
    shown: ShownDocument<'p>,
    /// What the numbers of a vector mean.
    spatial: Spatial,
    order: &'p KeyOrder,
}

impl Parameter<'_> {
    fn show(&self, ui: &mut Ui, form: &Form<'static>, value: &mut Value) -> bool {
        let (label, hover) = (form::label(self.name), form::description(self.property));
        match form {
            Form::Number(number) => show_number(ui, &label, hover, value, number),
            Form::Switch => show_switch(ui, &label, hover, value),
            Form::Axes => show_axes(ui, &label, hover, value, self.shown.up),
            Form::Text if self.name == "object" => self.show_object(ui, &label, hover, value),
            Form::Text => show_text(ui, &label, hover, value),
            Form::Choice(names) => show_choice(ui, &label, hover, value, names),
            Form::Vector(_, number) => self.show_vector(ui, &label, value, number),
            Form::Variants(tag, variants) => self.show_variants(ui, &label, value, tag, variants),
            Form::Group(schema) => {
                hovered(ui.strong(&label), hover);
                ui.indent(self.name, |ui| group(ui, self.shown, schema, value, self.order)).inner
            }
            Form::Optional(inner) => self.show_optional(ui, &label, inner, value),
            Form::ReadOnly => {
                let text = self.read_only(value);
                row(ui, &label, hover, |ui, _| ui.add(egui::Label::new(text).wrap()));
                false
            }
        }
    }

    /// A list of the objects with meshes, by their names.
    fn show_object(&self, ui: &mut Ui, label: &str, hover: &str, value: &mut Value) -> bool {
        let nodes = self.shown.document.nodes().nodes();
        let names = nodes.iter().filter(|(_, node)| node.mesh.is_some()).map(|(_, node)| &*node.name);
        let names: Vec<(&str, &str)> = names.map(|name| (name, "")).collect();
        show_choice_of(ui, label, hover, value, &names, str::to_owned)
    }

    /// A check box for whether there is a value, and the value.
    fn show_optional(&self, ui: &mut Ui, label: &str, inner: &Form<'static>, value: &mut Value) -> bool {
        // Names and lists that were not given cannot be given here.
        if *inner == Form::ReadOnly {
            return self.show(ui, inner, value);
        }
        let mut is_given = !value.is_null();
        let hover = form::description(self.property);
        let mut is_changed = false;
        if hovered(check_box(ui, &mut is_given, label), hover).changed() {
            *value = if is_given { form::initial(inner) } else { Value::Null };
            is_changed = true;
        }
        if is_given {
            let inner = |ui: &mut Ui| match inner {
                // The check box is its title.
                Form::Group(schema) => group(ui, self.shown, schema, value, self.order),
                inner => self.show(ui, inner, value),
            };
            is_changed |= ui.indent(self.name, inner).inner;
        }
        is_changed
    }

    /// A list of groups, and the parameters of the chosen one.
    fn show_variants(
        &self,
        ui: &mut Ui,
        label: &str,
        value: &mut Value,
        tag: &'static str,
        variants: &[Variant<'static>],
    ) -> bool {
        let names: Vec<_> = variants.iter().map(|variant| (variant.name, variant.description)).collect();
        let mut chosen = value[tag].clone();
        let hover = form::description(self.property);
        let mut is_changed = false;
        if show_choice(ui, label, hover, &mut chosen, &names)
            && let Some(variant) = variants.iter().find(|variant| chosen == variant.name)
        {
            *value = form::initial_variant(tag, variant);
            is_changed = true;
        }
        if let Some(variant) = variants.iter().find(|variant| value[tag] == variant.name) {
            let unit = form::unit(self.property);
            let unit = if unit == Unit::None { Unit::of_comment(variant.description) } else { unit };
            let inner = |ui: &mut Ui| group_in(ui, self.shown, variant.schema, value, self.order, unit);
            is_changed |= ui.indent(self.name, inner).inner;
        }
        is_changed
    }

    fn show_vector(&self, ui: &mut Ui, label: &str, value: &mut Value, form: &NumberForm) -> bool {
        let stored: Vec<f64> = value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
        let mut numbers = stored.clone();
        self.spatial.shown(self.shown.up, &mut numbers);
        let is_color = ["base_color", "color", "emissive", "specular"].contains(&self.name);
        let names = if is_color { CHANNELS } else { AXES };
        if vector(ui, label, form::description(self.property), &mut numbers, form, names).is_none() {
            return false;
        }
        self.spatial.stored(self.shown.up, &mut numbers);
        for (index, (now, before)) in numbers.into_iter().zip(stored).enumerate() {
            // The others keep their digits.
            if now != before {
                value[index] = form::number_value(now, form);
            }
        }
        true
    }

    /// "12 faces", "Cube", "the selected".
    fn read_only(&self, value: &Value) -> String {
        match value {
            Value::Array(list) if list.is_empty() => "none named".to_owned(),
            Value::Array(list) => {
                let noun = match (self.name, self.shown.document.selection().kind()) {
                    ("elements", ElementKind::Vertex) => "vertices",
                    ("elements", ElementKind::Edge) => "edges",
                    ("elements", ElementKind::Face) => "faces",
                    (name, _) => name,
                };
                match &list[..] {
                    [one] if noun == "objects" => self.named(one),
                    list => format!("{} {noun}", list.len()),
                }
            }
            Value::Null => "not given".to_owned(),
            value => self.named(value),
        }
    }

    /// The name of an object that is given by its number.
    fn named(&self, value: &Value) -> String {
        let nodes = self.shown.document.nodes().nodes();
        let id = value.as_u64().filter(|_| self.name.starts_with("object") || self.name == "parent");
        let node = id.and_then(|index| nodes.get(nodes.id_at(index as usize)?));
        match (node, value.as_str()) {
            (Some(node), _) if !node.name.is_empty() => node.name.clone(),
            (_, Some(name)) => name.to_owned(),
            _ => value.to_string(),
        }
    }
}

/// A check box whose label is wrapped in a narrow panel.
pub(super) fn check_box(ui: &mut Ui, value: &mut bool, label: &str) -> Response {
    ui.scope(|ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Wrap);
        ui.checkbox(value, label)
    })
    .inner
}

fn show_number(ui: &mut Ui, label: &str, hover: &str, value: &mut Value, form: &NumberForm) -> bool {
    let mut shown = value.as_f64().unwrap_or(0.0);
    let response = row(ui, label, hover, |ui, width| number(ui, width, &mut shown, form, ""));
    if response.changed() {
        *value = form::number_value(shown, form);
    }
    response.changed()
}

fn show_switch(ui: &mut Ui, label: &str, hover: &str, value: &mut Value) -> bool {
    let mut is_on = value.as_bool().unwrap_or_default();
    let is_changed = hovered(check_box(ui, &mut is_on, label), hover).changed();
    if is_changed {
        *value = is_on.into();
    }
    is_changed
}

/// A switch for each axis, in the order in which they are shown.
fn show_axes(ui: &mut Ui, label: &str, hover: &str, value: &mut Value, up: Up) -> bool {
    let mut is_changed = false;
    row(ui, label, hover, |ui, _| {
        let shown = ui.horizontal(|ui| {
            for axis in [0, 1, 2].map(|axis| up.shown_axis(axis)) {
                let is_on = value[axis].as_bool().unwrap_or_default();
                let name = AXES[up.shown_axis(axis)];
                let switch = ui.selectable_label(is_on, name).accessible_name(format!("{label} {name}"));
                if switch.clicked() {
                    value[axis] = (!is_on).into();
                    is_changed = true;
                }
            }
        });
        shown.response
    });
    is_changed
}

fn show_text(ui: &mut Ui, label: &str, hover: &str, value: &mut Value) -> bool {
    let mut shown = value.as_str().unwrap_or_default().to_owned();
    let response = row(ui, label, hover, |ui, width| text(ui, width, &mut shown));
    if response.changed() {
        *value = shown.into();
    }
    response.changed()
}

fn show_choice(ui: &mut Ui, label: &str, hover: &str, value: &mut Value, names: &[(&str, &str)]) -> bool {
    show_choice_of(ui, label, hover, value, names, form::label)
}

/// A list whose entries are shown as `shown` says.
fn show_choice_of(
    ui: &mut Ui,
    label: &str,
    hover: &str,
    value: &mut Value,
    names: &[(&str, &str)],
    as_text: fn(&str) -> String,
) -> bool {
    let current = value.as_str().map(as_text).unwrap_or_default();
    let mut chosen = None;
    row(ui, label, hover, |ui, width| {
        let list = egui::ComboBox::from_id_salt("choice").width(width).truncate().selected_text(current);
        let shown = list.show_ui(ui, |ui| {
            for (name, hover) in names {
                let is_chosen = *value == *name;
                if hovered(ui.selectable_label(is_chosen, as_text(name)), hover).clicked() && !is_chosen {
                    chosen = Some(*name);
                }
            }
        });
        shown.response
    });
    if let Some(name) = chosen {
        *value = name.into();
    }
    chosen.is_some()
}
