//! Units of numbers, shown after a field's value.

use crate::tool::Quantity;

/// What a number counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Unit {
    /// Nothing that has a unit.
    #[default]
    None,
    /// Metres.
    Metres,
    /// Square metres.
    SquareMetres,
    /// Degrees.
    Degrees,
    /// Radians, shown in degrees.
    Radians,
}

impl Unit {
    /// The unit stated in a comment, such as "How far, in metres."
    pub(super) fn of_comment(comment: &str) -> Self {
        let words = [
            ("square metres", Self::SquareMetres),
            ("in metres", Self::Metres),
            ("in degrees", Self::Degrees),
            ("in radians", Self::Radians),
        ];
        let lower = comment.to_lowercase();
        words.into_iter().find(|(word, _)| lower.contains(word)).map_or(Self::None, |(_, unit)| unit)
    }

    /// Which units may be typed after a number, which is shown in metres or degrees.
    pub(super) fn quantity(self) -> Quantity {
        match self {
            Self::Metres => Quantity::Length,
            Self::Degrees | Self::Radians => Quantity::Angle,
            Self::None | Self::SquareMetres => Quantity::Factor,
        }
    }

    /// The suffix of the number.
    pub(super) fn suffix(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Metres => " m",
            Self::SquareMetres => " m²",
            Self::Degrees | Self::Radians => "°",
        }
    }

    /// How many digits after the point are shown. Angles of lights and of cones are f32 in radians.
    pub(super) fn digits(self) -> usize {
        match self {
            Self::None | Self::Metres | Self::SquareMetres => 6,
            Self::Degrees | Self::Radians => 4,
        }
    }

    /// By how much the number changes for each point that it is dragged.
    pub(super) fn speed(self) -> f64 {
        match self {
            Self::None | Self::Metres | Self::SquareMetres => 0.01,
            Self::Degrees | Self::Radians => 0.5,
        }
    }

    /// What is shown for a value.
    pub(super) fn shown(self, value: f64) -> f64 {
        if self == Self::Radians { value.to_degrees() } else { value }
    }

    /// The value for what is shown.
    pub(super) fn value(self, shown: f64) -> f64 {
        if self == Self::Radians { shown.to_radians() } else { shown }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_tell_units() {
        assert_eq!(Unit::of_comment("How far, in metres."), Unit::Metres, "a length");
        assert_eq!(Unit::of_comment("In degrees: 0 to 180."), Unit::Degrees, "an angle");
        assert_eq!(Unit::of_comment("At most this area, in square metres."), Unit::SquareMetres, "an area");
        assert_eq!(Unit::of_comment("0 (smooth) to 1 (sharp)."), Unit::None, "a share");
    }

    #[test]
    fn radians_are_shown_in_degrees() {
        let unit = Unit::of_comment("By how much, in radians.");
        assert_eq!((unit.suffix(), unit.shown(std::f64::consts::PI)), ("°", 180.0), "half a turn");
        // Rounding of a factor and its inverse.
        assert!((unit.value(unit.shown(0.3)) - 0.3).abs() < 1e-15, "and back");
    }
}
