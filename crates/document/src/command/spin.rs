//! Sweeping elements around an axis, and cutting along a plane.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{BisectSettings, SpinSettings, VertexId};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

/// Sweeps the selected edges and vertices around an axis in the space of the mesh, in steps; with a height as a screw. Faces
/// close the ends. What is at the end is selected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Spin {
    /// A point on the axis, in metres.
    pub center: [f64; 3],
    /// The direction of the axis.
    pub axis: [f64; 3],
    /// The angle of a turn in degrees, counter-clockwise seen from the tip of the axis; 360 without a height joins the ends.
    pub angle: f64,
    /// How many steps a turn has.
    #[schemars(range(min = 1))]
    pub steps: u32,
    /// How far each turn moves along the axis, in metres.
    pub height: f64,
    /// How many turns follow each other.
    #[schemars(range(min = 1))]
    pub turns: u32,
}

impl Default for Spin {
    fn default() -> Self {
        let SpinSettings { center, axis, angle, steps, height, turns } = SpinSettings::default();
        Self { center, axis, angle: angle.to_degrees(), steps, height, turns }
    }
}

impl Action for Spin {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let &Self { center, axis, angle, steps, height, turns } = self;
        let settings = SpinSettings { center, axis, angle: angle.to_radians(), steps, height, turns };
        let kind = change.selection().kind();
        let mut faces = 0;
        change.edit_selected("spinning", "edges or vertices", |mesh, selection| {
            let edges = selection.edges(mesh, kind);
            let ends: BTreeSet<VertexId> = edges.iter().flat_map(|&edge| mesh.edge_vertices(edge)).collect();
            let mut alone = selection.vertices(mesh, kind);
            alone.retain(|vertex| !ends.contains(vertex));
            let made = mesh.spin(&edges, &alone, &settings)?;
            faces += made.faces.len();
            let is_of_edges = alone.is_empty();
            let end = match is_of_edges {
                true if !made.ends.is_empty() => Elements::Faces(made.ends),
                true => Elements::Edges(made.edges),
                false => Elements::Vertices(made.vertices),
            };
            Ok(AfterEdit::Select(end))
        })?;
        Ok(Outcome::counted("made", faces, ["face", "faces"]))
    }
}

/// Cuts the selected faces along a plane in the space of the mesh. The cut is selected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Bisect {
    /// On the plane, in metres.
    pub point: [f64; 3],
    /// Perpendicular to it; its length does not matter.
    pub normal: [f64; 3],
    /// Whether what is in front of the plane, where its normal points to, is removed.
    pub clear_outer: bool,
    /// Whether what is behind it is removed.
    pub clear_inner: bool,
    /// Whether the cut is filled with faces.
    pub fill: bool,
    /// Vertices at most this far from the plane, in metres, count as on it.
    #[schemars(range(min = 0.0))]
    pub threshold: f64,
}

impl Default for Bisect {
    fn default() -> Self {
        let BisectSettings { clear_outer, clear_inner, fill, threshold } = BisectSettings::default();
        Self { point: [0.0; 3], normal: [1.0, 0.0, 0.0], clear_outer, clear_inner, fill, threshold }
    }
}

impl Action for Bisect {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let &Self { clear_outer, clear_inner, fill, threshold, .. } = self;
        let (point, normal) = (DVec3::from(self.point), DVec3::from(self.normal));
        let settings = BisectSettings { clear_outer, clear_inner, fill, threshold };
        let kind = change.selection().kind();
        let mut edges = 0;
        change.edit_selected("bisecting", "at least one selected face", |mesh, selection| {
            let made = mesh.bisect(&selection.faces(mesh, kind), point, normal, &settings)?;
            edges += made.edges.len();
            Ok(AfterEdit::Select(Elements::Edges(made.edges)))
        })?;
        Ok(Outcome::counted("made", edges, ["edge", "edges"]))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;

    use crate::tests::commands::{edited, editing_faces, run, try_run};

    #[test]
    fn a_border_is_spun_by_degrees_and_undone() {
        let mut document = editing_faces(primitives::grid(2.0, 2.0, 1, 1));
        let spin = json!({ "op": "spin", "center": [0, 3, 0], "axis": [1, 0, 0], "angle": 90, "steps": 3 });
        let outcome = try_run(&mut document, spin).expect("possible");
        assert_eq!((outcome.message.as_str(), edited(&document).face_count()), ("made 12 faces", 14));
        assert!(edited(&document).is_watertight(), "the square closes both ends");
        document.undo().expect("one");
        assert_eq!(edited(&document).face_count(), 1);
        let refused =
            try_run(&mut document, json!({ "op": "spin", "axis": [0, 0, 0] })).expect_err("no axis");
        assert!(refused.to_string().contains("axis"), "{refused}");
    }

    #[test]
    fn half_a_cube_is_left_and_closed() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "bisect", "normal": [1, 1, 0], "clear_outer": true, "fill": true }));
        assert!(edited(&document).is_watertight());
        assert!((edited(&document).volume() - 4.0).abs() < 1e-6, "{}", edited(&document).volume());
        document.undo().expect("one");
        let refused =
            try_run(&mut document, json!({ "op": "bisect", "normal": [0, 0, 0] })).expect_err("none");
        assert!(refused.to_string().contains("normal"), "{refused}");
    }
}
