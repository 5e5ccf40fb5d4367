//! A scene into a document, part by part.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::json;
use trigon_math::DAffine3;
use trigon_mesh::EditData;
use trigon_scene::{Material, MaterialId, MeshAsset, MeshId, Node, NodeId, Scene, Skin, SkinId};

use super::draft::Draft;
use super::draft::GlbFile;
use super::freed::Replaced;
use super::materials::{plain, write_material};
use super::meshes::{Shape, Written, losses};
use super::movement::write_skin;
use super::nodes::{Choice, unchanged_copies};
use super::nodes::{camera, matrix, write_node};
use super::raw::RawObject;
use super::raw::RetainedFile;
use super::raw::draft_of;
use super::textures::Textures;
use crate::error::Location;
use crate::export::Loss;
use crate::gltf_source::GltfSource;
use crate::write::WriteError;

/// What is to be written.
pub(crate) struct Input<'a> {
    pub(crate) scene: &'a Scene,
    /// With it, the file is trigon's own: these meshes are being edited.
    pub(crate) edit_data: Option<&'a BTreeMap<MeshId, EditData>>,
    /// The file that the scene came from, if it is to be written back.
    pub(crate) retained: Option<&'a RetainedFile>,
    /// Where encoded images are.
    pub(crate) images: Option<&'a GltfSource>,
    /// Those to write; all unless given.
    pub(crate) nodes: Option<&'a [NodeId]>,
    /// A map of everything.
    pub(crate) root: Option<DAffine3>,
}

/// What came of it.
pub(crate) struct WrittenScene<'a> {
    pub(crate) file: GlbFile<'a>,
    pub(crate) losses: Vec<Loss>,
}

/// Writes a scene.
///
/// # Errors
/// The file would have more bytes than the format can count.
pub(crate) fn write_scene<'a>(input: &Input<'a>) -> Result<WrittenScene<'a>, WriteError> {
    let draft = input.retained.map_or_else(Draft::new, |retained| draft_of(&retained.source));
    let mut writer = SceneWriter {
        scene: input.scene,
        edit_data: input.edit_data,
        retained: input.retained,
        textures: Textures::new(input.scene, input.images, input.retained.is_some()),
        draft,
        choice: Choice::new(input.scene, input.nodes),
        copies: input.retained.map_or_else(BTreeMap::new, |retained| unchanged_copies(input.scene, retained)),
        indices: BTreeMap::new(),
        materials: BTreeMap::new(),
        stand_in: None,
        gone: None,
        losses: Vec::new(),
        replaced: Replaced::default(),
    };
    writer.number_nodes();
    let meshes = writer.write_meshes();
    let skins = writer.write_skins();
    writer.write_nodes(&meshes, &skins);
    writer.strip_removed();
    writer.write_animations();
    writer.write_roots(input.root);
    std::mem::take(&mut writer.replaced).free(&mut writer.draft);
    let SceneWriter { draft, losses, .. } = writer;
    Ok(WrittenScene { file: draft.finish()?, losses })
}

/// A mesh, and the material of each of its slots in the file.
type Use = (MeshId, Vec<Option<usize>>);

pub(super) struct SceneWriter<'a> {
    pub(super) scene: &'a Scene,
    edit_data: Option<&'a BTreeMap<MeshId, EditData>>,
    pub(super) retained: Option<&'a RetainedFile>,
    textures: Textures<'a>,
    pub(super) draft: Draft<'a>,
    choice: Choice,
    /// See [`unchanged_copies`].
    copies: BTreeMap<NodeId, Vec<NodeId>>,
    pub(super) indices: BTreeMap<NodeId, usize>,
    /// None for the format's default.
    materials: BTreeMap<MaterialId, Option<usize>>,
    /// The material of slots that have none.
    stand_in: Option<usize>,
    /// A node in place of joints that were removed.
    gone: Option<usize>,
    pub(super) losses: Vec<Loss>,
    replaced: Replaced,
}

impl<'a> SceneWriter<'a> {
    /// The nodes to write: those that copies of others need no place.
    fn nodes(&self) -> Vec<(NodeId, &'a Node)> {
        let copies: BTreeSet<NodeId> = self.copies.values().flatten().copied().collect();
        let is_written = |id: &NodeId| self.choice.has(*id) && !copies.contains(id);
        self.scene.nodes().iter().filter(|(id, _)| is_written(id)).collect()
    }

    /// The node as the file has it.
    fn loaded(&self, id: NodeId) -> Option<(usize, &'a Node)> {
        let retained = self.retained?;
        Some((retained.source.node(id)?, retained.scene.node(id)?))
    }

    fn number_nodes(&mut self) {
        for (id, _) in self.nodes() {
            let index = match self.loaded(id) {
                Some((index, _)) => index,
                None => self.draft.push("nodes", &RawObject::default()),
            };
            self.indices.insert(id, index);
        }
    }

    /// The index of a material; none for the format's default.
    fn material(&mut self, id: MaterialId) -> Option<usize> {
        if let Some(&known) = self.materials.get(&id) {
            return known;
        }
        let index = match self.scene.materials.get(id) {
            Some(now) => self.write_material(id, now),
            None => Some(self.stand_in()),
        };
        self.materials.insert(id, index);
        index
    }

    fn write_material(&mut self, id: MaterialId, now: &Material) -> Option<usize> {
        let loaded = self
            .retained
            .and_then(|retained| Some((retained.source.material(id), retained.scene.materials.get(id)?)));
        if let Some((index, was)) = loaded
            && was == now
        {
            return index;
        }
        let known = loaded.and_then(|(index, was)| Some((index?, was)));
        let mut object = known.map(|(index, _)| self.draft.object("materials", index)).unwrap_or_default();
        let fresh = plain();
        let was = known.map_or(&fresh, |(_, was)| was);
        write_material(&mut self.draft, &mut self.textures, &mut object, was, now);
        self.keep_empty_name(&mut object, &now.name);
        Some(match known {
            Some((index, _)) => {
                self.draft.update("materials", index, &object);
                index
            }
            None => self.draft.push("materials", &object),
        })
    }

    /// What has no name in a file gets one when it is read. In the editor's own file nothing changes by that.
    fn keep_empty_name(&self, object: &mut RawObject, name: &str) {
        if self.edit_data.is_some() && name.is_empty() && object.get("name").is_none() {
            object.set("name", name);
        }
    }

    fn stand_in(&mut self) -> usize {
        if let Some(known) = self.stand_in {
            return known;
        }
        let mut object = RawObject::default();
        write_material(&mut self.draft, &mut self.textures, &mut object, &plain(), &Material::default());
        *self.stand_in.insert(self.draft.push("materials", &object))
    }

    /// The meshes of the file that each node shows, and that all copies of a node show.
    fn write_meshes(&mut self) -> BTreeMap<NodeId, usize> {
        let mut users: BTreeMap<MeshId, Vec<(NodeId, &'a Node)>> = BTreeMap::new();
        let holders: Vec<(NodeId, NodeId)> =
            self.copies.iter().filter_map(|(&holder, copies)| Some((holder, *copies.first()?))).collect();
        let copies = holders.iter().filter_map(|&(holder, copy)| Some((holder, self.scene.node(copy)?)));
        let bare = &self.choice.bare;
        for (id, node) in self.nodes().into_iter().filter(|(id, _)| !bare.contains(id)).chain(copies) {
            if let Some(mesh) = node.mesh {
                users.entry(mesh).or_default().push((id, node));
            }
        }
        let mut found = BTreeMap::new();
        for (mesh, users) in users {
            self.write_mesh(mesh, &users, &mut found);
        }
        found
    }

    fn write_mesh(&mut self, id: MeshId, users: &[(NodeId, &'a Node)], found: &mut BTreeMap<NodeId, usize>) {
        let Some(asset) = self.scene.meshes().get(id) else { return };
        let edit_data = self.edit_data.and_then(|all| all.get(&id));
        let shape = Shape { mesh: asset.mesh(), edit_data };
        let origin = self.retained.and_then(|retained| retained.source.mesh(id));
        let object = self.mesh_object(id, asset, origin);
        let unchanged =
            origin.is_some() && self.retained.is_some_and(|retained| shape.is_unchanged(id, retained));
        let written = match unchanged {
            true => Some(Written::retained(object.clone())),
            false => self.write_shape(&object, origin, &shape),
        };
        let Some(written) = written else {
            self.lose(users, "its mesh, which has no vertices");
            return;
        };
        let materials = shape.mesh.attributes().face_materials.as_deref();
        let slots =
            materials.and_then(|materials| materials.iter().max()).map_or(1, |&last| last as usize + 1);
        let uses: Vec<Use> = users.iter().map(|(_, node)| (id, self.slot_materials(node, slots))).collect();
        let mut known: BTreeMap<&Use, usize> = BTreeMap::new();
        // Who shows the mesh as the file has it keeps it; else the first takes its place.
        let keeper = uses.iter().position(|(_, materials)| written.has_materials(materials)).unwrap_or(0);
        if let Some(index) = origin {
            known.insert(&uses[keeper], index);
            match unchanged && written.has_materials(&uses[keeper].1) {
                true => self.draft.update("meshes", index, &object),
                false => self.draft.set("meshes", index, &written.in_materials(&uses[keeper].1)),
            }
        }
        for ((node, _), of_node) in users.iter().zip(&uses) {
            let draft = &mut self.draft;
            let write = || draft.push("meshes", &written.in_materials(&of_node.1));
            found.insert(*node, *known.entry(of_node).or_insert_with(write));
        }
    }

    /// What the file says of a mesh, with its name.
    fn mesh_object(&self, id: MeshId, asset: &MeshAsset, origin: Option<usize>) -> RawObject {
        let mut object = origin.map(|index| self.draft.object("meshes", index)).unwrap_or_default();
        let was = self
            .retained
            .and_then(|retained| retained.scene.meshes().get(id))
            .map_or("", |asset| &asset.name);
        if asset.name != was {
            object.set_or_remove("name", Some(&asset.name).filter(|name| !name.is_empty()));
        }
        object
    }

    /// Writes the accessors of a mesh that is not in the file, or not as it is there.
    fn write_shape(
        &mut self,
        object: &RawObject,
        origin: Option<usize>,
        shape: &Shape<'_>,
    ) -> Option<Written> {
        if let Some(index) = origin {
            self.replaced.note(object);
            self.losses.extend(losses(object, index, shape.mesh));
        }
        Written::new(&mut self.draft, object.clone(), shape, self.edit_data.is_some())
    }

    fn lose(&mut self, users: &[(NodeId, &Node)], what: &str) {
        for (_, node) in users {
            let location = Location::Named(format!("node \"{}\"", node.name));
            self.losses.push(Loss { location, what: what.to_owned() });
        }
    }

    /// The material of each slot of a node's mesh.
    fn slot_materials(&mut self, node: &Node, slots: usize) -> Vec<Option<usize>> {
        /// More than any file has in use; what lies beyond is drawn in the format's default.
        const MOST_SLOTS: usize = 1 << 16;
        let mut materials: Vec<Option<usize>> = node.materials.iter().map(|&id| self.material(id)).collect();
        // A face may name any slot: those beyond the list are all the same.
        let slots = slots.min(MOST_SLOTS);
        if materials.len() < slots {
            let stand_in = Some(self.stand_in());
            materials.resize(slots, stand_in);
        }
        materials
    }

    fn write_skins(&mut self) -> BTreeMap<SkinId, usize> {
        let bare = &self.choice.bare;
        let used: BTreeSet<SkinId> = self
            .nodes()
            .iter()
            .filter(|(id, _)| !bare.contains(id))
            .filter_map(|(_, node)| node.skin)
            .collect();
        let mut skins = BTreeMap::new();
        for id in used {
            let Some(now) = self.scene.skins.get(id).filter(|skin| !skin.joints.is_empty()) else { continue };
            let loaded = self
                .retained
                .and_then(|retained| Some((retained.source.skin(id)?, retained.scene.skins.get(id)?)));
            if let Some((index, _)) = loaded.filter(|(_, was)| same_skin(was, now)) {
                skins.insert(id, index);
                continue;
            }
            if now.joints.iter().any(|joint| !self.indices.contains_key(joint)) {
                let name = json!({"name": "removed joint"});
                self.gone = self.gone.or_else(|| Some(self.draft.push("nodes", &name)));
            }
            let mut object = loaded.map(|(index, _)| self.draft.object("skins", index)).unwrap_or_default();
            let (indices, gone) = (&self.indices, self.gone.unwrap_or(0));
            let joint = |id| indices.get(&id).copied().unwrap_or(gone);
            write_skin(&mut self.draft, &mut object, now, joint);
            let index = match loaded {
                Some((index, _)) => {
                    self.draft.update("skins", index, &object);
                    index
                }
                None => self.draft.push("skins", &object),
            };
            skins.insert(id, index);
        }
        skins
    }

    fn write_nodes(&mut self, meshes: &BTreeMap<NodeId, usize>, skins: &BTreeMap<SkinId, usize>) {
        let channels = self.scene.animations.iter().flat_map(|animation| &animation.channels);
        let animated: BTreeSet<NodeId> = channels.map(|channel| channel.node).collect();
        let empty = Node::default();
        for (id, now) in self.nodes() {
            let index = self.indices[&id];
            let mut object = self.draft.object("nodes", index);
            let loaded = self.loaded(id).map(|(_, was)| was);
            let was = loaded.unwrap_or(&empty);
            let mut holder = Node::default();
            let now = if self.choice.bare.contains(&id) {
                (holder.name, holder.transform) = (now.name.clone(), now.transform);
                &holder
            } else {
                now
            };
            write_node(&mut self.draft, &mut object, was, now, animated.contains(&id));
            self.keep_empty_name(&mut object, &now.name);
            if now.camera != was.camera
                && now.camera.as_deref().is_some_and(|projection| camera(projection).is_none())
            {
                self.lose(&[(id, now)], "its camera, which is of a kind that glTF does not have");
            }
            let is_holder = self.copies.contains_key(&id);
            if !is_holder && object.object("extensions").get(INSTANCING).is_some() {
                self.dissolve(id, &mut object);
            }
            if now.mesh.is_some() || was.mesh.is_some() || is_holder {
                object.set_or_remove("mesh", meshes.get(&id));
            }
            if now.skin != was.skin {
                object.set_or_remove("skin", now.skin.and_then(|skin| skins.get(&skin)));
            }
            self.write_children(id, loaded, &mut object);
            self.draft.update("nodes", index, &object);
        }
    }

    /// Takes the extension off a node whose copies have become nodes of their own.
    fn dissolve(&self, id: NodeId, object: &mut RawObject) {
        let is_copy = |id: &NodeId| self.retained.is_some_and(|retained| retained.source.node(*id).is_none());
        let was = self.retained.and_then(|retained| retained.scene.node(id));
        if was.is_some_and(|was| was.children().iter().any(is_copy)) {
            let mut extensions = object.object("extensions");
            extensions.remove(INSTANCING);
            object.set_object("extensions", &extensions);
            object.remove("mesh");
        }
    }

    fn write_children(&self, id: NodeId, was: Option<&Node>, object: &mut RawObject) {
        let now = self.scene.node(id).map_or(&[][..], Node::children);
        let now: Vec<usize> = now.iter().filter_map(|child| self.indices.get(child).copied()).collect();
        let in_file = |child: &NodeId| self.retained.and_then(|retained| retained.source.node(*child));
        let was: Vec<usize> = was.map_or(&[][..], Node::children).iter().filter_map(in_file).collect();
        if was != now {
            object.set_or_remove("children", Some(&now).filter(|now| !now.is_empty()));
        }
    }

    /// What is left of nodes of the file that are not in the scene any more: a number, for those
    /// that refer to later ones.
    fn strip_removed(&mut self) {
        let Some(retained) = self.retained else { return };
        for (id, _) in retained.scene.nodes().iter() {
            let Some(index) = retained.source.node(id).filter(|_| self.scene.node(id).is_none()) else {
                continue;
            };
            let mut object = RawObject::default();
            if let Some(name) = self.draft.object("nodes", index).get("name") {
                object = RawObject::parse(&format!("{{\"name\":{name}}}"));
            }
            self.draft.set("nodes", index, &object);
        }
    }

    /// The scene and its roots.
    fn write_roots(&mut self, map: Option<DAffine3>) {
        let now: Vec<NodeId> = self.scene.roots().collect();
        let is_same = self.retained.is_some_and(|retained| retained.scene.roots().eq(now.iter().copied()));
        if is_same && self.gone.is_none() {
            return;
        }
        let mut list: Vec<usize> = now.iter().filter_map(|id| self.indices.get(id).copied()).collect();
        list.extend(self.gone);
        if let Some(map) = map.filter(|_| !list.is_empty()) {
            let root = json!({"name": "trigon", "matrix": matrix(&map), "children": list});
            list = vec![self.draft.push("nodes", &root)];
        }
        let list = Some(&list).filter(|list| !list.is_empty());
        match self.retained.and_then(|retained| retained.source.scene()) {
            Some(index) => {
                let mut scene = self.draft.object("scenes", index);
                scene.set_or_remove("nodes", list);
                self.draft.update("scenes", index, &scene);
            }
            None => {
                let mut scene = RawObject::default();
                scene.set_or_remove("nodes", list);
                let index = self.draft.push("scenes", &scene);
                self.draft.top.set("scene", &index);
            }
        }
    }
}

const INSTANCING: &str = "EXT_mesh_gpu_instancing";

fn same_skin(a: &Skin, b: &Skin) -> bool {
    (&a.name, &a.joints, &a.inverse_bind_matrices) == (&b.name, &b.joints, &b.inverse_bind_matrices)
}
