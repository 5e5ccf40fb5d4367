//! Imports through the public face: one module per subject.

mod accessors;
mod capture;
mod captures;
mod cases;
mod draco;
mod export;
mod features;
mod files;
mod gltf;
mod gltf_crate;
mod gltf_oracle;
mod hooks;
mod hostile;
mod material;
mod movement;
mod obj;
mod off;
mod oracle;
mod ply;
mod saving;
mod seen_cases;
mod shading_models;
mod source;
mod statements;
mod stl;
mod texture;
mod three_mf;
mod tobj_crate;
mod unneeded;
mod up;
mod validator;
mod wires;

use trigon_io::{LoadOptions, Loaded, load_from_slice};
use trigon_mesh::Mesh;

/// Loads from memory what must load.
fn loaded(name: &str, bytes: &[u8]) -> Loaded {
    load_from_slice(name, bytes, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// The message of what must not load.
fn refused(name: &str, bytes: &[u8]) -> String {
    let error =
        load_from_slice(name, bytes, &LoadOptions::default()).map(|_| ()).expect_err("it must not load");
    let message = error.to_string();
    assert!(message.starts_with(name), "{message:?} names the file");
    assert!(!message.contains('\n'), "{message:?} is one line");
    message
}

/// The meshes of a model, in order.
fn meshes(loaded: &Loaded) -> Vec<&Mesh> {
    loaded.scene.meshes().iter().map(|(_, asset)| asset.mesh()).collect()
}

/// The warnings as people see them.
fn warnings(loaded: &Loaded) -> Vec<String> {
    loaded.warnings.iter().map(ToString::to_string).collect()
}

/// Asserts that exactly one warning has a word in it.
fn warns_once(loaded: &Loaded, word: &str) {
    let all = warnings(loaded);
    assert_eq!(all.iter().filter(|warning| warning.contains(word)).count(), 1, "one {word:?} in {all:#?}");
}
