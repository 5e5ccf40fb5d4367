//! Lists of numbers, of which some are more likely.

use super::bits::Bits;
use super::budget::Budget;
use super::failure::Failure;
use super::rans::Rans;
use crate::formats::gltf::broken::Broken;
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
