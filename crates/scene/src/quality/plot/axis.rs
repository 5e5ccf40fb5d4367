//! Logarithmic axes: where they begin and end, and their ticks.

use trigon_math::elementary;

/// An axis from one round number to another, of which each is 1, 2 or 5 times a power of ten.
///
/// ```
/// use trigon_scene::quality::plot::LogAxis;
///
/// let axis = LogAxis::around([1.5, 70.0]);
/// assert_eq!(axis.ends(), [1.0, 100.0]);
/// assert_eq!(axis.position(10.0), 0.5, "halfway in the logarithm");
/// assert_eq!(axis.position(0.0), 0.0, "0 has no logarithm");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LogAxis {
    low: Round,
    high: Round,
}

/// A mark of an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTick {
    /// Where it is.
    pub value: f64,
    /// What stands beside it; `None` for one in between.
    pub label: Option<String>,
}

/// A digit times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Round {
    digit: u8,
    decade: i32,
}

impl Round {
    fn value(self) -> f64 {
        format!("{}e{}", self.digit, self.decade).parse().expect("a digit and an exponent are a number")
    }

    /// Short: without an exponent from 0.001 to below 100,000.
    fn label(self) -> String {
        let Self { digit, decade } = self;
        match decade {
            -3..=-1 => format!("0.{:0>width$}", digit, width = decade.unsigned_abs() as usize),
            0..=4 => format!("{digit}{}", "0".repeat(decade.unsigned_abs() as usize)),
            _ => format!("{digit}e{decade}"),
        }
    }

    /// The greatest power of ten that is not above a number within [`LEAST`] and [`MOST`].
    fn decade_of(value: f64) -> i32 {
        let guess = elementary::log10(value).floor() as i32;
        // The logarithm is rounded.
        let is_below = |decade: &i32| Self { digit: 1, decade: *decade }.value() <= value;
        [guess + 1, guess].into_iter().find(is_below).unwrap_or(guess - 1)
    }
}

/// Values beyond lie at the end of the axis.
const LEAST: f64 = 1e-100;
const MOST: f64 = 1e100;

/// How much farther than its values an axis goes at least, as a factor.
const MARGIN: f64 = 1.3;

/// The most labelled decades; of longer axes, not each is labelled.
const MOST_LABELS: i32 = 8;

impl LogAxis {
    /// The shortest axis with some margin about the positive, finite values; from 0.1 to 10 if there are none.
    pub fn around(values: impl IntoIterator<Item = f64>) -> Self {
        let Some([low, high]) = extent(values) else { return Self::default() };
        let of = |decade: i32| [1, 2, 5].map(|digit| Round { digit, decade });
        let below = |round: &Round| round.value() <= low / MARGIN;
        let above = |round: &Round| round.value() >= high * MARGIN;
        let [first, last] = [low / MARGIN, high * MARGIN].map(Round::decade_of);
        Self {
            low: of(first).into_iter().rev().find(below).unwrap_or(Round { digit: 1, decade: first }),
            high: of(last).into_iter().find(above).unwrap_or(Round { digit: 1, decade: last + 1 }),
        }
    }

    /// As [`around`](Self::around), with whole powers of ten at its ends.
    pub fn around_by_decades(values: impl IntoIterator<Item = f64>) -> Self {
        let Some([low, high]) = extent(values) else { return Self::default() };
        let end = |value: f64, more: i32| Round { digit: 1, decade: Round::decade_of(value) + more };
        Self { low: end(low / MARGIN, 0), high: end(high * MARGIN, 1) }
    }

    /// Its least and its greatest value.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.low.value(), self.high.value()]
    }

    /// Where a value lies: 0 at the lower end, where 0 and negative values are, too, to 1 at the upper one.
    #[must_use]
    pub fn position(&self, value: f64) -> f64 {
        let [low, high] = self.ends();
        if value > low {
            (elementary::log10(value.min(high) / low) / elementary::log10(high / low)).min(1.0)
        } else {
            0.0
        }
    }

    /// Its ticks, in rising order. The labels are 1, 2 and 5 in each decade of a short axis, powers of ten of a longer
    /// one, and some of these on a very long one.
    #[must_use]
    pub fn ticks(&self) -> Vec<AxisTick> {
        let decades = self.high.decade - self.low.decade + 1;
        let [least, most] = self.ends();
        let every = (decades + MOST_LABELS - 1) / MOST_LABELS;
        let tick = |round: Round| {
            let is_labelled = match round.digit {
                1 => true,
                2 | 5 => decades <= 3,
                _ => false,
            };
            AxisTick { value: round.value(), label: is_labelled.then(|| round.label()) }
        };
        let digits = if every > 1 { 1..=1 } else { 1..=9 };
        let rounds = (self.low.decade..=self.high.decade)
            .filter(|decade| decade.rem_euclid(every) == 0)
            .flat_map(|decade| digits.clone().map(move |digit| Round { digit, decade }));
        rounds.map(tick).filter(|tick| (least..=most).contains(&tick.value)).collect()
    }
}

impl Default for LogAxis {
    /// From 0.1 to 10.
    fn default() -> Self {
        Self { low: Round { digit: 1, decade: -1 }, high: Round { digit: 1, decade: 1 } }
    }
}

/// The least and the greatest of the positive, finite values.
fn extent(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let positive = values.into_iter().filter(|value| value.is_finite() && *value > 0.0);
    positive.map(|value| value.clamp(LEAST, MOST)).fold(None, |extent, value| {
        let [low, high] = extent.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn axes_end_at_1_2_or_5_of_a_decade_with_some_margin_about_the_values() {
        for (values, expected) in [
            ([2.0, 30.0], [1.0, 50.0]),
            ([3.0, 16.0], [2.0, 50.0]),
            ([8.0, 8.0], [5.0, 20.0]),
            ([0.1, 0.2], [0.05, 0.5]),
            ([1.2, 70.0], [0.5, 100.0]),
            ([1.4, 80.0], [1.0, 200.0]),
        ] {
            assert_eq!(LogAxis::around(values).ends(), expected, "about {values:?}");
        }
        assert_eq!(LogAxis::around([0.0, 30.0, 2.0]).ends(), [1.0, 50.0], "0 has no logarithm");
        assert_eq!(LogAxis::around([0.0, f64::NAN, f64::INFINITY]).ends(), [0.1, 10.0], "without any value");
        assert_eq!(LogAxis::around_by_decades([2.0, 0.5, 30.0]).ends(), [0.1, 100.0], "whole decades");
    }

    #[test]
    fn ticks_of_short_axes_have_labels_in_between() {
        let labels =
            |axis: LogAxis| axis.ticks().into_iter().filter_map(|tick| tick.label).collect::<Vec<_>>();
        assert_eq!(labels(LogAxis::around([3.0, 16.0])), ["2", "5", "10", "20", "50"], "in two decades");
        assert_eq!(labels(LogAxis::around([3e-5, 20.0])).len(), 6, "1e-5 to 10");
        assert_eq!(LogAxis::around([3.0, 16.0]).ticks().len(), 13, "2 to 9, 10 to 50");
    }

    #[test]
    fn labels_are_short() {
        let label = |digit, decade| Round { digit, decade }.label();
        let written =
            [label(1, -3), label(2, -2), label(1, 0), label(2, 1), label(5, 4), label(1, 5), label(5, -4)];
        assert_eq!(written, ["0.001", "0.02", "1", "20", "50000", "1e5", "5e-4"]);
    }

    proptest! {
        /// Any numbers: the axis is not empty, holds the values that it can, and has a few ticks.
        #[test]
        fn an_axis_is_sound_for_any_values(values in prop::collection::vec(any::<f64>(), 0..8)) {
            for axis in [LogAxis::around(values.clone()), LogAxis::around_by_decades(values.clone())] {
                let [low, high] = axis.ends();
                prop_assert!(0.0 < low && low < high && high.is_finite(), "{axis:?}");
                for value in &values {
                    let position = axis.position(*value);
                    prop_assert!((0.0..=1.0).contains(&position), "{value} is at {position}");
                    if (LEAST..=MOST).contains(value) {
                        prop_assert!(low < *value && *value < high, "{value} lies on {axis:?}");
                    }
                }
                let ticks = axis.ticks();
                let labels = ticks.iter().filter(|tick| tick.label.is_some()).count();
                prop_assert!((1..=12).contains(&labels), "{labels} labels on {axis:?}");
                prop_assert!(ticks.is_sorted_by(|a, b| a.value < b.value) && ticks.len() < 90);
                let positions = ticks.iter().map(|tick| axis.position(tick.value));
                prop_assert!(positions.is_sorted());
            }
        }
    }
}
