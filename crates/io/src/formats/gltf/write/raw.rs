//! JSON objects as text: a member that is not set keeps its place, its digits and its spaces.
//!
//! A parsed tree would sort the members and round the numbers of what trigon does not know.

use std::fmt;

use serde::de::{Deserializer, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};
use serde_json::value::{RawValue, to_raw_value};

/// An object whose members are texts.
#[derive(Clone, Debug, Default)]
pub(super) struct RawObject {
    members: Vec<(String, Box<RawValue>)>,
    is_changed: bool,
}

impl RawObject {
    /// The object in a text; an empty one if it is none.
    pub(super) fn parse(text: &str) -> Self {
        serde_json::from_str(text).unwrap_or_default()
    }

    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.members.iter().find(|(known, _)| known == name).map(|(_, value)| value.get())
    }

    /// A member that is an object; an empty one if it is none.
    pub(super) fn object(&self, name: &str) -> Self {
        self.get(name).map(Self::parse).unwrap_or_default()
    }

    /// A member that is a list of anything; an empty one if it is none.
    pub(super) fn list(&self, name: &str) -> Vec<Box<RawValue>> {
        self.get(name).and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default()
    }

    /// A member that is an index.
    pub(super) fn index(&self, name: &str) -> Option<usize> {
        self.get(name)?.parse().ok()
    }

    pub(super) fn set(&mut self, name: &str, value: &(impl Serialize + ?Sized)) {
        let value = raw(value);
        if self.get(name) == Some(value.get()) {
            return;
        }
        self.is_changed = true;
        match self.members.iter_mut().find(|(known, _)| known == name) {
            Some((_, old)) => *old = value,
            None => self.members.push((name.to_owned(), value)),
        }
    }

    /// Sets a member that is an object if it changed, or takes an empty one away.
    pub(super) fn set_object(&mut self, name: &str, value: &Self) {
        match value.is_empty() {
            true => self.remove(name),
            false if value.is_changed => self.set(name, value),
            false => {}
        }
    }

    pub(super) fn set_or_remove(&mut self, name: &str, value: Option<&impl Serialize>) {
        match value {
            Some(value) => self.set(name, value),
            None => self.remove(name),
        }
    }

    pub(super) fn remove(&mut self, name: &str) {
        let before = self.members.len();
        self.members.retain(|(known, _)| known != name);
        self.is_changed |= self.members.len() < before;
    }

    /// Whether it says something else than the text that it was read from.
    pub(super) fn is_changed(&self) -> bool {
        self.is_changed
    }

    pub(super) fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.members.iter().map(|(name, _)| name.as_str())
    }
}

/// The text of a value.
pub(super) fn raw(value: &(impl Serialize + ?Sized)) -> Box<RawValue> {
    to_raw_value(value).expect("it is made of numbers, texts, lists and maps by text")
}

impl Serialize for RawObject {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.members.len()))?;
        for (name, value) in &self.members {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for RawObject {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Members)
    }
}

struct Members;

impl<'de> Visitor<'de> for Members {
    type Value = RawObject;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RawObject, A::Error> {
        let mut object = RawObject::default();
        while let Some((name, value)) = map.next_entry::<String, Box<RawValue>>()? {
            // Of members with one name the last counts; a search in each would be quadratic.
            object.members.push((name, value));
        }
        let mut known = std::collections::HashSet::new();
        object.members.reverse();
        object.members.retain(|(name, _)| known.insert(name.clone()));
        object.members.reverse();
        Ok(object)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_set_stays_as_it_is_written() {
        let mut object = RawObject::parse(r#"{"z":1.000 ,"a":[ 1e-400],"m":{"é\u00e9" : 2}}"#);
        object.set("a", &[0.1f32, -0.0]);
        object.remove("m");
        object.set("b", "x");
        assert_eq!(raw(&object).get(), r#"{"z":1.000,"a":[0.1,-0.0],"b":"x"}"#, "in its order");
        assert_eq!(RawObject::parse(r#"{"a":1,"a":2}"#).get("a"), Some("2"), "the last counts");
    }
}
