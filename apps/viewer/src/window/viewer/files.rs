//! Which files are shown: loading them, what comes of it, and watching them.

use std::path::PathBuf;

use trigon_camera::{Orbit, OrbitStyle};
use trigon_io::Warning;
use trigon_window::Stage;

use super::{Pending, Shown, Unshown, ViewChange, Viewer};
use crate::args::InteractionStyle;
use crate::failure::Failure;
use crate::folders;
use crate::inputs::Inputs;
use crate::model::Model;
use crate::source::Source;
use crate::window::background::{Loading, Outcome};
use crate::window::comparing::Comparing;
use crate::window::playback::Playback;
use crate::window::watch::Watch;

impl Viewer {
    /// Starts to load the current source; what is on the screen stays until then.
    pub(super) fn load(&mut self, stage: &mut Stage, view: ViewChange) {
        let source = self.sources[self.current].clone();
        let loading = Loading::start(source, self.request.clone(), stage.waker());
        self.asks_to_load_again = false;
        self.pending = Some(Pending { loading, view });
    }

    /// Loads the current source again, or asks first if that would put back what was moved.
    pub(super) fn load_again(&mut self, stage: &mut Stage) {
        if stage.moved_nodes().is_empty() {
            self.load(stage, ViewChange::Keep);
        } else {
            self.asks_to_load_again = true;
        }
    }

    /// Goes to another source, around the ends.
    pub(super) fn step(&mut self, stage: &mut Stage, by: isize, view: ViewChange) {
        if self.sources.len() < 2 {
            stage.overlay.notify("there is no other file; drop some onto the window");
            return;
        }
        let next = (self.current as isize + by).rem_euclid(self.sources.len() as isize);
        self.current = next as usize;
        self.load(stage, view);
    }

    pub(super) fn loaded(&mut self, stage: &mut Stage, outcome: Outcome, view: ViewChange) {
        let shown = outcome.and_then(|(model, warnings)| {
            self.tell_warnings(stage, &warnings);
            self.show(stage, model, view)
        });
        if let Err(failure) = shown {
            self.tell_unshown(&self.sources[self.current].clone(), &failure);
        }
    }

    pub(super) fn show(&mut self, stage: &mut Stage, model: Model, view: ViewChange) -> Result<(), Failure> {
        if let Some(comparing) = &mut self.comparing {
            comparing.stand_beside(stage, model.scene.up);
        }
        let playback = Playback::new(&model.scene, &self.request);
        let bar = playback.as_ref().map_or(0.0, Playback::height);
        if view == ViewChange::Fit || self.shown.is_none() {
            let covered = std::mem::replace(&mut stage.covered_below, bar);
            let home = self.home(stage, &model).inspect_err(|_| stage.covered_below = covered)?;
            self.set_home(stage, home);
        }
        stage.covered_below = bar;
        stage.set_title(model.source.window_title());
        stage.selection = None;
        self.side.forget();
        self.measuring.forget();
        let mut scene = model.scene;
        self.playback = playback;
        if self.playback.as_ref().is_some_and(Playback::is_playing) {
            stage.animate();
        }
        for odd in &model.odd {
            self.notify(stage, odd.clone());
        }
        self.failure = None;
        self.bind_keys(stage, model.source.first_file());
        let scenery = self.request.scenery.add_to(&mut scene);
        stage.scene = scene.into();
        stage.forget_moves();
        stage.beside.clone_from(&scenery);
        self.follow(stage, &model.files);
        if let Some(file) = model.source.first_file() {
            self.recent.add(file);
        }
        let is_other = self.shown.as_ref().is_none_or(|shown| shown.source != model.source);
        let mut inputs = Inputs::default();
        inputs.add(&model.files);
        self.shown =
            Some(Shown { source: model.source, index: self.current, summary: None, scenery, inputs });
        if is_other && self.sources.len() > 1 && !self.show_name {
            stage.overlay.notify(self.name());
        }
        Ok(())
    }

    /// What was read for the model that is shown.
    pub(super) fn inputs(&self) -> Inputs {
        self.shown.as_ref().map(|shown| shown.inputs.clone()).unwrap_or_default()
    }

    /// Watches the files that were read, if files are to be watched.
    pub(super) fn follow(&mut self, stage: &mut Stage, files: &[PathBuf]) {
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
    pub(super) fn add(&mut self, stage: &mut Stage, files: Vec<PathBuf>) {
        if files.is_empty() {
            return;
        }
        let files = match folders::expanded(&files, false) {
            Ok(files) => files,
            Err(reason) => return self.tell_unshown(&Source::Files(files), &Failure::work(reason)),
        };
        let index = self.current + 1;
        if let Some(shown) = self.shown.as_mut().filter(|shown| shown.index >= index) {
            shown.index += files.len();
        }
        self.sources.splice(index..index, files.into_iter().map(|file| Source::Files(vec![file])));
        self.current = index;
        self.load(stage, ViewChange::Fit);
    }

    /// Goes through all models of the folder of the one that is shown, beginning with that.
    pub(super) fn add_folder(&mut self, stage: &mut Stage) {
        let index = self.shown.as_ref().map_or(self.current, |shown| shown.index);
        let file = self.sources[index].first_file().and_then(|file| std::path::absolute(file).ok());
        let Some((file, folder)) = file.as_ref().and_then(|file| Some((file, file.parent()?))) else {
            return self.notify(stage, "the built-in scene is in no folder");
        };
        let files = match folders::expanded(&[folder.to_owned()], self.request.goes_deep) {
            Ok(files) => files,
            Err(reason) => return self.tell_failure(stage, &Failure::work(reason)),
        };
        self.current = files.iter().position(|other| other == file).unwrap_or(0);
        if let Some(shown) = &mut self.shown {
            shown.index = self.current;
        }
        self.sources = files.into_iter().map(|file| Source::Files(vec![file])).collect();
        self.notify(stage, self.name());
        self.load(stage, ViewChange::Fit);
    }

    /// Nobody waits for what is being loaded any more.
    pub(super) fn cancel_loading(&mut self, stage: &mut Stage) {
        if self.pending.take().is_some() {
            stage.overlay.notify("loading was cancelled");
        }
    }

    /// The view that the command line asks for.
    pub(super) fn home(&self, stage: &Stage, model: &Model) -> Result<Orbit, Failure> {
        let (framing, aspect) = (&self.request.framing, stage.fit_aspect());
        let shot = match self.comparing.as_ref().and_then(Comparing::other) {
            Some(other) => model.shot_with(other, framing, aspect)?,
            None => model.shot(framing, aspect)?,
        };
        let mut orbit = Orbit::from_camera(&shot.camera, shot.distance, model.scene.up.direction());
        if self.request.framing.is_fitted() {
            orbit.zoom(stage.fit_share());
        }
        if self.request.window.interaction_style == Some(InteractionStyle::Trackball) {
            orbit.set_style(OrbitStyle::Trackball);
        }
        Ok(orbit)
    }

    pub(super) fn tell_warnings(&self, stage: &mut Stage, warnings: &[Warning]) {
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

    pub(super) fn tell_failure(&self, stage: &mut Stage, failure: &Failure) {
        self.reporter.error(failure);
        stage.overlay.notify(format!("error: {failure}"));
    }

    /// A file of a source could not be shown: that stays on the screen until another one is, or it is
    /// closed.
    fn tell_unshown(&mut self, source: &Source, failure: &Failure) {
        self.reporter.error(failure);
        let why = failure.to_string();
        self.failure = Some(Unshown { name: source.title_in(&why), why });
    }
}
