//! Selecting many elements of several objects at once, such as those in a region of an image.

use fixedbitset::FixedBitSet;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::MeshId;

use super::select::check_element;
use super::{Action, ObjectName, Outcome, SelectAction};
use crate::error::EditError;
use crate::state::Change;

/// Selects elements of edited objects in bulk: none of them becomes active.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectElements {
    /// The objects and their elements.
    pub parts: Vec<ElementsOf>,
    /// How this combines with the previous selection.
    pub action: SelectAction,
}

/// Elements of one object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ElementsOf {
    /// The object.
    pub object: ObjectName,
    /// Numbers of elements of the selected kind, as ranges: the first and the last of each.
    pub ranges: Vec<[u32; 2]>,
}

impl ElementsOf {
    /// Elements in increasing order.
    #[must_use]
    pub fn new(object: ObjectName, elements: impl IntoIterator<Item = u32>) -> Self {
        let mut ranges: Vec<[u32; 2]> = Vec::new();
        for element in elements {
            match ranges.last_mut() {
                Some([_, last]) if last.checked_add(1) == Some(element) => *last = element,
                _ => ranges.push([element, element]),
            }
        }
        Self { object, ranges }
    }
}

impl Action for SelectElements {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            return Err(EditError::NotEditing("selecting elements"));
        }
        let found: Result<Vec<_>, _> = self.parts.iter().map(|part| named(change, part)).collect();
        let found = found?;
        let (selection, _) = change.selection_and_meshes();
        if matches!(self.action, SelectAction::Replace | SelectAction::Intersect) {
            let is_named = |mesh: &MeshId| found.iter().any(|(named, _)| named == mesh);
            let is_cleared = |mesh: &MeshId| self.action == SelectAction::Replace || !is_named(mesh);
            let all: Vec<_> = selection.meshes().map(|(mesh, _)| mesh).filter(is_cleared).collect();
            for mesh in all {
                selection.of_mut(mesh).expect("it was just listed").clear();
            }
        }
        for (mesh, bits) in found {
            let own = selection.of_mut(mesh).expect("it was found among those that are edited");
            own.set(self.action.joined(own.bits(), &bits));
        }
        Ok(Outcome::silent())
    }
}

impl SelectAction {
    /// The selection of a mesh afterwards.
    pub(super) fn joined(self, before: &FixedBitSet, named: &FixedBitSet) -> FixedBitSet {
        let mut after = before.clone();
        after.grow(named.len());
        match self {
            Self::Replace => after.clone_from(named),
            Self::Add => after.union_with(named),
            Self::Remove => after.difference_with(named),
            Self::Toggle => after.symmetric_difference_with(named),
            Self::Intersect => after.intersect_with(named),
        }
        after
    }
}

/// The mesh and its elements.
fn named(change: &mut Change<'_>, part: &ElementsOf) -> Result<(MeshId, FixedBitSet), EditError> {
    let object = part.object.find(change.scene())?;
    let kind = change.selection().kind();
    let refused = EditError::NotEditing("selecting elements of an object");
    let Some(&id) = change.meshes_of([object]).first() else { return Err(refused) };
    let (selection, meshes) = change.selection_and_meshes();
    let (Some(mesh), Some(_)) = (meshes.get(&id), selection.of(id)) else { return Err(refused) };
    let mut bits = FixedBitSet::with_capacity(kind.capacity(mesh));
    for &[first, last] in &part.ranges {
        for element in first..=last {
            // A range may claim four thousand million elements: the first that does not exist ends
            // it.
            check_element(mesh, kind, element)?;
            bits.insert(element as usize);
        }
    }
    Ok((id, bits))
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene};

    use super::*;
    use crate::{Command, Document, ElementKind, SetElementKind};

    fn two_cubes() -> Document {
        let mut scene = Scene::new();
        for name in ["one", "two"] {
            scene.add_object(name, primitives::cube(1.0), Material::default());
        }
        let mut document = Document::new(scene);
        let edit = json!({ "op": "edit_objects", "objects": ["one", "two"] });
        document.run(serde_json::from_value(edit).expect("a command")).expect("both have meshes");
        document
            .run(SetElementKind { kind: ElementKind::Face, extend: false }.into())
            .expect("always possible");
        document
    }

    fn selected(document: &Document) -> Vec<Vec<u32>> {
        document.selection().meshes().map(|(_, own)| own.indices().collect()).collect()
    }

    fn select(document: &mut Document, parts: [&[u32]; 2], action: SelectAction) {
        let part = |(object, elements): (u32, &[u32])| {
            ElementsOf::new(ObjectName::Number(object), elements.iter().copied())
        };
        let parts = (0u32..).zip(parts).map(part).collect();
        document.run(SelectElements { parts, action }.into()).expect("they exist");
    }

    #[test]
    fn elements_of_several_objects_are_selected_in_every_mode() {
        let mut document = two_cubes();
        select(&mut document, [&[0, 1, 2], &[5]], SelectAction::Replace);
        assert_eq!(selected(&document), [vec![0, 1, 2], vec![5]]);
        select(&mut document, [&[2, 3], &[0]], SelectAction::Add);
        assert_eq!(selected(&document), [vec![0, 1, 2, 3], vec![0, 5]]);
        select(&mut document, [&[0, 5], &[]], SelectAction::Remove);
        assert_eq!(selected(&document), [vec![1, 2, 3], vec![0, 5]]);
        select(&mut document, [&[1, 4], &[5]], SelectAction::Toggle);
        assert_eq!(selected(&document), [vec![2, 3, 4], vec![0]]);
        select(&mut document, [&[3, 5], &[0]], SelectAction::Intersect);
        assert_eq!(selected(&document), [vec![3], vec![0]]);
        select(&mut document, [&[], &[1]], SelectAction::Replace);
        assert_eq!(selected(&document)[1], [1], "and nothing of the first");
    }

    #[test]
    fn ranges_beyond_the_mesh_are_refused() {
        let mut document = two_cubes();
        let parts = vec![ElementsOf { object: ObjectName::Number(0), ranges: vec![[0, u32::MAX]] }];
        let command: Command = SelectElements { parts, action: SelectAction::Replace }.into();
        assert!(document.run(command).is_err(), "a cube has six faces");
        assert!(selected(&document).iter().all(Vec::is_empty), "nothing changed");
    }

    #[test]
    fn neighbouring_elements_make_one_range() {
        let part = ElementsOf::new(ObjectName::Number(0), [0, 1, 2, 5, 7, 8]);
        assert_eq!(part.ranges, [[0, 2], [5, 5], [7, 8]]);
    }
}
