//! The extensions that objects of a document have, wherever they are: a file
//! may use one without declaring it.

use std::collections::BTreeSet;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

/// The names in all `extensions` objects of a document, `extras` apart.
pub(crate) fn extension_names(json: &[u8]) -> Result<BTreeSet<String>, serde_json::Error> {
    let mut names = BTreeSet::new();
    let mut deserializer = serde_json::Deserializer::from_slice(json);
    Search { names: &mut names, is_extensions: false }.deserialize(&mut deserializer)?;
    Ok(names)
}

/// Looks through one value. Its depth is bounded by the parser's own limit.
struct Search<'n> {
    names: &'n mut BTreeSet<String>,
    /// Whether the value is that of a key `extensions`.
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
        while let Some(key) = map.next_key::<String>()? {
            if key == "extras" {
                map.next_value::<IgnoredAny>()?;
                continue;
            }
            let is_extensions = key == "extensions" && !self.is_extensions;
            if self.is_extensions {
                self.names.insert(key);
            }
            map.next_value_seed(Search { names: self.names, is_extensions })?;
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
    fn names_are_found_at_any_depth_and_not_in_extras() {
        let json = br#"{"extensions": {"A": {"extensions": {"B": [{"extensions": {"C": null}}]}}},
            "nodes": [{"extensions": {"A": 1}, "extras": {"extensions": {"D": {}}}}],
            "name": "extensions", "extensionsUsed": ["E"]}"#;
        let names = extension_names(json).expect("JSON");
        assert_eq!(names.iter().map(String::as_str).collect::<Vec<_>>(), ["A", "B", "C"], "once each");
        extension_names(b"[").expect_err("not JSON");
    }
}
