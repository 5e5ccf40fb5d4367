//! What a file cannot hold, as data.

use std::fmt;

use crate::error::Place;

/// Something that a file holds, or a scene, and that would not be there any more after saving.
/// Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// Where it is in the file that was loaded, or in the scene.
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
