//! Which tests there are, and which of them judge a crate.

use crate::Folder;
use crate::error::{Error, Result, at};
use serde::Deserialize;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Of the package `trigon-tests`, these five take as long as all others together, and would run for every survivor.
const SLOW: [&str; 5] = [
    "coverage_lines::many_segments_that_cross_in_one_sample_are_all_drawn",
    "same_bytes::levels_and_depth_tests_change_nothing",
    "same_bytes::threads_and_tiles_change_nothing",
    "ties::many_coincident_triangles_show_the_smallest_key",
    "ties::the_smaller_key_is_seen_wherever_depths_are_equal",
];

/// One test of a test program.
#[derive(Debug, Clone)]
pub(crate) struct Test {
    pub(crate) program: PathBuf,
    /// Where cargo runs it: the package's folder.
    pub(crate) home: PathBuf,
    /// As in "trigon-math lib", which `cargo test -p` knows.
    pub(crate) target: String,
    pub(crate) name: String,
    /// Of the program's bytes: a result holds while it stays the same.
    pub(crate) version: u64,
}

impl Test {
    /// For people, and as a key.
    pub(crate) fn title(&self) -> String {
        format!("{} {}", self.target, self.name)
    }
}

#[derive(Deserialize)]
struct Artifact {
    manifest_path: PathBuf,
    target: Target,
    executable: Option<PathBuf>,
    profile: Profile,
}

#[derive(Deserialize)]
struct Target {
    name: String,
    kind: Vec<String>,
}

#[derive(Deserialize)]
struct Profile {
    test: bool,
}

/// The tests of a package, as the last build made them.
fn of_package(folder: &Folder, package: &str, home: &Path) -> Result<Vec<Test>> {
    let path = folder.state("artifacts.jsonl");
    let text = at(&path, fs::read_to_string(&path))?;
    let mut tests = Vec::new();
    for line in text.lines() {
        let artifact: Artifact =
            serde_json::from_str(line).map_err(|error| Error::Json { path: path.clone(), error })?;
        let is_ours = artifact.manifest_path.parent().is_some_and(|folder| folder.ends_with(home));
        // `allocations` counts what its process allocates, and has no harness that could run one test.
        let is_test = artifact.profile.test && artifact.target.name != "allocations";
        if let (true, true, Some(program)) = (is_ours, is_test, artifact.executable) {
            let kind = artifact.target.kind.first().map_or("", String::as_str);
            let target = if kind == "test" { artifact.target.name.as_str() } else { kind };
            tests.extend(of_program(&program, &folder.tree().join(home), &format!("{package} {target}"))?);
        }
    }
    Ok(tests)
}

fn of_program(program: &Path, home: &Path, target: &str) -> Result<Vec<Test>> {
    let names = |arguments: &[&str]| -> Result<Vec<String>> {
        let output = Command::new(program).args(arguments).current_dir(home).output();
        let text = String::from_utf8_lossy(&at(program, output)?.stdout).into_owned();
        Ok(text.lines().filter_map(|line| line.strip_suffix(": test").map(str::to_owned)).collect())
    };
    let version = hash(&at(program, fs::read(program))?);
    let ignored = names(&["--list", "--format", "terse", "--ignored"])?;
    let all = names(&["--list", "--format", "terse"])?;
    let is_run = |name: &String| !ignored.contains(name) && !SLOW.contains(&name.as_str());
    let tests = all.into_iter().filter(is_run).map(|name| Test {
        program: program.to_owned(),
        home: home.to_owned(),
        target: target.to_owned(),
        name,
        version,
    });
    Ok(tests.collect())
}

/// FNV-1a over words of eight bytes.
fn hash(bytes: &[u8]) -> u64 {
    let words =
        bytes.chunks(8).map(|chunk| chunk.iter().fold(0, |word, byte| (word << 8) | u64::from(*byte)));
    words.fold(0xcbf2_9ce4_8422_2325, |hash: u64, word| (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3))
}

/// The tests that judge the mutants of a crate: its own, and those of the whole workspace if they use the crate.
pub(crate) fn judging(folder: &Folder, krate: &str) -> Result<Vec<Test>> {
    let home = PathBuf::from("crates").join(krate);
    let mut tests = of_package(folder, &format!("trigon-{krate}"), &home)?;
    if !["modelling", "document", "window"].contains(&krate) {
        tests.extend(of_package(folder, "trigon-tests", Path::new("tests"))?);
    }
    Ok(tests)
}
