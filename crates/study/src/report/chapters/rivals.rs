//! What do other renderers' images cost, and how accurate are they? Nothing is measured here: the rows are
//! read from the two files in `crates/study/rivals`.

use super::*;
use crate::rivals::{Measured, Timed, measured, timed, timed_on};
use crate::workloads::Workload;
use trigon_math::elementary;

pub(in crate::report) const IMAGE: &str = "RMSE of the image, of 255";
const OUTLINES: &str = "wrong at outlines, ‰";
const HOLES: &str = "holes and wrong depth within, millionths";
const WITHIN: &str = "RMSE within surfaces, of 255";
const WORST: &str = "worst within surfaces, of 255";
pub(in crate::report) const ONE: &str = "ms, 1 thread";
const TWO: &str = "ms, 2 threads";
pub(in crate::report) const ALL: &str = "W2 to W5, geometric means";

/// Each renderer as the files and as readers call it.
const RENDERERS: [(&str, &str); 15] = [
    ("exact-centres", "exact colour at pixel centres, rounded to bytes"),
    ("exact-means", "exact mean of each pixel, rounded to bytes"),
    ("llvmpipe-debian", "llvmpipe, Mesa 22.3.6"),
    ("llvmpipe-new", "llvmpipe, Mesa 26.2.6"),
    ("llvmpipe-new-2x2", "llvmpipe, Mesa 26.2.6, 2×2 samples"),
    ("llvmpipe-new-4x4", "llvmpipe, Mesa 26.2.6, 4×4 samples"),
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
               no multisampling. llvmpipe with 2×2 and 4×4 samples draws so many times as wide and high, and halves the image by linear blits. \
               `tests/peers/rivals.sh` repeats the images and the times.",
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

/// How two values of a column are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Comparison {
    /// By three digits.
    Error,
    /// Exactly, as a number of pixels: the column has parts of those at outlines.
    Count,
    /// What lies within 15 % is no difference: times vary by as much from run to run.
    Time,
}

/// The columns by which trigon is compared with the best of the others.
const COMPARED: [(&str, &str, Comparison); 7] = [
    (IMAGE, "RMSE of the image, of 255", Comparison::Error),
    (OUTLINES, "wrong pixels at outlines", Comparison::Count),
    (HOLES, "holes and wrong depth within surfaces, millionths", Comparison::Error),
    (WITHIN, "RMSE within surfaces, of 255", Comparison::Error),
    (WORST, "worst pixel within surfaces, of 255", Comparison::Error),
    (ONE, "ms on one thread", Comparison::Time),
    (TWO, "ms on two threads", Comparison::Time),
];

/// The pixels at outlines of a workload: what the rates in the file are parts of.
fn outline_pixels(workload: Workload) -> f64 {
    match workload {
        Workload::Torus => 9_564.0,
        Workload::KnotPhong | Workload::KnotTextured => 17_697.0,
        Workload::Cubes => 239_428.0,
        _ => f64::NAN,
    }
}

/// For each column where trigon is better and where it is worse.
pub(in crate::report) fn findings(rows: &[Row]) -> Vec<String> {
    let multisampled = format!(
        "W6 is W3 with four multisamples, and has no column but the image and the times. trigon's rows of the other workloads are those of \
         `draft`, with one sample per pixel as all others. Errors are those of the bytes; none is in linear light. On two threads, a renderer that is \
         faster on one counts with that. llvmpipe's 2×2 and 4×4 samples are halved by linear blits, which round to bytes. {} and {} pixels at outlines are in W2 and W3, {} in W5. Times: {}.",
        outline_pixels(Workload::Torus),
        outline_pixels(Workload::KnotPhong),
        outline_pixels(Workload::Cubes),
        timed_on()
    );
    let verdicts =
        COMPARED.into_iter().filter_map(|(quantity, what, kind)| verdict(rows, quantity, what, kind));
    verdicts.chain(at_avx2(rows)).chain([multisampled]).collect()
}

/// How many times as long the fastest of the others takes as trigon with vectors of AVX2, if the machine has wider ones.
fn at_avx2(rows: &[Row]) -> Option<String> {
    let timed = timed();
    let ratios = |threads: usize, quantity: &str| {
        let ratio = |duel: Duel<'_>| {
            let is_it = |time: &&Timed| {
                time.workload == duel.workload.name()
                    && time.threads == threads
                    && ["trigon-draft-avx2", "trigon-avx2"].contains(&time.renderer.as_str())
            };
            let own = timed.iter().find(is_it)?.quarters[1];
            Some(format!("{} ({})", number(duel.least / own), short(duel.workload)))
        };
        let ratios = duels(rows, quantity, Comparison::Time).into_iter().map(ratio);
        Some(ratios.collect::<Option<Vec<String>>>()?.join(", "))
    };
    Some(format!(
        "With vectors of AVX2 instead of the machine's AVX-512, the fastest of the others takes {} times as long as trigon on one thread, and \
         {} on two.",
        ratios(1, ONE)?,
        ratios(2, TWO)?
    ))
}

/// trigon and the best of the others in a workload.
struct Duel<'a> {
    workload: Workload,
    own: f64,
    least: f64,
    /// The other renderer.
    name: &'a str,
}

/// trigon's value in a workload, with as many samples as the others have, and the least of the others.
fn duel<'a>(rows: &'a [Row], workload: Workload, quantity: &str, kind: Comparison) -> Option<Duel<'a>> {
    let is_drawn = |row: &&Row| {
        let is_like_others = row.value(OUTLINES).is_some() || workload == Workload::KnotMultisampled;
        row.conditions.geometry == workload.name() && is_like_others && !row.variant.starts_with("exact")
    };
    let value = |row: &Row| {
        // Whoever may use two threads may use one.
        let quantities = if quantity == TWO { &[ONE, TWO][..] } else { &[quantity] };
        let values = quantities.iter().filter_map(|quantity| row.value(quantity));
        let value = values.min_by(f64::total_cmp)?;
        Some(if kind == Comparison::Count { (value * outline_pixels(workload) / 1e3).round() } else { value })
    };
    let (own, others): (Vec<&Row>, Vec<&Row>) =
        rows.iter().filter(is_drawn).partition(|row| row.variant.starts_with("trigon"));
    let others = others.into_iter().filter_map(|row| Some((value(row)?, row.variant.as_str())));
    let (least, name) = others.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Duel { workload, own: value(own.first()?)?, least, name })
}

/// All workloads that have a column.
fn duels<'a>(rows: &'a [Row], quantity: &str, kind: Comparison) -> Vec<Duel<'a>> {
    let all = WORKLOADS.into_iter().chain([Workload::KnotMultisampled]);
    all.filter_map(|workload| duel(rows, workload, quantity, kind)).collect()
}

/// Where trigon is better and where it is worse by one column; nothing while it was not measured.
fn verdict(rows: &[Row], quantity: &str, what: &str, kind: Comparison) -> Option<String> {
    let (mut better, mut worse, mut level) = (Vec::new(), Vec::new(), Vec::new());
    for duel in duels(rows, quantity, kind) {
        let [own, least] = [duel.own, duel.least].map(number);
        let is_level = match kind {
            Comparison::Error => own == least,
            Comparison::Count => duel.own == duel.least,
            Comparison::Time => (duel.own / duel.least - 1.0).abs() <= 0.15,
        };
        let text = format!("{} ({own} against {least}, {})", short(duel.workload), duel.name);
        let list = if is_level {
            &mut level
        } else if duel.own < duel.least {
            &mut better
        } else {
            &mut worse
        };
        list.push(text);
    }
    let same = match kind {
        Comparison::Error => "equal to three digits in",
        Comparison::Count => "equal in",
        Comparison::Time => "within 15 % in",
    };
    let all = [("better in", better), ("worse in", worse), (same, level)];
    let verdicts = all.into_iter().filter(|(_, list)| !list.is_empty());
    let verdicts: Vec<String> =
        verdicts.map(|(verdict, list)| format!("{verdict} {}", list.join(", "))).collect();
    (!verdicts.is_empty())
        .then(|| format!("trigon beside the best of the others, by {what}: {}.", verdicts.join("; ")))
}

fn short(workload: Workload) -> &'static str {
    &workload.name()[..2]
}

/// The plot and a line for each of five columns, for the README, which a test holds to them.
#[cfg(test)]
pub(in crate::report) fn summary() -> String {
    let chapter = measure(Effort::Once);
    let mut text = String::new();
    for plot in &chapter.plots {
        text.push_str(&format!("\n![{}](docs/images/{})\n\n", plot.title, plot.file(chapter.name)));
    }
    for (quantity, what, kind) in [COMPARED[0], COMPARED[1], COMPARED[3], COMPARED[5], COMPARED[6]] {
        let verdict = verdict(&chapter.rows, quantity, what, kind).expect("it was measured");
        text.push_str(&format!("- {verdict}\n"));
    }
    text
}

pub(super) fn headlines() -> Vec<Headline> {
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rates at outlines are whole numbers of pixels.
    #[test]
    fn rates_at_outlines_are_counts() {
        let mut found = 0;
        for measured in measured() {
            let Some(centres) = measured.errors.centres else { continue };
            let workload =
                WORKLOADS.into_iter().find(|workload| workload.name() == measured.workload).unwrap();
            let count = centres.wrong_at_outlines * outline_pixels(workload) / 1e3;
            // Two divisions of f64.
            assert!((count - count.round()).abs() < 1e-9 * count.max(1.0), "{measured:?}: {count}");
            found += 1;
        }
        assert!(found > 30, "{found} rows");
    }

    #[test]
    fn counts_are_compared_exactly_errors_by_digits_and_times_with_a_margin() {
        let case = "W3-knot-phong as others draw it";
        let row = |name: &str, rate: f64, time: f64| {
            Row::new(case, name).of("W3-knot-phong").with(OUTLINES, rate).with(ONE, time)
        };
        let pixel = 1e3 / outline_pixels(Workload::KnotPhong);
        let rows = [row("trigon, draft", 4.0 * pixel, 10.0), row("other", 5.0 * pixel, 11.0)];
        let said = |quantity, kind| verdict(&rows, quantity, "it", kind).unwrap();
        assert!(said(OUTLINES, Comparison::Count).contains("better in W3 (4.00 against 5.00, other)"));
        assert!(said(ONE, Comparison::Time).contains("within 15 % in W3 (10.0 against 11.0, other)"));
        assert!(said(ONE, Comparison::Error).contains("better in W3 (10.0 against 11.0, other)"));
        let rows = [row("trigon, draft", 2.0116982, 10.0), row("other", 2.0115492, 11.0)];
        let said = verdict(&rows, OUTLINES, "it", Comparison::Error).unwrap();
        assert!(said.contains("equal to three digits in W3 (2.01 against 2.01, other)"), "{said}");
    }
}
