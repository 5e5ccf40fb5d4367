//! Opening, saving and closing: no work is lost without a question.

use std::path::{Path, PathBuf};

use trigon_document::scene::{Light, Material, Node, Scene};
use trigon_document::{AssignTexture, Document, LeaveEditMode, ObjectName, Select, TextureSource};
use trigon_window::Stage;
use trigon_window::scene::math::DVec3;
use trigon_window::scene::mesh::primitives;

use super::dialog::Purpose;
use super::editor::{Editor, Message, WELCOME};
use super::file_version::FileVersion;
use super::loading::{Found, LoadPurpose, Loading, Outcome};
use super::loading::{SaveOrder, Saved, Saving};
use super::navigation;
use super::open_file::{Answer, Next, OpenFile, Question};
use super::panels::Report;
use super::recovery::{Left, Recovery, set_damaged_aside};
use super::settings::{Look, ToolSettings};
use crate::export;
use crate::request::{FileAction, FileRequest, ImageKind};

/// From the right, above and before.
const HOME_DIRECTION: DVec3 = DVec3::new(-0.8, -0.6, -1.0);

/// Whether something is to be recovered.
pub(crate) fn offer_recovery(folder: Option<&Path>) -> Option<Question> {
    Left::find(folder?).into_iter().next().map(Question::Recover)
}

/// What is said of recovery files that cannot be used, once.
pub(crate) fn damaged_recovery(folder: Option<&Path>) -> Option<String> {
    let aside = set_damaged_aside(folder?);
    let (first, more) = (aside.first()?.display(), aside.len() - 1);
    let others = if more == 0 { String::new() } else { format!(" and {more} more") };
    Some(format!("Recovery: nothing in {first}{others} can be read; open the file that was saved last"))
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
        let light = scene.add(Node::from_light(Light::point(45.0)));
        if let Some(node) = scene.node_mut(light) {
            node.name = "Light".into();
            node.transform.translate(DVec3::new(4.0, 6.0, 3.0));
        }
        self.take_document(Document::new(scene), None);
        self.tools = ToolSettings::default();
        // So that Tab and G work at once.
        self.run(Select { objects: vec![ObjectName::of(cube)], ..Select::default() }.into());
        self.message = Message::Hint(WELCOME.into());
    }

    /// Another document replaces the open one.
    pub(crate) fn take_document(&mut self, document: Document, path: Option<PathBuf>) {
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
        let memory = std::mem::replace(&mut self.document, document).memory();
        self.document.set_memory(memory);
        // Its numbers may be those of the one before.
        self.look = Look::default();
        self.images.forget();
        (self.view.local, self.view.before_local, self.view.camera) = (None, None, None);
    }

    /// Carries out a request about files.
    pub(crate) fn file_request(&mut self, stage: &mut Stage, request: FileRequest) {
        self.cancel_tool(stage);
        match request {
            FileRequest::Ask(action) => self.ask(stage, action),
            FileRequest::Open(path) => self.unless_unsaved(stage, Next::Open(path)),
            FileRequest::SaveAs(path) => {
                let next = self.after_save.take();
                let path = with_extension(path);
                if is_native(&path) {
                    self.save_to(stage, path, next);
                } else {
                    // Under another ending no program would read it.
                    let name = path.display();
                    self.message = Message::Refusal(format!(
                        "{name}: documents are saved as .glb; File, Export writes other formats"
                    ));
                }
            }
            FileRequest::Import(path) => self.import(stage, path),
            FileRequest::Texture { material, slot, path } => {
                let texture = Some(TextureSource::File { path: path.to_string_lossy().into_owned() });
                let material = Some(material);
                self.run(AssignTexture { material, slot, texture, ..AssignTexture::default() }.into());
                self.show_images();
                self.show(stage);
            }
            FileRequest::Reference(path) => self.add_reference(stage, &path),
            FileRequest::Export(path) => self.export(&with_extension(path)),
            FileRequest::SaveImage { kind, path } => self.save_image(stage, kind, path),
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
                    self.dialog.exchange.measure(&mut self.document);
                    let suggestion = self.suggestion(&purpose);
                    self.dialog.ask(purpose, &suggestion);
                }
            }
        }
    }

    /// Under which name something is written first; for what is read none is better than another.
    pub(super) fn suggestion(&self, purpose: &Purpose) -> PathBuf {
        let path = self.file.path.as_deref().unwrap_or(Path::new("untitled"));
        match purpose {
            Purpose::SaveAs => path.with_extension("glb"),
            Purpose::Export => path.with_extension("obj"),
            Purpose::Image(ImageKind::UvLayout) => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                path.with_file_name(format!("{stem}-uv.png"))
            }
            Purpose::Image(_) => path.with_extension("png"),
            _ => PathBuf::new(),
        }
    }

    /// The document's file, if it is one that the editor writes.
    fn native_path(&self) -> Option<PathBuf> {
        self.file.path.clone().filter(|path| is_native(path))
    }

    fn unless_unsaved(&mut self, stage: &mut Stage, next: Next) {
        if self.file.is_unsaved() && !self.file.is_being_saved() {
            self.question = Some(Question::Unsaved(next));
        } else {
            self.go_on(stage, next);
        }
    }

    /// Replaces the document, or closes the window; after the current save, if there is one.
    pub(crate) fn go_on(&mut self, stage: &mut Stage, next: Next) {
        if let Some(saving) = &mut self.saving {
            saving.order.next = Some(next);
            return;
        }
        match next {
            Next::New => {
                self.start_new();
                self.look_at_all(stage);
                // Room for what will be added, and for the light.
                stage.orbit.zoom(0.3);
                stage.set_home(stage.orbit);
            }
            Next::Open(path) => self.load(stage, path, LoadPurpose::Open),
            Next::Quit => {
                if let Some(recovery) = self.recovery.take() {
                    recovery.close();
                }
                stage.exit();
            }
        }
    }

    /// Takes the whole scene into view, which becomes the one to return to.
    pub(crate) fn look_at_all(&mut self, stage: &mut Stage) {
        self.show(stage);
        stage.orbit.look_along(HOME_DIRECTION);
        navigation::frame_all(stage);
        stage.set_home(stage.orbit);
    }

    fn load(&mut self, stage: &Stage, path: PathBuf, purpose: LoadPurpose) {
        let waker = stage.waker();
        self.loading =
            Some(Loading::start(path, purpose, self.dialog.exchange.import_up, move || waker.wake()));
    }

    /// A load has ended; the next one begins.
    pub(crate) fn loaded(
        &mut self,
        stage: &mut Stage,
        path: &Path,
        version: Option<FileVersion>,
        outcome: Outcome,
    ) {
        match outcome {
            Ok(Found::Document(document, warnings)) => {
                self.take_document(*document, Some(path.to_owned()));
                self.file = std::mem::take(&mut self.file).of_version(version);
                self.recent.add(path);
                let warned = match &warnings[..] {
                    [] => String::new(),
                    [only] => format!(" with a warning: {only}"),
                    [first, ..] => format!(" with {} warnings: {first}", warnings.len()),
                };
                self.message = Message::Info(format!("Opened {}{warned}", path.display()));
                self.notice_others();
                self.look_at_all(stage);
            }
            Ok(Found::Import(loaded)) => {
                let imported = self.document.import(path.to_string_lossy().into_owned(), &loaded);
                let is_added = imported.is_ok();
                self.ended("Import", false, imported);
                self.show(stage);
                if is_added {
                    navigation::frame_selected(self, stage);
                }
            }
            Err(error) => self.give_up_loading(stage, Message::Refusal(error)),
        }
        if let Some(path) = self.to_import.pop_front() {
            self.load(stage, path, LoadPurpose::Import);
        }
    }

    /// The window has the keyboard again: says what other programs have done to the file meanwhile.
    pub(crate) fn notice_others(&mut self) {
        let Some(path) = self.file.path.as_ref().map(|path| path.display().to_string()) else { return };
        if self.file.notices_change() {
            let text = format!(
                "{path} was changed by another program; Save asks whether to overwrite, reload or save elsewhere"
            );
            self.message = Message::Refusal(text);
        } else if self.recovery.as_mut().is_some_and(Recovery::notices_other_editor) {
            let text = format!(
                "{path} is open in another editor, too; the one that saves last asks before it overwrites"
            );
            self.message = Message::Refusal(text);
        }
    }

    /// Nothing is loaded: what was open stays, and at the start there is a cube.
    pub(crate) fn give_up_loading(&mut self, stage: &mut Stage, message: Message) {
        if self.document.nodes().nodes().is_empty() {
            self.go_on(stage, Next::New);
        }
        self.message = message;
    }

    /// Saves, unless something would be lost that the user has not confirmed.
    fn save_to(&mut self, stage: &Stage, path: PathBuf, next: Option<Next>) {
        self.save(stage, SaveOrder { path, accepts_losses: false, overwrites: false, next });
    }

    /// Starts to save the document as it is now, or as soon as the current save has ended.
    fn save(&mut self, stage: &Stage, order: SaveOrder) {
        if self.saving.is_some() {
            self.to_save = Some(order);
            return;
        }
        if !order.overwrites && self.file.would_overwrite(&order.path) {
            self.question = Some(Question::ChangedOnDisk(order));
            return;
        }
        let waker = stage.waker();
        self.file.begins_save();
        if let Some(error) = self.recovery.as_mut().and_then(|it| it.save_begins(&mut self.document)) {
            self.message = Message::Refusal(error);
        }
        self.saving =
            Some(Saving::start(order, self.document.snapshot(), (self.storage)(), move || waker.wake()));
    }

    /// A save has ended; what waited for that follows.
    pub(crate) fn saved(&mut self, stage: &mut Stage, outcome: Saved) {
        let Some(Saving { order: SaveOrder { path, next, .. }, .. }) = self.saving.take() else { return };
        self.file.ended_save((outcome == Saved::Written).then(|| path.clone()));
        let next = match outcome {
            Saved::Written => {
                self.message = Message::Info(format!("Saved {}", path.display()));
                self.recent.add(&path);
                if let Some(recovery) = &mut self.recovery {
                    recovery.saved(&path);
                }
                next
            }
            Saved::WouldLose(losses) => {
                self.question = Some(Question::Losses { path, losses, next });
                None
            }
            Saved::Failed(error) => {
                self.message = Message::Refusal(error);
                None
            }
        };
        if let Some(order) = self.to_save.take() {
            self.save(stage, order);
        }
        if let Some(next) = next {
            self.go_on(stage, next);
        }
        self.show(stage);
    }

    /// Whether the document is closed as soon as it is saved: what was done now would be lost.
    pub(crate) fn closes_after_save(&self) -> bool {
        let orders = self.saving.iter().map(|saving| &saving.order).chain(&self.to_save);
        orders.into_iter().any(|order| order.next.is_some())
    }

    /// Saves, and closes nothing.
    pub(crate) fn stay_open(&mut self) {
        let orders = self.saving.iter_mut().map(|saving| &mut saving.order).chain(&mut self.to_save);
        orders.for_each(|order| order.next = None);
    }

    fn export(&mut self, path: &Path) {
        let exchange = &self.dialog.exchange;
        if exchange.export.selection_only && exchange.extents.selected.is_none() {
            let text = "Export: nothing with faces is selected; select objects, or switch off Selection only";
            return self.message = Message::Refusal(text.into());
        }
        let choices = exchange.export;
        let written = export::format_by_ending(path).and_then(|format| {
            let options = choices.for_format(format).options(&self.document);
            export::write_as(&self.document, format, path, &options)
        });
        self.message = match written {
            Ok(losses) if losses.is_empty() => Message::Info(format!("Exported {}", path.display())),
            Ok(lines) => {
                let lost = match lines.len() {
                    1 => "1 thing is".to_owned(),
                    count => format!("{count} things are"),
                };
                let text = format!("Exported {}; {lost} not in it", path.display());
                self.report = Some(Report { title: text.clone(), lines });
                Message::Info(text)
            }
            Err(error) => Message::Refusal(error),
        };
    }

    /// Adds what a file holds, as a command: the recovery file names it as it is found from anywhere.
    fn import(&mut self, stage: &mut Stage, path: PathBuf) {
        let path = std::path::absolute(&path).unwrap_or(path);
        if self.document.selection().is_editing() {
            self.run(LeaveEditMode {}.into());
            self.show(stage);
        }
        match self.loading {
            Some(_) => self.to_import.push_back(path),
            None => self.load(stage, path, LoadPurpose::Import),
        }
    }

    /// Goes on after a question.
    pub(crate) fn answer(&mut self, stage: &mut Stage, answer: Answer) {
        let Some(question) = self.question.take() else { return };
        match (question, answer) {
            (Question::Unsaved(next), Answer::Yes) => self.save_then(stage, next),
            (Question::Unsaved(next), Answer::No) => self.go_on(stage, next),
            (Question::Losses { path, next, .. }, Answer::Yes) => {
                self.save(stage, SaveOrder { path, accepts_losses: true, overwrites: true, next });
            }
            (Question::ChangedOnDisk(order), Answer::Yes) => {
                self.save(stage, SaveOrder { overwrites: true, ..order });
            }
            (Question::ChangedOnDisk(order), Answer::SaveAs) => {
                self.ask(stage, FileAction::SaveAs);
                self.after_save = order.next;
            }
            (Question::ChangedOnDisk(order), Answer::Reload) => {
                self.go_on(stage, Next::Open(order.path));
            }
            (Question::Recover(left), Answer::Yes) => self.recover(stage, &left),
            (Question::Recover(left), Answer::No) => left.discard(),
            (Question::Up, Answer::Up(up)) => self.preferences.change(|settings| settings.up = Some(up)),
            (_, _) => {}
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
                self.message = Message::Info(recovered(left));
                self.show(stage);
                navigation::frame_all(stage);
            }
            Err(error) => self.message = Message::Refusal(format!("Recovery: {error}")),
        }
    }
}

/// Whether it is the name of a file that a document is saved to.
fn is_native(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("glb"))
}

/// What is said of a document that has come back.
fn recovered(left: &Left) -> String {
    let missing =
        if left.is_cut_off { " except the last actions, which the recovery file lacks" } else { "" };
    match &left.document {
        Some(path) if is_native(path) => {
            format!("Recovered unsaved work{missing}; Save writes it to {}", path.display())
        }
        Some(path) => format!("Recovered unsaved work{missing} on {}; Save asks for a GLB", path.display()),
        None => format!("Recovered unsaved work{missing}; it has no file yet, and Save asks for a name"),
    }
}

/// A name without an extension gets that of the format that is written.
fn with_extension(path: PathBuf) -> PathBuf {
    if path.extension().is_none() { path.with_extension("glb") } else { path }
}
