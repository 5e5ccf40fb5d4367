//! Text of XML: what is written between tags and in attributes.

use std::fmt::{Arguments, Display, Formatter, Result, Write};

/// Appends formatted text.
pub(super) fn push(text: &mut String, arguments: Arguments<'_>) {
    text.write_fmt(arguments).expect("text takes everything");
}

/// Text as the value of an attribute. What XML cannot say is replaced.
pub(super) struct Escaped<'a>(pub(super) &'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\t' | '\n' | '\r' => write!(f, "&#{};", c as u32)?,
                '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => f.write_char('\u{fffd}')?,
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}
