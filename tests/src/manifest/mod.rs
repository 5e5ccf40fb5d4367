//! The same bytes everywhere: what small images of every feature hash to, in a
//! file that all machines share. Checked at every SIMD level of the machine, with
//! 1, 2 and 3 threads. `TRIGON_UPDATE_MANIFEST=1` writes the file anew: a change
//! of it is a change of what users see.

mod cases;
mod hash;
mod layouts;
mod scenes;

use crate::coverage_support::{levels, rasterizer};
use cases::all;
use hash::{fnv1a, hash, hash_frame};
use std::collections::BTreeMap;
use std::fs;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use trigon_raster::ExecuteSettings;

const HEADER: &str = "\
# What the pictures of tests/src/manifest hash to (FNV-1a, 64 bits, over all outputs, little-endian).
# Written by TRIGON_UPDATE_MANIFEST=1 cargo test -p trigon-tests manifest
";

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("manifest/pictures.txt")
}

/// The hashes by name.
fn read() -> BTreeMap<String, String> {
    let text = fs::read_to_string(path()).expect("the manifest is there");
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let pairs = lines.map(|line| line.split_once(' ').expect("a hash and a name"));
    pairs.map(|(hash, name)| (name.to_owned(), hash.to_owned())).collect()
}

fn write(hashes: &BTreeMap<String, String>) {
    let lines: String = hashes.iter().map(|(name, hash)| format!("{hash} {name}\n")).collect();
    fs::create_dir_all(path().with_file_name("")).expect("the tests' folder is writable");
    fs::write(path(), format!("{HEADER}{lines}")).expect("the tests' folder is writable");
}

/// Everything that must not change a byte.
fn every_setting() -> impl Iterator<Item = ExecuteSettings> {
    levels().flat_map(|level| {
        [1, 2, 3].map(|threads| ExecuteSettings {
            threads: NonZeroUsize::new(threads),
            simd: Some(level),
            ..ExecuteSettings::default()
        })
    })
}

#[test]
fn every_image_hashes_to_what_the_manifest_says() {
    let images = all();
    let by_name = |settings: &ExecuteSettings| -> BTreeMap<String, String> {
        let mut rasterizer = rasterizer(settings);
        let passes = images.iter().map(|image| (image.name(), hash(&image.draw(&mut rasterizer))));
        let scenes = scenes::images(settings).map(|frame| hash_frame(&frame));
        passes.chain(scenes::NAMES.map(str::to_owned).into_iter().zip(scenes)).collect()
    };
    if std::env::var_os("TRIGON_UPDATE_MANIFEST").is_some() {
        write(&by_name(&ExecuteSettings::default()));
    }
    let expected = read();
    assert_eq!(expected.len(), images.len() + scenes::NAMES.len(), "a line for each image");
    let mut wrong = Vec::new();
    for settings in every_setting() {
        for (name, hash) in by_name(&settings) {
            if expected.get(&name) != Some(&hash) {
                wrong.push(format!("{name} at {:?} with {:?} threads", settings.simd, settings.threads));
            }
        }
    }
    assert!(wrong.is_empty(), "{} images differ:\n{}", wrong.len(), wrong.join("\n"));
}

/// Else the manifest would hold nothing.
#[test]
fn every_image_shows_something_of_its_own() {
    let mut rasterizer = rasterizer(&ExecuteSettings::default());
    let mut seen = BTreeMap::new();
    for image in all().into_iter().filter(|image| !image.is_scalar()) {
        let other = seen.insert(hash(&image.draw(&mut rasterizer)), image.name());
        assert_eq!(other, None, "{} is the same", image.name());
        assert!(image.is_worth_drawing(&mut rasterizer), "{} is empty", image.name());
    }
    for (name, frame) in scenes::NAMES.into_iter().zip(scenes::images(&ExecuteSettings::default())) {
        let other = seen.insert(hash_frame(&frame), name.to_owned());
        assert_eq!(other, None, "{name} is the same");
    }
}

#[test]
fn the_hash_is_fnv_1a() {
    assert_eq!(fnv1a(*b""), 0xcbf2_9ce4_8422_2325, "the offset basis");
    assert_eq!(fnv1a(*b"foobar"), 0x8594_4171_f739_67e8, "from the authors' test vectors");
}
