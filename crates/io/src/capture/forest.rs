//! The node hierarchy.

use trigon_scene::{NodeId, Scene};

use super::stored::Stored;
use super::stream::{Damage, Reader};

/// Reads the children of every node and sets their parents.
pub(super) fn read(from: &mut Reader<'_>, scene: &mut Scene) -> Result<(), Damage> {
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
