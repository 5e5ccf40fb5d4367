//! Names for text formats.

/// A name that text formats take: without spaces, comments and what ends or continues a line; never empty.
pub(crate) fn plain_name(name: &str, otherwise: &str) -> String {
    let is_odd = |c: char| c.is_whitespace() || c.is_control() || matches!(c, '#' | '\\' | '/' | '"');
    let name: String = name.trim().chars().map(|c| if is_odd(c) { '_' } else { c }).collect();
    if name.is_empty() { otherwise.to_owned() } else { name }
}
