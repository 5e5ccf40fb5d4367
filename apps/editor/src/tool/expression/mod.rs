//! Arithmetic expressions typed instead of a number: `1/3`, `2 * (45 + 10)`, `pi rad`, `1 m + 20 cm`.
//!
//! A recursive descent parser; the nesting of parentheses and signs is limited, so no text
//! overflows the stack.

#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use thiserror::Error;
use trigon_document::mesh::math::elementary;

/// What a number means, and so which units it may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// In metres.
    Length,
    /// In degrees.
    Angle,
    /// Without a unit.
    Factor,
}

/// Why a text is no number.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{what} at character {index}")]
pub(crate) struct ExpressionError {
    /// From 1.
    pub(crate) index: usize,
    /// As "a number is missing".
    pub(crate) what: String,
}

/// Parentheses, signs and powers may nest so deep.
const MOST_LEVELS: usize = 50;

impl Quantity {
    /// The units and how much one of each is.
    fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Length => &[
                ("m", 1.0),
                ("cm", 0.01),
                ("mm", 0.001),
                ("km", 1000.0),
                ("um", 1e-6),
                ("in", 0.0254),
                ("ft", 0.3048),
            ],
            Self::Angle => &[("deg", 1.0), ("d", 1.0), ("rad", 180.0 / PI), ("r", 180.0 / PI)],
            Self::Factor => &[],
        }
    }

    /// The unit that a number without one has.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Length => " m",
            Self::Angle => "°",
            Self::Factor => "",
        }
    }
}

/// The value of a text, in metres or degrees.
///
/// # Errors
/// It is not an expression, its value is not finite, or it nests deeper than 50 levels.
pub(crate) fn evaluate(text: &str, quantity: Quantity) -> Result<f64, ExpressionError> {
    let mut parser = Parser { rest: text, length: text.chars().count(), quantity, levels: 0 };
    let value = parser.sum()?;
    parser.skip_space();
    if !parser.rest.is_empty() {
        return parser.fail("an operator is missing");
    }
    if value.is_finite() { Ok(value) } else { parser.fail("the value is not finite") }
}

struct Parser<'t> {
    rest: &'t str,
    /// Of the whole text, in characters.
    length: usize,
    quantity: Quantity,
    levels: usize,
}

impl<'t> Parser<'t> {
    fn fail<T>(&self, what: impl Into<String>) -> Result<T, ExpressionError> {
        Err(ExpressionError { index: self.length - self.rest.chars().count() + 1, what: what.into() })
    }

    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start();
    }

    /// Consumes a symbol if it is next.
    fn take(&mut self, symbol: char) -> bool {
        self.skip_space();
        let rest = self.rest.strip_prefix(symbol);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// Takes the longest beginning of which all characters are wanted.
    fn take_while(&mut self, is_wanted: impl Fn(char) -> bool) -> &'t str {
        let end = self.rest.find(|c| !is_wanted(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest;
        taken
    }

    fn sum(&mut self) -> Result<f64, ExpressionError> {
        let mut value = self.product()?;
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, ExpressionError> {
        let mut value = self.signed()?;
        loop {
            if self.take('*') {
                value *= self.signed()?;
            } else if self.take('/') {
                value /= self.signed()?;
            } else {
                return Ok(value);
            }
        }
    }

    /// A sign binds less than a power: −2 ^ 2 is −4.
    fn signed(&mut self) -> Result<f64, ExpressionError> {
        if self.levels == MOST_LEVELS {
            return self.fail("there are more than 50 levels");
        }
        self.levels += 1;
        let value = if self.take('-') {
            -self.signed()?
        } else if self.take('+') {
            self.signed()?
        } else {
            self.power()?
        };
        self.levels -= 1;
        Ok(value)
    }

    /// Powers group from the right: 2 ^ 3 ^ 2 is 2 ^ 9.
    fn power(&mut self) -> Result<f64, ExpressionError> {
        let base = self.measured()?;
        if self.take('^') { Ok(elementary::pow(base, self.signed()?)) } else { Ok(base) }
    }

    /// A value and perhaps its unit.
    fn measured(&mut self) -> Result<f64, ExpressionError> {
        let value = self.value()?;
        self.skip_space();
        let before = self.rest;
        let name = self.take_while(char::is_alphabetic);
        if name.is_empty() {
            return Ok(value);
        }
        let unit = self.quantity.units().iter().find(|(unit, _)| *unit == name);
        if let Some((_, size)) = unit {
            return Ok(value * size);
        }
        self.rest = before;
        let known: Vec<&str> = self.quantity.units().iter().map(|(unit, _)| *unit).collect();
        match known.is_empty() {
            true => self.fail(format!("a factor has no unit `{name}`")),
            false => self.fail(format!("`{name}` is not a unit; write one of {}", known.join(", "))),
        }
    }

    fn value(&mut self) -> Result<f64, ExpressionError> {
        if self.take('(') {
            let value = self.sum()?;
            return if self.take(')') { Ok(value) } else { self.fail("`)` is missing") };
        }
        self.skip_space();
        let before = self.rest;
        if self.rest.starts_with(char::is_alphabetic) {
            if self.take_while(char::is_alphabetic) == "pi" {
                return Ok(PI);
            }
            self.rest = before;
            return self.fail("a number is missing");
        }
        let digits = self.take_while(|c| c.is_ascii_digit() || c == '.');
        digits.parse().or_else(|_| {
            self.rest = before;
            self.fail("a number is missing")
        })
    }
}
