//! Which vector instructions a frame is drawn with.

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
    /// WebAssembly's 128 bits. A module is compiled for them or not: it has this level or [`Scalar`](Self::Scalar).
    Simd128,
}

/// A level by its name failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SimdLevelError {
    /// There is no level of that name.
    #[error("no such SIMD level: it is one of scalar, sse2, avx2, avx512, neon and simd128")]
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
    pub const ALL: [Self; 6] =
        [Self::Scalar, Self::Sse2, Self::Avx2, Self::Avx512, Self::Neon, Self::Simd128];

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
        Token::all().find(|token| Self::of(*token) == self)
    }

    fn of(token: Token) -> Self {
        match token {
            Token::Scalar(_) => Self::Scalar,
            #[cfg(target_arch = "x86_64")]
            Token::Sse2(_) => Self::Sse2,
            #[cfg(target_arch = "x86_64")]
            Token::Avx2(_) => Self::Avx2,
            #[cfg(target_arch = "x86_64")]
            Token::Avx512(_) => Self::Avx512,
            #[cfg(target_arch = "aarch64")]
            Token::Neon(_) => Self::Neon,
            #[cfg(target_feature = "simd128")]
            Token::Simd128(_) => Self::Simd128,
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
            Self::Simd128 => "simd128",
        })
    }
}

impl FromStr for SimdLevel {
    type Err = SimdLevelError;

    fn from_str(name: &str) -> Result<Self, SimdLevelError> {
        Self::ALL.into_iter().find(|level| level.to_string() == name).ok_or(SimdLevelError::Unknown)
    }
}
