//! The viewer's part of the window: the current model, loading, and the viewer's own keys.

mod overlays;
mod state;

use std::path::PathBuf;

use trigon_camera::{Orbit, OrbitStyle};
use trigon_io::Warning;
use trigon_math::DVec3;
use trigon_scene::{Background, Frame, NodeId, RenderSettings, Scene};
use trigon_window::{Animation, Corner, Handler, Hands, Input, Key, Modifiers, Stage, Taken, Tick, egui};

use super::axes::AxesOverlay;
use super::background::{Loading, Outcome};
#[cfg(feature = "study")]
use super::classic::Classics;
use super::commands::Command;
use super::comparing::Comparing;
use super::measuring::Measuring;
use super::open::{OpenWindow, SystemDialog};
use super::overlay_commands::OverlayCommand;
use super::playback::Playback;
use super::quality::QualityPanel;
use super::recent::Recent;
use super::side::SidePanel;
use super::watch::Watch;
use super::{screenshot, title};
use crate::args::{InteractionStyle, Request};
use crate::failure::Failure;
use crate::model::{Model, Source, Summary};
use crate::picture;
use crate::report::Reporter;

/// What happens to the view when another model comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum View {
    /// It is fitted to the model.
    Fit,
    /// It stays.
    Keep,
}

/// The model on the screen.
struct Shown {
    /// Its scene is on the stage.
    source: Source,
    /// Once somebody wants to see it: counting edges takes its time.
    summary: Option<Summary>,
    /// What is in the scene and not in the file.
    scenery: Vec<NodeId>,
}

impl Shown {
    /// The model alone. Meshes and textures are shared with the scene on the stage.
    fn model(&self, stage: &Stage) -> Model {
        let mut scene = Scene::clone(&stage.scene);
        for &node in &self.scenery {
            scene.remove(node);
        }
        Model::shown(scene, self.source.clone())
    }
}

/// What a load under way is for.
struct Pending {
    loading: Loading,
    view: View,
}

/// The viewer's part of the window.
pub(super) struct Viewer {
    request: Request,
    reporter: Reporter,
    sources: Vec<Source>,
    current: usize,
    pending: Option<Pending>,
    shown: Option<Shown>,
    show_name: bool,
    show_metadata: bool,
    open: OpenWindow,
    quality: QualityPanel,
    side: SidePanel,
    measuring: Measuring,
    /// If there is another model beside the one that is shown.
    comparing: Option<Comparing>,
    axes: AxesOverlay,
    #[cfg(feature = "study")]
    classics: Classics,
    recent: Recent,
    /// If the model that is shown has animations.
    playback: Option<Playback>,
    /// What went wrong last, until it is dismissed or put right.
    failure: Option<String>,
    /// If files are to be watched, and can be.
    watch: Option<Watch>,
}

impl Viewer {
    /// A viewer of these sources; there is at least one.
    pub(super) fn new(request: Request, sources: Vec<Source>, reporter: Reporter) -> Self {
        let (show_name, show_metadata) = (request.overlay.name, request.overlay.metadata);
        let side = if request.overlay.tree { SidePanel::with_tree() } else { SidePanel::default() };
        let comparing = request.compared.clone().map(Comparing::new);
        Self {
            request,
            reporter,
            sources,
            current: 0,
            pending: None,
            shown: None,
            show_name,
            show_metadata,
            open: OpenWindow::default(),
            quality: QualityPanel::default(),
            side,
            measuring: Measuring::default(),
            comparing,
            axes: AxesOverlay::default(),
            #[cfg(feature = "study")]
            classics: Classics::default(),
            recent: Recent::load(),
            playback: None,
            failure: None,
            watch: None,
        }
    }

    /// 0 if anything could be shown.
    pub(super) fn exit_code(&self) -> u8 {
        u8::from(self.shown.is_none() && self.pending.is_none())
    }

    /// Starts to load the current source; what is on the screen stays until then.
    fn load(&mut self, stage: &mut Stage, view: View) {
        let source = self.sources[self.current].clone();
        let loading = Loading::start(source, self.request.clone(), stage.waker());
        self.pending = Some(Pending { loading, view });
    }

    /// Goes to another source, around the ends.
    fn step(&mut self, stage: &mut Stage, by: isize, view: View) {
        if self.sources.len() < 2 {
            stage.overlay.notify("there is no other file; drop some onto the window");
            return;
        }
        let next = (self.current as isize + by).rem_euclid(self.sources.len() as isize);
        self.current = next as usize;
        self.load(stage, view);
    }

    fn loaded(&mut self, stage: &mut Stage, outcome: Outcome, view: View) {
        let shown = outcome.and_then(|(model, warnings)| {
            self.tell_warnings(stage, &warnings);
            self.show(stage, model, view)
        });
        if let Err(failure) = shown {
            self.tell_unshown(&failure);
        }
    }

    /// Shows what went wrong, with what to do about it.
    fn show_failure(&mut self, context: &egui::Context) {
        let Some(text) = &self.failure else { return };
        let mut closed = false;
        let area = egui::Area::new(egui::Id::unique("failure")).anchor(egui::Align2::CENTER_CENTER, [0.0; 2]);
        area.fade_in(false).show(context, |ui| {
            egui::Frame::popup(ui.style()).inner_margin(12).show(ui, |ui| {
                ui.set_max_width((context.content_rect().width() - 80.0).clamp(120.0, 480.0));
                ui.strong(format!("{} is not shown", self.sources[self.current].title()));
                ui.label(text.replace("; ", ".\n"));
                closed = ui.button("Close (Escape)").clicked();
            });
        });
        if closed {
            self.failure = None;
        }
    }

    fn show(&mut self, stage: &mut Stage, model: Model, view: View) -> Result<(), Failure> {
        if view == View::Fit || self.shown.is_none() {
            stage.orbit = self.home(stage, &model)?;
            stage.set_home(stage.orbit);
        }
        stage.set_title(title(&model.source));
        stage.selection = None;
        self.side.forget();
        self.measuring.forget();
        let mut scene = model.scene;
        self.playback = Playback::new(&scene, &self.request);
        if self.playback.as_ref().is_some_and(Playback::is_playing) {
            stage.animate();
        }
        if let Some(odd) = &model.odd {
            self.notify(stage, odd.clone());
        }
        self.failure = None;
        let scenery = self.request.scenery.add_to(&mut scene);
        stage.scene = scene.into();
        if self.sources.len() > 1 && !self.show_name {
            stage.overlay.notify(self.name());
        }
        self.follow(stage, &model.files);
        if let Some(file) = model.source.first_file() {
            self.recent.add(file);
        }
        self.shown = Some(Shown { source: model.source, summary: None, scenery });
        Ok(())
    }

    /// Watches the files that were read, if files are to be watched.
    fn follow(&mut self, stage: &mut Stage, files: &[PathBuf]) {
        if self.watch.is_none() && self.request.window.watch == Some(true) {
            let waker = stage.waker();
            match Watch::new(move || waker.wake()) {
                Ok(watch) => self.watch = Some(watch),
                Err(error) => {
                    self.tell_failure(stage, &Failure::work(format!("files cannot be watched: {error}")));
                }
            }
        }
        if let Some(Err(error)) = self.watch.as_mut().map(|watch| watch.follow(files)) {
            self.tell_failure(stage, &Failure::work(format!("not all files can be watched: {error}")));
        }
    }

    /// Shows files after the current one, and the first of them at once.
    fn add(&mut self, stage: &mut Stage, files: Vec<PathBuf>) {
        if files.is_empty() {
            return;
        }
        let place = self.current + 1;
        self.sources.splice(place..place, files.into_iter().map(|file| Source::Files(vec![file])));
        self.current = place;
        self.load(stage, View::Fit);
    }

    /// Nobody waits for what is being loaded any more.
    fn cancel_loading(&mut self, stage: &mut Stage) {
        if self.pending.take().is_some() {
            stage.overlay.notify("loading was cancelled");
        }
    }

    /// The view that the command line asks for.
    fn home(&self, stage: &Stage, model: &Model) -> Result<Orbit, Failure> {
        let shot = model.shot(&self.request.framing, stage.viewport().aspect())?;
        let mut orbit = Orbit::from_camera(&shot.camera, shot.distance, self.request.framing.up);
        if self.request.window.interaction_style == Some(InteractionStyle::Trackball) {
            orbit.set_style(OrbitStyle::Trackball);
        }
        Ok(orbit)
    }

    fn tell_warnings(&self, stage: &mut Stage, warnings: &[Warning]) {
        /// More would cover the model; the terminal has them all.
        const MOST: usize = 2;
        for warning in warnings {
            self.reporter.warning(warning);
        }
        for warning in warnings.iter().take(MOST) {
            stage.overlay.notify(format!("warning: {warning}"));
        }
        if warnings.len() > MOST {
            stage.overlay.notify(format!("and {} more warnings, on the terminal", warnings.len() - MOST));
        }
    }

    fn tell_failure(&self, stage: &mut Stage, failure: &Failure) {
        self.reporter.error(failure);
        stage.overlay.notify(format!("error: {failure}"));
    }

    /// A file could not be shown: that stays on the screen until another one is, or it is
    /// closed.
    fn tell_unshown(&mut self, failure: &Failure) {
        self.reporter.error(failure);
        self.failure = Some(failure.to_string());
    }

    /// Says what a key did, unless nobody wants to know.
    fn notify(&self, stage: &mut Stage, text: impl Into<String>) {
        if self.request.notifies {
            stage.overlay.notify(text);
        }
    }

    /// Plays the animations of the model, or says that it has none.
    fn play(&mut self, stage: &mut Stage, play: impl FnOnce(&mut Playback, &mut Stage) -> Option<String>) {
        let said = match &mut self.playback {
            Some(playback) => play(playback, stage),
            None => Some("this model has no animation".to_owned()),
        };
        if let Some(said) = said {
            self.notify(stage, said);
        }
    }

    /// "(2/5) chair.glb"
    fn name(&self) -> String {
        let title = self.sources[self.current].title();
        match self.sources.len() {
            1 => title,
            count => format!("({}/{count}) {title}", self.current + 1),
        }
    }

    /// Writes what is to be read beside the model: above it, for messages come
    /// below.
    fn write_overlay(&mut self, stage: &mut Stage) {
        stage.overlay.set(Corner::Top, self.show_name.then(|| self.name()));
        let shown = self.shown.as_mut().filter(|_| self.show_metadata);
        let lines = shown.map(|shown| {
            let summary = shown.summary.unwrap_or_else(|| shown.model(stage).summary());
            shown.summary.insert(summary).lines()
        });
        stage.overlay.set(Corner::TopLeft, lines.unwrap_or_default());
    }

    /// How far a load is, with a way to end it. Returns whether that was wanted.
    fn show_progress(&self, context: &egui::Context) -> bool {
        let Some(pending) = &self.pending else { return false };
        let mut cancelled = false;
        let area = egui::Area::new(egui::Id::unique("loading")).anchor(egui::Align2::CENTER_CENTER, [0.0; 2]);
        area.fade_in(false).show(context, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_width(280.0);
                ui.label(format!("loading {}", self.sources[self.current].title()));
                let percent = pending.loading.percent();
                let bar = egui::ProgressBar::new(percent as f32 / 100.0).text(format!("{percent} %"));
                ui.add(bar);
                cancelled = ui.button("Cancel (Ctrl+.)").clicked();
            });
        });
        cancelled
    }

    /// Another up axis, and the view that goes with it.
    fn set_up(&mut self, stage: &mut Stage, up: DVec3, name: &str) {
        self.request.framing.up = up;
        self.reset_view(stage);
        stage.overlay.notify(format!("{name} is up"));
    }

    fn reset_view(&mut self, stage: &mut Stage) {
        let Some(shown) = &self.shown else { return };
        let model = shown.model(stage);
        match self.home(stage, &model) {
            Ok(orbit) => {
                stage.orbit = orbit;
                stage.set_home(orbit);
            }
            Err(failure) => self.tell_failure(stage, &failure),
        }
    }

    fn brighten(stage: &mut Stage, factor: f32) {
        /// As bright and as dark as it gets.
        const RANGE: (f32, f32) = (0.01, 100.0);
        let light = (stage.settings.light_intensity * factor).clamp(RANGE.0, RANGE.1);
        stage.settings.light_intensity = light;
        stage.overlay.notify(format!("light: {light:.2}"));
    }

    fn take_screenshot(stage: &mut Stage, background: Background) {
        let settings = stage.picture_settings();
        stage.request_picture(RenderSettings { background, ..settings });
    }

    /// Draws and writes over a screenshot what lies over the window's picture, as `--output` does.
    fn with_overlay(&self, stage: &Stage, frame: Frame) -> Result<Frame, Failure> {
        let Some(shown) = &self.shown else { return Ok(frame) };
        let mut request = self.request.clone();
        (request.overlay.name, request.overlay.metadata) = (self.show_name, self.show_metadata);
        request.overlay.tree = false;
        picture::finished(frame, &shown.model(stage), &stage.camera(), &request)
    }

    fn run(&mut self, stage: &mut Stage, command: Command) {
        /// Eight presses of a key double the light.
        const BRIGHTER: f32 = 1.090_507_7;
        match command {
            Command::PreviousFile => self.step(stage, -1, View::Fit),
            Command::NextFile => self.step(stage, 1, View::Fit),
            Command::PreviousFileSameView => self.step(stage, -1, View::Keep),
            Command::NextFileSameView => self.step(stage, 1, View::Keep),
            Command::Reload => self.load(stage, View::Keep),
            Command::Open => self.open.toggle(),
            Command::PlayOrPause => self.play(stage, |playback, stage| {
                playback.toggle(stage);
                None
            }),
            Command::PlayBackward => self.play(stage, |playback, stage| {
                playback.toggle_backward(stage);
                None
            }),
            Command::CycleAnimation => self.play(stage, |playback, stage| Some(playback.cycle(stage))),
            Command::CancelLoading => self.cancel_loading(stage),
            Command::ResetView => self.reset_view(stage),
            Command::ToggleName => self.show_name = !self.show_name,
            Command::ToggleMetadata => self.show_metadata = !self.show_metadata,
            Command::ToggleDifference => self.quality.toggle_difference(stage),
            Command::ToggleQuality => self.quality.toggle(stage),
            Command::Brighter => Self::brighten(stage, BRIGHTER),
            Command::Darker => Self::brighten(stage, 1.0 / BRIGHTER),
            Command::UpY => self.set_up(stage, DVec3::Y, "+Y"),
            Command::UpZ => self.set_up(stage, DVec3::Z, "+Z"),
            Command::Screenshot => Self::take_screenshot(stage, stage.settings.background),
            Command::ScreenshotWithoutBackground => Self::take_screenshot(stage, Background::Transparent),
        }
    }
}

impl Handler for Viewer {
    fn start(&mut self, stage: &mut Stage) {
        stage.overlay.notify("H shows the keys");
        self.load(stage, View::Fit);
        if let Some(comparing) = &mut self.comparing {
            comparing.load(stage, &self.request);
        }
        self.write_overlay(stage);
    }

    fn frame(&mut self, stage: &mut Stage, tick: Tick) -> Animation {
        let plays = self.playback.as_mut().is_some_and(|playback| playback.advance(stage, tick.delta));
        if plays { Animation::Running } else { Animation::Resting }
    }

    fn input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        if self.failure.is_some() && is_escape(input) {
            self.failure = None;
            return Taken::Yes;
        }
        if self.measuring.input(stage, input, hands) == Taken::Yes {
            return Taken::Yes;
        }
        self.side.input(stage, input, hands)
    }

    fn command(&mut self, stage: &mut Stage, name: &str) {
        if let Ok(command) = name.parse::<OverlayCommand>() {
            self.run_overlay(stage, command);
        }
        if let Ok(command) = name.parse() {
            self.run(stage, command);
            self.write_overlay(stage);
        }
    }

    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, _: Modifiers) {
        let (files, others): (Vec<PathBuf>, Vec<PathBuf>) =
            paths.into_iter().partition(|path| path.is_file());
        if let Some(other) = others.first() {
            stage.overlay.notify(format!("{} is not a file; drop model files", other.display()));
        }
        self.add(stage, files);
        self.write_overlay(stage);
    }

    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        let beside = self.shown.as_ref().map_or(&[][..], |shown| &shown.scenery);
        self.side.show(ui, stage, beside);
        self.measuring.show(ui, stage);
        if let Some(comparing) = &self.comparing {
            comparing.show(ui, &self.sources[self.current].title());
        }
        if self.request.overlay.shows_axes {
            self.axes.show(ui, stage, self.request.overlay.axes);
        }
        if self.show_progress(ui.ctx()) {
            self.cancel_loading(stage);
        }
        #[cfg(feature = "study")]
        self.quality.show(ui.ctx(), stage, |ui, stage| self.classics.show(ui, stage));
        #[cfg(not(feature = "study"))]
        self.quality.show(ui.ctx(), stage, |_, _| {});
        if let Some(playback) = &mut self.playback {
            playback.show(ui, stage);
        }
        self.show_failure(ui.ctx());
        let waker = stage.waker();
        let files = self.open.show(ui.ctx(), &self.recent, |open| {
            open.browse(SystemDialog, move || waker.wake());
        });
        self.add(stage, files);
    }

    fn picture(&mut self, stage: &mut Stage, frame: Frame) {
        let model = self.shown.as_ref().and_then(|shown| shown.source.first_file());
        let saved = self
            .with_overlay(stage, frame)
            .and_then(|frame| screenshot::save(&frame, &self.request.screenshot, model));
        match saved {
            Ok(path) => {
                let path = std::path::absolute(&path).unwrap_or(path);
                self.reporter.info(format_args!("wrote {}", path.display()));
                stage.overlay.notify(format!("wrote {}", path.display()));
            }
            Err(failure) => self.tell_failure(stage, &failure),
        }
    }

    fn woken(&mut self, stage: &mut Stage) {
        let picked = self.open.picked();
        self.add(stage, picked);
        if let Some(Err(failure)) = self.comparing.as_mut().map(|comparing| comparing.woken(stage)) {
            self.tell_failure(stage, &failure);
        }
        if self.watch.as_ref().is_some_and(Watch::take_changed) {
            self.load(stage, View::Keep);
        }
        let outcome = self.pending.as_ref().and_then(|pending| pending.loading.outcome());
        if let Some(outcome) = outcome {
            let view = self.pending.take().map_or(View::Fit, |pending| pending.view);
            self.loaded(stage, outcome, view);
        }
        self.write_overlay(stage);
    }
}

/// Whether Escape was pressed.
fn is_escape(input: &Input) -> bool {
    matches!(input, Input::Key { logical: Some(Key::Escape), .. })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use clap::Parser;

    use super::*;
    use crate::args::RawArgs;
    use crate::report::Level;

    fn viewer(flags: &str) -> Viewer {
        let words = ["trigon-viewer"].into_iter().chain(flags.split_whitespace());
        let request = Request::new(RawArgs::parse_from(words)).expect("consistent flags");
        let sources = Source::all(&request);
        Viewer::new(request, sources, Reporter::new(Level::Quiet))
    }

    fn model(viewer: &Viewer) -> Model {
        Model::new(trigon_scene::showcase(), Source::BuiltIn, &viewer.request).expect("it can be drawn")
    }

    fn press(viewer: &mut Viewer, stage: &mut Stage, key: Key) -> Taken {
        let input = Input::Key { logical: Some(key), physical: None, repeat: false };
        let hands = Hands { pointer: None, modifiers: Modifiers::NONE };
        viewer.input(stage, &input, hands)
    }

    /// Errors vanished after three seconds.
    #[test]
    fn a_file_that_cannot_be_shown_is_a_message_that_stays() {
        let (mut viewer, mut stage) = (viewer("gone.obj"), Stage::new("test"));
        viewer.loaded(&mut stage, Err(Failure::work("gone.obj: it is not there; check the name")), View::Fit);
        for second in 0..60 {
            let tick = Tick { time: Duration::from_secs(second), delta: Duration::from_secs(1) };
            viewer.frame(&mut stage, tick);
        }
        assert!(viewer.failure.as_ref().is_some_and(|text| text.contains("gone.obj")), "a minute later");
        assert_eq!(press(&mut viewer, &mut stage, Key::Enter), Taken::No, "other keys leave it");
        assert_eq!(press(&mut viewer, &mut stage, Key::Escape), Taken::Yes, "it is closed");
        assert_eq!(viewer.failure, None, "and gone");
        assert_eq!(press(&mut viewer, &mut stage, Key::Escape), Taken::No, "then Escape is the window's");
    }

    #[test]
    fn a_model_that_is_shown_takes_the_message_away() {
        let (mut viewer, mut stage) = (viewer(""), Stage::new("test"));
        viewer.loaded(&mut stage, Err(Failure::work("broken; mend it")), View::Fit);
        let outcome = Ok((model(&viewer), Vec::new()));
        viewer.loaded(&mut stage, outcome, View::Fit);
        assert_eq!(viewer.failure, None, "it is put right");
        assert!(viewer.shown.is_some(), "and shown");
    }

    #[test]
    fn what_is_beside_the_model_does_not_count() {
        let (mut viewer, mut stage) = (viewer("--grid --normal-glyphs"), Stage::new("test"));
        let plain = model(&viewer).summary();
        let outcome = Ok((model(&viewer), Vec::new()));
        viewer.loaded(&mut stage, outcome, View::Fit);
        let shown = viewer.shown.as_ref().expect("shown");
        assert_eq!(shown.scenery.len(), 2, "grid and normals");
        let counted = shown.model(&stage).summary();
        assert_eq!(
            (counted.vertices, counted.nodes, counted.size),
            (plain.vertices, plain.nodes, plain.size),
            "as the file has it"
        );
    }

    #[test]
    fn space_says_that_there_is_nothing_to_play() {
        let (mut viewer, mut stage) = (viewer(""), Stage::new("test"));
        viewer.run(&mut stage, Command::PlayOrPause);
        assert!(viewer.playback.is_none(), "no animation");
        let tick = Tick { time: Duration::ZERO, delta: Duration::from_millis(16) };
        assert_eq!(viewer.frame(&mut stage, tick), Animation::Resting, "nothing moves");
    }
}
