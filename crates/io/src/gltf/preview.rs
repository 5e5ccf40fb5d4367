//! What can be said of a document before all of it is understood: its version,
//! and the extensions that its objects have. One pass that keeps nothing else.

use std::collections::BTreeSet;
use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

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
                        Key::Asset => preview.asset = map.next_value()?,
                        key => search_value(&key, &mut preview.extensions, &mut map)?,
                    }
                }
                Ok(preview)
            }
        }
        deserializer.deserialize_map(Document)
    }
}

/// What a key says of its value.
enum Key {
    Asset,
    Extensions,
    Extras,
    /// Anything else; with its name in an object of extensions.
    Other(Option<String>),
}

/// Reads a key without keeping it, or as the name of an extension.
struct KeyKind {
    keeps_names: bool,
}

impl<'de> DeserializeSeed<'de> for KeyKind {
    type Value = Key;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Key, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for KeyKind {
    type Value = Key;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: Error>(self, key: &str) -> Result<Key, E> {
        Ok(match key {
            name if self.keeps_names => Key::Other(Some(name.to_owned())),
            "asset" => Key::Asset,
            "extensions" => Key::Extensions,
            "extras" => Key::Extras,
            _ => Key::Other(None),
        })
    }
}

/// Looks for extensions in the value of a key.
fn search_value<'de, A: MapAccess<'de>>(
    key: &Key,
    names: &mut BTreeSet<String>,
    map: &mut A,
) -> Result<(), A::Error> {
    match key {
        Key::Extras => map.next_value::<IgnoredAny>().map(|_| ()),
        Key::Extensions => map.next_value_seed(Search { names, is_extensions: true }),
        Key::Asset | Key::Other(_) => map.next_value_seed(Search { names, is_extensions: false }),
    }
}

/// Looks through one value. Its depth is bounded by the parser's own limit.
struct Search<'n> {
    names: &'n mut BTreeSet<String>,
    /// Whether the keys of the value are names of extensions.
    is_extensions: bool,
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
        while let Some(mut key) = map.next_key_seed(KeyKind { keeps_names: self.is_extensions })? {
            if let Key::Other(Some(name)) = &mut key {
                self.names.insert(std::mem::take(name));
            }
            search_value(&key, self.names, &mut map)?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        while list.next_element_seed(Search { names: self.names, is_extensions: false })?.is_some() {}
        Ok(())
    }

    fn visit_bool<E>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E>(self, _: u64) -> Result<(), E> {
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
    fn what_is_no_document_is_refused() {
        for json in ["", "[", "[]", "5", "{\"a\": [}", "{\"asset\": 5}"] {
            assert!(serde_json::from_str::<Preview>(json).is_err(), "{json}");
        }
    }
}
