//! Where in a script something is wrong: line, command, parameter.

use std::ops::Range;

use serde_json::{Map, Value};

use crate::command::Command;
use crate::error::EditError;

/// The error of a script, with the command and the parameter that it is about.
pub(super) fn describe(text: &str, error: &serde_json::Error) -> EditError {
    let mut position = format!("line {}, column {}", error.line(), error.column());
    let at = offset(text, error);
    let spans = commands(text);
    // What a command holds is checked when the first character behind it has been read.
    let read = |span: &Range<usize>| text[span.end..at.max(span.end).min(text.len())].trim().len() <= 1;
    let index = spans.iter().rposition(|span| span.start < at).filter(|&index| read(&spans[index]));
    if let Some(index) = index {
        if error.is_data() {
            position = format!("line {}", text[..spans[index].start].matches('\n').count() + 1);
        }
        position.push_str(&format!(", command {}", index + 1));
        if let Ok(Value::Object(command)) = serde_json::from_str(&text[spans[index].clone()]) {
            let op = command.get("op").and_then(Value::as_str);
            position.push_str(&op.map_or_else(String::new, |op| format!(" ({op})")));
            if let Some(parameter) = culprit(&command, &without_position(error)) {
                position.push_str(&format!(", parameter {parameter:?}"));
            }
        }
    }
    EditError::Script { position, what: without_position(error) }
}

/// The message without the line and the column at its end.
fn without_position(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let position = format!(" at line {} column {}", error.line(), error.column());
    text.strip_suffix(&position).map(str::to_owned).unwrap_or(text)
}

/// The byte that a line and a column lead to. Columns count bytes, from 1; that of a line's end is its length.
fn offset(text: &str, error: &serde_json::Error) -> usize {
    let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    before + error.column()
}

/// The first parameter that alone gives the same error.
fn culprit<'c>(command: &'c Map<String, Value>, message: &str) -> Option<&'c str> {
    let op = command.get("op")?;
    let fails = |parameter: &str| {
        let alone: Map<String, Value> =
            [("op".to_owned(), op.clone()), (parameter.to_owned(), command[parameter].clone())]
                .into_iter()
                .collect();
        let error = serde_json::from_value::<Command>(alone.into()).err();
        error.is_some_and(|error| error.to_string() == message)
    };
    // What is missing is no parameter's fault.
    let is_missing = message.starts_with("missing field");
    command.keys().map(String::as_str).find(|&key| key != "op" && !is_missing && fails(key))
}

/// Where the commands stand: the objects in a list that is the script, or a value of it. Only as far as the text is JSON.
fn commands(text: &str) -> Vec<Range<usize>> {
    let (mut open, mut spans) = (Vec::new(), Vec::new());
    let (mut is_text, mut is_escaped) = (false, false);
    for (index, byte) in text.bytes().enumerate() {
        if is_text {
            is_text = is_escaped || byte != b'"';
            is_escaped = !is_escaped && byte == b'\\';
            continue;
        }
        match byte {
            b'"' => is_text = true,
            b'{' | b'[' => {
                let is_command = byte == b'{' && matches!(&open[..], [b'['] | [b'{', b'[']);
                open.push(byte);
                if is_command {
                    // Until its end is found it reaches to that of the text.
                    spans.push(index..text.len());
                }
            }
            b'}' | b']' => {
                let was = open.pop();
                if was == Some(b'{') && matches!(&open[..], [b'['] | [b'{', b'[']) {
                    spans.last_mut().expect("it was pushed when it was opened").end = index + 1;
                }
            }
            _ => {}
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use crate::Script;

    #[test]
    fn a_fault_is_named_by_line_command_and_parameter() {
        for (text, words) in [
            (
                r#"[{"op":"select_all"},{"op":"translate","offset":[1,2,"x"]}]"#,
                &["command 2 (translate)", "\"offset\""][..],
            ),
            (
                "{ \"version\": 1, \"commands\": [\n{\"op\":\"select_all\"},\n{\"op\":\"bevel\",\"width\":1,\"segments\":-1}\n] }",
                &["line 3", "command 2 (bevel)", "\"segments\"", "-1"],
            ),
            (
                r#"[{"op":"select_sharp","angel":3}]"#,
                &["command 1 (select_sharp)", "parameter \"angel\"", "expected"],
            ),
            (r#"[{"op":"add_object","object":{"shape":"cube"}}]"#, &["command 1 (add_object)", "edge"]),
            (r#"[{"op":"add_object"}]"#, &["command 1 (add_object)", "missing field `object`"]),
            (r#"[{"op":"select_all"},{"op":"explode"}]"#, &["command 2 (explode)", "unknown variant"]),
            (
                r#"[{"op":"rename_object","object":"a \"}]","name":5}]"#,
                &["command 1 (rename_object)", "\"name\""],
            ),
            ("[\n{\"op\":\"select_all\"},\n{\"op\" \"select_none\"}]", &["line 3", "command 2"]),
            (r#"[{"op":"select_all"}"#, &["line 1", "EOF"]),
            ("5", &["line 1"]),
        ] {
            let message = Script::from_json(text).expect_err("wrong").to_string();
            for word in words {
                assert!(message.contains(word), "{text}: {message}");
            }
        }
    }

    #[test]
    fn a_list_of_commands_is_a_script() {
        let list = Script::from_json(" [ { \"op\": \"select_all\" } ]").expect("a list");
        let whole = Script::from_json(r#"{ "version": 1, "commands": [ { "op": "select_all" } ] }"#);
        assert_eq!(list, whole.expect("a script"));
        assert_eq!(Script::from_json("[]").expect("a list").commands, []);
    }
}
