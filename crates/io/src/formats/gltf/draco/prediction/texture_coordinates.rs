//! Predictions of texture coordinates: the triangle in the texture is similar to that in space.

use super::{Neighbours, last};
use crate::formats::gltf::broken::Broken;
use crate::formats::gltf::draco::budget::Budget;
use crate::formats::gltf::draco::corners::{NONE, next, previous};
use crate::formats::gltf::draco::failure::Failure;
use crate::formats::gltf::draco::rans::LikelyBits;
use crate::formats::gltf::stream::Stream;

/// Predictions from the positions of triangles.
pub(super) struct Turns<'m> {
    near: Neighbours<'m>,
    /// Of each triangle that is predicted from its positions: whether it is turned like that in
    /// space. The last is the first one's.
    turns: Vec<bool>,
}

impl<'m> Turns<'m> {
    pub(super) fn read(
        stream: &mut Stream<'_>,
        near: Neighbours<'m>,
        budget: &mut Budget,
    ) -> Result<Self, Failure> {
        let count = u32::from_le_bytes(stream.array()?) as usize;
        if count > near.order.corners.len() {
            return Err("it has more turned triangles than texture coordinates".into());
        }
        budget.spend(count)?;
        let mut bits = LikelyBits::open(stream)?;
        let mut turn = true;
        let turns = (0..count).map(|_| {
            turn ^= !bits.take();
            turn
        });
        Ok(Self { near, turns: turns.collect() })
    }

    pub(super) fn predict(&mut self, value: u32, known: &[i32], predicted: &mut [i32]) -> Result<(), Broken> {
        let corner = self.near.order.corners.get(value as usize).copied().unwrap_or(NONE);
        let ends = [next(corner), previous(corner)].map(|corner| self.near.value_at(corner));
        let find = |end: Option<u32>| known.get(2 * end? as usize..)?.first_chunk::<2>().copied();
        match ends.map(find) {
            [Some(from), Some(to)] if from == to => predicted.copy_from_slice(&from),
            [Some(from), Some(to)] => {
                let at = |end: Option<u32>| self.near.position_of(end.unwrap_or(NONE));
                let edge = Edge {
                    values: [from, to].map(|end| end.map(i64::from)),
                    positions: [at(ends[0])?, at(ends[1])?],
                };
                let tip = self.near.position_of(value)?;
                match edge.similar(tip, &mut self.turns)? {
                    Some(similar) => predicted.copy_from_slice(&similar),
                    None => predicted.copy_from_slice(&from),
                }
            }
            [Some(from), None] => predicted.copy_from_slice(&from),
            // Of the other end nothing is used: the value before is as good.
            [None, _] => last(known, predicted),
        }
        Ok(())
    }
}

/// The edge that faces a corner.
struct Edge {
    /// The texture coordinates at its ends.
    values: [[i64; 2]; 2],
    positions: [[i64; 3]; 2],
}

const TOO_FAR: Broken = "its texture coordinates are too far from each other";

impl Edge {
    /// The texture coordinates of the corner at a position; none if the edge has no length. Sums
    /// and products are taken modulo 2⁶⁴ where valid ones cannot be larger.
    fn similar(&self, tip: [i64; 3], turns: &mut Vec<bool>) -> Result<Option<[i32; 2]>, Broken> {
        let ([from, to], [start, end]) = (self.values, self.positions);
        let along = difference(end, start);
        let length2 = dot(along, along);
        if length2 == 0 {
            return Ok(None);
        }
        let share = dot(difference(tip, start), along);
        let across = difference(to, from);
        let fits = |factor: u64, list: &[i64]| {
            let largest = list.iter().map(|number| number.unsigned_abs()).max().unwrap_or(0);
            factor.checked_mul(largest).is_some_and(|product| i64::try_from(product).is_ok())
        };
        let steps = share.unsigned_abs();
        if !fits(length2.cast_unsigned(), &from) || !fits(steps, &across) || !fits(steps, &along) {
            return Err(TOO_FAR);
        }
        // All in units of 1 / length2: the foot of the corner on the edge, and from there to it.
        let foot: [i64; 2] = std::array::from_fn(|k| (from[k] * length2).wrapping_add(share * across[k]));
        let foot_position =
            std::array::from_fn(|k| start[k].wrapping_add((share * along[k]).wrapping_div(length2)));
        let height = difference(tip, foot_position);
        let height = dot(height, height).wrapping_mul(length2).cast_unsigned().isqrt().cast_signed();
        let up = [across[1].wrapping_mul(height), across[0].wrapping_neg().wrapping_mul(height)];
        let is_turned = turns.pop().ok_or("it has too few turned triangles")?;
        let add = if is_turned { i64::wrapping_add } else { i64::wrapping_sub };
        Ok(Some(std::array::from_fn(|k| add(foot[k], up[k]).wrapping_div(length2) as i32)))
    }
}

fn difference<const N: usize>(a: [i64; N], b: [i64; N]) -> [i64; N] {
    std::array::from_fn(|k| a[k].wrapping_sub(b[k]))
}

fn dot(a: [i64; 3], b: [i64; 3]) -> i64 {
    a.iter().zip(b).fold(0, |sum: i64, (a, b)| sum.wrapping_add(a.wrapping_mul(b)))
}
