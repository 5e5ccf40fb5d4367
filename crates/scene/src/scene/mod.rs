//! The scene: a forest of nodes that share meshes, materials and textures.

mod append;
mod order;
mod placed;
mod pose;

use std::sync::Arc;

use thiserror::Error;
use trigon_camera::{Camera, Projection, UpAxis};
use trigon_math::{Bounds3, DAffine3, DMat3, DQuat, DVec3};
use trigon_mesh::{ChangeError, Mesh, MeshChange};
use trigon_raster::Texture;

use crate::animation::Animation;
use crate::arena::Arena;
use crate::light::CachedReading;
use crate::material::{Material, MaterialId};
use crate::mesh_asset::{MeshAsset, MeshId};
use crate::node::{Node, NodeId, Skin};
use crate::texture_asset::{TextureAsset, TextureId};
pub use append::SceneParts;
pub(crate) use placed::PlacedMesh;
pub use pose::{NodePose, Pose, SkinPose};

/// The placement of a node in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct NodePlacement {
    pub(crate) world: DAffine3,
    /// Whether an odd number of the transforms from the root mirror. The determinant of a nearly
    /// flat product would be dominated by rounding.
    pub(crate) is_mirrored: bool,
}

/// A change that a scene cannot make.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneError {
    /// The node was removed, or belongs to another scene.
    #[error("node {0:?} is not in this scene; it was removed, or belongs to another scene")]
    NoSuchNode(NodeId),
    /// A node cannot become its own descendant.
    #[error(
        "node {parent:?} cannot become the parent of {child:?}, because it is its descendant; detach {parent:?} first"
    )]
    Cycle {
        /// The node to move.
        child: NodeId,
        /// The new parent.
        parent: NodeId,
    },
    /// The mesh was removed, or belongs to another scene.
    #[error("mesh {0:?} is not in the scene; it belongs to another one")]
    NoSuchMesh(MeshId),
    /// The mesh lacks an element that was to be changed.
    #[error(transparent)]
    Change(#[from] ChangeError),
}

/// Everything that can be drawn: nodes, and the meshes, materials and textures
/// that they share.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Shared meshes.
    meshes: Arena<MeshAsset>,
    /// Shared materials.
    pub materials: Arena<Material>,
    /// Shared textures.
    pub textures: Arena<TextureAsset>,
    /// Joints that meshes follow.
    pub skins: Arena<Skin>,
    /// Movements of nodes, evaluated by [`Scene::pose`].
    pub animations: Vec<Animation>,
    /// The axis that points up; +Y by default. Nothing is turned by it: positions, cameras and lights keep
    /// their coordinates. Everything that knows a vertical follows it: [`Scene::overview`] and
    /// [`Scene::surround`], [environments](crate::EffectSettings::environment), also behind the model, and
    /// what metals mirror without one. [`Scene::turn_to`] turns the contents instead.
    pub up: UpAxis,
    nodes: Arena<Node>,
    /// Roots listed first; some may have been removed, or have a parent now.
    root_order: Vec<NodeId>,
    /// What a light meter reads; see [`Scene::light_reading`].
    pub(crate) reading: CachedReading,
}

impl Scene {
    /// An empty scene.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a mesh for nodes to draw.
    pub fn add_mesh(&mut self, name: impl Into<String>, mesh: Mesh) -> MeshId {
        self.meshes.insert(MeshAsset::new(name.into(), mesh))
    }

    /// Changes a mesh for every node that draws it; `None` if it was removed.
    pub fn replace_mesh(&mut self, id: MeshId, mesh: Mesh) -> Option<()> {
        self.reading.forget();
        self.meshes.get_mut(id)?.replace(mesh);
        Some(())
    }

    /// Gives some elements of a mesh new values, for every node that draws it. The frames have the
    /// same bytes as those of a scene created with the changed mesh.
    ///
    /// Takes time proportional to the change, and so does updating derived data at the next frame. If the
    /// last two frames of a [`Renderer`](crate::Renderer) differ in nothing but such changes, the next one
    /// draws only the parts that may look different, unless effects reach across the image, such as shadows.
    /// The first change is the exception: after it the next frame takes as long as after
    /// [`replace_mesh`](Self::replace_mesh). An editor can make an empty change in advance, so that dragging
    /// does not start with that delay. After every change, tangents generated for a normal map, shadow maps
    /// and the BVH are rebuilt. So is the whole mesh if a pose can deform it or if a polygon of four corners
    /// or more folds or unfolds.
    ///
    /// Clones of a scene share its meshes; a shared mesh is copied when it is changed.
    ///
    /// ```
    /// use trigon_scene::math::Vec3;
    /// use trigon_scene::mesh::{MeshChange, primitives};
    /// use trigon_scene::{Material, RenderSettings, Scene, render};
    ///
    /// let mut scene = Scene::new();
    /// scene.add_object("grid", primitives::grid(2.0, 2.0, 20, 20), Material::default());
    /// let (camera, settings) = (scene.overview(1.0), RenderSettings::new(32, 32));
    /// let before = render(&scene, &camera, &settings)?;
    ///
    /// let (id, _) = scene.meshes().iter().next().expect("one was added");
    /// let change = MeshChange { positions: vec![(220, Vec3::Y)], ..MeshChange::default() };
    /// scene.change_mesh(id, &change)?;
    /// assert!(render(&scene, &camera, &settings)? != before, "a vertex was drawn up");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When the mesh is gone, or has not what is to be changed. It stays as it was.
    pub fn change_mesh(&mut self, id: MeshId, change: &MeshChange) -> Result<(), SceneError> {
        self.reading.forget();
        let asset = self.meshes.get_mut(id).ok_or(SceneError::NoSuchMesh(id))?;
        Ok(asset.change(change)?)
    }

    /// Takes over a mesh of another scene under the same id, in the place of its own if it has
    /// one. Nothing is copied: both share the mesh, and what was found out about it, until one of them changes
    /// it. So a scene that is shown can follow one that is edited.
    ///
    /// `None` when the other scene has no such mesh, or when this one would have to give it
    /// another id: take over meshes in the order of their ids.
    ///
    /// ```
    /// use trigon_scene::Scene;
    /// use trigon_scene::mesh::primitives;
    ///
    /// let mut edited = Scene::new();
    /// let cube = edited.add_mesh("cube", primitives::cube(1.0));
    /// let mut shown = Scene::new();
    /// assert_eq!(shown.adopt_mesh(&edited, cube), Some(()));
    /// assert_eq!(shown.meshes().get(cube).map(|asset| asset.mesh().face_count()), Some(6));
    /// ```
    pub fn adopt_mesh(&mut self, from: &Self, id: MeshId) -> Option<()> {
        self.reading.forget();
        let asset = from.meshes.get(id)?.clone();
        if let Some(own) = self.meshes.get_mut(id) {
            *own = asset;
            return Some(());
        }
        let inserted = self.meshes.insert(asset);
        if inserted != id {
            self.meshes.remove(inserted);
        }
        (inserted == id).then_some(())
    }

    /// All meshes.
    #[must_use]
    pub fn meshes(&self) -> &Arena<MeshAsset> {
        &self.meshes
    }

    /// Adds a material.
    pub fn add_material(&mut self, material: Material) -> MaterialId {
        self.materials.insert(material)
    }

    /// Adds a texture.
    pub fn add_texture(&mut self, name: impl Into<String>, texture: Texture) -> TextureId {
        self.textures.insert(TextureAsset { name: name.into(), texture: Arc::new(texture) })
    }

    /// Adds a node as a root.
    pub fn add(&mut self, node: Node) -> NodeId {
        self.reading.forget();
        self.nodes.insert(Node { parent: None, children: Vec::new(), ..node })
    }

    /// Adds a node that hangs on another one; `None` when that one is gone.
    pub fn add_child(&mut self, parent: NodeId, node: Node) -> Option<NodeId> {
        self.reading.forget();
        self.nodes.get(parent)?;
        let child = self.nodes.insert(Node { parent: Some(parent), children: Vec::new(), ..node });
        self.nodes.get_mut(parent)?.children.push(child);
        Some(child)
    }

    /// Adds a mesh with a material as a new root: the simplest way to add an object.
    pub fn add_object(&mut self, name: impl Into<String>, mesh: Mesh, material: Material) -> NodeId {
        let name = name.into();
        let mesh = self.add_mesh(name.clone(), mesh);
        let material = self.add_material(material);
        self.add(Node::from_mesh(mesh, material).with_name(name))
    }

    /// All nodes, in the order of their indices.
    #[must_use]
    pub fn nodes(&self) -> &Arena<Node> {
        &self.nodes
    }

    /// A node, or `None` if it was removed.
    #[must_use]
    pub fn node(&self, id: NodeId) -> Option<&Node> {
        self.nodes.get(id)
    }

    /// A node, mutable, or `None` if it was removed.
    pub fn node_mut(&mut self, id: NodeId) -> Option<&mut Node> {
        self.reading.forget();
        self.nodes.get_mut(id)
    }

    /// All nodes, mutable, in the order of their indices.
    pub fn nodes_mut(&mut self) -> impl Iterator<Item = (NodeId, &mut Node)> {
        self.reading.forget();
        self.nodes.iter_mut()
    }

    /// Removes a node and its descendants. Meshes and materials stay, because others may share
    /// them. Returns the number of removed nodes.
    pub fn remove(&mut self, id: NodeId) -> usize {
        self.reading.forget();
        self.unhook(id);
        let (mut waiting, mut removed) = (vec![id], 0);
        while let Some(next) = waiting.pop() {
            if let Some(node) = self.nodes.remove(next) {
                waiting.extend(node.children);
                removed += 1;
            }
        }
        removed
    }

    /// Sets the parent of a node, or makes it a root. Its transform is kept as it is, relative to
    /// the new parent.
    ///
    /// # Errors
    /// Either was removed, or the node would become its own ancestor.
    pub fn set_parent(&mut self, child: NodeId, parent: Option<NodeId>) -> Result<(), SceneError> {
        self.reading.forget();
        self.nodes.get(child).ok_or(SceneError::NoSuchNode(child))?;
        if let Some(parent) = parent {
            self.nodes.get(parent).ok_or(SceneError::NoSuchNode(parent))?;
            if self.ancestors(parent).any(|ancestor| ancestor == child) {
                return Err(SceneError::Cycle { child, parent });
            }
        }
        self.unhook(child);
        if let Some(node) = self.nodes.get_mut(child) {
            node.parent = parent;
        }
        if let Some(parent) = parent.and_then(|parent| self.nodes.get_mut(parent)) {
            parent.children.push(child);
        }
        Ok(())
    }

    /// A node, its parent, and so on up to the root.
    pub fn ancestors(&self, id: NodeId) -> impl Iterator<Item = NodeId> {
        std::iter::successors(Some(id), |&id| self.nodes.get(id).and_then(|node| node.parent))
    }

    /// The map from a node's space to world space; the identity if the node was removed.
    #[must_use]
    pub fn world_transform(&self, id: NodeId) -> DAffine3 {
        let local = |id| self.nodes.get(id).map_or(DAffine3::IDENTITY, |node| node.transform.to_affine());
        self.ancestors(id).fold(DAffine3::IDENTITY, |inner, id| local(id) * inner)
    }

    /// For each node by index: its map to world space, or `None` if it or an ancestor is hidden or
    /// removed. Visits each node once, whatever the depth.
    #[must_use]
    pub fn visible_transforms(&self) -> Vec<Option<DAffine3>> {
        self.visible_placements().into_iter().map(|placement| Some(placement?.world)).collect()
    }

    /// The same, and whether the transforms mirror.
    pub(crate) fn visible_placements(&self) -> Vec<Option<NodePlacement>> {
        let mut table = vec![None; self.nodes.index_bound()];
        let roots = self.nodes.iter().filter(|(_, node)| node.parent.is_none());
        let mut waiting: Vec<(NodeId, NodePlacement)> =
            roots.map(|(id, _)| (id, NodePlacement::default())).collect();
        while let Some((id, outer)) = waiting.pop() {
            let Some(node) = self.nodes.get(id).filter(|node| node.visible) else { continue };
            let placement = NodePlacement {
                world: outer.world * node.transform.to_affine(),
                is_mirrored: outer.is_mirrored != node.transform.is_mirroring(),
            };
            table[id.index()] = Some(placement);
            waiting.extend(node.children.iter().map(|&child| (child, placement)));
        }
        table
    }

    /// The smallest box around everything visible; empty if nothing is.
    #[must_use]
    pub fn bounds(&self) -> Bounds3 {
        let around = |bounds: Bounds3, mesh: PlacedMesh<'_>| bounds.union(mesh.bounds());
        self.placed_meshes().fold(Bounds3::EMPTY, around)
    }

    /// The smallest box around [`Scene::visible_points`]; coordinates that are not finite do not count. [`Scene::bounds`]
    /// follows from the boxes of the meshes alone, and is larger where nodes rotate them.
    #[must_use]
    pub fn tight_bounds(&self) -> Bounds3 {
        let around = |bounds: Bounds3, mesh: PlacedMesh<'_>| bounds.union(mesh.tight_bounds());
        self.placed_meshes().fold(Bounds3::EMPTY, around)
    }

    /// The cameras in the scene, in the order of their nodes, for a viewer to choose from. A
    /// camera's scale is ignored.
    #[must_use]
    pub fn cameras(&self) -> Vec<(NodeId, Camera)> {
        let holders = self.nodes.iter().filter_map(|(id, node)| Some((id, **node.camera.as_ref()?)));
        holders.map(|(id, projection)| (id, camera_at(&self.world_transform(id), projection))).collect()
    }

    fn unhook(&mut self, id: NodeId) {
        let parent = self.nodes.get(id).and_then(|node| node.parent);
        if let Some(parent) = parent.and_then(|parent| self.nodes.get_mut(parent)) {
            parent.children.retain(|&child| child != id);
        }
    }
}

/// A camera at a node: the node's rotation without its scale.
fn camera_at(world: &DAffine3, projection: Projection) -> Camera {
    let back = world.transform_vector3(DVec3::Z).try_normalize().unwrap_or(DVec3::Z);
    let up = world.transform_vector3(DVec3::Y);
    let right = up.cross(back).try_normalize().unwrap_or_else(|| back.any_orthonormal_vector());
    let rotation = DMat3::from_cols(right, back.cross(right), back);
    Camera { position: world.translation, orientation: DQuat::from_mat3(&rotation).normalize(), projection }
}
