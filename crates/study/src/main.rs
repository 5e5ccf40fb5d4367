//! Measures what a millisecond buys on this machine, and writes the report:
//! `cargo run --release -p trigon-study -- --out study`.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use clap::Parser;
use trigon_study::report::{Effort, Header, Load, Moment, Progress, Report, ages};
use trigon_study::sittings;

/// Measure what a millisecond buys on this machine, and write a report
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Take less than a minute: fewer runs, smaller images, one sitting
    #[arg(long)]
    quick: bool,

    /// The folder for accuracy.md, its appendix, accuracy.csv and images; what is in it under these names is replaced
    #[arg(long, value_name = "DIR", default_value = "study")]
    out: PathBuf,

    /// How often the program is started anew, so that memory and the machine's load differ (default: 3, or 1 with --quick)
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=9))]
    sittings: Option<u32>,

    /// From which the random order of all runs follows (default: the time)
    #[arg(long)]
    seed: Option<u64>,

    /// Measure nothing, and list the tables that are older than the code that they measure
    #[arg(long, value_name = "accuracy.csv", num_args = 0..=1, default_missing_value = "docs/accuracy.csv")]
    stale: Option<PathBuf>,

    /// Measure times alone, and write them into this file: what the program starts itself with
    #[arg(long, hide = true)]
    times: Option<PathBuf>,
}

#[expect(clippy::print_stderr, reason = "that is where programs report")]
fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    if let Some(file) = &arguments.stale {
        return list_ages(file);
    }
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let seed = arguments
        .seed
        .unwrap_or_else(|| SystemTime::now().duration_since(UNIX_EPOCH).map_or(1, |since| since.as_secs()));
    if let Some(file) = &arguments.times {
        sittings::begin(seed);
        Report::measure(effort, progress());
        return Ok(sittings::write(file)?);
    }
    measure(arguments, effort, seed)
}

/// All sittings, the last one in this process, and the report.
#[expect(clippy::print_stderr, reason = "that is where programs report")]
fn measure(arguments: &Arguments, effort: Effort, seed: u64) -> Result<(), Box<dyn Error>> {
    let count = arguments.sittings.unwrap_or(if arguments.quick { 1 } else { 3 });
    let mut header = Header::now(seed);
    std::fs::create_dir_all(&arguments.out).map_err(|error| {
        format!("{}: {error}; name a folder that can be written to with --out", arguments.out.display())
    })?;
    let mut files = Vec::new();
    for sitting in 1..count {
        eprintln!("sitting {sitting} of {count}, seed {}", seed + u64::from(sitting));
        let file = arguments.out.join(format!("times-{sitting}.txt"));
        header.sittings.push(start(arguments, seed + u64::from(sitting), &file)?);
        files.push(file);
    }
    eprintln!("sitting {count} of {count}, seed {seed}");
    sittings::begin_last(seed, &files)?;
    let moment = Moment::now();
    let report = Report::measure(effort, progress());
    header.sittings.push(moment.load());
    report.write(&arguments.out, &header)?;
    for file in files {
        std::fs::remove_file(file)?;
    }
    let used: f64 = header.sittings.iter().map(|load| load.own).sum();
    eprintln!("wrote {} after {used:.0} s of processors", arguments.out.join("accuracy.md").display());
    Ok(())
}

/// Runs another sitting to its end.
fn start(arguments: &Arguments, seed: u64, file: &Path) -> Result<Load, Box<dyn Error>> {
    let moment = Moment::now();
    let mut command = Command::new(std::env::current_exe()?);
    command.arg("--times").arg(file).arg("--seed").arg(seed.to_string());
    if arguments.quick {
        command.arg("--quick");
    }
    let status = command.status()?;
    if !status.success() {
        return Err(format!("a sitting ended with {status}").into());
    }
    Ok(moment.load())
}

/// A line before each chapter, from the first second on.
#[expect(clippy::print_stderr, reason = "that is where programs report")]
fn progress() -> impl FnMut(Progress) {
    let start = Instant::now();
    move |Progress { chapter, done, of }| {
        eprintln!("{:5.0} s  {:2} of {of}  {chapter}", start.elapsed().as_secs_f64(), done + 1);
    }
}

#[expect(clippy::print_stdout, reason = "a list is what was requested")]
fn list_ages(file: &Path) -> Result<(), Box<dyn Error>> {
    for age in ages(file)?.into_iter().filter(|age| age.own + age.renderer > 0) {
        println!("{}: {} commits to its own code, {} to the renderer", age.question, age.own, age.renderer);
    }
    Ok(())
}
