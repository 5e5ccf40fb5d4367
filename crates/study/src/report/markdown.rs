//! Writes the report as Markdown, and its numbers as CSV.

use super::chapter::{Answer, Effort};
use super::figures::{Conditions, Row, Value, Warmth, number};
use std::fmt::Write as _;
use std::io::{self, Write};

/// How to read the sentences.
const RULES: &str = "Each sentence divides one row of the tables below by another one; the two figures stand in brackets. The \
                     two rows differ in what is printed in bold and in nothing else that is recorded: algorithm, \
                     threads, geometry, resolution, and whether memory, threads and trees are kept from run to run \
                     (warm). What lies within 15 % of 1 is no measurable difference. All rows with their conditions are \
                     in `results.csv` beside the report (here `docs/accuracy.csv`), and a test divides them \
                     again.\n\n";

/// The whole report.
pub(super) fn report(effort: Effort, answers: &[Answer]) -> String {
    let mut text = String::from("# What accuracy costs in time\n\n");
    let command = effort.pick("trigon-study --quick", "trigon-study");
    let _ = writeln!(
        text,
        "Made by `{command}`. Tests hold the errors, which are the same on every machine, with two exceptions: fused operations and \
         estimated reciprocals are the processor's, and predictions of times and errors follow from measured times. Times were measured by that \
         command on {}, on one thread unless told otherwise: \
         medians of runs in turn, with memory allocated anew up to three times. The algorithms and their sources \
         are in `crates/study/src`, a folder for each question.\n",
        processor()
    );
    text.push_str("## In short\n\n");
    text.push_str(RULES);
    for Answer { chapter, sentences } in answers.iter().filter(|answer| !answer.sentences.is_empty()) {
        let _ = writeln!(text, "- [{}](#{})", chapter.title, anchor(chapter.title));
        for sentence in sentences {
            let _ = writeln!(text, "  - {sentence}");
        }
    }
    for answer in answers {
        write_chapter(answer, &mut text);
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

pub(super) fn write_chapter(Answer { chapter, sentences }: &Answer, text: &mut String) {
    let _ = write!(text, "\n## {}\n\n{}\n\n", chapter.title, chapter.text);
    for sentence in sentences.iter().chain(&chapter.findings) {
        let _ = writeln!(text, "- {sentence}");
    }
    let mut cases: Vec<&str> = Vec::new();
    for row in &chapter.rows {
        if !cases.contains(&row.case.as_str()) {
            cases.push(&row.case);
        }
    }
    for case in cases {
        let rows: Vec<&Row> = chapter.rows.iter().filter(|row| row.case == case && row.is_listed).collect();
        write_table(case, &rows, text);
    }
    for plot in &chapter.plots {
        let _ = write!(text, "\n![{}](images/{})\n", plot.title, plot.file(chapter.name));
    }
    for image in &chapter.images {
        let _ = write!(text, "\n![{0}](images/{1})\n\n*{0}*\n", image.caption, image.file(chapter.name));
    }
}

/// A table of one case: a line for each variant, a column for each quantity.
pub(super) fn write_table(case: &str, rows: &[&Row], text: &mut String) {
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
pub(super) fn write_csv(answers: &[Answer], file: &mut impl Write) -> io::Result<()> {
    writeln!(file, "question,case,variant,{},quantity,value,low,high", Conditions::NAMES.join(","))?;
    for Answer { chapter, .. } in answers {
        for row in &chapter.rows {
            let Conditions { algorithm, threads, geometry, resolution: [width, height], warmth } =
                &row.conditions;
            let warmth = if *warmth == Warmth::Warm { "warm" } else { "built anew" };
            let [question, case, variant, algorithm, geometry] =
                [chapter.name, &row.case, &row.variant, algorithm, geometry].map(quoted);
            for Value { quantity, value, range } in &row.values {
                let [low, high] = range.unwrap_or([*value; 2]);
                let quantity = quoted(quantity);
                write!(
                    file,
                    "{question},{case},{variant},{algorithm},{threads},{geometry},{width}x{height},{warmth},"
                )?;
                writeln!(file, "{quantity},{value},{low},{high}")?;
            }
        }
    }
    Ok(())
}

/// As RFC 4180 wants a field with a comma.
fn quoted(word: &str) -> String {
    if word.contains([',', '"']) { format!("\"{}\"", word.replace('"', "\"\"")) } else { word.to_owned() }
}
