//! The results as tables in `docs/mutation.md`, and as `tests/mutants/results.csv`.

use crate::draw::{Dropped, Sample};
use crate::error::{Error, Result, at};
use crate::results::{Outcome, Results, load};
use crate::{CRATES, Folder, workspace};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;

/// All after this line of the page is written anew.
const MARKER: &str = "<!-- From here on written by `trigon-mutants report`. -->\n";
/// Why mutants survive: a line "identity => equivalent: reason", or "open" instead of "equivalent".
const REASONS: &str = "tests/mutants/survivors.txt";

/// A mutant of the sample with what happened to it.
struct Row<'a> {
    krate: &'a str,
    identity: &'a str,
    outcome: Outcome,
    by: &'a str,
    survived_before: bool,
}

/// Writes the page and the file.
pub(crate) fn report(folder: &Folder) -> Result<()> {
    let sample = Sample::load(&folder.state("sample.json"))?;
    let mut results = BTreeMap::new();
    for krate in CRATES {
        results.insert(krate, load(folder, krate)?);
    }
    let rows = rows(&sample, &results);
    let reasons = reasons()?;
    let path = workspace().join("docs/mutation.md");
    let page = at(&path, fs::read_to_string(&path))?;
    let head = page.split(MARKER).next().unwrap_or_default();
    let generated = [
        scores(&sample, &rows, &reasons),
        list("Timed out", rows.iter().filter(|row| row.outcome == Outcome::TimedOut).map(timed_out)),
        list(
            "Survivors",
            rows.iter().filter(|row| !row.outcome.is_detected()).map(|row| survivor(row, &reasons)),
        ),
        dropped(&sample),
    ];
    at(&path, fs::write(&path, format!("{head}{MARKER}{}", generated.concat())))?;
    let path = workspace().join("tests/mutants/results.csv");
    at(&path, fs::write(&path, csv(&rows)))
}

fn rows<'a>(sample: &'a Sample, results: &'a BTreeMap<&str, Results>) -> Vec<Row<'a>> {
    let row = |krate: &'a str, identity: &'a str| {
        let found = results.get(krate)?.get(identity)?;
        let by = found.by.as_deref().unwrap_or_default();
        Some(Row { krate, identity, outcome: found.outcome, by, survived_before: found.survived_before })
    };
    sample.drawn.iter().filter_map(|drawn| row(&drawn.krate, &drawn.identity)).collect()
}

/// By identity: whether the mutant is equivalent, and why it survives.
fn reasons() -> Result<BTreeMap<String, (bool, String)>> {
    let path = workspace().join(REASONS);
    let text = at(&path, fs::read_to_string(&path))?;
    let mut reasons = BTreeMap::new();
    for line in text.lines().filter(|line| !line.is_empty()) {
        let parts =
            line.split_once(" => ").and_then(|(identity, rest)| Some((identity, rest.split_once(": ")?)));
        let Some((identity, (kind @ ("equivalent" | "open"), reason))) = parts else {
            return Err(Error::Usage(format!("{REASONS}: {line}")));
        };
        reasons.insert(identity.to_owned(), (kind == "equivalent", reason.to_owned()));
    }
    Ok(reasons)
}

fn percent(part: usize, whole: usize) -> String {
    // Per mille, rounded down: 90 % is reached, not nearly reached.
    let mille = part * 1000 / whole.max(1);
    format!("{}.{} %", mille / 10, mille % 10)
}

fn scores(sample: &Sample, rows: &[Row], reasons: &BTreeMap<String, (bool, String)>) -> String {
    let mut text = format!(
        "\n## Score\nAt commit `{}`.\n\n\
         | crate | listed | sample | caught | timed out | survived | of these equivalent | score | without equivalent | before |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
        sample.commit.get(..8).unwrap_or_default()
    );
    for krate in CRATES {
        let own: Vec<&Row> = rows.iter().filter(|row| row.krate == krate).collect();
        let count = |is: &dyn Fn(&Row) -> bool| own.iter().filter(|row| is(row)).count();
        let detected = count(&|row| row.outcome.is_detected());
        let is_equivalent = |row: &Row| reasons.get(row.identity).is_some_and(|reason| reason.0);
        let equivalent = count(&|row| !row.outcome.is_detected() && is_equivalent(row));
        let _ = writeln!(
            text,
            "| {krate} | {} | {} | {} | {} | {} | {equivalent} | **{}** | {} | {} |",
            sample.listed.get(krate).copied().unwrap_or_default(),
            own.len(),
            count(&|row| row.outcome == Outcome::Caught),
            count(&|row| row.outcome == Outcome::TimedOut),
            own.len() - detected,
            percent(detected, own.len()),
            percent(detected, own.len() - equivalent),
            percent(count(&|row| row.outcome.is_detected() && !row.survived_before), own.len()),
        );
    }
    text
}

fn list(title: &str, lines: impl Iterator<Item = String>) -> String {
    let lines: String = lines.map(|line| format!("- {line}\n")).collect();
    format!("\n## {title}\n{}", if lines.is_empty() { "None.\n" } else { &lines })
}

fn timed_out(row: &Row) -> String {
    format!("`{}`, in `{}`", row.identity, row.by)
}

fn survivor(row: &Row, reasons: &BTreeMap<String, (bool, String)>) -> String {
    let (kind, reason) = match reasons.get(row.identity) {
        Some((true, reason)) => ("equivalent", reason.as_str()),
        Some((false, reason)) => ("open", reason.as_str()),
        None => ("open", "not looked at yet"),
    };
    let reached = if row.outcome == Outcome::NotReached { "; no test reaches it" } else { "" };
    format!("`{}`: {kind}{reached}. {reason}", row.identity)
}

fn dropped(sample: &Sample) -> String {
    let by_reason = |reason: Dropped| {
        let of = sample.dropped.iter().filter(move |(_, found)| **found == reason);
        of.map(|(identity, _)| format!("`{identity}`"))
    };
    let title = |text: &str, reason| list(&format!("Drawn, not tested: {text}"), by_reason(reason));
    title("these cannot be switched", Dropped::CannotBeSwitched)
        + &title("not compiled on this processor with the default features", Dropped::NotCompiledHere)
        + &title("these do not compile", Dropped::DoesNotCompile)
}

fn csv(rows: &[Row]) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut text = "crate,mutant,outcome,test\n".to_owned();
    for row in rows {
        let _ = writeln!(text, "{},{},{:?},{}", row.krate, quoted(row.identity), row.outcome, quoted(row.by));
    }
    text
}
