//! Measures what accuracy costs in time on this machine, and writes the report:
//! `cargo run --release -p trigon-study -- --out study`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use trigon_study::report::{Effort, Report};

/// Measure what accuracy costs in time on this machine, and write a report
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Take less than a minute: fewer runs, smaller images
    #[arg(long)]
    quick: bool,

    /// The folder for report.md, results.csv and images; what is in it under these names is replaced
    #[arg(long, value_name = "DIR", default_value = "study")]
    out: PathBuf,
}

#[expect(clippy::print_stderr, reason = "that is where programs report")]
fn main() -> ExitCode {
    let Arguments { quick, out } = Arguments::parse();
    let bar = bar();
    let report = Report::measure(if quick { Effort::Quick } else { Effort::Full }, |progress| {
        bar.set_length(progress.of as u64);
        bar.set_position(progress.done as u64);
        bar.set_message(progress.chapter);
    });
    bar.finish_and_clear();
    if let Err(error) = report.write(&out) {
        eprintln!("error: {}: {error}; name a folder that can be written to with --out", out.display());
        return ExitCode::FAILURE;
    }
    eprintln!("wrote {}", out.join("report.md").display());
    ExitCode::SUCCESS
}

/// Draws nothing unless standard error is a terminal.
fn bar() -> ProgressBar {
    let bar = ProgressBar::new(1);
    let style = ProgressStyle::with_template("{msg:14} {wide_bar} {pos}/{len} {elapsed}");
    bar.set_style(style.expect("the template is well-formed"));
    bar
}
