//! A mesh after all its modifiers: as a whole for exports, and live for a view, where a result stays until what it was made of
//! changes.

use trigon_mesh::Mesh;

use crate::edit_mesh::EditMesh;
use crate::modifier::{Modifier, StackedModifier, SubdivisionModifier};
use crate::refusal::Refusal;
use crate::stack::objects::{ModifierObjects, ObjectState};

/// What became of a modifier in a view.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ModifierState {
    /// It is shown.
    Shown,
    /// It is switched off.
    Off,
    /// Its surface is shown with so many levels, as the mesh is dense.
    Fewer(u32),
    /// It is left out: its result could have so many faces, too many to follow an edit at once.
    TooDense(u64),
    /// It is left out, because its operation was refused.
    Refused(Refusal),
}

impl ModifierState {
    /// What a view does not show of the modifier, and why, in words; `None` if it shows all that is on.
    #[must_use]
    pub fn shortfall(&self) -> Option<String> {
        match self {
            Self::Shown | Self::Off => None,
            Self::Fewer(levels) => {
                Some(format!("the view shows {levels}, as the mesh is dense; exports have all levels"))
            }
            Self::TooDense(faces) => Some(format!(
                "the view leaves it out, as it could make {faces} faces, too many to follow edits; exports have it"
            )),
            Self::Refused(refusal) => Some(format!("left out: {refusal}")),
        }
    }
}

/// The mesh after the modifiers that are on, evaluated live: each result is retained until the mesh changes, or the stack up
/// to it.
#[derive(Debug, Clone, Default)]
pub struct Evaluation {
    /// One for each modifier of the stack.
    steps: Vec<EvaluatedModifier>,
}

#[derive(Debug, Clone)]
struct EvaluatedModifier {
    stacked: StackedModifier,
    /// The state of the other object that it used.
    object: Option<ObjectState>,
    state: ModifierState,
    /// What it made, with the numbers of origins; `None` if it changed nothing.
    result: Option<EditMesh>,
}

impl Evaluation {
    /// The most faces of a result in a view. A subdivision surface of this size is made anew in less than a tenth of a second.
    pub const MOST_LIVE_FACES: u64 = 1 << 17;

    /// Forgets all results, because the mesh itself has changed.
    pub fn forget(&mut self) {
        self.steps.clear();
    }

    /// Evaluates what is not up to date. Returns whether anything was not.
    pub fn update(&mut self, mesh: &EditMesh, objects: &dyn ModifierObjects) -> bool {
        let state_of = |stacked: &StackedModifier| objects.state(stacked.modifier.object()?);
        let is_current = |(step, stacked): &(&EvaluatedModifier, &StackedModifier)| {
            step.stacked == **stacked && step.object == state_of(stacked)
        };
        let current = self.steps.iter().zip(mesh.modifiers()).take_while(is_current).count();
        let is_changed = current < self.steps.len().max(mesh.modifiers().len());
        self.steps.truncate(current);
        for stacked in &mesh.modifiers()[current..] {
            let (state, result) = self.evaluate(mesh, stacked, objects);
            self.steps.push(EvaluatedModifier {
                stacked: stacked.clone(),
                object: state_of(stacked),
                state,
                result,
            });
        }
        is_changed
    }

    /// What became of each modifier, in the order of the stack.
    #[must_use]
    pub fn states(&self) -> impl ExactSizeIterator<Item = &ModifierState> {
        self.steps.iter().map(|step| &step.state)
    }

    /// Whether a view shows something else than the mesh itself.
    #[must_use]
    pub fn changes_mesh(&self) -> bool {
        self.evaluated().is_some()
    }

    /// The mesh after the modifiers, for drawing; `None` if that is the mesh itself.
    #[must_use]
    pub fn to_mesh(&self) -> Option<Mesh> {
        self.evaluated().map(|evaluated| evaluated.to_mesh().0)
    }

    /// How many faces that has; `None` if it is the mesh itself.
    #[must_use]
    pub fn face_count(&self) -> Option<usize> {
        self.evaluated().map(EditMesh::face_count)
    }

    /// The mesh after the modifiers as an editable one; `None` if that is the mesh itself.
    #[must_use]
    pub fn to_edit_mesh(&self) -> Option<EditMesh> {
        self.evaluated().map(|evaluated| {
            let mut mesh = evaluated.clone();
            mesh.clear_origins();
            mesh
        })
    }

    pub(super) fn evaluated(&self) -> Option<&EditMesh> {
        self.steps.iter().rev().find_map(|step| step.result.as_ref())
    }

    fn evaluate(
        &self,
        mesh: &EditMesh,
        stacked: &StackedModifier,
        objects: &dyn ModifierObjects,
    ) -> (ModifierState, Option<EditMesh>) {
        if !stacked.is_on {
            return (ModifierState::Off, None);
        }
        let input = self.evaluated();
        let (modifier, state) = match live(input.unwrap_or(mesh), &stacked.modifier) {
            Ok(live) => live,
            Err(size) => return (ModifierState::TooDense(size), None),
        };
        let other = modifier.object().and_then(|name| objects.mesh(name));
        if let Some(size) = other.map(|other| 4 * other.face_count() as u64)
            && size > Self::MOST_LIVE_FACES
        {
            return (ModifierState::TooDense(size), None);
        }
        let mut result = input.map_or_else(|| with_origins(mesh), EditMesh::clone);
        match result.modify_in_range(&modifier, objects) {
            Ok(()) => (state, Some(result)),
            Err(refusal) => (ModifierState::Refused(refusal), None),
        }
    }
}

/// A modifier as a view evaluates it, or how large its result would be.
fn live(input: &EditMesh, modifier: &Modifier) -> Result<(Modifier, ModifierState), u64> {
    let is_small = |modifier: &Modifier| input.size_after(modifier) <= Evaluation::MOST_LIVE_FACES;
    if is_small(modifier) {
        return Ok((modifier.clone(), ModifierState::Shown));
    }
    if let Modifier::Subdivision(SubdivisionModifier { levels }) = *modifier {
        let with = |levels| Modifier::Subdivision(SubdivisionModifier { levels });
        if let Some(fewer) = (1..levels).rev().find(|&levels| is_small(&with(levels))) {
            return Ok((with(fewer), ModifierState::Fewer(fewer)));
        }
    }
    Err(input.size_after(modifier))
}

/// A mesh to be changed, without a stack of its own.
fn with_origins(mesh: &EditMesh) -> EditMesh {
    let mut mesh = EditMesh { modifiers: Vec::new(), ..mesh.clone() };
    mesh.number_origins();
    mesh
}

impl EditMesh {
    /// The mesh after all modifiers that are on, for exports: without the limit of a view. A modifier whose operation is not
    /// possible on the mesh is left out, as in a view. `None` if no modifier is on.
    ///
    /// # Errors
    /// A result would have too many elements or take too much memory, or a vertex would lie too far away.
    pub fn evaluated(&self, objects: &dyn ModifierObjects) -> Result<Option<Self>, Refusal> {
        let mut result: Option<Self> = None;
        for stacked in self.modifiers.iter().filter(|stacked| stacked.is_on) {
            let input = result.as_ref().unwrap_or(self);
            input.check_size_after(&stacked.modifier)?;
            let mut next = Self { modifiers: Vec::new(), ..input.clone() };
            match next.modify_in_range(&stacked.modifier, objects) {
                Ok(()) => result = Some(next),
                Err(
                    Refusal::NotPossible { .. }
                    | Refusal::NothingGiven { .. }
                    | Refusal::NotSolid { .. }
                    | Refusal::NoSuchGroup(_),
                ) => {}
                Err(refusal) => return Err(refusal),
            }
        }
        Ok(result)
    }

    /// Changes a mesh as a modifier says. Refuses a result with positions that are not finite, if all were before.
    fn modify_in_range(&mut self, modifier: &Modifier, objects: &dyn ModifierObjects) -> Result<(), Refusal> {
        let beyond = |mesh: &Self| mesh.vertices().find(|&vertex| !mesh.position(vertex).is_finite());
        let was_beyond = beyond(self).is_some();
        self.modify(modifier, objects)?;
        match beyond(self).filter(|_| !was_beyond) {
            Some(vertex) => Err(Refusal::Overflow(vertex)),
            None => Ok(()),
        }
    }
}
