//! What is left out or changed while the mesh is built: counted element by element, and reported once each at
//! the end.

use trigon_mesh::Mesh;

use super::parse::Parsed;
use crate::error::Location;
use crate::warning::Warnings;

/// How many elements there were, and what was odd about some of them.
#[derive(Default)]
pub(super) struct Passed {
    pub(super) elements: usize,
    pub(super) non_finite: usize,
    pub(super) flat: usize,
    /// Edges and points in another material than the first edge or point of their part.
    plain: usize,
    /// The material of the first of those.
    plain_material: Option<u32>,
    /// Lines on edges of faces.
    covered: usize,
}

impl Passed {
    /// Notes an edge or a point: it is drawn in the material of the first of its part.
    pub(super) fn note_wire(&mut self, slot: u32, material: Option<u32>) {
        if slot != 0 {
            self.plain += 1;
            self.plain_material = self.plain_material.or(material);
        }
    }

    /// Notes which lines of a mesh are edges of its faces, too: those are not loose.
    pub(super) fn note_covered(&mut self, mut lines: Vec<[u32; 2]>, mesh: &Mesh) {
        lines.sort_unstable();
        lines.dedup();
        self.covered += lines.len() - mesh.loose_edges().len();
    }

    pub(super) fn warn(&self, parsed: &Parsed, warnings: &mut Warnings) {
        let mut warn = |count: usize, line: Option<u64>, what: &str, remedy: &str| {
            warnings.push_counted(count, line.map_or(Location::Whole, Location::Line), what, remedy);
        };
        warn(
            self.non_finite,
            parsed.non_finite_line,
            "a face, a line or a point has a vertex that is not finite and is left out",
            "export the model again",
        );
        warn(
            self.flat,
            parsed.flat_line,
            "a face has fewer than 3 different vertices and is left out",
            "clean the model up",
        );
        warn(
            self.plain,
            self.plain_material.map(|material| parsed.record.material_lines[material as usize]),
            "a line or a point has another material than the first of its group, whose colour it gets",
            "start a group for each material, with g",
        );
        warn(
            self.covered,
            parsed.wire_line,
            "a line on the edge of a face of its group is not drawn",
            "start a group for the lines, with g",
        );
    }
}
