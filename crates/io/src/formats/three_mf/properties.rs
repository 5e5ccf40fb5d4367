//! Properties of triangles: which items of which group their corners show, and colours.

use trigon_math::Vec4;
use trigon_math::color::srgba8_to_linear;

use super::model::TriangleProperty;

/// What a triangle shows (Core Specification, 4.1.5): its own group or that of its object, and of that its own items.
/// A corner that names none has that of the first; a triangle that names none has those of its object.
pub(super) fn resolve(
    default: TriangleProperty,
    group: Option<u32>,
    items: [Option<u32>; 3],
) -> TriangleProperty {
    match items {
        [None, ..] => default,
        [Some(first), second, third] => TriangleProperty {
            group: group.unwrap_or(default.group),
            items: [first, second.unwrap_or(first), third.unwrap_or(first)],
        },
    }
}

/// A colour of sRGB bytes as linear light.
pub(super) fn color(bytes: [u8; 4]) -> Vec4 {
    srgba8_to_linear(bytes)
}

/// `#RRGGBB` or `#RRGGBBAA`.
pub(super) fn display_color(text: &[u8]) -> Option<Vec4> {
    let digits = text.strip_prefix(b"#")?;
    if !matches!(digits.len(), 6 | 8) || !digits.iter().all(u8::is_ascii_hexdigit) {
        return None;
    }
    let mut bytes = [255; 4];
    for (byte, pair) in bytes.iter_mut().zip(digits.chunks_exact(2)) {
        *byte = u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok()?;
    }
    Some(color(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_have_items_of_the_triangle_or_of_the_object() {
        let default = TriangleProperty { group: 5, items: [2; 3] };
        let resolved = |group, items| {
            let TriangleProperty { group, items } = resolve(default, group, items);
            [vec![group], items.to_vec()].concat()
        };
        assert_eq!(resolved(None, [None; 3]), [5, 2, 2, 2], "the object's");
        assert_eq!(resolved(Some(7), [Some(1), None, None]), [7, 1, 1, 1], "one for all corners");
        assert_eq!(resolved(None, [Some(0), Some(1), Some(3)]), [5, 0, 1, 3], "in the object's group");
        assert_eq!(resolved(Some(7), [None; 3]), [5, 2, 2, 2], "a group alone says nothing");
    }

    #[test]
    fn colours_have_six_or_eight_digits() {
        let read = |text: &str| display_color(text.as_bytes());
        assert_eq!(read("#FF0000"), Some(Vec4::new(1.0, 0.0, 0.0, 1.0)), "opaque");
        assert_eq!(read("#00ff0033"), Some(Vec4::new(0.0, 1.0, 0.0, 0.2)), "with alpha, in lower case");
        for wrong in ["", "#", "FF0000", "#F00", "#FF00000", "#GG0000", "#+10000", "#ÿÿÿ"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
