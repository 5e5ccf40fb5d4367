//! Nodes of the document to nodes of the scene, in the document's order: when
//! the scene shows all nodes, an object id is the node's index in the file.

use std::collections::BTreeMap;

use trigon_math::{DAffine3, DMat4, DQuat, DVec3};
use trigon_scene::{Light, MaterialId, MeshId, Node, NodeId, Transform};

use super::document::{Document, RawTransform};
use super::formats::AccessorReader;
use super::hierarchy::Hierarchy;
use super::hierarchy::{has_instances, read_instances};
use super::lights::convert_camera;
use super::lights::convert_light;
use super::mesh::{BuiltMesh, default_weights, sound_weights};
use super::native::AmbientExtras;
use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::warning::Warnings;

/// What a node needs of its mesh.
type PlacedMesh = (MeshId, Vec<MaterialId>);

/// The nodes of the document that are in the scene now.
pub(crate) struct Placed<'d> {
    pub(crate) document: &'d Document,
    /// For each node of the document; none when its scene does not reach it.
    pub(crate) ids: Vec<Option<NodeId>>,
    /// How many morph targets the mesh of each node has.
    pub(crate) target_counts: Vec<usize>,
}

impl Placed<'_> {
    /// The nodes of the document with their ids.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = (usize, NodeId)> {
        self.ids.iter().enumerate().filter_map(|(index, id)| Some((index, (*id)?)))
    }
}

/// Adds them, with their names taken out of the document: there may be millions.
pub(crate) fn add_nodes<'d>(
    import: &mut Import<'_>,
    document: &'d mut Document,
    hierarchy: &Hierarchy,
    meshes: Vec<Option<BuiltMesh>>,
    materials: &BTreeMap<Option<usize>, MaterialId>,
) -> Placed<'d> {
    let target_counts: Vec<usize> = meshes
        .iter()
        .map(|built| built.as_ref().map_or(0, |built| built.mesh.attributes().morph_targets.len()))
        .collect();
    let meshes: Vec<Option<PlacedMesh>> = meshes
        .into_iter()
        .enumerate()
        .map(|(index, built)| {
            let name = document.root.meshes[index].name.clone().unwrap_or_default();
            built.map(|built| {
                let slots = built.materials.iter().map(|material| materials[material]).collect();
                let id = import.scene.add_mesh(name, built.mesh);
                import.edit_data.extend(built.edit_data.map(|data| (id, data)));
                (id, slots)
            })
        })
        .collect();
    let mut ids: Vec<Option<NodeId>> = vec![None; document.root.nodes.len()];
    let included = (0..ids.len()).filter(|&node| hierarchy.included[node]);
    for index in included {
        let name = document.root.nodes[index].name.take().unwrap_or_else(|| format!("node {index}"));
        let node = convert_node(import, document, index, &meshes);
        ids[index] = Some(import.scene.add(node.with_name(name)));
    }
    hang_up(import, document, hierarchy, &ids);
    if !hierarchy.roots.is_sorted() {
        import.scene.order_roots(hierarchy.roots.iter().filter_map(|&node| ids[node]).collect());
    }
    let targets_of = |node: &gltf::json::Node| node.mesh.map_or(0, |mesh| target_counts[mesh.value()]);
    let target_counts = document.root.nodes.iter().map(targets_of).collect();
    Placed { document, ids, target_counts }
}

/// Hangs the copies of instanced nodes on them; the nodes themselves then draw
/// nothing. Copies come after all nodes of the file, whose indices stay theirs.
pub(crate) fn add_instances(
    import: &mut Import<'_>,
    reader: &mut AccessorReader<'_>,
    placed: &Placed<'_>,
) -> Result<(), LoadError> {
    let root = &placed.document.root;
    let is_instanced =
        |&(index, _): &(usize, NodeId)| root.nodes[index].mesh.is_some() && has_instances(root, index);
    for (index, id) in placed.nodes().filter(is_instanced) {
        let transforms =
            reader.read(import, |accessors, warnings| read_instances(accessors, index, warnings))?;
        let Some(node) = import.scene.node_mut(id) else { continue };
        let (mesh, materials) = (node.mesh.take(), std::mem::take(&mut node.materials));
        let (name, weights) = (node.name.clone(), node.morph_weights.clone());
        for (number, transform) in transforms.into_iter().enumerate() {
            let mut copy = Node::default().with_name(format!("{name} {number}")).with_transform(transform);
            (copy.mesh, copy.materials) = (mesh, materials.clone());
            copy.morph_weights.clone_from(&weights);
            import.scene.add_child(id, copy).expect("the node was added just now");
        }
    }
    Ok(())
}

/// Hangs children on their parents, the deepest first: every parent is then
/// still a root, and the check for loops takes one step.
fn hang_up(import: &mut Import<'_>, document: &Document, hierarchy: &Hierarchy, ids: &[Option<NodeId>]) {
    for &parent in hierarchy.order.iter().rev() {
        for child in document.root.nodes[parent].children.iter().flatten().map(|child| child.value()) {
            if let (Some(child), Some(_)) = (ids[child], hierarchy.parents[child]) {
                import.scene.set_parent(child, ids[parent]).expect("the hierarchy was checked for loops");
            }
        }
    }
}

/// All but the name.
fn convert_node(
    import: &mut Import<'_>,
    document: &Document,
    index: usize,
    meshes: &[Option<PlacedMesh>],
) -> Node {
    let from = &document.root.nodes[index];
    let plain = RawTransform::default();
    let raw = document.transforms.get(index).unwrap_or(&plain);
    let transform = convert_transform(raw, index, &mut import.warnings);
    let mut node = Node::default().with_transform(transform);
    if let Some((mesh, materials)) = from.mesh.and_then(|mesh| meshes[mesh.value()].clone()) {
        (node.mesh, node.materials) = (Some(mesh), materials);
    }
    if let Some(mesh) = from.mesh {
        let own = from.weights.as_deref().map(sound_weights);
        node.morph_weights = own.unwrap_or_else(|| default_weights(&document.root, mesh.value()));
    }
    node.light = convert_light(&document.root, from, &mut import.warnings).map(Box::new);
    node.camera = convert_camera(&document.root, from, &mut import.warnings).map(Box::new);
    if let Some(extras) = raw.native.get() {
        node.visible = !extras.hidden;
        let ambient =
            |from: &AmbientExtras| Box::new(Light::ambient(from.intensity).with_color(from.color.into()));
        node.light = extras.ambient.as_ref().map(ambient).or(node.light);
        if let Some(light) = &mut node.light {
            light.radius = if extras.radius > 0.0 { extras.radius } else { 0.0 };
        }
    }
    node
}

/// How much the square of the length of a quaternion may be from 1 to be rounding of f64.
const ROUNDING: f64 = 1e-15;

/// How much the length of a quaternion may be from 1 before it is worth a
/// warning: one of four bytes is off by as much.
pub(crate) const ROTATION_TOLERANCE: f64 = 0.00769;

fn convert_transform(raw: &RawTransform, index: usize, warnings: &mut Warnings) -> Transform {
    if let Some(matrix) = &raw.matrix {
        if raw.translation.is_some() || raw.rotation.is_some() || raw.scale.is_some() {
            warnings.push(
                Location::Item("node", index),
                "it has both a matrix and a translation, rotation or scale; only the matrix is used",
                "remove one of them, or export the model again",
            );
        }
        let matrix = DMat4::from_cols_array(matrix);
        if matrix.row(3).to_array() != [0.0, 0.0, 0.0, 1.0] {
            warnings.push(
                Location::Item("node", index),
                "the last row of its matrix is not 0 0 0 1 and is ignored",
                "export the model again",
            );
        }
        return Transform::Affine(DAffine3::from_mat4(matrix));
    }
    let rotation = raw.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    if rotation.length_squared() == 0.0 {
        warnings.push(
            Location::Item("node", index),
            "its rotation has no length and counts as none",
            "export the model again",
        );
    } else if (rotation.length() - 1.0).abs() > ROTATION_TOLERANCE {
        warnings.push(
            Location::Item("node", index),
            "its rotation is not a unit quaternion; it is normalized",
            "export the model again",
        );
    }
    let scale = raw.scale.map_or(DVec3::ONE, DVec3::from);
    if (rotation.length_squared() - 1.0).abs() <= ROUNDING {
        // Dividing by the length would only round once more: what was saved comes back.
        let translation = raw.translation.map_or(DVec3::ZERO, DVec3::from);
        return Transform::Decomposed { translation, rotation, scale };
    }
    Transform::from_scale_rotation_translation(
        scale,
        rotation,
        raw.translation.map_or(DVec3::ZERO, DVec3::from),
    )
}
