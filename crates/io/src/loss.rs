//! Losses: what a file format cannot hold, as data.

use std::fmt;

use crate::error::Place;

/// Something in a file or a scene that would be lost by saving. Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Loss {
    /// Its location in the loaded file, or in the scene.
    pub place: Place,
    /// What it is.
    pub what: String,
}

impl Loss {
    /// Something of the whole scene.
    pub(crate) fn of_scene(what: impl Into<String>) -> Self {
        Self { place: Place::Whole, what: what.into() }
    }
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = self.place.to_string();
        match place.strip_prefix(", ") {
            Some(place) => write!(f, "{place}: {}", self.what),
            None => f.write_str(&self.what),
        }
    }
}
