//! Files to models: guards, progress, warnings.

use std::io::{self, Read};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use trigon_io::{Limits, LoadError, LoadErrorKind, LoadOptions, Loaded, Warning};
use trigon_scene::Scene;

use crate::args::{Request, STDIN};
use crate::failure::Failure;
use crate::model::{Model, short};
use crate::report::Reporter;
use crate::source::Source;

/// Quick loads flash no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Called now and then with how far a load is, 0 to 1; `Break` cancels it.
pub(crate) type Progress<'a> = &'a (dyn Fn(f32) -> ControlFlow<()> + Sync);

/// Loads what a source names, and what was odd about it.
pub(crate) fn load(
    source: &Source,
    request: &Request,
    progress: Progress<'_>,
) -> Result<(Model, Vec<Warning>), Failure> {
    let (mut scene, mut scene_names, mut variant_names) = (Scene::new(), Vec::new(), Vec::new());
    let (mut warnings, mut read, mut odd) = (Vec::new(), Vec::new(), Vec::new());
    match source {
        Source::BuiltIn => scene = trigon_scene::showcase(),
        Source::Files(files) => {
            for (file, before) in files.iter().zip(0u16..) {
                let part = |fraction| progress((f32::from(before) + fraction) / files.len() as f32);
                let mut loaded = load_file(file, request, &part)?;
                warnings.extend(loaded.warnings);
                scene_names.extend(loaded.scene_names);
                variant_names.extend(loaded.variant_names);
                read.extend(loaded.files);
                // The first one is not copied: it may have millions of nodes.
                if before == 0 {
                    scene = loaded.scene;
                } else {
                    odd.extend(stand_upright(&mut loaded.scene, &scene, file, request));
                    scene.append(&loaded.scene);
                }
            }
        }
    }
    if let Some(moment) = &request.moment {
        odd.extend(moment.apply(&mut scene)?);
    }
    scene.up = request.up.unwrap_or(scene.up);
    let mut model = Model::new(scene, source.clone(), request)?;
    model.hide(&request.hidden)?;
    model.place_nodes(&request.placed)?;
    let light = model.scene.exposure_warning(&request.settings).map(|warning| warning.to_string());
    let odd = odd.into_iter().chain(light).collect();
    (model.scene_names, model.variant_names) = (scene_names, variant_names);
    (model.files, model.odd) = (read, odd);
    Ok((model, warnings))
}

/// Loads with a progress bar when it takes long and standard error is a
/// terminal, and reports the warnings.
pub(crate) fn load_aloud(source: &Source, request: &Request, reporter: Reporter) -> Result<Model, Failure> {
    let bar = LateBar::new(source.title(), request.shows_progress);
    let loaded = load(source, request, &|fraction| {
        bar.set(f64::from(fraction));
        ControlFlow::Continue(())
    });
    let started = bar.started;
    bar.finish();
    let (model, warnings) = loaded?;
    warnings.iter().for_each(|warning| reporter.warning(warning));
    for odd in &model.odd {
        reporter.warning(format_args!("{}: {odd}", model.source.title()));
    }
    let seconds = started.elapsed().as_secs_f64();
    reporter.debug(format_args!("loaded {} in {seconds:.3} s", model.source.title()));
    Ok(model)
}

/// A progress bar that is shown if something takes long and standard error is a terminal.
pub(crate) struct LateBar {
    bar: ProgressBar,
    started: Instant,
    is_early: bool,
}

impl LateBar {
    const STEPS: u64 = 1000;

    /// With what it says; `is_early` shows it at once.
    pub(crate) fn new(what: String, is_early: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(Self::STEPS), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template("{msg} {wide_bar} {percent} %");
        bar.set_style(style.expect("the template is well-formed"));
        bar.set_message(what);
        Self { bar, started: Instant::now(), is_early }
    }

    /// How far it is, 0 to 1.
    pub(crate) fn set(&self, fraction: f64) {
        if self.bar.is_hidden() && (self.is_early || self.started.elapsed() > PATIENCE) {
            // Draws nothing unless standard error is a terminal.
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_position((fraction * Self::STEPS as f64) as u64);
    }

    /// Removes it.
    pub(crate) fn finish(self) {
        self.bar.finish_and_clear();
    }
}

/// Loads the image that the model is to be lit by, if any.
pub(crate) fn light(request: &mut Request, reporter: Reporter) -> Result<(), Failure> {
    let Some(path) = &request.environment else { return Ok(()) };
    let (environment, warnings) =
        trigon_io::load_environment(path, &Limits::default()).map_err(Failure::work)?;
    warnings.iter().for_each(|warning| reporter.warning(warning));
    request.settings.effects.environment = Some(Arc::new(environment));
    Ok(())
}

fn load_file(path: &Path, request: &Request, progress: Progress<'_>) -> Result<Loaded, Failure> {
    check_size(path, request.max_bytes)?;
    let follow = |at: trigon_io::Progress| progress(at.fraction);
    let options = LoadOptions {
        format: request.format,
        scene: request.scene.clone(),
        variant: request.variant.clone(),
        threads: request.settings.threads,
        progress: Some(&follow),
        ..LoadOptions::default()
    };
    if path.as_os_str() == STDIN {
        let bytes = read_stdin(request.max_bytes.unwrap_or(options.limits.file_bytes))?;
        return trigon_io::load_from_slice("standard input", &bytes, &options).map_err(refused);
    }
    trigon_io::load(path, &options).map_err(refused)
}

/// Turns the contents of a file if another axis is up in them than in the scene that they join, unless the command
/// line names the axis. Says so.
fn stand_upright(added: &mut Scene, scene: &Scene, file: &Path, request: &Request) -> Option<String> {
    let (own, up) = (added.up, scene.up);
    if request.up.is_some() {
        return None;
    }
    added.turn_to(up)?;
    Some(format!(
        "{} was turned: {own} is up in such files, and {up} in the first one; --up={up} leaves it as it is",
        file.display()
    ))
}

fn refused(error: LoadError) -> Failure {
    match error.kind {
        LoadErrorKind::Empty => Failure::Empty(error.to_string()),
        _ => Failure::work(error),
    }
}

/// What another program sends, up to a number of bytes.
fn read_stdin(most: u64) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = io::stdin().lock().take(most.saturating_add(1)).read_to_end(&mut bytes);
    read.map_err(|error| Failure::work(format!("standard input: cannot be read ({error}); send it again")))?;
    if bytes.len() as u64 > most {
        return Err(Failure::work(format!(
            "standard input: is more than {most} bytes; raise --max-size if you want it"
        )));
    }
    Ok(bytes)
}

fn check_size(path: &Path, max_bytes: Option<u64>) -> Result<(), Failure> {
    const MIB: f64 = 1_048_576.0;
    let (Some(most), Ok(metadata)) = (max_bytes, path.metadata()) else { return Ok(()) };
    if metadata.len() <= most {
        return Ok(());
    }
    let [size, most] = [metadata.len(), most].map(|bytes| short(bytes as f64 / MIB));
    Err(Failure::work(format!(
        "{}: is {size} MiB, more than --max-size={most} allows; raise it if you want this file",
        path.display()
    )))
}
