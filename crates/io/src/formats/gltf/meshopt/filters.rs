//! Filters: from decoded attributes to the values that accessors describe.
//!
//! Where the specification leaves a result open (an invalid encoding of 1), it is the result of the
//! formula, without a division by zero.

/// A filter of the extension.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Filter {
    /// Bytes as they are.
    #[default]
    None,
    /// Unit vectors.
    Octahedral,
    /// Unit quaternions.
    Quaternion,
    /// Floating-point numbers of any precision.
    Exponential,
    /// Colours as luma and two chromas.
    Color,
}

impl Filter {
    /// The filter with a name; `None` for an unknown one.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        match name {
            "NONE" => Some(Self::None),
            "OCTAHEDRAL" => Some(Self::Octahedral),
            "QUATERNION" => Some(Self::Quaternion),
            "EXPONENTIAL" => Some(Self::Exponential),
            "COLOR" => Some(Self::Color),
            _ => None,
        }
    }

    /// Whether elements may have this many bytes.
    pub(super) fn fits(self, stride: usize) -> bool {
        match self {
            Self::None | Self::Exponential => stride.is_multiple_of(4),
            Self::Octahedral | Self::Color => stride == 4 || stride == 8,
            Self::Quaternion => stride == 8,
        }
    }

    pub(super) fn apply(self, bytes: &mut [u8], stride: usize) {
        match (self, stride) {
            (Self::None, _) => {}
            (Self::Exponential, _) => bytes.chunks_exact_mut(4).for_each(exponential),
            (Self::Octahedral, 4) => {
                each_of_bytes(bytes, |v| octahedral(v.map(|c| i32::from(c as i8)), 127.0));
            }
            (Self::Octahedral, _) => {
                each_of_words(bytes, |v| octahedral(v.map(|c| i32::from(c as i16)), 32767.0));
            }
            (Self::Quaternion, _) => each_of_words(bytes, |v| quaternion(v.map(|c| i32::from(c as i16)))),
            (Self::Color, 4) => each_of_bytes(bytes, |[y, co, cg, alpha]| {
                color(y.into(), i32::from(co as i8), i32::from(cg as i8), alpha.into(), 255.0)
            }),
            (Self::Color, _) => each_of_words(bytes, |[y, co, cg, alpha]| {
                color(y.into(), i32::from(co as i16), i32::from(cg as i16), alpha.into(), 65535.0)
            }),
        }
    }
}

/// Changes four components of a byte each.
fn each_of_bytes(bytes: &mut [u8], change: impl Fn([u8; 4]) -> [i32; 4]) {
    for element in bytes.chunks_exact_mut(4) {
        let changed = change([element[0], element[1], element[2], element[3]]);
        element.copy_from_slice(&changed.map(|component| component as u8));
    }
}

/// Changes four components of two bytes each.
fn each_of_words(bytes: &mut [u8], change: impl Fn([u16; 4]) -> [i32; 4]) {
    for element in bytes.chunks_exact_mut(8) {
        let word = |index: usize| u16::from_le_bytes([element[2 * index], element[2 * index + 1]]);
        let changed = change([0, 1, 2, 3].map(word));
        for (to, component) in element.chunks_exact_mut(2).zip(changed) {
            to.copy_from_slice(&(component as u16).to_le_bytes());
        }
    }
}

/// The nearest integer, halves away from zero; in range for all callers. 0 for what is no number.
fn rounded(value: f64) -> i32 {
    (if value < 0.0 { value - 0.5 } else { value + 0.5 }) as i32
}

fn octahedral([x, y, one, rest]: [i32; 4], most: f64) -> [i32; 4] {
    let one = f64::from(if one == 0 { 1 } else { one });
    let (mut x, mut y) = (f64::from(x) / one, f64::from(y) / one);
    let z = 1.0 - x.abs() - y.abs();
    // The lower half is folded outwards.
    let fold = if z < 0.0 { z } else { 0.0 };
    x -= fold.copysign(x);
    y -= fold.copysign(y);
    let length = (x * x + y * y + z * z).sqrt();
    let unit = |value: f64| rounded(value / length * most);
    [unit(x), unit(y), unit(z), rest]
}

fn quaternion([x, y, z, last]: [i32; 4]) -> [i32; 4] {
    let scale = std::f64::consts::FRAC_1_SQRT_2 / f64::from(last | 3);
    let parts = [x, y, z].map(|component| f64::from(component) * scale);
    let square = 1.0 - parts.iter().map(|part| part * part).sum::<f64>();
    let largest = if square > 0.0 { square.sqrt() } else { 0.0 };
    let at = (last & 3) as usize;
    let mut result = [0; 4];
    result[at] = rounded(largest * 32767.0);
    for (step, part) in parts.into_iter().enumerate() {
        result[(at + step + 1) % 4] = rounded(part * 32767.0);
    }
    result
}

fn exponential(bytes: &mut [u8]) {
    let coded = i32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let (exponent, mantissa) = (coded >> 24, coded << 8 >> 8);
    // A power of two from −128 to 127 is a normal f64, made from its bits.
    let power = f64::from_bits(((1023 + i64::from(exponent)) as u64) << 52);
    let value = (power * f64::from(mantissa)) as f32;
    bytes.copy_from_slice(&value.to_le_bytes());
}

fn color(y: i32, co: i32, cg: i32, alpha: i32, most: f64) -> [i32; 4] {
    // The highest bit of alpha gives the number of bits of the others.
    let bits = 32 - alpha.leading_zeros();
    let largest = (1i32 << bits) - 1;
    let scale = if largest > 0 { most / f64::from(largest) } else { 0.0 };
    let half = alpha & (largest >> 1);
    let channels = [y + co - cg, y + cg, y - co - cg, half << 1 | (half & 1)];
    channels.map(|channel| rounded(f64::from(channel) * scale))
}
