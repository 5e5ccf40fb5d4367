//! Streams of Google's encoder, against what Google's decoder makes of them and against the formulas of
//! the models; streams made by hand; and broken ones.

use std::path::{Path, PathBuf};

use trigon_math::elementary::{cos_f32, sin_f32};

use super::*;
use crate::formats::gltf::triangle_hash::xxh64;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/draco")
}

/// A stream, and what its name does not say: points, triangles and the hash of everything.
struct Fixture {
    name: String,
    bytes: Vec<u8>,
    points: usize,
    triangles: usize,
    hash: String,
}

fn fixtures() -> Vec<Fixture> {
    let oracle = std::fs::read_to_string(folder().join("oracle.txt")).expect("it is there");
    let read = |line: &str| {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |word: &str| word.parse().expect("a number");
        Fixture {
            name: words[0].to_owned(),
            bytes: std::fs::read(folder().join(words[0]).with_extension("drc")).expect("it is there"),
            points: number(words[1]),
            triangles: number(words[2]),
            hash: words[3].to_owned(),
        }
    };
    let all: Vec<Fixture> = oracle.lines().map(read).collect();
    assert!(all.len() > 50, "there are streams of every kind");
    all
}

fn decoded(bytes: &[u8]) -> Result<DecodedMesh, Failure> {
    let mut budget = Budget::default();
    budget.allow(bytes.len());
    decode(bytes, &mut budget)
}

/// Everything in a mesh: counts, triangles, and each attribute by its number with its type.
fn dump(mesh: &DecodedMesh) -> Vec<u8> {
    let mut words = vec![mesh.points as u32, mesh.triangles.len() as u32 / 3];
    words.extend(&mesh.triangles);
    words.push(mesh.attributes.len() as u32);
    let mut bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let mut attributes: Vec<&DecodedAttribute> = mesh.attributes.iter().collect();
    attributes.sort_by_key(|attribute| attribute.id);
    for DecodedAttribute { id, values } in attributes {
        let words = [*id, values.component.as_gl_enum(), values.components as u32, values.bytes.len() as u32];
        bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        bytes.extend(&values.bytes);
    }
    bytes
}

#[test]
fn streams_decode_to_the_bytes_of_googles_decoder() {
    for Fixture { name, bytes, points, triangles, hash } in fixtures() {
        let mesh = decoded(&bytes).unwrap_or_else(|failure| panic!("{name}: {failure:?}"));
        assert_eq!((mesh.points, mesh.triangles.len() / 3), (points, triangles), "{name}");
        assert_eq!(format!("{:016x}", xxh64(&dump(&mesh))), hash, "{name}");
    }
}

/// The values of an attribute as floating point, by its number.
fn floats<const N: usize>(mesh: &DecodedMesh, id: u32) -> Vec<[f32; N]> {
    let attribute = mesh.attributes.iter().find(|attribute| attribute.id == id).expect("it has it");
    assert_eq!(attribute.values.components, N, "attribute {id}");
    let bytes = attribute.values.bytes.as_chunks::<4>().0;
    bytes.as_chunks::<N>().0.iter().map(|value| value.map(f32::from_le_bytes)).collect()
}

/// The model `holes` is z = 0.3 · sin 9u · cos 7v over x = 3u and y = 2v, and every second quad is
/// cut along the same diagonal: texture coordinates tell where a point is.
#[test]
fn points_are_where_the_formula_of_the_model_has_them() {
    let names = |fixture: &Fixture| {
        let parts: Vec<&str> = fixture.name.split('-').collect();
        parts[0] == "holes" && parts[3].contains('u')
    };
    let found: Vec<Fixture> = fixtures().into_iter().filter(names).collect();
    assert!(found.len() > 2, "there are some");
    for Fixture { name, bytes, .. } in found {
        let mesh = decoded(&bytes).expect("it is sound");
        let normals = u32::from(name.contains("-n"));
        let (positions, uvs) = (floats::<3>(&mesh, 0), floats::<2>(&mesh, 1 + normals));
        // The coarsest precision is 5 bits for positions of a range of 3, and 4 bits for coordinates.
        let (step, uv_step) = if name.ends_with("-3") { (3.0 / 31.0, 1.0 / 15.0) } else { (3e-3, 2e-3) };
        for (position, [u, v]) in positions.iter().zip(&uvs) {
            let expected = [3.0 * u, 2.0 * v, 0.3 * sin_f32(9.0 * u) * cos_f32(7.0 * v)];
            for (found, expected) in position.iter().zip(expected) {
                assert!((found - expected).abs() <= step + 3.0 * uv_step, "{name}: {position:?} at {u}, {v}");
            }
        }
        for corners in mesh.triangles.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|point| positions[point as usize]);
            let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            assert!(twice > 0.0 || name.ends_with("-3"), "{name}: every triangle faces up");
        }
    }
}

/// A stream with 2²⁸ triangles in twenty bytes: all indices are the same symbol.
#[test]
fn claims_beyond_all_reason_are_refused_before_memory_is_taken() {
    let mut bytes = b"DRACO\x02\x02\x01\x00\x00\x00".to_vec();
    bytes.extend([0x80, 0x80, 0x80, 0x80, 0x01]); // triangles
    bytes.extend([3, 0]); // points, compressed indices
    bytes.extend([1, 1, 1, 0x01, 0x40, 1, 0]); // raw symbols of one bit, of which all are the first
    assert_eq!(decoded(&bytes).err(), Some(Failure::TooLarge), "too many");
}

#[test]
fn one_budget_serves_all_meshes_of_a_file() {
    let Fixture { bytes, .. } = fixtures().swap_remove(0);
    let mut budget = Budget::default();
    budget.allow(0);
    let last = (0..10_000_000).find_map(|_| decode(&bytes, &mut budget).err());
    assert_eq!(last, Some(Failure::TooLarge), "it is used up");
}

#[test]
fn other_versions_and_kinds_are_foreign() {
    let Fixture { bytes, .. } = fixtures().swap_remove(0);
    for (location, value) in [(5, 1), (6, 1), (6, 3), (7, 0), (8, 2)] {
        let mut other = bytes.clone();
        other[location] = value;
        assert!(matches!(decoded(&other), Err(Failure::Foreign(_))), "byte {location} is {value}");
    }
    assert!(matches!(decoded(b"DRACA"), Err(Failure::Broken(_))), "no stream");
    assert!(matches!(decoded(b""), Err(Failure::Broken(_))), "nothing");
}

/// Metadata of an attribute and of the file, with an element in an element.
#[test]
fn metadata_is_passed_over() {
    for Fixture { name, bytes, .. } in fixtures() {
        let mut with = bytes[..9].to_vec();
        with.extend((1_u16 << 15).to_le_bytes());
        with.extend([1, 0]); // of one attribute: number 0
        with.extend(*b"\x01\x03key\x02ab\x00"); // one entry, no elements
        with.extend(*b"\x00\x02"); // of the file: no entries, two elements
        with.extend(*b"\x03sub\x01\x01k\x01v\x01\x05inner\x00\x00");
        with.extend(*b"\x04last\x00\x00");
        with.extend(&bytes[11..]);
        let (plain, with) = (decoded(&bytes).expect("sound"), decoded(&with).expect("sound"));
        assert!(dump(&plain) == dump(&with), "{name}");
    }
}

/// Deterministic changes: single bytes and bits, copies, and ends that are missing.
struct Mutations(u64);

impl Mutations {
    fn next(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 as usize % below.max(1)
    }

    fn of(&mut self, bytes: &[u8]) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        for _ in 0..1 + self.next(4) {
            let length = bytes.len();
            let (at, other) = (self.next(length), self.next(length));
            match self.next(5) {
                0 => bytes[at] = self.next(256) as u8,
                1 => bytes[at] ^= 1 << self.next(8),
                // Most counts are at the front.
                2 => bytes[at % 80.min(length)] = self.next(256) as u8,
                3 => bytes[at] = bytes[other],
                _ => bytes.truncate(at + 1),
            }
        }
        bytes
    }
}

#[test]
fn changed_streams_are_meshes_or_errors() {
    let mut mutations = Mutations(0x2545_f491_4f6c_dd1d);
    let (mut sound, mut broken) = (0, 0);
    for Fixture { bytes, .. } in fixtures() {
        for _ in 0..150 {
            match decoded(&mutations.of(&bytes)) {
                Ok(mesh) => {
                    sound += 1;
                    assert!(mesh.triangles.iter().all(|&point| (point as usize) < mesh.points), "points");
                    for DecodedAttribute { values, .. } in &mesh.attributes {
                        let size = values.component.size() * values.components;
                        assert_eq!(values.bytes.len(), size * mesh.points, "one value for each");
                    }
                }
                Err(_) => broken += 1,
            }
        }
    }
    assert!(sound > 500 && broken > 500, "{sound} meshes, {broken} errors: both are tried");
}

#[test]
fn every_beginning_of_a_stream_is_an_error() {
    for Fixture { name, bytes, .. } in fixtures() {
        for length in (0..bytes.len()).step_by(1 + bytes.len() / 200) {
            assert!(decoded(&bytes[..length]).is_err(), "{name} up to byte {length}");
        }
    }
}
