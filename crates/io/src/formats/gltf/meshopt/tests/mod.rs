//! Streams written by hand and by an encoder of our own come back as they
//! were; streams of any bytes come back as errors.

mod encoder;
mod reference;

use proptest::prelude::*;

use super::*;
use encoder::{ChannelMode, encode_attributes, encode_indices, encode_triangles};

fn layout(mode: Mode, count: usize, stride: usize) -> Layout {
    Layout { mode, filter: Filter::None, count, stride }
}

fn words(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
}

#[test]
fn a_group_of_four_bit_deltas_is_read_as_the_specification_shows() {
    // The example of appendix A: sixteen deltas of the first byte; the other
    // three bytes do not change. Version 0, header bits 2 (four bits a delta).
    let group = [0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5];
    let mut stream = vec![0xa0, 2];
    stream.extend(group);
    stream.extend([0, 0, 0]);
    stream.extend([0; 32]);
    let decoded = decode(&layout(Mode::Attributes, 16, 4), &stream).expect("a stream");
    let deltas: [i8; 16] = [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0];
    let mut sum = 0u8;
    for (element, delta) in decoded.chunks_exact(4).zip(deltas) {
        sum = sum.wrapping_add_signed(delta);
        assert_eq!(element, [sum, 0, 0, 0], "the running sum");
    }
}

#[test]
fn every_code_of_triangles_is_read() {
    let table = [0x00, 0x12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    let stream = |codes: &[u8], data: &[u8]| [&[0xe1], codes, data, &table].concat();
    let decoded = |codes: &[u8], data: &[u8]| {
        decode(&layout(Mode::Triangles, 3 * codes.len(), 4), &stream(codes, data)).map(|bytes| words(&bytes))
    };
    // Three new vertices; the newest edge is (0, 2) … as (a, c).
    assert_eq!(decoded(&[0xf0], &[]), Ok(vec![0, 1, 2]), "all new, from the table");
    assert_eq!(decoded(&[0xf0, 0x00], &[]), Ok(vec![0, 1, 2, 0, 2, 3]), "an edge and a new one");
    assert_eq!(decoded(&[0xf0, 0x11], &[]), Ok(vec![0, 1, 2, 2, 1, 1]), "an edge and a recent one");
    assert_eq!(decoded(&[0xf0, 0xf1], &[]), Ok(vec![0, 1, 2, 3, 2, 1]), "a new one and two recent ones");
    assert_eq!(decoded(&[0xf0, 0x0f], &[14]), Ok(vec![0, 1, 2, 0, 2, 7]), "an edge and one written out");
    let beside = decoded(&[0xf0, 0x0f, 0x0d, 0x0e], &[14]);
    assert_eq!(beside, Ok(vec![0, 1, 2, 0, 2, 7, 0, 7, 6, 0, 6, 7]), "beside the last one");
    assert_eq!(decoded(&[0xf0, 0xff], &[0xff, 8, 3, 1]), Ok(vec![0, 1, 2, 4, 2, 1]), "all written out");
    assert_eq!(decoded(&[0xf0, 0xfe], &[0x00]), Ok(vec![0, 1, 2, 0, 1, 2]), "counting anew");
    assert_eq!(decoded(&[0xf0, 0xfe], &[0x1f, 8]), Ok(vec![0, 1, 2, 3, 2, 4]), "new, recent, written out");
    assert!(decoded(&[0x00], &[]).is_err(), "no edge yet");
    assert!(decoded(&[0xf1], &[]).is_err(), "no vertex yet");
    assert!(decoded(&[0xf0], &[1]).is_err(), "bytes left over");
    assert!(decoded(&[0xf0, 0x0f], &[]).is_err(), "too short");
}

#[test]
fn indices_follow_two_baselines() {
    // +1 on the first, +100 on the second, −1 on the first, +3 on the second.
    let stream = [0xd1, 1 << 2, 0x91, 0x03, 0x02, 3 << 2 | 1, 0, 0, 0, 0];
    assert_eq!(
        decode(&layout(Mode::Indices, 4, 2), &stream).map(|bytes| bytes.iter().step_by(2).copied().collect()),
        Ok(vec![1, 100, 0, 103]),
        "16 bits each"
    );
}

#[test]
fn claims_that_the_extension_forbids_are_refused() {
    let attributes = |stride, filter| Layout { filter, ..layout(Mode::Attributes, 1, stride) };
    for wrong in [
        attributes(0, Filter::None),
        attributes(6, Filter::None),
        attributes(260, Filter::None),
        attributes(12, Filter::Octahedral),
        attributes(4, Filter::Quaternion),
        layout(Mode::Triangles, 4, 4),
        layout(Mode::Indices, 1, 1),
        Layout { filter: Filter::Exponential, ..layout(Mode::Indices, 1, 4) },
    ] {
        assert!(decode(&wrong, &[0xa0; 64]).is_err(), "{wrong:?}");
    }
    let huge = layout(Mode::Attributes, usize::MAX / 256, 256);
    assert!(decode(&huge, &[0xa1; 400]).is_err(), "a claim alone takes no memory");
}

fn filtered(filter: Filter, stride: usize, words: &[i16]) -> Vec<i16> {
    let mut bytes: Vec<u8> = match stride {
        4 => words.iter().map(|&word| word as u8).collect(),
        _ => words.iter().flat_map(|word| word.to_le_bytes()).collect(),
    };
    filter.apply(&mut bytes, stride);
    match stride {
        4 => bytes.iter().map(|&byte| i16::from(byte as i8)).collect(),
        _ => bytes.chunks_exact(2).map(|word| i16::from_le_bytes([word[0], word[1]])).collect(),
    }
}

/// A unit vector on the octahedron, whose lower half is folded outwards
/// (Meyer et al., "On Floating-Point Normal Vectors", 2010).
fn octahedral([x, y, z]: [f64; 3], one: f64) -> [i16; 4] {
    let sum = x.abs() + y.abs() + z.abs();
    let (x, y) = (x / sum, y / sum);
    let (x, y) = if z < 0.0 { ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)) } else { (x, y) };
    [x, y, 1.0, 0.0].map(|component| (component * one).round() as i16)
}

#[test]
fn octahedral_vectors_become_unit_vectors() {
    for z in [-0.9, -0.5, -0.1, 0.1, 0.5, 0.9_f64] {
        for (x, y) in [(0.6, 0.8), (-0.6, 0.8), (0.28, -0.96), (-0.8, -0.6), (1.0, 0.0), (0.0, -1.0)] {
            let across = (1.0 - z * z).sqrt();
            let unit = [x * across, y * across, z];
            // Ten bits of the sixteen: off by half of 1/511 at most, more where the sides are steep.
            let decoded = filtered(Filter::Octahedral, 8, &octahedral(unit, 511.0));
            for (found, exact) in decoded.iter().zip(unit) {
                let off = f64::from(*found) / 32767.0 - exact;
                assert!(off.abs() < 2.0 / 511.0, "{exact} came back off by {off}");
            }
        }
    }
    assert_eq!(filtered(Filter::Octahedral, 4, &[127, 0, 127, 3]), [127, 0, 0, 3], "the last as it is");
    assert_eq!(filtered(Filter::Octahedral, 4, &[-7, 0, 7, 0]), [-127, 0, 0, 0], "in four bits");
    filtered(Filter::Octahedral, 4, &[0, 0, 0, 0]);
}

#[test]
fn quaternions_get_their_largest_component_back() {
    // A turn of 60° about y: (0, ½, 0, √¾); w is left out, which has the number 3.
    let one = (1 << 13) - 1;
    let scaled = (0.5 * f64::from(one) * std::f64::consts::SQRT_2).round() as i16;
    // After the largest, at 3, come x, y and z.
    let decoded = filtered(Filter::Quaternion, 8, &[0, scaled, 0, one & !3 | 3]);
    let exact = [0.0, 0.5, 0.0, 0.75_f64.sqrt()];
    for (found, exact) in decoded.iter().zip(exact) {
        assert!((f64::from(*found) / 32767.0 - exact).abs() < 2e-4, "{decoded:?}");
    }
}

#[test]
fn exponential_numbers_are_exact() {
    let coded = |exponent: i32, mantissa: i32| (exponent << 24 | mantissa & 0xff_ffff).to_le_bytes();
    let power = |exponent: u32| f32::from_bits((127 + exponent) << 23);
    let cases = [(0, 5, 5.0), (-3, -5, -0.625), (100, 1, power(100)), (-100, -1, -1.0 / power(100))];
    for (exponent, mantissa, value) in cases {
        let mut bytes = coded(exponent, mantissa);
        Filter::Exponential.apply(&mut bytes, 4);
        assert_eq!(f32::from_le_bytes(bytes), value, "{mantissa} · 2^{exponent}");
    }
}

#[test]
fn colors_come_back_from_luma_and_chroma() {
    // Six bits: r, g, b = 40, 20, 10 of 63; co = r − b, then halves.
    let (r, g, b) = (40, 20, 10);
    let (co, half) = ((r - b) / 2, (r + b) / 2);
    let cg = (g - half) / 2;
    let y = half + cg;
    let decoded = filtered(Filter::Color, 4, &[y, co, cg, 1 << 5 | 31]);
    let byte = |value: i16| (f64::from(value) * 255.0 / 63.0).round() as u8;
    let found: Vec<u8> = decoded.iter().map(|&component| component as u8).collect();
    let exact = [y + co - cg, y + cg, y - co - cg, 63].map(byte);
    assert_eq!(found, exact, "red, green, blue and opaque");
    assert!((i32::from(found[0]) - 162).abs() <= 4, "near the colour: {found:?}");
}

fn channel_mode() -> impl Strategy<Value = ChannelMode> {
    prop_oneof![Just(ChannelMode::Bytes), Just(ChannelMode::Words), (0..16u32).prop_map(ChannelMode::Bits)]
}

/// Bytes that change little, a lot, or not at all.
fn data() -> impl Strategy<Value = (Vec<u8>, Vec<ChannelMode>)> {
    (1..5usize, 1..600usize).prop_flat_map(|(channels, count)| {
        let step = prop_oneof![3 => Just(0u8), 3 => 0..4u8, 1 => any::<u8>()];
        let bytes = prop::collection::vec(step, channels * 4 * count).prop_map(move |mut steps| {
            for index in channels * 4..steps.len() {
                steps[index] = steps[index].wrapping_add(steps[index - channels * 4]);
            }
            steps
        });
        (bytes, prop::collection::vec(channel_mode(), channels))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn attributes_come_back((bytes, modes) in data()) {
        let stride = 4 * modes.len();
        let layout = layout(Mode::Attributes, bytes.len() / stride, stride);
        let old = encode_attributes(&bytes, stride, None);
        prop_assert_eq!(decode(&layout, &old), Ok(bytes.clone()), "version 0");
        let new = encode_attributes(&bytes, stride, Some(&modes));
        prop_assert_eq!(decode(&layout, &new), Ok(bytes), "version 1, {:?}", modes);
    }

    #[test]
    fn triangles_come_back(corners in prop::collection::vec(0..40u32, 0..300), grid in 2..12u32) {
        let whole = corners.len() / 3 * 3;
        let quad = |at: u32| [at, at + 1, at + grid, at + grid, at + 1, at + grid + 1];
        let ordered: Vec<u32> = (0..grid * 3).flat_map(quad).collect();
        for triangles in [&corners[..whole], &ordered] {
            let stream = encode_triangles(triangles);
            let decoded = decode(&layout(Mode::Triangles, triangles.len(), 4), &stream);
            prop_assert_eq!(decoded.map(|bytes| words(&bytes)), Ok(triangles.to_vec()));
        }
    }

    #[test]
    fn indices_come_back(indices in prop::collection::vec(0..1u32 << 29, 0..200)) {
        let decoded = decode(&layout(Mode::Indices, indices.len(), 4), &encode_indices(&indices));
        prop_assert_eq!(decoded.map(|bytes| words(&bytes)), Ok(indices));
    }

    #[test]
    fn any_bytes_are_decoded_or_refused(
        mut bytes in prop::collection::vec(any::<u8>(), 0..200),
        header in prop_oneof![Just(0xa0u8), Just(0xa1), Just(0xe1), Just(0xd1), any::<u8>()],
        count in 0..5000usize,
        stride in 0..80usize,
    ) {
        if let Some(first) = bytes.first_mut() {
            *first = header;
        }
        for mode in [Mode::Attributes, Mode::Triangles, Mode::Indices] {
            let filters =
                [Filter::None, Filter::Octahedral, Filter::Quaternion, Filter::Exponential, Filter::Color];
            for filter in filters {
                let layout = Layout { filter, ..layout(mode, count, stride) };
                if let Ok(decoded) = decode(&layout, &bytes) {
                    prop_assert_eq!(decoded.len(), count * stride, "all of it or nothing");
                }
            }
        }
    }
}

#[test]
fn triangles_come_in_threes() {
    let table = [0x00, 0x12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    let stream = [&[0xe1, 0xf0][..], &table].concat();
    for count in [1, 2, 4, 5] {
        let decoded = decode(&layout(Mode::Triangles, count, 4), &stream);
        assert_eq!(decoded, Err("the indices are not whole triangles"), "{count}");
    }
    assert!(decode(&layout(Mode::Triangles, 3, 4), &stream).is_ok(), "one triangle");
}
