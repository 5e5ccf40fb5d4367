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

Everything that `trigon-document` can do to a document, for scripts (`trigon-editor --run`) and for programs. A script is
JSON: `{ \"version\": 1, \"commands\": [ { \"op\": \"select_all\" }, … ] }`. Missing parameters have their defaults; unknown
parameters are errors.

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
        let name = variant["const"].as_str().map(str::to_owned).or_else(|| {
            let properties = variant["properties"].as_object()?;
            // The tag that identifies the variant.
            let (tag, name) = properties.iter().find_map(|(tag, of)| Some((tag, of["const"].as_str()?)))?;
            let parameters = properties.keys().filter(|key| *key != tag);
            Some(format!("{name}: {}", parameters.cloned().collect::<Vec<_>>().join(", ")))
        });
        if let Some(name) = name {
            lines.push_str(&format!("- `{name}` {}\n", described(variant)));
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
    use super::*;

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
    fn every_command_says_what_it_does() {
        let page = command_reference();
        assert!(page.matches("\n## `").count() > 20, "commands are found");
        for section in page.split("\n## ").skip(1) {
            assert!(section.lines().nth(2).is_some_and(|line| line.len() > 10), "{section}");
        }
    }
}
