//! Ids: an index in a capture becomes the item of that index after reading. An id of a removed item
//! becomes one that finds nothing.

use trigon_scene::{
    Arena, Id, Material, MaterialId, MeshAsset, MeshId, Node, NodeId, Scene, Skin, SkinId, TextureAsset,
    TextureId,
};

use super::stored::Stored;
use super::stream::{Damage, Reader, Writer};

/// Stands for an item that was removed.
const GONE: u32 = u32::MAX;

/// The ids of one kind of item read so far, by their indices, and one that finds nothing.
pub(super) struct Table<T> {
    pub(super) ids: Vec<Id<T>>,
    pub(super) gone: Option<Id<T>>,
}

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self { ids: Vec::new(), gone: None }
    }
}

/// All ids that have been read.
#[derive(Default)]
pub(super) struct Ids {
    pub(super) textures: Table<TextureAsset>,
    pub(super) meshes: Table<MeshAsset>,
    pub(super) materials: Table<Material>,
    pub(super) skins: Table<Skin>,
    pub(super) nodes: Table<Node>,
}

macro_rules! id {
    ($($type:ty: $table:ident, $arena:expr;)+) => {$(
        impl Stored for $type {
            fn write(&self, to: &mut Writer<'_>) {
                let arena: fn(&Scene) -> &Arena<_> = $arena;
                let is_alive = arena(to.scene).get(*self).is_some();
                if is_alive { self.index() as u32 } else { GONE }.write(to);
            }

            fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
                let index = u32::read(from)?;
                let table = &from.ids.$table;
                let found = if index == GONE { table.gone } else { table.ids.get(index as usize).copied() };
                let what = stringify!($table);
                found.ok_or_else(|| Damage::malformed(format!("{what} has no item {index}")))
            }
        }
    )+};
}
id! {
    TextureId: textures, |scene| &scene.textures;
    MeshId: meshes, Scene::meshes;
    MaterialId: materials, |scene| &scene.materials;
    SkinId: skins, |scene| &scene.skins;
    NodeId: nodes, Scene::nodes;
}
