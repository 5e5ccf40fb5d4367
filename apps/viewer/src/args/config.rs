//! Configuration files: JSON in F3D's format, a list of blocks with flags for the files that match
//! a pattern.
//!
//! The command line overrides them, except names with `!` in front, which override the command
//! line. Later blocks override earlier ones.

use std::fs;
use std::path::{Path, PathBuf};

use regex_lite::Regex;
use serde_json::{Map, Value};

use super::{names, script};

/// All blocks of all configuration files, in order of precedence.
#[derive(Clone, Debug, Default)]
pub(crate) struct Config {
    blocks: Vec<Block>,
    /// The files that were read.
    pub(crate) files: Vec<PathBuf>,
    /// Entries that have no effect, with the reason.
    pub(crate) warnings: Vec<String>,
}

/// Flags for some files.
#[derive(Clone, Debug)]
struct Block {
    /// `None` for all files.
    files: Option<Regex>,
    options: Vec<ConfigSetting>,
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "there is no window"))]
    bindings: Vec<KeyBinding>,
}

/// A key, and the lines of a command script that it executes in the window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct KeyBinding {
    pub(crate) key: String,
    pub(crate) lines: Vec<String>,
}

/// A flag, its value, and whether it overrides the command line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ConfigSetting {
    pub(crate) flag: String,
    pub(crate) value: String,
    pub(crate) imperative: bool,
    /// The file that it is from.
    pub(crate) file: PathBuf,
}

impl Config {
    /// Reads what `--config` names: a file, a folder of files, or the stem of files in the user's
    /// folder. Without it, the user's own `config`, if it exists.
    ///
    /// # Errors
    /// The named file does not exist, or is invalid.
    pub(crate) fn read(named: Option<&Path>) -> Result<Self, String> {
        let paths = match named {
            Some(path) if path.exists() => vec![path.to_owned()],
            Some(path) => users(path),
            None => users(Path::new("config")),
        };
        let found: Vec<PathBuf> = paths.iter().filter(|path| path.exists()).cloned().collect();
        if let (Some(path), true) = (named, found.is_empty()) {
            let tried: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
            let path = path.display();
            return Err(format!("--config={path}: there is no such file; looked for {}", tried.join(", ")));
        }
        let mut config = Self::default();
        for path in found {
            for file in json_files(&path)? {
                config.add(&file)?;
            }
        }
        Ok(config)
    }

    fn add(&mut self, file: &Path) -> Result<(), String> {
        let name = file.display();
        let text = fs::read_to_string(file).map_err(|error| format!("{name}: cannot be read ({error})"))?;
        let mut warnings = Vec::new();
        let mut blocks = blocks(&text, &mut warnings).map_err(|why| format!("{name}: {why}"))?;
        let settings = blocks.iter_mut().flat_map(|block| &mut block.options);
        settings.for_each(|setting| file.clone_into(&mut setting.file));
        self.blocks.extend(blocks);
        self.warnings.extend(warnings.into_iter().map(|warning| format!("{name}: {warning}")));
        self.files.push(file.to_owned());
        Ok(())
    }

    /// The settings for a file (`None` for the built-in scene); those with the highest precedence
    /// come last.
    pub(crate) fn settings(&self, file: Option<&Path>) -> Vec<ConfigSetting> {
        let mut settings: Vec<ConfigSetting> = Vec::new();
        for setting in self.matching(file).flat_map(|block| &block.options) {
            settings.retain(|other| other.flag != setting.flag);
            settings.push(setting.clone());
        }
        settings
    }

    /// The keys of the window for a file; later ones override earlier ones on the same key.
    #[cfg(feature = "window")]
    pub(crate) fn bindings(&self, file: Option<&Path>) -> Vec<KeyBinding> {
        let mut bindings: Vec<KeyBinding> = Vec::new();
        for binding in self.matching(file).flat_map(|block| &block.bindings) {
            bindings.retain(|other| !other.key.eq_ignore_ascii_case(&binding.key));
            bindings.push(binding.clone());
        }
        bindings
    }

    /// The blocks that apply to a file.
    fn matching(&self, file: Option<&Path>) -> impl Iterator<Item = &Block> {
        let name = file.map(|file| std::path::absolute(file).unwrap_or_else(|_| file.to_owned()));
        let name = name.map(|name| name.to_string_lossy().into_owned());
        self.blocks.iter().filter(move |block| match (&block.files, &name) {
            (None, _) => true,
            (Some(files), Some(name)) => files.is_match(name),
            (Some(_), None) => false,
        })
    }
}

/// `trigon/NAME.json` and the folder `trigon/NAME.d` in the user's configuration folder.
fn users(name: &Path) -> Vec<PathBuf> {
    let home = std::env::var_os("XDG_CONFIG_HOME").filter(|folder| !folder.is_empty()).map(PathBuf::from);
    let home = home.or_else(|| std::env::home_dir().map(|home| home.join(".config")));
    let Some(folder) = home.map(|home| home.join("trigon")) else { return Vec::new() };
    vec![folder.join(name).with_extension("json"), folder.join(name).with_extension("d")]
}

/// The file itself, or the files of a folder that end in `.json`, by name.
fn json_files(path: &Path) -> Result<Vec<PathBuf>, String> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let entries =
        fs::read_dir(path).map_err(|error| format!("{}: cannot be read ({error})", path.display()))?;
    let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files: Vec<PathBuf> =
        files.filter(|file| file.extension().is_some_and(|end| end == "json")).collect();
    files.sort();
    Ok(files)
}

fn blocks(text: &str, warnings: &mut Vec<String>) -> Result<Vec<Block>, String> {
    let json: Value = serde_json::from_str(text).map_err(|error| format!("it is not JSON ({error})"))?;
    let Value::Array(list) = json else {
        return Err("write a list of blocks, [{\"options\": {…}}]".to_owned());
    };
    let block = |(index, value)| block(value, warnings).map_err(|why| format!("block {index}: {why}"));
    list.iter().enumerate().map(block).collect()
}

fn block(value: &Value, warnings: &mut Vec<String>) -> Result<Block, String> {
    let Value::Object(fields) = value else { return Err("it is not an object".to_owned()) };
    if let Some(other) = fields.keys().find(|key| !KEYS.contains(&key.as_str())) {
        return Err(format!("{other:?} is unknown; write one of {}", KEYS.join(", ")));
    }
    let bindings = match fields.get("bindings") {
        None => Vec::new(),
        Some(Value::Object(bindings)) => {
            bindings.iter().map(|(key, value)| binding(key, value)).collect::<Result<_, _>>()?
        }
        Some(_) => return Err("bindings is not an object".to_owned()),
    };
    let options = match fields.get("options") {
        None => Vec::new(),
        Some(Value::Object(options)) => settings(options, warnings)?,
        Some(_) => return Err("options is not an object".to_owned()),
    };
    Ok(Block { files: pattern(fields)?, options, bindings })
}

/// A key and its line, or its lines.
fn binding(key: &str, value: &Value) -> Result<KeyBinding, String> {
    let wrong = || format!("bindings: {key} is {value}; write a command, or a list of commands");
    let texts = match value {
        Value::Array(list) => list.iter().map(Value::as_str).collect(),
        other => other.as_str().map(|line| vec![line]),
    };
    let lines: Vec<String> = texts.ok_or_else(wrong)?.into_iter().map(str::to_owned).collect();
    for line in &lines {
        let words = script::split(line).map_err(|why| format!("bindings: {key}: {why}"))?;
        if words.is_empty() {
            return Err(wrong());
        }
    }
    Ok(KeyBinding { key: key.to_owned(), lines })
}

const KEYS: [&str; 4] = ["match", "match-type", "options", "bindings"];

/// The files that a block applies to.
fn pattern(fields: &Map<String, Value>) -> Result<Option<Regex>, String> {
    let text = |key: &str| fields.get(key).and_then(Value::as_str);
    let Some(wanted) = text("match") else { return Ok(None) };
    let expression = match text("match-type").unwrap_or("regex") {
        "regex" => format!("^(?:{wanted})$"),
        "glob" => glob(wanted),
        "exact" => format!("^{}$", regex_lite::escape(wanted)),
        other => return Err(format!("match-type is {other:?}; write regex, glob or exact")),
    };
    Regex::new(&expression).map(Some).map_err(|error| format!("match: {error}"))
}

/// Converts a glob to a regular expression: `*` and `?` within a folder, `**` across folders, and
/// `{a,b}` for alternatives. Without a slash it is matched against the file's name.
fn glob(wanted: &str) -> String {
    let mut expression = if wanted.contains('/') { "^".to_owned() } else { "(?:^|/)".to_owned() };
    let mut rest = wanted.chars().peekable();
    let mut depth = 0;
    while let Some(character) = rest.next() {
        match character {
            '*' if rest.next_if_eq(&'*').is_some() => {
                let folders = rest.next_if_eq(&'/').is_some();
                expression.push_str(if folders { "(?:.*/)?" } else { ".*" });
            }
            '*' => expression.push_str("[^/]*"),
            '?' => expression.push_str("[^/]"),
            '{' => {
                depth += 1;
                expression.push_str("(?:");
            }
            '}' if depth > 0 => {
                depth -= 1;
                expression.push(')');
            }
            ',' if depth > 0 => expression.push('|'),
            other => expression.push_str(&regex_lite::escape(other.encode_utf8(&mut [0; 4]))),
        }
    }
    expression + "$"
}

fn settings(options: &Map<String, Value>, warnings: &mut Vec<String>) -> Result<Vec<ConfigSetting>, String> {
    /// These choose the configuration itself, or replace drawing.
    const NOT_HERE: [&str; 8] =
        ["help", "version", "list-readers", "list-bindings", "config", "no-config", "define", "input"];
    let mut settings = Vec::new();
    for (key, value) in options {
        let (name, imperative) = key.strip_prefix('!').map_or((key.as_str(), false), |name| (name, true));
        if NOT_HERE.contains(&name) {
            return Err(format!("{name} belongs on the command line"));
        }
        let value = text(value).ok_or_else(|| format!("{name} is {value}; write text, a number or true"))?;
        match names::flag(name) {
            Ok(flag) => {
                settings.push(ConfigSetting {
                    flag: flag.to_owned(),
                    value,
                    imperative,
                    file: PathBuf::new(),
                });
            }
            Err(why) => warnings.push(format!("{why}; it is ignored")),
        }
    }
    Ok(settings)
}

/// A value as it would be typed.
pub(super) fn text(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Number(number) => Some(number.to_string()),
        Value::Bool(on) => Some(on.to_string()),
        Value::Array(list) => Some(list.iter().map(text).collect::<Option<Vec<_>>>()?.join(",")),
        Value::Null | Value::Object(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn config(text: &str) -> Config {
        Config { blocks: blocks(text, &mut Vec::new()).expect("a configuration"), ..Config::default() }
    }

    fn flags(config: &Config, file: &str) -> Vec<String> {
        let settings = config.settings(Some(Path::new(file)));
        settings.iter().map(|setting| format!("{}={}", setting.flag, setting.value)).collect()
    }

    #[test]
    fn blocks_are_for_the_files_that_match() {
        let config = config(
            r#"[{"options": {"color": "0.5,0.1,0.1", "grid": true, "roughness": 0.2}},
                {"match": ".*gl(tf|b)", "options": {"edges": true, "grid": false}},
                {"match-type": "glob", "match": "*st?", "options": {"up": "+Z"}},
                {"match-type": "exact", "match": "/a/b.ply", "options": {"!axis": true}}]"#,
        );
        let all = ["color=0.5,0.1,0.1", "roughness=0.2"];
        assert_eq!(flags(&config, "/a/x.glb"), [all[0], all[1], "edges=true", "grid=false"], "later counts");
        assert_eq!(flags(&config, "/a/x.stl"), [all[0], "grid=true", all[1], "up=+Z"], "glob");
        assert_eq!(flags(&config, "/a/b.ply"), [all[0], "grid=true", all[1], "axis=true"], "exact");
        assert!(config.settings(Some(Path::new("/a/b.ply")))[3].imperative, "it wins");
        assert_eq!(config.settings(None).len(), 3, "the built-in scene matches nothing");
    }

    #[test]
    fn globs_cross_folders_with_two_stars() {
        for (wanted, path, matches) in [
            ("**/*gl{tf,b}", "/a/b/c.glb", true),
            ("**/*gl{tf,b}", "/a/b/c.gltf", true),
            ("/a/*.obj", "/a/b/c.obj", false),
            ("/a/**.obj", "/a/b/c.obj", true),
            ("c.o?j", "/a/b/c.obj", true),
            ("c.obj", "/a/b/xc.obj", false),
        ] {
            let expression = Regex::new(&glob(wanted)).expect("an expression");
            assert_eq!(expression.is_match(path), matches, "{wanted} and {path}");
        }
    }

    #[test]
    fn mistakes_are_named() {
        for (text, word) in [
            ("{", "not JSON"),
            ("{}", "list of blocks"),
            ("[3]", "block 0"),
            (r#"[{"option": {}}]"#, "\"option\" is unknown"),
            (r#"[{"match": "(", "options": {}}]"#, "match"),
            (r#"[{"match": "a", "match-type": "like"}]"#, "regex, glob or exact"),
            (r#"[{"options": {"config": "x"}}]"#, "command line"),
            (r#"[{"options": {"grid": {}}}]"#, "grid is"),
            (r#"[{"bindings": ["O"]}]"#, "bindings is not an object"),
            (r#"[{"bindings": {"O": 3}}]"#, "bindings: O is 3"),
            (r#"[{"bindings": {"O": ["exit", ""]}}]"#, "bindings: O is"),
            (r#"[{"bindings": {"O": "set up 'x"}}]"#, "not closed"),
        ] {
            let why = blocks(text, &mut Vec::new()).expect_err("refused");
            assert!(why.contains(word), "{text}: {why}");
        }
    }

    #[test]
    fn what_does_nothing_is_said() {
        let text = r#"[{"options": {"final-shader": "x", "edges": true}}]"#;
        let mut warnings = Vec::new();
        assert_eq!(blocks(text, &mut warnings).expect("fine")[0].options.len(), 1, "the edges");
        assert!(warnings[0].contains("no GPU"), "{warnings:?}");
    }

    #[cfg(feature = "window")]
    #[test]
    fn bindings_are_for_the_files_that_match() {
        let config = config(
            r#"[{"bindings": {"Ctrl+Shift+O": "toggle ui.filename", "Any+3": "roll_camera -90"}},
                {"match": ".*vtu", "bindings": {"any+3": ["roll_camera 90", "toggle ui.axis"]}}]"#,
        );
        let lines = |file: &str| {
            let bindings = config.bindings(Some(Path::new(file)));
            bindings.into_iter().map(|binding| (binding.key, binding.lines.join("; "))).collect::<Vec<_>>()
        };
        let own = |key: &str, lines: &str| (key.to_owned(), lines.to_owned());
        let name = own("Ctrl+Shift+O", "toggle ui.filename");
        assert_eq!(lines("/a/b.ply"), [own("Any+3", "roll_camera -90"), name.clone()], "of all files");
        assert_eq!(lines("/a/b.vtu"), [name, own("any+3", "roll_camera 90; toggle ui.axis")], "later counts");
    }
}
