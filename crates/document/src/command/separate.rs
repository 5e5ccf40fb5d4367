//! Separating parts of meshes into objects of their own.

use fixedbitset::FixedBitSet;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{EditMesh, FaceId, Refusal, VertexId};
use trigon_scene::{MaterialId, MeshId, NodeId};

use super::action::whole_meshes;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::{AfterEdit, Change};

const COMMAND: &str = "separating";

/// Which parts of a mesh become objects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SeparateBy {
    /// In edit mode: the selected faces of each mesh.
    #[default]
    Selection,
    /// Each part that is connected by edges. The part with the first vertex stays.
    LooseParts,
    /// The faces of each material slot. Those of the first slot in use stay, with everything that has no face.
    Material,
}

/// Makes parts of meshes separate objects in the same place. By loose parts and by material it works on the whole of
/// the meshes that are edited, or on those of the selected objects; in object mode the new objects are then selected,
/// too.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Separate {
    /// Which parts.
    pub by: SeparateBy,
}

impl Action for Separate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if self.by == SeparateBy::Selection {
            return separate_selection(change);
        }
        let mut made = Vec::new();
        for id in whole_meshes(change, COMMAND)? {
            let Some(mesh) = change.mesh(id) else { continue };
            match self.by {
                SeparateBy::Material => made.extend(separate_materials(change, id)?),
                SeparateBy::Selection | SeparateBy::LooseParts => {
                    let parts = loose_parts(mesh);
                    made.extend(separate_parts(change, id, parts)?);
                }
            }
        }
        if made.is_empty() {
            let reason = match self.by {
                SeparateBy::Material => "all faces have the same material",
                SeparateBy::Selection | SeparateBy::LooseParts => "everything is connected",
            };
            return Err(Refusal::NotPossible { operation: COMMAND, reason }.into());
        }
        let count = made.len();
        if !change.selection().is_editing() {
            change.selection_mut().objects.extend(made);
        }
        Ok(Outcome::counted("made", count, ["object", "objects"]))
    }
}

fn separate_selection(change: &mut Change<'_>) -> Result<Outcome, EditError> {
    let kind = change.selection().kind();
    let mut parts = Vec::new();
    change.edit_selected_meshes(COMMAND, "at least one selected face", |id, mesh, selection| {
        parts.push((id, mesh.separate(&selection.faces(mesh, kind))?));
        Ok(AfterEdit::Clear)
    })?;
    let count = parts.len();
    for (mesh, part) in parts {
        change.add_part(mesh, part);
    }
    Ok(Outcome::counted("made", count, ["object", "objects"]))
}

/// More objects than that are no use to anybody, and would fill the memory with their nodes.
const MOST_PARTS: usize = 10_000;

fn check_count(count: usize) -> Result<(), EditError> {
    if count > MOST_PARTS {
        let reason =
            "there would be more than 10000 objects: select what belongs together, and separate that";
        return Err(Refusal::NotPossible { operation: COMMAND, reason }.into());
    }
    Ok(())
}

/// The vertices of each part that is connected by edges; the part with the first vertex first.
fn loose_parts(mesh: &EditMesh) -> Vec<Vec<VertexId>> {
    let mut visited = FixedBitSet::with_capacity(mesh.vertex_capacity());
    let mut parts = Vec::new();
    for start in mesh.vertices() {
        if visited.put(start.index() as usize) {
            continue;
        }
        let mut part = vec![start];
        let mut next = 0;
        while let Some(&vertex) = part.get(next) {
            next += 1;
            for edge in mesh.vertex_edges(vertex) {
                let ends = mesh.edge_vertices(edge);
                part.extend(ends.into_iter().filter(|end| !visited.put(end.index() as usize)));
            }
        }
        parts.push(part);
    }
    parts
}

/// Makes all parts but the first objects.
fn separate_parts(
    change: &mut Change<'_>,
    id: MeshId,
    parts: Vec<Vec<VertexId>>,
) -> Result<Vec<NodeId>, EditError> {
    check_count(parts.len())?;
    let others = parts.get(1..).unwrap_or_default();
    if others.is_empty() {
        return Ok(Vec::new());
    }
    let extracted = change.edit(id, |mesh| {
        let mut extracted = Vec::new();
        for part in others {
            let edges: Vec<_> = part.iter().flat_map(|&vertex| mesh.vertex_edges(vertex)).collect();
            let faces: Vec<_> = part.iter().flat_map(|&vertex| mesh.vertex_faces(vertex)).collect();
            extracted.push(mesh.extract(part, &edges, &faces)?);
        }
        for part in others {
            mesh.delete_vertices(part)?;
        }
        Ok(extracted)
    })?;
    Ok(extracted.into_iter().map(|part| change.add_part(id, part)).collect())
}

/// The faces of a material slot.
struct OfSlot {
    slot: u32,
    faces: Vec<FaceId>,
}

/// The slots in use, in their order.
fn slots_in_use(mesh: &EditMesh) -> Vec<OfSlot> {
    let mut faces: Vec<FaceId> = mesh.faces().collect();
    faces.sort_by_key(|&face| mesh.material(face));
    let groups = faces.chunk_by(|&one, &next| mesh.material(one) == mesh.material(next));
    groups.map(|faces| OfSlot { slot: mesh.material(faces[0]), faces: faces.to_vec() }).collect()
}

/// Makes the faces of all slots but the first objects, each with its material alone.
fn separate_materials(change: &mut Change<'_>, id: MeshId) -> Result<Vec<NodeId>, EditError> {
    let Some(mesh) = change.mesh(id) else { return Ok(Vec::new()) };
    let slots = slots_in_use(mesh);
    check_count(slots.len())?;
    let Some((first, others)) = slots.split_first().filter(|(_, others)| !others.is_empty()) else {
        return Ok(Vec::new());
    };
    let owner = change.state().owner(id);
    let materials = owner.and_then(|owner| change.scene().node(owner)).map(|node| node.materials.clone());
    let materials = materials.unwrap_or_default();
    let parts = change.edit(id, |mesh| {
        let mut parts = Vec::new();
        for other in others {
            let mut part = mesh.separate(&other.faces)?;
            use_first_slot(&mut part);
            parts.push((other.slot, part));
        }
        Ok(parts)
    })?;
    let mut made = Vec::new();
    for (slot, part) in parts {
        let object = change.add_part(id, part);
        keep_material(change, object, &materials, slot);
        made.push(object);
    }
    let is_shared = change.scene().nodes().iter().filter(|(_, node)| node.mesh == Some(id)).count() > 1;
    if let Some(owner) = owner.filter(|_| !is_shared) {
        change.edit(id, |mesh| {
            use_first_slot(mesh);
            Ok(())
        })?;
        keep_material(change, owner, &materials, first.slot);
    }
    Ok(made)
}

fn use_first_slot(mesh: &mut EditMesh) {
    let faces: Vec<FaceId> = mesh.faces().filter(|&face| mesh.material(face) != 0).collect();
    faces.into_iter().for_each(|face| mesh.set_material(face, 0));
}

/// Gives an object the material of one slot alone; none if the slot had none.
fn keep_material(change: &mut Change<'_>, object: NodeId, materials: &[MaterialId], slot: u32) {
    let retained = materials.get(slot as usize).copied();
    let node = change.scene_mut().node_mut(object).expect("it is the mesh's object");
    node.materials = retained.into_iter().collect();
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::math::{DAffine3, DVec3, Vec3};
    use trigon_mesh::{MeshBuilder, primitives};
    use trigon_scene::{Material, Scene};

    use super::*;
    use crate::document::Document;
    use crate::tests::commands::{run, run_all, try_run};

    /// One object of several cubes, a loose edge and a loose vertex.
    fn crumbs(cubes: usize) -> Document {
        let mut mesh = EditMesh::new();
        let cube = EditMesh::from_mesh(&primitives::cube(1.0)).0;
        for index in 0..cubes {
            let away = DAffine3::from_translation(DVec3::X * (index as f64 * 4.0));
            let added = mesh.join_mesh(&cube, &away).expect("room");
            added.faces.into_iter().for_each(|face| mesh.set_material(face, index as u32 % 3));
        }
        let mut builder = MeshBuilder::new();
        for x in [0.0, 1.0, 2.0] {
            builder.push_vertex(Vec3::new(x, 9.0, 0.0));
        }
        builder.push_loose_edge(0, 1).expect("two vertices");
        mesh.join_mesh(&EditMesh::from_mesh(&builder.build()).0, &DAffine3::IDENTITY).expect("room");
        let mut scene = Scene::new();
        let id = scene.add_object("crumb", mesh.to_mesh().0, Material::default().with_name("a"));
        let other = scene.add_material(Material::default().with_name("b"));
        let node = scene.node_mut(id).expect("just added");
        node.materials.push(other);
        node.transform.set_translation(DVec3::Y);
        let mut document = Document::new(scene);
        run(&mut document, json!({ "op": "select_all" }));
        document
    }

    /// Name, vertices, edges, faces and materials of all objects.
    fn listed(document: &Document) -> Vec<(String, [usize; 3], Vec<String>)> {
        let scene = document.nodes();
        let describe = |(id, node): (NodeId, &trigon_scene::Node)| {
            assert_eq!(scene.world_transform(id).translation, DVec3::Y, "all are where they were");
            let mesh = document.mesh(node.mesh.expect("all have one")).expect("all were edited");
            mesh.check_structure().expect("whole");
            let material = |id| scene.materials.get(id).expect("it is there").name.clone();
            let materials = node.materials.iter().map(|&id| material(id)).collect();
            (node.name.clone(), [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()], materials)
        };
        scene.nodes().iter().map(describe).collect()
    }

    #[test]
    fn each_loose_part_becomes_an_object_in_either_mode() {
        for is_editing in [false, true] {
            let mut document = crumbs(2);
            let before = listed_before(&mut document, is_editing);
            run(&mut document, json!({ "op": "separate", "by": "loose_parts" }));
            let both = || vec!["a".to_owned(), "b".to_owned()];
            let expected = [
                ("crumb", [8, 12, 6]),
                ("crumb.001", [8, 12, 6]),
                ("crumb.002", [2, 1, 0]),
                ("crumb.003", [1, 0, 0]),
            ];
            let expected = expected.map(|(name, counts)| (name.to_owned(), counts, both()));
            assert_eq!(listed(&document), expected, "editing: {is_editing}");
            let selected = if is_editing { 1 } else { 4 };
            assert_eq!(document.selection().objects.len(), selected, "all parts, in object mode");
            document.undo().expect("one entry");
            assert_eq!(document.scene().nodes().len(), before, "undone");
            document.redo().expect("it was undone");
            assert_eq!(listed(&document), expected, "done again");
        }
    }

    fn listed_before(document: &mut Document, is_editing: bool) -> usize {
        if is_editing {
            run(document, json!({ "op": "edit_objects" }));
        }
        document.scene().nodes().len()
    }

    #[test]
    fn each_material_becomes_an_object_with_that_material_alone() {
        let mut document = crumbs(3);
        run(&mut document, json!({ "op": "separate", "by": "material" }));
        let named = |name: &str| name.to_owned();
        let expected = [
            // With the loose edge and the loose vertex.
            (named("crumb"), [11, 13, 6], vec![named("a")]),
            (named("crumb.001"), [8, 12, 6], vec![named("b")]),
            // The third slot has no material.
            (named("crumb.002"), [8, 12, 6], vec![]),
        ];
        assert_eq!(listed(&document), expected);
        let slots = document.nodes().nodes().iter().map(|(_, node)| {
            let mesh = document.mesh(node.mesh.expect("all have one")).expect("edited");
            mesh.faces().map(|face| mesh.material(face)).max()
        });
        assert_eq!(slots.collect::<Vec<_>>(), [Some(0); 3], "each uses its only slot");
    }

    #[test]
    fn what_has_one_part_and_one_material_is_refused() {
        let mut document = Document::default();
        run(&mut document, json!({ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } }));
        for by in ["loose_parts", "material"] {
            let refused = try_run(&mut document, json!({ "op": "separate", "by": by }));
            assert!(refused.expect_err("nothing to do").to_string().contains("separating"), "{by}");
        }
        run_all(&mut document, &[json!({ "op": "select_none" })]);
        try_run(&mut document, json!({ "op": "separate", "by": "material" })).expect_err("nothing selected");
    }
}
