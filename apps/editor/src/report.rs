//! What the program tells on standard error.

/// A line on standard error.
#[expect(clippy::print_stderr, reason = "programs report here")]
pub(crate) fn report(kind: &str, message: &str) {
    eprintln!("{kind}: {message}");
}
