//! The table of what modellers expect, in `docs/editor.md`: its keys are those of the default keymap, and its
//! tests are there.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use trigon_window::Chord;

use crate::window::actions;

/// The text of `docs/editor.md`.
fn guide() -> &'static str {
    static GUIDE: LazyLock<String> = LazyLock::new(|| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/editor.md");
        fs::read_to_string(path).expect("the guide")
    });
    &GUIDE
}

/// One row: what is expected, its keys with the names of their actions, and its tests.
struct Row {
    tier: &'static str,
    what: &'static str,
    keys: &'static str,
    tests: &'static str,
}

fn rows() -> impl Iterator<Item = Row> {
    let table = guide().split("## Row by row").nth(1).expect("there is a section of this name");
    table.lines().filter_map(|line| {
        let cells: Vec<_> = line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ").collect();
        let &[tier, what, keys, tests] = &cells[..] else { return None };
        (what != "what").then_some(Row { tier, what, keys, tests })
    })
}

/// What stands between backticks.
fn code(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// Names of all functions of the crates and apps.
fn functions() -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut names = BTreeSet::new();
    let mut folders = vec![root.join("crates"), root.join("apps")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the sources") {
            let path = entry.expect("it can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                let found = text.split("fn ").skip(1).filter_map(|rest| rest.split_once('('));
                names.extend(found.map(|(name, _)| name.to_owned()));
            }
        }
    }
    names
}

#[test]
fn each_key_of_the_table_is_bound_to_its_action() {
    let mut count = 0;
    for Row { what, keys, .. } in rows() {
        let mut chords: Vec<Chord> = Vec::new();
        for span in code(keys) {
            let Some(action) = actions::named(span) else {
                chords.push(
                    span.parse().unwrap_or_else(|_| panic!("{what}: {span} is neither key nor action")),
                );
                continue;
            };
            let bound: Vec<Chord> =
                action.keys.split_whitespace().map(|key| key.parse().expect("a chord")).collect();
            for chord in chords.drain(..) {
                assert!(bound.contains(&chord), "{what}: {chord} is not bound to {span}");
            }
            count += 1;
        }
        assert!(chords.is_empty(), "{what}: no action follows {chords:?}");
    }
    assert!(count > 80, "the table names actions: {count}");
}

#[test]
fn the_rows_of_each_tier_are_counted_as_the_text_says() {
    for tier in ["must", "expected", "loved", "keys"] {
        let of_tier: Vec<Row> = rows().filter(|row| row.tier == tier).collect();
        let done = of_tier.iter().filter(|row| !row.tests.starts_with("missing: ")).count();
        let text = format!("*{tier}* {done} of {}", of_tier.len());
        assert!(guide().contains(&text), "docs/editor.md does not say: {text}");
    }
}

#[test]
fn each_row_has_a_test_that_exists_or_says_why_it_is_missing() {
    let functions = functions();
    let (mut all, mut missing) = (0, Vec::new());
    for Row { what, tests, .. } in rows() {
        all += 1;
        let named: Vec<_> = code(tests).collect();
        for test in &named {
            assert!(functions.contains(*test), "{what}: there is no test {test}");
        }
        if named.is_empty() {
            assert!(tests.starts_with("missing: "), "{what}: name a test, or say why it is missing: {tests}");
            missing.push(what);
        }
    }
    assert!(all > 50, "the table has rows: {all}");
    assert!(missing.len() * 10 <= all, "at most a tenth is missing: {missing:?} of {all}");
}
