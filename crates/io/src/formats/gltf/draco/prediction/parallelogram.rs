//! Predictions from the triangle across an edge: together with it a new corner makes a
//! parallelogram (Touma and Gotsman 1998).

use super::{Neighbours, last};
use crate::formats::gltf::broken::Broken;
use crate::formats::gltf::draco::budget::Budget;
use crate::formats::gltf::draco::corners::{NONE, next, previous};
use crate::formats::gltf::draco::failure::Failure;
use crate::formats::gltf::draco::rans::LikelyBits;
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
