//! The byte stream of a capture: numbers are little-endian, floats their bits.

use std::io::{BufRead, BufReader, Read};

use flate2::read::ZlibDecoder;
use trigon_scene::Scene;

use super::ids::Ids;
use crate::limits::Limits;

/// Receives the parts of a capture, uncompressed.
pub(super) struct Writer<'a> {
    pub(super) bytes: Vec<u8>,
    /// Ids are written relative to the existing items of this.
    pub(super) scene: &'a Scene,
}

/// Returns them.
pub(super) struct Reader<'a> {
    stream: BufReader<ZlibDecoder<&'a [u8]>>,
    /// The remaining memory budget in bytes.
    left: u64,
    pub(super) limits: &'a Limits,
    /// What has been read so far, for ids.
    pub(super) ids: Ids,
}

/// Why a part cannot be read.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Damage {
    /// The parts are inconsistent or invalid.
    Malformed(String),
    /// A limit is exceeded.
    Limit(String),
}

impl Damage {
    pub(super) fn malformed(what: impl Into<String>) -> Self {
        Self::Malformed(what.into())
    }
}

impl<'a> Reader<'a> {
    /// Reads compressed parts. Their memory is limited by that for all files of a model.
    pub(super) fn new(compressed: &'a [u8], limits: &'a Limits) -> Self {
        let stream = BufReader::new(ZlibDecoder::new(compressed));
        Self { stream, left: limits.total_bytes, limits, ids: Ids::default() }
    }

    pub(super) fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Damage> {
        let mut bytes = [0; N];
        self.stream.read_exact(&mut bytes).map_err(|_| Damage::malformed("it ends too early"))?;
        Ok(bytes)
    }

    /// The number of items that follow, each of which takes this many bytes of memory.
    pub(super) fn count(&mut self, each: usize) -> Result<usize, Damage> {
        let count = u64::from_le_bytes(self.bytes()?);
        let wanted = count.checked_mul(each.max(1) as u64).filter(|&wanted| wanted <= self.left);
        let wanted = wanted.ok_or_else(|| {
            let allowed = self.limits.total_bytes;
            Damage::Limit(format!("{count} items of {each} bytes are more than the {allowed} bytes allowed"))
        })?;
        self.left -= wanted;
        usize::try_from(count).map_err(|_| Damage::malformed("a list is too large for memory"))
    }

    /// This many bytes in a row, already counted. Memory is allocated as they arrive.
    pub(super) fn run(&mut self, length: usize) -> Result<Vec<u8>, Damage> {
        let mut bytes = Vec::new();
        let read = (&mut self.stream).take(length as u64).read_to_end(&mut bytes);
        match read {
            Ok(read) if read == length => Ok(bytes),
            _ => Err(Damage::malformed("it ends too early")),
        }
    }

    /// Whether nothing follows.
    pub(super) fn is_at_end(&mut self) -> bool {
        self.stream.fill_buf().is_ok_and(<[u8]>::is_empty)
    }

    /// Whether everything has been read, including the checksum.
    pub(super) fn finish(mut self) -> Result<(), Damage> {
        match self.stream.read(&mut [0]) {
            Ok(0) => Ok(()),
            _ => Err(Damage::malformed("more follows where it should end")),
        }
    }
}
