//! Generates the reference page of all commands from the comments in the code.

use serde_json::Value;

use super::Command;

/// The reference of all commands in Markdown: what each one does, and its parameters with types,
/// defaults and ranges. `docs/commands.md` is this text.
#[must_use]
pub fn command_reference() -> String {
    let schema = command_schema();
    let definitions = &schema["$defs"];
    let mut page = String::from(HEAD);
    for variant in schema["oneOf"].as_array().into_iter().flatten() {
        // A command is an object with its name, and its parameters by reference.
        let Some(name) = variant["properties"]["op"]["const"].as_str() else { continue };
        let parameters = resolve(variant, definitions);
        page.push_str(&format!("\n## `{name}`\n\n{}\n", described(parameters)));
        page.push_str(&table(parameters));
    }
    let mut shared = String::new();
    for (name, definition) in definitions.as_object().into_iter().flatten() {
        if !is_command(name, &schema) {
            shared.push_str(&format!("\n### {name}\n\n{}\n", described(definition)));
            shared.push_str(&choices(definition));
            shared.push_str(&table(definition));
        }
    }
    page.push_str("\n## Types\n");
    page.push_str(&shared);
    page
}

/// The JSON schema of [`Command`], from which a program can build a form for a command.
#[must_use]
pub fn command_schema() -> Value {
    schemars::schema_for!(Command).to_value()
}

const HEAD: &str = "# Commands

Everything that `trigon-document` can do to a document, for scripts (`trigon-editor --run`) and for programs.

A script is JSON: `{ \"version\": 1, \"commands\": [ … ] }`, or the list `[ … ]` alone. Each command is an object: `op` is
its name, the other keys are its parameters. Missing parameters have their defaults, and a parameter without a default and
without the word *Default* in its description has to be given; unknown parameters are errors. A parameter whose type is a
link takes what the section of that type lists: a name in quotes, or an object with the key that is named first, its tag.

In object mode commands work on the selected objects, after `edit_objects` on the selected elements of their meshes, until
`leave_edit_mode`. What is added is selected. +Y is up. This script makes a table from nothing:

```json
[
  { \"op\": \"add_object\", \"object\": { \"shape\": \"cube\", \"edge\": 1.0 }, \"name\": \"Top\", \"position\": [0, 1, 0] },
  { \"op\": \"scale\", \"factors\": [2.0, 0.1, 1.0] },
  { \"op\": \"add_material\", \"name\": \"Wood\" },
  { \"op\": \"set_material_slot\", \"slot\": 0, \"material\": \"Wood\" },
  { \"op\": \"set_material\", \"material\": \"Wood\", \"base_color\": [0.4, 0.2, 0.1, 1.0], \"roughness\": 0.6 },
  { \"op\": \"add_object\", \"object\": { \"shape\": \"cylinder\", \"radius\": 0.1, \"height\": 0.95, \"segments\": 16 },
    \"name\": \"Leg\", \"position\": [0, 0.475, 0] },
  { \"op\": \"edit_objects\" },
  { \"op\": \"set_element_kind\", \"kind\": \"face\" },
  { \"op\": \"select_by_normal\", \"direction\": [0, -1, 0] },
  { \"op\": \"inset\", \"thickness\": 0.02 },
  { \"op\": \"extrude\", \"distance\": 0.05 },
  { \"op\": \"leave_edit_mode\" },
  { \"op\": \"rotate\", \"axis\": [0, 1, 0], \"angle\": 45 }
]
```

    trigon-editor --run table.json --output table.glb

This page is generated from the comments in the code (`command_reference`, checked by a test).
";

/// The target of a `$ref`.
fn resolve<'s>(value: &'s Value, definitions: &'s Value) -> &'s Value {
    match value["$ref"].as_str().and_then(|path| path.rsplit('/').next()) {
        Some(name) => &definitions[name],
        None => value,
    }
}

fn is_command(name: &str, schema: &Value) -> bool {
    let path = format!("#/$defs/{name}");
    schema["oneOf"].as_array().is_some_and(|variants| variants.iter().any(|variant| variant["$ref"] == path))
}

/// A description on one line.
fn described(value: &Value) -> String {
    value["description"].as_str().unwrap_or_default().replace('\n', " ")
}

/// The choices of an enumeration.
fn choices(definition: &Value) -> String {
    let variants = definition["oneOf"].as_array().into_iter().flatten();
    let mut lines = String::new();
    for variant in variants {
        let name = variant["const"].as_str().map(|name| format!("`{name}`")).or_else(|| {
            let properties = variant["properties"].as_object()?;
            // The tag that identifies the variant.
            let (tag, name) = properties.iter().find_map(|(tag, of)| Some((tag, of["const"].as_str()?)))?;
            if !variant["$ref"].is_null() {
                return Some(format!("`\"{tag}\": \"{name}\"` with the parameters of {}.", type_of(variant)));
            }
            let parameters = properties.iter().filter(|(key, _)| *key != tag);
            let parameters = parameters.map(|(key, of)| format!("`{key}` ({}{})", type_of(of), limits(of)));
            let parameters = parameters.collect::<Vec<_>>().join(", ");
            Some(format!(
                "`\"{tag}\": \"{name}\"`{}{parameters}.",
                if parameters.is_empty() { "" } else { " with " }
            ))
        });
        if let Some(name) = name {
            lines.push_str(format!("- {name} {}", described(variant)).trim_end());
            lines.push('\n');
        }
    }
    if let Some(names) = definition["enum"].as_array() {
        names.iter().filter_map(Value::as_str).for_each(|name| lines.push_str(&format!("- `{name}`\n")));
    }
    if lines.is_empty() { lines } else { format!("\n{lines}") }
}

/// The parameters of a command or of a type.
fn table(value: &Value) -> String {
    // The name of a command is its heading.
    let properties = value["properties"].as_object().into_iter().flatten().filter(|(name, _)| *name != "op");
    let properties: Vec<_> = properties.collect();
    if properties.is_empty() {
        return String::new();
    }
    let mut table = String::from("\n| parameter | type | default | |\n|---|---|---|---|\n");
    for (name, property) in properties {
        let default = match &property["default"] {
            Value::Null => String::new(),
            default => format!("`{default}`"),
        };
        let text = format!("{}{}", described(property), range(property));
        table.push_str(&format!("| `{name}` | {} | {default} | {text} |\n", type_of(property)));
    }
    table
}

fn range(property: &Value) -> String {
    match (&property["minimum"], &property["maximum"]) {
        (Value::Null, Value::Null) => String::new(),
        (least, Value::Null) => format!(" At least {least}."),
        (Value::Null, most) => format!(" At most {most}."),
        (least, most) => format!(" From {least} to {most}."),
    }
}

/// The same in a list, such as ", from 3 to 100".
fn limits(property: &Value) -> String {
    let range = range(property).to_lowercase();
    match range.trim().trim_end_matches('.') {
        "" => String::new(),
        range => format!(", {range}"),
    }
}

fn type_of(property: &Value) -> String {
    if let Some(path) = property["$ref"].as_str() {
        let name = path.rsplit('/').next().unwrap_or(path);
        return format!("[{name}](#{})", name.to_lowercase());
    }
    if let Some(any) = property["anyOf"].as_array() {
        let types = any.iter().filter(|one| one["type"] != "null");
        return types.map(type_of).collect::<Vec<_>>().join(" or ");
    }
    let simple = |name: &str| match name {
        "array" if !property["items"].is_null() => {
            let of = type_of(&property["items"]);
            match property["maxItems"].as_u64() {
                Some(count) => format!("{count} × {of}"),
                // A name with a link gets no plural.
                None if of.ends_with(')') => format!("list of {of}"),
                None => format!("list of {of}s"),
            }
        }
        "boolean" => "true or false".to_owned(),
        "string" => "text".to_owned(),
        other => other.to_owned(),
    };
    match &property["type"] {
        Value::Null if property["contentEncoding"] == "base64" => "text in Base64".to_owned(),
        Value::String(name) => simple(name),
        Value::Array(names) => {
            let names = names.iter().filter_map(Value::as_str).filter(|&name| name != "null");
            names.map(simple).collect::<Vec<_>>().join(" or ")
        }
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::math::DVec3;

    use super::*;
    use crate::{Document, Script};

    /// `TRIGON_UPDATE_GOLDENS=1` writes it.
    #[test]
    fn the_page_of_commands_is_up_to_date() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/commands.md");
        let page = command_reference();
        if std::env::var_os("TRIGON_UPDATE_GOLDENS").is_some() {
            std::fs::write(path, &page).expect("docs can be written");
        }
        let known = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            known == page,
            "docs/commands.md is not what the code says: TRIGON_UPDATE_GOLDENS=1 writes it"
        );
    }

    #[test]
    fn the_example_makes_a_table_from_nothing() {
        let page = command_reference();
        let example = page.split("```json").nth(1).and_then(|rest| rest.split("```").next()).expect("there");
        let mut document = Document::default();
        Script::from_json(example).expect("a script").run(&mut document, |_| {}).expect("it can be run");
        let bounds = document.scene().bounds();
        // The foot of the leg is 5 cm below the floor, the top 5 cm above its height.
        assert!(bounds.min.abs_diff_eq(DVec3::new(-1.0, -0.05, -0.5), 1e-6), "{bounds:?}");
        assert!(bounds.max.abs_diff_eq(DVec3::new(1.0, 1.05, 0.5), 1e-6), "{bounds:?}");
    }

    /// What a reader of the page can write, without the code: each variant of each type by its tag.
    #[test]
    fn every_variant_names_its_tag() {
        let page = command_reference();
        for words in [
            "`\"shape\": \"uv_sphere\"` with `radius` (number)",
            "`\"by\": \"euler\"` with `angles` (3 × number)",
        ] {
            assert!(page.contains(words), "{words}");
        }
    }

    #[test]
    fn every_command_says_what_it_does() {
        let page = command_reference();
        assert!(page.matches("\n## `").count() > 20, "commands are found");
        for section in page.split("\n## ").skip(1) {
            assert!(section.lines().nth(2).is_some_and(|line| line.len() > 10), "{section}");
        }
    }
}
