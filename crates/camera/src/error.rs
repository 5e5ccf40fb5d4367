//! Invalid camera parameters: which number, its value, and the accepted range.

/// A camera cannot be built from these numbers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// A number is outside its range (or NaN).
    #[error("{what} is {value}, but must be {allowed}")]
    OutOfRange {
        /// The name of the parameter in the constructor.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The range that is accepted, in words.
        allowed: &'static str,
    },
    /// Two bounds are equal, in the wrong order, or so close together that nothing fits between
    /// them.
    #[error(
        "{low_name} is {low} and {high_name} is {high}, but {low_name} must be clearly less than {high_name}"
    )]
    Unordered {
        /// The parameter that must be less.
        low_name: &'static str,
        /// Its value.
        low: f64,
        /// The parameter that must be greater.
        high_name: &'static str,
        /// Its value.
        high: f64,
    },
    /// A pose that is not a rotation and a translation.
    #[error("the pose is no rotation and translation: its columns have the lengths {}, {}, {}, or are not square to each other, or a number is not finite", lengths[0], lengths[1], lengths[2])]
    NoRotation {
        /// The lengths of the columns, which are 1 in a rotation.
        lengths: [f64; 3],
    },
    /// A pose that exchanges left and right.
    #[error("the pose is a mirror image; negate one axis, or name the other convention")]
    Mirrored,
    /// A text that is neither an axis nor a direction.
    #[error("write +X, -X, +Y, -Y, +Z, -Z or a direction such as 0,1,0.5")]
    UnknownAxis,
}

impl CameraError {
    /// Checks that `value` is finite.
    pub(crate) fn check_finite(what: &'static str, value: f64) -> Result<(), Self> {
        Self::check(what, value, value.is_finite(), "a finite number")
    }

    /// Checks that `value` is finite and greater than zero.
    pub(crate) fn check_positive(what: &'static str, value: f64) -> Result<(), Self> {
        Self::check(what, value, value.is_finite() && value > 0.0, "a finite number greater than 0")
    }

    /// Returns an error with this parameter and range unless `good`.
    pub(crate) fn check(
        what: &'static str,
        value: f64,
        good: bool,
        allowed: &'static str,
    ) -> Result<(), Self> {
        if good { Ok(()) } else { Err(Self::OutOfRange { what, value, allowed }) }
    }

    /// Checks that `low < high` and that their difference can be divided by.
    pub(crate) fn check_ordered(
        low_name: &'static str,
        low: f64,
        high_name: &'static str,
        high: f64,
    ) -> Result<(), Self> {
        Self::check_finite(low_name, low)?;
        Self::check_finite(high_name, high)?;
        let width = high - low;
        if width > 0.0 && width.is_finite() && width.recip().is_finite() {
            Ok(())
        } else {
            Err(Self::Unordered { low_name, low, high_name, high })
        }
    }
}
