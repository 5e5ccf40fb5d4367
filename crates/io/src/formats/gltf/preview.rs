//! What can be said about a document before it is parsed completely: its version, the extensions of its
//! objects, and whether its indices fit into 32 bits. `gltf::json` truncates larger indices, which would
//! refer to another object. One pass finds all this and stores nothing else. Extensions are listed here:
//! which are read, and the messages about the others.

use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;

use gltf::json::Root;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::packed::DRACO;
use super::{material_extensions, specular_glossiness, variants};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::warning::Warnings;

/// A first look at a document.
#[derive(Default)]
pub(crate) struct Preview {
    pub(crate) asset: Option<RawAsset>,
    /// The names in all `extensions` objects, declared or not; `extras` apart.
    pub(crate) extensions: BTreeSet<String>,
}

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(crate) struct RawAsset {
    pub(crate) version: Option<String>,
    pub(crate) min_version: Option<String>,
}

impl<'de> Deserialize<'de> for Preview {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Document;
        impl<'de> Visitor<'de> for Document {
            type Value = Preview;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a glTF document")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Preview, A::Error> {
                let mut preview = Preview::default();
                while let Some(key) = map.next_key_seed(KeyKind { keeps_names: false })? {
                    match key {
                        MemberKey::Asset => preview.asset = map.next_value()?,
                        key => search_value(&key, Inside::Anything, &mut preview.extensions, &mut map)?,
                    }
                }
                Ok(preview)
            }
        }
        deserializer.deserialize_map(Document)
    }
}

/// What a key says of its value.
enum MemberKey {
    Asset,
    Extensions,
    Extras,
    /// Of an index or a code, or of a list of them.
    Indices,
    /// Of an object, or a list of objects, whose values are indices.
    NamedIndices,
    /// Anything else; with its name in an object of extensions.
    Other(Option<String>),
}

/// The keys of indices and codes in glTF 2.0, section 5, and in the extensions that are drawn.
const INDICES: [&str; 30] = [
    "buffer",
    "bufferView",
    "camera",
    "children",
    "componentType",
    "index",
    "indices",
    "input",
    "inverseBindMatrices",
    "joints",
    "light",
    "magFilter",
    "mapping",
    "mappings",
    "material",
    "mesh",
    "minFilter",
    "mode",
    "node",
    "nodes",
    "output",
    "sampler",
    "scene",
    "skeleton",
    "skin",
    "source",
    "target",
    "variants",
    "wrapS",
    "wrapT",
];

/// Reads a key without keeping it, or as the name of an extension.
struct KeyKind {
    keeps_names: bool,
}

impl<'de> DeserializeSeed<'de> for KeyKind {
    type Value = MemberKey;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<MemberKey, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for KeyKind {
    type Value = MemberKey;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: Error>(self, key: &str) -> Result<MemberKey, E> {
        Ok(match key {
            name if self.keeps_names => MemberKey::Other(Some(name.to_owned())),
            "asset" => MemberKey::Asset,
            "extensions" => MemberKey::Extensions,
            "extras" => MemberKey::Extras,
            "attributes" | "targets" => MemberKey::NamedIndices,
            key if INDICES.contains(&key) => MemberKey::Indices,
            _ => MemberKey::Other(None),
        })
    }
}

/// Looks through the value of a key that is found in `object`.
fn search_value<'de, A: MapAccess<'de>>(
    key: &MemberKey,
    object: Inside,
    names: &mut BTreeSet<String>,
    map: &mut A,
) -> Result<(), A::Error> {
    let inside = match key {
        MemberKey::Extras => return map.next_value::<IgnoredAny>().map(|_| ()),
        MemberKey::Extensions => Inside::Extensions,
        MemberKey::Indices => Inside::Indices,
        MemberKey::NamedIndices => Inside::NamedIndices,
        // What an attribute is called does not matter.
        MemberKey::Asset | MemberKey::Other(_) if object == Inside::NamedIndices => Inside::Indices,
        MemberKey::Asset | MemberKey::Other(_) => Inside::Anything,
    };
    map.next_value_seed(Search { names, inside })
}

/// What a value is known to be by its key. The elements of a list are what the list is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Inside {
    Anything,
    /// An object whose keys are names of extensions.
    Extensions,
    Indices,
    NamedIndices,
}

/// Looks through one value. Its depth is bounded by the parser's own limit.
struct Search<'n> {
    names: &'n mut BTreeSet<String>,
    inside: Inside,
}

impl<'de> DeserializeSeed<'de> for Search<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Search<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let keeps_names = self.inside == Inside::Extensions;
        while let Some(mut key) = map.next_key_seed(KeyKind { keeps_names })? {
            if let MemberKey::Other(Some(name)) = &mut key {
                self.names.insert(std::mem::take(name));
            }
            search_value(&key, self.inside, self.names, &mut map)?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        while list.next_element_seed(Search { names: self.names, inside: self.inside })?.is_some() {}
        Ok(())
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<(), E> {
        if self.inside == Inside::Indices && number > u64::from(u32::MAX) {
            return Err(E::custom(format_args!("{number} is not a valid index: it needs more than 32 bits")));
        }
        Ok(())
    }

    fn visit_bool<E>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_f64<E>(self, _: f64) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E>(self, _: &str) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E>(self) -> Result<(), E> {
        Ok(())
    }
}

/// Read in full, beside those of materials that [`material_extensions`] lists.
const READ: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    DRACO,
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_unlit",
    specular_glossiness::NAME,
    variants::NAME,
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_transform",
];

/// Images in formats that are not read: the geometry is shown all the same,
/// with a fallback or a checkerboard on it.
const IMAGES: &[&str] = &[
    "KHR_texture_basisu",
    "KHR_texture_ktx",
    "EXT_texture_avif",
    "MSFT_texture_dds",
    "GOOGLE_texture_basis",
];

/// Data about the file that does not show, and what says itself what of it is
/// left out: a texture without an image, a channel that moves no node.
const INVISIBLE: &[&str] =
    &["KHR_xmp", "KHR_xmp_json_ld", "EXT_texture_procedurals", "KHR_animation_pointer"];

fn is_read(name: &str) -> bool {
    READ.contains(&name) || material_extensions::names().contains(&name)
}

/// Refuses a file that cannot be understood without an extension, and names
/// what else is not drawn. `found` are the extensions that the document has
/// objects of, declared or not.
pub(crate) fn check_extensions(
    path: &Path,
    root: &Root,
    found: &BTreeSet<String>,
    warnings: &mut Warnings,
) -> Result<(), LoadError> {
    let unread: Vec<&str> =
        root.extensions_required.iter().map(String::as_str).filter(|name| !is_read(name)).collect();
    let is_needless = |name: &&&str| IMAGES.contains(*name) || INVISIBLE.contains(*name);
    let missing: Vec<&str> = unread.iter().filter(|name| !is_needless(name)).copied().collect();
    if !missing.is_empty() {
        let what = format!("the file requires {}, which trigon does not read", missing.join(", "));
        return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, remedy(&missing)));
    }
    warn_of_required(root, &unread, warnings);
    let declared: BTreeSet<&str> = root.extensions_used.iter().map(String::as_str).collect();
    let undeclared = found.iter().map(String::as_str).filter(|name| !declared.contains(name));
    for name in root.extensions_used.iter().map(String::as_str).chain(undeclared) {
        if !is_read(name) && ![IMAGES, INVISIBLE].iter().any(|list| list.contains(&name)) {
            warnings.push(
                Location::Whole,
                format!("the extension {name} is not drawn"),
                "bake what it adds into the base colour or the mesh if it matters",
            );
        }
    }
    Ok(())
}

/// Says which required extensions the file is drawn without, whether or not
/// what it draws needs them, and which it requires without using them.
fn warn_of_required(root: &Root, unread: &[&str], warnings: &mut Warnings) {
    let of =
        |list: &[&str]| -> Vec<&str> { unread.iter().filter(|name| list.contains(name)).copied().collect() };
    let (images, invisible) = (of(IMAGES), of(INVISIBLE));
    if !images.is_empty() {
        let names = images.join(", ");
        let what =
            format!("the file requires {names}, which trigon does not support; such images are not drawn");
        warnings.push(Location::Whole, what, "export the model with PNG, JPEG or WebP images");
    }
    if !invisible.is_empty() {
        let names = invisible.join(", ");
        let what = format!("the file requires {names}, which trigon does not support; it is drawn without");
        warnings.push(Location::Whole, what, "export the model without it if something is missing");
    }
    for name in root.extensions_required.iter().filter(|name| !root.extensions_used.contains(name)) {
        let what = format!("the file requires {name}, which is missing in extensionsUsed");
        warnings.push(Location::Whole, what, "add it to extensionsUsed, or export the model again");
    }
}

fn remedy(missing: &[&str]) -> &'static str {
    let has = |part: &str| missing.iter().any(|name| name.contains(part));
    if has("materials") {
        "re-export with plain metallic-roughness materials"
    } else {
        "re-export without it"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_are_found_at_any_depth_and_not_in_extras() {
        let json = r#"{"extensions": {"A": {"extensions": {"B": [{"extensions": {"C": null}}]}}},
            "nodes": [{"extensions": {"A": 1}, "extras": {"extensions": {"D": {}}}}],
            "asset": {"version": "2.0"}, "name": "extensions", "extensionsUsed": ["E"]}"#;
        let preview: Preview = serde_json::from_str(json).expect("JSON");
        assert_eq!(preview.extensions.iter().collect::<Vec<_>>(), ["A", "B", "C"], "once each");
        assert_eq!(preview.asset.and_then(|asset| asset.version).as_deref(), Some("2.0"), "and the version");
    }

    #[test]
    fn indices_of_more_than_32_bits_are_refused_wherever_they_are() {
        let objects = [
            r#"{"scene": N}"#,
            r#"{"nodes": [{"children": [0, N]}]}"#,
            r#"{"accessors": [{"componentType": N}]}"#,
            r#"{"meshes": [{"primitives": [{"attributes": {"_ANY": N}}]}]}"#,
            r#"{"meshes": [{"primitives": [{"targets": [{}, {"POSITION": N}]}]}]}"#,
            r#"{"animations": [{"channels": [{"target": {"node": N}}]}]}"#,
            r#"{"nodes": [{"extensions": {"KHR_lights_punctual": {"light": N}}}]}"#,
        ];
        for object in objects {
            let read =
                |number: &str| serde_json::from_str::<Preview>(&object.replace('N', number)).map(|_| ());
            assert!(read("4294967295").is_ok(), "{object}: that fits");
            let error = read("4294967296").expect_err(object);
            assert!(error.to_string().starts_with("4294967296 is not a valid index"), "{object}: {error}");
        }
        for other in [r#"{"nodes": [{"translation": [N, 0, 0]}]}"#, r#"{"nodes": [{"extras": {"mesh": N}}]}"#]
        {
            let text = other.replace('N', "4294967296");
            assert!(serde_json::from_str::<Preview>(&text).is_ok(), "{other}: no index");
        }
    }

    #[test]
    fn what_is_no_document_is_refused() {
        for json in ["", "[", "[]", "5", "{\"a\": [}", "{\"asset\": 5}"] {
            assert!(serde_json::from_str::<Preview>(json).is_err(), "{json}");
        }
    }
}
