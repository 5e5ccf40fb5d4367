//! Builds the mutated workspace: mutants at which the compiler stops are taken out, and others drawn in their place.

use crate::draw::{Drawn, Dropped, Sample, draw, shuffle};
use crate::error::{Error, Result, at};
use crate::list::{Mutant, list};
use crate::sites::{Blame, blame, next_arm};
use crate::{Folder, copy, process, workspace};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fs;
use std::path::Path;

/// A message of cargo about a crate.
#[derive(Deserialize)]
struct Message {
    message: Option<Diagnostic>,
}

#[derive(Deserialize)]
struct Diagnostic {
    level: String,
    message: String,
    code: Option<Code>,
    spans: Vec<Place>,
    rendered: Option<String>,
}

#[derive(Deserialize)]
struct Code {
    code: String,
}

#[derive(Deserialize)]
struct Place {
    file_name: String,
    byte_start: usize,
    is_primary: bool,
}

/// Copies the workspace with `size` mutants of every one of these crates, and builds the tests.
pub(crate) fn build(folder: &Folder, size: usize, crates: &[&'static str]) -> Result<()> {
    let state = folder.state("");
    at(&state, fs::create_dir_all(&state))?;
    let path = folder.state("sample.json");
    let mut sample = Sample::load(&path)?;
    sample.commit = copy::git(&["rev-parse", "HEAD"])?.trim().to_owned();
    let mut lists: Vec<Vec<Mutant>> = Vec::new();
    for &krate in crates {
        let mut mutants = list(&workspace(), krate)?;
        sample.listed.insert(krate.to_owned(), mutants.len());
        shuffle(&mut mutants);
        lists.push(mutants);
    }
    loop {
        let drawn = lists.iter().flat_map(|list| draw(list, size, &sample.dropped));
        let drawn: Vec<(u32, &Mutant)> = (1..).zip(drawn).collect();
        let dropped = round(folder, crates, &drawn)?;
        if dropped.is_empty() {
            let drawn = drawn.iter().map(|(_, mutant)| Drawn {
                identity: mutant.identity.clone(),
                krate: mutant.krate.to_owned(),
            });
            sample.drawn = drawn.collect();
            sample.save(&path)?;
            break;
        }
        process::say(&format!("{} mutants cannot be tested; drawing others", dropped.len()));
        let identity = |number: u32| drawn[number as usize - 1].1.identity.clone();
        let dropped: Vec<_> =
            dropped.into_iter().map(|(number, reason)| (identity(number), reason)).collect();
        sample.dropped.extend(dropped);
        sample.save(&path)?;
    }
    process::build_tests(folder, crates)
}

/// Compiles the workspace with these mutants; returns those that cannot stay.
fn round(folder: &Folder, crates: &[&str], drawn: &[(u32, &Mutant)]) -> Result<BTreeMap<u32, Dropped>> {
    let unplaced = copy::copy(folder, drawn)?;
    if !unplaced.is_empty() {
        return Ok(unplaced.into_iter().map(|number| (number, Dropped::CannotBeSwitched)).collect());
    }
    let output = process::check(folder, crates)?;
    let messages = output.lines().filter_map(|line| serde_json::from_str::<Message>(line).ok());
    let diagnostics: Vec<Diagnostic> = messages.filter_map(|message| message.message).collect();
    let errors: Vec<&Diagnostic> = diagnostics.iter().filter(|found| found.level == "error").collect();
    if !errors.is_empty() {
        return blamed(folder, &errors);
    }
    let compiled = compiled(folder, &diagnostics)?;
    let without = drawn.iter().map(|(number, _)| *number).filter(|number| !compiled.contains(number));
    Ok(without.map(|number| (number, Dropped::NotCompiledHere)).collect())
}

fn text_of(folder: &Folder, place: &Place) -> Result<String> {
    let path = folder.tree().join(&place.file_name);
    at(&path, fs::read_to_string(&path))
}

/// The mutants that an error is about, and why they cannot stay.
fn blame_for(folder: &Folder, error: &Diagnostic) -> Result<Option<(Vec<u32>, Dropped)>> {
    // The primary place first, then those that explain it.
    let mut places: Vec<&Place> = error.spans.iter().collect();
    places.sort_by_key(|place| !place.is_primary);
    places.retain(|place| Path::new(&place.file_name).is_relative());
    for place in &places {
        match blame(&text_of(folder, place)?, place.byte_start) {
            Blame::Mutant(number) => return Ok(Some((vec![number], Dropped::DoesNotCompile))),
            Blame::Site(numbers) => return Ok(Some((numbers, Dropped::CannotBeSwitched))),
            Blame::Nobody => {}
        }
    }
    let is_match = error.code.as_ref().is_some_and(|code| code.code == "E0004");
    let Some(place) = places.first().filter(|_| is_match) else { return Ok(None) };
    let arm = next_arm(&text_of(folder, place)?, place.byte_start);
    Ok(arm.map(|number| (vec![number], Dropped::DoesNotCompile)))
}

fn blamed(folder: &Folder, errors: &[&Diagnostic]) -> Result<BTreeMap<u32, Dropped>> {
    let mut dropped = BTreeMap::new();
    for error in errors {
        if let Some((numbers, reason)) = blame_for(folder, error)? {
            dropped.extend(numbers.into_iter().map(|number| (number, reason)));
        }
    }
    if dropped.is_empty() {
        let texts = errors.iter().map(|error| error.rendered.as_deref().unwrap_or(&error.message));
        return Err(Error::Compile(texts.collect::<BTreeSet<_>>().into_iter().collect()));
    }
    Ok(dropped)
}

/// The mutants whose switches the compiler has seen: it warns of each.
fn compiled(folder: &Folder, diagnostics: &[Diagnostic]) -> Result<HashSet<u32>> {
    let is_use = |found: &&Diagnostic| found.code.as_ref().is_some_and(|code| code.code == "deprecated");
    let mut compiled = HashSet::new();
    for place in diagnostics.iter().filter(is_use).flat_map(|found| &found.spans) {
        let text = text_of(folder, place)?;
        let number = text[place.byte_start..].split_once('(').and_then(|(_, rest)| rest.split_once(')'));
        compiled.extend(number.and_then(|(number, _)| number.parse::<u32>().ok()));
    }
    Ok(compiled)
}
