//! The table of `docs/viewer.md`: its flags exist, its keys are bound, and its tests are there.

use std::collections::BTreeSet;
use std::fs;
use std::sync::LazyLock;

use clap::CommandFactory;

use super::*;
use crate::args::RawArgs;

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The text of `docs/viewer.md`.
fn guide() -> &'static str {
    static GUIDE: LazyLock<String> =
        LazyLock::new(|| fs::read_to_string(root().join("docs/viewer.md")).expect("the guide"));
    &GUIDE
}

/// One row: what is expected, its flags and keys, and its tests.
struct Row {
    tier: &'static str,
    what: &'static str,
    controls: &'static str,
    tests: &'static str,
}

fn rows() -> impl Iterator<Item = Row> {
    let table = guide().split("## Row by row").nth(1).expect("there is a section of this name");
    table.lines().filter_map(|line| {
        let cells: Vec<_> = line.strip_prefix('|')?.strip_suffix('|')?.split('|').map(str::trim).collect();
        let &[tier, what, controls, tests] = &cells[..] else { return None };
        let is_row = what != "what" && !what.starts_with("--");
        is_row.then_some(Row { tier, what, controls, tests })
    })
}

/// What stands between backticks.
fn code(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// Names of all tests of the crates, the apps and `tests`.
fn tests() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut folders: Vec<PathBuf> = ["crates", "apps", "tests"].map(|folder| root().join(folder)).into();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the sources") {
            let path = entry.expect("it can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                let marked = text.split("#[test]").skip(1).filter_map(|rest| rest.split_once("fn "));
                names.extend(marked.filter_map(|(_, rest)| Some(rest.split_once('(')?.0.to_owned())));
            }
        }
    }
    names
}

#[test]
fn flags_and_keys_of_the_table_exist() {
    let command = RawArgs::command();
    let flags: BTreeSet<String> =
        command.get_arguments().filter_map(|argument| Some(format!("--{}", argument.get_long()?))).collect();
    let (_folder, viewer) = simple();
    let stage = stage(&viewer);
    let (mut flag_count, mut key_count) = (0, 0);
    for Row { what, controls, .. } in rows() {
        for control in code(controls) {
            if control.starts_with("--") {
                assert!(flags.contains(control), "{what}: there is no flag {control}");
                flag_count += 1;
                continue;
            }
            let chord: Chord = control.parse().unwrap_or_else(|_| panic!("{what}: {control} is no key"));
            let is_bound = stage.keymap.bindings().iter().any(|binding| binding.chord == chord);
            assert!(is_bound, "{what}: {control} is not bound");
            key_count += 1;
        }
    }
    assert!(flag_count > 60 && key_count > 50, "{flag_count} flags and {key_count} keys");
}

#[test]
fn rows_of_each_tier_are_counted_as_the_text_says() {
    for tier in ["must", "expected", "more"] {
        let of_tier: Vec<Row> = rows().filter(|row| row.tier == tier).collect();
        let done = of_tier.iter().filter(|row| !row.tests.starts_with("missing: ")).count();
        let text = format!("*{tier}* {done} of {}", of_tier.len());
        assert!(guide().contains(&text), "docs/viewer.md does not say: {text}");
    }
}

#[test]
fn each_row_has_a_test_that_exists_or_says_why_it_is_missing() {
    let existing = tests();
    let (mut all, mut missing) = (0, Vec::new());
    for Row { what, tests, .. } in rows() {
        all += 1;
        for test in code(tests) {
            assert!(existing.contains(test), "{what}: there is no test {test}");
        }
        if code(tests).next().is_none() {
            assert!(tests.starts_with("missing: "), "{what}: name a test, or say why it is missing: {tests}");
            missing.push(what);
        }
    }
    assert!(all > 90, "the table has rows: {all}");
    assert!(missing.len() * 10 <= all, "at most a tenth is missing: {missing:?} of {all}");
}
