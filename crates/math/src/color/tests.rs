//! The tables against the curve in `f64`, the encoder against a search, and the
//! edges of every range.

use glam::Vec4;

use super::*;

/// The curve, written out again in `f64`.
fn decode(value: f64) -> f64 {
    if value <= 0.04045 { value / 12.92 } else { elementary::pow((value + 0.055) / 1.055, 2.4) }
}

#[test]
fn the_decoding_table_is_the_curve() {
    for byte in 0..=255_u8 {
        let exact = decode(f64::from(byte) / 255.0);
        assert_eq!(srgb8_to_linear(byte), exact as f32, "byte {byte}");
    }
}

#[test]
fn every_threshold_separates_two_bytes_at_the_exact_half() {
    for (index, threshold) in THRESHOLDS.into_iter().enumerate() {
        let half = decode((index as f64 + 0.5) / 255.0);
        assert!(
            f64::from(threshold) >= half && f64::from(threshold.next_down()) < half,
            "threshold {index} is {threshold}, the curve says {half}"
        );
    }
}

#[test]
fn all_bytes_survive_the_round_trip() {
    for byte in 0..=255_u8 {
        assert_eq!(linear_to_srgb8(srgb8_to_linear(byte)), byte, "byte {byte}");
    }
}

/// What the cells accelerate: count the thresholds that are not above.
fn by_search(linear: f32) -> u8 {
    THRESHOLDS.iter().filter(|&&t| linear >= t).count() as u8
}

#[test]
fn the_encoder_equals_a_search_around_thresholds_and_cells() {
    let mut values: Vec<f32> = THRESHOLDS.to_vec();
    values.extend(
        (0..=CELL_COUNT as u32).map(|cell| f32::from_bits(SRGB8_LEAST.to_bits() + (cell << SRGB8_CELL_BITS))),
    );
    for value in values {
        for near in [value.next_down(), value, value.next_up()] {
            assert_eq!(linear_to_srgb8(near), by_search(near), "at {near}");
        }
    }
    for i in 0..134_464_u32 {
        let value = i as f32 / 99_991.0;
        assert_eq!(linear_to_srgb8(value), by_search(value), "at {value}");
    }
}

#[test]
fn what_is_no_colour_becomes_black_or_white() {
    let cases = [
        (f32::NAN, 0),
        (-f32::NAN, 0),
        (f32::INFINITY, 255),
        (f32::NEG_INFINITY, 0),
        (-1.0, 0),
        (-0.0, 0),
        (f32::from_bits(1), 0),
        (f32::MAX, 255),
        (1.0, 255),
        (1.0_f32.next_down(), 255),
    ];
    for (value, byte) in cases {
        assert_eq!(linear_to_srgb8(value), byte, "encoding {value}");
    }
    assert_eq!(unit_to_u8(f32::NAN), 0, "alpha of NaN");
    assert_eq!(unit_to_u8(f32::INFINITY), 255, "alpha of infinity");
    assert_eq!(unit_to_u8(-3.0), 0, "alpha below zero");
    assert_eq!(unit_to_u8(0.5), 128, "a tie goes up");
}

#[test]
fn the_float_curves_are_inverse_and_mirrored() {
    for i in -2000_i16..=2000 {
        let value = f32::from(i) / 1000.0;
        let back = linear_to_srgb(srgb_to_linear(value));
        assert!((back - value).abs() <= 3e-7, "{value} came back as {back}");
        assert_eq!(srgb_to_linear(-value), -srgb_to_linear(value), "mirrored");
    }
    assert!(srgb_to_linear(f32::NAN).is_nan(), "NaN stays NaN");
}

#[test]
fn alpha_is_multiplied_and_divided() {
    let straight = Vec4::new(0.5, 0.25, 1.0, 0.5);
    let colour = premultiplied(straight);
    assert_eq!(colour, Vec4::new(0.25, 0.125, 0.5, 0.5), "halved");
    assert_eq!(unpremultiplied(colour), straight, "and back");
    assert_eq!(
        unpremultiplied(Vec4::new(1.0, 1.0, 1.0, 0.0)),
        Vec4::ZERO,
        "nothing shows a colour without alpha"
    );
}

#[test]
fn four_bytes_survive_the_round_trip() {
    for byte in 0..=255_u8 {
        let bytes = [byte, 255 - byte, byte / 2, byte];
        assert_eq!(linear_to_srgba8(srgba8_to_linear(bytes)), bytes, "{bytes:?}");
    }
}
