//! Window mode: the models of the command line in a window, one at a time.

mod axes;
mod background;
mod classic;
mod commands;
mod comparing;
mod hint;
mod lines;
mod measuring;
mod notices;
mod open;
mod path_text;
mod playback;
mod quality;
mod screenshot;
#[cfg(test)]
mod sessions;
mod side;
mod viewer;
mod watch;

use std::fmt::Display;
use std::path::{Path, PathBuf};

use trigon_camera::Viewport;
use trigon_scene::ShadingModel;
use trigon_window::{Application, Interaction, Refinement, Stage, Visibility, WindowError};

use crate::args::Request;
use crate::compare;
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::report::Reporter;
use crate::scripted;
use crate::source::Source;
use viewer::Viewer;

/// Opens a window and returns the exit code when it is closed.
pub(crate) fn run(request: &Request, reporter: Reporter) -> u8 {
    if !display_is_named() {
        reporter.error(no_display(request));
        return 1;
    }
    let request = &match scripted::changed(request, reporter) {
        Ok(request) => request,
        Err(failure) => {
            reporter.error(&failure);
            return failure.exit_code();
        }
    };
    if let Some(Err(failure)) = request.compared.as_ref().map(|_| compare::only_source(request)) {
        reporter.error(&failure);
        return failure.exit_code();
    }
    let sources = Source::all(request);
    let mut application = Application::new(sources[0].window_title());
    set_stage(&mut application.stage, request);
    if let Err(failure) = interactions(&mut application, request, reporter) {
        reporter.error(&failure);
        return failure.exit_code();
    }
    let mut viewer = Viewer::new(request.clone(), sources, reporter);
    match application.run_with(&mut viewer) {
        Ok(()) => viewer.exit_code(),
        Err(WindowError::NoDisplay { .. }) => {
            reporter.error(no_display(request));
            1
        }
        Err(error) => {
            reporter.error(format_args!("{error}; write an image instead with --output image.png"));
            1
        }
    }
}

/// As the window begins.
fn set_stage(stage: &mut Stage, request: &Request) {
    let (width, height) = (request.settings.width, request.settings.height);
    stage.set_size(Viewport { width, height });
    stage.settings = request.settings.clone();
    stage.refinement = refinement(request);
    stage.keymap = commands::keymap();
    stage.text_scale = request.overlay.text_scale;
    if request.shows_frame_time {
        stage.frame_time = Visibility::Shown;
    }
}

/// At rest the image becomes the reference, unless somebody asked for something else,
/// or for another shading: then for its look.
fn refinement(request: &Request) -> Refinement {
    let usual = request.settings.shading == ShadingModel::Phong;
    if request.window.refine.unwrap_or(usual) { Refinement::Reference } else { Refinement::Settings }
}

/// What is recorded, and what is played, if anything.
fn interactions(
    application: &mut Application<'_>,
    request: &Request,
    reporter: Reporter,
) -> Result<(), Failure> {
    let named = |file: &Path, error: &dyn Display| Failure::work(format!("{}: {error}", file.display()));
    if let Some(file) = &request.window.interaction_play {
        let text = std::fs::read_to_string(file).map_err(|error| named(file, &error))?;
        application.play(Interaction::from_text(&text).map_err(|error| named(file, &error))?);
    }
    if let Some(file) = request.window.interaction_record.clone() {
        Inputs::of(request).refuse(&file)?;
        application.record(move |interaction| {
            let text = interaction.to_text();
            let written = trigon_io::write_atomically(&file, |file| file.write_all(text.as_bytes()));
            if let Err(error) = written {
                reporter.error(error);
            }
        });
    }
    Ok(())
}

/// `--list-bindings`: the lines of the cheat sheet under their headings, with the keys that configuration files have
/// for the first file.
pub(crate) fn bindings(request: &Request, reporter: Reporter) -> Vec<String> {
    let mut keymap = commands::keymap();
    let first = request.files.first().map(PathBuf::as_path);
    let unbound = lines::Bound::default().bind(&mut keymap, request.line.bindings(first));
    unbound.iter().for_each(|unbound| reporter.warning(unbound));
    let sheet = keymap.sheet();
    let sections = sheet.chunk_by(|one, next| one.section == next.section);
    let lines = sections.flat_map(|rows| {
        let rows_of = rows.iter().map(|row| format!("  {:46} {}", row.keys, row.description));
        std::iter::once(rows[0].section.to_string()).chain(rows_of)
    });
    lines.collect()
}

/// Loading a large model only to find that it cannot be shown is no fun, so
/// this is asked first. Other systems always have a display, or say so later.
fn display_is_named() -> bool {
    let named = |variable| std::env::var_os(variable).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || named("DISPLAY") || named("WAYLAND_DISPLAY")
}

fn no_display(request: &Request) -> String {
    let file = match request.files.first() {
        None => String::new(),
        Some(file) => format!(" {}", file.display()),
    };
    format!(
        "there is no display to open a window on; write an image instead: trigon-viewer{file} --output image.png"
    )
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::args::RawArgs;

    #[test]
    fn at_rest_the_image_is_refined_unless_its_look_or_a_flag_says_otherwise() {
        let refinement = |flags: &[&str]| {
            let words = ["trigon-viewer"].into_iter().chain(flags.iter().copied());
            refinement(&Request::new(RawArgs::parse_from(words)).expect("consistent flags"))
        };
        assert_eq!(refinement(&[]), Refinement::Reference, "usually");
        assert_eq!(refinement(&["--shading=flat"]), Refinement::Settings, "flat was asked for");
        assert_eq!(refinement(&["--shading=flat", "--refine"]), Refinement::Reference, "and so was this");
        assert_eq!(refinement(&["--refine=false"]), Refinement::Settings, "or the other way round");
    }
}
