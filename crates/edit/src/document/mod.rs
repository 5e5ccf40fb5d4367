//! An open document: a scene, its meshes while they are edited, what is selected, what was done.

mod change;
mod preview;
mod scene;
mod scene_change;
mod shown;
mod state;
mod visible;

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use trigon_io::{
    Export, ExportOptions, Format, LoadError, LoadOptions, Loaded, NativeDocument, NativeFile, Warning,
    WriteError,
};
use trigon_mesh::edit::EditMesh;
use trigon_mesh::math::DAffine3;
use trigon_scene::{MeshId, Scene};

use crate::command::{Command, ImportFile, Outcome};
use crate::error::EditError;
use crate::history::{Entry, History};
use crate::recovery::Event;
use crate::selection::Selection;

pub(crate) use change::{AfterEdit, Change};
pub use scene_change::SceneChange;
use state::State;
pub(crate) use visible::shown_levels;

/// A scene that is edited by commands.
///
/// Everything that changes goes through [`Document::run`], so that it can be undone to the same
/// bytes, repeated, adjusted, and written down as a script. The document never draws:
/// [`Document::scene`] is what is to be drawn.
///
/// ```
/// use trigon_edit::{Command, Document};
/// use trigon_scene::showcase;
///
/// let mut document = Document::new(showcase());
/// let before = document.scene().nodes().len();
/// let all: Command = serde_json::from_str(r#"{ "op": "select_all" }"#)?;
/// document.run(all)?;
/// document.run(serde_json::from_str(r#"{ "op": "delete_objects" }"#)?)?;
/// assert_eq!(document.scene().nodes().len(), 0);
/// document.undo()?;
/// assert_eq!(document.scene().nodes().len(), before);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Document {
    state: State,
    history: History,
    /// What was done since the last time that somebody asked; `None` until somebody asks.
    events: Option<Vec<Event>>,
    /// What is tried out and neither confirmed nor cancelled yet; its other state is that before.
    preview: Option<Entry>,
    revision: u64,
}

impl Document {
    /// Opens a scene. Nothing is selected.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        Self::from_file(NativeDocument::new(scene))
    }

    /// Opens a file of any format that can be read, with what there is to say about it.
    ///
    /// # Errors
    /// As [`NativeDocument::load`].
    pub fn open(path: &Path, options: &LoadOptions<'_>) -> Result<(Self, Vec<Warning>), LoadError> {
        let (file, warnings) = NativeDocument::load(path, options)?;
        Ok((Self::from_file(file), warnings))
    }

    /// Opens a file from memory: the base of a recovery file. `name` stands for it in messages.
    ///
    /// # Errors
    /// As [`NativeDocument::load_from_slice`].
    pub fn open_bytes(
        name: &Path,
        bytes: &[u8],
        options: &LoadOptions<'_>,
    ) -> Result<(Self, Vec<Warning>), LoadError> {
        let (file, warnings) = NativeDocument::load_from_slice(name, bytes, options)?;
        Ok((Self::from_file(file), warnings))
    }

    fn from_file(file: NativeDocument) -> Self {
        Self { state: State { file, ..State::default() }, revision: next_revision(), ..Self::default() }
    }

    /// The document as a native file, not written yet: [`save`](crate::save) writes it once
    /// nobody minds what would be lost.
    ///
    /// # Errors
    /// When the file would have 4 GiB or more.
    pub fn encode(&self) -> Result<NativeFile<'_>, WriteError> {
        self.state.file.encode()
    }

    /// The document as it is now, to be encoded on another thread while this one goes on changing. It takes the time
    /// of copying the meshes that are or were edited.
    #[must_use]
    pub fn snapshot(&self) -> NativeDocument {
        self.state.file.clone()
    }

    /// Adds what was loaded of a file, as [`ImportFile`](crate::ImportFile) does with its path, without reading it
    /// again.
    ///
    /// # Errors
    /// As those of the command, but that the file cannot be read.
    pub fn import(&mut self, path: String, loaded: &Loaded) -> Result<Outcome, EditError> {
        self.confirm();
        let import = ImportFile { path };
        let (entry, outcome) =
            self.attempt_as(import.clone().into(), |_, change| import.add(change, loaded))?;
        self.enter(entry);
        Ok(outcome)
    }

    /// The document for other programs, not written yet; see [`trigon_io::export()`].
    ///
    /// # Errors
    /// As [`trigon_io::export()`].
    pub fn export(
        &self,
        name: &str,
        format: Format,
        options: &ExportOptions<'_>,
    ) -> Result<Export, WriteError> {
        self.state.file.export(name, format, options)
    }

    /// The nodes and materials as they are now, and meshes as they were when [`Self::scene`] was called
    /// last.
    #[must_use]
    pub fn nodes(&self) -> &Scene {
        &self.state.file.scene
    }

    /// A mesh with its neighbours, if it is or was edited.
    #[must_use]
    pub fn mesh(&self, id: MeshId) -> Option<&EditMesh> {
        self.state.mesh(id)
    }

    /// The map from a mesh into the world, where it is edited: that of the first selected object that shows
    /// it, or of the first one at all; identity where none does.
    #[must_use]
    pub fn mesh_transform(&self, id: MeshId) -> DAffine3 {
        self.state.mesh_transform(id)
    }

    /// What is selected.
    #[must_use]
    pub fn selection(&self) -> &Selection {
        &self.state.selection
    }

    /// Another number after everything that was done or taken back, and for every document that is
    /// opened: what was computed of a document holds as long as this stays.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// What was done.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Sets how much memory the history may take, in bytes.
    pub fn set_history_budget(&mut self, bytes: usize) {
        self.history.set_budget(bytes);
    }

    /// Runs a command: one entry in the history. A preview that is under way is confirmed first, as by
    /// all that changes the document ([`Self::preview`]).
    ///
    /// # Errors
    /// Why it was refused. The document is as it was before.
    pub fn run(&mut self, command: Command) -> Result<Outcome, EditError> {
        self.confirm();
        let (entry, outcome) = self.attempt(command)?;
        self.enter(entry);
        Ok(outcome)
    }

    /// Runs a command without a trace in the history. A refusal leaves the document as it was.
    fn attempt(&mut self, command: Command) -> Result<(Entry, Outcome), EditError> {
        self.attempt_as(command, |command, change| command.action().run(change))
    }

    /// The same for a command whose work is done by a function.
    fn attempt_as(
        &mut self,
        command: Command,
        work: impl FnOnce(&Command, &mut Change<'_>) -> Result<Outcome, EditError>,
    ) -> Result<(Entry, Outcome), EditError> {
        self.revision = next_revision();
        let selection = self.state.selection.clone();
        let mut change = Change { state: &mut self.state, meshes: Vec::new(), parts: None };
        let result = work(&command, &mut change);
        let Change { meshes, parts, .. } = change;
        let mut entry = Entry { command, meshes, parts, selection, bytes: 0 };
        match result {
            Ok(mut outcome) => {
                outcome.warnings.append(&mut self.state.untold);
                Ok((entry, outcome))
            }
            Err(refusal) => {
                self.exchange(&mut entry);
                Err(refusal)
            }
        }
    }

    /// Puts what was just done into the history.
    fn enter(&mut self, entry: Entry) {
        self.note(|| Event::Run(Box::new(entry.command.clone())));
        self.history.push(entry);
    }

    /// Takes back the last command.
    ///
    /// # Errors
    /// There is none.
    pub fn undo(&mut self) -> Result<(), EditError> {
        self.confirm();
        let mut history = std::mem::take(&mut self.history);
        let entry = history.step_back().ok_or(EditError::Nothing("undo"));
        let result = entry.map(|entry| self.exchange(entry));
        self.history = history;
        if result.is_ok() {
            self.note(|| Event::Undo);
        }
        result
    }

    /// Does again what was taken back last.
    ///
    /// # Errors
    /// There is nothing.
    pub fn redo(&mut self) -> Result<(), EditError> {
        self.confirm();
        let mut history = std::mem::take(&mut self.history);
        let entry = history.step_forward().ok_or(EditError::Nothing("do again"));
        let result = entry.map(|entry| self.exchange(entry));
        self.history = history;
        if result.is_ok() {
            self.note(|| Event::Redo);
        }
        result
    }

    /// Runs the last command that was not a selection once more.
    ///
    /// # Errors
    /// There is none, or it is refused now.
    pub fn repeat_last(&mut self) -> Result<Outcome, EditError> {
        self.confirm();
        let last = self.history.done().iter().rev().find(|entry| !entry.command.is_selection());
        let command = last.ok_or(EditError::Nothing("repeat"))?.command.clone();
        self.run(command)
    }

    /// Runs another command in place of the last one, usually the same with other parameters.
    ///
    /// # Errors
    /// There is none, or the other one is refused: then the last one stays done.
    pub fn adjust_last(&mut self, command: Command) -> Result<Outcome, EditError> {
        self.confirm();
        if self.history.done().is_empty() {
            return Err(EditError::Nothing("adjust"));
        }
        let (selection, undone) = (self.state.selection.clone(), self.history.undone().len());
        self.undo()?;
        self.run(command).inspect_err(|_| {
            debug_assert_eq!(self.history.undone().len(), undone + 1, "a refusal adds no entry");
            if self.redo().is_ok() {
                self.state.selection = selection;
            }
        })
    }

    /// All commands that are done, to be run again on the document as it was opened. Not
    /// complete when entries were dropped ([`History::dropped`]).
    #[must_use]
    pub fn script(&self) -> Vec<Command> {
        self.history.done().iter().map(|entry| entry.command.clone()).collect()
    }

    /// What was done since the last call: what a recovery file is told. The first call starts to
    /// write down.
    pub fn take_events(&mut self) -> Vec<Event> {
        self.events.replace(Vec::new()).unwrap_or_default()
    }

    fn note(&mut self, event: impl FnOnce() -> Event) {
        if let Some(events) = &mut self.events {
            events.push(event());
        }
    }

    /// Goes to an entry's other state.
    fn exchange(&mut self, entry: &mut Entry) {
        self.revision = next_revision();
        // A command may change a mesh several times: backwards in time, and the next time forwards.
        for (id, difference) in entry.meshes.iter_mut().rev() {
            if let Some(mesh) = self.state.file.edited.get_mut(id) {
                difference.apply(mesh);
                self.state.shown.note_difference(*id, mesh, difference);
            }
        }
        entry.meshes.reverse();
        if let Some(parts) = &mut entry.parts {
            self.state.file.scene.swap_parts(parts);
            self.state.shown.note_parts();
        }
        std::mem::swap(&mut self.state.selection, &mut entry.selection);
    }
}

/// A number that no document of this program had before.
fn next_revision() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed) + 1
}
