//! The window's view as a command line: copied, kept in files, and read from them.

use std::path::{Path, PathBuf};

use trigon_scene::RenderSettings;
use trigon_window::Stage;

use super::{ViewChange, Viewer};
use crate::args::{CommandLine, DECIDED, PlacedNode, Request, Subject, of_settings, plain};
use crate::exact_camera::ExactCamera;
use crate::failure::Failure;
use crate::loading;
use crate::source::Source;
use crate::state::State;
use crate::window::side::Content;

/// A command line that draws the window's image.
pub(in crate::window) struct Copied {
    pub(in crate::window) state: State,
    /// What it does not set as it is.
    pub(in crate::window) differs: Option<&'static str>,
}

impl Viewer {
    /// What the window shows now.
    pub(in crate::window) fn copied(&self, stage: &Stage) -> Result<Copied, Failure> {
        let source = &self.sources[self.current];
        let mistake = |error: clap::Error| Failure::Usage(plain(&error));
        let mut flags = self.request.line.flags_but(&DECIDED, source.first_file()).map_err(mistake)?;
        // Those of configuration files are among them.
        flags.push("--no-config=true".to_owned());
        let settings = stage.image_settings();
        flags.extend(of_settings(&settings));
        let exact = ExactCamera { camera: stage.camera(), distance: stage.orbit.distance() };
        flags.push(format!("--camera-exact={exact}"));
        flags.extend(self.request.up.map(|up| format!("--up={up}")));
        flags.extend(self.overlay_flags());
        flags.extend(self.playback.iter().flat_map(|playback| playback.flags()));
        flags.extend(self.node_flags(stage));
        let files = match source {
            Source::BuiltIn => Vec::new(),
            Source::Files(files) => files.clone(),
        };
        let state = State { files, flags };
        let line = CommandLine::new(state.words(false)).map_err(mistake)?;
        let request = Request::from_line(&line, source.first_file()).map_err(mistake)?;
        let moved_beside = !stage.moved_nodes().is_empty() && !stage.beside.is_empty();
        let differs = if !is_alike(request.settings, settings) {
            Some("no flag asks for as many samples of both kinds")
        } else {
            moved_beside.then_some("its grid, normals and bones follow the objects that were moved")
        };
        Ok(Copied { state, differs })
    }

    fn overlay_flags(&self) -> impl Iterator<Item = String> {
        let overlay = &self.request.overlay;
        [
            (overlay.shows_axes, "axis"),
            (self.request.scenery.shows_grid, "grid"),
            (self.show_name, "filename"),
            (self.show_metadata, "metadata"),
        ]
        .into_iter()
        .filter(|(is_shown, _)| *is_shown)
        .map(|(_, flag)| format!("--{flag}=true"))
    }

    /// The nodes that are hidden, and those that were moved, by their numbers in the tree.
    fn node_flags(&self, stage: &Stage) -> Vec<String> {
        let Some(shown) = &self.shown else { return Vec::new() };
        let (model, moved) = (shown.model(stage), stage.moved_nodes());
        let (mut hidden, mut flags) = (Vec::new(), Vec::new());
        for (number, (id, _)) in model.scene.tree().into_iter().enumerate() {
            let Some(node) = model.scene.node(id) else { continue };
            if !node.visible {
                hidden.push(number.to_string());
            }
            if moved.contains(&id) || self.request.placed.iter().any(|placed| placed.number == number) {
                flags.push(format!("--place-node={}", PlacedNode { number, transform: node.transform }));
            }
        }
        if !hidden.is_empty() {
            flags.push(format!("--hide-nodes={}", hidden.join(",")));
        }
        flags
    }

    /// Copies it to the clipboard, and shows it.
    pub(super) fn copy_command(&mut self, stage: &mut Stage) {
        match self.copied(stage) {
            Ok(Copied { mut state, differs }) => {
                state.flags.push("--output=view.png".to_owned());
                self.side.show_command(state.command(), differs);
                self.side.open(Content::Command);
            }
            Err(failure) => self.tell_failure(stage, &failure),
        }
    }

    /// The file of the state.
    fn state_path(&self) -> PathBuf {
        let model = self.sources[self.current].first_file();
        self.request.state_file.unused(Subject { model, ..Subject::default() })
    }

    pub(super) fn save_state(&mut self, stage: &mut Stage) {
        let path = self.state_path();
        let written = self.copied(stage).and_then(|Copied { mut state, .. }| {
            // It may be loaded in another folder.
            state
                .files
                .iter_mut()
                .for_each(|file| *file = std::path::absolute(&*file).unwrap_or(file.clone()));
            self.inputs().refuse(&path)?;
            state.write(&path).map_err(Failure::work)
        });
        match written {
            Ok(()) => self.notify(stage, format!("saved {}", path.display())),
            Err(failure) => self.tell_failure(stage, &failure),
        }
    }

    pub(super) fn load_state(&mut self, stage: &mut Stage) {
        let path = self.state_path();
        match self.take_state(stage, &path) {
            Ok(()) => self.notify(stage, format!("loaded {}", path.display())),
            Err(failure) => self.tell_failure(stage, &failure),
        }
    }

    fn take_state(&mut self, stage: &mut Stage, path: &Path) -> Result<(), Failure> {
        let mistake = |error: clap::Error| Failure::Usage(format!("{}: {}", path.display(), plain(&error)));
        let state = State::read(path).map_err(Failure::work)?;
        let line = CommandLine::new(state.words(false)).map_err(mistake)?;
        let mut request =
            Request::from_line(&line, state.files.first().map(PathBuf::as_path)).map_err(mistake)?;
        loading::light(&mut request, self.reporter)?;
        // How the window works is not part of the state.
        request.window = self.request.window.clone();
        request.state_file = self.request.state_file.clone();
        request.screenshot = self.request.screenshot.clone();
        stage.settings = request.settings.clone();
        (self.show_name, self.show_metadata) = (request.overlay.name, request.overlay.metadata);
        (self.sources, self.current) = (Source::all(&request), 0);
        self.request = request;
        self.load(stage, ViewChange::Fit);
        Ok(())
    }
}

/// Whether they draw the same. Environments are those of the same flags.
fn is_alike(mut one: RenderSettings, other: RenderSettings) -> bool {
    let RenderSettings { threads, simd, outputs, .. } = other;
    (one.threads, one.simd, one.outputs) = (threads, simd, outputs);
    one.effects.environment.clone_from(&other.effects.environment);
    one == other
}
