//! Checks for conflicts on the command line.

use std::path::PathBuf;

use super::{Mode, STDIN};
use crate::args::beside::Beside;
use crate::args::output::Destination;
use crate::args::raw::RawArgs;

/// Standard input can be read only once, and a window reloads its files.
pub(super) fn check_stdin(mode: &Mode, files: &[PathBuf]) -> Result<(), String> {
    match files.iter().filter(|file| file.as_os_str() == STDIN).count() {
        0 => Ok(()),
        1 if *mode != Mode::Window => Ok(()),
        1 => Err("a window does not read standard input, which it could not load again; write an image with --output, or save the model as a file and name that".to_owned()),
        _ => Err("standard input holds one model; name - once".to_owned()),
    }
}

/// Several images need several names. F3D draws the first model and only warns about the rest,
/// which scripts do not notice.
pub(super) fn check_output(mode: &Mode, files: usize) -> Result<(), String> {
    if files < 2 {
        return Ok(());
    }
    if let Mode::Frontier(template) = mode
        && !template.tells_models_apart()
    {
        return Err(format!(
            "{files} files give {files} plots, but --frontier names one; write {{model}} or {{n}} in it (--frontier '{{model}}.svg')"
        ));
    }
    let Mode::Image { output, capture } = mode else { return Ok(()) };
    if capture.is_some() {
        return Err(format!(
            "{files} files give {files} images, but --capture stores one; name one file, or draw them in one scene with --multi-file-mode=all"
        ));
    }
    let Some(output) = output else { return Ok(()) };
    match output {
        Destination::File(template) if template.tells_models_apart() => Ok(()),
        Destination::File(_) => Err(format!(
            "{files} files give {files} images, but --output names one; write {{model}} or {{n}} in it (--output '{{model}}.png'), or draw them in one scene with --multi-file-mode=all"
        )),
        Destination::Stdout => Err(format!(
            "{files} files give {files} images, but standard output takes one; draw them in one scene with --multi-file-mode=all, or write files with --output '{{model}}.png'"
        )),
    }
}

/// Outputs need a destination: files next to the image, or channels in it.
pub(super) fn check_outputs(mode: &Mode, outputs: &[Beside]) -> Result<(), String> {
    if outputs.is_empty() {
        return Ok(());
    }
    let Mode::Image { output, .. } = mode else {
        return Err("--outputs needs an image, and none is drawn; leave out --outputs, or the flag that replaces the image".to_owned());
    };
    match output {
        Some(Destination::Stdout) => Err(
            "--outputs writes files beside the image, but standard output has no name; name one (--output image.png)".to_owned(),
        ),
        Some(Destination::File(template)) if template.is_exr() => {
            match outputs.iter().find(|beside| beside.names_format()) {
                Some(Beside { output, .. }) => Err(format!(
                    "an OpenEXR file holds all outputs itself; write --outputs={output} without an ending, or --output with a name that ends in .png"
                )),
                None => Ok(()),
            }
        }
        Some(Destination::File(_)) | None => Ok(()),
    }
}

/// Frames need as many names, or one file that holds them all.
pub(super) fn check_frames(raw: &RawArgs, mode: &Mode) -> Result<(), String> {
    let Mode::Image { output, capture } = mode else { return Ok(()) };
    let (moves, many) = match output {
        Some(Destination::File(template)) => (template.is_moving(), template.tells_frames_apart()),
        Some(Destination::Stdout) | None => (false, false),
    };
    let frames = moves || many;
    if frames && (capture.is_some() || raw.reference.is_some()) {
        return Err(
            "--output with several frames does not work with --capture and --reference; name one image"
                .to_owned(),
        );
    }
    if moves && !raw.outputs.is_empty() {
        return Err("--outputs writes files beside each image, but all are in one file; write {frame} in the name of --output (--output 'view_{frame:3}.png')".to_owned());
    }
    if let (Some(file), false) = (&raw.animation.cameras, frames) {
        return Err(format!(
            "--cameras={} makes an image for each camera; write {{frame}} or {{camera}} in the name of --output (--output 'view_{{frame:3}}.png')",
            file.display()
        ));
    }
    if let (Some(views), false) = (raw.animation.turntable, frames) {
        return Err(format!(
            "--turntable={views} makes {views} images; write {{frame}} in the name of --output (--output 'view_{{frame:3}}.png'), or end it in .gif or .apng"
        ));
    }
    Ok(())
}
