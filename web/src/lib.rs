//! Models in a browser: files in memory become a model, and a model becomes images. JavaScript (`web/page`) does the rest.
//!
//! A module is compiled for vectors of 128 bits or without; the page loads the one that the browser can run.

mod facts;
mod files;
mod measurement;
mod model;
mod refusal;

use wasm_bindgen::prelude::wasm_bindgen;

/// The SIMD level that images are drawn with: `scalar` or `simd128`.
#[wasm_bindgen(js_name = simdLevel)]
#[must_use]
pub fn simd_level() -> String {
    trigon_scene::SimdLevel::best().to_string()
}

/// The names of what faces can show, in the order of menus.
#[wasm_bindgen]
#[must_use]
pub fn displays() -> Vec<String> {
    trigon_scene::Display::ALL.map(|display| display.name().to_owned()).to_vec()
}

/// The file name extensions of models, without a dot.
#[wasm_bindgen]
#[must_use]
pub fn extensions() -> Vec<String> {
    files::extensions().map(str::to_owned).collect()
}
