//! Colour transfer: sRGB bytes to linear light and back.
//!
//! Decoding a byte reads a table. Encoding compares with 255 thresholds, each
//! the smallest `f32` that rounds to the next byte, so the result is the byte
//! nearest to the exact curve, on every machine, with no power function at run
//! time. The curve is that of IEC 61966-2-1 (sRGB).
//!
//! Colours as vectors hold red, green, blue, alpha. *Straight* colours have
//! independent alpha; *premultiplied* ones have the colour multiplied by it.

mod srgb_table;

use glam::Vec4;

use crate::elementary;
use srgb_table::{DECODED, THRESHOLDS};

/// Decodes an sRGB value to linear light, in `f64` and cast once.
///
/// Meant for `[0, 1]`. Above 1 the curve goes on; below 0 it is mirrored, so
/// that colours out of gamut survive. NaN stays NaN.
#[must_use]
pub fn srgb_to_linear(encoded: f32) -> f32 {
    let value = f64::from(encoded.abs());
    let linear = if value <= 0.04045 { value / 12.92 } else { elementary::pow((value + 0.055) / 1.055, 2.4) };
    (linear as f32).copysign(encoded)
}

/// Encodes linear light as an sRGB value, in `f64` and cast once.
///
/// Meant for `[0, 1]`. Above 1 the curve goes on; below 0 it is mirrored. NaN
/// stays NaN.
#[must_use]
pub fn linear_to_srgb(linear: f32) -> f32 {
    let value = f64::from(linear.abs());
    let encoded =
        if value <= 0.003_130_8 { value * 12.92 } else { 1.055 * elementary::pow(value, 1.0 / 2.4) - 0.055 };
    (encoded as f32).copysign(linear)
}

/// The linear light of an sRGB byte: the `f32` nearest to the exact curve.
#[must_use]
pub fn srgb8_to_linear(byte: u8) -> f32 {
    DECODED[usize::from(byte)]
}

/// The sRGB byte nearest to a linear value; the exact curve has no ties.
///
/// Values below 0 and NaN give 0, values above 1 and `+∞` give 255. Every byte
/// survives [`srgb8_to_linear`] and back.
#[must_use]
pub fn linear_to_srgb8(linear: f32) -> u8 {
    if linear >= THRESHOLDS[254] {
        return 255;
    }
    if linear < CELL_START || linear.is_nan() {
        return 0;
    }
    let cell = (linear.to_bits() - CELL_START.to_bits()) >> CELL_SHIFT;
    let below = CELLS[cell as usize];
    below + u8::from(linear >= THRESHOLDS[usize::from(below)])
}

/// Where the cells of the encoder begin: a power of two just below the first
/// threshold.
const CELL_START: f32 = 1.0 / 8192.0;
/// A cell is a run of `f32`s that agree in all but the last 16 bits: 1/128 of
/// an octave. No cell holds two thresholds, which the table's builder asserts.
const CELL_SHIFT: u32 = 16;
/// 13 octaves from 2⁻¹³ to 1.
const CELL_COUNT: usize = 13 << (23 - CELL_SHIFT);
/// For each cell, the byte of its first value.
static CELLS: [u8; CELL_COUNT] = cells();

/// Counts for each cell the thresholds at or below its first value.
const fn cells() -> [u8; CELL_COUNT] {
    let mut cells = [0; CELL_COUNT];
    let mut cell = 0;
    let mut below = 0;
    while cell < CELL_COUNT {
        let first = f32::from_bits(CELL_START.to_bits() + ((cell as u32) << CELL_SHIFT));
        let start = below;
        while below < THRESHOLDS.len() && THRESHOLDS[below] <= first {
            below += 1;
        }
        assert!(below <= start + 1, "two thresholds share a cell");
        cells[cell] = below as u8;
        cell += 1;
    }
    cells
}

/// The byte nearest to `value · 255`, ties up, for data that is no light
/// (alpha, masks).
///
/// Values below 0 and NaN give 0, values above 1 and `+∞` give 255.
#[must_use]
pub fn unit_to_u8(value: f32) -> u8 {
    // 24 bits times 8 bits is exact in f64, so is the half. The cast saturates
    // and takes NaN to 0.
    (f64::from(value) * 255.0 + 0.5) as u8
}

/// The linear, straight colour of four bytes: sRGB colour and plain alpha.
#[must_use]
pub fn srgba8_to_linear(bytes: [u8; 4]) -> Vec4 {
    let [red, green, blue, alpha] = bytes;
    Vec4::new(srgb8_to_linear(red), srgb8_to_linear(green), srgb8_to_linear(blue), f32::from(alpha) / 255.0)
}

/// The four bytes of a linear, straight colour: sRGB colour and plain alpha,
/// each as [`linear_to_srgb8`] and [`unit_to_u8`] round it.
#[must_use]
pub fn linear_to_srgba8(color: Vec4) -> [u8; 4] {
    [linear_to_srgb8(color.x), linear_to_srgb8(color.y), linear_to_srgb8(color.z), unit_to_u8(color.w)]
}

/// Multiplies the colour by its alpha: straight to premultiplied.
#[must_use]
pub fn premultiplied(straight: Vec4) -> Vec4 {
    (straight.truncate() * straight.w).extend(straight.w)
}

/// Divides the colour by its alpha: premultiplied to straight.
///
/// Alpha of zero, below zero or NaN gives transparent black, the only colour
/// that nothing shows.
#[must_use]
pub fn unpremultiplied(premultiplied: Vec4) -> Vec4 {
    if premultiplied.w > 0.0 {
        (premultiplied.truncate() / premultiplied.w).extend(premultiplied.w)
    } else {
        Vec4::ZERO
    }
}

#[cfg(test)]
mod tests;
