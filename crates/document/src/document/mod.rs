//! An open document: a scene, its edited meshes, the selection, the history.

mod copy;
mod history;
mod scene;

use std::path::{Path, PathBuf};

use trigon_io::{
    Export, ExportOptions, Format, LoadError, LoadOptions, Loaded, Location, NativeDocument, Warning,
};
use trigon_mesh::math::DAffine3;
use trigon_modelling::EditMesh;
use trigon_scene::{MeshId, Scene};

use crate::command::{Command, ImportFile, ObjectName, Outcome};
use crate::document_file::{DocumentFile, ExportError};
use crate::error::EditError;
use crate::revision::next_revision;
use crate::selection::Selection;
use crate::state::{Change, State};
use crate::storage::{Disk, finish_set};

pub use history::{Entry, Event, History};

/// A scene that commands edit.
///
/// All changes go through [`Document::run`], so that they can be undone to the same bytes,
/// repeated, adjusted, and written as a script. The document never draws: [`Document::scene`] is
/// the scene to draw.
///
/// ```
/// use trigon_document::{Command, Document};
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
    /// The events since they were last requested; `None` until the first request.
    events: Option<Vec<Event>>,
    /// The preview that is neither confirmed nor cancelled yet; its other state is the one before
    /// it.
    preview: Option<Entry>,
    revision: u64,
}

impl Document {
    /// Opens a scene. Nothing is selected.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        Self::from_file(DocumentFile { native: NativeDocument::new(scene), ..DocumentFile::default() })
    }

    /// Opens a file of any readable format, with its warnings. A set of files whose saving was interrupted is completed
    /// first ([`finish_set`]).
    ///
    /// # Errors
    /// As [`NativeDocument::load`].
    pub fn open(path: &Path, options: &LoadOptions<'_>) -> Result<(Self, Vec<Warning>), LoadError> {
        let finished = finish_set(&mut Disk, path);
        let (native, mut warnings) = NativeDocument::load(path, options)?;
        if let Err(error) = finished {
            let location = Location::Named("the files that belong to it".to_owned());
            let remedy = "make its folder writable and open it again";
            warnings.push(Warning::new(path, location, &format!("some are older: {error}"), remedy));
        }
        Ok((Self::from_file(DocumentFile::open(native, path, &mut warnings)), warnings))
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
        let (native, mut warnings) = NativeDocument::load_from_slice(name, bytes, options)?;
        Ok((Self::from_file(DocumentFile::open(native, name, &mut warnings)), warnings))
    }

    fn from_file(file: DocumentFile) -> Self {
        let mut state = State { file, ..State::default() };
        state.shown.marks_revision = next_revision();
        Self { state, revision: next_revision(), ..Self::default() }
    }

    /// The document as trigon's own file holds it. [`NativeDocument::encode`] makes the file, and
    /// [`save`](crate::save) writes it once the caller accepts what would be lost.
    #[must_use]
    pub fn to_native(&self) -> NativeDocument {
        self.state.file.to_native()
    }

    /// The document as it is now, for encoding on another thread while editing continues. Takes the time to
    /// copy the meshes that are or were edited.
    #[must_use]
    pub fn snapshot(&self) -> DocumentFile {
        self.state.file.clone()
    }

    /// Adds the contents of a loaded file, as [`ImportFile`] does with its path, without
    /// reading it again.
    ///
    /// # Errors
    /// The errors of the command, except that the file cannot be read.
    pub fn import(&mut self, path: String, loaded: &Loaded) -> Result<Outcome, EditError> {
        self.confirm();
        let up = Some(loaded.scene.up).filter(|&up| up != loaded.format.up());
        let import = ImportFile { path, up };
        let (entry, outcome) =
            self.attempt_as(import.clone().into(), |_, change| import.add(change, loaded))?;
        self.enter(entry);
        Ok(outcome)
    }

    /// The document for other programs, not written yet; see [`DocumentFile::export`].
    ///
    /// # Errors
    /// As [`DocumentFile::export`].
    pub fn export(
        &self,
        name: &str,
        format: Format,
        options: &ExportOptions<'_>,
    ) -> Result<Export, ExportError> {
        self.state.file.export(name, format, options)
    }

    /// Every file that its contents were read from, the opened model first.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.state.file.native.files
    }

    /// The nodes and materials as they are now, and meshes as of the last call of [`Self::scene`].
    #[must_use]
    pub fn nodes(&self) -> &Scene {
        &self.state.file.native.scene
    }

    /// A mesh with its adjacency, if it is or was edited.
    #[must_use]
    pub fn mesh(&self, id: MeshId) -> Option<&EditMesh> {
        self.state.mesh(id)
    }

    /// The map from a mesh into the world in which it is edited: that of the first selected object that shows
    /// it, or of the first one at all; the identity if none does.
    #[must_use]
    pub fn mesh_transform(&self, id: MeshId) -> DAffine3 {
        self.state.mesh_transform(id)
    }

    /// The first object that shows a mesh, for commands that name one.
    #[must_use]
    pub fn object_of(&self, mesh: MeshId) -> Option<ObjectName> {
        let mut nodes = self.nodes().nodes().iter();
        nodes.find(|(_, node)| node.mesh == Some(mesh)).map(|(id, _)| ObjectName::of(id))
    }

    /// The selection.
    #[must_use]
    pub fn selection(&self) -> &Selection {
        &self.state.selection
    }

    /// A number that changes with every edit and undo, and with every document that is opened: data
    /// computed from a document is valid as long as it is unchanged.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The history.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Sets the memory budget of the history, in bytes.
    pub fn set_history_budget(&mut self, bytes: usize) {
        self.history.set_budget(bytes);
    }

    /// The setting `memory`: how many bytes of memory a command may let a mesh take.
    #[must_use]
    pub fn memory(&self) -> u64 {
        self.state.memory.unwrap_or(EditMesh::MEMORY)
    }

    /// Sets the setting `memory`: how many bytes of memory a command may let a mesh take; [`EditMesh::MEMORY`] without.
    /// A command for which that is too little is refused before it allocates anything.
    pub fn set_memory(&mut self, bytes: u64) {
        self.state.memory = Some(bytes);
    }

    /// Runs a command: one entry in the history. A preview in progress is confirmed first, as by every change
    /// of the document ([`Self::preview`]).
    ///
    /// # Errors
    /// The command failed. The document is unchanged.
    pub fn run(&mut self, command: Command) -> Result<Outcome, EditError> {
        self.confirm();
        let (entry, outcome) = self.attempt(command)?;
        self.enter(entry);
        Ok(outcome)
    }

    /// Runs a command without an entry in the history. On an error the document is unchanged.
    fn attempt(&mut self, command: Command) -> Result<(Entry, Outcome), EditError> {
        self.attempt_as(command, |command, change| command.action().run(change))
    }

    /// The same for a command implemented by a function.
    fn attempt_as(
        &mut self,
        command: Command,
        work: impl FnOnce(&Command, &mut Change<'_>) -> Result<Outcome, EditError>,
    ) -> Result<(Entry, Outcome), EditError> {
        self.revision = next_revision();
        let selection = self.state.selection.clone();
        let mut change = Change { state: &mut self.state, meshes: Vec::new(), parts: None };
        let result =
            work(&command, &mut change).and_then(|outcome| change.check_placements().map(|()| outcome));
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

    /// Adds the last change to the history.
    fn enter(&mut self, entry: Entry) {
        self.note(|| Event::Run(Box::new(entry.command.clone())));
        self.history.push(entry);
    }

    /// Undoes the last command.
    ///
    /// # Errors
    /// There is nothing to undo.
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

    /// Redoes the command that was undone last.
    ///
    /// # Errors
    /// There is nothing to redo.
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

    /// Runs the last command that was not a selection again.
    ///
    /// # Errors
    /// There is none, or it fails now.
    pub fn repeat_last(&mut self) -> Result<Outcome, EditError> {
        self.confirm();
        let last = self.history.done().iter().rev().find(|entry| !entry.command.is_selection());
        let command = last.ok_or(EditError::Nothing("repeat"))?.command.clone();
        self.run(command)
    }

    /// Replaces the last command with another, usually the same with other parameters.
    ///
    /// # Errors
    /// There is none, or the other one fails: then the last one stays done.
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

    /// All commands that are done, to run again on the document as it was opened. Incomplete if
    /// entries were dropped ([`History::dropped`]).
    #[must_use]
    pub fn script(&self) -> Vec<Command> {
        self.history.done().iter().map(|entry| entry.command.clone()).collect()
    }

    /// The events since the last call, for a recovery file. The first call starts recording.
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
        // A command may change a mesh several times: undo goes backwards through them, redo
        // forwards.
        for (id, difference) in entry.meshes.iter_mut().rev() {
            if let Some(mesh) = self.state.file.edited.get_mut(id) {
                difference.apply(mesh);
                self.state.shown.note_difference(*id, mesh, difference);
            }
        }
        entry.meshes.reverse();
        if let Some(parts) = &mut entry.parts {
            self.state.file.native.scene.swap_parts(parts);
            self.state.shown.note_parts();
        }
        std::mem::swap(&mut self.state.selection, &mut entry.selection);
    }
}
