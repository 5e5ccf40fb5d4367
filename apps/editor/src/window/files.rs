//! Opening, saving and closing: nothing that was done is lost without a question.

use std::path::{Path, PathBuf};

use trigon_edit::scene::{Light, Material, Node, Scene};
use trigon_edit::{
    AssignTexture, Disk, Document, ImportFile, LeaveEditMode, ObjectName, Select, TextureSource, save,
};
use trigon_io::ExportOptions;
use trigon_window::Stage;
use trigon_window::scene::math::DVec3;
use trigon_window::scene::mesh::primitives;

use super::dialog::Purpose;
use super::editor::{Editor, Message, WELCOME};
use super::loading::{Loading, Outcome};
use super::look::Look;
use super::navigation;
use super::open_file::{Answer, Next, OpenFile, Question};
use super::recovery::{Left, Recovery};
use crate::export;
use crate::request::{FileAction, FileRequest};

/// From the right, above and before.
const HOME_DIRECTION: DVec3 = DVec3::new(-0.8, -0.6, -1.0);

/// Whether something is to be recovered.
pub(crate) fn offer_recovery(folder: Option<&Path>) -> Option<Question> {
    Left::find(folder?).into_iter().next().map(Question::Recover)
}

impl Editor {
    /// What is written on the window: the file, with a mark while something is not saved.
    pub(crate) fn title(&self) -> String {
        let mark = if self.file.is_unsaved() { "*" } else { "" };
        format!("{mark}{} - trigon", self.file.name())
    }

    /// Another document with a cube, as Blender starts.
    fn start_new(&mut self) {
        let mut scene = Scene::new();
        let cube = scene.add_object("Cube", primitives::cube(2.0), Material::default());
        let light = scene.add(Node::from_light(Light::point(100.0)));
        if let Some(node) = scene.node_mut(light) {
            node.name = "Light".into();
            node.transform.translate(DVec3::new(4.0, 6.0, 3.0));
        }
        self.take_document(Document::new(scene), None);
        // So that Tab and G work at once.
        self.run(Select { objects: vec![ObjectName::of(cube)], ..Select::default() }.into());
        self.message = Message::Info(WELCOME.into());
    }

    fn take_document(&mut self, document: Document, path: Option<PathBuf>) {
        self.replace_document(document);
        let folder = self.recovery_folder.as_deref();
        self.recovery =
            folder.and_then(|folder| Recovery::start(folder, &mut self.document, path.as_deref()));
        self.file = OpenFile::opened(path);
    }

    fn replace_document(&mut self, document: Document) {
        if let Some(recovery) = self.recovery.take() {
            recovery.close();
        }
        self.document = document;
        // Its numbers may be those of the one before.
        self.look = Look::default();
        (self.view.local, self.view.before_camera) = (None, None);
    }

    /// Does what was asked about files.
    pub(crate) fn file_request(&mut self, stage: &mut Stage, request: FileRequest) {
        self.cancel_tool(stage);
        match request {
            FileRequest::Ask(action) => self.ask(stage, action),
            FileRequest::Open(path) => self.unless_unsaved(stage, Next::Open(path)),
            FileRequest::SaveAs(path) => {
                let next = self.after_save.take();
                self.save_to(stage, with_extension(path), next);
            }
            FileRequest::Import(path) => self.import(stage, path),
            FileRequest::Texture { material, slot, path } => {
                let texture = Some(TextureSource::File { path: path.to_string_lossy().into_owned() });
                let material = Some(material);
                self.run(AssignTexture { material, slot, texture, ..AssignTexture::default() }.into());
            }
            FileRequest::Export(path) => self.export(&with_extension(path)),
        }
    }

    fn ask(&mut self, stage: &mut Stage, action: FileAction) {
        self.after_save = None;
        match action {
            FileAction::New => self.unless_unsaved(stage, Next::New),
            FileAction::Quit => self.unless_unsaved(stage, Next::Quit),
            FileAction::Save => match self.native_path() {
                Some(path) => self.save_to(stage, path, None),
                None => self.ask(stage, FileAction::SaveAs),
            },
            other => {
                if let Some(purpose) = Purpose::of(other) {
                    let path = self.file.path.as_deref().map(|path| path.with_extension("glb"));
                    let path = path.filter(|_| purpose == Purpose::SaveAs).unwrap_or_default();
                    self.dialog.ask(purpose, path.display().to_string());
                }
            }
        }
    }

    /// The document's file, if it is one that the editor writes.
    fn native_path(&self) -> Option<PathBuf> {
        let is_native = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "glb");
        self.file.path.clone().filter(is_native)
    }

    fn unless_unsaved(&mut self, stage: &mut Stage, next: Next) {
        if self.file.is_unsaved() {
            self.question = Some(Question::Unsaved(next));
        } else {
            self.go_on(stage, next);
        }
    }

    /// Replaces the document, or closes the window.
    pub(crate) fn go_on(&mut self, stage: &mut Stage, next: Next) {
        match next {
            Next::New => {
                self.start_new();
                self.look_at_all(stage);
                // The view turns around what is modelled first, and has room for what will be added.
                stage.orbit.set_target(DVec3::ZERO);
                stage.orbit.zoom(0.55);
                stage.set_home(stage.orbit);
            }
            Next::Open(path) => {
                let waker = stage.waker();
                self.loading = Some(Loading::start(path, move || waker.wake()));
            }
            Next::Quit => {
                if let Some(recovery) = self.recovery.take() {
                    recovery.close();
                }
                stage.exit();
            }
        }
    }

    fn look_at_all(&mut self, stage: &mut Stage) {
        self.show(stage);
        stage.orbit.look_along(HOME_DIRECTION);
        navigation::frame_all(self, stage);
        stage.set_home(stage.orbit);
    }

    /// A load has ended.
    pub(crate) fn loaded(&mut self, stage: &mut Stage, path: &Path, outcome: Outcome) {
        match outcome {
            Ok((document, warnings)) => {
                self.take_document(document, Some(path.to_owned()));
                self.recent.add(path);
                let warned = match &warnings[..] {
                    [] => String::new(),
                    [first, ..] => format!(" with {} warnings: {first}", warnings.len()),
                };
                self.message = Message::Info(format!("Opened {}{warned}", path.display()));
                self.look_at_all(stage);
            }
            Err(error) => self.give_up_loading(stage, Message::Refusal(error)),
        }
    }

    /// Nothing is loaded: what was open stays, and at the start there is a cube.
    pub(crate) fn give_up_loading(&mut self, stage: &mut Stage, message: Message) {
        if self.document.nodes().nodes().is_empty() {
            self.go_on(stage, Next::New);
        }
        self.message = message;
    }

    /// Saves, unless something would be lost that nobody was asked about.
    fn save_to(&mut self, stage: &mut Stage, path: PathBuf, next: Option<Next>) {
        let losses: Vec<String> = match self.document.encode() {
            Ok(file) => file.what_would_be_lost().iter().map(ToString::to_string).collect(),
            Err(error) => {
                self.message = Message::Refusal(error.to_string());
                return;
            }
        };
        if losses.is_empty() {
            self.write(stage, path, next);
        } else {
            self.question = Some(Question::Losses { path, losses, next });
        }
    }

    fn write(&mut self, stage: &mut Stage, path: PathBuf, next: Option<Next>) {
        let encoded = self.document.encode().map_err(|error| error.to_string());
        let written = encoded
            .and_then(|file| save(&mut Disk, &path, &file.to_bytes()).map_err(|error| error.to_string()));
        match written {
            Ok(()) => {
                self.message = Message::Info(format!("Saved {}", path.display()));
                self.recent.add(&path);
                self.file.saved_as(path);
                if let Some(next) = next {
                    self.go_on(stage, next);
                }
            }
            Err(error) => self.message = Message::Refusal(error),
        }
    }

    fn export(&mut self, path: &Path) {
        let written = export::format_by_ending(path)
            .and_then(|format| export::write_as(&self.document, format, path, &ExportOptions::default()));
        self.message = match written {
            Ok(losses) if losses.is_empty() => Message::Info(format!("Exported {}", path.display())),
            Ok(losses) => {
                let (first, count) = (&losses[0], losses.len());
                Message::Info(format!("Exported {}; {count} things are lost: {first}", path.display()))
            }
            Err(error) => Message::Refusal(error),
        };
    }

    /// Adds what a file holds, as a command: the recovery file names it as it is found from anywhere.
    fn import(&mut self, stage: &mut Stage, path: PathBuf) {
        let path = std::path::absolute(&path).unwrap_or(path);
        if self.document.selection().is_editing() {
            self.run(LeaveEditMode {}.into());
        }
        self.run(ImportFile { path: path.to_string_lossy().into_owned() }.into());
        self.show(stage);
    }

    /// Goes on after a question.
    pub(crate) fn answer(&mut self, stage: &mut Stage, answer: Answer) {
        let Some(question) = self.question.take() else { return };
        match (question, answer) {
            (Question::Unsaved(next), Answer::Yes) => self.save_then(stage, next),
            (Question::Unsaved(next), Answer::No) => self.go_on(stage, next),
            (Question::Losses { path, next, .. }, Answer::Yes) => self.write(stage, path, next),
            (Question::Recover(left), Answer::Yes) => self.recover(stage, &left),
            (Question::Recover(left), Answer::No) => left.discard(),
            (_, Answer::No | Answer::Cancel) => {}
        }
        self.show(stage);
    }

    fn save_then(&mut self, stage: &mut Stage, next: Next) {
        match self.native_path() {
            Some(path) => self.save_to(stage, path, Some(next)),
            None => {
                self.ask(stage, FileAction::SaveAs);
                self.after_save = Some(next);
            }
        }
    }

    fn recover(&mut self, stage: &mut Stage, left: &Left) {
        match left.recover() {
            Ok((document, log)) => {
                self.replace_document(document);
                let (folder, path) = (self.recovery_folder.as_deref(), left.document.clone());
                self.recovery = folder
                    .and_then(|folder| Recovery::resume(folder, &mut self.document, log, path.as_deref()));
                self.file = OpenFile::opened(path);
                self.file.changed();
                left.discard();
                self.message = Message::Info("Recovered what was not saved; save it now".into());
                self.show(stage);
                navigation::frame_all(self, stage);
            }
            Err(error) => self.message = Message::Refusal(format!("Recovery: {error}")),
        }
    }
}

/// A name without an extension gets that of the format that is written.
fn with_extension(path: PathBuf) -> PathBuf {
    if path.extension().is_none() { path.with_extension("glb") } else { path }
}
