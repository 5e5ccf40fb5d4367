//! The stack of modifiers of a mesh: changing it, applying modifiers, and what the mesh is after all of them.
//!
//! | file | what it does |
//! |---|---|
//! | `mod` | changes the stack |
//! | `apply` | runs one modifier, by the operations that commands call |
//! | `objects` | what modifiers need of other objects |
//! | `size` | how large its result may be, before it runs |
//! | `origins` | the face of the mesh that each face of a result came from |
//! | `evaluation` | the mesh after all modifiers, evaluated anew from the first one that changed |
//! | `cage` | the mesh itself over its result, for edit mode |

mod apply;
mod cage;
mod evaluation;
mod objects;
mod origins;
mod size;
#[cfg(test)]
mod tests;

use super::edit_mesh::EditMesh;
use super::modifier::{Modifier, StackedModifier, SubdivisionModifier};
use super::refusal::Refusal;
pub use evaluation::{Evaluation, ModifierState};
pub use objects::{ModifierObjects, NoObjects, ObjectState};

const STACK: &str = "a stack of modifiers";

impl EditMesh {
    /// The most modifiers in a stack.
    pub const MOST_MODIFIERS: usize = 32;

    /// The modifiers, in the order in which they are evaluated.
    #[must_use]
    pub fn modifiers(&self) -> &[StackedModifier] {
        &self.modifiers
    }

    /// Replaces the stack. The mesh itself stays as it is.
    ///
    /// # Errors
    /// There are more than [`Self::MOST_MODIFIERS`]; a parameter is out of its range; a subdivision surface of the mesh would
    /// take more memory than is allowed.
    pub fn set_modifiers(&mut self, modifiers: Vec<StackedModifier>) -> Result<(), Refusal> {
        if modifiers.len() > Self::MOST_MODIFIERS {
            return Err(Refusal::NotPossible { operation: STACK, reason: "it has room for 32: apply some" });
        }
        modifiers.iter().try_for_each(|stacked| stacked.modifier.check())?;
        for stacked in modifiers.iter().filter(|stacked| stacked.is_on) {
            if let Modifier::Subdivision(SubdivisionModifier { levels }) = stacked.modifier {
                self.check_capacity_for_levels(levels)?;
            }
        }
        self.modifiers = modifiers;
        Ok(())
    }

    /// Adds a modifier before the one with an index, or after the last.
    ///
    /// # Errors
    /// As [`Self::set_modifiers`], or the index is larger than the number of modifiers.
    pub fn add_modifier(&mut self, index: usize, modifier: StackedModifier) -> Result<(), Refusal> {
        if index > self.modifiers.len() {
            return Err(no_modifier(index));
        }
        let mut modifiers = self.modifiers.clone();
        modifiers.insert(index, modifier);
        self.set_modifiers(modifiers)
    }

    /// Gives a modifier other parameters, or makes it one of another kind.
    ///
    /// # Errors
    /// As [`Self::set_modifiers`], or there is no modifier with this index.
    pub fn set_modifier(&mut self, index: usize, modifier: Modifier) -> Result<(), Refusal> {
        let mut modifiers = self.modifiers.clone();
        modifiers.get_mut(index).ok_or_else(|| no_modifier(index))?.modifier = modifier;
        self.set_modifiers(modifiers)
    }

    /// Switches a modifier on or off.
    ///
    /// # Errors
    /// As [`Self::set_modifiers`], or there is no modifier with this index.
    pub fn switch_modifier(&mut self, index: usize, is_on: bool) -> Result<(), Refusal> {
        let mut modifiers = self.modifiers.clone();
        modifiers.get_mut(index).ok_or_else(|| no_modifier(index))?.is_on = is_on;
        self.set_modifiers(modifiers)
    }

    /// Removes a modifier, which is returned.
    ///
    /// # Errors
    /// There is no modifier with this index.
    pub fn remove_modifier(&mut self, index: usize) -> Result<StackedModifier, Refusal> {
        self.check_modifier(index)?;
        Ok(self.modifiers.remove(index))
    }

    /// Moves a modifier to another index; those between move by one.
    ///
    /// # Errors
    /// There is no modifier with one of these indices.
    pub fn move_modifier(&mut self, from: usize, to: usize) -> Result<(), Refusal> {
        self.check_modifier(from)?;
        self.check_modifier(to)?;
        let moved = self.modifiers.remove(from);
        self.modifiers.insert(to, moved);
        Ok(())
    }

    /// Changes the mesh as a modifier says, whether that is on or not, and takes it from the stack. Those before it stay in the
    /// stack: they are evaluated after it from then on.
    ///
    /// # Errors
    /// There is no modifier with this index; or the operation is refused, and mesh and stack are as they were.
    pub fn apply_modifier(&mut self, index: usize, objects: &dyn ModifierObjects) -> Result<(), Refusal> {
        self.check_modifier(index)?;
        self.whole(|mesh| {
            let stacked = mesh.modifiers.remove(index);
            mesh.check_size_after(&stacked.modifier)?;
            mesh.modify(&stacked.modifier, objects)
        })
    }

    fn check_modifier(&self, index: usize) -> Result<(), Refusal> {
        if index < self.modifiers.len() { Ok(()) } else { Err(no_modifier(index)) }
    }
}

fn no_modifier(index: usize) -> Refusal {
    let (parameter, range) = ("the index of a modifier", "that of one in the stack");
    Refusal::OutOfRange { parameter, value: index as f64, range }
}
