//! Mutation testing of the library crates on a small machine; `docs/mutation.md` has the results.
//!
//! cargo-mutants lists the mutants, but builds the workspace anew for each. Here a sample is built in at once, each
//! mutant behind a switch that is read when a test starts. `build` copies the workspace and makes the switches,
//! `run` finds out which tests reach which mutant and runs these with the mutant switched on, and `report` writes
//! the tables.

mod check;
mod copy;
mod draw;
mod error;
mod list;
mod place;
mod process;
mod record;
mod report;
mod results;
mod run;
mod sites;
/// Compiled into the mutated crates, and here for its test.
#[cfg(test)]
#[expect(unreachable_pub, reason = "public where it is a crate of its own")]
mod switch;
mod tests_of;

use error::{Error, Result};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The crates that are mutated, those first that others depend on.
const CRATES: [&str; 10] =
    ["math", "mesh", "modelling", "camera", "raster", "scene", "io", "document", "study", "window"];

const USAGE: &str = "usage:
  trigon-mutants build DIR [SIZE] [CRATE]...
                                    copy the workspace to DIR and build it with SIZE mutants (60) of every crate,
                                    or of these alone, and only their own tests
  trigon-mutants run DIR [CRATE]... test the mutants of these crates that have no result yet, or survived
  trigon-mutants again DIR [CRATE]... forget the results of these crates
  trigon-mutants report DIR         the tables of docs/mutation.md, and tests/mutants/results.csv

`build` needs cargo-mutants 27. DIR must not be within the workspace.";

/// What there is in the folder that the user names.
struct Folder(PathBuf);

impl Folder {
    /// The copy of the workspace.
    fn tree(&self) -> PathBuf {
        self.0.join("tree")
    }

    fn target(&self) -> PathBuf {
        self.0.join("target")
    }

    /// What is kept from one run of this program to the next.
    fn state(&self, name: &str) -> PathBuf {
        self.0.join("state").join(name)
    }
}

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn crates_of(names: &[String]) -> Result<Vec<&'static str>> {
    if names.is_empty() {
        return Ok(CRATES.to_vec());
    }
    let find = |name: &String| CRATES.into_iter().find(|known| known == name);
    names.iter().map(|name| find(name).ok_or_else(|| Error::Usage(format!("no crate {name}")))).collect()
}

fn work(arguments: &[String]) -> Result<()> {
    let [command, folder, rest @ ..] = arguments else {
        return Err(Error::Usage(USAGE.to_owned()));
    };
    let folder = Folder(PathBuf::from(folder));
    match (command.as_str(), rest) {
        ("build", rest) => {
            let size = rest.first().and_then(|size| size.parse().ok());
            let crates = crates_of(if size.is_some() { &rest[1..] } else { rest })?;
            check::build(&folder, size.unwrap_or(60), &crates)
        }
        ("run", names) => crates_of(names)?.into_iter().try_for_each(|name| run::run(&folder, name)),
        ("again", names) => crates_of(names)?.into_iter().try_for_each(|name| results::forget(&folder, name)),
        ("report", []) => report::report(&folder),
        _ => Err(Error::Usage(USAGE.to_owned())),
    }
}

#[expect(clippy::print_stderr, reason = "a program that says why it failed")]
fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match work(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
