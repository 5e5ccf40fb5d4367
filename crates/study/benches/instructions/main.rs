//! Writes `docs/accuracy-instructions.md`: how many instructions an image takes at each of the qualities from which a time
//! budget chooses. It needs valgrind, and no quiet machine.
//!
//! `cargo bench -p trigon-study --bench instructions -- docs`

mod callgrind;

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use callgrind::{instructions, switch_counting};
use trigon_scene::quality::{Quality, candidates};
use trigon_study::frames::{FrameCase, Repeated, name, usual};
use trigon_study::report::Header;

const CASES: [FrameCase; 4] = [FrameCase::Showcase, FrameCase::Shadows, FrameCase::Chair, FrameCase::Passage];

/// Pixels of the small images of `docs/accuracy.md`.
const SIZE: [u32; 2] = [480, 288];

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["count", case, quality] => draw_counted(case.parse()?, quality.parse()?),
        [folder] => write(Path::new(folder)),
        _ => Err("name the folder to write to, such as docs".into()),
    }
}

/// Draws an image twice: once to fill caches, and once for callgrind, within which this program then runs.
fn draw_counted(case: usize, quality: usize) -> Result<(), Box<dyn Error>> {
    let case = *CASES.get(case).ok_or("there is no such case")?;
    let quality = *candidates().get(quality).ok_or("there is no such quality")?;
    let mut repeated = Repeated::new(case, SIZE, quality).on_threads(NonZeroUsize::MIN);
    repeated.draw(0.0)?;
    switch_counting("on")?;
    repeated.draw(0.0)?;
    switch_counting("off")
}

fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    let Header { date, commit, .. } = Header::now(0);
    let mut text = format!(
        "# Instructions of an image\n\nTimes of [What a millisecond buys](accuracy.md) vary with the machine and its load. These numbers \
         hardly do: millions of instructions of one warm frame of {}×{} pixels, on one thread at AVX2, counted by callgrind on {date} \
         at commit {commit}.\n\n    cargo bench -p trigon-study --bench instructions -- docs\n\n| |",
        SIZE[0], SIZE[1]
    );
    CASES.iter().try_for_each(|case| write!(text, " {} |", case.name()))?;
    write!(text, "\n|---|{}\n", "--:|".repeat(CASES.len()))?;
    let mut counts = Vec::new();
    for (number, &quality) in candidates().iter().enumerate() {
        let row = count(number, quality)?;
        write!(text, "| {} |", name(quality))?;
        row.iter().try_for_each(|count| match count {
            Some(count) => write!(text, " {:.1} |", count / 1e6),
            None => write!(text, " – |"),
        })?;
        text.push('\n');
        counts.push((quality, row));
    }
    let [pairs, fewer] = doubled(&counts);
    writeln!(
        text,
        "\nA dash stands where nothing casts shadows, so that another line says the same. Of {pairs} pairs of images of which one has at least twice \
         the samples of the other and is like it otherwise, {fewer} take fewer instructions for more samples."
    )?;
    Ok(fs::write(folder.join("accuracy-instructions.md"), text)?)
}

/// The instructions of all cases at a quality; none where its shadows make no difference.
fn count(number: usize, quality: Quality) -> Result<Vec<Option<f64>>, Box<dyn Error>> {
    let of_case = |(index, case): (usize, &FrameCase)| {
        let is_like_another = !case.has_shadows() && usual(quality) != quality;
        let counted = || instructions(&["count", &index.to_string(), &number.to_string()]);
        (!is_like_another).then(counted).transpose()
    };
    CASES.iter().enumerate().map(of_case).collect()
}

/// How many pairs differ by at least twice the samples alone, and how many of them take fewer instructions for more samples.
fn doubled(counts: &[(Quality, Vec<Option<f64>>)]) -> [usize; 2] {
    let [mut pairs, mut fewer] = [0; 2];
    for (quality, row) in counts {
        for (other, more) in counts {
            let Quality { samples_per_axis: axis, samples, .. } = *other;
            let is_alike = Quality { samples_per_axis: axis, samples, ..*quality } == *other;
            let [least, most] = [quality, other].map(|quality| quality.covered_samples());
            let grows = axis >= quality.samples_per_axis && samples >= quality.samples && most >= 2 * least;
            if is_alike && grows {
                let both = row.iter().zip(more).filter_map(|(few, many)| Some((*few)? > (*many)?));
                both.for_each(|is_fewer| {
                    pairs += 1;
                    fewer += usize::from(is_fewer);
                });
            }
        }
    }
    [pairs, fewer]
}
