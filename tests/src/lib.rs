//! Nothing: this package exists for its tests.

/// Runs the examples of the project's README as tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
