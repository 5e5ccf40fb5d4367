//! The vertices of a mesh that are drawn as points.

use std::sync::Arc;

use fixedbitset::FixedBitSet;

use crate::marks::{self, Mark};
use crate::node::NodeId;

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
        let count = used.iter().filter(|&&used| used).count();
        let (mut points, mut numbers) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut marked = FixedBitSet::with_capacity(count);
        for (vertex, _) in (0_u32..).zip(used.iter()).filter(|(_, used)| **used) {
            let number = of_vertices.get(vertex as usize).copied().unwrap_or(0);
            if number != 0 {
                if colors[usize::from(number)].w <= 0.0 {
                    continue;
                }
                marked.insert(points.len());
            }
            points.push(vertex);
            numbers.push(number);
        }
        let no_face = Arc::new(vec![u32::MAX; points.len()]);
        Self { points: Arc::new(points), numbers: Arc::new(numbers), marked: Arc::new(marked), no_face }
    }
}
