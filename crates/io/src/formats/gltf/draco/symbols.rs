//! Lists of numbers, of which some are more likely. They are coded by range asymmetric numeral systems (Duda
//! 2013), in a fractional number of bits, or as numbers of any number of bits. A budget bounds what decoding
//! may cost, and a failure says why a mesh is not decoded.

use crate::formats::gltf::stream::Broken;
use crate::formats::gltf::stream::Stream;

/// How the numbers are stored.
const TAGGED: u8 = 0;
const RAW: u8 = 1;

/// The precision of tags.
const TAG_PRECISION: u32 = 12;

/// Reads numbers, in groups that have the same number of bits.
pub(super) fn read_symbols(
    stream: &mut Stream<'_>,
    count: usize,
    group: usize,
    budget: &mut Budget,
) -> Result<Vec<u32>, Failure> {
    budget.spend(count)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    match stream.byte()? {
        TAGGED => read_tagged(stream, count, group, budget),
        RAW => read_raw(stream, count, budget),
        _ => Err(Failure::Foreign("symbols of an unknown kind")),
    }
}

/// Each group has a tag, which is the number of bits of its numbers.
fn read_tagged(
    stream: &mut Stream<'_>,
    count: usize,
    group: usize,
    budget: &mut Budget,
) -> Result<Vec<u32>, Failure> {
    let table = SymbolTable::read(stream, TAG_PRECISION, budget)?;
    let mut tags = table.open(stream.counted_bytes()?)?;
    let mut bits = Bits::new(stream.0);
    let mut numbers = Vec::with_capacity(count);
    while numbers.len() < count {
        let width = table.take(&mut tags);
        for _ in 0..group {
            numbers.push(bits.take(width)?);
        }
    }
    stream.0 = bits.rest();
    Ok(numbers)
}

fn read_raw(stream: &mut Stream<'_>, count: usize, budget: &mut Budget) -> Result<Vec<u32>, Failure> {
    let width = u32::from(stream.byte()?);
    if !(1..=18).contains(&width) {
        return Err("its symbols have an impossible number of bits".into());
    }
    let table = SymbolTable::read(stream, (3 * width / 2).clamp(12, 20), budget)?;
    let mut symbols = table.open(stream.counted_bytes()?)?;
    Ok((0..count).map(|_| table.take(&mut symbols)).collect())
}

/// How likely each symbol is.
struct SymbolTable {
    precision_bits: u32,
    /// The share of each symbol, and the sum of those before it.
    shares: Vec<(u32, u32)>,
    /// The symbol of each state.
    symbols: Vec<u32>,
}

impl SymbolTable {
    fn read(stream: &mut Stream<'_>, precision_bits: u32, budget: &mut Budget) -> Result<Self, Failure> {
        let count = stream.varint()? as usize;
        // A byte stands for at most 64 symbols.
        if count / 64 > stream.0.len() {
            return Err("it has more symbols than bytes for them".into());
        }
        let states = 1_usize << precision_bits;
        budget.spend(2 * count + states)?;
        let (mut shares, mut symbols) = (Vec::with_capacity(count), Vec::with_capacity(states));
        while shares.len() < count {
            let first = stream.byte()?;
            if first & 3 == 3 {
                // A run of symbols that do not occur.
                let end = shares.len() + usize::from(first >> 2) + 1;
                shares.resize(end, (0, symbols.len() as u32));
                continue;
            }
            let share = read_share(stream, first)?;
            if share as usize > states - symbols.len() {
                return Err(WRONG_SUM.into());
            }
            let symbol = shares.len() as u32;
            shares.push((share, symbols.len() as u32));
            symbols.resize(symbols.len() + share as usize, symbol);
        }
        if shares.len() > count || symbols.len() < states {
            return Err(WRONG_SUM.into());
        }
        Ok(Self { precision_bits, shares, symbols })
    }

    fn open<'b>(&self, bytes: &'b [u8]) -> Result<Rans<'b>, Broken> {
        Rans::open(bytes, 4 << self.precision_bits)
    }

    fn take(&self, rans: &mut Rans<'_>) -> u32 {
        let symbol = self.symbols[rans.fill(self.precision_bits) as usize];
        let (share, before) = self.shares[symbol as usize];
        rans.advance(self.precision_bits, share, before);
        symbol
    }
}

const WRONG_SUM: Broken = "the shares of its symbols do not make a whole";

/// A share of one to three bytes; the lowest bits of the first are how many follow it.
fn read_share(stream: &mut Stream<'_>, first: u8) -> Result<u32, Broken> {
    let mut share = u32::from(first >> 2);
    for byte_index in 0..u32::from(first & 3) {
        share |= u32::from(stream.byte()?) << (8 * byte_index + 6);
    }
    Ok(share)
}

/// Range asymmetric numeral systems (Duda 2013): numbers in a fractional number of bits.
///
/// The state is a large number whose lower part names the next symbol. Bytes are read from the end to the
/// front. When they run out the state only shrinks, so that decoding never fails.
///
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

/// Bits of a stream; the lowest bit of each byte is the first.
pub(super) struct Bits<'b> {
    bytes: &'b [u8],
    /// The number of bits that were read.
    read: usize,
}

impl<'b> Bits<'b> {
    pub(super) fn new(bytes: &'b [u8]) -> Self {
        Self { bytes, read: 0 }
    }

    /// A number of at most 32 bits, the lowest first.
    pub(super) fn take(&mut self, count: u32) -> Result<u32, Broken> {
        let end = self.read + count as usize;
        if count > 32 || end > self.bytes.len().saturating_mul(8) {
            return Err("its bits end too early");
        }
        let mut window = [0; 8];
        let rest = &self.bytes[self.read / 8..];
        let here = rest.len().min(8);
        window[..here].copy_from_slice(&rest[..here]);
        let value = (u64::from_le_bytes(window) >> (self.read % 8)) & ((1 << count) - 1);
        self.read = end;
        Ok(value as u32)
    }

    /// The bytes after the last bit that was read.
    pub(super) fn rest(&self) -> &'b [u8] {
        &self.bytes[self.read.div_ceil(8)..]
    }
}

/// A word is about what one number of a mesh takes, in memory or in time. Meshes that were
/// exported take 5 to 30 words per byte of their stream; large flat grids take up to 200.
const WORDS_PER_BYTE: u64 = 256;

/// The allowance for small files: 512 MiB.
const WORDS_ALWAYS: u64 = 1 << 27;

/// Counts what decoding costs, in words of four bytes. All meshes of a file share one, since a
/// file may refer to the same few bytes thousands of times.
#[derive(Default)]
pub(crate) struct Budget {
    spent: u64,
    limit: u64,
}

impl Budget {
    /// Sets the limit to what a file of some size may cost.
    pub(crate) fn allow(&mut self, file_bytes: usize) {
        self.limit = (file_bytes as u64).saturating_mul(WORDS_PER_BYTE).max(WORDS_ALWAYS);
    }

    /// Counts words that are about to be allocated or visited.
    pub(super) fn spend(&mut self, words: usize) -> Result<(), Failure> {
        self.spent = self.spent.saturating_add(words as u64);
        if self.spent <= self.limit { Ok(()) } else { Err(Failure::TooLarge) }
    }
}

/// Why a mesh is not decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// The stream is invalid.
    Broken(Broken),
    /// It is of a kind that is not read.
    Foreign(&'static str),
    /// It stands for more than the [`Budget`] allows.
    TooLarge,
}

impl From<Broken> for Failure {
    fn from(broken: Broken) -> Self {
        Self::Broken(broken)
    }
}
