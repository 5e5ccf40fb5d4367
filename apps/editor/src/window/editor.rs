//! The editor's state, and the execution of requests.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use trigon_document::{
    Command, Disk, Document, EditError, EditObjects, Glb, LeaveEditMode, ObjectName, Outcome, Select,
    SetElementKind, Storage, scene::NodeId,
};
use trigon_window::egui::Rect;
use trigon_window::scene::math::DVec2;
use trigon_window::{RecentFiles, Stage};

use super::actions;
use super::button_start::Click;
use super::dialog::{FileWindow, Purpose};
use super::gizmo_cache::GizmoCache;
use super::images::Images;
use super::keys::Keys;
use super::loading::Loading;
use super::loading::{SaveOrder, Saving};
use super::open_file::{Next, OpenFile, Question};
use super::panels::{Panels, Rename, Report, Search};
use super::pointing::Pointing;
use super::popup::Popup;
use super::preferences::Preferences;
use super::recovery::Recovery;
use super::running::Running;
use super::settings::Look;
use super::settings::{self, Layout, ToolSettings, ViewState};
use crate::request::{Request, ToolKind, UiRequest};
use crate::up::Up;
use crate::uv::UvView;

/// What the status line says until the next action.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Message {
    /// What is not worth a look: how to begin, and what a click selected.
    Hint(String),
    /// What was done.
    Info(String),
    /// Why something was not done.
    Refusal(String),
}

/// The hint of a first start.
pub(crate) const WELCOME: &str =
    "Middle drag or Alt+left drag orbits, the wheel zooms; click selects, Tab edits; F3 finds every command";

/// Sizes of text, as factors: above them the panels leave no room for the view.
const TEXT_SIZES: [f32; 7] = [0.64, 0.8, 1.0, 1.25, 1.5, 1.75, 2.0];

/// The size that is so many steps larger than the nearest one.
fn next_size(size: f32, steps: isize) -> f32 {
    let off = |at: &usize| (TEXT_SIZES[*at] - size).abs();
    let nearest = (0..TEXT_SIZES.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or_default();
    TEXT_SIZES[nearest.saturating_add_signed(steps).min(TEXT_SIZES.len() - 1)]
}

/// What is said of a command and its outcome.
fn said(name: &str, message: &str) -> String {
    if message.is_empty() { name.to_owned() } else { format!("{name}: {message}") }
}

/// A document in a window.
pub(crate) struct Editor {
    pub(crate) document: Document,
    pub(crate) file: OpenFile,
    pub(crate) keys: Keys,
    pub(crate) tools: ToolSettings,
    pub(crate) view: ViewState,
    pub(crate) layout: Layout,
    pub(crate) preferences: Preferences,
    pub(crate) message: Message,
    pub(crate) popup: Option<Popup>,
    pub(crate) search: Option<Search>,
    pub(crate) report: Option<Report>,
    pub(crate) rename: Option<Rename>,
    pub(crate) question: Option<Question>,
    pub(crate) dialog: FileWindow,
    /// What is rendered, and images that are written.
    pub(crate) images: Images,
    /// The file that is being loaded.
    pub(crate) loading: Option<Loading>,
    /// Files to be imported after it.
    pub(crate) to_import: VecDeque<PathBuf>,
    /// The document as it is being saved.
    pub(crate) saving: Option<Saving>,
    /// What is to be saved after that.
    pub(crate) to_save: Option<SaveOrder>,
    /// Where files are saved.
    pub(crate) storage: Box<dyn Fn() -> Box<dyn Storage + Send>>,
    /// What follows when a document without a file has got one.
    pub(crate) after_save: Option<Next>,
    pub(crate) recent: RecentFiles,
    pub(crate) recovery: Option<Recovery>,
    pub(crate) panels: Panels,
    /// The tool that follows the pointer.
    pub(crate) tool: Option<Running>,
    pub(crate) look: Look,
    pub(crate) gizmo_cache: GizmoCache,
    pub(crate) uv: UvView,
    /// What no panel covers of the window, in points, once that is known.
    pub(crate) free: Option<Rect>,
    pub(crate) pointing: Pointing,
    /// A press of the left button that has not become anything yet.
    pub(crate) click: Option<Click>,
    /// Where the pointer was last, in physical pixels.
    pub(crate) pointer: Option<DVec2>,
    /// What was copied last: a GLB.
    pub(crate) copied: Option<Glb>,
    /// Where files of recovery are kept.
    pub(crate) recovery_folder: Option<PathBuf>,
    /// What is said when the window is open, such as chords of the user's keymap that cannot be used.
    pub(crate) notes: Vec<String>,
    /// The files of the command line, until the window is open.
    pub(crate) to_open: Vec<PathBuf>,
}

impl Editor {
    /// An editor that remembers what it has to in a folder, and opens the first of these files and imports the
    /// others.
    pub(crate) fn new(keys: Keys, folder: Option<PathBuf>, to_open: Vec<PathBuf>) -> Self {
        Self {
            document: Document::default(),
            file: OpenFile::default(),
            keys,
            tools: ToolSettings::default(),
            view: ViewState::default(),
            layout: Layout::default(),
            preferences: Preferences::load(folder.as_ref().map(|folder| folder.join("editor.json"))),
            message: Message::Hint(WELCOME.into()),
            popup: None,
            search: None,
            report: None,
            rename: None,
            question: None,
            dialog: FileWindow::default(),
            images: Images::default(),
            loading: None,
            to_import: VecDeque::new(),
            saving: None,
            to_save: None,
            storage: Box::new(|| Box::new(Disk)),
            after_save: None,
            recent: RecentFiles::load(folder.as_ref().map(|folder| folder.join("edited"))),
            recovery: None,
            panels: Panels::default(),
            tool: None,
            look: Look::default(),
            gizmo_cache: GizmoCache::default(),
            uv: UvView::default(),
            free: None,
            pointing: Pointing::default(),
            click: None,
            pointer: None,
            copied: None,
            recovery_folder: folder.as_deref().map(|folder: &Path| folder.join("recovery")),
            notes: Vec::new(),
            to_open,
        }
    }

    /// Carries out the requests, and shows the resulting document.
    pub(crate) fn perform(&mut self, stage: &mut Stage, request: Request) {
        let is_shown = !matches!(request, Request::Ui(request) if request.is_about_window());
        match request {
            Request::Run(command) => self.run(command),
            Request::Adjust(command) => self.adjust(command),
            Request::Undo => self.undo(),
            Request::Redo => self.redo(),
            Request::RepeatLast => self.repeat(),
            Request::ChooseTexture { material, slot } => {
                self.dialog.ask(Purpose::Texture(material, slot), Path::new(""));
            }
            Request::Compare(comparison) => stage.comparison = comparison,
            Request::Refine(refinement) => stage.refinement = refinement,
            Request::StartTool(tool) => self.start_tool(stage, tool),
            Request::View(request) => self.navigate(stage, request),
            Request::File(request) => self.file_request(stage, request),
            Request::Ui(request) => self.ui_request(stage, request),
        }
        // The image is drawn again only where it may be another one.
        if is_shown {
            self.show(stage);
        }
    }

    /// Brings the document onto the stage, and what was done into the recovery file.
    pub(crate) fn show(&mut self, stage: &mut Stage) {
        if let Some(recovery) = &mut self.recovery
            && let Some(error) = recovery.follow(&mut self.document)
        {
            self.message = Message::Refusal(error);
        }
        self.show_document(stage);
        stage.set_title(self.title());
    }

    /// Runs a command, and says what has come of it.
    pub(crate) fn run(&mut self, command: Command) {
        let (selects, name) = (command.is_selection(), command.name());
        let outcome = self.document.run(command);
        self.ended(name, selects, outcome);
    }

    /// Says what has come of a command.
    pub(crate) fn ended(&mut self, name: &str, selects: bool, outcome: Result<Outcome, EditError>) {
        match outcome {
            Ok(outcome) => {
                self.file.ran(selects);
                let text = said(name, &outcome.message);
                self.message = match &outcome.warnings[..] {
                    [] if selects => Message::Hint(text),
                    [] => Message::Info(text),
                    warnings => Message::Refusal(format!("{text}. {}", warnings.join(". "))),
                };
            }
            Err(refusal) => self.message = Message::Refusal(refusal.to_string()),
        }
    }

    pub(crate) fn done(&mut self, name: &str, message: &str) {
        self.message = Message::Info(said(name, message));
    }

    fn adjust(&mut self, command: Command) {
        let (selects, name) = (command.is_selection(), command.name());
        match self.document.adjust_last(command) {
            Ok(outcome) => {
                if !selects {
                    self.file.changed();
                }
                self.done(name, &outcome.message);
            }
            Err(refusal) => self.message = Message::Refusal(refusal.to_string()),
        }
    }

    fn undo(&mut self) {
        let last = self.document.history().done().last().map(|entry| entry.command());
        let (selects, name) = last.map_or((true, ""), |command| (command.is_selection(), command.name()));
        match self.document.undo() {
            Ok(()) => {
                self.file.undid(selects);
                self.message = Message::Info(format!("Undo: {name}"));
            }
            Err(refusal) => self.message = Message::Refusal(refusal.to_string()),
        }
    }

    fn redo(&mut self) {
        let next = self.document.history().undone().first().map(|entry| entry.command());
        let (selects, name) = next.map_or((true, ""), |command| (command.is_selection(), command.name()));
        match self.document.redo() {
            Ok(()) => {
                self.file.redid(selects);
                self.message = Message::Info(format!("Redo: {name}"));
            }
            Err(refusal) => self.message = Message::Refusal(refusal.to_string()),
        }
    }

    fn repeat(&mut self) {
        match self.document.repeat_last() {
            Ok(outcome) => {
                self.file.ran(false);
                self.done("Repeat", &outcome.message);
            }
            Err(refusal) => self.message = Message::Refusal(refusal.to_string()),
        }
    }

    fn ui_request(&mut self, stage: &mut Stage, request: UiRequest) {
        match request {
            UiRequest::Popup(menu) => self.popup = Some(Popup::new(menu)),
            UiRequest::Search => self.search = Some(Search::default()),
            UiRequest::Help => self.layout.help = !self.layout.help,
            UiRequest::AdjustPanel => self.layout.adjust = !self.layout.adjust,
            UiRequest::ToggleEditMode => self.toggle_edit_mode(stage),
            UiRequest::Select { kind, extend } => self.run(SetElementKind { kind, extend }.into()),
            UiRequest::Rip { fill } => self.rip(stage, fill),
            UiRequest::ExtrudeAlongNormals => self.extrude_along_normals(stage),
            UiRequest::ProjectFromView => self.project_from_view(stage),
            UiRequest::ToolBar => self.layout.tool_bar = !self.layout.tool_bar,
            UiRequest::SideBar => self.layout.side_bar = !self.layout.side_bar,
            UiRequest::UvView => self.uv.is_open = !self.uv.is_open,
            UiRequest::Copy => self.copy(),
            UiRequest::Paste => self.paste(),
            UiRequest::Placing(placing) => self.snap(placing),
            UiRequest::OriginToCursor => self.origin_to_cursor(),
            UiRequest::Up(_)
            | UiRequest::Theme(_)
            | UiRequest::Development
            | UiRequest::EmulateMouse
            | UiRequest::EmulateNumpad
            | UiRequest::LargerText
            | UiRequest::NormalText
            | UiRequest::SmallerText => self.change_preferences(stage, request),
            UiRequest::Snapping => self.tools.snapping = !self.tools.snapping,
            UiRequest::Snap(target) => self.tools.snap_target = target,
            UiRequest::SnapWith(source) => self.tools.snap_source = source,
            UiRequest::Proportional => self.tools.proportional = !self.tools.proportional,
            UiRequest::Pivot(pivot) => self.tools.pivot = pivot,
            UiRequest::Gizmo(kind) => self.tools.gizmo = kind,
            UiRequest::Orientation(orientation) => self.tools.orientation = orientation,
            UiRequest::LinkedAtPointer => self.select_linked(stage),
            UiRequest::Parent { keeps_transform } => self.set_parent(keeps_transform),
            UiRequest::Rename => self.rename = Rename::of_active(&self.document),
        }
    }

    fn change_preferences(&mut self, stage: &mut Stage, request: UiRequest) {
        self.preferences.change(|settings| match request {
            UiRequest::Up(up) => settings.up = Some(up),
            UiRequest::Theme(theme) => settings.theme = theme,
            UiRequest::Development => settings.development = !settings.development,
            UiRequest::EmulateMouse => settings.emulates_mouse = !settings.emulates_mouse,
            UiRequest::EmulateNumpad => settings.emulates_numpad = !settings.emulates_numpad,
            UiRequest::LargerText => settings.text_scale = next_size(settings.text_scale, 1),
            UiRequest::SmallerText => settings.text_scale = next_size(settings.text_scale, -1),
            UiRequest::NormalText => settings.text_scale = 1.0,
            _ => {}
        });
        self.apply_preferences(stage);
    }

    /// The axis that is up on the screen.
    pub(crate) fn up(&self) -> Up {
        self.preferences.get().up.unwrap_or_default()
    }

    /// Sets up the stage and the keys as users have it.
    pub(crate) fn apply_preferences(&mut self, stage: &mut Stage) {
        let settings = self.preferences.get();
        stage.keymap = settings::drags(settings.emulates_mouse);
        stage.theme = settings.theme;
        stage.text_scale = settings.text_scale.clamp(0.5, 4.0);
        self.keys.emulates_numpad = settings.emulates_numpad;
    }

    /// Without a mesh among what is selected, what is under the pointer is edited, or else all.
    fn toggle_edit_mode(&mut self, stage: &Stage) {
        if self.document.selection().is_editing() {
            return self.run(LeaveEditMode {}.into());
        }
        let scene = self.document.nodes();
        let has_mesh = |id: &NodeId| scene.node(*id).is_some_and(|node| node.mesh.is_some());
        if !self.document.selection().objects.iter().any(has_mesh) {
            let hit = self.pointer.and_then(|at| stage.pick(at)).map(|(hit, _)| hit.node);
            let under = hit.filter(has_mesh).map(|id| vec![id]);
            let visible = scene.nodes().iter().filter(|(_, node)| node.visible);
            let all = visible.map(|(id, _)| id).filter(has_mesh);
            let objects = under.unwrap_or_else(|| all.collect());
            if !objects.is_empty() {
                let objects = objects.into_iter().map(ObjectName::of).collect();
                self.run(Select { objects, ..Select::default() }.into());
            }
        }
        self.run(EditObjects::default().into());
    }

    /// Does what an action of the table does, or says why it cannot.
    pub(crate) fn choose(&mut self, stage: &mut Stage, action: &actions::Action) {
        match action.refusal(&self.document) {
            Some(reason) => self.message = Message::Refusal(format!("{}: {reason}", action.label)),
            None => {
                let before = self.entries();
                let request = match action.request() {
                    Request::Run(command) => Request::Run(self.in_space(command)),
                    request => request,
                };
                self.perform(stage, request);
                if action.makes_copies() && self.entries() > before {
                    self.start_tool(stage, ToolKind::Move);
                }
            }
        }
    }
}
