//! Copying what is selected: a file of its own, which the command [`Paste`](crate::Paste) adds to a document.

use std::collections::{BTreeMap, BTreeSet};

use trigon_io::NativeDocument;
use trigon_modelling::EditMesh;
use trigon_scene::{MeshId, NodeId, Scene};

use super::Document;
use crate::command::transform_of;
use crate::document_file::DocumentFile;
use crate::error::EditError;

const COMMAND: &str = "copying";

impl Document {
    /// What is selected, as a GLB of its own: in object mode the selected objects with their meshes, materials, images
    /// and lights, children of each other as they are here; in edit mode the selected elements of each mesh as an
    /// object. All are placed as they are in the world. Animations are not copied.
    ///
    /// ```
    /// use trigon_document::{Command, Document, Paste};
    /// use trigon_scene::showcase;
    ///
    /// let mut document = Document::new(showcase());
    /// document.run(serde_json::from_str(r#"{ "op": "select_all" }"#)?)?;
    /// let bytes = document.copy()?;
    /// let mut other = Document::default();
    /// other.run(Paste { glb: bytes.into() }.into())?;
    /// assert_eq!(other.nodes().nodes().len(), document.nodes().nodes().len());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Nothing is selected, or it would take 4 GiB or more.
    pub fn copy(&self) -> Result<Vec<u8>, EditError> {
        let file =
            if self.selection().is_editing() { self.selected_elements()? } else { self.selected_objects()? };
        let native = file.to_native();
        let encoded = native.encode().map_err(|error| EditError::Copy(error.to_string()))?;
        Ok(encoded.to_bytes())
    }

    fn selected_objects(&self) -> Result<DocumentFile, EditError> {
        let scene = self.nodes();
        let objects = self.selection().objects.iter().copied();
        let objects: BTreeSet<NodeId> = objects.filter(|&id| scene.node(id).is_some()).collect();
        if objects.is_empty() {
            return Err(EditError::NothingSelected { command: COMMAND, needed: "at least one object" });
        }
        Ok(file(only(scene, &objects), self.state.file.edited.clone()))
    }

    fn selected_elements(&self) -> Result<DocumentFile, EditError> {
        let (mut objects, mut edited) = (BTreeSet::new(), BTreeMap::new());
        let kind = self.selection().kind();
        for (id, selection) in self.selection().meshes().filter(|(_, selection)| !selection.is_empty()) {
            let (Some(owner), Some(mesh)) = (self.state.owner(id), self.mesh(id)) else { continue };
            let (vertices, edges) = (selection.vertices(mesh, kind), selection.edges(mesh, kind));
            let part = mesh.extract(&vertices, &edges, &selection.faces(mesh, kind))?;
            objects.insert(owner);
            edited.insert(id, part);
        }
        if objects.is_empty() {
            let needed = "at least one vertex, edge or face";
            return Err(EditError::NothingSelected { command: COMMAND, needed });
        }
        let mut scene = only(self.nodes(), &objects);
        for (_, node) in scene.nodes_mut() {
            // Of an object that is a light, too, the elements alone are selected.
            (node.light, node.camera) = (None, None);
        }
        Ok(file(scene, edited))
    }
}

fn file(scene: Scene, edited: BTreeMap<MeshId, EditMesh>) -> DocumentFile {
    DocumentFile { native: NativeDocument::new(scene), edited }
}

/// A scene of these objects alone, each below the nearest of its ancestors that is one of them, or else placed as in
/// the world.
fn only(scene: &Scene, objects: &BTreeSet<NodeId>) -> Scene {
    let mut copy = scene.clone();
    copy.animations.clear();
    let in_order = scene.tree().into_iter().map(|(id, _)| id).filter(|id| objects.contains(id));
    for id in in_order {
        let parent = scene.ancestors(id).skip(1).find(|ancestor| objects.contains(ancestor));
        let is_same = scene.node(id).is_some_and(|node| node.parent() == parent);
        if !is_same {
            let outer = parent.map_or(Default::default(), |parent| scene.world_transform(parent));
            let local = outer.inverse() * scene.world_transform(id);
            copy.set_parent(id, parent).expect("an ancestor is no descendant");
            // Below an object that is scaled to zero there is no such placement: it keeps the one it has.
            if local.is_finite() {
                copy.node_mut(id).expect("it is there").transform = transform_of(local);
            }
        }
        let joints = scene.node(id).and_then(|node| node.skin).and_then(|skin| scene.skins.get(skin));
        if joints.is_some_and(|skin| !skin.joints.iter().all(|joint| objects.contains(joint))) {
            copy.node_mut(id).expect("it is there").skin = None;
        }
    }
    let others: Vec<NodeId> =
        scene.nodes().iter().map(|(id, _)| id).filter(|id| !objects.contains(id)).collect();
    for id in others {
        copy.remove(id);
    }
    copy
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::math::{DQuat, DVec3};
    use trigon_mesh::primitives;
    use trigon_scene::{
        Light, Material, MaterialTexture, Node, Texture, TextureBinding, TextureFormat, Transform,
    };

    use super::*;
    use crate::command::Paste;
    use crate::document::Event;
    use crate::tests::commands::{run, run_all};

    fn paste(document: &mut Document, bytes: Vec<u8>) {
        document.run(Paste { glb: bytes.into() }.into()).expect("it was copied");
    }

    /// An arm with a hand below an empty elbow, a lamp on the hand, and a textured material for both meshes.
    fn arm() -> (Document, [NodeId; 4]) {
        let mut scene = Scene::new();
        let turn = DQuat::from_rotation_y(0.5);
        let at = |x: f64| Transform::from_scale_rotation_translation(DVec3::splat(2.0), turn, DVec3::X * x);
        let arm = scene.add_object("arm", primitives::cube(1.0), Material::default());
        scene.node_mut(arm).expect("there").transform = at(1.0);
        let elbow = scene.add_child(arm, Node::default().with_transform(at(2.0)).with_name("elbow"));
        let elbow = elbow.expect("the arm is there");
        let texels = vec![[255, 0, 0, 255], [0, 255, 0, 255]];
        let texture = Texture::new(2, 1, texels, TextureFormat::Srgb).expect("two texels");
        let texture = scene.add_texture("stripes", texture);
        let skin = scene.node(arm).expect("there").materials[0];
        let binding = Some(TextureBinding::new(texture));
        scene.materials.get_mut(skin).expect("there").set_texture(MaterialTexture::BaseColor, binding);
        let mesh = scene.add_mesh("hand", primitives::uv_sphere(1.0, 8, 4));
        let hand = Node::from_mesh(mesh, skin).with_name("hand").with_transform(at(3.0));
        let hand = scene.add_child(elbow, hand).expect("the elbow is there");
        let lamp = Node::from_light(Light::point(5.0)).with_name("lamp").at(DVec3::Y);
        let lamp = scene.add_child(hand, lamp).expect("the hand is there");
        (Document::new(scene), [arm, elbow, hand, lamp])
    }

    fn named(document: &Document, name: &str) -> NodeId {
        let found = document.nodes().nodes().iter().find(|(_, node)| node.name == name);
        found.unwrap_or_else(|| panic!("{name} is not there")).0
    }

    #[test]
    fn objects_are_pasted_where_they_were_with_what_they_need_and_no_more() {
        let (mut document, [_, _, hand, lamp]) = arm();
        run(&mut document, json!({ "op": "edit_objects", "objects": ["hand"] }));
        run_all(&mut document, &[json!({ "op": "select_all" }), json!({ "op": "mark_seam" })]);
        run(&mut document, json!({ "op": "leave_edit_mode" }));
        run(&mut document, json!({ "op": "select", "objects": ["arm", "hand", "lamp"] }));
        let bytes = document.copy().expect("three are selected");
        let (materials, textures) = (document.nodes().materials.len(), document.nodes().textures.len());
        paste(&mut document, bytes.clone());
        let [arm2, hand2, lamp2] = ["arm.001", "hand.001", "lamp.001"].map(|name| named(&document, name));
        let scene = document.nodes();
        assert_eq!(document.selection().objects, [arm2, hand2, lamp2].into(), "all that was pasted");
        assert_eq!(scene.node(hand2).expect("there").parent(), Some(arm2), "the elbow was not copied");
        assert_eq!(scene.node(lamp2).expect("there").parent(), Some(hand2), "as before");
        for (was, is) in [(hand, hand2), (lamp, lamp2)] {
            let [was, is] = [was, is].map(|id| scene.world_transform(id));
            // Products and quotients of a few numbers below 40, and once to f32 in the file.
            assert!(was.abs_diff_eq(is, 1e-4), "{was:?} is at {is:?}");
        }
        assert_eq!(scene.node(lamp2).expect("there").light, scene.node(lamp).expect("there").light);
        assert_eq!((scene.materials.len(), scene.textures.len()), (materials, textures), "the same ones");
        assert_eq!(scene.node(hand2).expect("there").materials, scene.node(hand).expect("there").materials);
        let meshes = [hand, hand2].map(|id| scene.node(id).and_then(|node| node.mesh).expect("it has one"));
        let seams = meshes.map(|id| {
            let mesh = document.mesh(id).expect("with its marks");
            mesh.edges().filter(|&edge| mesh.is_seam(edge)).count()
        });
        assert!(seams[0] > 0 && seams[0] == seams[1], "{seams:?}");
        let mut other = Document::default();
        paste(&mut other, bytes);
        assert_eq!((other.nodes().materials.len(), other.nodes().textures.len()), (1, 1), "what they need");
        assert_eq!(other.nodes().nodes().len(), 3, "with free names");
        named(&other, "hand");
    }

    #[test]
    fn elements_join_the_mesh_that_is_edited_and_are_selected() {
        let (mut document, [arm, _, hand, _]) = arm();
        run(&mut document, json!({ "op": "edit_objects", "objects": ["hand"] }));
        run(&mut document, json!({ "op": "set_element_kind", "kind": "face" }));
        run(&mut document, json!({ "op": "select", "elements": [0, 1] }));
        let bytes = document.copy().expect("two faces");
        let hand_mesh = document.nodes().node(hand).and_then(|node| node.mesh).expect("it has one");
        let world = document.nodes().world_transform(hand);
        let mesh = document.mesh(hand_mesh).expect("edited");
        let face = mesh.faces().next().expect("there");
        let center = world.transform_point3(mesh.face_center(face));
        run_all(
            &mut document,
            &[
                json!({ "op": "leave_edit_mode" }),
                json!({ "op": "edit_objects", "objects": ["arm"] }),
                json!({ "op": "set_element_kind", "kind": "face" }),
            ],
        );
        let materials = document.nodes().node(arm).expect("there").materials.clone();
        paste(&mut document, bytes);
        let id = document.nodes().node(arm).and_then(|node| node.mesh).expect("it has one");
        let mesh = document.mesh(id).expect("edited");
        mesh.check_structure().expect("whole");
        assert_eq!(mesh.face_count(), 6 + 2, "a cube and two faces");
        let selected: Vec<u32> = document.selection().of(id).expect("edited").indices().collect();
        assert_eq!(selected, [6, 7], "the pasted ones");
        let found = mesh.face_center(trigon_modelling::FaceId::new(6));
        let found = document.nodes().world_transform(arm).transform_point3(found);
        // Positions of some 30 metres, rounded to f32 twice.
        assert!(found.abs_diff_eq(center, 1e-4), "{found} where it was, at {center}");
        assert_eq!(document.nodes().node(arm).expect("there").materials, materials, "no new slot");
        assert_eq!(document.nodes().nodes().len(), 4, "no new object");
        document.undo().expect("one entry");
        assert_eq!(document.mesh(id).expect("edited").face_count(), 6, "undone");
    }

    #[test]
    fn a_paste_is_in_the_history_and_in_recovery_files() {
        let (mut document, _) = arm();
        let mut again = Document::new(document.scene().clone());
        document.take_events();
        run(&mut document, json!({ "op": "select", "objects": ["lamp"] }));
        let bytes = document.copy().expect("one");
        let size = bytes.len();
        paste(&mut document, bytes);
        assert!(document.history().bytes() >= size, "its bytes count");
        let events = serde_json::to_string(&document.take_events()).expect("JSON");
        let events: Vec<Event> = serde_json::from_str(&events).expect("as written");
        again.replay(&events).expect("the same");
        let encode = |document: &Document| document.to_native().encode().expect("small").to_bytes();
        assert!(encode(&document) == encode(&again), "the same bytes");
        named(&again, "lamp.001");
    }

    #[test]
    fn nothing_and_no_glb_are_refused() {
        let mut document = Document::default();
        document.copy().expect_err("nothing is selected");
        for (glb, word) in [("bm8=", "clipboard"), ("!", "Base64")] {
            let json = json!({ "op": "paste", "glb": glb });
            let refused = match serde_json::from_value::<crate::Command>(json) {
                Ok(command) => document.run(command).expect_err("no GLB").to_string(),
                Err(error) => error.to_string(),
            };
            assert!(refused.contains(word), "{refused}");
        }
    }
}
