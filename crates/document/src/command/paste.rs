//! Adding what was copied: see [`Document::copy`](crate::Document::copy).

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::Path;
use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use trigon_io::{Format, LoadOptions, NativeDocument};
use trigon_mesh::Mesh;
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{EditMesh, Refusal};
use trigon_scene::{MaterialId, MaterialTexture, MeshId, NodeId, Scene, TextureAsset, TextureId};

use super::parts::Slots;
use super::space::inverse;
use super::{Action, Outcome};
use crate::document_file::DocumentFile;
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{Change, Names};

const COMMAND: &str = "pasting";

/// Adds what was copied. In object mode its objects, placed as they were, with free names; in edit mode the elements of
/// its meshes, which join the mesh of the active object, placed as they were in the world. What was added is selected.
/// Materials and images that the document has already are not added again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Paste {
    /// What was copied: a GLB that holds all its buffers and images, in Base64.
    pub glb: Glb,
}

/// The bytes of a GLB; text in Base64 (RFC 4648) in scripts. Clones share them.
#[derive(Clone, PartialEq, Eq)]
pub struct Glb(Arc<[u8]>);

impl Glb {
    /// The bytes.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }
}

impl From<Vec<u8>> for Glb {
    fn from(bytes: Vec<u8>) -> Self {
        Self(bytes.into())
    }
}

impl fmt::Debug for Glb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Glb({} bytes)", self.0.len())
    }
}

impl Serialize for Glb {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&STANDARD.encode(&self.0))
    }
}

impl<'de> Deserialize<'de> for Glb {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let bytes = STANDARD.decode(text).map_err(|error| D::Error::custom(format!("no Base64: {error}")))?;
        Ok(bytes.into())
    }
}

impl JsonSchema for Glb {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Glb".into()
    }

    fn inline_schema() -> bool {
        true
    }

    /// Without a type, so that no form offers the text for editing.
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "contentEncoding": "base64" })
    }
}

impl Action for Paste {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let name = Path::new("the clipboard");
        let options = LoadOptions { format: Some(Format::Glb), ..LoadOptions::default() };
        let loaded = NativeDocument::load_from_slice(name, self.glb.bytes(), &options);
        let (native, mut warnings) = loaded.map_err(|error| EditError::Import(error.to_string()))?;
        let copied = DocumentFile::open(native, name, &mut warnings);
        let outcome = match change.selection().is_editing() {
            true => paste_elements(change, copied)?,
            false => paste_objects(change, copied),
        };
        let reported = warnings.iter().map(ToString::to_string);
        Ok(Outcome { warnings: reported.chain(outcome.warnings).collect(), message: outcome.message })
    }

    fn bytes(&self) -> usize {
        self.glb.0.len()
    }
}

fn paste_objects(change: &mut Change<'_>, copied: DocumentFile) -> Outcome {
    let added = append(change, copied);
    let selection = change.selection_mut();
    selection.active = added.first().copied();
    let count = added.len();
    selection.objects = added.into_iter().collect();
    Outcome::counted("pasted", count, ["object", "objects"])
}

/// Adds the objects, with their edited meshes, free names, and materials that the document has already.
fn append(change: &mut Change<'_>, mut copied: DocumentFile) -> Vec<NodeId> {
    let known = Known::of(change.scene());
    let mut names = Names::of(change.scene());
    let scene = change.scene_mut();
    copied.native.scene.turn_to(scene.up);
    let added = scene.append(&copied.native.scene);
    known.use_for(scene, &added);
    let mut meshes: BTreeMap<MeshId, MeshId> = BTreeMap::new();
    for (&id, (_, old)) in added.iter().zip(copied.native.scene.nodes().iter()) {
        let node = scene.node_mut(id).expect("it was just added");
        node.name = names.take(&node.name);
        meshes.extend(old.mesh.zip(node.mesh));
    }
    for (old, edited) in copied.edited {
        if let Some(&id) = meshes.get(&old) {
            change.set_edited(id, edited);
        }
    }
    added
}

/// The materials and textures of a scene before something is added to it.
struct Known {
    materials: BTreeSet<MaterialId>,
    textures: BTreeSet<TextureId>,
}

impl Known {
    fn of(scene: &Scene) -> Self {
        Self {
            materials: scene.materials.iter().map(|(id, _)| id).collect(),
            textures: scene.textures.iter().map(|(id, _)| id).collect(),
        }
    }

    /// Lets added objects use these instead of equal ones that were added with them, which are removed.
    fn use_for(&self, scene: &mut Scene, added: &[NodeId]) {
        let is_new = |id: &TextureId| !self.textures.contains(id);
        let new: Vec<TextureId> = scene.textures.iter().map(|(id, _)| id).filter(is_new).collect();
        let mut textures = BTreeMap::new();
        for id in new {
            let asset = scene.textures.get(id).expect("it was just listed");
            let is_equal =
                |known: &&TextureId| scene.textures.get(**known).is_some_and(|one| is_same(one, asset));
            if let Some(&known) = self.textures.iter().find(is_equal) {
                textures.insert(id, known);
            }
        }
        let is_new = |id: &MaterialId| !self.materials.contains(id);
        let new: Vec<MaterialId> = scene.materials.iter().map(|(id, _)| id).filter(is_new).collect();
        let mut materials = BTreeMap::new();
        for id in new {
            let material = scene.materials.get_mut(id).expect("it was just listed");
            for slot in MaterialTexture::ALL {
                let binding = material.texture(slot);
                if let Some((known, binding)) =
                    binding.and_then(|old| Some((textures.get(&old.texture)?, old)))
                {
                    let texture = *known;
                    material.set_texture(slot, Some(trigon_scene::TextureBinding { texture, ..binding }));
                }
            }
            let material = material.clone();
            let is_equal = |known: &&MaterialId| scene.materials.get(**known) == Some(&material);
            if let Some(&known) = self.materials.iter().find(is_equal) {
                materials.insert(id, known);
                scene.materials.remove(id);
            }
        }
        textures.keys().for_each(|&id| drop(scene.textures.remove(id)));
        for &id in added {
            let node = scene.node_mut(id).expect("it was just added");
            let known = |id: &MaterialId| materials.get(id).copied().unwrap_or(*id);
            node.materials = node.materials.iter().map(known).collect();
        }
    }
}

fn is_same(one: &TextureAsset, other: &TextureAsset) -> bool {
    let (name, one, other) = (one.name == other.name, &one.texture, &other.texture);
    let size = |texture: &trigon_scene::Texture| (texture.width(), texture.height());
    name && size(one) == size(other) && one.format() == other.format() && one.texels().eq(other.texels())
}

/// A mesh that was copied, and the index of its object among those that were.
struct Pasted {
    mesh: EditMesh,
    object: usize,
}

/// Joins all meshes to the active object's.
fn paste_elements(change: &mut Change<'_>, copied: DocumentFile) -> Result<Outcome, EditError> {
    let into = edited_mesh(change)?;
    let object = change.state().owner(into).ok_or(EditError::NotEditing(COMMAND))?;
    let from_world = inverse(change.scene().world_transform(object), COMMAND)?;
    let meshes = meshes_of(&copied);
    if meshes.is_empty() {
        let reason = "what was copied has no mesh: leave edit mode to paste objects";
        return Err(Refusal::NotPossible { operation: COMMAND, reason }.into());
    }
    let added = append(change, copied);
    let mut slots = Slots::of_active(change, object, into)?;
    let mut vertices = Vec::new();
    for Pasted { mut mesh, object: index } in meshes {
        let id = added[index];
        let materials = change.scene().node(id).map(|node| node.materials.clone()).unwrap_or_default();
        slots.assign(change.scene_mut(), &mut mesh, &materials);
        let transform = from_world * change.scene().world_transform(id);
        vertices.extend(change.edit(into, |edited| Ok(edited.join_mesh(&mesh, &transform)?))?.vertices);
    }
    let scene = change.scene_mut();
    for id in added {
        scene.remove(id);
    }
    scene.node_mut(object).expect("it shows the mesh").materials = slots.materials;
    let count = vertices.len();
    select(change, into, vertices);
    Ok(Outcome::counted("pasted", count, ["vertex", "vertices"]))
}

/// Adds a mesh to the active object's while that is edited, in its first material slot, at a point of the world and along
/// the world's axes. What was added is selected.
pub(super) fn add_to_edited(
    change: &mut Change<'_>,
    mesh: &Mesh,
    position: DVec3,
) -> Result<Outcome, EditError> {
    let into = edited_mesh(change)?;
    let object = change.state().owner(into).ok_or(EditError::NotEditing(COMMAND))?;
    let from_world = inverse(change.scene().world_transform(object), COMMAND)?;
    let transform = from_world * DAffine3::from_translation(position);
    let (added, _) = EditMesh::from_mesh(mesh);
    let joined = change.edit(into, |edited| Ok(edited.join_mesh(&added, &transform)?))?;
    let count = joined.vertices.len();
    select(change, into, joined.vertices);
    Ok(Outcome::counted("added", count, ["vertex", "vertices"]))
}

/// The mesh of the active object if it is edited, or the first edited one.
fn edited_mesh(change: &Change<'_>) -> Result<MeshId, EditError> {
    let active = change.selection().active.and_then(|id| change.scene().node(id)?.mesh);
    let active = active.filter(|&id| change.selection().of(id).is_some());
    let first = change.selection().meshes().map(|(id, _)| id).next();
    active.or(first).ok_or(EditError::NotEditing(COMMAND))
}

/// The meshes of all objects that were copied.
fn meshes_of(copied: &DocumentFile) -> Vec<Pasted> {
    let scene = &copied.native.scene;
    let of = |(object, (_, node)): (usize, (NodeId, &trigon_scene::Node))| {
        let id = node.mesh?;
        let edited = copied.edited.get(&id).cloned();
        let mesh = edited.or_else(|| Some(EditMesh::from_mesh(scene.meshes().get(id)?.mesh()).0))?;
        Some(Pasted { mesh, object })
    };
    scene.nodes().iter().enumerate().filter_map(of).collect()
}

/// Selects these vertices of a mesh, and nothing else.
fn select(change: &mut Change<'_>, id: MeshId, vertices: Vec<trigon_modelling::VertexId>) {
    let kind = change.selection().kind();
    let all: Vec<MeshId> = change.selection().meshes().map(|(id, _)| id).collect();
    let (selection, meshes) = change.selection_and_meshes();
    for other in all {
        selection.of_mut(other).expect("it was just listed").clear();
    }
    if let (Some(selection), Some(mesh)) = (selection.of_mut(id), meshes.get(&id)) {
        selection.select(mesh, kind, &Elements::Vertices(vertices));
    }
}
