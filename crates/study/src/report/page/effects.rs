//! A small frontier for each effect.

use std::fmt::Write as _;

use super::super::chapter::{Row, number, quartile_words};
use super::super::chapters::effects::{OCCLUSION, SHADOWS, TEXTURES};
use super::super::chapters::frames::{RMSE, TIME};
use super::super::chapters::line;
use super::recorded::Recorded;
use crate::frames::FrameCase;

/// A frontier of the page.
struct Table<'a> {
    title: &'static str,
    text: &'static str,
    rows: &'a [Row],
    case: &'a str,
    /// The settings; all, if there are none.
    variants: &'a [&'a str],
    quantities: [&'a str; 2],
    image: &'static str,
}

pub(super) fn write(recorded: &Recorded<'_>, text: &mut String) {
    let [grass, layers] = [FrameCase::Grass, FrameCase::Layers].map(FrameCase::name);
    let table = |title, text, case, image| Table {
        title,
        text,
        rows: recorded.effects,
        case,
        variants: &[],
        quantities: [TIME, RMSE],
        image,
    };
    let samples = [
        "1×1×1 (draft)",
        "1×1×4",
        "1×1×16",
        "2×2×1 (standard)",
        "2×2×4",
        "4×4×1, shadow maps",
        "4×4×4, shadow maps",
    ];
    let tables = [
        table("Shadows", "Maps by the texels along their side, and rays.", SHADOWS, "effects-shadows"),
        table(
            "Ambient occlusion",
            "Rays at every sample, or shared among pixels, with 2×2 samples.",
            OCCLUSION,
            "effects-occlusion",
        ),
        table("Textures", "Filters at 1×1, 2×2 and 4×4 samples.", TEXTURES, "effects-textures"),
        Table {
            rows: recorded.frames,
            variants: &samples,
            ..table(
                "Samples",
                "Grass, whose blades are thinner than a pixel: supersampling shades all samples, multisampling one of each 2, 4 …",
                grass,
                "frames-grass",
            )
        },
        Table {
            rows: recorded.line,
            quantities: [line::TIME, line::RMSE],
            ..table(
                "Lines",
                "A line one pixel wide, against the area that it covers of each pixel.",
                line::CASE,
                "line-lines",
            )
        },
        Table {
            rows: recorded.frames,
            variants: &["1×1×1 (draft)", "1×1×4", "2×2×1 (standard)", "2×2×4", "4×4×1 (high)"],
            ..table(
                "Transparency",
                "Balls behind each other. The renderer blends layers in their order at each sample, so samples limit it, down to the rounding to bytes.",
                layers,
                "frames-layers",
            )
        },
    ];
    text.push_str("\n## One effect at a time\n\nErrors are those of the whole image; half of the runs took between the two times in parentheses.\n");
    tables.iter().for_each(|table| table.write(text));
}

impl Table<'_> {
    fn write(&self, text: &mut String) {
        let [time, error] = self.quantities;
        let _ = write!(
            text,
            "\n### {}\n\n{}\n\n| {} | {time} | {error} |\n|---|--:|--:|\n",
            self.title, self.text, self.case
        );
        let is_shown = |row: &&Row| {
            row.case == self.case
                && (self.variants.is_empty() || self.variants.contains(&row.variant.as_str()))
        };
        for row in self.rows.iter().filter(is_shown) {
            let cells = self.quantities.map(|quantity| match row.value(quantity) {
                Some(value) => number(value) + &quartile_words(row.quartiles(quantity)),
                None => "–".to_owned(),
            });
            let _ = writeln!(text, "| {} | {} |", row.variant, cells.join(" | "));
        }
        let _ = writeln!(text, "\n![{}: error against time](images/accuracy-{}.svg)", self.title, self.image);
    }
}
