//! Text of any Unicode encoding as bytes.

use std::borrow::Cow;

/// A text as bytes of an ASCII superset, without its byte order mark. Without a mark they stay as they are.
pub(crate) fn plain_text(bytes: &[u8]) -> Cow<'_, [u8]> {
    let from_units = |read: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|pair| read([pair[0], pair[1]]));
        let text: String =
            char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        Cow::Owned(text.into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, ..] => from_units(u16::from_le_bytes),
        [0xfe, 0xff, ..] => from_units(u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_in_other_encodings_is_read() {
        let units = || "\u{feff}v 1".encode_utf16();
        let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
        for text in [&little[..], &big, b"\xef\xbb\xbfv 1", b"v 1"] {
            assert_eq!(&*plain_text(text), b"v 1", "{text:?}");
        }
    }
}
