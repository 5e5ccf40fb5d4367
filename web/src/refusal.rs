//! Errors as JavaScript gets them: JSON, of which the page makes an `Error` with fields.

use serde::Serialize;
use trigon_io::LoadError;

/// Why something was not done.
#[derive(Serialize)]
pub(crate) struct Refusal {
    /// `Read`, `Unsupported`, `Malformed`, `Forbidden`, `Limit`, `Empty` or `Render`.
    kind: String,
    file: Option<String>,
    message: String,
}

impl Refusal {
    /// An image could not be drawn.
    pub(crate) fn of_image(error: impl ToString) -> String {
        Self { kind: "Render".to_owned(), file: None, message: error.to_string() }.json()
    }

    /// A file could not be loaded.
    pub(crate) fn of_file(error: &LoadError) -> String {
        let (kind, message) = (format!("{:?}", error.kind), error.to_string());
        Self { kind, file: Some(error.file.display().to_string()), message }.json()
    }

    fn json(&self) -> String {
        serde_json::to_string(self).unwrap_or_else(|error| error.to_string())
    }
}
