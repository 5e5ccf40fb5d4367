//! What an OBJ has that is left out or changed: counted line by line, and said
//! once each at the end.

use crate::error::Place;
use crate::warning::Warnings;

/// Counts of what is worth one warning each, with the line of the first.
#[derive(Debug, Default)]
pub(crate) struct Oddities {
    pub(crate) surplus: Tally,
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

    /// Adds what was counted further on in the file.
    pub(crate) fn add_all(&mut self, later: Self) {
        if self.count == 0 {
            self.line = later.line;
        }
        self.count += later.count;
    }
}

impl Oddities {
    /// Adds what was counted further on in the file.
    pub(crate) fn add(&mut self, later: &Self) {
        self.surplus.add_all(later.surplus);
        self.short_faces.add_all(later.short_faces);
        self.dropped_indices.add_all(later.dropped_indices);
        self.unknown.add_all(later.unknown);
    }

    /// Says once each what was odd; `colorless` are vertices without a colour
    /// while others have one.
    pub(crate) fn warn(&self, colorless: Tally, warnings: &mut Warnings) {
        let mut warn = |tally: Tally, what: &str, remedy: &str| {
            warnings.push_counted(tally.count, Place::Line(tally.line), what, remedy);
        };
        warn(
            self.surplus,
            "a vertex has more numbers than trigon reads",
            "remove the numbers after x, y, z and the colour",
        );
        warn(
            colorless,
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
