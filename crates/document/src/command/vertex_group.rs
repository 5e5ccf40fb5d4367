//! Vertex groups: named sets of weighted vertices of an object's mesh, which modifiers and moves can be limited to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{EditMesh, GroupAssignment, Refusal, VertexId};

use super::modifier::mesh_of;
use super::select_related::change_selections;
use super::transform::VERTICES;
use super::{Action, ObjectName, Outcome, Proportional, SelectAction};
use crate::error::EditError;
use crate::selection::{Elements, MeshSelection};
use crate::state::Change;

const GROUP: &str = "a vertex group";

/// The name of a group, or of the last one of a mesh.
fn named_or_last(mesh: &EditMesh, name: Option<&String>) -> Result<String, Refusal> {
    let named = name.cloned().or_else(|| mesh.vertex_group_names().last().map(str::to_owned));
    let reason = "the mesh has none: add one first";
    named.ok_or(Refusal::NotPossible { operation: GROUP, reason })
}

/// Adds a vertex group to an object's mesh: a named set of vertices, each with a weight from 0 to 1. In edit mode the selected
/// vertices are in it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AddVertexGroup {
    /// The object. Default: the active one.
    pub object: Option<ObjectName>,
    /// The name. Default: `Group`, with a number if the mesh has one.
    pub name: Option<String>,
    /// Whether the group is empty, also in edit mode.
    pub empty: bool,
}

impl AddVertexGroup {
    fn name_for(&self, mesh: &EditMesh) -> String {
        let is_free = |name: &String| mesh.vertex_group(name).is_none();
        let numbered = (1..).map(|number| format!("Group.{number:03}"));
        let mut names = std::iter::once("Group".to_owned()).chain(numbered);
        self.name.clone().unwrap_or_else(|| names.find(is_free).expect("a mesh has few groups"))
    }
}

impl Action for AddVertexGroup {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = mesh_of(change, self.object.as_ref(), GROUP)?;
        let kind = change.selection().kind();
        let selected = change.selection().of(id).filter(|_| !self.empty).cloned();
        let name = change.edit(id, |mesh| {
            let name = self.name_for(mesh);
            mesh.add_vertex_group(&name)?;
            let vertices: Vec<VertexId> =
                selected.map_or_else(Vec::new, |selection| selection.vertices(mesh, kind));
            if !vertices.is_empty() {
                mesh.assign_to_vertex_group(&name, &vertices, &GroupAssignment::default())?;
            }
            Ok(name)
        })?;
        Ok(Outcome::with_message(name))
    }
}

/// Removes a vertex group from an object's mesh; its vertices stay. A modifier that it limits is left out until it has another
/// group, or none.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RemoveVertexGroup {
    /// The object. Default: the active one.
    pub object: Option<ObjectName>,
    /// The group. Default: the last one.
    pub group: Option<String>,
}

impl Action for RemoveVertexGroup {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = mesh_of(change, self.object.as_ref(), GROUP)?;
        change.edit(id, |mesh| Ok(mesh.remove_vertex_group(&named_or_last(mesh, self.group.as_ref())?)?))?;
        Ok(Outcome::silent())
    }
}

/// Gives a vertex group another name, also in the modifiers that it limits.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RenameVertexGroup {
    /// The object. Default: the active one.
    pub object: Option<ObjectName>,
    /// The group. Default: the last one.
    pub group: Option<String>,
    /// The new name, which no other group of the mesh has.
    pub name: String,
}

impl Action for RenameVertexGroup {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = mesh_of(change, self.object.as_ref(), GROUP)?;
        change.edit(id, |mesh| {
            Ok(mesh.rename_vertex_group(&named_or_last(mesh, self.group.as_ref())?, &self.name)?)
        })?;
        Ok(Outcome::silent())
    }
}

/// Gives the selected vertices of the edited meshes a weight in a vertex group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AssignToVertexGroup {
    /// The group. Default: the last one of each mesh.
    pub group: Option<String>,
    /// The weight.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub weight: f64,
    /// Also gives vertices near the selected ones a weight, which falls off with distance as moves do; lengths are those of
    /// the mesh.
    pub falloff: Option<Proportional>,
    /// Whether nearby vertices get lower weights than they have; otherwise they keep these.
    pub replace: bool,
}

impl Default for AssignToVertexGroup {
    fn default() -> Self {
        Self { group: None, weight: 1.0, falloff: None, replace: false }
    }
}

impl Action for AssignToVertexGroup {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let assignment = GroupAssignment {
            weight: self.weight,
            falloff: self.falloff.as_ref().map(|near| near.falloff(1.0)),
            replace: self.replace,
        };
        let mut changed = 0;
        change.edit_selected_vertices("assigning to a vertex group", VERTICES, |mesh, vertices| {
            let group = named_or_last(mesh, self.group.as_ref())?;
            changed += mesh.assign_to_vertex_group(&group, vertices, &assignment)?;
            Ok(())
        })?;
        Ok(Outcome::counted("weighted", changed, ["vertex", "vertices"]))
    }
}

/// Takes the selected vertices of the edited meshes out of a vertex group.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RemoveFromVertexGroup {
    /// The group. Default: the last one of each mesh.
    pub group: Option<String>,
}

impl Action for RemoveFromVertexGroup {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut removed = 0;
        change.edit_selected_vertices("removing from a vertex group", VERTICES, |mesh, vertices| {
            let group = named_or_last(mesh, self.group.as_ref())?;
            removed += mesh.remove_from_vertex_group(&group, vertices)?;
            Ok(())
        })?;
        Ok(Outcome::counted("removed", removed, ["vertex", "vertices"]))
    }
}

/// Selects the vertices of a vertex group in the edited meshes, and the edges and faces all of whose vertices are in it. A mesh
/// without such a group has none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectVertexGroup {
    /// The group. Default: the last one of each mesh.
    pub group: Option<String>,
    /// Vertices with a smaller weight are not selected.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub minimum: f64,
    /// How this combines with the previous selection.
    pub action: SelectAction,
}

impl Default for SelectVertexGroup {
    /// All vertices of the group are added.
    fn default() -> Self {
        Self { group: None, minimum: 0.0, action: SelectAction::Add }
    }
}

impl SelectVertexGroup {
    fn vertices(&self, mesh: &EditMesh) -> Vec<VertexId> {
        let name = named_or_last(mesh, self.group.as_ref()).unwrap_or_default();
        let Some(group) = mesh.vertex_group(&name) else { return Vec::new() };
        let is_enough = |(vertex, weight): &(VertexId, f32)| {
            f64::from(*weight) >= self.minimum && !mesh.is_vertex_hidden(*vertex)
        };
        group.vertices().filter(is_enough).map(|(vertex, _)| vertex).collect()
    }
}

impl Action for SelectVertexGroup {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut is_known = false;
        let outcome = change_selections(change, "select a vertex group", |mesh, kind, selection| {
            is_known |= match &self.group {
                Some(name) => mesh.vertex_group(name).is_some(),
                None => mesh.vertex_group_names().len() > 0,
            };
            let mut found = MeshSelection::default();
            found.select(mesh, kind, &Elements::Vertices(self.vertices(mesh)));
            let joined = self.action.joined(selection.bits(), found.bits());
            selection.set(joined);
            Ok(())
        })?;
        match &self.group {
            _ if is_known => Ok(outcome),
            Some(name) => Err(Refusal::NoSuchGroup(name.clone()).into()),
            None => {
                let reason = "no edited mesh has one: add one first";
                Err(Refusal::NotPossible { operation: GROUP, reason }.into())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use trigon_mesh::primitives;

    use crate::document::Document;
    use crate::tests::commands::{edited, editing_faces, run, try_run};

    fn names(document: &Document) -> Vec<String> {
        edited(document).vertex_group_names().map(str::to_owned).collect()
    }

    /// Runs a command. Returns how many elements are selected.
    fn selected(document: &mut Document, command: Value) -> usize {
        run(document, command);
        document.selection().meshes().next().expect("one is edited").1.len()
    }

    #[test]
    fn groups_are_added_renamed_removed_and_undone() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "add_vertex_group" }));
        run(&mut document, json!({ "op": "add_vertex_group", "name": "top", "empty": true }));
        run(&mut document, json!({ "op": "add_vertex_group" }));
        assert_eq!(names(&document), ["Group", "top", "Group.001"]);
        let counts: Vec<usize> = ["Group", "top", "Group.001"]
            .map(|name| edited(&document).vertex_group(name).map_or(99, |group| group.vertices().count()))
            .to_vec();
        assert_eq!(counts, [8, 0, 8], "the selected vertices, or none");
        run(&mut document, json!({ "op": "rename_vertex_group", "group": "top", "name": "above" }));
        run(&mut document, json!({ "op": "remove_vertex_group", "group": "Group" }));
        run(&mut document, json!({ "op": "remove_vertex_group" }));
        assert_eq!(names(&document), ["above"]);
        let taken = json!({ "op": "add_vertex_group", "name": "above" });
        let refused = try_run(&mut document, taken).expect_err("it is there").to_string();
        assert!(refused.contains("\"above\" already"), "{refused}");
        for _ in 0..6 {
            document.undo().expect("each was one step");
        }
        assert_eq!(names(&document), [""; 0]);
        for op in ["remove_vertex_group", "assign_to_vertex_group", "select_vertex_group"] {
            let refused = try_run(&mut document, json!({ "op": op })).expect_err("there is none").to_string();
            assert!(refused.contains("add one first"), "{refused}");
        }
    }

    #[test]
    fn vertices_are_assigned_removed_and_selected_by_weight() {
        let mut document = editing_faces(primitives::grid(4.0, 4.0, 4, 4));
        run(&mut document, json!({ "op": "add_vertex_group", "name": "spot", "empty": true }));
        run(&mut document, json!({ "op": "set_element_kind", "kind": "vertex" }));
        run(&mut document, json!({ "op": "select_none" }));
        // The middle of five times five vertices, 1 m apart.
        run(&mut document, json!({ "op": "select", "elements": [12] }));
        let falloff = json!({ "radius": 2.0, "shape": "linear" });
        let assign = json!({ "op": "assign_to_vertex_group", "weight": 0.5, "falloff": falloff });
        let outcome = try_run(&mut document, assign).expect("possible");
        assert_eq!(outcome.message, "weighted 9 vertices", "nearer than 2 m");
        let select =
            |minimum: f64| json!({ "op": "select_vertex_group", "minimum": minimum, "action": "replace" });
        assert_eq!(selected(&mut document, select(0.0)), 9);
        assert_eq!(selected(&mut document, select(0.25)), 5, "1 m away");
        assert_eq!(selected(&mut document, select(0.5)), 1, "the middle");
        let outcome = try_run(&mut document, json!({ "op": "remove_from_vertex_group" })).expect("possible");
        assert_eq!(outcome.message, "removed 1 vertex");
        run(&mut document, json!({ "op": "select_all" }));
        let deselect = json!({ "op": "select_vertex_group", "group": "spot", "action": "remove" });
        assert_eq!(selected(&mut document, deselect), 25 - 8);
        let unknown = json!({ "op": "select_vertex_group", "group": "spots" });
        let refused = try_run(&mut document, unknown).expect_err("no such group").to_string();
        assert!(refused.contains("\"spots\""), "{refused}");
    }

    #[test]
    fn a_wall_is_as_thick_as_its_group_says_and_follows_it() {
        let mut document = editing_faces(primitives::grid(2.0, 2.0, 2, 2));
        run(&mut document, json!({ "op": "add_vertex_group", "name": "thick" }));
        let wall = json!({ "kind": "solidify", "thickness": 0.5, "group": "thick" });
        run(&mut document, json!({ "op": "add_modifier", "modifier": wall }));
        let volume = |document: &mut Document| {
            let scene = document.scene_to_render();
            let (_, asset) = scene.meshes().iter().next().expect("one");
            trigon_modelling::EditMesh::from_mesh(asset.mesh()).0.volume()
        };
        run(&mut document, json!({ "op": "leave_edit_mode" }));
        assert!((volume(&mut document) - 2.0).abs() < 1e-6, "4 m² times 0.5 m");
        run(&mut document, json!({ "op": "edit_objects" }));
        run(&mut document, json!({ "op": "select_all" }));
        run(&mut document, json!({ "op": "assign_to_vertex_group", "weight": 0.25 }));
        run(&mut document, json!({ "op": "leave_edit_mode" }));
        assert!((volume(&mut document) - 0.5).abs() < 1e-6, "a quarter, evaluated again");
    }
}
