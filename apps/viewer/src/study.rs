//! `trigon-viewer study`: measures what accuracy costs, and writes the report.

use std::path::PathBuf;

use clap::{ArgAction, Args};

use crate::report::Reporter;

/// What is measured, and where the report goes.
#[derive(Args, Clone, Debug, PartialEq)]
pub(crate) struct StudyArgs {
    /// Take less than a minute: fewer runs, smaller images
    #[arg(long)]
    pub(crate) quick: bool,

    /// The folder for report.md, results.csv and images; what is in it under these names is replaced
    #[arg(long, value_name = "DIR", default_value = "study")]
    pub(crate) out: PathBuf,

    // The viewer's own help has two lengths, so that clap's is off there, and with it here.
    /// Print this help
    #[arg(long, short, action = ArgAction::Help)]
    help: Option<bool>,
}

/// Measures and writes; returns the exit code.
#[cfg(feature = "study")]
pub(crate) fn run(arguments: &StudyArgs, reporter: Reporter) -> u8 {
    use trigon_study::report::{Effort, Report};

    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let bar = bar();
    let report = Report::measure(effort, |progress| {
        bar.set_length(progress.of as u64);
        bar.set_position(progress.done as u64);
        bar.set_message(progress.chapter);
    });
    bar.finish_and_clear();
    let file = arguments.out.join("report.md");
    match report.write(&arguments.out) {
        Ok(()) => {
            reporter.info(format_args!("wrote {}", file.display()));
            0
        }
        Err(error) => {
            let folder = arguments.out.display();
            reporter
                .error(format_args!("{folder}: {error}; name a folder that can be written to with --out"));
            1
        }
    }
}

/// Draws nothing unless standard error is a terminal.
#[cfg(feature = "study")]
fn bar() -> indicatif::ProgressBar {
    let bar = indicatif::ProgressBar::new(1);
    let style = indicatif::ProgressStyle::with_template("{msg:14} {wide_bar} {pos}/{len} {elapsed}");
    bar.set_style(style.expect("the template is well-formed"));
    bar
}

/// There is nothing to measure with.
#[cfg(not(feature = "study"))]
pub(crate) fn run(_: &StudyArgs, reporter: Reporter) -> u8 {
    reporter.error("this trigon-viewer was built without its study; build it with the feature `study`");
    1
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use clap::error::ErrorKind;

    use super::*;
    use crate::args::{Command, RawArgs};

    #[test]
    fn study_is_a_command_and_models_are_none() {
        let typed = RawArgs::parse_from(["trigon-viewer", "study", "--quick", "--out", "here"]);
        let Some(Command::Study(arguments)) = typed.command else { panic!("a command: {typed:?}") };
        assert_eq!((arguments.quick, arguments.out), (true, PathBuf::from("here")), "as typed");
        let help = RawArgs::try_parse_from(["trigon-viewer", "study", "--help"]).expect_err("it is printed");
        assert_eq!(help.kind(), ErrorKind::DisplayHelp, "of the command itself");
        let model = RawArgs::parse_from(["trigon-viewer", "chair.glb"]);
        assert!(model.command.is_none() && model.files.len() == 1, "a file is a model: {model:?}");
    }
}
