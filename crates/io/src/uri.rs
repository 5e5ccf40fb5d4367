//! The two kinds of reference that glTF uses and trigon follows: `data:` URIs
//! and percent-encoded relative paths (RFC 2397, RFC 3986).

use base64::Engine;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;

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
    /// A path, decoded, not yet checked.
    Path(String),
}

/// Parses a reference, or returns why it is invalid.
pub(crate) fn parse_reference(uri: &str) -> Result<Reference, &'static str> {
    if uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
        return decode_data(&uri[5..]).map(Reference::Data);
    }
    let decoded = percent_decode_str(uri).decode_utf8().map_err(|_| "its percent-encoding is not UTF-8")?;
    Ok(Reference::Path(decoded.into_owned()))
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
        for uri in ["data:", "data:;base64", "data:;base64,####", "%ff%fe.bin", "data:;base64,A"] {
            parse_reference(uri).expect_err(uri);
        }
    }

    #[test]
    fn paths_are_decoded() {
        assert_eq!(
            parse_reference("a%20b/%C3%A9.png"),
            Ok(Reference::Path("a b/é.png".to_owned())),
            "decoded"
        );
        assert_eq!(
            parse_reference("%2e%2e/x"),
            Ok(Reference::Path("../x".to_owned())),
            "to be refused by the folder"
        );
    }

    #[test]
    fn long_uris_are_quoted_short() {
        assert!(quotable(&"é".repeat(1000)).len() < 300, "cut at a character");
        assert_eq!(quotable("data:;base64,AAAA"), "data: URI", "no base64 in messages");
    }
}
