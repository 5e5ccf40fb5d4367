//! The JSON of a glTF file: parsed by gltf::json without its validation (which panics on some
//! files), with node transforms read separately as f64.

use std::collections::BTreeSet;
use std::path::Path;

use gltf::json::Root;
use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;

use super::native::{Extras, MaterialExtras, NativeHeader, NodeExtras};
use super::preview::Preview;
use super::primitive::{ForeignAttribute, RawPrimitive, foreign_attributes};
use crate::error::{LoadError, LoadErrorKind, Location};

/// A parsed document.
pub(crate) struct Document {
    pub(crate) root: Root,
    /// The transforms of the nodes: gltf::json rounds them to f32.
    pub(crate) transforms: Vec<RawTransform>,
    /// The names of each mesh's morph targets, where the file has any: by
    /// convention in the mesh's `extras`.
    pub(crate) target_names: Vec<Vec<String>>,
    /// How many animation channels move something other than a node.
    pub(crate) foreign_channels: usize,
    /// How many numbers are beyond f32: 0 stands in their places.
    pub(crate) unbounded: usize,
    /// The attributes that are not read, in the order of the file.
    pub(crate) foreign_attributes: Vec<ForeignAttribute>,
    /// The extensions that any object of the document has.
    pub(crate) extensions: BTreeSet<String>,
    /// What a native file says of each mesh.
    pub(crate) native_meshes: Vec<Extras<NativeHeader>>,
    /// What it says of each material.
    pub(crate) native_materials: Vec<Extras<MaterialExtras>>,
}

/// A node's transform as the file has it. There may be millions: what few nodes have, or is large, is apart.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct RawTransform {
    pub(crate) matrix: Option<Box<[f64; 16]>>,
    pub(crate) translation: Option<[f64; 3]>,
    pub(crate) rotation: Option<[f64; 4]>,
    pub(crate) scale: Option<[f64; 3]>,
    /// What a native file says of it.
    #[serde(rename = "extras")]
    pub(crate) native: Extras<Box<NodeExtras>>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct RawDocument {
    nodes: Vec<RawTransform>,
    meshes: Vec<RawMesh>,
    materials: Vec<RawMaterial>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct RawMaterial {
    extras: Extras<MaterialExtras>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct RawMesh {
    /// Anything at all.
    extras: Option<Box<RawValue>>,
    primitives: Vec<RawPrimitive>,
}

impl RawMesh {
    fn target_names(&self) -> Vec<String> {
        #[derive(Deserialize)]
        struct Members {
            #[serde(default, rename = "targetNames")]
            names: Vec<Value>,
        }
        let members = self.extras.as_ref().and_then(|text| serde_json::from_str::<Members>(text.get()).ok());
        let names = members.map(|members| members.names).unwrap_or_default();
        names.into_iter().map(|name| name.as_str().unwrap_or_default().to_owned()).collect()
    }

    fn native(&self) -> Extras<NativeHeader> {
        let extras = self.extras.as_ref().and_then(|text| serde_json::from_str(text.get()).ok());
        extras.unwrap_or_default()
    }
}

/// Parses the JSON and checks that it is glTF 2.
pub(crate) fn parse_document(path: &Path, json: &[u8]) -> Result<Document, LoadError> {
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let preview: Preview = serde_json::from_slice(json).map_err(|error| json_error(path, &error))?;
    check_version(path, &preview)?;
    let Mended { root, foreign_channels, unbounded } = match serde_json::from_slice(json) {
        Ok(root) => Mended { root, foreign_channels: 0, unbounded: 0 },
        // The first error has the line; the second try has legal oddities mended.
        Err(error) => parse_mended(json).ok_or_else(|| json_error(path, &error))?,
    };
    // `extras` are first read as text. Bytes that are not UTF-8 can only be in strings.
    let text = String::from_utf8_lossy(json);
    let raw: RawDocument = serde_json::from_str(&text).map_err(|error| json_error(path, &error))?;
    let target_names = raw.meshes.iter().map(RawMesh::target_names).collect();
    let native_meshes = raw.meshes.iter().map(RawMesh::native).collect();
    let native_materials = raw.materials.into_iter().map(|material| material.extras).collect();
    let primitives = raw.meshes.into_iter().map(|mesh| mesh.primitives).collect();
    let foreign_attributes = foreign_attributes(primitives);
    let (transforms, extensions) = (raw.nodes, preview.extensions);
    Ok(Document {
        root,
        transforms,
        target_names,
        foreign_channels,
        unbounded,
        foreign_attributes,
        extensions,
        native_meshes,
        native_materials,
    })
}

fn json_error(path: &Path, error: &serde_json::Error) -> LoadError {
    let text = error.to_string();
    // The place is said once, at the front.
    let text = text.split(" at line ").next().unwrap_or_default();
    let what = format!("this is not the JSON of a glTF file: {text} (column {})", error.column());
    LoadError::malformed(path, what, "export the model again").at(Location::Line(error.line() as u64))
}

fn check_version(path: &Path, preview: &Preview) -> Result<(), LoadError> {
    let asset = preview.asset.as_ref();
    let Some(version) = asset.and_then(|asset| asset.version.as_deref()) else {
        return Err(LoadError::malformed(path, "asset.version is missing", "export the model as glTF 2.0"));
    };
    let needed = asset.and_then(|asset| asset.min_version.as_deref()).unwrap_or(version);
    let is_too_new = asset.is_some_and(|asset| asset.min_version.is_some()) && needed != "2.0";
    if version.split('.').next() != Some("2") || is_too_new {
        let what = format!("asset.version '{needed}' is not supported, only glTF 2.0 is");
        return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, "export the model as glTF 2.0"));
    }
    Ok(())
}

/// What [`parse_mended`] finds.
struct Mended {
    root: Root,
    /// As [`Document`] has them.
    foreign_channels: usize,
    unbounded: usize,
}

/// Parses once more without `extras` (which may be anything, where gltf::json
/// wants objects), with the lists that may be absent, without animation
/// channels that move no node, and with 0 for numbers that f32 cannot hold.
fn parse_mended(json: &[u8]) -> Option<Mended> {
    let mut value: Value = serde_json::from_slice(json).ok()?;
    let mut waiting = vec![&mut value];
    let mut unbounded = 0;
    while let Some(next) = waiting.pop() {
        match next {
            Value::Object(map) => {
                map.remove("extras");
                waiting.extend(map.values_mut());
            }
            Value::Array(list) => waiting.extend(list),
            Value::Number(number) if number.as_f64().is_some_and(|n| n.abs() > f64::from(f32::MAX)) => {
                *next = Value::from(0);
                unbounded += 1;
            }
            _ => {}
        }
    }
    for scene in value.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten() {
        scene.as_object_mut()?.entry("nodes").or_insert(Value::Array(Vec::new()));
    }
    let mut foreign_channels = 0;
    for animation in value.get_mut("animations").and_then(Value::as_array_mut).into_iter().flatten() {
        let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) else { continue };
        let before = channels.len();
        channels.retain(|channel| channel.pointer("/target/node").is_some());
        foreign_channels += before - channels.len();
    }
    // From bytes again: the code that reads a document from values would take as long to
    // compile as all that reads it from bytes.
    let mended = serde_json::to_vec(&value).ok()?;
    Some(Mended { root: serde_json::from_slice(&mended).ok()?, foreign_channels, unbounded })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(json: &str) -> Result<Document, LoadError> {
        parse_document(Path::new("a.gltf"), json.as_bytes())
    }

    #[test]
    fn transforms_keep_all_their_digits() {
        let document = parse(r#"{"asset":{"version":"2.0"},"nodes":[{"translation":[10000000.001,0.1,0]}]}"#)
            .expect("glTF");
        assert_eq!(document.transforms[0].translation, Some([10000000.001, 0.1, 0.0]), "f64");
    }

    #[test]
    fn legal_oddities_are_read() {
        parse(r#"{"asset":{"version":"2.1","extras":5},"scenes":[{"name":"empty"}],"extras":null}"#)
            .expect("legal");
    }

    #[test]
    fn other_versions_and_broken_json_are_named() {
        let message = |json: &str| parse(json).err().expect("an error").to_string();
        assert!(message(r#"{"asset":{"version":"1.0"},"meshes":{}}"#).contains("'1.0'"), "an old version");
        assert!(message(r#"{"asset":{"version":"2.1","minVersion":"2.1"}}"#).contains("'2.1'"), "too new");
        assert!(message("{}").contains("asset.version"), "no version");
        assert!(
            message("{\"asset\":{\"version\":\"2.0\"},\n\"nodes\":[{\"mesh\":-1}]}")
                .starts_with("a.gltf, line 2: "),
            "the line"
        );
        message("");
        message(&"[".repeat(100_000));
    }
}
