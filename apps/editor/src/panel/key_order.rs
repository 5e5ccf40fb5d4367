//! The declaration order of a command's parameters: the most important first. The schema sorts them
//! by name, the text of a command does not.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use trigon_document::Command;

/// The keys of a JSON object in the order of its text, each with those of its own value.
#[derive(Debug, Default, PartialEq)]
pub(super) struct KeyOrder(Vec<(String, KeyOrder)>);

impl KeyOrder {
    /// Of a command's parameters.
    pub(super) fn of(command: &Command) -> Self {
        let text = serde_json::to_string(command).expect("commands have string keys");
        serde_json::from_str(&text).expect("it was just written")
    }

    /// The position of a key; missing keys come last.
    pub(super) fn place(&self, key: &str) -> usize {
        self.0.iter().position(|(name, _)| name == key).unwrap_or(usize::MAX)
    }

    /// The order within the value of a key.
    pub(super) fn within(&self, key: &str) -> &Self {
        static EMPTY: KeyOrder = KeyOrder(Vec::new());
        self.0.iter().find(|(name, _)| name == key).map_or(&EMPTY, |(_, order)| order)
    }
}

impl<'de> Deserialize<'de> for KeyOrder {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(KeyOrderVisitor)
    }
}

struct KeyOrderVisitor;

impl<'de> Visitor<'de> for KeyOrderVisitor {
    type Value = KeyOrder;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<KeyOrder, A::Error> {
        let mut keys = Vec::new();
        while let Some(entry) = map.next_entry()? {
            keys.push(entry);
        }
        Ok(KeyOrder(keys))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<KeyOrder, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(KeyOrder::default())
    }

    fn visit_bool<E>(self, _: bool) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_i64<E>(self, _: i64) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_u64<E>(self, _: u64) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_f64<E>(self, _: f64) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_str<E>(self, _: &str) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }

    fn visit_unit<E>(self) -> Result<KeyOrder, E> {
        Ok(KeyOrder::default())
    }
}

#[cfg(test)]
mod tests {
    use trigon_document::Bevel;

    use super::*;

    #[test]
    fn parameters_are_in_the_order_of_their_declaration() {
        let order = KeyOrder::of(&Bevel::default().into());
        assert!(order.place("width") < order.place("segments"), "the width is the first");
        assert!(order.place("segments") < order.place("clamp_overlap"), "not by the alphabet");
        assert_eq!(order.place("none"), usize::MAX, "there is no such key");
    }
}
