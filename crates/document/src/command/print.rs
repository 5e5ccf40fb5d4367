//! What is in the way of printing: selecting thin walls and overhangs, and closing meshes with a report.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{OverhangSettings, SolidReport, SolidSettings};

use super::select_related::change_selections;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::Change;

/// Selects exactly the faces behind which the body is thin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectThin {
    /// Walls thinner than this are selected, in metres of the mesh.
    #[schemars(range(min = 0.0))]
    pub thickness: f64,
}

impl Default for SelectThin {
    fn default() -> Self {
        Self { thickness: 0.0008 }
    }
}

impl Action for SelectThin {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select thin walls", |mesh, kind, selection| {
            let faces = mesh.thin_faces(self.thickness).iter().map(|thin| thin.face).collect();
            selection.select(mesh, kind, &Elements::Faces(faces));
            Ok(())
        })
    }
}

/// Selects exactly the faces that look down so far that nothing holds them while they are printed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectOverhangs {
    /// Away from the build plate, in the space of the mesh; its length does not matter.
    pub up: [f64; 3],
    /// Faces are selected whose normal is nearer to straight down than this, in degrees.
    #[schemars(range(min = 0.0, max = 90.0))]
    pub angle: f64,
    /// Faces no higher than this above the lowest vertex lie on the build plate and are not selected, in metres.
    #[schemars(range(min = 0.0))]
    pub plate_within: f64,
}

impl Default for SelectOverhangs {
    fn default() -> Self {
        Self { up: [0.0, 1.0, 0.0], angle: 45.0, plate_within: 1e-5 }
    }
}

impl Action for SelectOverhangs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (up, angle) = (DVec3::from(self.up), self.angle.to_radians());
        let settings = OverhangSettings { up, angle, plate_within: self.plate_within };
        change_selections(change, "select overhangs", |mesh, kind, selection| {
            selection.select(mesh, kind, &Elements::Faces(mesh.overhanging_faces(&settings)));
            Ok(())
        })
    }
}

/// Closes the edited meshes: joins doubles, takes away what has no area, fills holes and turns faces outwards.
///
/// Vertices are joined at open edges only, and a flat open part is not filled. What was mended is reported, and what is left is a
/// warning.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MakeSolid {
    /// How far apart vertices are that become one, in metres.
    #[schemars(range(min = 0.0))]
    pub within: f64,
    /// Faces no larger than this go, in square metres.
    #[schemars(range(min = 0.0))]
    pub zero_area: f64,
    /// Holes with more edges stay open; none for holes of any size.
    pub most_hole_edges: Option<usize>,
}

impl Default for MakeSolid {
    fn default() -> Self {
        let SolidSettings { within, zero_area, .. } = SolidSettings::default();
        Self { within, zero_area, most_hole_edges: None }
    }
}

impl Action for MakeSolid {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            return Err(EditError::NotEditing("making solid"));
        }
        let most_hole_edges = self.most_hole_edges.unwrap_or(usize::MAX);
        let settings = SolidSettings { within: self.within, zero_area: self.zero_area, most_hole_edges };
        let ids: Vec<_> = change.selection().meshes().map(|(id, _)| id).collect();
        let mut reports = Vec::new();
        for id in ids {
            reports.push(change.edit(id, |mesh| Ok(mesh.make_solid(&settings)?))?);
        }
        Ok(reported(&reports))
    }
}

/// Counts of elements of a kind, summed over all meshes.
struct Count {
    of: fn(&SolidReport) -> usize,
    one: &'static str,
    many: &'static str,
}

const fn count(of: fn(&SolidReport) -> usize, one: &'static str, many: &'static str) -> Count {
    Count { of, one, many }
}

const MENDED: [Count; 7] = [
    count(|report| report.merged_vertices, "vertex joined", "vertices joined"),
    count(|report| report.zero_area_faces, "face without area removed", "faces without area removed"),
    count(|report| report.doubled_faces, "doubled face removed", "doubled faces removed"),
    count(|report| report.loose_edges, "loose edge removed", "loose edges removed"),
    count(|report| report.loose_vertices, "loose vertex removed", "loose vertices removed"),
    count(|report| report.filled_holes, "hole filled", "holes filled"),
    count(|report| report.turned_faces, "face turned over", "faces turned over"),
];

const LEFT: [Count; 3] = [
    count(|report| report.open_edges_left, "open edge is left", "open edges are left"),
    count(
        |report| report.non_manifold_edges_left,
        "edge of three or more faces is left",
        "edges of three or more faces are left",
    ),
    count(
        |report| report.inconsistent_edges_left,
        "edge of faces that look to different sides is left",
        "edges of faces that look to different sides are left",
    ),
];

/// What was mended as the message, what is left as warnings.
fn reported(reports: &[SolidReport]) -> Outcome {
    let listed = |counts: &[Count]| -> Vec<String> {
        let sums = counts.iter().map(|count| (count, reports.iter().map(count.of).sum::<usize>()));
        let found = sums.filter(|(_, sum)| *sum > 0);
        found.map(|(count, sum)| format!("{sum} {}", if sum == 1 { count.one } else { count.many })).collect()
    };
    let mended = listed(&MENDED);
    let message = if mended.is_empty() { "nothing to mend".to_owned() } else { mended.join(", ") };
    Outcome { warnings: listed(&LEFT), ..Outcome::with_message(message) }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;

    use crate::tests::commands::{chosen, edited, editing_faces, run};

    #[test]
    fn thin_walls_and_overhangs_are_selected() {
        let mut document = editing_faces(primitives::cube(2.0));
        let thin = |thickness: f64| json!({ "op": "select_thin", "thickness": thickness });
        assert_eq!(chosen(&mut document, thin(2.0)), 0, "it is as thick");
        assert_eq!(chosen(&mut document, thin(2.01)), 6, "from each side");
        assert_eq!(chosen(&mut document, json!({ "op": "select_overhangs" })), 0, "it stands on its plate");
        let tilted = json!({ "op": "select_overhangs", "up": [0.0, 1.0, 0.5] });
        assert_eq!(chosen(&mut document, tilted), 1, "the side that looks down most");
    }

    #[test]
    fn a_broken_cube_is_closed_with_a_report() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "select_by_normal" }));
        run(&mut document, json!({ "op": "delete", "what": "faces" }));
        let command = serde_json::from_value(json!({ "op": "make_solid" })).expect("a command");
        let outcome = document.run(command).expect("possible");
        assert_eq!((outcome.message.as_str(), outcome.warnings.len()), ("1 hole filled", 0));
        assert!(edited(&document).is_watertight(), "closed");
        let mut sheet = editing_faces(primitives::grid(1.0, 1.0, 2, 2));
        let command = serde_json::from_value(json!({ "op": "make_solid" })).expect("a command");
        let outcome = sheet.run(command).expect("possible");
        assert_eq!(outcome.message, "nothing to mend");
        assert_eq!(outcome.warnings, ["8 open edges are left"]);
    }
}
