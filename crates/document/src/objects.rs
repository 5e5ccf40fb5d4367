//! Other objects that modifiers of a mesh use, found in the scene by their names.

use std::borrow::Cow;
use std::collections::BTreeMap;

use trigon_mesh::math::DAffine3;
use trigon_modelling::{EditMesh, Modifier, ModifierObjects, ObjectState};
use trigon_scene::{MeshId, Node, NodeId, Scene};

/// The objects of a scene, as seen from a mesh of it.
pub(crate) struct SceneObjects<'s> {
    scene: &'s Scene,
    edited: &'s BTreeMap<MeshId, EditMesh>,
    /// Of edited meshes; none where only one evaluation is made.
    revisions: Option<&'s BTreeMap<MeshId, u64>>,
    /// The mesh with the modifiers.
    mesh: MeshId,
}

impl<'s> SceneObjects<'s> {
    pub(crate) fn new(
        scene: &'s Scene,
        edited: &'s BTreeMap<MeshId, EditMesh>,
        revisions: Option<&'s BTreeMap<MeshId, u64>>,
        mesh: MeshId,
    ) -> Self {
        Self { scene, edited, revisions, mesh }
    }

    /// The first object of a name that does not show the mesh with the modifiers, and its mesh.
    fn find(&self, name: &str) -> Option<(NodeId, Option<MeshId>)> {
        let is_other = |(_, node): &(NodeId, &Node)| node.name == name && node.mesh != Some(self.mesh);
        self.scene.nodes().iter().find(is_other).map(|(id, node)| (id, node.mesh))
    }

    /// The map from the mesh with the modifiers into the world: that of the first object that shows it.
    fn world_transform(&self) -> DAffine3 {
        let shows = |id: &NodeId| self.scene.node(*id).is_some_and(|node| node.mesh == Some(self.mesh));
        let owner = self.scene.nodes().iter().map(|(id, _)| id).find(shows);
        owner.map_or(DAffine3::IDENTITY, |id| self.scene.world_transform(id))
    }
}

impl ModifierObjects for SceneObjects<'_> {
    fn state(&self, name: &str) -> Option<ObjectState> {
        let (object, mesh) = self.find(name)?;
        let revision = self.revisions.zip(mesh).and_then(|(revisions, mesh)| revisions.get(&mesh));
        let transform = self.world_transform().inverse() * self.scene.world_transform(object);
        Some(ObjectState { revision: revision.copied().unwrap_or(0), transform })
    }

    fn mesh(&self, name: &str) -> Option<Cow<'_, EditMesh>> {
        let id = self.find(name)?.1?;
        if let Some(mesh) = self.edited.get(&id) {
            return Some(Cow::Borrowed(mesh));
        }
        let asset = self.scene.meshes().get(id)?;
        Some(Cow::Owned(EditMesh::from_mesh(asset.mesh()).0))
    }
}

/// A copy of the object that a modifier uses, if it uses one: what stays while the mesh with the modifier changes.
#[derive(Debug, Default)]
pub(crate) struct UsedObject(Option<(ObjectState, Option<EditMesh>)>);

impl UsedObject {
    pub(crate) fn of(objects: &dyn ModifierObjects, modifier: &Modifier) -> Self {
        let used = |name| Some((objects.state(name)?, objects.mesh(name).map(Cow::into_owned)));
        Self(modifier.object().and_then(used))
    }
}

impl ModifierObjects for UsedObject {
    fn state(&self, _: &str) -> Option<ObjectState> {
        self.0.as_ref().map(|(state, _)| *state)
    }

    fn mesh(&self, _: &str) -> Option<Cow<'_, EditMesh>> {
        self.0.as_ref()?.1.as_ref().map(Cow::Borrowed)
    }
}
