//! `--help`: the most important flags, in two screens. `--help=all` is clap's help.

use std::fmt::Write;

use clap::{Arg, Command};

/// A flag of the short help and its description; empty for the first words of the long help.
type Row = (&'static str, &'static str);

/// The contents of the short help, by group.
const ESSENTIAL: [(&str, &[Row]); 7] = [
    (
        "Files",
        &[
            ("output", ""),
            ("resolution", ""),
            ("outputs", "Also write depth, normals and other outputs"),
            ("multi-file-mode", "Several files: one at a time, all together, or by folder"),
            ("reference", ""),
            ("compare", "Show another model next to it, and the differences"),
            ("explain-pixel", "Explain why this pixel looks as it does"),
            ("check", "List faults of the files; exit code 1 for errors"),
            ("no-render", ""),
            ("capture", "Write scene, camera, settings and image to one file"),
            ("replay", "Draw a capture again, and check that it is identical"),
        ],
    ),
    (
        "Camera",
        &[
            ("view", "Look from front, back, left, right, top, bottom or iso"),
            ("up", ""),
            ("camera-direction", ""),
            ("camera-position", ""),
            ("camera-zoom-factor", ""),
            ("camera-orthographic", ""),
            ("camera-index", ""),
        ],
    ),
    (
        "Look",
        &[
            ("preset", "From draft to reference: time against accuracy"),
            ("samples", "Samples along each side of a pixel, 1 to 4"),
            ("edges", ""),
            ("display", "base-color, normal, roughness, depth, matcap and others"),
            ("style", "surface, edges, wireframe or hidden-line"),
            ("color", ""),
            ("opacity", ""),
            ("background-color", ""),
            ("no-background", ""),
            ("backface-type", ""),
        ],
    ),
    (
        "Light",
        &[
            ("shadows", ""),
            ("ambient-occlusion", ""),
            ("sky", ""),
            ("hdri-file", ""),
            ("hdri-skybox", ""),
            ("light-intensity", ""),
            ("tone-mapping", ""),
        ],
    ),
    ("Overlays", &[("grid", ""), ("axis", ""), ("filename", ""), ("metadata", "")]),
    (
        "Animation",
        &[
            ("animation-indices", ""),
            ("animation-time", ""),
            ("frame-rate", "Frames per second, for {frame}, .gif and .apng"),
            ("turntable", ""),
            ("cameras", "Draw each view of a file: JSON, NeRF or COLMAP"),
        ],
    ),
    (
        "Program",
        &[
            ("config", ""),
            ("command-script", "Run the commands in this file, line by line"),
            ("watch", ""),
            ("verbose", ""),
            ("json", "Print facts to standard output, one JSON object per line"),
            ("list-readers", ""),
            ("list-bindings", ""),
            ("version", "Print version"),
        ],
    ),
];

/// Before the groups.
const HEAD: &str = "\
Show 3D models, or render them to image files. No GPU is needed, and no display for image files.

  trigon-viewer chair.glb                      show a model; H in the window lists its keys
  trigon-viewer chair.glb --output chair.png   write an image (PNG, JPEG, WebP, OpenEXR)
  trigon-viewer *.obj --output '{model}.png'   an image of each
  trigon-viewer chair.glb --turntable=36 --output chair.gif
  trigon-viewer batch jobs.jsonl --resume      draw a list of jobs; see batch --help
";

/// After them.
const FOOT: &str = "
Exit codes: 0 done; 1 something was not loaded, drawn or written, or --check found errors;
2 the command line is invalid; 3 an image differs from --reference or --replay.
More: --help=all for every flag, values and examples.
";

/// Two screens.
pub(crate) fn short(command: &Command) -> String {
    let mut text = HEAD.to_owned();
    for (heading, flags) in ESSENTIAL {
        // Writing to a string does not fail.
        let _ = write!(text, "\n{heading}:\n");
        for (flag, said) in flags {
            let argument = command.get_arguments().find(|argument| argument.get_long() == Some(flag));
            // clap adds --version by itself.
            let start = argument.map_or_else(|| format!("      --{flag:32}"), start);
            let help = argument.and_then(Arg::get_help).map(ToString::to_string).unwrap_or_default();
            let said = if said.is_empty() { shortened(&help) } else { (*said).to_owned() };
            let _ = writeln!(text, "{start} {said}");
        }
    }
    text + FOOT
}

/// `  -e, --edges                  `
fn start(argument: &Arg) -> String {
    let short = argument.get_short().map_or("    ".to_owned(), |letter| format!("-{letter}, "));
    let long = argument.get_long().unwrap_or_default();
    let takes = argument.get_action().takes_values();
    let value = argument.get_value_names().and_then(|names| names.first()).filter(|_| takes);
    let value = match (value, argument.is_require_equals_set()) {
        (Some(name), true) if name == "BOOL" => String::new(),
        (Some(name), true) => format!("[={name}]"),
        (Some(name), false) => format!(" {name}"),
        (None, _) => String::new(),
    };
    let flag = format!("{long}{value}");
    format!("  {short}--{flag:32}")
}

/// The first part of a sentence, up to 58 characters.
fn shortened(help: &str) -> String {
    const WIDTH: usize = 58;
    let part = help.split([';', '(']).next().unwrap_or(help).trim();
    let part =
        if part.chars().count() > WIDTH { part.split([':', ',']).next().unwrap_or(part) } else { part };
    part.chars().take(WIDTH).collect()
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::super::RawArgs;
    use super::*;

    /// A common terminal size of 100 × 45 characters.
    #[test]
    fn the_help_fits_two_screens() {
        let text = short(&RawArgs::command());
        assert!(text.lines().count() <= 90, "{} lines", text.lines().count());
        for line in text.lines() {
            assert!(line.chars().count() <= 100, "{line}");
        }
        for (_, flags) in ESSENTIAL {
            for (flag, _) in flags {
                assert!(text.contains(&format!("--{flag}")), "{flag}");
            }
        }
        assert!(!text.contains("F3D"), "nobody has to know it");
    }
}
