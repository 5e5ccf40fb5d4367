//! The report is whole: every chapter answers, and every file that the text names is there.

use super::chapter::{number, value};
use super::*;
use std::path::PathBuf;

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
    assert_eq!(told, ["line", "depth"], "each chapter reports progress");
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    report.write_appendix(folder, &Header::now(1)).unwrap();
    let text = fs::read_to_string(folder.join("accuracy-appendix.md")).unwrap();
    let links = text.split("](images/").skip(1);
    let images: Vec<&str> = links.filter_map(|rest| rest.split(')').next()).collect();
    assert_eq!(
        images,
        [
            "accuracy-line-lines.svg",
            "accuracy-line-lines.png",
            "accuracy-depth-resolved.svg",
            "accuracy-depth-road.png"
        ],
        "in order"
    );
    for image in images {
        let file = fs::read(folder.join("images").join(image)).unwrap();
        assert!(file.len() > 500, "{image} holds an image");
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
    let csv = fs::read_to_string(folder.join("accuracy.csv")).unwrap();
    let fields = csv
        .lines()
        .filter(|line| line.starts_with("depth,at 10 m,16 bit,16 bit,1,at 10 m,0x0,warm,bytes,2,2,2"));
    assert_eq!(fields.count(), 1, "a line for each number");
}

/// The headlines of chapters find their rows, which differ in one condition: a sentence panics
/// otherwise. Those that take minutes in a debug build are held by the published rows alone.
#[test]
fn quick_chapters_answer() {
    const SLOW: [&str; 5] = ["fill", "visibility", "threads", "frames", "effects"];
    let has_headlines = |question: &&Question| !(question.headlines)().is_empty();
    for question in CHAPTERS.iter().filter(has_headlines).filter(|question| !SLOW.contains(&question.name)) {
        let answer = Answer::measure(question, Effort::Once);
        assert!(!answer.sentences.is_empty(), "{} has a headline", question.name);
    }
}

/// Whether published files are to be written anew from what follows from the rows, instead of being compared with it. The page follows
/// from `accuracy.csv`, so a second run writes what the first one changed there.
fn is_updating() -> bool {
    std::env::var_os("TRIGON_UPDATE_RIVALS").is_some()
}

/// A file of the repository.
fn repository(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file)
}

/// Expects a text between two marks in a file of the repository.
fn hold(file: &str, marks: [&str; 2], expected: &str) {
    let path = repository(file);
    let text = fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once(marks[0]).unwrap_or_else(|| panic!("{file} has no {:?}", marks[0]));
    let (shown, after) = rest.split_once(marks[1]).unwrap_or((rest, ""));
    if is_updating() {
        let end = if after.is_empty() { "" } else { marks[1] };
        fs::write(&path, [before, marks[0], expected, end, after].concat()).unwrap();
    } else {
        assert_eq!(shown, expected, "TRIGON_UPDATE_RIVALS=1 writes it into {file}");
    }
}

/// The README and the published report show what the published files say of other renderers.
#[test]
fn the_readme_and_the_report_show_the_published_rivals() {
    hold(
        "README.md",
        ["<!-- rivals -->\n", "<!-- end of rivals -->"],
        &format!("{}\n", chapters::rivals::summary()),
    );
    let question = CHAPTERS.iter().find(|question| question.name == "rivals").unwrap();
    let chapter = question.measure;
    let answer = Answer { chapter: chapter(Effort::Quick), sentences: Vec::new() };
    let mut text = String::new();
    markdown::write_chapter(&answer, &mut text);
    let title = format!("\n## {}\n", answer.chapter.title);
    let (_, text) = text.split_once(&title).unwrap();
    hold("docs/accuracy-appendix.md", [&title, "\n## "], text);
    for plot in &answer.chapter.plots {
        let path = repository("docs/images").join(plot.file(answer.chapter.name));
        if is_updating() {
            plot.write(&path).unwrap();
        }
        assert!(path.exists(), "{} is shown", path.display());
    }
    hold_rows(&answer);
}

/// Expects a chapter's rows in the published file.
fn hold_rows(answer: &Answer) {
    let mut rows = Vec::new();
    markdown::write_csv(std::slice::from_ref(answer), &mut rows).unwrap();
    let rows = String::from_utf8(rows).unwrap();
    let expected: Vec<&str> = rows.lines().skip(1).collect();
    let path = repository("docs/accuracy.csv");
    let text = fs::read_to_string(&path).unwrap();
    let is_own = |line: &&str| line.split(',').next() == Some(answer.chapter.name);
    if is_updating() {
        let before = text.lines().take_while(|line| !is_own(line));
        let after = text.lines().skip_while(|line| !is_own(line)).filter(|line| !is_own(line));
        let lines: Vec<&str> = before.chain(expected).chain(after).collect();
        fs::write(path, lines.join("\n") + "\n").unwrap();
    } else {
        let shown: Vec<&str> = text.lines().filter(is_own).collect();
        assert_eq!(shown, expected, "TRIGON_UPDATE_RIVALS=1 writes them");
    }
}

/// The report that is published, with all rows behind it.
mod recorded {
    use super::*;
    use crate::report::published::{fields, read};
    use std::collections::BTreeMap;

    /// A row of the file: its conditions, and its values by quantity.
    #[derive(Default)]
    struct Recorded {
        conditions: Vec<String>,
        values: BTreeMap<String, f64>,
    }

    /// All rows by question, table and name.
    fn records() -> BTreeMap<[String; 3], Recorded> {
        let mut records: BTreeMap<[String; 3], Recorded> = BTreeMap::new();
        for line in &published::records() {
            let fields: [String; 12] = fields(line).try_into().unwrap();
            let [
                question,
                case,
                variant,
                algorithm,
                threads,
                geometry,
                resolution,
                warmth,
                quantity,
                value,
                ..,
            ] = fields;
            let record = records.entry([question, case, variant]).or_default();
            record.conditions = vec![algorithm, threads, geometry, resolution, warmth];
            record.values.insert(quantity, value.parse().unwrap());
        }
        records
    }

    /// Its sentences under "In short".
    fn in_short() -> Vec<String> {
        let text = read("accuracy-appendix.md");
        let part = text.split("## In short").nth(1).unwrap().split("\n## ").next().unwrap();
        part.lines().filter_map(|line| line.strip_prefix("  - ")).map(str::to_owned).collect()
    }

    /// What a sentence says of a quantity: the text up to the next one, or to the sentence's end.
    fn said<'a>(sentence: &'a str, quantity: &str) -> &'a str {
        let said = sentence.split_once(&format!("{quantity}: ")).unwrap_or_else(|| panic!("{sentence}")).1;
        said.split_once(';').map_or(said, |(said, _)| said)
    }

    /// Headlines divide the two rows that they name, as the file has them, and these differ in one
    /// condition. All that is told in short is such a headline.
    #[test]
    fn headlines_follow_from_the_recorded_rows() {
        let records = records();
        let mut sentences = in_short().into_iter();
        for question in CHAPTERS {
            for headline in (question.headlines)() {
                let sentence = sentences.next().unwrap_or_else(|| panic!("{headline:?} is told"));
                let [above, below] = [&headline.numerator, &headline.denominator]
                    .map(|key| &records[&[question.name.to_owned(), key.case.clone(), key.variant.clone()]]);
                let pairs = above.conditions.iter().zip(&below.conditions);
                let differing: Vec<_> = pairs.filter(|(one, other)| one != other).collect();
                assert_eq!(differing.len(), 1, "{sentence} compares {differing:?}");
                for quantity in &headline.quantities {
                    let [a, b] = [above, below].map(|record| record.values[*quantity]);
                    holds(said(&sentence, quantity), [a, b], headline::is_time(quantity));
                }
            }
        }
        assert_eq!(sentences.next(), None, "nothing else is told");
    }

    /// Over all scenes no quality is both faster and more accurate than a preset, by more than what is measurable.
    #[test]
    fn presets_lie_on_the_front() {
        const CASE: &str = "all scenes, geometric means";
        let records = records();
        let points: Vec<(&str, [f64; 2])> = records
            .iter()
            .filter(|([question, case, _], _)| question == "frames" && case == CASE)
            .map(|([.., variant], record)| {
                (
                    variant.as_str(),
                    ["ms per frame", "RMSE in linear light"].map(|quantity| record.values[quantity]),
                )
            })
            .collect();
        let presets: Vec<_> = points.iter().filter(|(variant, _)| variant.ends_with(')')).collect();
        assert_eq!(presets.len(), 4, "all presets were measured");
        for (preset, own) in presets {
            let beats = |other: &[f64; 2]| (0..2).all(|axis| other[axis] < 0.85 * own[axis]);
            let better: Vec<_> = points.iter().filter(|(_, other)| beats(other)).collect();
            assert!(better.is_empty(), "{preset} takes and misses {own:?}, but there is {better:?}");
        }
    }

    /// Whether what is said of two numbers is so.
    fn holds(said: &str, [a, b]: [f64; 2], is_time: bool) {
        if a != b && a * b == 0.0 {
            assert!(
                said.starts_with(&format!("{} instead of {}", number(a), number(b))),
                "{a} and {b}: {said}"
            );
            return;
        }
        assert_eq!(said.starts_with("the same"), a == b, "{a} and {b}: {said}");
        let is_near = is_time && a != b && (0.85..=1.15).contains(&(a / b));
        assert_eq!(said.starts_with("no measurable difference"), is_near, "{a} and {b}: {said}");
        assert!(said.contains(&format!("({} / {})", number(a), number(b))), "{a} and {b}: {said}");
        if let Some((times, _)) = said.split_once('×') {
            let times: f64 = times.parse().unwrap();
            // Three digits are told: off by half a unit of the third, at most 0.5 %.
            assert!((times / (a / b) - 1.0).abs() <= 0.005, "{a} and {b}: {said}");
        }
    }

    /// The page follows from the rows, and is short enough to be read.
    #[test]
    fn the_page_is_that_of_the_rows() {
        let header = Header::parse(&read("accuracy.csv")).expect("the file says when it was measured");
        let [frames, effects, line, rivals] =
            ["frames", "effects", "line", "rivals"].map(chapters::tests::rows);
        let recorded = page::Recorded {
            header: &header,
            frames: &frames,
            effects: &effects,
            line: &line,
            rivals: &rivals,
        };
        if is_updating() {
            fs::write(repository("docs/accuracy.md"), page::page(&recorded)).unwrap();
            for panel in page::panels(&recorded) {
                fs::write(repository("docs/images").join(panel.file()), panel.svg()).unwrap();
            }
        }
        let (expected, shown) = (page::page(&recorded), read("accuracy.md"));
        for (expected, shown) in expected.lines().zip(shown.lines()) {
            assert_eq!(expected, shown);
        }
        assert_eq!(expected.lines().count(), shown.lines().count(), "every line");
        assert!(shown.lines().count() <= 250, "{} lines", shown.lines().count());
        for panel in page::panels(&recorded) {
            assert!(
                panel.svg() == read(&format!("images/{}", panel.file())),
                "{} shows the rows",
                panel.file()
            );
        }
        for image in shown.split("](images/").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert!(read(&format!("images/{image}")).len() > 500, "{image} is there");
        }
    }

    /// What has twice the samples, and else is the same, takes no less time, beyond the quartiles of both; but for one pair in
    /// two hundred: a quarter of the frames lies beyond each quartile, and there are few frames.
    #[test]
    fn hardly_a_time_contradicts_another() {
        let [pairs, contradicting] = page::contradictions(&chapters::tests::rows("frames"));
        assert!(pairs > 500 && 200 * contradicting < pairs, "{contradicting} of {pairs} pairs");
    }

    /// The truth is known twice as well as the best image of each scene: its own error changes no other by more than a seventh.
    #[test]
    fn the_truth_is_closer_than_any_image() {
        use chapters::frames::Sweep;
        use chapters::frames::sweep::BOUND;
        let rows = chapters::tests::rows("frames");
        let mut scenes = 0;
        for sweep in [Sweep::small([480, 288]), Sweep::large([1920, 1080])] {
            for case in sweep.cases() {
                let bound = value(&rows, &sweep.truths(), case.name(), BOUND);
                let of_case = rows.iter().filter(|row| row.case == sweep.case(*case));
                let errors = of_case.filter_map(|row| row.value(chapters::frames::RMSE));
                let least = errors.fold(f64::INFINITY, f64::min);
                assert!(2.0 * bound < least, "{}: {bound} beside {least}", sweep.case(*case));
                scenes += 1;
            }
        }
        assert_eq!(scenes, 12 + 4, "at both sizes");
    }
}
