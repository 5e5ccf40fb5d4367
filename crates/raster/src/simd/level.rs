//! Which vector instructions a frame is drawn with.

use fearless_simd::Level;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;
use trigon_math::simd::Token;

/// A set of vector instructions. Every level draws the same bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SimdLevel {
    /// None: one number at a time. For comparison; where the processor has vectors
    /// it is there only with the feature `scalar`.
    Scalar,
    /// x86-64's own 128 bits.
    Sse2,
    /// x86-64-v3: 256 bits.
    Avx2,
    /// Ice Lake's AVX-512. Vectors have eight lanes at this level, too; what it adds is
    /// masks, more registers and permutations.
    Avx512,
    /// aarch64's own 128 bits.
    Neon,
}

/// A level by its name failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SimdLevelError {
    /// There is no level of that name.
    #[error("no such SIMD level: it is one of scalar, sse2, avx2, avx512 and neon")]
    Unknown,
    /// This processor lacks the instructions, or the crate was built without the
    /// feature `scalar`.
    #[error(
        "the SIMD level {0} is not available: this processor lacks it, or it is `scalar` and the feature of \
         that name is off; choose another one, or let the program choose"
    )]
    Unsupported(SimdLevel),
}

impl SimdLevel {
    /// All levels, narrow to wide.
    pub const ALL: [Self; 5] = [Self::Scalar, Self::Sse2, Self::Avx2, Self::Avx512, Self::Neon];

    /// The best that this processor has.
    #[must_use]
    pub fn best() -> Self {
        let supported = |level: &&Self| level.token().is_some();
        Self::ALL.iter().rfind(supported).copied().unwrap_or(Self::Scalar)
    }

    /// Whether this processor has it.
    #[must_use]
    pub fn is_supported(self) -> bool {
        self.token().is_some()
    }

    /// The proof that the processor has it.
    pub(crate) fn token(self) -> Option<Token> {
        match self {
            #[cfg(any(feature = "scalar", not(any(target_arch = "x86_64", target_arch = "aarch64"))))]
            Self::Scalar => Some(Token::Scalar(trigon_math::simd::Scalar::new())),
            #[cfg(not(any(feature = "scalar", not(any(target_arch = "x86_64", target_arch = "aarch64")))))]
            Self::Scalar => None,
            #[cfg(target_arch = "x86_64")]
            Self::Sse2 => Level::new().as_sse2().map(Token::Sse2),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => Level::new().as_avx2().map(Token::Avx2),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => Level::new().as_avx512().map(Token::Avx512),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Sse2 | Self::Avx2 | Self::Avx512 => None,
            #[cfg(target_arch = "aarch64")]
            Self::Neon => Level::new().as_neon().map(Token::Neon),
            #[cfg(not(target_arch = "aarch64"))]
            Self::Neon => None,
        }
    }
}

impl fmt::Display for SimdLevel {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Scalar => "scalar",
            Self::Sse2 => "sse2",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
            Self::Neon => "neon",
        })
    }
}

impl FromStr for SimdLevel {
    type Err = SimdLevelError;

    fn from_str(name: &str) -> Result<Self, SimdLevelError> {
        Self::ALL.into_iter().find(|level| level.to_string() == name).ok_or(SimdLevelError::Unknown)
    }
}
