//! Vectors for tests of single functions: those that every processor of the architecture has. For `Fallback`, which has none, the
//! compiler would take minutes to build what such functions call, and images are drawn so only with the feature `scalar`.

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(crate) use fearless_simd::Fallback as Baseline;
#[cfg(target_arch = "aarch64")]
pub(crate) use fearless_simd::aarch64::Neon as Baseline;
#[cfg(target_arch = "x86_64")]
pub(crate) use fearless_simd::x86::Sse2 as Baseline;

/// The token of the level.
pub(crate) fn baseline() -> Baseline {
    #[cfg(target_arch = "x86_64")]
    let token = fearless_simd::Level::new().as_sse2();
    #[cfg(target_arch = "aarch64")]
    let token = fearless_simd::Level::new().as_neon();
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    let token = Some(Baseline::new());
    token.expect("it is part of the architecture")
}
