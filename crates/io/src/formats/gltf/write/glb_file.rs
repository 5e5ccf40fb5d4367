//! The GLB container: a header, the JSON, and the bytes of the buffer (glTF 2.0 specification,
//! section 4.4).

use std::borrow::Cow;
use std::io::{self, Write};

/// A GLB in parts.
pub(crate) struct GlbFile<'a> {
    /// Padded to 4 bytes.
    pub(crate) json: Vec<u8>,
    pub(crate) segments: Vec<Cow<'a, [u8]>>,
    /// The total size of the segments.
    pub(crate) binary: usize,
}

impl GlbFile<'_> {
    /// Of the file and its two chunks.
    pub(crate) const HEADERS: usize = 12 + 8 + 8;

    pub(crate) fn write_to(&self, writer: &mut dyn Write) -> io::Result<()> {
        let has_binary = self.binary > 0;
        let without = if has_binary { 0 } else { 8 };
        let length = Self::HEADERS - without + self.json.len() + self.binary;
        let word = |value: usize| (value as u32).to_le_bytes();
        writer.write_all(b"glTF\x02\0\0\0")?;
        writer.write_all(&word(length))?;
        writer.write_all(&word(self.json.len()))?;
        writer.write_all(b"JSON")?;
        writer.write_all(&self.json)?;
        if has_binary {
            writer.write_all(&word(self.binary))?;
            writer.write_all(b"BIN\0")?;
            for segment in &self.segments {
                writer.write_all(segment)?;
            }
        }
        Ok(())
    }

    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(Self::HEADERS + self.json.len() + self.binary);
        self.write_to(&mut bytes).expect("memory takes every byte");
        bytes
    }
}
