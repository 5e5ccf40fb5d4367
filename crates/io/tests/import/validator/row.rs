//! One file that the validator reports a code of, and what trigon does with it.

use crate::gltf::Doc;

use super::files::square;

/// What trigon does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The file is refused with an error.
    Refused,
    /// The file is drawn, and a warning says what is not as it should be.
    Warned,
    /// The file is drawn without a word, for this reason.
    Silent(&'static str),
}

pub(super) use Outcome::{Refused, Silent, Warned};

/// How a file is made.
#[derive(Clone, Copy)]
enum Make {
    /// The sound square, changed, as GLB.
    Glb(fn(&mut Doc)),
    /// These bytes, and the ending of their name.
    Bytes(&'static str, fn() -> Vec<u8>),
}

#[derive(Clone, Copy)]
pub(super) struct Row {
    /// The code, and after a dash which of several files of the code this is.
    pub(super) name: &'static str,
    /// What is wrong with the file, in words.
    pub(super) what: &'static str,
    pub(super) outcome: Outcome,
    make: Make,
}

impl Row {
    pub(super) fn code(&self) -> &'static str {
        self.name.split('-').next().unwrap_or_default()
    }

    /// Its file's name and bytes.
    pub(super) fn file(&self) -> (String, Vec<u8>) {
        match self.make {
            Make::Glb(change) => {
                let mut doc = square();
                change(&mut doc);
                (format!("{}.glb", self.name), doc.glb())
            }
            Make::Bytes(ending, make) => (format!("{}.{ending}", self.name), make()),
        }
    }
}

/// The square, changed.
pub(super) fn glb(name: &'static str, what: &'static str, outcome: Outcome, change: fn(&mut Doc)) -> Row {
    Row { name, what, outcome, make: Make::Glb(change) }
}

/// Bytes made by hand; a GLB.
pub(super) fn raw(name: &'static str, what: &'static str, outcome: Outcome, make: fn() -> Vec<u8>) -> Row {
    Row { name, what, outcome, make: Make::Bytes("glb", make) }
}

/// Bytes made by hand; JSON.
pub(super) fn json_file(
    name: &'static str,
    what: &'static str,
    outcome: Outcome,
    make: fn() -> Vec<u8>,
) -> Row {
    Row { name, what, outcome, make: Make::Bytes("gltf", make) }
}
