//! What an OBJ has that is left out or changed: counted line by line, and said
//! once each at the end.

use crate::error::Place;
use crate::warning::Warnings;

/// Counts of what is worth one warning each, with the line of the first.
#[derive(Debug, Default)]
pub(crate) struct Oddities {
    pub(crate) surplus: Tally,
    pub(crate) colorless: Tally,
    pub(crate) short_faces: Tally,
    pub(crate) dropped_indices: Tally,
    pub(crate) unknown: Tally,
}

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    count: usize,
    line: u64,
}

impl Tally {
    pub(crate) fn add(&mut self, line: u64) {
        if self.count == 0 {
            self.line = line;
        }
        self.count += 1;
    }
}

impl Oddities {
    /// Says once each what was odd.
    pub(crate) fn warn(&self, warnings: &mut Warnings) {
        let mut warn = |tally: Tally, what: &str, remedy: &str| {
            warnings.push_counted(tally.count, Place::Line(tally.line), what, remedy);
        };
        warn(
            self.surplus,
            "a vertex has more numbers than trigon reads",
            "remove the numbers after x, y, z and the colour",
        );
        warn(
            self.colorless,
            "a vertex has no colour while others have; it is white",
            "export colours for all vertices or for none",
        );
        warn(
            self.short_faces,
            "a face has fewer than 3 vertices and is left out",
            "remove it, or write edges with `l` and points with `p`",
        );
        warn(
            self.dropped_indices,
            "a texture coordinate or normal index leads nowhere and is ignored",
            "export the model again",
        );
        warn(self.unknown, "curves and surfaces are not drawn", "convert them to polygons");
    }
}
