//! Losses: what a file format cannot hold, as data.

use std::fmt;

use crate::error::Location;

/// Something in a file or a scene that would be lost by saving. Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Loss {
    /// Its location in the loaded file, or in the scene.
    pub location: Location,
    /// What it is.
    pub what: String,
}

impl Loss {
    /// Something of the whole scene.
    pub(crate) fn of_scene(what: impl Into<String>) -> Self {
        Self { location: Location::Whole, what: what.into() }
    }
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let location = self.location.to_string();
        match location.strip_prefix(", ") {
            Some(location) => write!(f, "{location}: {}", self.what),
            None => f.write_str(&self.what),
        }
    }
}
