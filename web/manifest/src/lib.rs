//! The pictures of `tests/manifest` as a WebAssembly module draws them. Their source is that of the tests.

#[path = "../../../tests/src/manifest"]
mod manifest {
    #[expect(dead_code, reason = "tests ask more of the pictures")]
    mod cases;
    mod hash;
    mod layouts;
    mod scenes;

    use trigon_raster::{ExecuteSettings, Rasterizer};

    /// The lines of the manifest: a hash and a name each.
    pub(super) fn lines() -> Vec<String> {
        let settings = ExecuteSettings::default();
        let mut rasterizer = Rasterizer::new(settings).expect("the best level");
        let passes =
            cases::all().into_iter().map(|case| (hash::hash(&case.draw(&mut rasterizer)), case.name()));
        let frames = scenes::images(&settings).map(|frame| hash::hash_frame(&frame));
        let frames = frames.zip(scenes::NAMES.map(str::to_owned));
        passes.chain(frames).map(|(hash, name)| format!("{hash} {name}")).collect()
    }
}
#[expect(dead_code, reason = "tests draw with more programs")]
#[path = "../../../tests/src/programs.rs"]
mod programs;
#[path = "../../../tests/src/random.rs"]
mod random;
#[path = "../../../tests/src/samples.rs"]
mod samples;

use wasm_bindgen::prelude::wasm_bindgen;

/// The lines of the manifest: a hash and a name each.
#[wasm_bindgen]
#[must_use]
pub fn lines() -> Vec<String> {
    manifest::lines()
}
