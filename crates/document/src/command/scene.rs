//! Objects as a whole: new ones, names, visibility, copies.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DVec3, Vec3};
use trigon_scene::{Light, Material, Node, NodeId};

use super::{Action, ObjectName, Outcome, Shape};
use crate::error::EditError;
use crate::state::Change;

/// Adds a standard object and selects it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AddObject {
    /// The shape, with its dimensions.
    pub object: Shape,
    /// The name. Default: that of the shape.
    #[serde(default)]
    pub name: Option<String>,
    /// The position of its origin, in metres.
    #[serde(default)]
    pub position: [f64; 3],
}

impl Action for AddObject {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("adding an object"));
        }
        let name = self.name.clone().unwrap_or_else(|| self.object.name().to_owned());
        let scene = change.scene_mut();
        let id = scene.add_object(name, self.object.mesh(), Material::default());
        let position = DVec3::from(self.position);
        scene.node_mut(id).expect("it was just added").transform.set_translation(position);
        select_only(change, id);
        Ok(Outcome::silent())
    }
}

/// Which light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LightShape {
    /// Shines from a point in all directions.
    #[default]
    Point,
    /// Shines from infinitely far away, along −Z of its object.
    Directional,
    /// Shines in a cone along −Z of its object.
    Spot,
}

/// Adds a light and selects it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AddLight {
    /// Which.
    pub light: LightShape,
    /// Its name.
    pub name: String,
    /// The brightness of a white surface that the light hits head-on, for points and spots from one
    /// metre away: 1 is white.
    #[schemars(range(min = 0.0))]
    pub intensity: f32,
    /// Linear red, green and blue.
    pub color: [f32; 3],
    /// The position, in metres.
    pub position: [f64; 3],
}

impl Default for AddLight {
    fn default() -> Self {
        let (light, name) = (LightShape::default(), "Light".to_owned());
        Self { light, name, intensity: 10.0, color: [1.0; 3], position: [0.0; 3] }
    }
}

impl Action for AddLight {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("adding a light"));
        }
        let light = match self.light {
            LightShape::Point => Light::point(self.intensity),
            LightShape::Directional => Light::directional(self.intensity),
            LightShape::Spot => Light::spot(self.intensity),
        };
        let node = Node::from_light(light.with_color(Vec3::from(self.color))).with_name(self.name.clone());
        let id = change.scene_mut().add(node.at(DVec3::from(self.position)));
        select_only(change, id);
        Ok(Outcome::silent())
    }
}

/// Adds an object without content, as a parent for others, and selects it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AddEmpty {
    /// Its name.
    pub name: String,
    /// The position of its origin, in metres.
    pub position: [f64; 3],
}

impl Default for AddEmpty {
    fn default() -> Self {
        Self { name: "Empty".to_owned(), position: [0.0; 3] }
    }
}

impl Action for AddEmpty {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("adding an object"));
        }
        let node = Node::default().with_name(self.name.clone());
        let id = change.scene_mut().add(node.at(DVec3::from(self.position)));
        select_only(change, id);
        Ok(Outcome::silent())
    }
}

pub(super) fn select_only(change: &mut Change<'_>, id: NodeId) {
    let selection = change.selection_mut();
    selection.objects = [id].into();
    selection.active = Some(id);
}

/// Renames an object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RenameObject {
    /// Which.
    pub object: ObjectName,
    /// The new name.
    pub name: String,
}

impl Action for RenameObject {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = self.object.find(change.scene())?;
        change.scene_mut().node_mut(id).expect("it was just found").name.clone_from(&self.name);
        Ok(Outcome::silent())
    }
}

/// Shows or hides objects with their descendants. Hidden ones are deselected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShowObjects {
    /// The objects. Default: the selected ones.
    #[serde(default)]
    pub objects: Vec<ObjectName>,
    /// Whether to show or hide them.
    pub visible: bool,
}

impl Action for ShowObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let objects = named_or_selected(change, &self.objects, "showing objects")?;
        let scene = change.scene_mut();
        for id in objects {
            scene.node_mut(id).expect("it was just found").visible = self.visible;
        }
        let scene = change.scene();
        let hidden = |id: &NodeId| scene.node(*id).is_none_or(|node| !node.visible);
        let (hidden, shown): (BTreeSet<NodeId>, BTreeSet<NodeId>) =
            change.selection().objects.iter().partition(|id| hidden(id));
        if !change.selection().is_editing() && !hidden.is_empty() {
            let selection = change.selection_mut();
            selection.active = selection.active.filter(|active| shown.contains(active));
            selection.objects = shown;
        }
        Ok(Outcome::silent())
    }
}

/// Duplicates the selected objects, and selects the copies. Their children are not copied.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DuplicateObjects {
    /// Whether the copies share the mesh, so that editing one changes all.
    pub linked: bool,
    /// The offset of the copies, in metres.
    pub offset: [f64; 3],
}

impl Action for DuplicateObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let objects = named_or_selected(change, &[], "duplicating objects")?;
        let mut copies = BTreeSet::new();
        for id in objects {
            let mut node = change.scene().node(id).expect("it was just found").clone();
            let parent = node.parent();
            node.transform.translate(DVec3::from(self.offset));
            if let Some(mesh) = node.mesh.filter(|_| !self.linked) {
                node.mesh = change.copy_mesh(mesh);
            }
            let scene = change.scene_mut();
            let copy = match parent {
                Some(parent) => scene.add_child(parent, node),
                None => Some(scene.add(node)),
            };
            copies.extend(copy);
        }
        let selection = change.selection_mut();
        selection.active = copies.last().copied();
        selection.objects = copies;
        Ok(Outcome::silent())
    }
}

/// The objects that a command names, or the selected ones.
pub(super) fn named_or_selected(
    change: &Change<'_>,
    names: &[ObjectName],
    command: &'static str,
) -> Result<Vec<NodeId>, EditError> {
    let found: Result<Vec<NodeId>, EditError> = if names.is_empty() {
        let selected = change.selection().objects.iter().copied();
        Ok(selected.filter(|&id| change.scene().node(id).is_some()).collect())
    } else {
        names.iter().map(|name| name.find(change.scene())).collect()
    };
    match found? {
        objects if objects.is_empty() => {
            Err(EditError::NothingSelected { command, needed: "at least one object" })
        }
        objects => Ok(objects),
    }
}
