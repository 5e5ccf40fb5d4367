//! The vertices of a mesh that are drawn as points.

use std::sync::Arc;

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use crate::marks::{self, Mark};
use crate::node::NodeId;

/// Vertices that a thread takes at a time.
const SHARE: usize = 1 << 14;

/// The vertices of a mesh at a node that are shown as points, with their marks. The lists are shared
/// with the last image, which compares them with those of the next.
pub(super) struct VertexList {
    /// Increasing.
    pub(super) points: Arc<Vec<u32>>,
    /// The number of the mark of each point, 0 without one.
    pub(super) numbers: Arc<Vec<u8>>,
    /// The points that have a mark.
    pub(super) marked: Arc<FixedBitSet>,
    /// Whether each point belongs to no face.
    pub(super) no_face: Arc<Vec<u32>>,
}

impl VertexList {
    /// The used vertices, without those that a mark hides.
    pub(super) fn new(node: NodeId, used: &[bool], marks: &[Mark]) -> Self {
        let (of_vertices, colors) = (marks::numbers(marks, node), marks::colors(marks));
        let starts: Vec<usize> = (0..used.len()).step_by(SHARE).collect();
        let shares = starts.into_par_iter().map(|start| {
            let share = start..used.len().min(start + SHARE);
            let (mut points, mut numbers) = (Vec::with_capacity(SHARE), Vec::with_capacity(SHARE));
            for vertex in share.filter(|&vertex| used[vertex]) {
                let number = of_vertices.get(vertex).copied().unwrap_or(0);
                if number == 0 || colors[usize::from(number)].w > 0.0 {
                    points.push(vertex as u32);
                    numbers.push(number);
                }
            }
            (points, numbers)
        });
        let (points, numbers): (Vec<Vec<u32>>, Vec<Vec<u8>>) = shares.unzip();
        let (points, numbers) = (points.concat(), numbers.concat());
        let word = |numbers: &[u8]| {
            numbers.iter().rev().fold(0, |word, &number| word << 1 | usize::from(number != 0))
        };
        let words = numbers.chunks(usize::BITS as usize).map(word);
        let marked = FixedBitSet::with_capacity_and_blocks(numbers.len(), words);
        let no_face = Arc::new(vec![u32::MAX; points.len()]);
        Self { points: Arc::new(points), numbers: Arc::new(numbers), marked: Arc::new(marked), no_face }
    }
}
