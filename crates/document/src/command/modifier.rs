//! The stack of modifiers of a mesh: operations on the whole mesh that stay alive while its own elements go on to be edited.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{EditMesh, Modifier, ModifierState, Refusal, StackedModifier, SubdivisionModifier};
use trigon_scene::MeshId;

use super::action::{remake, whole_meshes};
use super::set_transform::named_or_active;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::objects::UsedObject;
use crate::state::Change;

const STACK: &str = "a modifier";

/// The mesh of an object by name, or of the active one, for something that it gets.
pub(super) fn mesh_of(
    change: &Change<'_>,
    name: Option<&ObjectName>,
    operation: &'static str,
) -> Result<MeshId, EditError> {
    let object = named_or_active(change, name, operation)?;
    let mesh = change.scene().node(object).and_then(|node| node.mesh);
    let reason = "the object has no mesh: select one that has";
    mesh.ok_or_else(|| Refusal::NotPossible { operation, reason }.into())
}

/// Changes the stack of a mesh, and reports what a view shows.
fn restack(
    change: &mut Change<'_>,
    object: Option<&ObjectName>,
    with: impl FnOnce(&mut EditMesh) -> Result<(), Refusal>,
) -> Result<Outcome, EditError> {
    let id = mesh_of(change, object, STACK)?;
    change.edit(id, |mesh| Ok(with(mesh)?))?;
    let states: Vec<ModifierState> =
        change.evaluate(id).map_or_else(Vec::new, |all| all.states().cloned().collect());
    let modifiers = change.mesh(id).map_or(&[][..], EditMesh::modifiers);
    let reported = modifiers.iter().zip(&states);
    let words: Vec<String> = reported
        .filter_map(|(stacked, state)| Some(format!("{}: {}", stacked.modifier.name(), state.shortfall()?)))
        .collect();
    Ok(Outcome::with_message(words.join("; ")))
}

/// Adds a modifier to the stack of an object's mesh. What is shown and exported is the mesh after all modifiers that are on, in
/// their order, while its own elements, the cage, go on to be edited. The file of the document retains mesh and modifiers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AddModifier {
    /// The object. Default: the active one.
    #[serde(default)]
    pub object: Option<ObjectName>,
    /// The modifier.
    pub modifier: Modifier,
    /// How many modifiers come before it. Default: all.
    #[serde(default)]
    pub index: Option<u32>,
}

impl Action for AddModifier {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        restack(change, self.object.as_ref(), |mesh| {
            let index = self.index.map_or(mesh.modifiers().len(), |index| index as usize);
            mesh.add_modifier(index, StackedModifier::new(self.modifier.clone()))
        })
    }
}

/// Gives a modifier other parameters, or makes it one of another kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetModifier {
    /// The object. Default: the active one.
    #[serde(default)]
    pub object: Option<ObjectName>,
    /// The index in the stack, from 0.
    pub index: u32,
    /// The modifier with all parameters: those that are not given have their defaults.
    pub modifier: Modifier,
}

impl Action for SetModifier {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let index = self.index as usize;
        restack(change, self.object.as_ref(), |mesh| mesh.set_modifier(index, self.modifier.clone()))
    }
}

/// Switches a modifier on or off. One that is off is neither shown nor exported.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShowModifier {
    /// The object. Default: the active one.
    #[serde(default)]
    pub object: Option<ObjectName>,
    /// The index in the stack, from 0.
    pub index: u32,
    /// Whether it is on.
    pub on: bool,
}

impl Action for ShowModifier {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        restack(change, self.object.as_ref(), |mesh| mesh.switch_modifier(self.index as usize, self.on))
    }
}

/// Moves a modifier to another index of the stack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MoveModifier {
    /// The object. Default: the active one.
    #[serde(default)]
    pub object: Option<ObjectName>,
    /// The index in the stack, from 0.
    pub index: u32,
    /// The index that it has then.
    pub to: u32,
}

impl Action for MoveModifier {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let [from, to] = [self.index, self.to].map(|index| index as usize);
        restack(change, self.object.as_ref(), |mesh| mesh.move_modifier(from, to))
    }
}

/// Removes a modifier from the stack. The mesh itself stays.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RemoveModifier {
    /// The object. Default: the active one.
    #[serde(default)]
    pub object: Option<ObjectName>,
    /// The index in the stack, from 0.
    pub index: u32,
}

impl Action for RemoveModifier {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        restack(change, self.object.as_ref(), |mesh| mesh.remove_modifier(self.index as usize).map(drop))
    }
}

/// Changes a mesh as one of its modifiers says, whether that is on or not, and takes it from the stack. The modifiers before it
/// stay in the stack and are not applied, as in Blender: with some that are on, the result may differ from what was shown, and a
/// warning says so.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ApplyModifier {
    /// The object. Default: the active one.
    pub object: Option<ObjectName>,
    /// The index in the stack, from 0.
    pub index: u32,
}

impl Action for ApplyModifier {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = mesh_of(change, self.object.as_ref(), STACK)?;
        let (faces, warning) = apply(change, id, self.index as usize)?;
        let mut outcome = Outcome::counted("made", faces, ["face", "faces"]);
        outcome.warnings.extend(warning);
        Ok(outcome)
    }
}

/// Applies a modifier. Returns how many faces the mesh has then, and a warning if others come before it.
fn apply(change: &mut Change<'_>, id: MeshId, index: usize) -> Result<(usize, Option<String>), EditError> {
    let modifiers = change.mesh(id).map_or(&[][..], EditMesh::modifiers);
    let skips = modifiers.iter().take(index).any(|stacked| stacked.is_on);
    let warning = modifiers.get(index).filter(|_| skips).map(|stacked| {
        let name = stacked.modifier.name();
        format!(
            "{name}: applied before the modifiers above it, so that the result may differ from what was shown"
        )
    });
    let modifier = modifiers.get(index).map(|stacked| stacked.modifier.clone());
    let objects = modifier.map_or_else(UsedObject::default, |modifier| change.objects_of(id, &modifier));
    Ok((remake(change, id, |mesh| Ok(mesh.apply_modifier(index, &objects)?))?, warning))
}

/// Shows meshes as their Catmull-Clark surfaces, while their own elements, the cage, go on to be edited: the meshes that
/// are edited, or those of the selected objects. Edges with a crease stay sharp. The file of the document keeps
/// cage and levels; what is exported is the surface. This adds a subdivision modifier after all others, changes the first one
/// that there is, or removes it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SetSubdivision {
    /// The number of subdivisions; 0 removes the modifier.
    #[schemars(range(min = 0, max = 5))]
    pub levels: u32,
}

/// The index of the first subdivision modifier.
fn subdivision_of(mesh: &EditMesh) -> Option<usize> {
    mesh.modifiers().iter().position(|stacked| matches!(stacked.modifier, Modifier::Subdivision(_)))
}

impl Action for SetSubdivision {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut faces = 0;
        let mut fewer: Option<u32> = None;
        for id in whole_meshes(change, "a subdivision surface")? {
            let index = change.edit(id, |mesh| Ok(self.set(mesh)?))?;
            let evaluation = change.evaluate(id).expect("it was just edited");
            let shown = match index.and_then(|index| evaluation.states().nth(index)) {
                Some(ModifierState::Fewer(levels)) => Some(*levels),
                Some(ModifierState::TooDense(_)) => Some(0),
                _ => None,
            };
            fewer = [fewer, shown].into_iter().flatten().min();
            let evaluated = evaluation.face_count();
            faces += evaluated.or_else(|| Some(change.mesh(id)?.face_count())).unwrap_or(0);
        }
        let message = match fewer {
            _ if self.levels == 0 => "off".to_owned(),
            Some(levels) => format!(
                "{} levels; the view shows {levels}, as the mesh is dense; exports have all",
                self.levels
            ),
            None => format!("{}, {faces} faces", levels_in_words(self.levels)),
        };
        Ok(Outcome::with_message(message))
    }
}

impl SetSubdivision {
    /// Changes the stack of a mesh. Returns the index of the modifier.
    fn set(&self, mesh: &mut EditMesh) -> Result<Option<usize>, Refusal> {
        let surface = SubdivisionModifier { levels: self.levels };
        let index = subdivision_of(mesh);
        match index {
            Some(index) if self.levels == 0 => drop(mesh.remove_modifier(index)?),
            Some(index) => {
                mesh.switch_modifier(index, true)?;
                mesh.set_modifier(index, surface.into())?;
            }
            None if self.levels == 0 => {}
            None => mesh.add_modifier(mesh.modifiers().len(), StackedModifier::new(surface))?,
        }
        Ok(subdivision_of(mesh))
    }
}

fn levels_in_words(levels: u32) -> String {
    if levels == 1 { "1 level".to_owned() } else { format!("{levels} levels") }
}

/// Makes meshes the surfaces that they are shown as: those that are edited, or those of the selected objects. This applies the
/// first subdivision modifier of each, as `apply_modifier` does.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ApplySubdivision {}

impl Action for ApplySubdivision {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let all = whole_meshes(change, "a subdivision surface")?;
        let index_of = |id: &MeshId| Some((*id, change.state().mesh(*id).and_then(subdivision_of)?));
        let with_surface: Vec<(MeshId, usize)> = all.iter().filter_map(index_of).collect();
        if with_surface.is_empty() {
            let reason = "the mesh has no subdivision surface: give it one first (Ctrl+1 to Ctrl+5)";
            return Err(Refusal::NotPossible { operation: "applying a subdivision", reason }.into());
        }
        let (mut faces, mut warnings) = (0, Vec::new());
        for (id, index) in with_surface {
            let (count, warning) = apply(change, id, index)?;
            faces += count;
            warnings.extend(warning);
        }
        Ok(Outcome { warnings, ..Outcome::counted("made", faces, ["face", "faces"]) })
    }
}

/// Lets modifiers go on using an object that got another name.
pub(super) fn rename_in_modifiers(
    change: &mut Change<'_>,
    before: &str,
    name: &str,
) -> Result<(), EditError> {
    let is_used =
        |mesh: &EditMesh| mesh.modifiers().iter().any(|stacked| stacked.modifier.object() == Some(before));
    for id in change.edited_where(is_used) {
        change.edit(id, |mesh| {
            let mut modifiers = mesh.modifiers().to_vec();
            for stacked in &mut modifiers {
                if stacked.modifier.object() == Some(before) {
                    stacked.modifier.set_object(name);
                }
            }
            Ok(mesh.set_modifiers(modifiers)?)
        })?;
    }
    Ok(())
}
