//! Flags that do nothing beside others, and why: each is told, none is an error.

use super::Mode;
use crate::args::raw::RawArgs;

/// A warning for each flag that was given and does nothing.
pub(super) fn warnings(raw: &RawArgs, mode: &Mode) -> Vec<String> {
    let (window, scenery, animation) = (&raw.window, &raw.scenery, &raw.animation);
    let in_window = [
        ("--display-depth", raw.display_depth == Some(true), "it is of images; add --output image.png"),
        ("--json", raw.json == Some(true), "it describes images; add --output or --no-render"),
    ];
    let in_image = [
        ("--watch", window.watch == Some(true), "an image is drawn once; leave out --output"),
        ("--refine", window.refine == Some(true), "an image is as --preset and --samples say"),
        (
            "--interaction-style",
            window.interaction_style.is_some(),
            "no window is opened; leave out --output",
        ),
        (
            "--animation-autoplay",
            animation.animation_autoplay == Some(true),
            "no window is opened; write {frame} in --output for many images",
        ),
        ("--animation-progress", animation.animation_progress.is_some(), "no window is opened"),
    ];
    let without_grid = [
        ("--grid-unit", scenery.grid_unit.is_some(), "there is no grid; add --grid"),
        ("--grid-absolute", scenery.grid_absolute == Some(true), "there is no grid; add --grid"),
    ];
    let has_grid = scenery.grid == Some(true);
    let ignored: Vec<_> = match mode {
        Mode::Window => in_window.to_vec(),
        Mode::Image { .. } => in_image.to_vec(),
        _ => Vec::new(),
    };
    let ignored = ignored.into_iter().chain(without_grid.into_iter().filter(|_| !has_grid));
    let given = ignored.filter(|(_, is_given, _)| *is_given);
    given.map(|(flag, _, why)| format!("{flag} is ignored: {why}")).collect()
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use crate::args::{RawArgs, Request};

    fn ignored(flags: &str) -> Vec<String> {
        let words = ["trigon-viewer"].into_iter().chain(flags.split_whitespace());
        Request::new(RawArgs::parse_from(words)).expect("consistent flags").ignored
    }

    #[test]
    fn flags_that_do_nothing_are_told_with_the_reason() {
        for (flags, flag) in [
            ("--display-depth", "--display-depth"),
            ("--json", "--json"),
            ("--output a.png --watch", "--watch"),
            ("--output a.png --refine", "--refine"),
            ("--output a.png --interaction-style=trackball", "--interaction-style"),
            ("--output a.png --animation-autoplay", "--animation-autoplay"),
            ("--output a.png --animation-progress=none", "--animation-progress"),
            ("--grid-unit=2", "--grid-unit"),
            ("--grid-absolute", "--grid-absolute"),
        ] {
            let told = ignored(flags);
            assert!(
                told.len() == 1 && told[0].starts_with(&format!("{flag} is ignored: ")),
                "{flags}: {told:?}"
            );
        }
        for flags in ["", "--watch --refine", "--grid --grid-unit=2", "--output a.png --json --display-depth"]
        {
            assert_eq!(ignored(flags), [""; 0], "{flags}");
        }
    }
}
