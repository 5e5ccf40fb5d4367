//! Numbers of any number of bits.

use crate::formats::gltf::broken::Broken;

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
