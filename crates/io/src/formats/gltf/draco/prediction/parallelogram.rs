//! Predictions from the triangle across an edge. A new corner makes a parallelogram with it (Touma and Gotsman 1998);
//! for texture coordinates the triangle in the texture is similar to that in space.

use super::{Neighbours, last};
use crate::formats::gltf::draco::corners::{NONE, next, previous};
use crate::formats::gltf::draco::symbols::{Budget, Failure, LikelyBits};
use crate::formats::gltf::stream::Broken;
use crate::formats::gltf::stream::Stream;

/// The maximum number of parallelograms of which the mean is taken.
const MOST: usize = 4;

/// Predicts a value across the edge that its first corner faces, or the value before.
pub(super) fn predict(near: Neighbours<'_>, value: u32, known: &[i32], predicted: &mut [i32]) {
    let corner = near.order.corners.get(value as usize).copied().unwrap_or(NONE);
    if value == 0 || !complete(near, corner, known, predicted) {
        last(known, predicted);
    }
}

/// Completes the parallelogram at a corner; false if not all of the other three are known.
fn complete(near: Neighbours<'_>, corner: u32, known: &[i32], completed: &mut [i32]) -> bool {
    let across = near.table.opposite(corner);
    let group = completed.len();
    let find = |corner: u32| {
        let start = near.value_at(corner)? as usize * group;
        known.get(start..start + group)
    };
    let (Some(tip), Some(one), Some(other)) = (find(across), find(next(across)), find(previous(across)))
    else {
        return false;
    };
    for (completed, ((tip, one), other)) in completed.iter_mut().zip(tip.iter().zip(one).zip(other)) {
        *completed = one.wrapping_add(*other).wrapping_sub(*tip);
    }
    true
}

/// Predictions from all parallelograms at a vertex.
pub(super) struct Creases<'m> {
    near: Neighbours<'m>,
    /// By the number of parallelograms: whether each of them is across a crease, in the order in
    /// which they are found.
    creases: [std::vec::IntoIter<bool>; MOST],
    /// Room for the parallelograms.
    found: Vec<i32>,
}

impl<'m> Creases<'m> {
    pub(super) fn read(
        stream: &mut Stream<'_>,
        near: Neighbours<'m>,
        budget: &mut Budget,
    ) -> Result<Self, Failure> {
        let mut creases: [std::vec::IntoIter<bool>; MOST] = Default::default();
        for creases in &mut creases {
            let count = stream.varint()? as usize;
            if count > near.table.vertices.len() {
                return Err("it has more creases than edges".into());
            }
            budget.spend(count)?;
            if count > 0 {
                let mut bits = LikelyBits::open(stream)?;
                *creases = (0..count).map(|_| bits.take()).collect::<Vec<bool>>().into_iter();
            }
        }
        Ok(Self { near, creases, found: Vec::new() })
    }

    pub(super) fn predict(&mut self, value: u32, known: &[i32], predicted: &mut [i32]) -> Result<(), Broken> {
        let group = predicted.len();
        self.found.clear();
        if value > 0 {
            self.find_all(value, known, predicted);
        }
        let mut used = 0;
        predicted.fill(0);
        if let Some(context) = (self.found.len() / group).checked_sub(1) {
            for found in self.found.chunks_exact(group) {
                if self.creases[context].next().ok_or("it has too few creases")? {
                    continue;
                }
                used += 1;
                for (sum, found) in predicted.iter_mut().zip(found) {
                    *sum = sum.wrapping_add(*found);
                }
            }
        }
        match used {
            0 => last(known, predicted),
            _ => predicted.iter_mut().for_each(|sum| *sum /= used),
        }
        Ok(())
    }

    /// Completes the parallelograms around the vertex of a value, until there are enough.
    fn find_all(&mut self, value: u32, known: &[i32], completed: &mut [i32]) {
        let start = self.near.order.corners.get(value as usize).copied().unwrap_or(NONE);
        for corner in self.near.table.around(start) {
            if complete(self.near, corner, known, completed) {
                self.found.extend_from_slice(completed);
                if self.found.len() == MOST * completed.len() {
                    break;
                }
            }
        }
    }
}

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
