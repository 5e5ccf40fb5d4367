//! Objects as a whole: new ones, names, copies, and standard objects with their dimensions.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DVec3, Vec3};
use trigon_mesh::{Mesh, primitives};
use trigon_scene::{Light, Material, Node, NodeId};

use super::modifier::rename_in_modifiers;
use super::paste::add_to_edited;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::state::{Change, Names};

/// Adds a standard object and selects it; in edit mode its elements, which join the active mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AddObject {
    /// The shape, with its dimensions.
    pub object: Shape,
    /// The name. Default: that of the shape. If another object has it, a number is added: `Cube.001`.
    #[serde(default)]
    pub name: Option<String>,
    /// The position of its origin, in metres.
    #[serde(default)]
    pub position: [f64; 3],
}

impl Action for AddObject {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (mesh, position) = (self.object.mesh(), DVec3::from(self.position));
        if change.selection().is_editing() {
            return add_to_edited(change, &mesh, position);
        }
        let name = change.free_name(self.name.as_deref().unwrap_or(self.object.name()));
        let scene = change.scene_mut();
        let id = scene.add_object(name, mesh, Material::default());
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
        let name = change.free_name(&self.name);
        let node = Node::from_light(light.with_color(Vec3::from(self.color))).with_name(name);
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
        let node = Node::default().with_name(change.free_name(&self.name));
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

/// Renames an object. If another object has the new name, a number is added: `Cube.001`.
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
        let name = Names::without(change.scene(), &[id].into()).take(&self.name);
        let node = change.scene_mut().node_mut(id).expect("it was just found");
        let before = std::mem::replace(&mut node.name, name.clone());
        rename_in_modifiers(change, &before, &name)?;
        if name == self.name {
            return Ok(Outcome::silent());
        }
        Ok(Outcome::with_message(format!(
            "another object is called {:?}: this one is now {name:?}",
            self.name
        )))
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
        let mut names = Names::of(change.scene());
        for id in objects {
            let mut node = change.scene().node(id).expect("it was just found").clone();
            let parent = node.parent();
            node.name = names.take(&node.name);
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

/// A standard object. Lengths are in metres. Counts of pieces are brought into 3 to 2048 (1 to 2048 for columns and
/// rows, 2 to 2048 for rings), subdivisions of an icosphere into 0 to 7, those of a teapot into 2 to 64.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields)]
#[schemars(extend("examples" = Shape::USUAL))]
#[expect(missing_docs, reason = "the names say it")]
pub enum Shape {
    Plane { width: f32, depth: f32 },
    Grid { width: f32, depth: f32, columns: u32, rows: u32 },
    Cube { edge: f32 },
    UvSphere { radius: f32, segments: u32, rings: u32 },
    Icosphere { radius: f32, subdivisions: u32 },
    Cylinder { radius: f32, height: f32, segments: u32 },
    Cone { radius: f32, height: f32, segments: u32 },
    Disc { radius: f32, segments: u32 },
    Torus { major_radius: f32, minor_radius: f32, major_segments: u32, minor_segments: u32 },
    Pyramid { edge: f32, height: f32 },
    Tetrahedron { edge: f32 },
    Octahedron { edge: f32 },
    Dodecahedron { edge: f32 },
    Icosahedron { edge: f32 },
    Teapot { subdivisions: u32 },
}

impl Shape {
    /// Each of them with default dimensions: about two metres in size.
    pub const USUAL: [Self; 15] = [
        Self::Plane { width: 2.0, depth: 2.0 },
        Self::Grid { width: 2.0, depth: 2.0, columns: 10, rows: 10 },
        Self::Cube { edge: 2.0 },
        Self::UvSphere { radius: 1.0, segments: 32, rings: 16 },
        Self::Icosphere { radius: 1.0, subdivisions: 2 },
        Self::Cylinder { radius: 1.0, height: 2.0, segments: 32 },
        Self::Cone { radius: 1.0, height: 2.0, segments: 32 },
        Self::Disc { radius: 1.0, segments: 32 },
        Self::Torus { major_radius: 1.0, minor_radius: 0.25, major_segments: 48, minor_segments: 12 },
        Self::Pyramid { edge: 2.0, height: 2.0 },
        Self::Tetrahedron { edge: 2.0 },
        Self::Octahedron { edge: 1.5 },
        Self::Dodecahedron { edge: 0.75 },
        Self::Icosahedron { edge: 1.0 },
        Self::Teapot { subdivisions: 4 },
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane { .. } => "Plane",
            Self::Grid { .. } => "Grid",
            Self::Cube { .. } => "Cube",
            Self::UvSphere { .. } => "Sphere",
            Self::Icosphere { .. } => "Icosphere",
            Self::Cylinder { .. } => "Cylinder",
            Self::Cone { .. } => "Cone",
            Self::Disc { .. } => "Disc",
            Self::Torus { .. } => "Torus",
            Self::Pyramid { .. } => "Pyramid",
            Self::Tetrahedron { .. } => "Tetrahedron",
            Self::Octahedron { .. } => "Octahedron",
            Self::Dodecahedron { .. } => "Dodecahedron",
            Self::Icosahedron { .. } => "Icosahedron",
            Self::Teapot { .. } => "Teapot",
        }
    }

    pub(super) fn mesh(self) -> Mesh {
        match self {
            Self::Plane { width, depth } => primitives::plane(width, depth),
            Self::Grid { width, depth, columns, rows } => primitives::grid(width, depth, columns, rows),
            Self::Cube { edge } => primitives::cube(edge),
            Self::UvSphere { radius, segments, rings } => primitives::uv_sphere(radius, segments, rings),
            Self::Icosphere { radius, subdivisions } => primitives::icosphere(radius, subdivisions),
            Self::Cylinder { radius, height, segments } => primitives::cylinder(radius, height, segments),
            Self::Cone { radius, height, segments } => primitives::cone(radius, height, segments),
            Self::Disc { radius, segments } => primitives::disc(radius, segments),
            Self::Torus { major_radius, minor_radius, major_segments, minor_segments } => {
                primitives::torus(major_radius, minor_radius, major_segments, minor_segments)
            }
            Self::Pyramid { edge, height } => primitives::pyramid(edge, height),
            Self::Tetrahedron { edge } => primitives::tetrahedron(edge),
            Self::Octahedron { edge } => primitives::octahedron(edge),
            Self::Dodecahedron { edge } => primitives::dodecahedron(edge),
            Self::Icosahedron { edge } => primitives::icosahedron(edge),
            Self::Teapot { subdivisions } => primitives::teapot(subdivisions),
        }
    }
}
