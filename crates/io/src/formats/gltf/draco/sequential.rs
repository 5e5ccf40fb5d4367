//! Triangles that are stored as indices.

use super::Stream;
use super::budget::Budget;
use super::failure::Failure;
use super::shape::Shape;
use super::symbols::read_symbols;
use crate::formats::gltf::broken::Broken;

pub(super) fn read_triangles(stream: &mut Stream<'_>, budget: &mut Budget) -> Result<Shape, Failure> {
    let (faces, points) = (stream.varint()? as usize, stream.varint()?);
    // The smallest index takes a byte, compressed ones less.
    let corners = faces.checked_mul(3).ok_or("it has too many triangles")?;
    budget.spend(corners)?;
    budget.spend(points as usize)?;
    let triangles = match stream.byte()? {
        0 => differences(&read_symbols(stream, corners, 1, budget)?),
        1 => read_plain(stream, corners, points)?,
        _ => return Err(Failure::Foreign("indices of an unknown kind")),
    };
    if triangles.iter().any(|&point| point >= points) {
        return Err("an index is beyond its points".into());
    }
    Ok(Shape { points: points as usize, triangles, tables: None })
}

/// Indices of which each is stored as the difference to the one before, with its sign in the
/// lowest bit.
fn differences(symbols: &[u32]) -> Vec<u32> {
    let add = |last: &mut u32, &symbol: &u32| {
        let size = symbol >> 1;
        *last = if symbol & 1 == 0 { last.wrapping_add(size) } else { last.wrapping_sub(size) };
        Some(*last)
    };
    symbols.iter().scan(0, add).collect()
}

/// Indices in as many bytes as the number of points needs.
fn read_plain(stream: &mut Stream<'_>, corners: usize, points: u32) -> Result<Vec<u32>, Broken> {
    if corners > stream.0.len() {
        return Err("it has more triangles than bytes for them");
    }
    let read = |_| {
        Ok(match points {
            0..=0xff => u32::from(stream.byte()?),
            0x100..=0xffff => u32::from(u16::from_le_bytes(stream.array()?)),
            0x1_0000..=0x1f_ffff => stream.varint()?,
            _ => u32::from_le_bytes(stream.array()?),
        })
    };
    (0..corners).map(read).collect()
}
