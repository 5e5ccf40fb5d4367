//! `--frontier`: measures what a model's image costs at many settings, and how wrong it then is, as a plot or a table.

use std::path::Path;
use std::thread;
use std::time::Instant;

use trigon_scene::quality::{Frontier, FrontierDot, Sweep, SweepOptions};
use trigon_scene::{Cancel, RenderSettings};

use crate::args::{Request, Subject, Template};
use crate::failure::Failure;
use crate::loading::{self, LateBar};
use crate::outlet::{Outlet, missing_folder};
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::write_lines;

/// Measures every source; the worst exit code is returned.
pub(crate) fn run(request: &Request, output: &Template, reporter: Reporter) -> u8 {
    let mut outlet = Outlet::new(None, request, reporter);
    Source::visit_all(request, reporter, |source, request| {
        measure(source, request, output, &mut outlet, reporter)
    })
}

fn measure(
    source: &Source,
    request: &Request,
    output: &Template,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<(), Failure> {
    let mut model = loading::load_aloud(source, request, reporter)?;
    outlet.inputs.add(&model.files);
    let path = output.unused(Subject { model: source.image_subject(), ..Subject::default() });
    // Before it is measured in vain.
    outlet.inputs.refuse(&path)?;
    missing_folder(&path).map_or(Ok(()), Err)?;
    if outlet.taken.contains(&path) {
        return Err(Failure::Usage(format!(
            "{}: two plots would be written to it; write {{n}} in the name of --frontier (--frontier '{{model}}_{{n}}.svg')",
            path.display()
        )));
    }
    let shot = model.shot_with_scenery(request)?;
    let mut sweep = Sweep::new(model.scene.clone(), shot.camera, &request.settings, SweepOptions::default());
    let (started, bar) = (Instant::now(), LateBar::new(source.title(), request.shows_progress));
    let mut progress = sweep.progress();
    while !progress.is_done() {
        progress = sweep.step(&mut || started.elapsed(), &Cancel::default()).map_err(Failure::work)?;
        bar.set(progress.done as f64 / progress.of as f64);
    }
    bar.finish();
    let frontier = sweep.frontier();
    let text = if is_table(&path) {
        frontier.to_csv()
    } else {
        let subject = subject(&source.title(), &request.settings);
        frontier.plot(&subject, request.limit.map(|limit| limit.time())).to_svg()
    };
    outlet.save_text(&path, &text, format_args!("{} settings", frontier.dots.len()))?;
    write_lines(std::iter::once(source.title()).chain(lines(&frontier)))
}

fn is_table(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"))
}

/// "chair.glb, 1000×600, 2 threads"
fn subject(title: &str, settings: &RenderSettings) -> String {
    let threads = settings.threads.or_else(|| thread::available_parallelism().ok());
    let threads = match threads.map_or(1, |threads| threads.get()) {
        1 => "1 thread".to_owned(),
        threads => format!("{threads} threads"),
    };
    format!("{title}, {}×{}, {threads}", settings.width, settings.height)
}

/// The best settings, from the fastest on.
fn lines(frontier: &Frontier) -> Vec<String> {
    let best = frontier.best();
    let widest = best.iter().map(|dot| dot.name().chars().count()).max().unwrap_or(0);
    best.iter().map(|dot| format!("  {:widest$}  {}", dot.name(), figures(dot))).collect()
}

/// "12.1 ms (11.8 to 12.9), RMSE 0.0123"
pub(crate) fn figures(dot: &FrontierDot) -> String {
    let [low, median, high] =
        [dot.time.low, dot.time.median, dot.time.high].map(|time| time.as_secs_f64() * 1e3);
    let error = if dot.error == 0.0 { "no error".to_owned() } else { format!("RMSE {:.2e}", dot.error) };
    format!("{median:.2} ms ({low:.2} to {high:.2}), {error}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_says_what_was_drawn_and_how() {
        let mut settings = RenderSettings::new(30, 20);
        settings.threads = std::num::NonZeroUsize::new(1);
        assert_eq!(subject("a.obj", &settings), "a.obj, 30×20, 1 thread");
        settings.threads = std::num::NonZeroUsize::new(3);
        assert_eq!(subject("a.obj", &settings), "a.obj, 30×20, 3 threads");
        assert!(is_table(Path::new("x.CSV")) && !is_table(Path::new("x.svg")));
    }
}
