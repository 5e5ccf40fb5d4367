//! The scene: its parts at their indices, so that nothing that depends on the order of nodes changes.
//! References come after their targets; since skins and nodes refer to each other, the slots of skins come
//! first and their joints last. The node hierarchy comes at the end.

use std::sync::Arc;

use trigon_mesh::Mesh;
use trigon_scene::{
    Animation, Arena, Channel, Curve, Id, Interpolation, Material, MeshAsset, Node, NodeId, Property, Scene,
    Skin, Texture, TextureAsset, TextureFormat, Transform,
};

use super::stored::Table;
use super::stored::{CaptureReader, CaptureWriter, Damage, Stored, choice, record};

record!(Skin { name, joints, inverse_bind_matrices });
record!(Animation { name, channels });
record!(Channel { node, property, curve });
choice!(Property { 0 => Translation, 1 => Rotation, 2 => Scale, 3 => MorphWeights });
choice!(Interpolation { 0 => Step, 1 => Linear, 2 => CubicSpline });
choice!(Transform { 0 => Decomposed { translation, rotation, scale }, 1 => Affine(affine) });

impl Stored for Scene {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        write_slots(to, &self.textures, Stored::write);
        (self.meshes().len() as u64).write(to);
        for (_, asset) in self.meshes().iter() {
            asset.name.write(to);
            asset.mesh().write(to);
        }
        write_slots(to, &self.materials, Stored::write);
        write_slots(to, &self.skins, |_, _| {});
        write_slots(to, self.nodes(), Stored::write);
        for (_, skin) in self.skins.iter() {
            skin.write(to);
        }
        for (_, node) in self.nodes().iter() {
            node.children().to_vec().write(to);
        }
        self.animations.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let mut scene = Self::new();
        from.ids.textures = read_arena(from, &mut scene.textures, one_texel)?;
        for _ in 0..part_count::<MeshAsset>(from)? {
            let (name, mesh) = <(String, Mesh)>::read(from)?;
            from.ids.meshes.ids.push(scene.add_mesh(name, mesh));
        }
        from.ids.materials = read_arena(from, &mut scene.materials, Material::default)?;
        let slots = read_slots(from, |_: Option<()>| scene.skins.insert(Skin::default()))?;
        from.ids.skins = slots.emptied(|id| _ = scene.skins.remove(id));
        let slots = read_slots(from, |node: Option<Node>| scene.add(node.unwrap_or_default()))?;
        from.ids.nodes = slots.emptied(|id| _ = scene.remove(id));
        let skins: Vec<_> = scene.skins.iter().map(|(id, _)| id).collect();
        for id in skins {
            let skin = Stored::read(from)?;
            if let Some(entry) = scene.skins.get_mut(id) {
                *entry = skin;
            }
        }
        read(from, &mut scene)?;
        scene.animations = Stored::read(from)?;
        Ok(scene)
    }
}

/// Everything except parent and children, which are restored at the end.
impl Stored for Node {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let Self { name, transform, mesh, materials, skin, morph_weights, light, camera, visible, .. } = self;
        name.write(to);
        transform.write(to);
        mesh.filter(|&mesh| to.scene.meshes().get(mesh).is_some()).write(to);
        materials.write(to);
        skin.filter(|&skin| to.scene.skins.get(skin).is_some()).write(to);
        morph_weights.write(to);
        light.write(to);
        camera.write(to);
        visible.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let mut node = Self::default();
        node.name = Stored::read(from)?;
        node.transform = Stored::read(from)?;
        node.mesh = Stored::read(from)?;
        node.materials = Stored::read(from)?;
        node.skin = Stored::read(from)?;
        node.morph_weights = Stored::read(from)?;
        node.light = Stored::read(from)?;
        node.camera = Stored::read(from)?;
        node.visible = Stored::read(from)?;
        Ok(node)
    }
}

impl Stored for Curve {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.interpolation().write(to);
        (self.width() as u32).write(to);
        self.times().to_vec().write(to);
        self.values().to_vec().write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let (interpolation, width) = (Stored::read(from)?, u32::read(from)?);
        let curve = Self::new(interpolation, width as usize, Stored::read(from)?, Stored::read(from)?);
        curve.ok_or_else(|| Damage::malformed("the keyframes of a curve do not fit each other"))
    }
}

/// The items of an arena up to the last one, and which slots are empty.
fn write_slots<T>(to: &mut CaptureWriter<'_>, arena: &Arena<T>, write: impl Fn(&T, &mut CaptureWriter<'_>)) {
    let count = arena.iter().last().map_or(0, |(id, _)| id.index() + 1);
    (count as u64).write(to);
    for index in 0..count {
        let item = arena.id_at(index).and_then(|id| arena.get(id));
        item.is_some().write(to);
        item.iter().for_each(|item| write(item, to));
    }
}

/// The number of parts of a kind that follow.
fn part_count<T>(from: &mut CaptureReader<'_>) -> Result<usize, Damage> {
    let (count, allowed) = (from.count(size_of::<T>())?, from.limits.nodes);
    if count > allowed {
        return Err(Damage::Limit(format!("a scene has {count} parts of a kind, {allowed} are allowed")));
    }
    Ok(count)
}

/// The slots of an arena. Empty ones hold placeholders until all are there; otherwise a later item
/// would take them.
struct Slots<T> {
    ids: Vec<Id<T>>,
    stand_ins: Vec<Id<T>>,
}

/// The ids that `insert` returns for the content of each slot, and for placeholders.
fn read_slots<T, I: Stored>(
    from: &mut CaptureReader<'_>,
    mut insert: impl FnMut(Option<I>) -> Id<T>,
) -> Result<Slots<T>, Damage> {
    let mut slots = Slots { ids: Vec::new(), stand_ins: Vec::new() };
    for _ in 0..part_count::<T>(from)? {
        let item = Option::read(from)?;
        let is_empty = item.is_none();
        let id = insert(item);
        slots.ids.push(id);
        slots.stand_ins.extend(is_empty.then_some(id));
    }
    // One for ids that should find nothing.
    slots.stand_ins.push(insert(None));
    Ok(slots)
}

impl<T> Slots<T> {
    fn emptied(self, remove: impl FnMut(Id<T>)) -> Table<T> {
        let gone = self.stand_ins.last().copied();
        self.stand_ins.into_iter().for_each(remove);
        Table { ids: self.ids, gone }
    }
}

fn read_arena<T: Stored>(
    from: &mut CaptureReader<'_>,
    arena: &mut Arena<T>,
    stand_in: impl Fn() -> T,
) -> Result<Table<T>, Damage> {
    let slots = read_slots(from, |item: Option<T>| arena.insert(item.unwrap_or_else(&stand_in)))?;
    Ok(slots.emptied(|id| _ = arena.remove(id)))
}

fn one_texel() -> TextureAsset {
    let texture = Texture::new(1, 1, vec![[0; 4]], TextureFormat::Linear).expect("one texel is a texture");
    TextureAsset { name: String::new(), texture: Arc::new(texture) }
}

/// Reads the children of every node and sets their parents.
pub(super) fn read(from: &mut CaptureReader<'_>, scene: &mut Scene) -> Result<(), Damage> {
    let nodes: Vec<NodeId> = scene.nodes().iter().map(|(id, _)| id).collect();
    let mut children = vec![Vec::<NodeId>::new(); scene.nodes().index_bound()];
    let mut is_root = vec![true; scene.nodes().index_bound()];
    for &id in &nodes {
        let hanging = Vec::<NodeId>::read(from)?;
        for child in &hanging {
            if scene.node(*child).is_none() || !std::mem::replace(&mut is_root[child.index()], false) {
                return Err(Damage::malformed("a node has two parents, or does not exist"));
            }
        }
        children[id.index()] = hanging;
    }
    let roots = nodes.iter().copied().filter(|id| is_root[id.index()]);
    let order = downwards(roots.collect(), &children, from.limits.depth)?;
    if order.len() < nodes.len() {
        return Err(Damage::malformed("nodes form a cycle"));
    }
    // From below: the scene looks for cycles above the new parent, which has no parent yet.
    for parent in order.into_iter().rev() {
        for &child in &children[parent.index()] {
            scene.set_parent(child, Some(parent)).map_err(|error| Damage::malformed(error.to_string()))?;
        }
    }
    Ok(())
}

/// Every node reachable from the roots, after its parent.
fn downwards(roots: Vec<NodeId>, children: &[Vec<NodeId>], limit: usize) -> Result<Vec<NodeId>, Damage> {
    let (mut order, mut level, mut depth) = (Vec::new(), roots, 0);
    while !level.is_empty() {
        depth += 1;
        if depth > limit {
            return Err(Damage::Limit(format!("nodes are nested more than {limit} deep")));
        }
        let next = level.iter().flat_map(|id| children[id.index()].iter().copied()).collect();
        order.append(&mut level);
        level = next;
    }
    Ok(order)
}
