//! Draws one job, as the command line does that it stands for.

use std::collections::HashSet;
use std::ffi::OsString;
use std::path::PathBuf;

use serde_json::Value;

use crate::args::{Destination, Job, Mode, Request, plain};
use crate::failure::Failure;
use crate::outlet::{Folders, Outlet, OutputFile};
use crate::report::Reporter;
use crate::source::Source;
use crate::{image, loading};

/// What a job read and wrote.
pub(super) struct JobDrawing {
    pub(super) read: Vec<PathBuf>,
    pub(super) written: Vec<OutputFile>,
    /// Of each model.
    pub(super) facts: Vec<Value>,
}

/// How jobs are drawn.
pub(super) struct JobSettings<'a> {
    /// Flags that change no image.
    pub(super) words: &'a [OsString],
    pub(super) folders: Folders<'a>,
    pub(super) reporter: Reporter,
}

/// Draws a job. The names of its images must not be `taken`, and are then.
pub(super) fn draw(
    job: &Job,
    settings: &JobSettings<'_>,
    taken: &mut HashSet<PathBuf>,
) -> Result<JobDrawing, Failure> {
    let reporter = settings.reporter;
    let mut request = request(job, settings.words)?;
    request.ignored.iter().for_each(|warning| reporter.warning(warning));
    loading::light(&mut request, reporter)?;
    let destination = destination(&request);
    let mut outlet = Outlet::new(destination, &request, reporter);
    outlet.beside = &request.outputs;
    outlet.folders = settings.folders;
    outlet.held_facts = Some(Vec::new());
    std::mem::swap(&mut outlet.taken, taken);
    let code = Source::visit_all(&request, reporter, |source, request| {
        image::draw_source(source, request, None, &mut outlet, reporter)
    });
    std::mem::swap(&mut outlet.taken, taken);
    if code != 0 {
        return Err(Failure::Reported(code));
    }
    let read = outlet.inputs.files();
    Ok(JobDrawing { read, written: outlet.written, facts: outlet.held_facts.unwrap_or_default() })
}

/// What a job asks for. A configuration that it names may ask for what [`Job::parse`] refuses.
fn request(job: &Job, words: &[OsString]) -> Result<Request, Failure> {
    let line = job.line(words).map_err(Failure::Usage)?;
    let file = job.first_input();
    let request = Request::from_line(&line, file).map_err(|error| Failure::Usage(plain(&error)))?;
    if destination(&request).is_some()
        && request.script.is_none()
        && request.reference.is_none()
        && request.limit.is_none()
    {
        return Ok(request);
    }
    Err(Failure::Usage(
        "its configuration asks for something else than images that are the same each time; leave that out"
            .to_owned(),
    ))
}

/// Where the images of a request go, if it is for images whose names are the same each time.
fn destination(request: &Request) -> Option<&Destination> {
    let Mode::Image { output: Some(output), capture: None } = &request.mode else { return None };
    matches!(output, Destination::File(template) if template.is_repeatable()).then_some(output)
}
