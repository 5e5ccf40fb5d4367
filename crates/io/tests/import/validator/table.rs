//! The rows as the table of `docs/gltf-codes.md`.

use std::fmt::Write;

use super::Answer;
use super::report::{Code, Report};
use super::row::{Outcome, Refused, Row, Silent, Warned};

const HEAD: &str = "\
# What trigon does with broken glTF files

Every error and every warning of the Khronos glTF validator, with at least one file that it reports so. trigon refuses the
file with an error, draws it with a warning, or draws it without one, for a reason. The rule is that nothing is silently
drawn differently from what the file says. A viewer is no validator: what does not change the image gets no warning.

Messages are shown as they are printed, without the file's name. A test makes each file, checks it against the
validator's recorded report, and holds trigon to this table (`crates/io/tests/import/validator`; `docs/testing.md` says
how to record and rewrite). A code that covers many cases has several files, and the table speaks for these only.
";

/// The document.
pub(super) fn table(rows: &[Row], answers: &[Answer], report: &Report) -> String {
    let mut text = format!("{HEAD}\n{}\n", summary(rows, report));
    let mut group = "";
    for code in report.serious() {
        if code.group != group {
            group = &code.group;
            let head = "| code | severity | the file | trigon | its message, or why there is none |";
            write!(text, "\n## {group}\n\n{head}\n|---|---|---|---|---|\n").expect("text takes it");
        }
        for (row, answer) in rows.iter().zip(answers).filter(|(row, _)| row.code() == code.name) {
            writeln!(text, "{}", line(code, row, answer)).expect("text takes it");
        }
    }
    text
}

fn summary(rows: &[Row], report: &Report) -> String {
    let count = |is: fn(&Outcome) -> bool| rows.iter().filter(|row| is(&row.outcome)).count();
    let severity = |severity: &str| report.codes.iter().filter(|code| code.severity == severity).count();
    format!(
        "Version {version} of the validator has {errors} errors and {warnings} warnings. Of the {files} files, {refused} \
         are refused,\n{warned} are drawn with a warning and {silent} without one. Not in the table are its {facts} codes of the severity \
         Information and\n{hints} of the severity Hint, which are about correct files.",
        version = report.version,
        errors = severity("Error"),
        warnings = severity("Warning"),
        files = rows.len(),
        refused = count(|outcome| *outcome == Refused),
        warned = count(|outcome| *outcome == Warned),
        silent = count(|outcome| matches!(outcome, Silent(_))),
        facts = severity("Information"),
        hints = severity("Hint"),
    )
}

fn line(code: &Code, row: &Row, answer: &Answer) -> String {
    let (outcome, said) = match row.outcome {
        Refused => ("refused", None),
        Warned => ("drawn with a warning", None),
        Silent(reason) => ("drawn", Some(reason)),
    };
    let lines = || answer.lines.join("<br>");
    let said = said.map_or_else(lines, str::to_owned).replace('|', "\\|");
    format!("| `{}` | {} | {} | {outcome} | {said} |", code.name, code.severity, row.what)
}
