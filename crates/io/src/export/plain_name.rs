//! Names for text formats.

/// A name valid in text formats: without spaces, comments and characters that end or continue a line; never
/// empty.
pub(crate) fn plain_name(name: &str, otherwise: &str) -> String {
    let is_odd = |c: char| c.is_whitespace() || c.is_control() || matches!(c, '#' | '\\' | '/' | '"');
    let name: String = name.trim().chars().map(|c| if is_odd(c) { '_' } else { c }).collect();
    if name.is_empty() { otherwise.to_owned() } else { name }
}
