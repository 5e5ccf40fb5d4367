//! What users have set up for themselves, kept between runs.

use std::fs;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use trigon_io::write_atomically;
use trigon_window::Theme;

use crate::up::Up;

/// The settings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Settings {
    /// Whether the tab *Development* is there.
    pub(crate) development: bool,
    /// Whether Alt and the left button stand for the middle one.
    pub(crate) emulates_mouse: bool,
    /// Whether the digits above the letters stand for those of the number pad.
    pub(crate) emulates_numpad: bool,
    /// Which axis is shown as up; `None` before anybody was asked.
    pub(crate) up: Option<Up>,
    /// Whether panels are light or dark.
    pub(crate) theme: Theme,
    /// By how much text and buttons are larger than usual.
    pub(crate) text_scale: f32,
}

impl Default for Settings {
    fn default() -> Self {
        // Touchpads and thin clients have no middle button, and nothing is lost by helping them.
        Self {
            development: false,
            emulates_mouse: true,
            emulates_numpad: false,
            up: None,
            theme: Theme::System,
            text_scale: 1.0,
        }
    }
}

/// The settings and their file.
#[derive(Debug, Default)]
pub(crate) struct Preferences {
    settings: Settings,
    /// `None` remembers nothing beyond this run.
    file: Option<PathBuf>,
}

impl Preferences {
    /// The settings of a JSON file; the usual ones for what it does not say, and if it cannot be read.
    pub(crate) fn load(file: Option<PathBuf>) -> Self {
        let text = file.as_ref().and_then(|file| fs::read_to_string(file).ok());
        let settings = text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
        Self { settings, file }
    }

    pub(crate) fn get(&self) -> Settings {
        self.settings
    }

    /// Whether which axis is up is a question still. Nobody is asked whose answer would be forgotten.
    pub(crate) fn asks_for_up(&self) -> bool {
        self.settings.up.is_none() && self.file.is_some()
    }

    /// Changes settings, and writes them down if they are others now. A file that cannot be written is no reason to stop:
    /// they count for this run only.
    pub(crate) fn change(&mut self, change: impl FnOnce(&mut Settings)) {
        let before = self.settings;
        change(&mut self.settings);
        let Some(file) = self.file.as_ref().filter(|_| self.settings != before) else { return };
        drop(file.parent().map(fs::create_dir_all));
        let text = serde_json::to_string_pretty(&self.settings).expect("numbers and truth values");
        drop(write_atomically(file, |writer| writer.write_all(text.as_bytes())));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_there_again_in_the_next_run() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = Some(folder.path().join("deep").join("editor.json"));
        let mut preferences = Preferences::load(file.clone());
        assert_eq!(preferences.get(), Settings::default(), "nothing yet");
        preferences.change(|settings| (settings.development, settings.text_scale) = (true, 1.25));
        assert_eq!(Preferences::load(file.clone()).get(), preferences.get(), "read again");
        let path = file.clone().expect("a path");
        fs::write(&path, "{ \"development\": true, \"of a later version\": 3 }").expect("written");
        let settings = Preferences::load(file.clone()).get();
        assert_eq!(settings, Settings { development: true, ..Settings::default() }, "what is known counts");
        fs::write(&path, "no JSON").expect("written");
        assert_eq!(Preferences::load(file).get(), Settings::default(), "the usual ones");
    }
}
