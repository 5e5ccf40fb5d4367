//! The page that says what a millisecond buys, from recorded rows alone: `docs/accuracy.md`. What it sums up is in the appendix.

mod answers;
mod budget;
mod effects;
mod limits;
mod panels;
mod recorded;

use std::fmt::Write as _;

pub(super) use limits::contradictions;
pub(super) use panels::panels;
pub(super) use recorded::Recorded;

use super::chapter::number;
use super::chapters::frames::Sweep;

/// The appendix, from the page.
pub(super) const APPENDIX: &str = "accuracy-appendix.md";

/// The whole page.
pub(super) fn page(recorded: &Recorded<'_>) -> String {
    let mut text = format!(
        "# What a millisecond buys\n\n{}\n\nErrors are root mean squares of the difference from the right image, in linear light, where 1 is the \
         display's white. The right image comes from rays in `f64` that share no code with the renderer; how exact it is stands \
         [below](#how-right-is-the-truth). Times are medians of whole frames on all threads; [instructions](accuracy-instructions.md), which no \
         load changes, are counted apart. Methods, algorithms and all other tables are in the \
         [appendix]({APPENDIX}), all rows in `accuracy.csv`; a test writes this page again from those rows.\n\nA setting a×a×c has a×a shaded samples for each \
         pixel, and c samples of coverage in each of them. Up to 2×2 it has shadow maps of 2048 texels, above it shadow rays, unless it says otherwise. \
         `draft`, `standard`, `high` and `reference` are presets.\n\n",
        recorded.header.words(),
    );
    for panel in panels(recorded) {
        let _ = writeln!(text, "![Error against time: {}](images/{})\n", panel.title, panel.file());
    }
    text.push_str(
        "*Geometric means over the scenes. Every setting is a dot, and the line joins those that none beats in both time and error. Nothing that is stored in \
         bytes can lie below the level of the right image as bytes. In the last picture trigon and other renderers draw four workloads, with one \
         sample per pixel unless it says otherwise, and no line joins them.*\n\n",
    );
    limits::write(recorded, &mut text);
    answers::write(recorded, &mut text);
    effects::write(recorded, &mut text);
    budget::write(recorded, &mut text);
    write_truth(recorded, &mut text);
    let [pairs, contradicting] = contradictions(recorded.frames);
    let _ = write!(
        text,
        "\n## How right are the times?\n\nOf {pairs} pairs of settings in the same scene, of which one has at least twice the samples of the other \
         and is the same otherwise, {contradicting} contradict that: the one with more was faster, and the quartiles of both lie apart. Of times that differ by \
         less than a fifth either may be the shorter one, as those of the texture filters show.\n",
    );
    let _ = write!(
        text,
        "\n## Other renderers\n\n{}\n\nTheir images and times, and how they were made, are in the [appendix]({APPENDIX}#what-do-other-renderers-get-for-their-time).\n",
        super::chapters::rivals::findings(recorded.rivals)
            .iter()
            .map(|line| format!("- {line}"))
            .collect::<Vec<_>>()
            .join("\n"),
    );
    text
}

/// What is known of the right images.
fn write_truth(recorded: &Recorded<'_>, text: &mut String) {
    use super::chapters::frames::sweep::{BOUND, ROUNDING, UNCERTAIN};
    let [small, large] = recorded.sweeps();
    text.push_str(
        "\n## How right is the truth?\n\nIn one pixel of 61, 512 other rays are cast, twice as many as the truth has at most. The root mean square of the \
         differences bounds the error of the truth. *Rounded to bytes* is how far the truth is from its own bytes. One pixel of each 2×2 is judged at the small size (4×4 with ambient occlusion), one of each 8×8 at the large one; the last columns \
         tell how far an error may therefore be from that of all pixels (two standard errors).\n\n",
    );
    text.push_str(
        "| scene | error of the truth, less than | large | rounded to bytes | large | known within, % | large |\n\
         |---|--:|--:|--:|--:|--:|--:|\n",
    );
    for case in small.cases() {
        let cell = |sweep: &Sweep, quantity: &str| {
            let found = super::chapter::value(recorded.frames, &sweep.truths(), case.name(), quantity);
            number(found)
        };
        let columns = [BOUND, ROUNDING, UNCERTAIN];
        let cells = columns.map(|quantity| [&small, &large].map(|sweep| cell(sweep, quantity)).join(" | "));
        let _ = writeln!(text, "| {} | {} |", case.name(), cells.join(" | "));
    }
}
