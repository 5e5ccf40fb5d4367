//! The published report follows from its recorded rows.

use super::*;
use crate::report::chapter::Answer;
use crate::report::markdown::{write_csv, write_table};
use crate::report::published::{fields, read, records};
use std::fs;
use std::path::Path;

/// The rows of a question as they were recorded.
pub(in crate::report) fn rows(question: &str) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for line in &records() {
        let [of, case, variant, algorithm, threads, geometry, resolution, warmth, quantity, value, low, high] =
            <[String; 12]>::try_from(fields(line)).expect("as the report is written");
        if of != question {
            continue;
        }
        if !rows.last().is_some_and(|row| row.case == case && row.variant == variant) {
            let (width, height) = resolution.split_once('x').unwrap();
            let size = [width, height].map(|side| side.parse().unwrap());
            let row = Row::new(case, variant).by(algorithm).of(geometry).sized(size);
            let row = row.with_threads(threads.parse().unwrap());
            rows.push(if warmth == "warm" { row } else { row.built_anew() });
        }
        let [value, low, high]: [f64; 3] = [value, low, high].map(|number| number.parse().unwrap());
        // Rows keep the names of quantities for as long as the program runs.
        let quantity: &'static str = quantity.leak();
        let row = rows.pop().unwrap();
        rows.push(if low == value && value == high {
            row.with(quantity, value)
        } else {
            row.timed(quantity, Spread { low, median: value, high })
        });
    }
    if question == "frames" {
        frames::leave_out_what_is_beaten(&mut rows);
    }
    rows
}

/// The part of the report about a question: all of its lines but empty rows of tables.
fn chapter(title: &str) -> String {
    let text = read("accuracy-appendix.md");
    let (_, text) = text.split_once(&format!("\n## {title}\n")).unwrap();
    // What refuses a scene has a row in the table, but no figure to record.
    let is_recorded =
        |line: &&str| !(line.starts_with("| ") && line.split('|').skip(2).all(is_dash_or_blank));
    let lines = text.split("\n## ").next().unwrap().lines().filter(is_recorded);
    lines.map(|line| line.to_owned() + "\n").collect()
}

fn is_dash_or_blank(cell: &str) -> bool {
    matches!(cell.trim(), "–" | "")
}

/// The title of each question that has rows, from the list at the top of the report.
fn titles() -> Vec<String> {
    let text = read("accuracy-appendix.md");
    let parts = text.split("\n## ").skip(1).map(|part| part.lines().next().unwrap().to_owned());
    parts.filter(|title| title != "In short").collect()
}

#[test]
fn tables_and_sentences_are_those_of_the_rows() {
    for (question, title) in CHAPTERS.iter().zip(titles()) {
        let (rows, published) = (rows(question.name), chapter(&title));
        let mut cases: Vec<&str> = rows.iter().map(|row| row.case.as_str()).collect();
        cases.sort_unstable();
        cases.dedup();
        assert_eq!(published.matches("\n|---|").count(), cases.len(), "{title} has a table for each case");
        for case in cases {
            let listed: Vec<&Row> = rows.iter().filter(|row| row.case == case && row.is_listed).collect();
            let mut table = String::new();
            write_table(case, &listed, &mut table);
            assert!(published.contains(&table), "{title} has the table\n{table}");
        }
        for headline in (question.headlines)() {
            let sentence = headline.sentence(&rows);
            assert!(published.contains(&format!("- {sentence}\n")), "{title} says: {sentence}");
        }
    }
}

#[test]
fn findings_are_those_of_the_rows() {
    let said = |question: &str, found: &[String]| {
        let pixel = CHAPTERS.iter().position(|known| known.name == question).unwrap();
        let published = chapter(&titles()[pixel]);
        for sentence in found {
            assert!(published.contains(&format!("- {sentence}\n")), "{question} says: {sentence}");
        }
    };
    said("rivals", &rivals::findings(&rows("rivals")));
    said("fill", &fill::findings(&rows("fill")));
    said("line", &line::findings(&rows("line")));
    said("frames", &frames::findings(&rows("frames")));
    said("storage", &storage::findings());
    // The first is about times that are plotted alone.
    said("visibility", &visibility::findings(&rows("visibility"), &Vec::new())[1..]);
}

#[test]
fn rows_are_written_as_they_were_recorded() {
    let answer = |question: &Question| {
        let (rows, findings, plots, images) = (rows(question.name), Vec::new(), Vec::new(), Vec::new());
        let chapter = Chapter { name: question.name, title: "", text: "", rows, plots, images, findings };
        Answer { chapter, sentences: Vec::new() }
    };
    let mut written = Vec::new();
    write_csv(&CHAPTERS.iter().map(answer).collect::<Vec<_>>(), &mut written).unwrap();
    let (written, recorded) = (String::from_utf8(written).unwrap(), records());
    for (written, recorded) in written.lines().skip(1).zip(&recorded) {
        assert_eq!(written, recorded);
    }
    assert_eq!(written.lines().count(), recorded.len() + 1, "every row");
}

/// The means of the recorded scenes are the recorded means.
#[test]
fn qualities_have_their_means_over_all_scenes() {
    let recorded = rows("frames");
    for sweep in [frames::Sweep::small([480, 288]), frames::Sweep::large([1920, 1080])] {
        let means = sweep.mean_rows(&recorded);
        assert!(means.len() >= 15, "{} qualities", means.len());
        for mean in means {
            let same = recorded.iter().find(|row| row.case == mean.case && row.variant == mean.variant);
            for (mean, recorded) in mean.values.iter().zip(&same.expect("it was recorded").values) {
                assert_eq!(mean.quantity, recorded.quantity);
                assert!((mean.value / recorded.value - 1.0).abs() < 1e-9, "{mean:?} and {recorded:?}");
            }
        }
    }
}

/// Draws a published plot anew, of the same columns, and writes it.
fn redrawn(file: &str, published: &str, rows: &[Row], case: &str) -> String {
    let texts = published.split("<text").skip(1).filter_map(|part| part.split_once('>'));
    let texts: Vec<_> = texts.map(|(tag, rest)| (tag.contains("rotate("), rest)).collect();
    let quantities = rows.iter().flat_map(|row| row.values.iter().map(|value| value.quantity));
    let axes = [false, true].map(|is_upright| {
        let is_title = |text: &str, quantity: &str| text.split('<').next().unwrap().trim() == quantity;
        let titles = texts.iter().filter(|(upright, _)| *upright == is_upright);
        let quantity =
            quantities.clone().find(|quantity| titles.clone().any(|(_, text)| is_title(text, quantity)));
        quantity.expect("an axis of each kind")
    });
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(file);
    Plot::trade("", rows, case, axes).write(&path).unwrap();
    fs::read_to_string(path).unwrap()
}

/// A plot of error against time shows two columns of one table.
#[test]
fn plots_show_the_rows_of_their_tables() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plot.svg");
    let mut found = 0;
    for (question, title) in CHAPTERS.iter().zip(titles()) {
        let (rows, published) = (rows(question.name), chapter(&title));
        for part in published.split("![Error against time: ").skip(1) {
            let (case, rest) = part.split_once("](").unwrap();
            let (file, _) = rest.split_once(')').unwrap();
            let mut expected = read(file);
            if std::env::var_os("TRIGON_UPDATE_PLOTS").is_some() {
                expected = redrawn(file, &expected, &rows, case);
            }
            let mut quantities: Vec<&str> = rows
                .iter()
                .filter(|row| row.case == case)
                .flat_map(|row| row.values.iter().map(|value| value.quantity))
                .collect();
            quantities.sort_unstable();
            quantities.dedup();
            let mut pairs = quantities.iter().flat_map(|&x| quantities.iter().map(move |&y| [x, y]));
            let is_same = |axes: [&str; 2]| {
                Plot::trade("", &rows, case, axes).write(&path).unwrap();
                fs::read_to_string(&path).unwrap() == expected
            };
            let axes = pairs.find(|&axes| {
                axes.iter().all(|axis| expected.contains(axis)) && axes[0] != axes[1] && is_same(axes)
            });
            assert!(axes.is_some(), "{file} shows {case}");
            found += 1;
        }
    }
    assert!(found >= 15, "{found} plots");
}
