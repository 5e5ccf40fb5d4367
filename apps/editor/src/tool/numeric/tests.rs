//! Typed keys and what they mean.

use proptest::prelude::*;

use super::*;

/// Types characters; `<` is Backspace, `>` Tab.
fn typing(entry: &mut NumericEntry, keys: &str) {
    for key in keys.chars() {
        let key = match key {
            '<' => Key::Backspace,
            '>' => Key::Tab,
            ' ' => Key::Space,
            character => Key::Character(character),
        };
        entry.key(key, Modifiers::NONE);
    }
}

fn entered(keys: &str) -> NumericEntry {
    let mut entry = NumericEntry::new(Quantity::Length, 3);
    typing(&mut entry, keys);
    entry
}

fn values(keys: &str) -> Vec<Option<f64>> {
    entered(keys).values().unwrap_or_else(|error| panic!("{keys}: {error}"))
}

#[test]
fn numbers_are_typed_as_in_blender() {
    assert_eq!(values("2"), [Some(2.0), None, None], "the first component");
    assert_eq!(values("1.25"), [Some(1.25), None, None], "with a point");
    assert_eq!(values("12-"), [Some(-12.0), None, None], "a minus negates the whole, at any place");
    assert_eq!(values("-12-"), [Some(12.0), None, None], "and a second one again");
    assert_eq!(values("4/"), [Some(0.25), None, None], "the reciprocal");
    assert_eq!(values("4/-"), [Some(-0.25), None, None], "of which the negative");
    assert_eq!(values("1>2>3"), [Some(1.0), Some(2.0), Some(3.0)], "Tab goes on");
    assert_eq!(values("1>2>3>4"), [Some(14.0), Some(2.0), Some(3.0)], "and around");
    assert_eq!(values("1.2.3"), [Some(1.23), None, None], "one point only");
    assert_eq!(values("."), [Some(0.0), None, None], "the beginning of a number");
}

#[test]
fn backspace_resets_and_then_leaves() {
    let mut entry = entered("-12");
    typing(&mut entry, "<<");
    assert_eq!((entry.values().expect("empty")[0], entry.is_active()), (None, true), "the sign is left");
    typing(&mut entry, "<");
    assert!(entry.is_active(), "the sign is gone");
    typing(&mut entry, "<");
    assert!(!entry.is_active(), "the pointer counts again");
    assert!(!entry.key(Key::Backspace, Modifiers::NONE), "and Backspace is the tool's");
    assert!(!entry.key(Key::Tab, Modifiers::NONE), "so is Tab");
}

#[test]
fn expressions_take_every_key_until_they_end() {
    let mut entry = entered("=2*(1+1)x");
    assert_eq!(
        entry.status(),
        "[2*(1+1)x], –, –: `x` is not a unit; write one of m, cm, mm, km, um, in, ft at character 8"
    );
    typing(&mut entry, "<");
    assert_eq!(entry.values().expect("four")[0], Some(4.0), "Backspace takes back a character");
    assert!(entry.key(Key::Character('='), Modifiers::CTRL), "ends it");
    assert!(!entry.key(Key::Character('x'), Modifiers::NONE), "x is the tool's again");
    assert_eq!(values("5-=+ 50cm"), [Some(-4.5), None, None], "what was typed before stays");
    let mut shifted = entered("=");
    for (key, modifiers) in [
        ('9', Modifiers::SHIFT),
        ('2', Modifiers::NONE),
        ('0', Modifiers::SHIFT),
        ('6', Modifiers::SHIFT),
        ('3', Modifiers::NONE),
    ] {
        shifted.key(Key::Character(key), modifiers);
    }
    assert_eq!(shifted.values().expect("(2)^3")[0], Some(8.0), "symbols as on a US keyboard");
}

#[test]
fn keys_of_tools_are_left_alone() {
    let mut entry = NumericEntry::new(Quantity::Angle, 1);
    for key in [Key::Character('x'), Key::Enter, Key::Escape, Key::Space, Key::Tab, Key::Character('/')] {
        assert!(!entry.key(key, Modifiers::NONE), "{key}");
    }
    assert!(!entry.key(Key::Character('1'), Modifiers::CTRL), "Ctrl+1 is no digit");
    assert!(!entry.is_active(), "nothing was typed");
    assert_eq!(entry.value_or(1.0), Ok(None), "the pointer counts");
}

#[test]
fn zero_has_no_reciprocal() {
    let entry = entered("0/");
    assert!(entry.values().is_err(), "refused");
    assert!(entry.status().contains("zero has no reciprocal"), "and said");
}

proptest! {
    #[test]
    fn no_keys_break_it(keys in "[-=./*<> 0-9a-z()^+]{0,300}", count in 0usize..4) {
        let mut entry = NumericEntry::new(Quantity::Angle, count);
        for (index, key) in keys.chars().enumerate() {
            typing(&mut entry, &key.to_string());
            if index == 100 {
                entry.set_count(1);
            }
            if let Ok(values) = entry.values() {
                prop_assert!(values.iter().flatten().all(|value| value.is_finite()));
            }
            prop_assert!(!entry.status().is_empty());
        }
    }
}
