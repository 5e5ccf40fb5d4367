//! Command scripts: the changes of each line, and the images that they request.

use std::fs;
use std::path::Path;

use crate::args::{CommandLine, Destination, Mode, Request, Step, Template, plain, steps};
use crate::failure::Failure;
use crate::image;
use crate::loading;
use crate::outlet::Outlet;
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::report_failure;
use crate::stdout::write_lines;

/// Where a script is: what it has changed, and which files there are.
struct Session {
    line: CommandLine,
    sources: Vec<Source>,
    current: usize,
}

/// Executes the script, and then draws the image of --output; returns the exit code.
pub(crate) fn run(
    request: &Request,
    output: Option<&Destination>,
    capture: Option<&Path>,
    reporter: Reporter,
) -> u8 {
    let mut outlet = Outlet::new(output, request, reporter);
    outlet.beside = &request.outputs;
    let done = done(request, &mut outlet, reporter).and_then(|session| {
        let request = session.request(reporter)?;
        image::draw_source(session.source(), &request, capture, &mut outlet, reporter)
    });
    match done {
        Ok(()) => 0,
        Err(failure) => {
            let source = Source::Files(request.files.clone());
            report_failure(&source, &failure, request.json, reporter)
        }
    }
}

/// The request after a script, for a window: images that it asks for are not taken.
#[cfg(feature = "window")]
pub(crate) fn changed(request: &Request, reporter: Reporter) -> Result<Request, Failure> {
    if request.script.is_none() {
        return Ok(request.clone());
    }
    let mut outlet = Outlet::new(None, request, reporter);
    let session = done(request, &mut outlet, reporter)?;
    Ok(Request { script: None, ..session.request(reporter)? })
}

fn done(request: &Request, outlet: &mut Outlet<'_>, reporter: Reporter) -> Result<Session, Failure> {
    let sources = Source::all(request);
    let mut session = Session { line: request.line.clone(), sources, current: 0 };
    let Some(file) = &request.script else { return Ok(session) };
    let name = file.display();
    let text = fs::read_to_string(file)
        .map_err(|error| Failure::work(format!("{name}: cannot be read ({error}); check the name")))?;
    let located = |line: usize, why: &str| Failure::Usage(format!("{name}, line {line}: {why}"));
    // All is read before anything is done.
    for (line, step) in steps(&text).map_err(|(line, why)| located(line, &why))? {
        match step {
            Step::Stop => break,
            Step::Say(what) => reporter.info(what),
            Step::Ignored(why) => reporter.warning(format_args!("{name}, line {line}: {why}")),
            Step::SceneInfo => session.describe(reporter)?,
            Step::Print(flag) => {
                reporter.info(session.line.typed_value(&flag, session.source().first_file()));
            }
            Step::Screenshot { file, background } => {
                session.draw(file.as_deref(), background, outlet, reporter)?;
            }
            Step::Go(by) => session.go(by),
            Step::Add(files) => {
                session.sources.extend(files.into_iter().map(|file| Source::Files(vec![file])));
            }
            changing => session.change(changing).map_err(|why| located(line, &why))?,
        }
    }
    Ok(session)
}

impl Session {
    fn source(&self) -> &Source {
        &self.sources[self.current]
    }

    fn go(&mut self, by: isize) {
        let count = self.sources.len() as isize;
        self.current = (self.current as isize + by).rem_euclid(count) as usize;
    }

    fn request(&self, reporter: Reporter) -> Result<Request, Failure> {
        let request = Request::from_line(&self.line, self.source().first_file());
        let mut request = request.map_err(|error| Failure::Usage(plain(&error)))?;
        loading::light(&mut request, reporter)?;
        Ok(request)
    }

    /// Changes flags.
    fn change(&mut self, step: Step) -> Result<(), String> {
        self.line = self.line.changed(step, self.source().first_file())?;
        Ok(())
    }

    fn describe(&self, reporter: Reporter) -> Result<(), Failure> {
        let request = self.request(reporter)?;
        let model = loading::load_aloud(self.source(), &request, reporter)?;
        let lines = model.summary().lines().into_iter().map(|line| format!("  {line}"));
        let lines = std::iter::once(model.source.title()).chain(lines);
        if matches!(&request.mode, Mode::Image { output: Some(Destination::Stdout), .. }) {
            lines.for_each(|line| reporter.info(line));
        } else {
            write_lines(lines)?;
        }
        Ok(())
    }

    /// Writes an image of what there is.
    fn draw(
        &self,
        file: Option<&str>,
        background: bool,
        outlet: &mut Outlet<'_>,
        reporter: Reporter,
    ) -> Result<(), Failure> {
        let mut session =
            Self { line: self.line.clone(), sources: self.sources.clone(), current: self.current };
        if !background {
            session.line = session.line.with(["--no-background".to_owned()]);
        }
        let mut request = session.request(reporter)?;
        let template = match file {
            None => request.screenshot.clone(),
            Some(name) => {
                match name.parse::<Destination>().map_err(|why| Failure::Usage(format!("{name}: {why}")))? {
                    Destination::File(template) => template,
                    Destination::Stdout => Template::parse("screenshot_{n}.png").map_err(Failure::Usage)?,
                }
            }
        };
        let output = Destination::File(template);
        request.mode = Mode::Image { output: Some(output.clone()), capture: None };
        request.reference = None;
        let mut own = Outlet::new(Some(&output), &request, reporter);
        own.inputs = outlet.inputs.clone();
        image::draw_source(session.source(), &request, None, &mut own, reporter)?;
        outlet.written.append(&mut own.written);
        Ok(())
    }
}
