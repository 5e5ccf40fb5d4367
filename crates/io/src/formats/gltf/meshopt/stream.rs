//! A stream of bytes.

use super::broken::Broken;

/// The rest of a stream.
pub(super) struct Stream<'b>(pub(super) &'b [u8]);

impl<'b> Stream<'b> {
    /// Splits off the header byte at the front and a tail at the end.
    pub(super) fn open(bytes: &'b [u8], tail: usize) -> Result<(u8, Self, &'b [u8]), Broken> {
        let (&header, rest) = bytes.split_first().ok_or("it is empty")?;
        let middle = rest.len().checked_sub(tail).ok_or("it is too short for its tail")?;
        let (body, tail) = rest.split_at(middle);
        Ok((header, Self(body), tail))
    }

    pub(super) fn take(&mut self, count: usize) -> Result<&'b [u8], Broken> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or("it ends too early")?;
        self.0 = rest;
        Ok(taken)
    }

    pub(super) fn byte(&mut self) -> Result<u8, Broken> {
        Ok(self.take(1)?[0])
    }

    /// Unsigned LEB128 of at most five bytes; bits beyond 32 are ignored.
    pub(super) fn varint(&mut self) -> Result<u32, Broken> {
        let mut value = 0;
        for shift in [0, 7, 14, 21, 28] {
            let byte = self.byte()?;
            value |= u32::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err("a number has more than five bytes")
    }

    /// An error unless everything was read.
    pub(super) fn finish(self) -> Result<(), Broken> {
        if self.0.is_empty() { Ok(()) } else { Err("bytes are left over") }
    }
}

/// Decodes zigzag encoding: 0, −1, 1, −2 …, modulo 2³².
pub(super) fn unzigzag(value: u32) -> u32 {
    if value & 1 == 0 { value >> 1 } else { !(value >> 1) }
}
