//! A stream of compressed bytes, read from the front; numbers are little-endian.

/// The rest of a stream.
pub(crate) struct Stream<'b>(pub(crate) &'b [u8]);

impl<'b> Stream<'b> {
    /// Splits off the header byte at the front and a tail at the end.
    pub(crate) fn open(bytes: &'b [u8], tail: usize) -> Result<(u8, Self, &'b [u8]), Broken> {
        let (&header, rest) = bytes.split_first().ok_or("it is empty")?;
        let middle = rest.len().checked_sub(tail).ok_or("it is too short for its tail")?;
        let (body, tail) = rest.split_at(middle);
        Ok((header, Self(body), tail))
    }

    pub(crate) fn take(&mut self, count: usize) -> Result<&'b [u8], Broken> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(TOO_SHORT)?;
        self.0 = rest;
        Ok(taken)
    }

    /// The next bytes of a number.
    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N], Broken> {
        let (&taken, rest) = self.0.split_first_chunk().ok_or(TOO_SHORT)?;
        self.0 = rest;
        Ok(taken)
    }

    pub(crate) fn byte(&mut self) -> Result<u8, Broken> {
        Ok(self.array::<1>()?[0])
    }

    /// Unsigned LEB128 of at most five bytes; bits beyond 32 are ignored.
    pub(crate) fn varint(&mut self) -> Result<u32, Broken> {
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

    /// Bytes that a number before them counts.
    pub(crate) fn counted_bytes(&mut self) -> Result<&'b [u8], Broken> {
        let count = self.varint()?;
        self.take(count as usize)
    }

    /// An error unless everything was read.
    pub(crate) fn finish(self) -> Result<(), Broken> {
        if self.0.is_empty() { Ok(()) } else { Err("bytes are left over") }
    }
}

const TOO_SHORT: Broken = "it ends too early";

/// Decodes zigzag encoding: 0, −1, 1, −2 …, modulo 2³².
pub(crate) fn unzigzag(value: u32) -> u32 {
    if value & 1 == 0 { value >> 1 } else { !(value >> 1) }
}

/// Why compressed data is invalid.
pub(crate) type Broken = &'static str;
