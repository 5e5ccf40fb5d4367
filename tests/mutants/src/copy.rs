//! The copy of the workspace, with switches.

use crate::error::{Error, Result, at};
use crate::list::Mutant;
use crate::{CRATES, Folder, place, sites, workspace};
use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const SWITCH_MANIFEST: &str = "[package]\nname = \"trigon-mutants-switch\"\nedition = \"2024\"\n";
const DEPENDENCY: &str =
    "[dependencies]\ntrigon-mutants-switch = { path = \"../../tests/mutants-switch\" }\n";
/// Errors by default that mutants make, and that cargo-mutants' builds would stop at for no good reason. On the
/// first line, so that all lines keep their numbers.
const ALLOWED: &str = "#![allow(arithmetic_overflow, unconditional_panic, overflowing_literals)] ";

/// The output of a git command in the workspace.
pub(crate) fn git(arguments: &[&str]) -> Result<String> {
    let fails = |message: String| Error::Program { program: "git".to_owned(), message };
    let output = Command::new("git").args(arguments).current_dir(workspace()).output();
    let output = output.map_err(|error| fails(error.to_string()))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(fails(String::from_utf8_lossy(&output.stderr).into_owned()))
}

/// Makes the copy the same as the workspace, with these mutants and their numbers. Files that stay the same are not
/// touched, so that cargo builds what has changed. Returns the mutants for which there is no place.
pub(crate) fn copy(folder: &Folder, mutants: &[(u32, &Mutant)]) -> Result<Vec<u32>> {
    let mut by_file: BTreeMap<&str, Vec<(u32, &Mutant)>> = BTreeMap::new();
    for (number, mutant) in mutants {
        by_file.entry(&mutant.file).or_default().push((*number, mutant));
    }
    let names = git(&["ls-files", "--cached", "--others", "--exclude-standard"])?;
    let mut placed = HashSet::new();
    let mut written = HashSet::new();
    for name in names.lines().filter(|name| workspace().join(name).is_file()) {
        let from = workspace().join(name);
        let bytes = at(&from, fs::read(&from))?;
        let bytes = match by_file.get(name) {
            Some(mutants) => with_switches(name, bytes, mutants, &mut placed)?,
            None => bytes,
        };
        let path = folder.tree().join(name);
        write(&path, &adapted(name, bytes))?;
        written.insert(path);
    }
    add_switch(folder, &mut written)?;
    remove_others(&folder.tree(), &written)?;
    Ok(mutants.iter().map(|(number, _)| *number).filter(|number| !placed.contains(number)).collect())
}

fn with_switches(
    name: &str,
    bytes: Vec<u8>,
    mutants: &[(u32, &Mutant)],
    placed: &mut HashSet<u32>,
) -> Result<Vec<u8>> {
    let source = String::from_utf8_lossy(&bytes).into_owned();
    let sites = place::sites(name, &source, mutants)?;
    placed.extend(sites.iter().flat_map(|site| &site.mutants).map(|(number, _)| number));
    Ok(sites::switched(&source, &sites).into_bytes())
}

/// Manifests that know the switch, and crates without lints that mutants would trip over.
fn adapted(name: &str, bytes: Vec<u8>) -> Vec<u8> {
    let is = |file: &str| CRATES.iter().any(|krate| name == format!("crates/{krate}/{file}"));
    if is("Cargo.toml") {
        return String::from_utf8_lossy(&bytes).replacen("[dependencies]\n", DEPENDENCY, 1).into_bytes();
    }
    if is("src/lib.rs") {
        return [ALLOWED.as_bytes(), &bytes].concat();
    }
    bytes
}

fn add_switch(folder: &Folder, written: &mut HashSet<PathBuf>) -> Result<()> {
    let home = folder.tree().join("tests/mutants-switch");
    for (name, text) in [("Cargo.toml", SWITCH_MANIFEST), ("src/lib.rs", include_str!("switch.rs"))] {
        write(&home.join(name), text.as_bytes())?;
        written.insert(home.join(name));
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    if let Some(parent) = path.parent() {
        at(parent, fs::create_dir_all(parent))?;
    }
    at(path, fs::write(path, bytes))
}

/// Removes files that the workspace has no longer, and what tests wrote.
fn remove_others(folder: &Path, written: &HashSet<PathBuf>) -> Result<()> {
    for entry in at(folder, fs::read_dir(folder))? {
        let path = at(folder, entry)?.path();
        if path.is_dir() {
            remove_others(&path, written)?;
        } else if !written.contains(&path) && path.file_name().is_none_or(|name| name != "Cargo.lock") {
            at(&path, fs::remove_file(&path))?;
        }
    }
    Ok(())
}
