//! Lists on standard output: formats, levels of SIMD, and the contents of files.

use crate::args::Request;
use crate::facts::ModelFacts;
use crate::loading;
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::{json_line, print_lines};

/// `--list-readers`: one line per format.
pub(crate) fn readers(reporter: Reporter) -> u8 {
    let line = |reader: &trigon_io::Reader| {
        let endings: Vec<String> = reader.extensions.iter().map(|ending| format!(".{ending}")).collect();
        format!("{:12} {:24} {}", endings.join(" "), reader.name, reader.reads)
    };
    print_lines(trigon_io::readers().map(line), reporter)
}

/// `--list-rendering-backends`: the one that there is.
pub(crate) fn backends(reporter: Reporter) -> u8 {
    let levels = trigon_scene::SimdLevel::ALL.into_iter().filter(|level| level.is_supported());
    let levels: Vec<String> = levels.map(|level| level.to_string()).collect();
    print_lines([format!("cpu: available, with {} (--simd)", levels.join(", "))], reporter)
}

/// `--no-render`: what is in each file.
pub(crate) fn inspect(request: &Request, reporter: Reporter) -> u8 {
    let mut unwritten = 0;
    let unread = Source::visit_all(request, reporter, |source, request| {
        let model = loading::load_aloud(source, request, reporter)?;
        if request.json {
            let facts = ModelFacts::new(&model, &model.summary());
            unwritten = unwritten.max(json_line(&facts, reporter));
            return Ok(());
        }
        let facts = model.summary().lines().into_iter().chain(model.choices());
        let facts = facts.map(|fact| format!("  {fact}"));
        let code = print_lines(std::iter::once(source.title()).chain(facts), reporter);
        unwritten = unwritten.max(code);
        Ok(())
    });
    unread.max(unwritten)
}
