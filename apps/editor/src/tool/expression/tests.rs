//! Texts and their values.

use proptest::prelude::*;

use super::*;

fn length(text: &str) -> f64 {
    evaluate(text, Quantity::Length).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn error(text: &str, quantity: Quantity) -> String {
    evaluate(text, quantity).expect_err("it is no number").to_string()
}

#[test]
fn operators_bind_as_in_mathematics() {
    for (text, value) in [
        ("1+2*3", 7.0),
        (" ( 1 + 2 ) * 3 ", 9.0),
        ("10-4-3", 3.0),
        ("16/4/2", 2.0),
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("--3", 3.0),
        ("+.5", 0.5),
        ("2.", 2.0),
    ] {
        assert_eq!(length(text), value, "{text}");
    }
    assert_eq!(length("pi"), PI, "to the last bit");
}

#[test]
fn units_are_those_of_the_quantity() {
    assert_eq!(length("1 m + 20cm + 5 mm"), 1.0 + 20.0 * 0.01 + 5.0 * 0.001, "metres");
    assert_eq!(length("12in"), 12.0 * 0.0254, "inches");
    assert_eq!(evaluate("pi rad", Quantity::Angle), Ok(180.0), "half a turn");
    assert_eq!(evaluate("45deg * 2", Quantity::Angle), Ok(90.0), "degrees are the default");
    let no_angle = error("3 rad", Quantity::Length);
    assert!(
        no_angle.starts_with("`rad` is not a unit; write one of m, cm") && no_angle.ends_with('3'),
        "{no_angle}"
    );
    assert_eq!(error("3 m", Quantity::Factor), "a factor has no unit `m` at character 3");
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    for (text, message) in [
        ("", "a number is missing at character 1"),
        ("1 +", "a number is missing at character 4"),
        ("(1 + 2", "`)` is missing at character 7"),
        ("1 2", "an operator is missing at character 3"),
        ("1..2", "a number is missing at character 1"),
        ("x", "a number is missing at character 1"),
        ("1/0", "the value is not finite at character 4"),
        ("2 * é", "a number is missing at character 5"),
    ] {
        assert_eq!(error(text, Quantity::Factor), message, "{text}");
    }
}

#[test]
fn depth_is_bounded() {
    for text in ["(".repeat(100_000), "-".repeat(100_000), "2^".repeat(100_000)] {
        assert!(error(&text, Quantity::Factor).starts_with("there are more than 50 levels"), "refused");
    }
    let deep = format!("{}1{}", "(".repeat(49), ")".repeat(49));
    assert_eq!(length(&deep), 1.0, "within the bound");
}

proptest! {
    #[test]
    fn any_text_is_a_finite_number_or_an_error(text in "[-+*/^(). 0-9a-zé]{0,40}") {
        for quantity in [Quantity::Length, Quantity::Angle, Quantity::Factor] {
            match evaluate(&text, quantity) {
                Ok(value) => prop_assert!(value.is_finite()),
                Err(error) => prop_assert!((1..=text.chars().count() + 1).contains(&error.index)),
            }
        }
    }

    #[test]
    fn numbers_are_read_as_rust_reads_them(value in 0.0f64..1e9) {
        prop_assert_eq!(length(&format!("{value}")), value);
    }
}
