//! Colour transfer: sRGB bytes to linear light and back.
//!
//! Decoding a byte reads a table. Encoding compares with 255 thresholds, each the smallest `f32` that rounds to
//! the next byte. So the result is the byte nearest to the exact curve, on every machine, with no power function
//! at run time. The curve is that of IEC 61966-2-1 (sRGB).
//!
//! Colours as vectors hold red, green, blue, alpha. *Straight* colours have
//! independent alpha; *premultiplied* ones have the colour multiplied by it.

mod srgb_table;

use glam::Vec4;

use crate::elementary;
use srgb_table::{DECODED, THRESHOLDS};

/// Decodes an sRGB value to linear light, in `f64` and cast once.
///
/// Intended for `[0, 1]`. Above 1 the curve continues; below 0 it is mirrored, so that out-of-gamut
/// colours survive. NaN stays NaN.
#[must_use]
pub fn srgb_to_linear(encoded: f32) -> f32 {
    let value = f64::from(encoded.abs());
    let linear = if value <= 0.04045 { value / 12.92 } else { elementary::pow((value + 0.055) / 1.055, 2.4) };
    (linear as f32).copysign(encoded)
}

/// Encodes linear light as an sRGB value, in `f64` and cast once.
///
/// Intended for `[0, 1]`. Above 1 the curve continues; below 0 it is mirrored. NaN stays NaN.
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
    // The comparison is false for NaN.
    let linear = if linear > SRGB8_LEAST { linear } else { SRGB8_LEAST };
    let bits = linear.min(SRGB8_GREATEST).to_bits() - SRGB8_LEAST.to_bits();
    ((srgb8_cell(bits >> SRGB8_CELL_BITS) + bits % (1 << SRGB8_CELL_BITS)) >> SRGB8_CELL_BITS) as u8
}

/// The value that represents all smaller ones in [`srgb8_cell`]: a power of two just below the
/// first threshold.
pub const SRGB8_LEAST: f32 = 1.0 / 8192.0;
/// The value that represents all greater ones: the last below 1.
pub const SRGB8_GREATEST: f32 = 1.0 - f32::EPSILON / 2.0;
/// The number of low bits ignored within a cell, which is 1/128 of an octave. No cell contains two
/// thresholds, which the table's builder asserts.
pub const SRGB8_CELL_BITS: u32 = 16;
/// 13 octaves from 2⁻¹³ to 1.
const CELL_COUNT: usize = 13 << (23 - SRGB8_CELL_BITS);
/// Large enough that a remainder stays inside.
const PADDED_CELL_COUNT: usize = CELL_COUNT.next_power_of_two();
static CELLS: [u32; PADDED_CELL_COUNT] = cells();

/// For encoding several values at once: with `bits` the bits of a value between [`SRGB8_LEAST`] and
/// [`SRGB8_GREATEST`] minus those of `SRGB8_LEAST`, its byte is `(srgb8_cell(bits >> 16) + bits %
/// (1 << 16)) >> 16`, with [`SRGB8_CELL_BITS`] for 16.
///
/// ```
/// use trigon_math::color::{SRGB8_LEAST, linear_to_srgb8, srgb8_cell};
///
/// let bits = 0.5_f32.to_bits() - SRGB8_LEAST.to_bits();
/// assert_eq!((srgb8_cell(bits >> 16) + bits % (1 << 16)) >> 16, 188);
/// assert_eq!(linear_to_srgb8(0.5), 188);
/// ```
#[must_use]
#[inline]
pub fn srgb8_cell(cell: u32) -> u32 {
    CELLS[cell as usize % PADDED_CELL_COUNT]
}

/// For each cell the byte of its first value in the upper half of a number. The lower half is what
/// the last bits of a threshold in the cell need for a carry; 0 if there is none.
const fn cells() -> [u32; PADDED_CELL_COUNT] {
    const CARRY: u32 = 1 << SRGB8_CELL_BITS;
    let mut cells = [0; PADDED_CELL_COUNT];
    let mut cell = 0;
    let mut below = 0;
    while cell < CELL_COUNT {
        let first = SRGB8_LEAST.to_bits() + ((cell as u32) << SRGB8_CELL_BITS);
        while below < THRESHOLDS.len() && THRESHOLDS[below].to_bits() <= first {
            below += 1;
        }
        cells[cell] = (below as u32) << SRGB8_CELL_BITS;
        if below < THRESHOLDS.len() && THRESHOLDS[below].to_bits() < first + CARRY {
            cells[cell] += CARRY - (THRESHOLDS[below].to_bits() - first);
            let next = below + 1;
            let is_alone = next == THRESHOLDS.len() || THRESHOLDS[next].to_bits() >= first + CARRY;
            assert!(is_alone, "two thresholds share a cell");
        }
        cell += 1;
    }
    cells
}

/// The byte nearest to `value · 255`, ties up, for data other than light (alpha, masks).
///
/// Values below 0 and NaN give 0, values above 1 and `+∞` give 255.
#[must_use]
pub fn unit_to_u8(value: f32) -> u8 {
    // . 24 bits times 8 bits is exact in f64, and so is the half. The cast saturates and maps NaN
    // to 0.
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
/// Alpha of zero, below zero or NaN gives transparent black, the only colour without a visible
/// effect.
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
