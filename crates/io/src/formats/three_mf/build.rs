//! Places what the parts say: a node for each item of the build, and below it one for each component. Objects that
//! several items name are one mesh.

use std::collections::BTreeMap;

use trigon_math::{DAffine3, DMat3};
use trigon_scene::{Node, NodeId, Transform};

use super::mesh::{Built, MeshMaker};
use super::model::{FoundObject, Models, ObjectShape, PlacedObject, Triangles};
use crate::error::{LoadError, LoadErrorKind};
use crate::import::Import;
use crate::polygons::{most_corners, too_many_corners};

/// What is still to be placed.
struct Pending<'m> {
    /// The part whose item or component it is.
    part: &'m str,
    placed: &'m PlacedObject,
    parent: Option<NodeId>,
    depth: usize,
}

/// A scene in the making.
struct BuildReader<'m> {
    models: &'m Models,
    stack: Vec<Pending<'m>>,
    built: BTreeMap<(&'m str, u32), Built>,
    maker: MeshMaker<'m>,
    /// Of all nodes.
    corners: usize,
}

/// Adds the nodes of a file to the scene.
pub(super) fn build(import: &mut Import<'_>, models: &Models) -> Result<(), LoadError> {
    let root = models.by_part.get_key_value(&models.root);
    let items = root.map_or(&[][..], |(_, model)| &model.items);
    if items.is_empty() && !import.options.may_be_empty {
        let what = "there is nothing to draw: the build has no items";
        let remedy = "export the model with its objects on the plate";
        return Err(LoadError::new(LoadErrorKind::Empty, import.path, what, remedy));
    }
    let pend = |placed| Pending { part: models.root.as_str(), placed, parent: None, depth: 0 };
    let stack = items.iter().rev().map(pend).collect();
    let (built, maker) = (BTreeMap::new(), MeshMaker::default());
    let mut reader = BuildReader { models, stack, built, maker, corners: 0 };
    let objects: usize = models.by_part.values().map(|model| model.objects.len()).sum();
    while let Some(pending) = reader.stack.pop() {
        // A longer way down comes to an object for the second time.
        if pending.depth > objects.min(import.options.limits.depth) {
            let what = format!("object {} contains itself", pending.placed.object);
            return Err(fault(import, &pending, what));
        }
        reader.add(import, &pending)?;
    }
    Ok(())
}

impl<'m> BuildReader<'m> {
    /// Adds the node of an item or a component, and puts its own components on the stack.
    fn add(&mut self, import: &mut Import<'_>, pending: &Pending<'m>) -> Result<(), LoadError> {
        let found = self.find(import, pending)?;
        let limit = import.options.limits.nodes;
        if import.scene.nodes().len() >= limit {
            return Err(LoadError::limit(import.path, format!("it has more than {limit} nodes")));
        }
        let mut map = pending.placed.transform;
        map.translation = found.model.unit.meters(map.translation);
        let mut node = Node::default().with_name(name_of(&found, pending.placed));
        if let ObjectShape::Mesh(triangles) = &found.object.shape {
            let built = self.mesh(import, &found, triangles)?;
            map *= DAffine3::from_translation(built.offset);
            (node.mesh, node.materials) = (Some(built.mesh), built.materials);
        }
        node.transform = match map.matrix3 == DMat3::IDENTITY {
            true => Transform::from_translation(map.translation),
            false => Transform::Affine(map),
        };
        let id = match pending.parent {
            Some(parent) => import.scene.add_child(parent, node).expect("the parent was added"),
            None => import.scene.add(node),
        };
        if let ObjectShape::Components(components) = &found.object.shape {
            let depth = pending.depth + 1;
            let pend = |placed| Pending { part: found.part, placed, parent: Some(id), depth };
            self.stack.extend(components.iter().rev().map(pend));
        }
        Ok(())
    }

    fn find(&self, import: &Import<'_>, pending: &Pending<'m>) -> Result<FoundObject<'m>, LoadError> {
        let (part, number) = (pending.placed.part.as_deref().unwrap_or(pending.part), pending.placed.object);
        let found = self.models.by_part.get_key_value(part).and_then(|(part, model)| {
            Some(FoundObject { part, model, number, object: model.objects.get(&number)? })
        });
        found.ok_or_else(|| fault(import, pending, format!("there is no object {number}")))
    }

    /// The mesh of an object, made when it is placed for the first time.
    fn mesh(
        &mut self,
        import: &mut Import<'_>,
        found: &FoundObject<'m>,
        triangles: &'m Triangles,
    ) -> Result<Built, LoadError> {
        self.corners = self.corners.saturating_add(3 * triangles.triangles.len());
        if self.corners > most_corners(import) {
            return Err(too_many_corners(import));
        }
        let key = (found.part, found.number);
        if let Some(known) = self.built.get(&key) {
            return Ok(known.clone());
        }
        let built = self.maker.make(import, found, triangles);
        self.built.insert(key, built.clone());
        Ok(built)
    }
}

/// The error of an item or a component.
fn fault(import: &Import<'_>, pending: &Pending<'_>, what: String) -> LoadError {
    LoadError::malformed(import.path, what, "export the model again").at(pending.placed.location.clone())
}

/// The name of a node: that of the object, else the number of the part, else the number of the object.
fn name_of(found: &FoundObject<'_>, placed: &PlacedObject) -> String {
    let names = [&found.object.name, &placed.part_number, &found.object.part_number];
    let named = names.into_iter().find(|name| !name.is_empty());
    named.map_or_else(|| format!("object {}", found.number), Clone::clone)
}
