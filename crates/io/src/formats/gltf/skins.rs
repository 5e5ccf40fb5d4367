//! Skins: joints and their inverse bind matrices.

use std::collections::HashSet;

use trigon_math::{DAffine3, DMat4, DVec4};
use trigon_mesh::SkinWeights;
use trigon_scene::{Node, NodeId, Skin, SkinId};

use super::accessor::Accessors;
use super::buffers::Unplaced;
use super::formats::AccessorReader;
use super::formats::BIND_MATRIX;
use super::nodes::Placed;
use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::warning::{Warnings, counted};

/// Reads the matrices of a skin, one for each joint; identity where the file
/// has none or nonsense.
fn read_bind_matrices(
    accessors: &mut Accessors<'_>,
    index: usize,
    warnings: &mut Warnings,
) -> Result<Vec<DAffine3>, Unplaced> {
    let skin = &accessors.root.skins[index];
    let Some(accessor) = skin.inverse_bind_matrices else { return Ok(Vec::new()) };
    let location = || Location::Item("skin", index);
    accessors.spend(usize::try_from(accessors.count(accessor.value())).unwrap_or(usize::MAX), &location())?;
    accessors.doubt_stride(accessor.value());
    if let Some(what) = BIND_MATRIX.fault(accessors.root, accessor.value()) {
        warnings.push(location(), what, "export the model again");
    }
    let read = accessors.vectors::<16>(accessor.value(), BIND_MATRIX.types)?;
    if read.len() < skin.joints.len() {
        let what =
            format!("{} for {}", counted(read.len(), "bind matrix"), counted(skin.joints.len(), "joint"));
        warnings.push(location(), format!("{what}; the others are the identity"), "export the model again");
    }
    let mut broken = 0;
    let mut convert = |columns: &[f32; 16]| {
        let matrix = DMat4::from_cols_array(&columns.map(f64::from));
        let is_affine = matrix.is_finite() && matrix.row(3) == DVec4::W;
        broken += usize::from(!is_affine);
        if matrix.is_finite() { DAffine3::from_mat4(matrix) } else { DAffine3::IDENTITY }
    };
    let matrices = read.iter().take(skin.joints.len()).map(&mut convert).collect();
    let what = "a bind matrix is not finite, or its last row is not 0 0 0 1; it is corrected";
    warnings.push_counted(broken, location(), what, "export the model again");
    Ok(matrices)
}

/// Adds the skins that placed nodes use, and hands them to these nodes.
pub(crate) fn add_skins(
    import: &mut Import<'_>,
    reader: &mut AccessorReader<'_>,
    placed: &Placed<'_>,
) -> Result<(), LoadError> {
    let root = &placed.document.root;
    if root.skins.is_empty() {
        return Ok(());
    }
    let mut skins = vec![None; root.skins.len()];
    let (mut effort, limit) = (0_usize, import.options.limits.corners);
    // Joints that the scene does not show find nothing.
    let nobody = import.scene.add(Node::default());
    import.scene.remove(nobody);
    for (node, id) in placed.nodes() {
        let Some(index) = root.nodes[node].skin.map(|skin| skin.value()) else { continue };
        let (skin, above) = match skins[index] {
            Some(known) => known,
            None => {
                let matrices = reader
                    .read(import, |accessors, warnings| read_bind_matrices(accessors, index, warnings))?;
                let skin = convert(import, placed, index, nobody, matrices);
                let skin = import.scene.skins.insert(skin);
                *skins[index].insert((skin, nodes_above(import, skin)))
            }
        };
        effort = effort.saturating_add(above);
        if effort > limit {
            let what = format!("with it, skins follow more than {limit} nodes");
            return Err(LoadError::limit(import.path, what).at(Location::Item("node", node)));
        }
        warn_of_joints(import, id, Location::Item("node", node), root.skins[index].joints.len());
        if let Some(node) = import.scene.node_mut(id) {
            node.skin = Some(skin);
        }
    }
    Ok(())
}

/// How many nodes a skin's pose depends on: its joints and what they hang on.
/// Thousands of nodes may share a skin of thousands of joints.
fn nodes_above(import: &Import<'_>, skin: SkinId) -> usize {
    let Some(skin) = import.scene.skins.get(skin) else { return 0 };
    let mut known = HashSet::new();
    for &joint in &skin.joints {
        for above in import.scene.ancestors(joint) {
            if !known.insert(above) {
                break;
            }
        }
    }
    known.len()
}

fn convert(
    import: &mut Import<'_>,
    placed: &Placed<'_>,
    index: usize,
    nobody: NodeId,
    inverse_bind_matrices: Vec<DAffine3>,
) -> Skin {
    let from = &placed.document.root.skins[index];
    let joints: Vec<Option<NodeId>> = from.joints.iter().map(|joint| placed.ids[joint.value()]).collect();
    let lost = joints.iter().filter(|joint| joint.is_none()).count();
    if lost > 0 {
        let what = format!(
            "{} outside the scene; what follows them stays where the mesh is",
            counted(lost, "joint")
        );
        import.warnings.push(Location::Item("skin", index), what, "put all joints in the scene of the mesh");
    }
    Skin {
        name: from.name.clone().unwrap_or_else(|| format!("skin {index}")),
        joints: joints.into_iter().map(|joint| joint.unwrap_or(nobody)).collect(),
        inverse_bind_matrices,
    }
}

/// Says when the mesh of a node and its skin do not fit together.
fn warn_of_joints(import: &mut Import<'_>, id: NodeId, location: Location, joints: usize) {
    let what = match joint_bound(import, id) {
        None => "it has a skin, and its mesh has no joints and weights: it is drawn unskinned".to_owned(),
        Some(bound) if bound > joints => {
            let last = bound - 1;
            format!(
                "its mesh follows joint {last} of {joints}; what follows no joint stays where the mesh is"
            )
        }
        Some(_) => return,
    };
    import.warnings.push(location, what, "export the model again");
}

/// One more than the last joint that a node's mesh follows; none when it
/// follows none.
fn joint_bound(import: &Import<'_>, id: NodeId) -> Option<usize> {
    let mesh = import.scene.meshes().get(import.scene.node(id)?.mesh?)?;
    let skin: &SkinWeights = mesh.mesh().attributes().skin.as_ref()?;
    let followed = skin.joints().iter().zip(skin.weights()).filter(|(_, weight)| **weight > 0.0);
    Some(followed.map(|(&joint, _)| usize::from(joint) + 1).max().unwrap_or(0))
}
