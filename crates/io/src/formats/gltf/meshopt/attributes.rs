//! Mode 0: elements as differences from the previous one, byte by byte, in groups of sixteen with
//! as many bits as needed.

use crate::formats::gltf::broken::Broken;
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
    let channels: Vec<Channel> = match version {
        Version::Zero => vec![Channel::Bytes; stride / 4],
        Version::One => modes.iter().map(|&mode| Channel::new(mode)).collect::<Result<_, _>>()?,
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
enum Channel {
    /// Differences of bytes.
    Bytes,
    /// Differences of two 16-bit numbers.
    Words,
    /// The differing bits, which the encoder rotated to the left by this many.
    Bits(u32),
}

impl Channel {
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
fn add_up(deltas: &[u8], elements: usize, channels: &[Channel], previous: &mut [u8], decoded: &mut Vec<u8>) {
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
