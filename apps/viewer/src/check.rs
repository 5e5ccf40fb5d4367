//! `--check`: faults of models with remedies; for people, or as JSON for other programs.

use std::fmt;
use std::ops::ControlFlow;
use std::path::Path;

use serde_json::{Value, json};
use trigon_io::Warning;
use trigon_scene::{Finding, Severity};

use crate::args::{CheckPurpose, Request};
use crate::failure::Failure;
use crate::loading;
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::report_failure;
use crate::stdout::{json_line, print_lines};

/// One thing that is wrong.
struct Fault {
    severity: Severity,
    name: &'static str,
    location: String,
    what: String,
    remedy: String,
}

/// Checks every source; 1 if anything is wrong with one, or it cannot be loaded.
pub(crate) fn run(request: &Request, purpose: CheckPurpose, reporter: Reporter) -> u8 {
    let mut worst = 0;
    for source in Source::all(request) {
        let faults = match request.for_source(&source).and_then(|request| faults(&source, &request, purpose))
        {
            Ok(faults) => faults,
            Err(failure @ Failure::Usage(_)) => {
                worst = worst.max(report_failure(&source, &failure, request.json, reporter));
                continue;
            }
            Err(failure) => vec![Fault::unloadable(&failure)],
        };
        let is_wrong = faults.iter().any(|fault| fault.severity == Severity::Error);
        worst = worst.max(u8::from(is_wrong));
        let unwritten = if request.json {
            json_line(&facts(&source, &faults), reporter)
        } else {
            print_lines(lines(&source, &faults), reporter)
        };
        worst = worst.max(unwritten);
    }
    worst
}

/// What the reader said, and what the scene says itself.
fn faults(source: &Source, request: &Request, purpose: CheckPurpose) -> Result<Vec<Fault>, Failure> {
    let (model, warnings) = loading::load(source, request, &|_| ControlFlow::Continue(()))?;
    let mut faults: Vec<Fault> = warnings.iter().map(Fault::of_reader).collect();
    faults.extend(Fault::of_variants(&model.variant_names));
    let findings = match purpose {
        CheckPurpose::Show => model.scene.check(),
        CheckPurpose::Print => model.scene.check_for_printing(),
    };
    faults.extend(findings.into_iter().map(Fault::of_scene));
    faults.sort_by_key(|fault| std::cmp::Reverse(fault.severity));
    Ok(faults)
}

impl Fault {
    fn unloadable(failure: &Failure) -> Self {
        let text = failure.to_string();
        let (what, remedy) = text.split_once("; ").unwrap_or((&text, "check the file"));
        Self {
            severity: Severity::Error,
            name: if matches!(failure, Failure::Empty(_)) { "nothing-to-draw" } else { "not-loaded" },
            location: "file".to_owned(),
            what: what.to_owned(),
            remedy: remedy.to_owned(),
        }
    }

    /// A file beside the model that is missing or cannot be used is an error: the image
    /// lacks it.
    fn of_reader(warning: &Warning) -> Self {
        let is_missing = !warning.tried.is_empty();
        let more = if warning.more > 0 { format!(" … and {} more", warning.more) } else { String::new() };
        let tried: Vec<String> = warning.tried.iter().map(|path| path.display().to_string()).collect();
        let tried = if is_missing { format!(", looked for {}", tried.join(", ")) } else { String::new() };
        Self {
            severity: if is_missing { Severity::Error } else { Severity::Warning },
            name: if is_missing { "missing-file" } else { "in-the-file" },
            location: format!("{}{}", warning.file.display(), warning.location),
            what: format!("{}{more}{tried}", warning.what),
            remedy: warning.remedy.clone(),
        }
    }

    /// That there is more than is checked.
    fn of_variants(names: &[String]) -> Option<Self> {
        let list: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
        (!names.is_empty()).then(|| Self {
            severity: Severity::Note,
            name: "variants",
            location: "file".to_owned(),
            what: format!(
                "its materials have the variants {}, of which one at a time is checked",
                list.join(", ")
            ),
            remedy: "choose one with --variant".to_owned(),
        })
    }

    /// Whether it is no fault.
    fn is_note(&self) -> bool {
        self.severity == Severity::Note
    }

    fn of_scene(finding: Finding) -> Self {
        let Finding { severity, fault, location, what, remedy } = finding;
        Self { severity, name: fault, location, what, remedy: remedy.to_owned() }
    }

    fn facts(&self) -> Value {
        json!({
            "severity": severity(self.severity), "fault": self.name, "place": self.location,
            "what": self.what, "remedy": self.remedy,
        })
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, location, what, remedy, .. } = self;
        write!(f, "{}: {location}: {what} ({name}); {remedy}", severity(self.severity))
    }
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

fn lines(source: &Source, faults: &[Fault]) -> Vec<String> {
    let title = match faults.iter().all(Fault::is_note) {
        true => format!("{}: no faults", source.title()),
        false => source.title(),
    };
    let faults = faults.iter().map(|fault| format!("  {fault}"));
    std::iter::once(title).chain(faults).collect()
}

fn facts(source: &Source, faults: &[Fault]) -> Value {
    let is_wrong = faults.iter().any(|fault| fault.severity == Severity::Error);
    let (notes, findings): (Vec<&Fault>, Vec<&Fault>) = faults.iter().partition(|fault| fault.is_note());
    let all = |faults: Vec<&Fault>| faults.into_iter().map(Fault::facts).collect::<Vec<_>>();
    json!({
        "file": source.first_file().map(Path::to_string_lossy), "ok": !is_wrong, "findings": all(findings), "notes": all(notes),
    })
}
