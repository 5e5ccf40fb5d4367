//! Cuts along what crosses faces, and along outlines of other objects.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{EditMesh, IntersectWith, KnifeProjection};
use trigon_scene::NodeId;

use super::cut::cut_outcome;
use super::space::TransformSpace;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

const PROJECTING: &str = "projecting an outline";
const FACES: &str = "at least one selected face";

/// Cuts the selected faces of each mesh along the lines in which they cross others, and those, too; selects the new
/// edges. Nothing is removed or joined.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct IntersectFaces {
    /// Whether they are intersected with all other faces of their mesh that are not hidden (`others`), or with each
    /// other (`themselves`).
    pub with: IntersectWith,
}

impl Action for IntersectFaces {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let (mut faces, mut uncut) = (0, 0);
        change.edit_selected("intersecting faces", FACES, |mesh, selection| {
            let cut = mesh.intersect_faces(&selection.faces(mesh, kind), self.with)?;
            faces += cut.faces.len();
            uncut += cut.uncut;
            Ok(AfterEdit::Select(Elements::Edges(cut.edges)))
        })?;
        Ok(cut_outcome(faces, uncut))
    }
}

/// Cuts the selected faces along the outlines of other objects, seen in a direction; selects the new edges.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct KnifeProject {
    /// The objects whose outlines are projected. Default: the other selected objects that have meshes.
    pub objects: Vec<ObjectName>,
    /// The direction in world space; its length does not matter. Default: from above.
    pub direction: [f64; 3],
    /// Whether faces that others hide in this direction are cut, too.
    pub cut_through: bool,
}

impl Default for KnifeProject {
    fn default() -> Self {
        Self { objects: Vec::new(), direction: [0.0, -1.0, 0.0], cut_through: false }
    }
}

/// An object whose outline is projected.
struct OutlineObject {
    mesh: EditMesh,
    to_world: DAffine3,
}

impl KnifeProject {
    /// The named objects, or the selected ones that are not edited.
    fn tools(&self, change: &mut Change<'_>) -> Result<Vec<OutlineObject>, EditError> {
        let named: Vec<NodeId> = if self.objects.is_empty() {
            change.selection().objects.iter().copied().collect()
        } else {
            self.objects.iter().map(|name| name.find(change.scene())).collect::<Result<_, _>>()?
        };
        let mut tools = Vec::new();
        for object in named {
            let mesh = change.scene().node(object).and_then(|node| node.mesh);
            let edited = |id| change.selection().meshes().any(|(edited, _)| edited == id);
            let Some(id) = mesh.filter(|&id| !edited(id)) else { continue };
            let to_world = change.scene().world_transform(object);
            // Only read: a mesh that was never edited stays so in the saved file.
            let edited = change.selection_and_meshes().1.get(&id).cloned();
            let stored = || change.scene().meshes().get(id).map(|asset| EditMesh::from_mesh(asset.mesh()).0);
            tools.extend(edited.or_else(stored).map(|mesh| OutlineObject { mesh, to_world }));
        }
        if tools.is_empty() {
            let needed = "another object with a mesh, selected or named";
            return Err(EditError::NothingSelected { command: PROJECTING, needed });
        }
        Ok(tools)
    }
}

impl Action for KnifeProject {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let into_meshes = TransformSpace::World.into_meshes(PROJECTING, change)?;
        let tools = self.tools(change)?;
        let kind = change.selection().kind();
        let (mut faces, mut uncut) = (0, 0);
        change.edit_selected_meshes(PROJECTING, FACES, |id, mesh, selection| {
            let from_world = into_meshes.get(&id).copied().unwrap_or_default();
            let mut edges = Vec::new();
            let mut given = selection.faces(mesh, kind);
            for tool in &tools {
                let projection = KnifeProjection {
                    transform: from_world * tool.to_world,
                    direction: from_world.transform_vector3(DVec3::from(self.direction)),
                    cut_through: self.cut_through,
                };
                let cut = mesh.knife_project(&given, &tool.mesh, &projection)?;
                faces += cut.faces.len();
                uncut += cut.uncut;
                edges.extend(cut.edges);
                given.extend(cut.faces);
            }
            edges.retain(|&edge| mesh.has_edge(edge));
            Ok(AfterEdit::Select(Elements::Edges(edges)))
        })?;
        Ok(cut_outcome(faces, uncut))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene, Transform};

    use super::*;
    use crate::document::Document;
    use crate::tests::commands::{run, try_run};

    fn editing(scene: Scene, faces: &[u32]) -> Document {
        let mut document = Document::new(scene);
        run(&mut document, json!({ "op": "edit_objects", "objects": ["object"] }));
        run(&mut document, json!({ "op": "set_element_kind", "kind": "face" }));
        run(&mut document, json!({ "op": "select", "elements": faces }));
        document
    }

    fn bytes(document: &Document) -> Vec<u8> {
        document.to_native().encode().expect("it can be").to_bytes()
    }

    #[test]
    fn crossing_parts_of_a_mesh_are_cut_and_it_is_undone() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let other = mesh.clone();
        mesh.join_mesh(&other, &DAffine3::from_translation(DVec3::ONE)).expect("room");
        let mut scene = Scene::new();
        scene.add_object("object", mesh.to_mesh().0, Material::default());
        let mut document = editing(scene, &[0, 1, 2, 3, 4, 5]);
        let before = bytes(&document);
        let outcome = try_run(&mut document, json!({ "op": "intersect_faces" })).expect("they cross");
        assert_eq!((outcome.message.as_str(), outcome.warnings.len()), ("made 6 faces", 0));
        document.undo().expect("one");
        assert!(bytes(&document) == before, "undone");
        let refused = try_run(&mut document, json!({ "op": "intersect_faces", "with": "themselves" }));
        assert!(refused.expect_err("they do not").to_string().contains("no face crosses"));
    }

    #[test]
    fn outlines_of_other_objects_are_projected_and_what_ends_within_a_face_is_reported() {
        let mut scene = Scene::new();
        scene.add_object("object", primitives::cube(2.0), Material::default());
        let sheet = scene.add_object("sheet", primitives::plane(1.0, 1.0), Material::default());
        let above = Transform::from_translation(DVec3::new(0.0, 3.0, 0.0));
        scene.node_mut(sheet).expect("it was added").transform = above;
        let mut document = editing(scene, &[0, 1, 2, 3, 4, 5]);
        let refused = try_run(&mut document, json!({ "op": "knife_project" })).expect_err("nothing is named");
        assert!(refused.to_string().contains("another object"), "{refused}");
        let before = bytes(&document);
        for (cut_through, message) in [(false, "made 2 faces"), (true, "made 4 faces")] {
            let command = json!({ "op": "knife_project", "objects": ["sheet"], "cut_through": cut_through });
            let outcome = try_run(&mut document, command).expect("it is above");
            assert_eq!((outcome.message.as_str(), outcome.warnings.len()), (message, 0));
            document.undo().expect("one");
            assert!(bytes(&document) == before, "undone");
        }
        let at = |edge: u32| json!({ "at": "edge", "edge": edge, "position": 0.5 });
        let (id, _) = document.selection().meshes().next().expect("it is edited");
        let mesh = document.mesh(id).expect("it is there");
        let face = mesh.faces().next().expect("six");
        let edges: Vec<u32> = mesh.face_edges(face).map(|edge| edge.index()).collect();
        let corners = mesh.face_vertices(face).map(|vertex| mesh.position(vertex));
        let center = (corners.sum::<trigon_mesh::math::Vec3>() / 4.0).to_array();
        let inside = json!({ "at": "face", "face": face.index(), "position": center });
        let strokes = json!([[at(edges[0]), at(edges[1])], [at(edges[2]), inside]]);
        let outcome = try_run(&mut document, json!({ "op": "knife", "strokes": strokes })).expect("one cuts");
        assert_eq!(outcome.message, "made 1 face");
        assert!(
            outcome.warnings.len() == 1 && outcome.warnings[0].contains("1 piece"),
            "{:?}",
            outcome.warnings
        );
    }
}
