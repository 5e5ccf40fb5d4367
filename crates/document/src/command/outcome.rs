//! What a command reports when it is done.

/// A report to the user.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Outcome {
    /// A line for the status bar, as "merged 12 vertices"; empty if the image shows everything.
    pub message: String,
    /// A warning, as "cube: 2 corners …".
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Nothing to report.
    pub(crate) fn silent() -> Self {
        Self::default()
    }

    /// As "merged 12 vertices".
    pub(crate) fn counted(verb: &str, count: usize, [one, many]: [&str; 2]) -> Self {
        Self::with_message(format!("{verb} {count} {}", if count == 1 { one } else { many }))
    }

    pub(crate) fn with_message(message: impl Into<String>) -> Self {
        Self { message: message.into(), warnings: Vec::new() }
    }
}
