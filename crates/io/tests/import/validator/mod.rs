//! Every error and warning of the Khronos glTF validator: a file that gets it,
//! and what trigon does with that file.
//!
//! The rows make the files. What the official validator reports of each is
//! recorded in `crates/io/tests/validator`, and the outcomes are the table in
//! `docs/gltf-codes.md`, which `TRIGON_UPDATE_CODES=1` writes anew. See
//! `docs/testing.md`.

mod data;
mod files;
mod glb;
mod link;
mod report;
mod row;
mod schema;
mod semantic;
mod table;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use trigon_io::{LoadOptions, load};
use trigon_math::{Bounds3, DVec3};

use report::{Report, fnv1a};
use row::{Outcome, Refused, Row, Silent, Warned};
use table::table;

fn rows() -> Vec<Row> {
    [schema::rows(), semantic::rows(), link::rows(), data::rows(), glb::rows()].concat()
}

/// What trigon said of a file: its error, or its warnings.
struct Answer {
    is_refused: bool,
    /// Of all that is drawn.
    bounds: Bounds3,
    /// Without the name of the file.
    lines: Vec<String>,
}

fn ask(folder: &Path, name: &str, bytes: &[u8]) -> Answer {
    let path = folder.join(name);
    fs::write(&path, bytes).expect("the folder is writable");
    // Messages start with the file, and that with the folder; an image's file
    // may be the one to blame.
    let plain = |message: String| {
        let folder = format!("{}/", folder.display());
        let message = message.strip_prefix(&folder).unwrap_or(&message).to_owned();
        assert!(message.starts_with(name), "{message:?} names the file {name}");
        assert!(!message.contains('\n'), "{message:?} is one line");
        message[name.len()..].trim_start_matches([',', ':', ' ']).to_owned()
    };
    match load(&path, &LoadOptions::default()) {
        Ok(loaded) => {
            assert!(!loaded.scene.bounds().is_empty(), "{name} shows something");
            let lines = loaded.warnings.iter().map(|warning| plain(warning.to_string())).collect();
            Answer { is_refused: false, bounds: loaded.scene.bounds(), lines }
        }
        Err(error) => {
            Answer { is_refused: true, bounds: Bounds3::EMPTY, lines: vec![plain(error.to_string())] }
        }
    }
}

/// What trigon does with each row's file.
fn answers(rows: &[Row]) -> Vec<Answer> {
    let folder = tempfile::tempdir().expect("a folder");
    let of = |row: &Row| {
        let (name, bytes) = row.file();
        ask(folder.path(), &name, &bytes)
    };
    rows.iter().map(of).collect()
}

/// Writes the files where `TRIGON_VALIDATOR_FILES` says, for the validator.
#[test]
fn files_for_the_validator_are_written_on_request() {
    let Some(folder) = std::env::var_os("TRIGON_VALIDATOR_FILES") else { return };
    fs::create_dir_all(&folder).expect("the folder is writable");
    for (name, bytes) in rows().iter().map(Row::file) {
        fs::write(Path::new(&folder).join(name), bytes).expect("the folder is writable");
    }
}

#[test]
fn every_code_has_a_row_and_every_row_a_code() {
    let (rows, report) = (rows(), Report::read());
    let known: BTreeSet<&str> = report.serious().map(|code| code.name.as_str()).collect();
    let held: BTreeSet<&str> = rows.iter().map(Row::code).collect();
    assert!(known.len() > 100, "the list of codes was recorded");
    assert_eq!(held, known, "the rows are of the validator's errors and warnings");
    let names: BTreeSet<&str> = rows.iter().map(|row| row.name).collect();
    assert_eq!(names.len(), rows.len(), "each row has a name of its own");
}

#[test]
fn the_validator_reports_each_code_of_the_files_as_they_are() {
    let (rows, report) = (rows(), Report::read());
    let mut wrong = Vec::new();
    let mut made = BTreeSet::new();
    for row in &rows {
        let (name, bytes) = row.file();
        match report.files.get(&name) {
            None => wrong.push(format!("{name} is not recorded")),
            Some(file) if file.hash != fnv1a(&bytes) => wrong.push(format!("{name} has changed")),
            Some(file) if !file.codes.iter().any(|code| code == row.code()) => {
                wrong.push(format!("{name} gets {:?} instead", file.codes));
            }
            Some(_) => {}
        }
        made.insert(name);
    }
    wrong.extend(
        report.files.keys().filter(|name| !made.contains(*name)).map(|name| format!("{name} is not made")),
    );
    assert!(wrong.is_empty(), "record them again, see docs/testing.md: {wrong:#?}");
}

#[test]
fn each_file_is_refused_or_drawn_as_its_row_says() {
    let rows = rows();
    for (row, answer) in rows.iter().zip(answers(&rows)) {
        let found = match &answer {
            Answer { is_refused: true, .. } => Refused,
            Answer { lines, .. } if lines.is_empty() => Silent(""),
            _ => Warned,
        };
        let same = std::mem::discriminant::<Outcome>(&found) == std::mem::discriminant(&row.outcome);
        let lines = answer.lines;
        assert!(same, "{} should be {:?} and is {found:?}: {lines:#?}", row.name, row.outcome);
    }
}

/// A shear shows; nothing else that is passed over may move the square.
#[test]
fn what_gets_no_warning_is_where_the_sound_square_is() {
    let rows = rows();
    for (row, answer) in rows.iter().zip(answers(&rows)) {
        let right = if row.name == "NODE_MATRIX_NON_TRS" { 1.5 } else { 1.0 };
        if matches!(row.outcome, Silent(_)) {
            let Bounds3 { min, max } = answer.bounds;
            assert_eq!((min, max), (DVec3::ZERO, DVec3::new(right, 1.0, 0.0)), "{}", row.name);
        }
    }
}

#[test]
fn the_table_in_the_documentation_is_true() {
    let rows = rows();
    let text = table(&rows, &answers(&rows), &Report::read());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/gltf-codes.md");
    if std::env::var_os("TRIGON_UPDATE_CODES").is_some() {
        fs::write(&path, &text).expect("the folder is writable");
    }
    let kept = fs::read_to_string(&path).expect("the table is there");
    let different = kept.lines().zip(text.lines()).find(|(kept, made)| kept != made);
    assert_eq!(different, None, "TRIGON_UPDATE_CODES=1 writes the table anew");
    assert_eq!(kept, text, "TRIGON_UPDATE_CODES=1 writes the table anew");
}

/// Else the other tests would say nothing about what changes were made to it.
#[test]
fn the_sound_square_is_drawn_without_a_word() {
    let folder = tempfile::tempdir().expect("a folder");
    let square = files::square();
    for (name, bytes) in [("a.glb", square.glb()), ("a.gltf", files::gltf(&square))] {
        let answer = ask(folder.path(), name, &bytes);
        assert!(!answer.is_refused && answer.lines.is_empty(), "{name}: {:#?}", answer.lines);
    }
}
