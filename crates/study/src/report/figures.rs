//! What was measured, in a form that tables, plots and files are made from.

use crate::measure::Spread;

/// What one variant gave in one case.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) case: String,
    pub(super) variant: String,
    pub(super) values: Vec<Value>,
}

/// One number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Value {
    /// What it tells, and its unit: the head of a column.
    pub(super) quantity: &'static str,
    pub(super) value: f64,
    /// Between which values half of the runs lay.
    pub(super) range: Option<[f64; 2]>,
}

impl Row {
    pub(super) fn new(case: impl Into<String>, variant: impl Into<String>) -> Self {
        Self { case: case.into(), variant: variant.into(), values: Vec::new() }
    }

    /// With a number.
    pub(super) fn with(mut self, quantity: &'static str, value: f64) -> Self {
        self.values.push(Value { quantity, value, range: None });
        self
    }

    /// With a time.
    pub(super) fn timed(mut self, quantity: &'static str, time: Spread) -> Self {
        let Spread { low, median, high } = time;
        self.values.push(Value { quantity, value: median, range: Some([low, high]) });
        self
    }

    pub(super) fn value(&self, quantity: &str) -> Option<f64> {
        self.values.iter().find(|value| value.quantity == quantity).map(|value| value.value)
    }
}

/// A number of a variant in a case; no number if it was not measured.
pub(super) fn value(rows: &[Row], case: &str, variant: &str, quantity: &str) -> f64 {
    let mut found = rows.iter().filter(|row| row.case == case && row.variant == variant);
    found.find_map(|row| row.value(quantity)).unwrap_or(f64::NAN)
}

/// Three digits that count, without an exponent where people can do without.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        "–".to_owned()
    } else if !(1e-4..1e7).contains(&size) {
        format!("{value:.2e}")
    } else {
        let before = trigon_math::elementary::log10(size).floor();
        let after = (2.0 - before).max(0.0) as usize;
        format!("{value:.after$}")
    }
}

/// How many times one number is the other.
pub(super) fn times(of: f64, other: f64) -> String {
    format!("{}×", number(of / other))
}
