//! The viewer's part of the window: the current model, loading, and the viewer's own keys.

mod files;
mod lines;
mod overlays;
mod run;
mod state;

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use trigon_camera::{Orbit, UpAxis};
use trigon_scene::{Background, Frame, NodeId, RenderSettings, Scene};
use trigon_window::{
    AnimationState, Corner, Handler, Hands, Input, Key, Modifiers, RecentFiles, Stage, Taken, Tick,
    Visibility, egui, state_folder,
};

use super::axes::AxesOverlay;
use super::background::Loading;
use super::classic::Classics;
use super::comparing::Comparing;
use super::hint::Hint;
use super::lines::Bound;
use super::measuring::Measuring;
use super::notices::{Answer, Notices};
use super::open::{OpenWindow, SystemDialog};
use super::playback::Playback;
use super::quality::QualityPanel;
use super::screenshot;
use super::side::SidePanel;
use super::watch::Watch;
use crate::args::{Request, Template};
use crate::drawing;
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::model::{Model, Summary};
use crate::report::Reporter;
use crate::source::Source;

/// What happens to the view when another model comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ViewChange {
    /// It is fitted to the model.
    Fit,
    /// It stays.
    Keep,
}

/// The model on the screen.
struct Shown {
    /// Its scene is on the stage.
    source: Source,
    /// Its place among the sources.
    index: usize,
    /// Once somebody wants to see it: counting edges takes its time.
    summary: Option<Summary>,
    /// What is in the scene and not in the file.
    scenery: Vec<NodeId>,
    /// What was read for it, and must not be overwritten.
    inputs: Inputs,
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
    view: ViewChange,
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
    classics: Classics,
    recent: RecentFiles,
    /// If the model that is shown has animations.
    playback: Option<Playback>,
    /// Whether the environment lights the model only because a key has shown it as the background.
    is_lit_by_skybox: bool,
    /// What went wrong last, until it is dismissed or put right.
    failure: Option<Unshown>,
    /// Whether it is asked if objects that were moved may go back.
    asks_to_load_again: bool,
    hint: Hint,
    /// The view that was fitted last.
    fitted: Option<Orbit>,
    /// The keys of configuration files.
    bound: Bound,
    /// The names of screenshots that are being drawn, first things first.
    shots: VecDeque<Template>,
    /// If files are to be watched, and can be.
    watch: Option<Watch>,
}

/// A file that is not shown.
#[derive(Debug, PartialEq)]
struct Unshown {
    name: String,
    why: String,
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
            classics: Classics::default(),
            recent: RecentFiles::load(state_folder().map(|folder| folder.join("recent"))),
            playback: None,
            is_lit_by_skybox: false,
            failure: None,
            asks_to_load_again: false,
            hint: Hint::default(),
            fitted: None,
            bound: Bound::default(),
            shots: VecDeque::new(),
            watch: None,
        }
    }

    /// 0 if anything could be shown.
    pub(super) fn exit_code(&self) -> u8 {
        u8::from(self.shown.is_none() && self.pending.is_none())
    }

    /// Shows what stands in the middle of the view, unless a panel is there, and does what is answered.
    fn show_notices(&mut self, stage: &mut Stage, ui: &egui::Ui) {
        if self.open.is_shown() || stage.cheat_sheet == Visibility::Shown {
            return;
        }
        let name = self.sources[self.current].title();
        let percent = self.pending.as_ref().map(|pending| pending.loading.percent());
        let notices = Notices {
            loading: percent.map(|percent| (name.as_str(), percent)),
            failure: self.failure.as_ref().map(|unshown| (unshown.name.as_str(), unshown.why.as_str())),
            moved: self.asks_to_load_again.then(|| stage.moved_nodes().len()),
            is_empty: self.shown.is_none() && self.pending.is_none(),
        };
        if let Some(answer) = notices.show(ui.ctx(), ui.available_rect_before_wrap()) {
            self.answer(stage, answer);
            ui.ctx().request_repaint();
        }
    }

    fn answer(&mut self, stage: &mut Stage, answer: Answer) {
        match answer {
            Answer::CancelLoading => self.cancel_loading(stage),
            Answer::CloseFailure => self.failure = None,
            Answer::LoadAgain => self.load(stage, ViewChange::Keep),
            Answer::KeepMoved => self.asks_to_load_again = false,
            Answer::Open => self.open.toggle(),
        }
    }

    /// Closes what lies on top, if Escape closes anything of the viewer's.
    fn close_panel(&mut self, stage: &mut Stage) -> Taken {
        if stage.cheat_sheet == Visibility::Shown {
            return Taken::No;
        }
        if self.open.is_shown() {
            self.open.toggle();
        } else if self.asks_to_load_again {
            self.asks_to_load_again = false;
        } else if self.failure.is_some() {
            self.failure = None;
        } else if self.quality.is_shown() {
            self.quality.toggle(stage);
        } else {
            return Taken::No;
        }
        Taken::Yes
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

    /// "(2/5) chair.glb": of the model that is shown, whatever is being loaded.
    fn name(&self) -> String {
        let index = self.shown.as_ref().map_or(self.current, |shown| shown.index);
        let title = self.sources[index].title();
        match self.sources.len() {
            1 => title,
            count => format!("({}/{count}) {title}", index + 1),
        }
    }

    /// Writes what is to be read beside the model: above it, for messages come
    /// below.
    fn write_overlay(&mut self, stage: &mut Stage) {
        let compared = self.comparing.as_ref().map(|pair| pair.text(&self.sources[self.current].title()));
        stage.overlay.set(Corner::Top, self.show_name.then(|| self.name()).into_iter().chain(compared));
        let shown = self.shown.as_mut().filter(|_| self.show_metadata);
        let lines = shown.map(|shown| {
            let summary = shown.summary.unwrap_or_else(|| shown.model(stage).summary());
            shown.summary.insert(summary).lines()
        });
        stage.overlay.set(Corner::TopLeft, lines.unwrap_or_default());
    }

    /// Another up axis, and the grid and the view that go with it.
    fn set_up(&mut self, stage: &mut Stage, up: UpAxis) {
        self.request.up = Some(up);
        stage.scene.up = up;
        if let Some(comparing) = &mut self.comparing {
            comparing.set_up(stage, up);
        }
        if self.request.scenery.shows_grid {
            // Away and back again, across the new axis.
            self.toggle_grid(stage);
            self.toggle_grid(stage);
        }
        self.reset_view(stage);
        stage.overlay.notify(format!("{up} is up"));
    }

    fn reset_view(&mut self, stage: &mut Stage) {
        let Some(shown) = &self.shown else { return };
        let model = shown.model(stage);
        match self.home(stage, &model) {
            Ok(orbit) => self.set_home(stage, orbit),
            Err(failure) => self.tell_failure(stage, &failure),
        }
    }

    fn set_home(&mut self, stage: &mut Stage, orbit: Orbit) {
        stage.orbit = orbit;
        stage.set_home(orbit);
        self.fitted = Some(orbit);
    }

    fn brighten(stage: &mut Stage, factor: f32) {
        /// As bright and as dark as it gets.
        const RANGE: (f32, f32) = (0.01, 100.0);
        let light = (stage.settings.light_intensity * factor).clamp(RANGE.0, RANGE.1);
        stage.settings.light_intensity = light;
        stage.overlay.notify(format!("light: {light:.2}"));
    }

    /// Takes a screenshot under a name, or under the usual one.
    fn take_screenshot(&mut self, stage: &mut Stage, background: Background, name: Option<Template>) {
        let settings = stage.image_settings();
        stage.request_image(RenderSettings { background, ..settings });
        self.shots.push_back(name.unwrap_or_else(|| self.request.screenshot.clone()));
    }

    /// Binds the keys that configuration files have for a model.
    fn bind_keys(&mut self, stage: &mut Stage, file: Option<&Path>) {
        for unbound in self.bound.bind(&mut stage.keymap, self.request.line.bindings(file)) {
            self.reporter.warning(&unbound);
            stage.overlay.notify(format!("warning: {unbound}"));
        }
    }

    /// Draws and writes over a screenshot what lies over the window's image, as `--output` does.
    fn with_overlay(&self, stage: &Stage, frame: Frame) -> Result<Frame, Failure> {
        let Some(shown) = &self.shown else { return Ok(frame) };
        let mut request = self.request.clone();
        (request.overlay.name, request.overlay.metadata) = (self.show_name, self.show_metadata);
        request.overlay.tree = false;
        drawing::finished(frame, &shown.model(stage), &stage.camera(), &request)
    }
}

impl Handler for Viewer {
    fn start(&mut self, stage: &mut Stage) {
        self.hint.start(stage);
        for ignored in &self.request.ignored {
            stage.overlay.notify(format!("warning: {ignored}"));
        }
        stage.columns = if self.comparing.is_some() { 2 } else { 1 };
        let file = self.sources[self.current].first_file().map(Path::to_owned);
        self.bind_keys(stage, file.as_deref());
        self.load(stage, ViewChange::Fit);
        if let Some(comparing) = &mut self.comparing {
            comparing.load(stage, &self.request);
        }
        self.write_overlay(stage);
    }

    fn frame(&mut self, stage: &mut Stage, tick: Tick) -> AnimationState {
        let plays = self.playback.as_mut().is_some_and(|playback| playback.advance(stage, tick.delta));
        if plays { AnimationState::Running } else { AnimationState::Resting }
    }

    fn input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        self.hint.input(stage, input);
        let taken = match input {
            Input::Key { logical: Some(Key::Escape), .. } => self.close_panel(stage),
            Input::Key { logical: Some(Key::Enter), .. } if self.asks_to_load_again => {
                self.load(stage, ViewChange::Keep);
                Taken::Yes
            }
            _ => Taken::No,
        };
        if taken == Taken::Yes || self.measuring.input(stage, input, hands) == Taken::Yes {
            return Taken::Yes;
        }
        self.side.input(stage, input, hands)
    }

    fn command(&mut self, stage: &mut Stage, name: &str) {
        match name.parse() {
            Ok(command) => self.run(stage, command),
            Err(()) => {
                let lines = self.bound.lines(name).to_vec();
                self.run_lines(stage, &lines);
            }
        }
        self.write_overlay(stage);
    }

    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, _: Modifiers) {
        self.add(stage, paths);
        self.write_overlay(stage);
    }

    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        // Under the panels, so that it has the width of the window.
        if let Some(playback) = &mut self.playback {
            playback.show(ui, stage);
        }
        let beside = self.shown.as_ref().map_or(&[][..], |shown| &shown.scenery);
        self.side.show(ui, stage, beside);
        self.quality.show(ui, stage, |ui, stage| self.classics.show(ui, stage));
        // On what no panel covers.
        self.measuring.show(ui, stage);
        if self.comparing.is_some() {
            // How far both are apart is known once they are drawn.
            self.write_overlay(stage);
        }
        if self.request.overlay.shows_axes {
            self.axes.show(ui, stage, self.request.overlay.axes);
        }
        if self.open.is_shown() && stage.cheat_sheet == Visibility::Shown {
            self.open.toggle();
        }
        self.show_notices(stage, ui);
        let waker = stage.waker();
        let files = self.open.show(ui, &self.recent, |open| {
            open.browse(SystemDialog, move || waker.wake());
        });
        self.add(stage, files);
    }

    fn image(&mut self, stage: &mut Stage, frame: Frame) {
        let model = self.shown.as_ref().and_then(|shown| shown.source.first_file());
        let name = self.shots.pop_front().unwrap_or_else(|| self.request.screenshot.clone());
        let inputs = self.inputs();
        let saved =
            self.with_overlay(stage, frame).and_then(|frame| screenshot::save(&frame, &name, model, &inputs));
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
        let up = self.shown.as_ref().map(|_| stage.scene.up);
        match self.comparing.as_mut().map(|comparing| comparing.woken(stage, up)) {
            Some(Err(failure)) => self.tell_failure(stage, &failure),
            // Now it is known how large it is; who has turned the camera keeps it.
            Some(Ok(true)) if self.fitted == Some(stage.orbit) => self.reset_view(stage),
            _ => {}
        }
        if self.watch.as_ref().is_some_and(Watch::take_changed) {
            self.load_again(stage);
        }
        let outcome = self.pending.as_ref().and_then(|pending| pending.loading.outcome());
        if let Some(outcome) = outcome {
            let view = self.pending.take().map_or(ViewChange::Fit, |pending| pending.view);
            self.loaded(stage, outcome, view);
        }
        self.write_overlay(stage);
    }
}

#[cfg(test)]
mod replays;

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use clap::Parser;

    use super::*;
    use crate::args::RawArgs;
    use crate::report::Level;
    use crate::window::commands::Command;

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
        viewer.loaded(
            &mut stage,
            Err(Failure::work("gone.obj: it is not there; check the name")),
            ViewChange::Fit,
        );
        for second in 0..60 {
            let tick = Tick { time: Duration::from_secs(second), delta: Duration::from_secs(1) };
            viewer.frame(&mut stage, tick);
        }
        assert!(
            viewer.failure.as_ref().is_some_and(|unshown| unshown.why.contains("gone.obj")),
            "a minute later"
        );
        assert_eq!(press(&mut viewer, &mut stage, Key::Enter), Taken::No, "other keys leave it");
        assert_eq!(press(&mut viewer, &mut stage, Key::Escape), Taken::Yes, "it is closed");
        assert_eq!(viewer.failure, None, "and gone");
        assert_eq!(press(&mut viewer, &mut stage, Key::Escape), Taken::No, "then Escape is the window's");
    }

    #[test]
    fn a_message_keeps_the_name_of_its_file_while_another_one_loads() {
        let (mut viewer, mut stage) = (viewer("a.obj b.obj"), Stage::new("test"));
        viewer.loaded(&mut stage, Err(Failure::work("a.obj: it is broken; mend it")), ViewChange::Fit);
        viewer.step(&mut stage, 1, ViewChange::Fit);
        assert_eq!(viewer.sources[viewer.current].title(), "b.obj", "the next one is loading");
        assert_eq!(
            viewer.failure.as_ref().map(|unshown| unshown.name.as_str()),
            Some("a.obj"),
            "the message's"
        );
    }

    #[test]
    fn a_model_that_is_shown_takes_the_message_away() {
        let (mut viewer, mut stage) = (viewer(""), Stage::new("test"));
        viewer.loaded(&mut stage, Err(Failure::work("broken; mend it")), ViewChange::Fit);
        let outcome = Ok((model(&viewer), Vec::new()));
        viewer.loaded(&mut stage, outcome, ViewChange::Fit);
        assert_eq!(viewer.failure, None, "it is put right");
        assert!(viewer.shown.is_some(), "and shown");
    }

    #[test]
    fn what_is_beside_the_model_does_not_count() {
        let (mut viewer, mut stage) = (viewer("--grid --normal-glyphs"), Stage::new("test"));
        let plain = model(&viewer).summary();
        let outcome = Ok((model(&viewer), Vec::new()));
        viewer.loaded(&mut stage, outcome, ViewChange::Fit);
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
        assert_eq!(viewer.frame(&mut stage, tick), AnimationState::Resting, "nothing moves");
    }
}
