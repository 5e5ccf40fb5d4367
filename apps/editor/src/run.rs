//! Runs a script from the first to the last command, and writes the result to a file.

use std::path::Path;

use indicatif::{ProgressBar, ProgressStyle};
use trigon_document::{Disk, Document, Outcome, Script, save};
use trigon_io::{FileIdentity, LoadOptions};

use crate::arguments::Arguments;
use crate::export;
use crate::report;

/// Runs the command line.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    let (Some(script_path), Some(output)) = (&arguments.run, &arguments.output) else {
        return Err("write both a script and an output: --run SCRIPT --output FILE".into());
    };
    refuse_script(script_path, output)?;
    let script = read_script(script_path)?;
    let mut document = open(arguments)?;
    if let Some(bytes) = arguments.memory {
        document.set_memory(bytes);
    }
    run_script(&script, &mut document, arguments.quiet)
        .map_err(|error| format!("{}, {error}", script_path.display()))?;
    if let Some(format) = export::format_of(arguments, output)? {
        return export::write(&document, format, output, arguments);
    }
    export::refuse_to_replace(&document, output, std::iter::once(output.clone()))?;
    let native = document.to_native();
    let file = native.encode().map_err(|error| error.to_string())?;
    let losses = file.what_would_be_lost();
    if !losses.is_empty() {
        losses.iter().for_each(|loss| report("warning", &format!("would be lost: {loss}")));
        if !arguments.accept_losses {
            return Err("nothing was written; --accept-losses writes the file anyway".into());
        }
    }
    save(&mut Disk, output, &file.to_bytes()).map_err(|error| error.to_string())
}

/// The file that is edited may be replaced: a backup of it stays. The script is nothing that an output should replace.
fn refuse_script(script: &Path, output: &Path) -> Result<(), String> {
    let [one, other] = [script, output].map(|path| FileIdentity::of(path).ok());
    if one.is_none() || one != other {
        return Ok(());
    }
    Err(format!(
        "{}: is the script itself (it is {}) and would be lost; write to another file",
        output.display(),
        script.display()
    ))
}

fn read_script(path: &Path) -> Result<Script, String> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| format!("{}: cannot be read ({error})", path.display()))?;
    Script::from_json(&text).map_err(|error| format!("{}, {error}", path.display()))
}

fn open(arguments: &Arguments) -> Result<Document, String> {
    let path = match &arguments.files[..] {
        [] => return Ok(Document::default()),
        [path] => path,
        [_, second, ..] => {
            return Err(format!("{}: a script edits one file; run it once for each", second.display()));
        }
    };
    let options = LoadOptions { up: arguments.import_up, ..LoadOptions::default() };
    let (document, warnings) = Document::open(path, &options).map_err(|error| error.to_string())?;
    if !arguments.quiet {
        warnings.iter().for_each(|warning| report("warning", &warning.to_string()));
    }
    Ok(document)
}

fn run_script(script: &Script, document: &mut Document, quiet: bool) -> Result<(), String> {
    let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(script.commands.len() as u64) };
    // Drawn a few times per second at most, and only if standard error is a terminal.
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} {msg}").expect("a valid template");
    bar.set_style(style);
    let result = script.run(document, |progress| {
        bar.set_position(progress.index as u64);
        bar.set_message(progress.command.name());
    });
    bar.finish_and_clear();
    let outcomes = result.map_err(|error| error.to_string())?;
    if !quiet {
        tell(script, &outcomes);
    }
    Ok(())
}

/// The messages of the commands, each with its position in the script.
fn tell(script: &Script, outcomes: &[Outcome]) {
    for (index, (command, outcome)) in script.commands.iter().zip(outcomes).enumerate() {
        let position = format!("command {} ({})", index + 1, command.name());
        if !outcome.message.is_empty() {
            report(&position, &outcome.message);
        }
        outcome.warnings.iter().for_each(|warning| report("warning", &format!("{position}: {warning}")));
    }
}
