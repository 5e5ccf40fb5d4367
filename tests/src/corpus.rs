//! The importers against files that are hard to load: each does what
//! `tests/corpus/expected.txt` says, and no mutation of any makes them panic.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use proptest::prelude::*;
use trigon_io::{LoadOptions, Loaded, load, load_from_slice};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus")
}

/// The models in the folder, by their path below it.
fn models() -> Vec<String> {
    let is_model = |path: &Path| {
        path.extension().is_some_and(|ending| {
            ["obj", "gltf", "glb", "ply", "stl", "off", "3mf"].iter().any(|known| ending == *known)
        })
    };
    let mut models = Vec::new();
    for sub in std::fs::read_dir(folder())
        .expect("the corpus folder")
        .flatten()
        .filter(|entry| entry.path().is_dir())
    {
        for file in
            std::fs::read_dir(sub.path()).expect("a folder").flatten().filter(|entry| is_model(&entry.path()))
        {
            models.push(format!(
                "{}/{}",
                sub.file_name().to_string_lossy(),
                file.file_name().to_string_lossy()
            ));
        }
    }
    models.sort();
    assert!(models.len() > 60, "the corpus is there: {} models", models.len());
    models
}

#[test]
fn every_file_does_what_is_expected() {
    let expected = std::fs::read_to_string(folder().join("expected.txt")).expect("the expectations");
    let rows: Vec<Vec<&str>> = expected
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split_whitespace().collect())
        .collect();
    let listed: BTreeSet<&str> = rows.iter().map(|row| row[1]).collect();
    let found = models();
    assert_eq!(
        listed,
        found.iter().map(String::as_str).collect(),
        "every model has a row, and every row a model"
    );
    for row in rows {
        check(row[0], row[1], &row[2..].join(" "));
    }
}

fn check(outcome: &str, model: &str, words: &str) {
    let result = load(folder().join(model), &LoadOptions::default());
    match (outcome, result) {
        ("refused", Err(error)) => {
            let message = error.to_string();
            let name = model.rsplit('/').next().expect("a name");
            assert!(
                message.contains(name) && message.contains(words) && !message.contains('\n'),
                "{model}: {message}"
            );
        }
        ("warned", Ok(loaded)) => {
            let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
            assert!(
                warnings.iter().any(|warning| warning.contains(words)),
                "{model} says {words:?}: {warnings:#?}"
            );
            check_scene(model, &loaded);
        }
        ("clean", Ok(loaded)) => {
            assert!(loaded.warnings.is_empty(), "{model}: {:#?}", loaded.warnings);
            check_scene(model, &loaded);
        }
        (_, Err(error)) => panic!("{model} should be {outcome}: {error}"),
        (_, Ok(loaded)) => panic!("{model} should be {outcome}; it has {} warnings", loaded.warnings.len()),
    }
}

/// What holds for every scene that was loaded, whatever the file.
fn check_scene(model: &str, loaded: &Loaded) {
    for (_, asset) in loaded.scene.meshes().iter() {
        let mesh = asset.mesh();
        let count = mesh.vertex_count();
        assert!(
            mesh.positions().iter().all(|position| position.is_finite()),
            "{model}: positions are finite"
        );
        for face in 0..mesh.face_count() {
            let corners = mesh.face_vertices(face);
            assert!(
                corners.len() >= 3 && corners.iter().all(|&vertex| (vertex as usize) < count),
                "{model}: face {face}"
            );
        }
    }
    for (_, node) in loaded.scene.nodes().iter() {
        assert!(
            node.mesh.is_none_or(|mesh| loaded.scene.meshes().get(mesh).is_some()),
            "{model}: meshes exist"
        );
        assert!(
            node.materials.iter().all(|&material| loaded.scene.materials.get(material).is_some()),
            "{model}: materials exist"
        );
    }
    for (_, material) in loaded.scene.materials.iter() {
        let texture = material.base_color_texture.map(|binding| binding.texture);
        assert!(
            texture.is_none_or(|texture| loaded.scene.textures.get(texture).is_some()),
            "{model}: textures exist"
        );
    }
}

/// The bytes of all models.
fn seeds() -> &'static [(String, Vec<u8>)] {
    static SEEDS: OnceLock<Vec<(String, Vec<u8>)>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let read = |model: String| {
            let bytes = std::fs::read(folder().join(&model)).expect("a file");
            (model, bytes)
        };
        models().into_iter().map(read).collect()
    })
}

/// A small damage to a file.
#[derive(Clone, Debug)]
enum Mutation {
    Flip(usize, u8),
    Set(usize, u8),
    Cut(usize),
    Remove(usize, usize),
    Repeat(usize, usize),
    Digit(usize, u8),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    prop_oneof![
        (any::<usize>(), 0..8u8).prop_map(|(at, bit)| Mutation::Flip(at, bit)),
        (any::<usize>(), prop::sample::select(vec![0, 0xff, 0x7f, 0x80, b' ', b'\n', b'/', b'-']))
            .prop_map(|(at, value)| Mutation::Set(at, value)),
        any::<usize>().prop_map(Mutation::Cut),
        (any::<usize>(), 1..16usize).prop_map(|(at, length)| Mutation::Remove(at, length)),
        (any::<usize>(), 1..64usize).prop_map(|(at, length)| Mutation::Repeat(at, length)),
        (any::<usize>(), b'0'..=b'9').prop_map(|(at, digit)| Mutation::Digit(at, digit)),
    ]
}

fn mutate(bytes: &mut Vec<u8>, mutation: &Mutation) {
    let length = bytes.len().max(1);
    match *mutation {
        _ if bytes.is_empty() => bytes.push(b'v'),
        Mutation::Flip(at, bit) => bytes[at % length] ^= 1 << bit,
        Mutation::Set(at, value) => bytes[at % length] = value,
        Mutation::Cut(at) => bytes.truncate(at % length),
        Mutation::Remove(at, count) => drop(bytes.drain(at % length..(at % length + count).min(length))),
        Mutation::Repeat(at, count) => {
            let piece = bytes[at % length..(at % length + count).min(length)].to_vec();
            let at = at % length;
            bytes.splice(at..at, piece);
        }
        // The next digit becomes another: indices, counts and offsets change.
        Mutation::Digit(at, digit) => {
            if let Some(found) = bytes.iter().skip(at % length).position(u8::is_ascii_digit) {
                bytes[at % length + found] = digit;
            }
        }
    }
}

proptest! {
    #![proptest_config(crate::effort::cases(2000))]

    #[test]
    fn no_mutation_makes_a_loader_panic(seed in any::<prop::sample::Index>(), mutations in prop::collection::vec(mutation(), 1..6)) {
        let (model, original) = seed.get(seeds());
        let mut bytes = original.clone();
        mutations.iter().for_each(|mutation| mutate(&mut bytes, mutation));
        match load_from_slice(model, &bytes, &LoadOptions::default()) {
            Ok(loaded) => check_scene(model, &loaded),
            Err(error) => prop_assert!(!error.to_string().contains('\n'), "one line: {error}"),
        }
    }
}
