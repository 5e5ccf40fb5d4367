//! Writes the report as Markdown, and its numbers as CSV. Images lie side by side.

use std::fmt::Write as _;
use std::fs::File;
use std::io;
use std::io::{BufWriter, Write};
use std::path::Path;

use image::RgbImage;
use image::codecs::png::PngEncoder;
use trigon_classic::Field;

use super::chapter::{Answer, Conditions, Row, Value, Warmth, number};
use super::header::Header;

/// How to read the sentences.
const RULES: &str = "Each sentence divides one row of the tables below by another one; the two figures stand in brackets. The \
                     two rows differ in what is printed in bold and in nothing else that is recorded: algorithm, \
                     threads, geometry, resolution, and whether memory, threads and trees are kept from run to run \
                     (warm). Times within 15 % of each other are no measurable difference; errors and counts are compared exactly. All \
                     rows with their conditions are in `accuracy.csv`, and a test divides them again.\n\n";

/// All tables, and the sentences about them.
pub(super) fn appendix(header: &Header, answers: &[Answer]) -> String {
    let mut text = String::from("# What accuracy costs in time: all tables\n\n");
    let _ = writeln!(
        text,
        "[What a millisecond buys](accuracy.md) sums up what follows. {} Tests hold the errors, which are the same on every machine, with two \
         exceptions: fused operations and estimated reciprocals are the processor's, and predictions of times and errors follow from \
         measured times. Everything runs on one thread unless told otherwise. Brackets hold the quartiles of all runs. The algorithms and \
         their sources are in `crates/study/src`, a folder for each question.\n",
        header.words()
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
    let letters = title.chars().filter(|c| c.is_alphanumeric() || *c == ' ' || *c == '-');
    letters.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
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

/// Some images of the same size next to each other.
pub(super) struct ImageRow {
    name: &'static str,
    pub(super) caption: String,
    pub(super) panels: Vec<Field<[u8; 3]>>,
}

impl ImageRow {
    /// Images from left to right.
    pub(super) fn new(name: &'static str, caption: impl Into<String>, panels: Vec<Field<[u8; 3]>>) -> Self {
        Self { name, caption: caption.into(), panels }
    }

    pub(super) fn file(&self, chapter: &str) -> String {
        format!("accuracy-{chapter}-{}.png", self.name)
    }

    pub(super) fn write(&self, path: &Path) -> io::Result<()> {
        // Not `save`, which chooses by the file's name and so compiles every encoder.
        let file = BufWriter::new(File::create(path)?);
        self.composed().write_with_encoder(PngEncoder::new(file)).map_err(io::Error::other)
    }

    /// Small pixels are shown large: panels are enlarged to about 256 pixels.
    fn composed(&self) -> RgbImage {
        const GAP: u32 = 8;
        let [width, height] = self.panels[0].size();
        let zoom = (256 / width).max(1);
        let [wide, high] = [width, height].map(|side| (side * zoom) as u32);
        let count = self.panels.len() as u32;
        RgbImage::from_fn(count * (wide + GAP) - GAP, high, |x, y| {
            let (panel, column) = (x / (wide + GAP), x % (wide + GAP));
            let pixel = [column, y].map(|part| part as usize / zoom);
            image::Rgb(if column < wide { self.panels[panel as usize][pixel] } else { [255; 3] })
        })
    }
}

/// Grey values, 0 to 1 of linear light, as bytes.
pub(super) fn grey(light: f64) -> [u8; 3] {
    [trigon_math::color::linear_to_srgb8(light as f32); 3]
}

/// How wrong something is, from black over red and yellow to white, 1 and above.
pub(super) fn heat(error: f64) -> [u8; 3] {
    [0.0, 1.0, 2.0].map(|start| ((error * 3.0 - start).clamp(0.0, 1.0) * 255.0) as u8)
}

/// A colour for a number, to tell neighbours apart.
pub(super) fn tint(number: u32) -> [u8; 3] {
    let bits = u64::from(number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    [16, 32, 48].map(|shift| 64 + (bits >> shift & 0x7f) as u8)
}

/// The faces of an image in colours; nothing is dark.
pub(super) fn tinted(faces: &Field<u32>) -> Field<[u8; 3]> {
    faces.map(|&face| if face == u32::MAX { [24; 3] } else { tint(face) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_are_side_by_side_and_enlarged() {
        let panel = |red: u8| Field::from_fn([100, 3], |[x, y]| [red, x as u8, y as u8]);
        let row = ImageRow::new("name", "caption", vec![panel(1), panel(2), panel(3)]);
        let image = row.composed();
        // Twice 100 is the most that is at most 256; the gaps are 8 wide.
        assert_eq!(image.dimensions(), (3 * 200 + 2 * 8, 6));
        for (x, y, color) in image.enumerate_pixels() {
            let (number, column) = (x / 208, x % 208);
            let expected =
                if column < 200 { [number as u8 + 1, (column / 2) as u8, (y / 2) as u8] } else { [255; 3] };
            assert_eq!(color.0, expected, "{x}, {y}");
        }
        assert_eq!(row.file("line"), "accuracy-line-name.png");
        let large = ImageRow::new("name", "caption", vec![Field::new([300, 2], [0; 3])]);
        assert_eq!(large.composed().dimensions(), (300, 2), "large pixels are left as they are");
    }

    #[test]
    fn heat_runs_from_black_over_red_and_yellow_to_white() {
        let found = [-1.0, 0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0, 7.0].map(heat);
        assert_eq!(
            found,
            [[0; 3], [0; 3], [255, 0, 0], [255, 255, 0], [255; 3], [255; 3]],
            "each third is a channel"
        );
        assert_eq!(heat(0.5), [255, 127, 0], "half of the second");
    }

    #[test]
    fn greys_are_bytes_of_srgb() {
        assert_eq!([0.0, 0.5, 1.0].map(grey), [[0; 3], [188; 3], [255; 3]]);
    }

    #[test]
    fn neighbours_have_different_colours_and_none_is_dark() {
        for number in 0..2000 {
            let [one, next] = [number, number + 1].map(tint);
            assert!(one.iter().all(|channel| (64..192).contains(channel)), "{one:?}");
            let differs: u32 = one.iter().zip(next).map(|(a, b)| u32::from(a.abs_diff(b))).sum();
            assert!(differs > 20, "{number}: {one:?} and {next:?}");
        }
        let faces = Field::from_fn([2, 1], |[x, _]| if x == 0 { u32::MAX } else { 5 });
        assert_eq!(tinted(&faces).values(), [[24; 3], tint(5)], "nothing is dark");
    }
}
