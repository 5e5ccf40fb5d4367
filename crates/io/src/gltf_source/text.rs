//! The JSON text of a file, and finding parts of it without building a tree.
//!
//! A parsed tree would round numbers, and would take many times the memory of the text. A part of
//! the text is exact at any depth: the parser skips everything else, without recursion.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

/// The top-level lists of a glTF file: their items are found without reading the file again.
const LISTS: &[&str] = &[
    "accessors",
    "animations",
    "bufferViews",
    "buffers",
    "cameras",
    "images",
    "materials",
    "meshes",
    "nodes",
    "samplers",
    "scenes",
    "skins",
    "textures",
];

/// The positions of each list's items in the text.
type Lists = BTreeMap<&'static str, Vec<Range<usize>>>;

/// The text, and the start and end of the items of its lists.
pub(crate) struct JsonText {
    text: Box<str>,
    lists: Lists,
}

impl JsonText {
    /// Finds the lists of a document.
    pub(crate) fn new(text: &str) -> serde_json::Result<Self> {
        let lists = serde_json::Deserializer::from_str(text).deserialize_map(FindLists(text))?;
        Ok(Self { text: text.into(), lists })
    }

    pub(super) fn whole(&self) -> &str {
        &self.text
    }

    /// The target of a JSON pointer.
    pub(super) fn at(&self, pointer: &str) -> Option<&str> {
        let mut steps = match pointer.strip_prefix('/') {
            Some(steps) => steps.split('/').map(unescape).collect::<Vec<_>>().into_iter(),
            None if pointer.is_empty() => return Some(&self.text),
            None => return None,
        };
        let mut part: &str = &self.text;
        if let [list, item, ..] = steps.as_slice()
            && let Some(items) = self.lists.get(list.as_str())
        {
            part = &self.text[items.get(parse_index(item)?)?.clone()];
            steps.nth(1);
        }
        steps.try_fold(part, |part, step| child(part, &step))
    }
}

/// A step of a pointer: `~1` stands for a slash, `~0` for a tilde.
fn unescape(step: &str) -> String {
    step.replace("~1", "/").replace("~0", "~")
}

/// An index as in RFC 6901: digits without leading zeros.
fn parse_index(step: &str) -> Option<usize> {
    let is_plain = step.bytes().all(|byte| byte.is_ascii_digit()) && (step == "0" || !step.starts_with('0'));
    step.parse().ok().filter(|_| is_plain)
}

/// The member of an object, or the item of a list.
fn child<'t>(text: &'t str, step: &str) -> Option<&'t str> {
    let mut parser = serde_json::Deserializer::from_str(text);
    Some(FindChild(step).deserialize(&mut parser).ok()??.get())
}

/// Looks for one child, skipping the others.
struct FindChild<'s>(&'s str);

impl<'t> DeserializeSeed<'t> for FindChild<'_> {
    type Value = Option<&'t RawValue>;

    fn deserialize<D: Deserializer<'t>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'t> Visitor<'t> for FindChild<'_> {
    type Value = Option<&'t RawValue>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object or a list")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut members: A) -> Result<Self::Value, A::Error> {
        let mut found = None;
        while let Some(name) = members.next_key::<String>()? {
            if name == self.0 {
                found = Some(members.next_value()?);
            } else {
                members.next_value::<IgnoredAny>()?;
            }
        }
        Ok(found)
    }

    fn visit_seq<A: SeqAccess<'t>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let Some(mut before) = parse_index(self.0) else {
            while items.next_element::<IgnoredAny>()?.is_some() {}
            return Ok(None);
        };
        while before > 0 && items.next_element::<IgnoredAny>()?.is_some() {
            before -= 1;
        }
        let found = items.next_element()?;
        while items.next_element::<IgnoredAny>()?.is_some() {}
        Ok(found)
    }
}

/// Records the positions of the lists' items.
struct FindLists<'t>(&'t str);

impl<'t> Visitor<'t> for FindLists<'t> {
    type Value = Lists;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the object of a glTF file")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut members: A) -> Result<Lists, A::Error> {
        let mut lists = Lists::new();
        while let Some(name) = members.next_key::<String>()? {
            let Some(&list) = LISTS.iter().find(|&&list| list == name) else {
                members.next_value::<IgnoredAny>()?;
                continue;
            };
            let items: Vec<&RawValue> = members.next_value()?;
            lists.insert(list, items.into_iter().map(|item| self.range_of(item)).collect());
        }
        Ok(lists)
    }
}

impl FindLists<'_> {
    /// The start and end of an item borrowed from the text.
    fn range_of(&self, item: &RawValue) -> Range<usize> {
        let start = item.get().as_ptr().addr() - self.0.as_ptr().addr();
        start..start + item.get().len()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::Value;

    use super::*;

    fn text(json: &str) -> JsonText {
        JsonText::new(json).expect("JSON")
    }

    #[test]
    fn parts_are_as_they_are_written() {
        let text = text(
            r#" {"nodes":[ {"b" : 1e-400 , "a":[ 1.000 ,"é\u00e9"]}, 3], "x":{"/~": 123456789012345678901234567890}} "#,
        );
        for (pointer, part) in [
            ("/nodes/0", Some(r#"{"b" : 1e-400 , "a":[ 1.000 ,"é\u00e9"]}"#)),
            ("/nodes/0/b", Some("1e-400")),
            ("/nodes/0/a/0", Some("1.000")),
            ("/nodes/0/a/1", Some(r#""é\u00e9""#)),
            ("/nodes/1", Some("3")),
            ("/x/~1~0", Some("123456789012345678901234567890")),
            ("/nodes/2", None),
            ("/nodes/00", None),
            ("/nodes/+0", None),
            ("/nodes/-", None),
            ("/nodes/0/a/2", None),
            ("/nodes/0/a/0/0", None),
            ("/y", None),
            ("nodes", None),
        ] {
            assert_eq!(text.at(pointer), part, "{pointer}");
        }
        assert_eq!(text.at(""), Some(text.whole()), "everything");
        assert_eq!(text.at("/nodes").map(str::len), Some(47), "a list as a whole");
    }

    #[test]
    fn of_members_with_one_name_the_last_counts() {
        assert_eq!(text(r#"{"a":1,"a":2}"#).at("/a"), Some("2"), "an object");
        assert_eq!(text(r#"{"nodes":[1],"nodes":[2]}"#).at("/nodes/0"), Some("2"), "a list");
    }

    /// A tree of this depth would overflow the stack, or be rejected by the parser's limit.
    #[test]
    fn depth_takes_no_stack() {
        const DEPTH: usize = 1_000_000;
        let deep = format!("{}{}", "[".repeat(DEPTH), "]".repeat(DEPTH));
        let text = text(&format!(r#"{{"nodes":[{{"extras":{deep}}}],"x":{deep}}}"#));
        assert_eq!(text.at("/nodes/0/extras"), Some(deep.as_str()), "in a list");
        assert_eq!(text.at("/x/0").map(str::len), Some(deep.len() - 2), "beside the lists");
    }

    fn json() -> impl Strategy<Value = Value> {
        let leaf = prop_oneof![
            Just(Value::Null),
            any::<bool>().prop_map(Value::from),
            any::<i64>().prop_map(Value::from),
            ".{0,4}".prop_map(Value::from),
        ];
        leaf.prop_recursive(4, 40, 5, |inner| {
            let name = prop_oneof![Just("nodes".to_owned()), "[a~/0-2]{0,3}"];
            prop_oneof![
                prop::collection::vec(inner.clone(), 0..5).prop_map(Value::from),
                prop::collection::btree_map(name, inner, 0..5)
                    .prop_map(|map| Value::Object(map.into_iter().collect())),
            ]
        })
    }

    /// Every pointer into a value.
    fn pointers(value: &Value, path: String, found: &mut Vec<String>) {
        match value {
            Value::Array(list) => {
                list.iter()
                    .enumerate()
                    .for_each(|(key, item)| pointers(item, format!("{path}/{key}"), found));
            }
            Value::Object(map) => map.iter().for_each(|(key, item)| {
                let key = key.replace('~', "~0").replace('/', "~1");
                pointers(item, format!("{path}/{key}"), found);
            }),
            _ => {}
        }
        found.push(path);
    }

    proptest! {
        /// serde_json's tree is the oracle.
        #[test]
        fn pointers_lead_where_a_tree_has_them(nodes in prop::collection::vec(json(), 0..4), other in json()) {
            let value = serde_json::json!({"nodes": nodes, "other": other});
            let text = text(&serde_json::to_string_pretty(&value).expect("JSON"));
            let mut all = Vec::new();
            pointers(&value, String::new(), &mut all);
            for pointer in all {
                let part: Value = serde_json::from_str(text.at(&pointer).expect("it exists")).expect("JSON");
                prop_assert_eq!(Some(&part), value.pointer(&pointer), "{}", pointer);
            }
        }
    }
}
