//! What do other renderers' images cost, and how accurate are they? Nothing is measured here: the rows are
//! read from the two files in `crates/study/rivals`.

use super::*;
use crate::rivals::{Measured, Timed, measured, timed};
use crate::workloads::Workload;
use trigon_math::elementary;

const IMAGE: &str = "RMSE of the image, of 255";
const OUTLINES: &str = "wrong at outlines, ‰";
const HOLES: &str = "holes and wrong depth within, millionths";
const WITHIN: &str = "RMSE within surfaces, of 255";
const WORST: &str = "worst within surfaces, of 255";
const ONE: &str = "ms, 1 thread";
const TWO: &str = "ms, 2 threads";
const ALL: &str = "W2 to W5, geometric means";

/// Each renderer as the files and as readers call it.
const RENDERERS: [(&str, &str); 13] = [
    ("exact-centres", "exact colour at pixel centres, rounded to bytes"),
    ("exact-means", "exact mean of each pixel, rounded to bytes"),
    ("llvmpipe-debian", "llvmpipe, Mesa 22.3.6"),
    ("llvmpipe-new", "llvmpipe, Mesa 26.2.6"),
    ("lavapipe-new", "lavapipe, Mesa 26.2.6"),
    ("swiftshader", "SwiftShader, Chromium 156"),
    ("euc-0.5.3", "euc 0.5.3"),
    ("retrofire-0.4.0", "retrofire 0.4.0"),
    ("trigon", "trigon"),
    ("trigon-draft", "trigon, draft"),
    ("trigon-standard", "trigon, standard"),
    ("trigon-high", "trigon, high"),
    ("trigon-reference", "trigon, reference"),
];

/// The workloads that one sample a pixel draws, and what the plot shows means of.
const WORKLOADS: [Workload; 4] =
    [Workload::Torus, Workload::KnotPhong, Workload::KnotTextured, Workload::Cubes];

pub(super) fn measure(_: Effort) -> Chapter {
    let rows = rows();
    let is_timed = rows.iter().any(|row| row.value(ONE).is_some());
    let plot = is_timed.then(|| Plot::trade("means", &rows, ALL, [ONE, IMAGE]));
    Chapter {
        name: "rivals",
        title: "What do other renderers get for their time?",
        text: "Five workloads (`crates/study/README.md` defines them) at 1920×1080, drawn by other CPU renderers and by trigon at each preset. \
               All are compared with one exact image: the definition carried out in `f64` by rays, with its own camera, light and texture \
               (`crates/study/src/rivals`). *Of the image* compares with the mean of 256 rays through each pixel that shows a surface, in \
               plain bytes. The other errors are those at the centres of pixels, for images with one sample per pixel. Pixels *at outlines* have another \
               surface beside them; those that show the wrong one are errors of coverage. All other pixels lie *within surfaces*. A hole there shows the background. \
               In W5, whose faces have one colour each, any other colour is a wrong depth. The RMSE of the rest is interpolation in W2, light from \
               interpolated normals in W3, and texture filtering in W4. The first two rows are the exact image rounded to bytes: no image can be \
               closer. euc and retrofire have no derivatives, so their W4 reads one level of the texture, which is less work. Both have one thread and \
               no multisampling. `tests/peers/rivals.sh` repeats the images and the times.",
        findings: findings(&rows),
        plots: plot.into_iter().collect(),
        images: Vec::new(),
        rows,
    }
}

/// All rows, those of the means first.
fn rows() -> Vec<Row> {
    let (measured, timed) = (measured(), timed());
    let mut rows: Vec<Row> = means(&measured, &timed);
    rows.extend(measured.iter().map(|one| row(one, &timed)));
    rows
}

/// A renderer's name for readers.
fn name(renderer: &str) -> &str {
    RENDERERS.iter().find(|(key, _)| *key == renderer).map_or(renderer, |(_, name)| name)
}

fn row(measured: &Measured, timed: &[Timed]) -> Row {
    let Measured { renderer, workload, errors } = measured;
    let mut row = Row::new(format!("{workload} as others draw it"), name(renderer))
        .of(workload.as_str())
        .sized([1920, 1080])
        .with(IMAGE, errors.image);
    if let Some(centres) = errors.centres {
        row = row
            .with(OUTLINES, centres.wrong_at_outlines)
            .with(HOLES, centres.wrong_within)
            .with(WITHIN, centres.within)
            .with(WORST, centres.worst_within);
    }
    for (threads, quantity) in [(1, ONE), (2, TWO)] {
        let is_it =
            |time: &&Timed| (&time.renderer, &time.workload, time.threads) == (renderer, workload, threads);
        if let Some(Timed { quarters: [low, median, high], .. }) = timed.iter().find(is_it) {
            row = row.timed(quantity, Spread { low: *low, median: *median, high: *high });
        }
    }
    row
}

/// Each renderer that has drawn W2 to W5.
fn means(measured: &[Measured], timed: &[Timed]) -> Vec<Row> {
    let mean = |values: Vec<f64>| {
        let is_whole = values.len() == WORKLOADS.len();
        is_whole.then(|| elementary::pow(values.iter().product(), 1.0 / values.len() as f64))
    };
    let is_meant = |workload: &str| WORKLOADS.iter().any(|one| one.name() == workload);
    let of = |renderer: &str| {
        let errors = measured.iter().filter(|one| one.renderer == renderer && is_meant(&one.workload));
        let mut row = Row::new(ALL, name(renderer)).sized([1920, 1080]);
        row = row.with(IMAGE, mean(errors.map(|one| one.errors.image).collect())?);
        for (threads, quantity) in [(1, ONE), (2, TWO)] {
            let times = timed
                .iter()
                .filter(|one| one.renderer == renderer && one.threads == threads && is_meant(&one.workload));
            if let Some(time) = mean(times.map(|one| one.quarters[1]).collect()) {
                row = row.with(quantity, time);
            }
        }
        Some(row)
    };
    RENDERERS.iter().filter_map(|(key, _)| of(key)).collect()
}

/// The quantities by which trigon is compared with the best of the others, as table headings.
const COMPARED: [(&str, &str); 4] = [
    (OUTLINES, "wrong pixels per thousand outline pixels"),
    (WITHIN, "RMSE within surfaces, of 255"),
    (ONE, "ms on one thread, one sample per pixel"),
    (TWO, "ms on two threads, one sample per pixel"),
];

/// For each quantity where trigon is better and where it loses.
fn findings(rows: &[Row]) -> Vec<String> {
    COMPARED.into_iter().filter_map(|(quantity, what)| verdict(rows, quantity, what)).collect()
}

/// trigon's value in a workload, with one sample a pixel, and the least of the others with its renderer.
fn duel<'a>(rows: &'a [Row], workload: Workload, quantity: &str) -> Option<(f64, f64, &'a str)> {
    let is_drawn = |row: &&Row| {
        let is_centred = row.value(OUTLINES).is_some() && !row.variant.starts_with("exact");
        row.conditions.geometry == workload.name() && is_centred
    };
    let (own, others): (Vec<&Row>, Vec<&Row>) =
        rows.iter().filter(is_drawn).partition(|row| row.variant.starts_with("trigon"));
    let others = others.into_iter().filter_map(|row| Some((row.value(quantity)?, row.variant.as_str())));
    let (least, name) = others.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((own.first()?.value(quantity)?, least, name))
}

/// Where trigon is better and where it loses by one quantity; nothing while it was not measured.
fn verdict(rows: &[Row], quantity: &str, what: &str) -> Option<String> {
    let (mut won, mut lost, mut level) = (Vec::new(), Vec::new(), Vec::new());
    for workload in WORKLOADS {
        let (own, least, _) = duel(rows, workload, quantity)?;
        let workloads = match own {
            own if own < 0.85 * least => &mut won,
            own if own > 1.15 * least => &mut lost,
            _ => &mut level,
        };
        workloads.push(short(workload));
    }
    let all = [
        ("trigon is better in", won),
        ("it loses in", lost),
        ("there is no measurable difference in", level),
    ];
    let verdicts = all.into_iter().filter(|(_, list)| !list.is_empty());
    let verdicts: Vec<String> =
        verdicts.map(|(verdict, list)| format!("{verdict} {}", list.join(", "))).collect();
    Some(format!("Compared with the best of the others, by {what}: {}.", verdicts.join("; ")))
}

fn short(workload: Workload) -> &'static str {
    &workload.name()[..2]
}

/// A line for each quantity and workload: trigon and the best of the others.
#[cfg(test)]
fn duels(rows: &[Row]) -> String {
    let mut text =
        String::from("| | workload | trigon | best of the others | which |\n|---|---|--:|--:|---|\n");
    for (quantity, what) in COMPARED {
        for workload in WORKLOADS {
            if let Some((own, least, name)) = duel(rows, workload, quantity) {
                let (own, least) = (number(own), number(least));
                text.push_str(&format!("| {what} | {} | {own} | {least} | {name} |\n", short(workload)));
            }
        }
    }
    text
}

/// The tables, the sentences and the plot for the README, which a test holds to them.
#[cfg(test)]
pub(in crate::report) fn summary() -> String {
    let chapter = measure(Effort::Once);
    let means: Vec<&Row> = chapter.rows.iter().filter(|row| row.case == ALL).collect();
    let mut text = String::new();
    crate::report::markdown::write_table(ALL, &means, &mut text);
    text.push_str(&format!("\n{}\n", duels(&chapter.rows)));
    chapter.findings.iter().for_each(|finding| text.push_str(&format!("- {finding}\n")));
    for plot in &chapter.plots {
        text.push_str(&format!("\n![{}](docs/images/{})\n", plot.title, plot.file(chapter.name)));
    }
    text
}

pub(super) fn headlines() -> Vec<Headline> {
    Vec::new()
}
