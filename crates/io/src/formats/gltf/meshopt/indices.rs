//! Mode 2: each index is a difference from one of two previous ones.

use crate::formats::gltf::broken::Broken;
use crate::formats::gltf::stream::{Stream, unzigzag};

const HEADER: u8 = 0xd1;
const TAIL: usize = 4;

pub(super) fn decode(bytes: &[u8], count: usize) -> Result<Vec<u32>, Broken> {
    let (header, mut stream, _) = Stream::open(bytes, TAIL)?;
    if header != HEADER {
        return Err("it does not begin as a sequence of indices does");
    }
    let mut last = [0u32; 2];
    // Not with the claimed capacity: each index takes at least one byte.
    let mut indices = Vec::with_capacity(count.min(stream.0.len()));
    for _ in 0..count {
        let code = stream.varint()?;
        let baseline = &mut last[(code & 1) as usize];
        *baseline = baseline.wrapping_add(unzigzag(code >> 1));
        indices.push(*baseline);
    }
    stream.finish()?;
    Ok(indices)
}
