//! Executes lines of command scripts in the window: those of keys, and those of configuration files.

use trigon_scene::{Background, EffectSettings, RenderSettings, Shadows};
use trigon_window::{Action, Stage};

use super::{ViewChange, Viewer};
use crate::args::{Request, Step, Template, plain};
use crate::failure::Failure;
use crate::framing::Turn;
use crate::loading;
use crate::moment::Jump;
use crate::window::lines::Line;

impl Viewer {
    /// Does what lines say, one after the other, until one fails.
    pub(super) fn run_lines(&mut self, stage: &mut Stage, lines: &[Line]) {
        for line in lines {
            if let Err(failure) = self.run_line(stage, line.clone()) {
                return self.tell_failure(stage, &failure);
            }
        }
    }

    fn run_line(&mut self, stage: &mut Stage, line: Line) -> Result<(), Failure> {
        match line {
            Line::Key(binding) if binding.action == Action::Command => {
                if let Ok(command) = binding.name.parse() {
                    self.run(stage, command);
                }
                Ok(())
            }
            Line::Key(binding) => {
                stage.act(binding.action);
                Ok(())
            }
            Line::Step(step) => self.run_step(stage, step),
        }
    }

    /// Does a step of a script.
    pub(super) fn run_step(&mut self, stage: &mut Stage, step: Step) -> Result<(), Failure> {
        match step {
            Step::Edit(words) => match words.as_slice() {
                [word] if self.moves(stage, word) => {}
                _ => self.change(stage, Step::Edit(words))?,
            },
            Step::Screenshot { file, background } => self.shoot(stage, file.as_deref(), background)?,
            Step::Go(0) => self.load_again(stage),
            Step::Go(by) => self.step(stage, by, ViewChange::Fit),
            Step::Add(files) => self.add(stage, files),
            Step::SceneInfo => {
                let lines = self.shown.as_ref().map(|shown| shown.model(stage).summary().lines());
                lines.into_iter().flatten().for_each(|line| self.reporter.info(line));
            }
            Step::Print(flag) => {
                let file = self.sources[self.current].first_file();
                let said = format!("{flag} {}", self.request.line.typed_value(&flag, file));
                self.reporter.info(&said);
                self.notify(stage, said);
            }
            Step::Say(said) => self.reporter.info(said),
            Step::Ignored(why) => self.notify(stage, why),
            Step::Stop => stage.exit(),
            other => self.change(stage, other)?,
        }
        Ok(())
    }

    /// Changes a flag by a key.
    pub(super) fn change_by_key(&mut self, stage: &mut Stage, step: Step) {
        if let Err(failure) = self.change(stage, step) {
            self.tell_failure(stage, &failure);
        }
    }

    pub(super) fn toggle_flag(&mut self, stage: &mut Stage, flag: &str) {
        self.change_by_key(stage, Step::Toggle(flag.to_owned()));
    }

    pub(super) fn toggle_shadows(&mut self, stage: &mut Stage) {
        let is_on = stage.settings.effects.shadows != Shadows::Off;
        self.set_flags(stage, &[if is_on { "--shadows=off" } else { "--shadows=on" }]);
    }

    /// Lights the model from all around, or no longer. What is shown behind it lights it.
    pub(super) fn toggle_environment(&mut self, stage: &mut Stage) {
        self.is_lit_by_skybox = false;
        let is_on = stage.settings.effects.environment.is_some();
        let flags: &[&str] =
            if is_on { &["--hdri-skybox=false", "--hdri-ambient=false"] } else { &["--hdri-ambient=true"] };
        self.set_flags(stage, flags);
    }

    pub(super) fn toggle_skybox(&mut self, stage: &mut Stage) {
        let flags: &[&str] = match stage.settings.background {
            Background::Environment if std::mem::take(&mut self.is_lit_by_skybox) => {
                &["--hdri-skybox=false", "--hdri-ambient=false"]
            }
            Background::Environment => &["--hdri-skybox=false"],
            // It would contradict the other flag.
            _ if self.request.line.is_off("hdri-ambient") => {
                self.is_lit_by_skybox = true;
                &["--hdri-ambient=true", "--hdri-skybox=true"]
            }
            _ => &["--hdri-skybox=true"],
        };
        self.set_flags(stage, flags);
    }

    fn set_flags(&mut self, stage: &mut Stage, flags: &[&str]) {
        self.change_by_key(stage, Step::Edit(flags.iter().map(|&flag| flag.to_owned()).collect()));
    }

    /// Moves the camera or goes to another time, if that is what a flag of a script does.
    fn moves(&mut self, stage: &mut Stage, word: &str) -> bool {
        let (flag, value) = word.split_once('=').unwrap_or((word, ""));
        match flag {
            "--camera-turn" => match value.parse::<Turn>() {
                Ok(Turn::Azimuth(angle)) => stage.orbit.orbit(angle, 0.0),
                Ok(Turn::Elevation(angle)) => stage.orbit.orbit(0.0, angle),
                Ok(Turn::Roll(angle)) => stage.orbit.roll(angle),
                Ok(Turn::Reset) => self.reset_view(stage),
                Err(_) => return false,
            },
            "--animation-jump" => {
                let Ok(jump) = value.parse::<Jump>() else { return false };
                let rate = self.request.sequence.rate;
                self.play(stage, |playback, stage| {
                    playback.jump(stage, jump, rate);
                    None
                });
            }
            _ => return false,
        }
        true
    }

    fn shoot(&mut self, stage: &mut Stage, file: Option<&str>, background: bool) -> Result<(), Failure> {
        let name = file.map(|name| Template::parse(name).map_err(Failure::Usage)).transpose()?;
        let backdrop = if background { stage.settings.background } else { Background::Transparent };
        self.take_screenshot(stage, backdrop, name);
        Ok(())
    }

    /// Changes flags: what they set is set at once, or a model that they change is loaded again.
    fn change(&mut self, stage: &mut Stage, step: Step) -> Result<(), Failure> {
        let file = self.sources[self.current].first_file();
        let line = self.request.line.changed(step, file).map_err(Failure::Usage)?;
        let request = |line| Request::from_line(line, file).map_err(|error| Failure::Usage(plain(&error)));
        // As it was before keys changed anything.
        let before = Request { settings: self.request.settings.clone(), ..request(&self.request.line)? };
        let mut after = request(&line)?;
        self.light(&mut after)?;
        let said = line.last_change();
        let is_framed = before.framing != after.framing || before.up != after.up;
        let is_other = is_other_model(&before, &after);
        take_settings(&mut stage.settings, &before.settings, &after.settings);
        take(&mut self.show_name, &before.overlay.name, &after.overlay.name);
        take(&mut self.show_metadata, &before.overlay.metadata, &after.overlay.metadata);
        take(&mut stage.text_scale, &before.overlay.text_scale, &after.overlay.text_scale);
        let now = &mut self.request;
        take(&mut now.framing, &before.framing, &after.framing);
        take(&mut now.overlay.shows_axes, &before.overlay.shows_axes, &after.overlay.shows_axes);
        take(&mut now.scenery.shows_grid, &before.scenery.shows_grid, &after.scenery.shows_grid);
        after.window.clone_from(&now.window);
        after.screenshot.clone_from(&now.screenshot);
        after.state_file.clone_from(&now.state_file);
        after.framing.clone_from(&now.framing);
        if before.up == after.up {
            after.up = now.up;
        }
        after.overlay.shows_axes = now.overlay.shows_axes;
        after.scenery.shows_grid = now.scenery.shows_grid;
        self.request = after;
        if is_other {
            self.load_changed(stage, is_framed);
        } else if is_framed {
            self.reset_view(stage);
        }
        self.notify(stage, said);
        Ok(())
    }

    /// Loads what flags have changed; asks first if objects would go back.
    fn load_changed(&mut self, stage: &mut Stage, is_framed: bool) {
        if is_framed {
            self.load(stage, ViewChange::Fit);
        } else {
            self.load_again(stage);
        }
        if let Some(comparing) = &mut self.comparing {
            comparing.load(stage, &self.request);
        }
    }

    /// Lights a request by its environment image, which is not loaded again if it is that of before.
    fn light(&self, request: &mut Request) -> Result<(), Failure> {
        if request.environment.is_none() || request.environment != self.request.environment {
            return loading::light(request, self.reporter);
        }
        request.settings.effects.environment.clone_from(&self.request.settings.effects.environment);
        Ok(())
    }
}

/// Whether the model or what is beside it looks different.
fn is_other_model(before: &Request, after: &Request) -> bool {
    before.look != after.look
        || before.scenery != after.scenery
        || before.moment != after.moment
        || before.scene != after.scene
        || before.format != after.format
        || before.up != after.up
        || before.hidden != after.hidden
        || before.placed != after.placed
}

/// Takes over what has changed.
fn take<T: PartialEq + Clone>(now: &mut T, before: &T, after: &T) {
    if before != after {
        now.clone_from(after);
    }
}

/// Takes over all settings that have changed; what keys and panels have set of the others stays.
fn take_settings(now: &mut RenderSettings, before: &RenderSettings, after: &RenderSettings) {
    macro_rules! take_all {
        ($now:expr, $before:expr, $after:expr; $type:ident { $($field:ident),* } but $($other:ident),*) => {
            let (now, before, after) = ($now, $before, $after);
            // Names every field: a new one has to be put here.
            let $type { $($field: _,)* $($other: _,)* } = after;
            $(take(&mut now.$field, &before.$field, &after.$field);)*
        };
    }
    take_all!(&mut now.effects, &before.effects, &after.effects; EffectSettings {
        shadows, soft_shadows, ambient_occlusion, environment, metal_reflection, sight, fog, exposure, tone_mapping, outline
    } but);
    take_all!(now, before, after; RenderSettings {
        samples_per_axis, samples, background, style, display, line_width, point_size, edge_color, edge_opacity, x_ray, marks,
        vertices, lighting, light_intensity, shading, reflection, threads, simd
    } but width, height, effects, outputs);
}
