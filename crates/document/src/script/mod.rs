//! Scripts: lists of commands as JSON.

mod fault;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::command::{Command, Outcome};
use crate::document::Document;
use crate::error::EditError;

/// Commands to be run one after another.
///
/// ```
/// use trigon_document::{Document, Script};
/// use trigon_scene::showcase;
///
/// let script = Script::from_json(r#"{ "version": 1, "commands": [
///     { "op": "select_all" },
///     { "op": "edit_objects" },
///     { "op": "set_element_kind", "kind": "face" },
///     { "op": "select_all" },
///     { "op": "delete" }
/// ] }"#)?;
/// let mut document = Document::new(showcase());
/// script.run(&mut document, |_| {})?;
/// assert!(document.scene().meshes().iter().all(|(_, mesh)| mesh.mesh().face_count() == 0));
/// # Ok::<(), trigon_document::EditError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// The version of the format: 1.
    pub version: u32,
    /// The commands, in order.
    pub commands: Vec<Command>,
}

/// The progress of a script.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ScriptProgress<'s> {
    /// The index of the next command, from 0.
    pub index: usize,
    /// How many commands there are.
    pub count: usize,
    /// The next command.
    pub command: &'s Command,
}

impl Script {
    /// The version that is written.
    pub const VERSION: u32 = 1;

    /// A script of commands, as [`Document::script`] returns them.
    #[must_use]
    pub fn new(commands: Vec<Command>) -> Self {
        Self { version: Self::VERSION, commands }
    }

    /// Reads a script: a whole one, or a list of commands alone.
    ///
    /// # Errors
    /// It is not valid JSON, has another version, or contains an unknown command or parameter. The message names the
    /// line, the command and, where it is to blame, the parameter.
    pub fn from_json(text: &str) -> Result<Self, EditError> {
        let is_list = text.trim_start().starts_with('[');
        let parsed = if is_list {
            serde_json::from_str(text).map(Self::new)
        } else {
            serde_json::from_str::<Self>(text)
        };
        let script = parsed.map_err(|error| fault::describe(text, &error))?;
        if script.version != Self::VERSION {
            let what = format!("the version is {}, but only version 1 is known", script.version);
            return Err(EditError::Script { position: "version".into(), what });
        }
        Ok(script)
    }

    /// Writes the script, one command per line.
    #[must_use]
    pub fn to_json(&self) -> String {
        let line = |command: &Command| serde_json::to_string(command).expect("commands have string keys");
        let lines: Vec<String> = self.commands.iter().map(line).collect();
        format!("{{ \"version\": {}, \"commands\": [\n{}\n] }}\n", self.version, lines.join(",\n"))
    }

    /// Runs all commands, and returns their outcomes. `progress` is called before each.
    ///
    /// # Errors
    /// A command failed: the error says which. The commands before it stay done.
    pub fn run(
        &self,
        document: &mut Document,
        mut progress: impl FnMut(ScriptProgress<'_>),
    ) -> Result<Vec<Outcome>, EditError> {
        let count = self.commands.len();
        let mut outcomes = Vec::with_capacity(count);
        for (index, command) in self.commands.iter().enumerate() {
            progress(ScriptProgress { index, count, command });
            let outcome = document.run(command.clone()).map_err(|error| EditError::Script {
                position: format!("command {} of {count} ({})", index + 1, command.name()),
                what: error.to_string(),
            })?;
            outcomes.push(outcome);
        }
        Ok(outcomes)
    }
}
