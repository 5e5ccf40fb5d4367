//! Mode 0: elements as differences from the previous one, byte by byte, in groups of sixteen with as many bits as
//! needed. Filters turn them into the values that accessors describe.

use crate::formats::gltf::stream::Broken;
use crate::formats::gltf::stream::Stream;

/// Elements of a group.
const GROUP: usize = 16;
/// The maximum number of elements and of bytes of a block.
const BLOCK: usize = 256;
const BLOCK_BYTES: usize = 8192;

/// The two versions of the format.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Version {
    Zero,
    One,
}

impl Version {
    fn of(header: Option<&u8>) -> Result<Self, Broken> {
        match header {
            Some(0xa0) => Ok(Self::Zero),
            Some(0xa1) => Ok(Self::One),
            _ => Err("it does not begin as a list of attributes does"),
        }
    }

    /// The base element, the coding of channels, and before both their padding.
    fn tail(self, stride: usize) -> (usize, usize) {
        match self {
            Self::Zero => (stride.max(32), 0),
            Self::One => ((stride + stride / 4).max(24), stride / 4),
        }
    }
}

pub(super) fn decode(bytes: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, Broken> {
    let version = Version::of(bytes.first())?;
    let (tail_length, channel_bytes) = version.tail(stride);
    let (_, mut stream, tail) = Stream::open(bytes, tail_length)?;
    let (_, tail) = tail.split_at(tail.len() - stride - channel_bytes);
    let (baseline, modes) = tail.split_at(stride);
    let channels: Vec<ChannelMode> = match version {
        Version::Zero => vec![ChannelMode::Bytes; stride / 4],
        Version::One => modes.iter().map(|&mode| ChannelMode::new(mode)).collect::<Result<_, _>>()?,
    };
    let most = ((BLOCK_BYTES / stride) & !(GROUP - 1)).min(BLOCK);
    let mut previous = baseline.to_vec();
    let mut decoded = Vec::new();
    while decoded.len() < count * stride {
        let elements = (count - decoded.len() / stride).min(most);
        let deltas = read_block(&mut stream, version, elements, stride)?;
        add_up(&deltas, elements, &channels, &mut previous, &mut decoded);
    }
    stream.finish()?;
    Ok(decoded)
}

/// The deltas of a block: all elements' first bytes, then all second bytes …
fn read_block(
    stream: &mut Stream<'_>,
    version: Version,
    elements: usize,
    stride: usize,
) -> Result<Vec<u8>, Broken> {
    let groups = elements.div_ceil(GROUP);
    let control = match version {
        Version::Zero => &[],
        Version::One => stream.take(stride / 4)?,
    };
    let mut deltas = Vec::with_capacity(stride * groups * GROUP);
    for byte in 0..stride {
        let widths = match control.get(byte / 4).map(|modes| modes >> (byte % 4 * 2) & 3) {
            None => [0, 2, 4, 8],
            Some(0) => [0, 1, 2, 4],
            Some(1) => [1, 2, 4, 8],
            Some(2) => {
                deltas.resize(deltas.len() + groups * GROUP, 0);
                continue;
            }
            Some(_) => {
                deltas.extend_from_slice(stream.take(elements)?);
                deltas.resize((byte + 1) * groups * GROUP, 0);
                continue;
            }
        };
        let header = stream.take(groups.div_ceil(4))?;
        for group in 0..groups {
            let width = widths[usize::from(header[group / 4] >> (group % 4 * 2) & 3)];
            read_group(stream, width, &mut deltas)?;
        }
    }
    Ok(deltas)
}

/// Sixteen deltas with some bits each. One with all bits set stands for a byte after the group.
fn read_group(stream: &mut Stream<'_>, width: usize, deltas: &mut Vec<u8>) -> Result<(), Broken> {
    let packed = stream.take(GROUP * width / 8)?;
    let mut group = match width {
        0 => [0; GROUP],
        1 => unpacked::<1>(packed),
        2 => unpacked::<2>(packed),
        4 => unpacked::<4>(packed),
        _ => {
            deltas.extend_from_slice(packed);
            return Ok(());
        }
    };
    let escape = (1u8 << width) - 1;
    for delta in group.iter_mut().filter(|delta| width > 0 && **delta == escape) {
        *delta = stream.byte()?;
    }
    deltas.extend_from_slice(&group);
    Ok(())
}

fn unpacked<const WIDTH: usize>(packed: &[u8]) -> [u8; GROUP] {
    std::array::from_fn(|index| {
        let bit = index * WIDTH;
        // Single bits are stored from the lowest on, others from the highest.
        let shift = if WIDTH == 1 { bit % 8 } else { 8 - WIDTH - bit % 8 };
        packed[bit / 8] >> shift & ((1 << WIDTH) - 1)
    })
}

/// How four bytes of an element follow from those of the previous one.
#[derive(Clone, Copy)]
enum ChannelMode {
    /// Differences of bytes.
    Bytes,
    /// Differences of two 16-bit numbers.
    Words,
    /// The differing bits, which the encoder rotated to the left by this many.
    Bits(u32),
}

impl ChannelMode {
    fn new(mode: u8) -> Result<Self, Broken> {
        match (mode & 0xf, mode >> 4) {
            (0, 0) => Ok(Self::Bytes),
            (1, 0) => Ok(Self::Words),
            (2, rotation) => Ok(Self::Bits(u32::from(rotation))),
            _ => Err("the mode of a channel is unknown"),
        }
    }

    fn follow(self, previous: [u8; 4], delta: [u8; 4]) -> [u8; 4] {
        match self {
            Self::Bytes => {
                std::array::from_fn(|byte| previous[byte].wrapping_add(unzigzag_byte(delta[byte])))
            }
            Self::Words => {
                let word = |bytes: [u8; 4], at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
                let sum = |at| word(previous, at).wrapping_add(unzigzag_word(word(delta, at)));
                let ([a, b], [c, d]) = (sum(0).to_le_bytes(), sum(2).to_le_bytes());
                [a, b, c, d]
            }
            Self::Bits(rotation) => {
                let bits = u32::from_le_bytes(delta).rotate_right(rotation);
                (u32::from_le_bytes(previous) ^ bits).to_le_bytes()
            }
        }
    }
}

fn unzigzag_byte(value: u8) -> u8 {
    if value & 1 == 0 { value >> 1 } else { !(value >> 1) }
}

fn unzigzag_word(value: u16) -> u16 {
    if value & 1 == 0 { value >> 1 } else { !(value >> 1) }
}

/// Converts the deltas of a block to elements, channel by channel.
fn add_up(
    deltas: &[u8],
    elements: usize,
    channels: &[ChannelMode],
    previous: &mut [u8],
    decoded: &mut Vec<u8>,
) {
    let (pitch, stride, start) = (elements.div_ceil(GROUP) * GROUP, previous.len(), decoded.len());
    decoded.resize(start + elements * stride, 0);
    for (index, (channel, last)) in channels.iter().zip(previous.chunks_exact_mut(4)).enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|byte| &deltas[(4 * index + byte) * pitch..][..elements]);
        let mut value = [last[0], last[1], last[2], last[3]];
        for (at, element) in decoded[start..].chunks_exact_mut(stride).enumerate() {
            value = channel.follow(value, [a[at], b[at], c[at], d[at]]);
            element[4 * index..4 * index + 4].copy_from_slice(&value);
        }
        last.copy_from_slice(&value);
    }
}

/// Filters: from decoded attributes to the values that accessors describe.
///
/// Where the specification leaves a result open (an invalid encoding of 1), it is the result of the formula,
/// without a division by zero.
///
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
