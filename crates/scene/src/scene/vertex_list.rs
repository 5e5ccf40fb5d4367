//! The vertices of a mesh that are shown as points. Of a dense mesh they are many, and while it is worked on
//! they stay the same from frame to frame.

use std::sync::Arc;

use fixedbitset::FixedBitSet;

use crate::marks::{self, Mark};
use crate::node::NodeId;

/// The vertices of a mesh at a node that are shown as points, with their marks. The lists are shared,
/// so that equal ones are recognized without a look at each vertex.
#[derive(Clone, Debug)]
pub(crate) struct VertexList {
    node: NodeId,
    used: Arc<Vec<bool>>,
    marks: Vec<Mark>,
    /// Increasing.
    pub(crate) points: Arc<Vec<u32>>,
    /// The number of the mark of each point, 0 without one.
    pub(crate) numbers: Arc<Vec<u8>>,
    /// The points that have a mark.
    pub(crate) marked: Arc<FixedBitSet>,
    /// For each point that it belongs to no face.
    pub(crate) no_face: Arc<Vec<u32>>,
}

impl VertexList {
    /// The used vertices, without those that a mark hides.
    pub(super) fn new(node: NodeId, used: &Arc<Vec<bool>>, marks: &[Mark]) -> Self {
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
        Self {
            node,
            used: Arc::clone(used),
            marks: marks.to_vec(),
            points: Arc::new(points),
            numbers: Arc::new(numbers),
            marked: Arc::new(marked),
            no_face,
        }
    }

    /// Whether it is known to be the list of other inputs. Sets are compared as what is shared.
    pub(super) fn is_of(&self, node: NodeId, used: &Arc<Vec<bool>>, marks: &[Mark]) -> bool {
        let are_same = |(own, other): (&Mark, &Mark)| {
            Arc::ptr_eq(&own.elements, &other.elements) && (own.opacity > 0.0) == (other.opacity > 0.0)
        };
        self.node == node
            && Arc::ptr_eq(&self.used, used)
            && self.marks.len() == marks.len()
            && self.marks.iter().zip(marks).all(are_same)
    }
}
