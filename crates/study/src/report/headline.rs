//! A sentence of "In short": one row divided by another that differs from it in one condition.
//!
//! A chapter names the two rows and the compared column; words and numbers follow from the rows. So a
//! sentence cannot divide by a row that it does not name, or hide a second difference.

use super::chapter::{Conditions, Row, number};

/// Ratios of times this near to 1 say nothing: times vary by as much from run to run.
const SAME: f64 = 0.15;

/// Whether a column holds times; errors and counts do not vary.
pub(super) fn is_time(quantity: &str) -> bool {
    let first = quantity.split([' ', ',']).next().unwrap_or_default();
    ["ns", "µs", "ms"].contains(&first) || quantity.ends_with(", ns")
}

/// Two rows of a chapter, and what is compared.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Headline {
    /// What is divided.
    pub(super) numerator: RowKey,
    /// What it is divided by.
    pub(super) denominator: RowKey,
    /// The columns.
    pub(super) quantities: Vec<&'static str>,
    /// What follows for a reader, without figures; may be empty.
    pub(super) meaning: &'static str,
}

/// Where a row stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct RowKey {
    /// The table.
    pub(super) case: String,
    /// The row in it.
    pub(super) variant: String,
}

impl RowKey {
    pub(super) fn new(case: impl Into<String>, variant: impl Into<String>) -> Self {
        Self { case: case.into(), variant: variant.into() }
    }

    fn find<'a>(&self, rows: &'a [Row]) -> &'a Row {
        let is_meant = |row: &&Row| row.case == self.case && row.variant == self.variant;
        rows.iter().find(is_meant).unwrap_or_else(|| panic!("headlines name rows of their chapter: {self:?}"))
    }
}

impl Headline {
    /// Two rows of one table.
    pub(super) fn within(
        case: impl Into<String>,
        [numerator, denominator]: [impl Into<String>; 2],
        quantities: impl Into<Vec<&'static str>>,
    ) -> Self {
        let case = case.into();
        Self {
            numerator: RowKey::new(case.clone(), numerator),
            denominator: RowKey::new(case, denominator),
            quantities: quantities.into(),
            meaning: "",
        }
    }

    /// One row of two tables.
    pub(super) fn between(
        [numerator, denominator]: [impl Into<String>; 2],
        variant: impl Into<String>,
        quantities: impl Into<Vec<&'static str>>,
    ) -> Self {
        let variant = variant.into();
        Self {
            numerator: RowKey::new(numerator, variant.clone()),
            denominator: RowKey::new(denominator, variant),
            quantities: quantities.into(),
            meaning: "",
        }
    }

    /// With what follows from it.
    pub(super) fn meaning(mut self, meaning: &'static str) -> Self {
        self.meaning = meaning;
        self
    }

    /// The sentence.
    ///
    /// # Panics
    /// A row or a value is missing, or the rows do not differ in exactly one condition: the
    /// chapter's source is wrong.
    pub(super) fn sentence(&self, rows: &[Row]) -> String {
        let [above, below] = [&self.numerator, &self.denominator].map(|key| key.find(rows));
        let differing = differing(&above.conditions, &below.conditions);
        let [index] = differing[..] else { panic!("{self:?} compares rows that differ in {differing:?}") };
        let [what, instead] = [above, below].map(|row| row.conditions.words()[index].clone());
        let words = below.conditions.words();
        let same = words.iter().enumerate().filter(|(pixel, word)| *pixel != index && !word.is_empty());
        let same: Vec<&str> = same.map(|(_, word)| word.as_str()).collect();
        let compared = self.quantities.iter().map(|quantity| {
            let [a, b] = [above, below].map(|row| {
                row.value(quantity)
                    .unwrap_or_else(|| panic!("{self:?} compares what was measured: {quantity}"))
            });
            format!("{quantity}: {}", ratio(a, b, is_time(quantity)))
        });
        let compared: Vec<String> = compared.collect();
        let mut text =
            format!("**{what} instead of {instead}** ({}): {}.", same.join(", "), compared.join("; "));
        if !self.meaning.is_empty() {
            text.push(' ');
            text.push_str(self.meaning);
        }
        text
    }
}

/// The conditions in which two rows differ, by their places in [`Conditions::NAMES`].
fn differing(one: &Conditions, other: &Conditions) -> Vec<usize> {
    let pairs = one.words().into_iter().zip(other.words()).enumerate();
    pairs.filter(|(_, (one, other))| one != other).map(|(index, _)| index).collect()
}

/// How many times `b` `a` is, with both.
fn ratio(a: f64, b: f64, is_time: bool) -> String {
    let both = format!("({} / {})", number(a), number(b));
    if a == b {
        format!("the same {both}")
    } else if a == 0.0 || b == 0.0 {
        format!("{} instead of {}", number(a), number(b))
    } else if is_time && (a / b - 1.0).abs() <= SAME {
        format!("no measurable difference {both}")
    } else {
        format!("{}× {both}", number(a / b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIME: &str = "ms per frame";

    fn rows() -> Vec<Row> {
        let row = |variant: &str, time: f64| Row::new("balls", variant).sized([8, 4]).with(TIME, time);
        vec![row("a", 3.0), row("b", 2.0), row("c", 2.2), row("d", 2.0).with_threads(2), row("e", 0.0)]
    }

    fn sentence(variants: [&str; 2]) -> String {
        Headline::within("balls", variants, [TIME]).sentence(&rows())
    }

    #[test]
    fn a_sentence_names_both_rows_and_what_they_share() {
        let expected =
            "**a instead of b** (1 thread, balls, 8×4 pixels, warm): ms per frame: 1.50× (3.00 / 2.00).";
        assert_eq!(sentence(["a", "b"]), expected);
    }

    #[test]
    fn ratios_of_times_within_15_percent_of_1_are_none() {
        assert!(sentence(["c", "b"]).ends_with("no measurable difference (2.20 / 2.00)."), "1.10");
        assert!(sentence(["b", "c"]).ends_with("no measurable difference (2.00 / 2.20)."), "0.91");
        assert!(sentence(["a", "e"]).ends_with("3.00 instead of 0."), "nothing divides by 0");
        assert!(sentence(["e", "a"]).ends_with("0 instead of 3.00."), "and no factor is 0");
        assert_eq!(ratio(2.2, 2.0, false), "1.10× (2.20 / 2.00)", "an error does not vary");
        assert_eq!(ratio(2.0, 2.0, false), "the same (2.00 / 2.00)");
        let times = ["ms per frame", "ns per look-up", "µs per frame", "ms, 1 thread", "picking an edge, ns"];
        assert!(times.into_iter().all(is_time) && !is_time("misordered pixels, ‰"));
    }

    #[test]
    #[should_panic(expected = "differ in [0, 1]")]
    fn two_differences_are_refused() {
        sentence(["a", "d"]);
    }
}
