//! The report as text, and its numbers as a list.

use super::figures::{Row, Value, number};
use super::{Chapter, Effort};
use std::fmt::Write as _;
use std::io::{self, Write};

/// The whole report.
pub(super) fn report(effort: Effort, chapters: &[Chapter]) -> String {
    let mut text = String::from("# What accuracy costs in time\n\n");
    let command = if effort == Effort::Quick { "trigon-viewer study --quick" } else { "trigon-viewer study" };
    let _ = writeln!(
        text,
        "Made by `{command}`. Errors are the same on every machine and held by tests; times were measured by that \
         command on {}: medians of runs in turn, one thread unless told otherwise. The algorithms and their sources \
         are in `crates/study/src`, a folder for each question.\n",
        processor()
    );
    text.push_str("## In short\n\n");
    for chapter in chapters {
        let finding = chapter.findings.first().map_or("", String::as_str);
        let _ = writeln!(text, "- [{}](#{}) {finding}", chapter.title, anchor(chapter.title));
    }
    for chapter in chapters {
        write_chapter(chapter, &mut text);
    }
    text
}

/// As GitHub makes them of titles.
fn anchor(title: &str) -> String {
    let kept = title.chars().filter(|c| c.is_alphanumeric() || *c == ' ' || *c == '-');
    kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
}

fn processor() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    let model = model.map_or("a processor that does not tell its name", |(_, name)| name.trim());
    format!("{model} ({threads} threads)")
}

fn write_chapter(chapter: &Chapter, text: &mut String) {
    let _ = write!(text, "\n## {}\n\n{}\n\n", chapter.title, chapter.text);
    for finding in &chapter.findings {
        let _ = writeln!(text, "- {finding}");
    }
    let mut cases: Vec<&str> = Vec::new();
    for row in &chapter.rows {
        if !cases.contains(&row.case.as_str()) {
            cases.push(&row.case);
        }
    }
    for case in cases {
        let rows: Vec<&Row> = chapter.rows.iter().filter(|row| row.case == case).collect();
        write_table(case, &rows, text);
    }
    for plot in &chapter.plots {
        let _ = write!(text, "\n![{}](images/{})\n", plot.title, plot.file(chapter.name));
    }
    for picture in &chapter.pictures {
        let _ = write!(text, "\n![{0}](images/{1})\n\n*{0}*\n", picture.caption, picture.file(chapter.name));
    }
}

/// A table of one case: a line for each variant, a column for each quantity.
fn write_table(case: &str, rows: &[&Row], text: &mut String) {
    let mut quantities: Vec<&str> = Vec::new();
    for value in rows.iter().flat_map(|row| &row.values) {
        if !quantities.contains(&value.quantity) {
            quantities.push(value.quantity);
        }
    }
    let _ = write!(text, "\n| {case} |");
    quantities.iter().for_each(|quantity| {
        let _ = write!(text, " {quantity} |");
    });
    let _ = writeln!(text, "\n|---|{}", "--:|".repeat(quantities.len()));
    for row in rows {
        let _ = write!(text, "| {} |", row.variant);
        for quantity in &quantities {
            let value = row.values.iter().find(|value| value.quantity == *quantity);
            let _ = write!(text, " {} |", value.map_or_else(|| "–".to_owned(), cell));
        }
        text.push('\n');
    }
}

fn cell(value: &Value) -> String {
    match value.range {
        Some([low, high]) => format!("{} ({}–{})", number(value.value), number(low), number(high)),
        None => number(value.value),
    }
}

/// A line for each number.
pub(super) fn write_csv(chapters: &[Chapter], file: &mut impl Write) -> io::Result<()> {
    writeln!(file, "question,case,variant,quantity,value,low,high")?;
    for chapter in chapters {
        for row in &chapter.rows {
            for Value { quantity, value, range } in &row.values {
                let [low, high] = range.unwrap_or([*value; 2]);
                let words = [chapter.name, &row.case, &row.variant, quantity].map(quoted);
                writeln!(file, "{},{value},{low},{high}", words.join(","))?;
            }
        }
    }
    Ok(())
}

/// As RFC 4180 wants a field with a comma.
fn quoted(word: &str) -> String {
    if word.contains([',', '"']) { format!("\"{}\"", word.replace('"', "\"\"")) } else { word.to_owned() }
}
