//! The two kinds of reference that glTF uses and trigon follows: `data:` URIs
//! and percent-encoded relative paths (RFC 2397, RFC 3986).

use std::borrow::Cow;

use base64::Engine;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};

/// Standard base64, with or without padding: exporters differ.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// The target of a reference.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Reference {
    /// The bytes are in the reference itself.
    Data(Vec<u8>),
    /// A path, not yet checked.
    Path(FileNames),
}

/// The names that a reference may mean. Exporters write names percent-encoded, as the format asks, or as they
/// are; and programs that fetch models keep encoded names.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct FileNames {
    /// Decoded, and as it is written: the most likely first.
    pub(crate) spelled: Vec<String>,
    /// Encoded, if that is another name.
    pub(crate) encoded: Option<String>,
}

/// What stays as it is in an encoded path (RFC 3986, sections 2.3 and 3.3).
const UNESCAPED_IN_PATHS: &AsciiSet =
    &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~').remove(b'/');

impl FileNames {
    fn of(uri: &str) -> Self {
        let decoded = percent_decode_str(uri).decode_utf8().ok();
        let mut spelled: Vec<String> = decoded.into_iter().map(Cow::into_owned).collect();
        if spelled.first().is_none_or(|decoded| decoded != uri) {
            spelled.push(uri.to_owned());
        }
        let encoded = utf8_percent_encode(uri, UNESCAPED_IN_PATHS).to_string();
        // What has percent signs already was encoded by the model's author.
        let encoded = Some(encoded).filter(|encoded| encoded != uri && !uri.contains('%'));
        Self { spelled, encoded }
    }

    /// All of them, the most likely first.
    pub(crate) fn all(&self) -> impl Iterator<Item = &str> {
        self.spelled.iter().chain(&self.encoded).map(String::as_str)
    }
}

/// Parses a reference, or returns why it is invalid.
pub(crate) fn parse_reference(uri: &str) -> Result<Reference, &'static str> {
    if uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
        return decode_data(&uri[5..]).map(Reference::Data);
    }
    Ok(Reference::Path(FileNames::of(uri)))
}

/// The reference as quoted in messages: never a megabyte of base64.
pub(crate) fn quotable(uri: &str) -> String {
    const LONGEST: usize = 100;
    if uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
        return "data: URI".to_owned();
    }
    let short: String = uri.chars().take(LONGEST).collect();
    if short.len() < uri.len() { format!("\"{short}…\"") } else { format!("\"{short}\"") }
}

fn decode_data(rest: &str) -> Result<Vec<u8>, &'static str> {
    let (head, body) = rest.split_once(',').ok_or("its data: URI has no comma")?;
    if !head.to_ascii_lowercase().ends_with(";base64") {
        return Ok(percent_decode_str(body).collect());
    }
    if !body.contains(['%', '\n', '\r', ' ', '\t']) {
        return BASE64.decode(body).map_err(|_| "its data: URI is not base64");
    }
    let bytes: Vec<u8> = percent_decode_str(body).filter(|byte| !byte.is_ascii_whitespace()).collect();
    BASE64.decode(bytes).map_err(|_| "its data: URI is not base64")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris_of_every_spelling_decode() {
        for uri in [
            "data:application/octet-stream;base64,AAEC/w==",
            "data:;base64,AAEC/w",
            "DATA:;BASE64,AA%45C/w==",
            "data:,%00%01%02%ff",
            "data:;base64,AAEC\n/w==",
        ] {
            assert_eq!(parse_reference(uri), Ok(Reference::Data(vec![0, 1, 2, 255])), "{uri}");
        }
    }

    #[test]
    fn broken_uris_are_refused_without_a_panic() {
        for uri in ["data:", "data:;base64", "data:;base64,####", "data:;base64,A"] {
            parse_reference(uri).expect_err(uri);
        }
    }

    #[test]
    fn a_path_may_be_encoded_or_not() {
        let names = |uri: &str| match parse_reference(uri) {
            Ok(Reference::Path(names)) => names.all().map(str::to_owned).collect::<Vec<_>>(),
            other => panic!("{uri}: {other:?}"),
        };
        assert_eq!(names("a%20b/%C3%A9.png"), ["a b/é.png", "a%20b/%C3%A9.png"], "decoded first");
        assert_eq!(names("a b.png"), ["a b.png", "a%20b.png"], "as it is, and then encoded");
        assert_eq!(names("%ff%fe.bin"), ["%ff%fe.bin"], "bytes that are no text are a name as it is");
        assert_eq!(names("100%.png"), ["100%.png"], "a percent sign alone");
        assert_eq!(names("a-b_c.d~/e"), ["a-b_c.d~/e"], "nothing to encode");
        assert_eq!(names("%2e%2e/x")[0], "../x", "to be refused by the folder");
    }

    #[test]
    fn long_uris_are_quoted_short() {
        assert!(quotable(&"é".repeat(1000)).len() < 300, "cut at a character");
        assert_eq!(quotable("data:;base64,AAAA"), "data: URI", "no base64 in messages");
    }
}
