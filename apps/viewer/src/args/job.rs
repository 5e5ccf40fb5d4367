//! A job of a batch: an object of JSON with the models and the flags of a command that draws images.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::line::word;
use super::output::{Destination, Subject, Template};
use super::{CommandLine, config, names, plain};

/// A job, as it is written into receipts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Job {
    /// The models; none is the built-in scene.
    inputs: Vec<String>,
    /// Flags without dashes, and their values as they would be typed.
    flags: BTreeMap<String, String>,
}

impl Job {
    /// Reads a line.
    ///
    /// # Errors
    /// It is no job; with the remedy.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let json: Value = serde_json::from_str(text).map_err(|error| format!("it is not JSON ({error})"))?;
        let Value::Object(mut members) = json else {
            return Err(
                "write an object, such as {\"input\": \"chair.glb\", \"output\": \"chair.png\"}".to_owned()
            );
        };
        let inputs = inputs(members.remove("input").unwrap_or_default())?;
        let job = Self { inputs, flags: flags(&members)? };
        job.template().map(|_| job)
    }

    /// The model that configurations go by.
    pub(crate) fn first_input(&self) -> Option<&Path> {
        self.inputs.first().map(Path::new)
    }

    /// Whether its images have the names of their cameras, which nobody knows before they are read.
    pub(crate) fn names_cameras(&self) -> bool {
        self.template().is_ok_and(|template| template.names_camera())
    }

    /// The names of its first images, if their cameras do not name them: in two jobs they are a conflict.
    pub(crate) fn names(&self) -> Vec<String> {
        let template = self.template().ok().filter(|template| !template.names_camera());
        let subjects = match self.inputs.as_slice() {
            [] => vec![None],
            files => files.iter().map(|file| Some(Path::new(file))).collect(),
        };
        let name = |template: &Template, model| {
            template.unused(Subject { model, ..Subject::default() }).to_string_lossy().into_owned()
        };
        template.iter().flat_map(|template| subjects.iter().map(|model| name(template, *model))).collect()
    }

    /// The command line that draws it. The user's own configuration is not read: a job draws the same images everywhere.
    ///
    /// # Errors
    /// The flags are invalid, or contradict each other.
    pub(crate) fn line(&self, more: &[OsString]) -> Result<CommandLine, String> {
        let mut words: Vec<OsString> = self.flags.iter().map(|(flag, value)| word(flag, value)).collect();
        if !self.flags.contains_key("config") {
            words.push("--no-config".into());
        }
        words.extend_from_slice(more);
        words.push("--".into());
        words.extend(self.inputs.iter().map(OsString::from));
        CommandLine::new(words).map_err(|error| plain(&error))
    }

    fn template(&self) -> Result<Template, String> {
        let Some(name) = self.flags.get("output") else {
            return Err("it has no output; write where its images go (\"output\": \"chair_{frame:3}.png\")"
                .to_owned());
        };
        match name.parse().map_err(|why| format!("output: {why}"))? {
            Destination::Stdout => Err("output: a batch writes no image to standard output; name a file".to_owned()),
            Destination::File(template) if template.is_repeatable() => Ok(template),
            Destination::File(_) => Err(
                "output: with {n} and {date} an image has another name each time; write {model}, {frame} or {camera}".to_owned(),
            ),
        }
    }
}

/// One name or a list of them.
fn inputs(value: Value) -> Result<Vec<String>, String> {
    let wrong = |value: &Value| format!("input is {value}; write the name of a file, or a list of names");
    let files = match value {
        Value::Null => Vec::new(),
        Value::Array(list) => list,
        one => vec![one],
    };
    let name = |file: Value| match file {
        Value::String(name) if name == super::STDIN => {
            Err("input: a batch reads no model from standard input; name a file".to_owned())
        }
        Value::String(name) => Ok(name),
        other => Err(wrong(&other)),
    };
    files.into_iter().map(name).collect()
}

fn flags(members: &Map<String, Value>) -> Result<BTreeMap<String, String>, String> {
    let mut flags = BTreeMap::new();
    for (name, value) in members {
        if let Some((_, why)) = NOT_IN_JOBS.iter().find(|(flags, _)| flags.contains(&name.as_str())) {
            return Err(format!("{name} {why}"));
        }
        let flag = names::flag(name)?;
        let text =
            config::text(value).ok_or_else(|| format!("{name} is {value}; write text, a number or true"))?;
        flags.insert(flag.to_owned(), text);
    }
    Ok(flags)
}

/// Flags that a job cannot have, and why.
const NOT_IN_JOBS: [(&[&str], &str); 3] = [
    (
        &["threads", "simd", "verbose", "json", "loading-progress"],
        "changes no image; write it on the command line of the batch, if it has such a flag",
    ),
    (
        &["time-budget"],
        "draws what the machine can do in a time, and no other machine could verify that; write preset or samples",
    ),
    (
        &[
            "help",
            "version",
            "list-readers",
            "list-bindings",
            "list-rendering-backends",
            "no-config",
            "define",
            "reset",
            "unset",
            "command-script",
            "capture",
            "replay",
            "reference",
            "compare",
            "check",
            "explain",
            "explain-pixel",
            "no-render",
            "frontier",
        ],
        "is not for jobs, which draw images; leave it out",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn job(text: &str) -> Job {
        Job::parse(text).expect("a job")
    }

    #[test]
    fn a_job_is_a_command_line() {
        let text = r#"{"input": "a.glb", "output": "a_{frame}.png", "outputs": ["depth", "normals"], "samples": 2,
            "edges": true, "anti-aliasing": true, "up": "-Z", "render.grid.enable": false}"#;
        let line = job(text).line(&["--threads=1".into()]).expect("a line").text();
        assert_eq!(
            line,
            "--anti-aliasing --edges=true --grid=false --output=a_{frame}.png --outputs=depth,normals --samples=2 --up=-Z --no-config --threads=1 -- a.glb"
        );
        let other =
            job(r#"{"samples": "2", "output": "x.png", "input": ["b.obj", "-c.obj"], "config": "c.json"}"#);
        assert_eq!(other.inputs, ["b.obj", "-c.obj"], "a list");
        assert!(!other.flags.contains_key("no-config"), "it names a configuration itself");
    }

    #[test]
    fn mistakes_are_named() {
        for (text, word) in [
            ("{", "not JSON"),
            ("[]", "write an object"),
            ("{}", "no output"),
            (r#"{"input": 3, "output": "a.png"}"#, "input is 3"),
            (r#"{"input": "-", "output": "a.png"}"#, "standard input"),
            (r#"{"output": "-"}"#, "standard output"),
            (r#"{"output": "a.tiff"}"#, "output: use a name"),
            (r#"{"output": "{n}.png"}"#, "another name each time"),
            (r#"{"output": "{date}.png"}"#, "another name each time"),
            (r#"{"output": "a.png", "sample": 3}"#, "\"sample\" is not an option"),
            (r#"{"output": "a.png", "samples": {}}"#, "samples is {}"),
            (r#"{"output": "a.png", "threads": 1}"#, "changes no image"),
            (r#"{"output": "a.png", "time-budget": "5ms"}"#, "verify"),
            (r#"{"output": "a.png", "capture": "a.trigon"}"#, "not for jobs"),
        ] {
            let why = Job::parse(text).expect_err("refused");
            assert!(why.contains(word), "{text}: {why}");
        }
    }

    #[test]
    fn names_of_images_tell_jobs_apart() {
        let names = |text| job(text).names();
        assert_eq!(
            names(r#"{"input": ["x/a.glb", "b.obj"], "output": "o/{model}_{frame:3}.png"}"#),
            ["o/a_000.png", "o/b_000.png"]
        );
        assert_eq!(names(r#"{"output": "{model}.png"}"#), ["trigon.png"], "the built-in scene");
        assert!(
            names(r#"{"input": "a.glb", "output": "{camera}.png"}"#).is_empty(),
            "it depends on the cameras"
        );
    }
}
