//! Truths on disk, by the hash of all that they follow from: the scene as rays see it, the size, and the code.

use std::fs;
use std::path::Path;

use super::Truth;
use super::world::{Texels, World};

/// The code that makes a truth: another one makes another.
const CODE: [&str; 5] = [
    include_str!("mod.rs"),
    include_str!("light.rs"),
    include_str!("samples.rs"),
    include_str!("tree.rs"),
    include_str!("world.rs"),
];

/// FNV-1a with 128 bits (G. Fowler, L. Noll and K.-P. Vo, 1991).
struct Hash(u128);

impl Hash {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u128::from(*byte)).wrapping_mul((1 << 88) + 0x13b);
        }
    }

    fn number(&mut self, number: f64) {
        self.bytes(&number.to_bits().to_le_bytes());
    }
}

/// The name of the file of a world's image.
pub(super) fn name(world: &World, size: [u32; 2]) -> String {
    let mut hash = Hash(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
    CODE.iter().for_each(|file| hash.bytes(file.as_bytes()));
    let World { triangles, looks, lamps, ambient, background, eye, effects, .. } = world;
    hash.bytes(format!("{size:?} {lamps:?} {ambient:?} {background:?} {eye:?} {effects:?}").as_bytes());
    for triangle in triangles {
        let vectors = triangle.corners.iter().chain(&triangle.normals).flat_map(|at| at.to_array());
        vectors.chain(triangle.uvs.iter().flat_map(|at| at.to_array())).for_each(|value| hash.number(value));
        hash.bytes(&triangle.look.to_le_bytes());
    }
    for look in looks {
        hash.bytes(format!("{:?}", look.material).as_bytes());
        let values = look.texture.iter().flat_map(Texels::values);
        values.flat_map(|value| value.to_array()).for_each(|value| hash.number(value));
    }
    format!("{:032x}", hash.0)
}

/// The image in a file, if it is whole.
pub(super) fn read(path: &Path, size: [u32; 2], square: u32) -> Option<Truth> {
    let pixels = super::known_pixels(size, square);
    let bytes = fs::read(path).ok()?;
    let (numbers, []) = bytes.as_chunks::<8>() else { return None };
    let (bound, light) = numbers.split_first()?;
    let number = |bytes: &[u8; 8]| f64::from_le_bytes(*bytes);
    let (light, []) = light.as_chunks::<3>() else { return None };
    let light: Vec<[f64; 3]> = light.iter().map(|pixel| pixel.each_ref().map(number)).collect();
    (light.len() == pixels.len()).then(|| Truth { size, square, pixels, light, bound: number(bound) })
}

/// Writes an image, whole or not at all; without success where the disk does not let it.
pub(super) fn write(path: &Path, truth: &Truth) {
    let numbers = std::iter::once(&truth.bound).chain(truth.light.as_flattened());
    let bytes: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
    let part = path.with_extension(format!("part{}", std::process::id()));
    let folder = path.parent().unwrap_or(Path::new("."));
    let written = fs::create_dir_all(folder).and_then(|()| fs::write(&part, bytes));
    if written.and_then(|()| fs::rename(&part, path)).is_err() {
        // It is computed again next time.
        let _ = fs::remove_file(&part);
    }
}
