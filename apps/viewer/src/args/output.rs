//! The destination of an image: standard output, or a file whose name may contain variables.

use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::SystemTime;

/// The destination of an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Destination {
    /// Standard output.
    Stdout,
    /// A file.
    File(Template),
}

impl FromStr for Destination {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "-" {
            return Ok(Self::Stdout);
        }
        let ending = Path::new(text).extension().map(|ending| ending.to_string_lossy().to_lowercase());
        if !ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str())) {
            return Err(format!(
                "use a name that ends in .{}, or - for a PNG on standard output",
                ENDINGS.join(", .")
            ));
        }
        Template::parse(text).map(Self::File)
    }
}

/// The extensions of the image formats.
const ENDINGS: [&str; 7] = ["png", "jpg", "jpeg", "webp", "exr", "gif", "apng"];

/// The name of an image that is a single file.
pub(crate) fn image_name(text: &str) -> Result<Template, String> {
    match text.parse()? {
        Destination::Stdout => Err("name a file".to_owned()),
        Destination::File(template) => Ok(template),
    }
}

/// The name of a plot or a table.
pub(crate) fn plot_name(text: &str) -> Result<Template, String> {
    let ending = Path::new(text).extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("svg" | "csv") => Template::parse(text),
        _ => Err("use a name that ends in .svg for a plot, or in .csv for a table".to_owned()),
    }
}

/// A file name with variables, such as `{model}_{n:3}.png`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Template(Vec<Piece>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Piece {
    Text(String),
    /// The model's name without its extension.
    Model,
    /// With its extension.
    ModelWithExtension,
    /// The extension alone.
    Extension,
    /// A number, padded to this many digits.
    Number(usize),
    /// The number of a frame, padded to this many digits.
    Frame(usize),
    /// The name of the camera without folder and extension, or else the number of the frame.
    Camera,
    /// The date in a format of `strftime`.
    Date(String),
}

/// The properties of an image that its name may use.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Subject<'a> {
    /// `None` for the built-in scene.
    pub(crate) model: Option<&'a Path>,
    /// From 0.
    pub(crate) frame: u32,
    /// The name of its camera, such as that of a photograph; empty if there is none.
    pub(crate) view: &'a str,
}

impl Template {
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let (mut pieces, mut rest) = (Vec::new(), text);
        while let Some(open) = rest.find('{') {
            pieces.push(Piece::Text(rest[..open].to_owned()));
            let (piece, after) = match rest[open..].strip_prefix("{{") {
                Some(escaped) => literal(escaped)?,
                None => variable(&rest[open + 1..])?,
            };
            pieces.push(piece);
            rest = after;
        }
        pieces.push(Piece::Text(rest.to_owned()));
        Ok(Self(pieces))
    }

    /// Whether the name is that of an OpenEXR file, which holds all outputs.
    pub(crate) fn is_exr(&self) -> bool {
        matches!(self.0.last(), Some(Piece::Text(end)) if end.to_lowercase().ends_with(".exr"))
    }

    /// Whether the name is that of a file that holds several frames.
    pub(crate) fn is_moving(&self) -> bool {
        let end =
            |text: &str| text.to_lowercase().ends_with(".gif") || text.to_lowercase().ends_with(".apng");
        matches!(self.0.last(), Some(Piece::Text(text)) if end(text))
    }

    /// Whether each frame gets its own name.
    pub(crate) fn tells_frames_apart(&self) -> bool {
        self.0.iter().any(|piece| matches!(piece, Piece::Frame(_) | Piece::Camera))
    }

    /// Whether the same image gets the same name again, whatever files there are and whatever day it is.
    pub(crate) fn is_repeatable(&self) -> bool {
        !self.0.iter().any(|piece| matches!(piece, Piece::Number(_) | Piece::Date(_)))
    }

    /// Whether the name contains that of the camera.
    pub(crate) fn names_camera(&self) -> bool {
        self.0.contains(&Piece::Camera)
    }

    /// Whether different models get different names.
    pub(crate) fn tells_models_apart(&self) -> bool {
        self.0
            .iter()
            .any(|piece| matches!(piece, Piece::Model | Piece::ModelWithExtension | Piece::Number(_)))
    }

    /// The name for an image, with the first number whose file does not exist yet.
    pub(crate) fn unused(&self, subject: Subject<'_>) -> PathBuf {
        self.unused_in(Path::new(""), subject)
    }

    /// The same in a folder.
    pub(crate) fn unused_in(&self, folder: &Path, subject: Subject<'_>) -> PathBuf {
        let numbered = self.0.iter().any(|piece| matches!(piece, Piece::Number(_)));
        let now = SystemTime::now();
        let mut names = (1..).map(|number| folder.join(self.fill(subject, number, now)));
        let free = names.find(|name| !numbered || !name.exists());
        free.expect("a folder holds fewer files than there are numbers")
    }

    fn fill(&self, Subject { model, frame, view }: Subject<'_>, number: usize, now: SystemTime) -> PathBuf {
        let text = |part: Option<&std::ffi::OsStr>| part.map(|part| part.to_string_lossy().into_owned());
        let name: String = self
            .0
            .iter()
            .map(|piece| match piece {
                Piece::Text(text) => text.clone(),
                Piece::Model => text(model.and_then(Path::file_stem)).unwrap_or_else(|| BUILT_IN.to_owned()),
                Piece::ModelWithExtension => {
                    text(model.and_then(Path::file_name)).unwrap_or_else(|| BUILT_IN.to_owned())
                }
                Piece::Extension => text(model.and_then(Path::extension)).unwrap_or_default(),
                Piece::Number(digits) => format!("{number:0digits$}"),
                Piece::Frame(digits) => format!("{frame:0digits$}"),
                Piece::Camera => text(Path::new(view).file_stem()).unwrap_or_else(|| frame.to_string()),
                Piece::Date(format) => date(now, format),
            })
            .collect();
        expand_home(&name)
    }
}

/// The name of the built-in scene in file names.
const BUILT_IN: &str = "trigon";

/// `{{x}}` stands for `{x}`: `text` begins after the two braces.
fn literal(text: &str) -> Result<(Piece, &str), String> {
    let (name, after) = text.split_once("}}").ok_or("a {{ has no }}")?;
    Ok((Piece::Text(format!("{{{name}}}")), after))
}

/// A variable; `text` begins after its brace.
fn variable(text: &str) -> Result<(Piece, &str), String> {
    let (name, after) = text.split_once('}').ok_or("a { has no }")?;
    let piece = match (name, name.split_once(':')) {
        ("app", _) => Piece::Text("trigon-viewer".to_owned()),
        ("version" | "version_full", _) => Piece::Text(env!("CARGO_PKG_VERSION").to_owned()),
        ("model", _) => Piece::Model,
        ("model.ext", _) => Piece::ModelWithExtension,
        ("model_ext", _) => Piece::Extension,
        ("n", _) => Piece::Number(1),
        (_, Some(("n", digits))) => Piece::Number(padding(digits)?),
        ("frame", _) => Piece::Frame(1),
        ("camera", _) => Piece::Camera,
        (_, Some(("frame", digits))) => Piece::Frame(padding(digits)?),
        ("date", _) => Piece::Date("%Y%m%d".to_owned()),
        (_, Some(("date", format))) => Piece::Date(format.to_owned()),
        _ => {
            return Err(format!(
                "{{{name}}} is not a variable; there are {{model}}, {{model.ext}}, {{model_ext}}, {{n}}, {{n:3}}, {{frame}}, {{frame:4}}, {{camera}}, {{date}}, {{app}} and {{version}}"
            ));
        }
    };
    Ok((piece, after))
}

fn padding(digits: &str) -> Result<usize, String> {
    const MOST: usize = 20;
    let digits = digits.parse::<usize>().ok().filter(|digits| (1..=MOST).contains(digits));
    digits.ok_or_else(|| format!("after the colon comes a number of digits from 1 to {MOST}"))
}

/// A time in UTC, in a format of `strftime` with its numeric letters; other letters are kept.
fn date(time: SystemTime, format: &str) -> String {
    let seconds = time.duration_since(SystemTime::UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    let (year, month, day) = civil(days);
    let mut text = String::new();
    let mut letters = format.chars();
    while let Some(letter) = letters.next() {
        match (letter == '%').then(|| letters.next()).flatten() {
            Some('Y') => text += &format!("{year:04}"),
            Some('m') => text += &format!("{month:02}"),
            Some('d') => text += &format!("{day:02}"),
            Some('H') => text += &format!("{:02}", second / 3600),
            Some('M') => text += &format!("{:02}", second / 60 % 60),
            Some('S') => text += &format!("{:02}", second % 60),
            Some('F') => text += &format!("{year:04}-{month:02}-{day:02}"),
            Some(other) => text.push(other),
            None => text.push(letter),
        }
    }
    text
}

/// Year, month and day of a day since 1970-01-01: years are counted from March, so that the leap
/// day is the last one, in eras of 400 years with 146,097 days.
fn civil(days: u64) -> (u64, u64, u64) {
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    (era * 400 + year + later, month, day)
}

/// Expands `~/…` to the home folder: shells do not do this after `--output=`.
fn expand_home(name: &str) -> PathBuf {
    match (name.strip_prefix("~/"), std::env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => PathBuf::from(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(template: &str, model: Option<&str>) -> String {
        let template = Template::parse(template).expect("a template");
        let subject = Subject { model: model.map(Path::new), frame: 12, view: "images/left.1.jpg" };
        // 2024-02-29 13:05:09.
        let now = SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_709_211_909);
        template.fill(subject, 7, now).to_string_lossy().into_owned()
    }

    #[test]
    fn variables_are_filled_in() {
        let model = Some("some/where/big.chair.obj");
        assert_eq!(filled("plain.png", model), "plain.png", "no variable");
        assert_eq!(filled("out/{model}_{n}.png", model), "out/big.chair_7.png", "model and number");
        assert_eq!(filled("{model.ext}.{n:3}.png", model), "big.chair.obj.007.png", "ending and padding");
        assert_eq!(filled("{model_ext}.png", model), "obj.png", "ending alone");
        assert_eq!(filled("{{model}}_{app}.png", model), "{model}_trigon-viewer.png", "escaped");
        assert_eq!(filled("{model}.png", None), "trigon.png", "the built-in scene");
        assert_eq!(filled("{frame}_{frame:04}.png", None), "12_0012.png", "a frame");
        assert_eq!(filled("{camera}.png", None), "left.1.png", "a camera");
        assert_eq!(filled("{date}_{date:%H-%M-%S}.png", None), "20240229_13-05-09.png", "a leap day");
    }

    #[test]
    fn mistakes_are_named() {
        for (text, word) in [
            ("{modle}.png", "modle"),
            ("{model.png", "no }"),
            ("{{model.png", "no }}"),
            ("{n:0}.png", "digits"),
            ("a.tiff", ".png"),
            ("a", ".png"),
        ] {
            let error = text.parse::<Destination>().expect_err("refused");
            assert!(error.contains(word), "{text}: {error}");
        }
        assert_eq!("-".parse(), Ok(Destination::Stdout), "standard output");
    }
}
