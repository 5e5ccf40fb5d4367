//! Chooses the widget of a parameter from the commands' schema. The schema sorts parameters by name; here
//! they have the order of their declaration, the most important first.

use std::fmt;
use std::sync::OnceLock;

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::Value;
use trigon_document::{Command, command_schema};

use super::unit::Unit;

/// What a value may be.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form<'s> {
    /// A number within bounds.
    Number(NumberForm),
    /// True or false.
    Switch,
    /// A text.
    Text,
    /// One of some names, each with what it means.
    Choice(Vec<(&'s str, &'s str)>),
    /// True or false for each of the three axes.
    Axes,
    /// So many numbers.
    Vector(usize, NumberForm),
    /// One of several groups of parameters; the key decides which.
    Variants(&'s str, Vec<Variant<'s>>),
    /// Parameters of its own.
    Group(&'s Value),
    /// Nothing, or something of that form.
    Optional(Box<Form<'s>>),
    /// What is not edited here, as a list of numbers of elements.
    ReadOnly,
}

impl Form<'_> {
    /// How many numbers it has, given or not.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Vector(count, _) => *count,
            Self::Optional(inner) => inner.count(),
            _ => 0,
        }
    }
}

/// A number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NumberForm {
    pub(super) least: f64,
    pub(super) most: f64,
    pub(super) is_integer: bool,
    pub(super) unit: Unit,
}

/// One of several groups.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Variant<'s> {
    pub(super) name: &'s str,
    pub(super) description: &'s str,
    /// Its parameters, and the key that decides which they are.
    pub(super) schema: &'s Value,
    /// What it is at first.
    pub(super) example: Option<&'s Value>,
}

/// The schema of all commands.
pub(super) fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(command_schema)
}

/// The parameters of a command, by its name in JSON.
pub(super) fn of_command(name: &str) -> Option<&'static Value> {
    let variants = schema()["oneOf"].as_array()?;
    variants.iter().find(|variant| variant["properties"]["op"]["const"] == name).map(resolve)
}

/// What a `$ref` leads to.
pub(super) fn resolve(value: &'static Value) -> &'static Value {
    match value["$ref"].as_str().and_then(|path| path.rsplit('/').next()) {
        Some(name) => &schema()["$defs"][name],
        None => value,
    }
}

/// The comment on a parameter, or on its type.
pub(super) fn description(property: &'static Value) -> &'static str {
    let own = property["description"].as_str();
    own.or_else(|| resolve(property)["description"].as_str()).unwrap_or_default()
}

/// The unit stated in the comment on a parameter, or on its type.
pub(super) fn unit(property: &'static Value) -> Unit {
    let unit_of = |value: &Value| Unit::of_comment(value["description"].as_str().unwrap_or_default());
    match unit_of(property) {
        Unit::None => unit_of(resolve(property)),
        unit => unit,
    }
}

/// The form of a parameter. `outer` is the unit of its group, if it does not tell its own.
pub(super) fn form(property: &'static Value, outer: Unit) -> Form<'static> {
    let unit = if unit(property) == Unit::None { outer } else { unit(property) };
    if let Some(any) = property["anyOf"].as_array() {
        let mut forms = any.iter().filter(|one| one["type"] != "null").map(|one| form(one, unit));
        return match (forms.next(), any.len()) {
            (Some(form), 2) if any.iter().any(|one| one["type"] == "null") => Form::Optional(Box::new(form)),
            _ => Form::ReadOnly,
        };
    }
    let schema = resolve(property);
    if let Some(types) = schema["type"].as_array() {
        let is_optional = types.iter().any(|one| one == "null");
        let name = types.iter().filter_map(Value::as_str).find(|&name| name != "null").unwrap_or_default();
        let form = simple(schema, name, unit);
        return if is_optional { Form::Optional(Box::new(form)) } else { form };
    }
    if let Some(variants) = schema["oneOf"].as_array() {
        return one_of(schema, variants);
    }
    if let Some(names) = schema["enum"].as_array() {
        return Form::Choice(names.iter().filter_map(Value::as_str).map(|name| (name, "")).collect());
    }
    if schema["anyOf"].is_array() {
        return Form::ReadOnly;
    }
    simple(schema, schema["type"].as_str().unwrap_or_default(), unit)
}

fn simple(schema: &'static Value, name: &str, unit: Unit) -> Form<'static> {
    match name {
        "number" => Form::Number(number(schema, false, unit)),
        "integer" => Form::Number(number(schema, true, Unit::None)),
        "boolean" => Form::Switch,
        "string" => Form::Text,
        "object" => Form::Group(schema),
        "array" => match (schema["maxItems"].as_u64(), form(&schema["items"], unit)) {
            (Some(3), Form::Switch) => Form::Axes,
            (Some(count), Form::Number(number)) => Form::Vector(count as usize, number),
            _ => Form::ReadOnly,
        },
        _ => Form::ReadOnly,
    }
}

fn number(schema: &Value, is_integer: bool, unit: Unit) -> NumberForm {
    // Counts: more than that is no parameter that anybody drags to.
    let most = if is_integer { f64::from(u32::MAX) } else { f64::INFINITY };
    let least = schema["minimum"].as_f64().unwrap_or(if is_integer { 0.0 } else { f64::NEG_INFINITY });
    NumberForm { least, most: schema["maximum"].as_f64().unwrap_or(most), is_integer, unit }
}

/// An enumeration of names, or of groups of parameters.
fn one_of(schema: &'static Value, variants: &'static [Value]) -> Form<'static> {
    let described = |variant: &'static Value| variant["description"].as_str().unwrap_or_default();
    let named = variants.iter().filter_map(|one| Some((one["const"].as_str()?, described(one))));
    let names: Vec<_> = named.collect();
    if names.len() == variants.len() {
        return Form::Choice(names);
    }
    let mut tag = "";
    let mut groups = Vec::new();
    for variant in variants {
        let properties = variant["properties"].as_object().into_iter().flatten();
        for (key, property) in properties {
            if let Some(name) = property["const"].as_str() {
                tag = key;
                let examples = schema["examples"].as_array();
                let example = examples.and_then(|all| all.iter().find(|one| one[key] == name));
                groups.push(Variant { name, description: described(variant), schema: variant, example });
            }
        }
    }
    if groups.is_empty() { Form::ReadOnly } else { Form::Variants(tag, groups) }
}

/// "Merge distance" for `merge_distance`.
pub(super) fn label(name: &str) -> String {
    let mut label = name.replace('_', " ");
    if let Some(first) = label.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    label
}

/// What a value of a form is before anybody chose one.
pub(super) fn initial(form: &Form<'static>) -> Value {
    match form {
        Form::Number(number) => number_value(0.0, number),
        Form::Switch => false.into(),
        Form::Axes => vec![false; 3].into(),
        Form::Text => "".into(),
        Form::Choice(names) => names.first().map_or(Value::Null, |&(name, _)| name.into()),
        Form::Vector(count, number) => vec![number_value(0.0, number); *count].into(),
        Form::Variants(tag, variants) => {
            variants.first().map_or(Value::Null, |one| initial_variant(tag, one))
        }
        Form::Group(schema) => {
            let properties = schema["properties"].as_object().into_iter().flatten();
            let first = |property: &'static Value| match &property["default"] {
                Value::Null => initial(&self::form(property, Unit::None)),
                default => default.clone(),
            };
            properties.map(|(key, property)| (key.clone(), first(property))).collect()
        }
        Form::Optional(_) | Form::ReadOnly => Value::Null,
    }
}

/// What a variant is at first.
pub(super) fn initial_variant(tag: &str, variant: &Variant<'static>) -> Value {
    if let Some(example) = variant.example {
        return example.clone();
    }
    let properties = variant.schema["properties"].as_object().into_iter().flatten();
    let mut value: serde_json::Map<String, Value> =
        properties.map(|(key, property)| (key.clone(), initial(&form(property, Unit::None)))).collect();
    value.insert(tag.to_owned(), variant.name.into());
    Value::Object(value)
}

/// A number as JSON, within its bounds.
pub(super) fn number_value(number: f64, form: &NumberForm) -> Value {
    let number = number.clamp(form.least, form.most);
    if form.is_integer { (number.round() as i64).into() } else { number.into() }
}

/// The keys of a JSON object in the order of its text, each with those of its own value.
#[derive(Debug, Default, PartialEq)]
pub(super) struct KeyOrder(Vec<(String, KeyOrder)>);

impl KeyOrder {
    /// Of a command's parameters.
    pub(super) fn of(command: &Command) -> Self {
        let text = serde_json::to_string(command).expect("commands have string keys");
        serde_json::from_str(&text).expect("it was just written")
    }

    /// The position of a key; missing keys come last.
    pub(super) fn index_of(&self, key: &str) -> usize {
        self.0.iter().position(|(name, _)| name == key).unwrap_or(usize::MAX)
    }

    /// The order within the value of a key.
    pub(super) fn within(&self, key: &str) -> &Self {
        static EMPTY: KeyOrder = KeyOrder(Vec::new());
        self.0.iter().find(|(name, _)| name == key).map_or(&EMPTY, |(_, order)| order)
    }
}

impl<'de> Deserialize<'de> for KeyOrder {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(KeyOrderVisitor)
    }
}

struct KeyOrderVisitor;

impl<'de> Visitor<'de> for KeyOrderVisitor {
    type Value = KeyOrder;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<KeyOrder, A::Error> {
        let mut keys = Vec::new();
        while let Some(entry) = map.next_entry()? {
            keys.push(entry);
        }
        Ok(KeyOrder(keys))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<KeyOrder, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(KeyOrder::default())
    }

    fn visit_bool<E>(self, _: bool) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_i64<E>(self, _: i64) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_u64<E>(self, _: u64) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_f64<E>(self, _: f64) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_str<E>(self, _: &str) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_unit<E>(self) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }
}

#[cfg(test)]
mod tests {
    use trigon_document::Bevel;

    use super::*;

    #[test]
    fn parameters_are_in_the_order_of_their_declaration() {
        let order = KeyOrder::of(&Bevel::default().into());
        assert!(order.index_of("width") < order.index_of("segments"), "the width is the first");
        assert!(order.index_of("segments") < order.index_of("clamp_overlap"), "not by the alphabet");
        assert_eq!(order.index_of("none"), usize::MAX, "there is no such key");
    }
}
