//! Levels of vector instructions, and how an expression is compiled for each.
//!
//! The level without vectors takes longer to compile than all others together. Where the processor has vectors it is there
//! only with the feature `scalar`.

use fearless_simd::Level;

/// The level without vectors.
#[cfg(any(
    feature = "scalar",
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
))]
pub type Scalar = fearless_simd::Fallback;

/// The level without vectors, which is not there.
#[cfg(not(any(
    feature = "scalar",
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
)))]
#[derive(Clone, Copy, Debug)]
pub enum Scalar {}

/// A level that the processor has.
#[derive(Clone, Copy, Debug)]
pub enum Token {
    /// No vectors.
    Scalar(Scalar),
    /// x86-64's own 128 bits.
    #[cfg(target_arch = "x86_64")]
    Sse2(fearless_simd::x86::Sse2),
    /// x86-64-v3: 256 bits.
    #[cfg(target_arch = "x86_64")]
    Avx2(fearless_simd::x86::Avx2),
    /// Ice Lake's AVX-512.
    #[cfg(target_arch = "x86_64")]
    Avx512(fearless_simd::x86::Avx512),
    /// aarch64's own 128 bits.
    #[cfg(target_arch = "aarch64")]
    Neon(fearless_simd::aarch64::Neon),
    /// WebAssembly's 128 bits, in modules that are compiled for them.
    #[cfg(target_feature = "simd128")]
    Simd128(fearless_simd::wasm32::WasmSimd128),
}

impl Token {
    /// All levels that this processor has, narrow to wide.
    pub fn all() -> impl Iterator<Item = Self> {
        let level = Level::new();
        #[cfg(target_arch = "x86_64")]
        let vectors = [
            level.as_sse2().map(Self::Sse2),
            level.as_avx2().map(Self::Avx2),
            level.as_avx512().map(Self::Avx512),
        ];
        #[cfg(target_arch = "aarch64")]
        let vectors = [level.as_neon().map(Self::Neon)];
        #[cfg(target_feature = "simd128")]
        let vectors = [level.as_wasm_simd128().map(Self::Simd128)];
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
        let vectors: [Option<Self>; 0] = [];
        #[cfg(any(
            feature = "scalar",
            not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
        ))]
        let scalar = [Self::Scalar(Scalar::new())];
        #[cfg(not(any(
            feature = "scalar",
            not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
        )))]
        let scalar = [];
        let _ = level;
        scalar.into_iter().chain(vectors.into_iter().flatten())
    }

    /// The widest one.
    #[must_use]
    pub fn best() -> Self {
        Self::all().last().expect("every processor has a level: where there are no vectors, the scalar one")
    }
}

/// Runs an expression in a function that is compiled for the level of a [`Token`]. Everything that it calls must be
/// `#[inline(always)]` down to the vectors, or it loses the level's instructions.
#[macro_export]
macro_rules! at_level {
    ($token:expr, $simd:ident => $body:expr) => {{
        use $crate::simd::Simd as _;
        match $token {
            $crate::simd::Token::Scalar($simd) => $crate::at_scalar!($simd => $body),
            #[cfg(target_arch = "x86_64")]
            $crate::simd::Token::Sse2($simd) => $crate::at_token!($simd => $body),
            #[cfg(target_arch = "x86_64")]
            $crate::simd::Token::Avx2($simd) => $crate::at_token!($simd => $body),
            #[cfg(target_arch = "x86_64")]
            $crate::simd::Token::Avx512($simd) => $crate::at_token!($simd => $body),
            #[cfg(target_arch = "aarch64")]
            $crate::simd::Token::Neon($simd) => $crate::at_token!($simd => $body),
            #[cfg(target_feature = "simd128")]
            $crate::simd::Token::Simd128($simd) => $crate::at_token!($simd => $body),
        }
    }};
}

/// Runs an expression without vectors.
#[cfg(any(
    feature = "scalar",
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
))]
#[doc(hidden)]
#[macro_export]
macro_rules! at_scalar {
    ($simd:ident => $body:expr) => {
        $crate::at_token!($simd => $body)
    };
}

/// Compiles nothing for a level that is not there.
#[cfg(not(any(
    feature = "scalar",
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))
)))]
#[doc(hidden)]
#[macro_export]
macro_rules! at_scalar {
    ($simd:ident => $body:expr) => {
        match $simd {}
    };
}

/// Runs an expression in a function that is compiled for a level.
#[doc(hidden)]
#[macro_export]
macro_rules! at_token {
    ($simd:ident => $body:expr) => {
        $simd.vectorize(
            #[inline(always)]
            || $body,
        )
    };
}
