//! Where a picture goes: standard output, or a file whose name may hold
//! variables.

use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Where a picture goes.
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
        if !matches!(ending.as_deref(), Some("png" | "exr")) {
            return Err(
                "pictures are written as PNG or OpenEXR; use a name that ends in .png or .exr, or - for standard output"
                    .to_owned(),
            );
        }
        Template::parse(text).map(Self::File)
    }
}

/// A file name with variables, such as `{model}_{n:3}.png`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Template(Vec<Piece>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Piece {
    Text(String),
    /// The model's name without its ending.
    Model,
    /// With its ending.
    ModelWithExtension,
    /// The ending alone.
    Extension,
    /// A number, padded to this many digits.
    Number(usize),
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

    /// Whether different models get different names.
    pub(crate) fn tells_models_apart(&self) -> bool {
        self.0
            .iter()
            .any(|piece| matches!(piece, Piece::Model | Piece::ModelWithExtension | Piece::Number(_)))
    }

    /// The name for a model (`None` for the built-in scene), with the first
    /// number whose file does not exist yet.
    pub(crate) fn unused(&self, model: Option<&Path>) -> PathBuf {
        self.unused_in(Path::new(""), model)
    }

    /// The same in a folder.
    pub(crate) fn unused_in(&self, folder: &Path, model: Option<&Path>) -> PathBuf {
        let numbered = self.0.iter().any(|piece| matches!(piece, Piece::Number(_)));
        let mut names = (1..).map(|number| folder.join(self.fill(model, number)));
        let free = names.find(|name| !numbered || !name.exists());
        free.expect("a folder holds fewer files than there are numbers")
    }

    fn fill(&self, model: Option<&Path>, number: usize) -> PathBuf {
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
            })
            .collect();
        expand_home(&name)
    }
}

/// What the built-in scene is called in file names.
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
        ("version", _) => Piece::Text(env!("CARGO_PKG_VERSION").to_owned()),
        ("model", _) => Piece::Model,
        ("model.ext", _) => Piece::ModelWithExtension,
        ("model_ext", _) => Piece::Extension,
        ("n", _) => Piece::Number(1),
        (_, Some(("n", digits))) => Piece::Number(padding(digits)?),
        _ => {
            return Err(format!(
                "{{{name}}} is no variable; there are {{model}}, {{model.ext}}, {{model_ext}}, {{n}}, {{n:3}}, {{app}} and {{version}}"
            ));
        }
    };
    Ok((piece, after))
}

fn padding(digits: &str) -> Result<usize, String> {
    const MOST: usize = 20;
    let digits = digits.parse::<usize>().ok().filter(|digits| (1..=MOST).contains(digits));
    digits.ok_or_else(|| format!("after {{n: comes a number of digits from 1 to {MOST}"))
}

/// `~/…` in the home folder: shells leave it alone after `--output=`.
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
        template.fill(model.map(Path::new), 7).to_string_lossy().into_owned()
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
    }

    #[test]
    fn mistakes_are_named() {
        for (text, word) in [
            ("{modle}.png", "modle"),
            ("{model.png", "no }"),
            ("{{model.png", "no }}"),
            ("{n:0}.png", "digits"),
            ("a.jpg", ".png"),
            ("a", ".png"),
        ] {
            let error = text.parse::<Destination>().expect_err("refused");
            assert!(error.contains(word), "{text}: {error}");
        }
        assert_eq!("-".parse(), Ok(Destination::Stdout), "standard output");
    }
}
