//! The viewer's part of the window: which model is shown, loading it, and what
//! the viewer's own keys do.

use std::path::PathBuf;

use trigon_camera::Orbit;
use trigon_io::Warning;
use trigon_math::DVec3;
use trigon_scene::{Background, Frame};
use trigon_window::{Corner, Handler, Modifiers, Stage};

use super::background::{Loading, Outcome};
use super::commands::Command;
use super::{screenshot, title};
use crate::args::Request;
use crate::failure::Failure;
use crate::model::{Model, Source, Summary};
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
    summary: Summary,
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
}

impl Viewer {
    /// A viewer of these sources; there is at least one.
    pub(super) fn new(request: Request, sources: Vec<Source>, reporter: Reporter) -> Self {
        let (show_name, show_metadata) = (false, false);
        Self { request, reporter, sources, current: 0, pending: None, shown: None, show_name, show_metadata }
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
            self.tell_failure(stage, &failure);
        }
    }

    fn show(&mut self, stage: &mut Stage, model: Model, view: View) -> Result<(), Failure> {
        let summary = model.summary();
        if view == View::Fit || self.shown.is_none() {
            stage.orbit = self.home(stage, &model)?;
            stage.set_home(stage.orbit);
        }
        stage.set_title(title(&model.source));
        stage.selection = None;
        stage.scene = model.scene;
        if self.sources.len() > 1 && !self.show_name {
            stage.overlay.notify(self.name());
        }
        self.shown = Some(Shown { source: model.source, summary });
        Ok(())
    }

    /// The view that the command line asks for.
    fn home(&self, stage: &Stage, model: &Model) -> Result<Orbit, Failure> {
        let shot = model.shot(&self.request.framing, stage.viewport().aspect())?;
        Ok(Orbit::from_camera(&shot.camera, shot.distance, self.request.framing.up))
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
    fn write_overlay(&self, stage: &mut Stage) {
        let name = self.show_name.then(|| self.name());
        let loading = self.pending.as_ref().map(|pending| {
            format!("loading {}: {} %", self.sources[self.current].title(), pending.loading.percent())
        });
        stage.overlay.set(Corner::Top, name.into_iter().chain(loading));
        let summary = self.shown.as_ref().filter(|_| self.show_metadata).map(|shown| shown.summary.lines());
        stage.overlay.set(Corner::TopLeft, summary.unwrap_or_default());
    }

    /// Another up axis, and the view that goes with it.
    fn set_up(&mut self, stage: &mut Stage, up: DVec3, name: &str) {
        self.request.framing.up = up;
        self.reset_view(stage);
        stage.overlay.notify(format!("{name} is up"));
    }

    fn reset_view(&mut self, stage: &mut Stage) {
        let Some(shown) = &self.shown else { return };
        // The model is on the stage; only its bounds and cameras are asked for.
        let scene = std::mem::take(&mut stage.scene);
        let model = Model::shown(scene, shown.source.clone());
        match self.home(stage, &model) {
            Ok(orbit) => {
                stage.orbit = orbit;
                stage.set_home(orbit);
            }
            Err(failure) => self.tell_failure(stage, &failure),
        }
        stage.scene = model.scene;
    }

    fn brighten(stage: &mut Stage, factor: f32) {
        /// As bright and as dark as it gets.
        const RANGE: (f32, f32) = (0.01, 100.0);
        let light = (stage.settings.light_intensity * factor).clamp(RANGE.0, RANGE.1);
        stage.settings.light_intensity = light;
        stage.overlay.notify(format!("light: {light:.2}"));
    }

    fn take_screenshot(stage: &mut Stage, background: Background) {
        let mut settings = stage.settings.clone();
        (settings.width, settings.height) = (stage.viewport().width, stage.viewport().height);
        settings.background = background;
        stage.request_picture(settings);
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
            Command::ResetView => self.reset_view(stage),
            Command::ToggleName => self.show_name = !self.show_name,
            Command::ToggleMetadata => self.show_metadata = !self.show_metadata,
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
        self.write_overlay(stage);
    }

    fn command(&mut self, stage: &mut Stage, name: &str) {
        if let Ok(command) = name.parse() {
            self.run(stage, command);
            self.write_overlay(stage);
        }
    }

    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, _: Modifiers) {
        let (files, others): (Vec<PathBuf>, Vec<PathBuf>) =
            paths.into_iter().partition(|path| path.is_file());
        if let Some(other) = others.first() {
            stage.overlay.notify(format!("{} is no file; drop model files", other.display()));
        }
        if files.is_empty() {
            return;
        }
        let place = self.current + 1;
        self.sources.splice(place..place, files.into_iter().map(|file| Source::Files(vec![file])));
        self.current = place;
        self.load(stage, View::Fit);
        self.write_overlay(stage);
    }

    fn picture(&mut self, stage: &mut Stage, frame: Frame) {
        let model = self.shown.as_ref().and_then(|shown| shown.source.first_file());
        match screenshot::save(&frame, model) {
            Ok(path) => {
                let path = std::path::absolute(&path).unwrap_or(path);
                self.reporter.info(format_args!("wrote {}", path.display()));
                stage.overlay.notify(format!("wrote {}", path.display()));
            }
            Err(failure) => self.tell_failure(stage, &failure),
        }
    }

    fn woken(&mut self, stage: &mut Stage) {
        let outcome = self.pending.as_ref().and_then(|pending| pending.loading.outcome());
        if let Some(outcome) = outcome {
            let view = self.pending.take().map_or(View::Fit, |pending| pending.view);
            self.loaded(stage, outcome, view);
        }
        self.write_overlay(stage);
    }
}
