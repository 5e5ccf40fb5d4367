//! Range asymmetric numeral systems (Duda 2013): numbers in a fractional number of bits.
//!
//! The state is a large number whose lower part names the next symbol. Bytes are read from the end
//! to the front. When they run out the state only shrinks, so that decoding never fails.

use crate::formats::gltf::broken::Broken;
use crate::formats::gltf::stream::Stream;

/// The state.
pub(super) struct Rans<'b> {
    state: u32,
    /// At least this, as long as there are bytes; a power of 2 of at most 2²².
    base: u32,
    /// The bytes that are not read.
    bytes: &'b [u8],
}

impl<'b> Rans<'b> {
    /// Starts at the end of some bytes: the last one says how many hold the first state.
    pub(super) fn open(bytes: &'b [u8], base: u32) -> Result<Self, Broken> {
        let last = *bytes.last().ok_or("its symbols have no bytes")?;
        let size = usize::from(last >> 6) + 1;
        let start = bytes.len().checked_sub(size).ok_or("its symbols end too early")?;
        let mut word = [0; 4];
        word[..size].copy_from_slice(&bytes[start..]);
        let state = u32::from_le_bytes(word) & ((1 << (8 * size - 2)) - 1);
        // The highest byte is read once the state is below the base.
        let state = state.checked_add(base).filter(|state| state / 256 < base);
        Ok(Self {
            state: state.ok_or("its symbols start with too large a state")?,
            base,
            bytes: &bytes[..start],
        })
    }

    /// The lower bits of the state, which name the next symbol.
    pub(super) fn fill(&mut self, precision_bits: u32) -> u32 {
        while self.state < self.base
            && let Some((&last, rest)) = self.bytes.split_last()
        {
            self.state = self.state << 8 | u32::from(last);
            self.bytes = rest;
        }
        self.state & ((1 << precision_bits) - 1)
    }

    /// Removes a symbol from the state: its share of all states, and the sum of those before it.
    pub(super) fn advance(&mut self, precision_bits: u32, share: u32, before: u32) {
        let rest = self.state & ((1 << precision_bits) - 1);
        // At most the state, since the share is at most all states.
        self.state = (self.state >> precision_bits) * share + rest - before;
    }
}

/// The states that a bit has.
const BIT_PRECISION: u32 = 8;

/// Bits of which one value is more likely.
pub(super) struct LikelyBits<'b> {
    rans: Rans<'b>,
    /// The share of ones, of 256.
    ones: u32,
}

impl<'b> LikelyBits<'b> {
    pub(super) fn open(stream: &mut Stream<'b>) -> Result<Self, Broken> {
        let zeros = u32::from(stream.byte()?);
        Ok(Self { rans: Rans::open(stream.counted_bytes()?, 1 << 12)?, ones: (1 << BIT_PRECISION) - zeros })
    }

    pub(super) fn take(&mut self) -> bool {
        let (all, ones) = (1 << BIT_PRECISION, self.ones);
        let is_one = self.rans.fill(BIT_PRECISION) < ones;
        let (share, before) = if is_one { (ones, 0) } else { (all - ones, ones) };
        self.rans.advance(BIT_PRECISION, share, before);
        is_one
    }
}
