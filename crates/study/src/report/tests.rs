//! The report is whole: every chapter answers, and every file that the text names is there.

use super::figures::number;
use super::*;

#[test]
fn numbers_keep_three_digits() {
    let written = [0.0, 0.001234, 0.5, 1.0, 12.345, 123.4, 56789.0, 1.2e-9, f64::NAN].map(number);
    assert_eq!(
        written,
        ["0", "0.00123", "0.500", "1.00", "12.3", "123", "56789", "1.20e-9", "–"],
        "in tables"
    );
}

/// Of two chapters that are soon measured.
#[test]
fn everything_that_the_report_names_is_written() {
    let mut told = Vec::new();
    let chapters = [CHAPTERS[2], CHAPTERS[5]];
    let report = Report::of(&chapters, Effort::Quick, |progress| told.push(progress.chapter));
    assert_eq!(told, ["line", "depth"], "progress is told of each chapter");
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    report.write(folder).unwrap();
    let text = fs::read_to_string(folder.join("report.md")).unwrap();
    let links = text.split("](images/").skip(1);
    let images: Vec<&str> = links.filter_map(|rest| rest.split(')').next()).collect();
    assert_eq!(
        images,
        ["accuracy-line-lines.svg", "accuracy-line-lines.png", "accuracy-depth-resolved.svg"],
        "in order"
    );
    for image in images {
        let file = fs::read(folder.join("images").join(image)).unwrap();
        assert!(file.len() > 500, "{image} holds a picture");
    }
    for answer in &report.answers {
        for sentence in &answer.sentences {
            assert_eq!(
                text.matches(sentence.as_str()).count(),
                2,
                "in short, and in its chapter: {sentence}"
            );
        }
    }
    let csv = fs::read_to_string(folder.join("results.csv")).unwrap();
    let fields = csv
        .lines()
        .filter(|line| line.starts_with("depth,at 10 m,16 bit,16 bit,1,at 10 m,0x0,warm,bytes,2,2,2"));
    assert_eq!(fields.count(), 1, "a line for each number");
}

/// Every chapter's headlines find their rows, which differ in one condition: a sentence panics
/// otherwise.
#[test]
fn every_chapter_answers() {
    for question in CHAPTERS {
        let answer = Answer::measure(&question, Effort::Once);
        assert!(!answer.sentences.is_empty(), "{} has a headline", question.name);
    }
}
