//! The files of a model, by their paths.

use std::collections::BTreeMap;
use std::path::Path;

use wasm_bindgen::prelude::wasm_bindgen;

/// Files in memory.
#[wasm_bindgen]
#[derive(Default)]
pub struct Files {
    pub(crate) by_path: BTreeMap<String, Vec<u8>>,
}

#[wasm_bindgen]
impl Files {
    /// None yet.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file. Paths start at a common folder, and have `/` between names.
    pub fn add(&mut self, path: String, bytes: Vec<u8>) {
        self.by_path.insert(path, bytes);
    }

    /// The paths of those that have the name of a model, from the top of the folder downwards.
    #[must_use]
    pub fn models(&self) -> Vec<String> {
        let mut models: Vec<String> = self.by_path.keys().filter(|path| is_model(path)).cloned().collect();
        models.sort_by_key(|path| path.matches('/').count());
        models
    }
}

/// The endings of models' names.
pub(crate) fn extensions() -> impl Iterator<Item = &'static str> {
    trigon_io::readers().flat_map(|reader| reader.extensions.iter().copied())
}

fn is_model(path: &str) -> bool {
    let ending = Path::new(path).extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    extensions().any(|extension| extension.eq_ignore_ascii_case(ending))
}
