//! Switches in small sources.

use super::{Blame, blame, next_arm, switched};
use crate::list::{Genre, Mutant, Position};
use crate::place::sites;

fn mutant(genre: Genre, replacement: &str, line: usize, column: usize) -> Mutant {
    Mutant {
        identity: String::new(),
        krate: "math",
        file: "a.rs".to_owned(),
        genre,
        replacement: replacement.to_owned(),
        start: Position { line, column },
    }
}

/// The source with mutants 1, 2… , without comments and with short switches.
fn short(source: &str, mutants: &[Mutant]) -> String {
    let numbered: Vec<(u32, &Mutant)> = (1..).zip(mutants).collect();
    let text = switched(source, &sites("a.rs", source, &numbered).expect("valid Rust"));
    let without = text.split("/*").map(|part| part.split_once("*/").map_or(part, |(_, rest)| rest));
    without.collect::<String>().replace("::trigon_mutants_switch::active", "on")
}

#[test]
fn functions_return_before_their_first_statement() {
    let source = "fn f() -> u8 {\n    // é\n    7\n}";
    let mutants = [mutant(Genre::FnValue, "0", 3, 5), mutant(Genre::FnValue, "1", 3, 5)];
    let expected = "fn f() -> u8 {\n    // é\n    if on(1) { return 0; } if on(2) { return 1; } 7\n}";
    assert_eq!(short(source, &mutants), expected);
}

#[test]
fn operators_within_operators_are_switched_apart() {
    let source = "fn f(a: i32) -> i32 { -a * 2 }";
    let mutants = [
        mutant(Genre::BinaryOperator, "+", 1, 26),
        mutant(Genre::UnaryOperator, "", 1, 23),
        mutant(Genre::BinaryOperator, "/", 1, 26),
    ];
    let negated = "(if on(2) { (a) } else { (-a) })";
    let expected = format!(
        "fn f(a: i32) -> i32 {{ (if on(1) {{ ({negated}) + (2) }} else if on(3) {{ ({negated}) / (2) }} \
         else {{ ({negated} * 2) }}) }}"
    );
    assert_eq!(short(source, &mutants), expected);
}

#[test]
fn arms_get_a_guard_or_another() {
    let source = "fn f(a: i32) { match a { 1 => g(), b if b > 2 => h(), _ => {} } }";
    let mutants = [
        mutant(Genre::MatchArm, "", 1, 26),
        mutant(Genre::MatchArm, "", 1, 36),
        mutant(Genre::MatchArmGuard, "true", 1, 41),
        mutant(Genre::BinaryOperator, "<", 1, 43),
    ];
    let guard = "(if on(3) { true } else { ((if on(4) { (b) < (2) } else { (b > 2) })) })";
    let expected = format!(
        "fn f(a: i32) {{ match a {{ 1 if !on(1) => g(), b if !on(2) && ({guard}) => h(), _ => {{}} }} }}"
    );
    assert_eq!(short(source, &mutants), expected);
}

#[test]
fn a_field_is_left_out_with_its_comma() {
    let source = "fn f(s: S) -> S { S { a: 1, b: 2, ..s } }";
    let expected = "fn f(s: S) -> S { (if on(1) { S {  b: 2, ..s } } else { (S { a: 1, b: 2, ..s }) }) }";
    assert_eq!(short(source, &[mutant(Genre::StructField, "", 1, 23)]), expected);
}

#[test]
fn errors_are_traced_to_mutants_and_switches() {
    let source = "fn f(a: i32) -> i32 { a + 2 }";
    let wrong = mutant(Genre::BinaryOperator, "/", 1, 25);
    let text = switched(source, &sites("a.rs", source, &[(7, &wrong)]).expect("valid Rust"));
    let byte = |part: &str| text.find(part).expect("a part of the text");
    assert_eq!(blame(&text, byte("/ (2)")), Blame::Mutant(7));
    assert_eq!(blame(&text, byte("::trigon")), Blame::Site(vec![7]));
    assert_eq!(blame(&text, byte("fn")), Blame::Nobody);
    assert_eq!(blame(&text, text.len() - 1), Blame::Nobody);
}

#[test]
fn a_match_that_is_not_exhaustive_is_traced_to_its_arm() {
    let source = "fn f(a: bool) { match a { true => g(), false => {} } }";
    let arm = mutant(Genre::MatchArm, "", 1, 27);
    let text = switched(source, &sites("a.rs", source, &[(5, &arm)]).expect("valid Rust"));
    assert_eq!(next_arm(&text, 22), Some(5), "{text}");
    assert_eq!(next_arm(&text, text.len()), None, "no arm follows");
}
