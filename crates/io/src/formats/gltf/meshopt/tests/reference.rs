//! Streams of another implementation: `meshoptimizer-rs`, a port of meshoptimizer 1.3. It shares nothing with
//! our decoder or with the encoder of these tests.

use meshoptimizer_rs::codec::{
    ExpMode, IndexEncoding, VertexEncoding, decode_filter_color, decode_filter_exp, decode_filter_oct,
    decode_filter_quat, decode_index_buffer, decode_index_sequence, decode_vertex_buffer,
    encode_filter_color, encode_filter_exp, encode_filter_oct, encode_filter_quat, encode_index_buffer,
    encode_index_sequence, encode_vertex_buffer,
};
use meshoptimizer_rs::{Error, Limits, Workspace};

use super::*;

fn workspace() -> Workspace {
    Workspace::new(Limits::default())
}

/// Version 0, or version 1 at a level of compression; from level 3 on channels have rotated bits.
fn encoding() -> impl Strategy<Value = VertexEncoding> {
    let encoding = |version, level| VertexEncoding::new(version, level).expect("a version and a level");
    prop_oneof![Just(encoding(0, 0)), (0..4u8).prop_map(move |level| encoding(1, level))]
}

/// What the other implementation decodes.
fn expected(layout: &Layout, stream: &[u8]) -> Result<Vec<u8>, Error> {
    let Layout { count, stride, .. } = *layout;
    match layout.mode {
        Mode::Attributes => decode_vertex_buffer(count, stride, stream, &mut workspace()),
        Mode::Triangles => decode_index_buffer(count, stride, stream, &mut workspace()),
        Mode::Indices => decode_index_sequence(count, stride, stream, &mut workspace()),
    }
}

/// A stream of any mode, and its layout.
fn stream() -> impl Strategy<Value = (Layout, Vec<u8>)> {
    let attributes = (data(), encoding()).prop_map(|((bytes, modes), encoding)| {
        let (stride, count) = (4 * modes.len(), bytes.len() / (4 * modes.len()));
        let stream = encode_vertex_buffer(&bytes, count, stride, encoding, &mut workspace());
        (layout(Mode::Attributes, count, stride), stream.expect("whole elements"))
    });
    let numbers = || prop::collection::vec(prop_oneof![0..40u32, 0..100_000u32], 3..300);
    let triangles = numbers().prop_map(|mut corners| {
        corners.truncate(corners.len() / 3 * 3);
        let stream = encode_index_buffer(&corners, IndexEncoding::DEFAULT, &mut workspace());
        (layout(Mode::Triangles, corners.len(), 4), stream.expect("whole triangles"))
    });
    let indices = numbers().prop_map(|indices| {
        let stream = encode_index_sequence(&indices, IndexEncoding::DEFAULT, &mut workspace());
        (layout(Mode::Indices, indices.len(), 4), stream.expect("any indices"))
    });
    prop_oneof![attributes, triangles, indices]
}

/// The specification leaves open whether bits are rotated while they are encoded or decoded; meshoptimizer rotates them to
/// the left while it encodes.
#[test]
fn rotated_bits_were_rotated_once_more() {
    // One element of four bytes: the first as it is, the others zero. Then the padding, the base element and the mode.
    let stream = [&[0xa1, 0b10_10_10_11, 0x10], &[0; 19][..], &[0; 4], &[0x42]].concat();
    let layout = layout(Mode::Attributes, 1, 4);
    assert_eq!(expected(&layout, &stream), Ok(vec![1, 0, 0, 0]), "by the other implementation");
    assert_eq!(decode(&layout, &stream), Ok(vec![1, 0, 0, 0]), "0x10 rotated back by four bits");
}

/// Eight bits that cross the border of two bytes: the encoder rotates them into one.
#[test]
fn rotated_bits_of_another_encoder_come_back() {
    let numbers = (0..2000_u32).map(|index| index.wrapping_mul(2_654_435_761) >> 24 << 20);
    let bytes: Vec<u8> = numbers.flat_map(u32::to_le_bytes).collect();
    let level = VertexEncoding::new(1, 3).expect("a level");
    let stream = encode_vertex_buffer(&bytes, 2000, 4, level, &mut workspace()).expect("whole elements");
    let mode = stream[stream.len() - 1];
    assert!(mode & 0xf == 2 && mode >> 4 > 0, "rotated bits: {mode:#x}");
    assert_eq!(decode(&layout(Mode::Attributes, 2000, 4), &stream), Ok(bytes));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn streams_of_another_encoder_are_decoded((layout, stream) in stream()) {
        prop_assert_eq!(decode(&layout, &stream).ok(), expected(&layout, &stream).ok());
    }

    /// The other decoder accepts streams that the specification calls invalid: of unknown channel modes, of tables with
    /// codes that do not exist, and such as refer to vertices before the first one.
    #[test]
    fn damaged_streams_are_refused_or_give_the_same(
        (layout, mut stream) in stream(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
        cut in 0..40usize,
    ) {
        for (index, byte) in changes {
            *index.get_mut(&mut stream) = byte;
        }
        stream.truncate(stream.len() - cut.saturating_sub(20).min(stream.len()));
        let expected = expected(&layout, &stream);
        if let Ok(decoded) = decode(&layout, &stream) {
            prop_assert_eq!(Ok(decoded), expected);
        }
    }

    /// The specification allows a unit in the last place, except for exponential numbers.
    #[test]
    fn filters_agree_to_one_unit(
        parts in prop::collection::vec(-1.0..1.0f32, 32),
        bits in 4..=8u32,
        more_bits in 4..=16u32,
    ) {
        let length = |vector: &[f32]| vector.iter().map(|part| part * part).sum::<f32>().sqrt().max(0.1);
        let unit: Vec<f32> =
            parts.chunks(4).flat_map(|part| part.iter().map(|x| x / length(part)).collect::<Vec<_>>()).collect();
        let color: Vec<f32> = parts.iter().map(|part| part.abs()).collect();
        let of = &mut workspace();
        let cases = [
            (Filter::Octahedral, 4, encode_filter_oct(8, 4, bits, &unit, of)),
            (Filter::Octahedral, 8, encode_filter_oct(8, 8, more_bits, &unit, of)),
            (Filter::Quaternion, 8, encode_filter_quat(8, 8, more_bits, &unit, of)),
            (Filter::Exponential, 16, encode_filter_exp(8, 16, more_bits, &parts, ExpMode::Separate, of)),
            (Filter::Color, 4, encode_filter_color(8, 4, bits, &color, of)),
            (Filter::Color, 8, encode_filter_color(8, 8, more_bits, &color, of)),
        ];
        for (filter, stride, encoded) in cases {
            let mut found = encoded.expect("eight vectors");
            let mut expected = found.clone();
            filter.apply(&mut found, stride);
            match filter {
                Filter::Octahedral => decode_filter_oct(&mut expected, 8, stride, of),
                Filter::Quaternion => decode_filter_quat(&mut expected, 8, stride, of),
                Filter::Exponential => decode_filter_exp(&mut expected, 8, stride, of),
                Filter::Color => decode_filter_color(&mut expected, 8, stride, of),
                Filter::None => unreachable!("not in the list"),
            }.expect("eight elements");
            let numbers = |bytes: &[u8]| -> Vec<i32> {
                match (filter, stride) {
                    (Filter::Color, 4) => bytes.iter().map(|&byte| byte.into()).collect(),
                    (_, 4) => bytes.iter().map(|&byte| (byte as i8).into()).collect(),
                    (Filter::Color, _) => {
                        bytes.chunks(2).map(|word| u16::from_le_bytes([word[0], word[1]]).into()).collect()
                    }
                    _ => bytes.chunks(2).map(|word| i16::from_le_bytes([word[0], word[1]]).into()).collect(),
                }
            };
            let most = i32::from(filter != Filter::Exponential);
            for (found, expected) in numbers(&found).into_iter().zip(numbers(&expected)) {
                prop_assert!((found - expected).abs() <= most, "{:?}: {} for {}", filter, found, expected);
            }
        }
    }
}
