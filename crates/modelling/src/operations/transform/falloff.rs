//! Proportional falloff: vertices near the moved ones move by a fraction.

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::along_edges::distances_along_edges;
use super::nearest::NearestPoints;
use crate::edit_mesh::EditMesh;
use crate::ids::VertexId;
use crate::refusal::Refusal;

/// How far a movement reaches beyond the moved vertices, and how it fades. Hidden vertices never
/// follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Falloff {
    /// How it fades with distance.
    pub shape: FalloffShape,
    /// In metres, above 0: from this distance on nothing moves.
    pub radius: f64,
    /// How distance is measured.
    pub distance: FalloffDistance,
}

impl Default for Falloff {
    /// Smooth over one metre, straight.
    fn default() -> Self {
        Self { shape: FalloffShape::Smooth, radius: 1.0, distance: FalloffDistance::Straight }
    }
}

/// The curve of a falloff. With `x` from 1 (at a moved vertex) to 0 (at the radius):
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FalloffShape {
    /// 3x² − 2x³
    Smooth,
    /// √(2x − x²), a quarter of a circle
    Sphere,
    /// √x
    Root,
    /// x²
    Sharp,
    /// x
    Linear,
    /// 1
    Constant,
}

/// The distance of a vertex to the nearest moved one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FalloffDistance {
    /// In a straight line, whether the mesh is connected there or not.
    Straight,
    /// On the shortest path along edges: only what is connected follows. On a grid this is up to
    /// √2 times the straight distance.
    AlongEdges,
}

impl FalloffShape {
    /// The fraction of the movement, 1 to 0, at a distance given as a fraction of the radius.
    #[must_use]
    pub fn weight(self, share: f64) -> f64 {
        // Also without a distance nothing moves.
        let x = if share < 1.0 { (1.0 - share).min(1.0) } else { 0.0 };
        match self {
            Self::Smooth => x * x * (3.0 - 2.0 * x),
            Self::Sphere => (x * (2.0 - x)).sqrt(),
            Self::Root => x.sqrt(),
            Self::Sharp => x * x,
            Self::Linear => x,
            Self::Constant if x > 0.0 => 1.0,
            Self::Constant => 0.0,
        }
    }
}

/// What moves, and how much of the way: the vertices in ascending order.
pub(in crate::operations) struct Weighted {
    pub(in crate::operations) vertices: Vec<VertexId>,
    pub(in crate::operations) weights: Vec<f64>,
}

impl Falloff {
    /// All vertices that move when some, in ascending order, move wholly.
    pub(in crate::operations) fn weigh(
        &self,
        mesh: &EditMesh,
        moved: &[VertexId],
    ) -> Result<Weighted, Refusal> {
        if !(self.radius > 0.0 && self.radius.is_finite()) {
            let (parameter, range) = ("the radius of the falloff", "above 0 and finite");
            return Err(Refusal::OutOfRange { parameter, value: self.radius, range });
        }
        let mut is_moved = FixedBitSet::with_capacity(mesh.vertex_capacity());
        for vertex in moved {
            is_moved.insert(vertex.0 as usize);
        }
        let parts = match self.distance {
            FalloffDistance::Straight => self.weigh_straight(mesh, moved, &is_moved),
            FalloffDistance::AlongEdges => {
                let distances = distances_along_edges(mesh, moved, &is_moved, self.radius);
                let distance = |index: u32| distances[index as usize];
                self.weigh_by(mesh, &is_moved, || distance)
            }
        };
        let (vertices, weights) = parts.into_iter().flatten().unzip();
        Ok(Weighted { vertices, weights })
    }

    fn weigh_straight(
        &self,
        mesh: &EditMesh,
        moved: &[VertexId],
        is_moved: &FixedBitSet,
    ) -> Vec<Vec<(VertexId, f64)>> {
        let tree = NearestPoints::new(moved.iter().map(|&vertex| mesh.position(vertex)).collect());
        self.weigh_by(mesh, is_moved, || {
            let mut search = tree.search();
            move |index| search.distance(mesh.positions[index], self.radius)
        })
    }

    /// The weights of all vertices that move, in pieces; each piece measures with a function of its own.
    fn weigh_by<M>(
        &self,
        mesh: &EditMesh,
        is_moved: &FixedBitSet,
        measure: impl Fn() -> M + Sync,
    ) -> Vec<Vec<(VertexId, f64)>>
    where
        M: FnMut(u32) -> f64,
    {
        /// Vertices in a piece: enough to hide what handing one to a thread costs.
        const PIECE: usize = 1 << 13;
        let weigh_piece = |(piece, positions): (usize, &[trigon_math::Vec3])| {
            let mut distance = measure();
            let first = (piece * PIECE) as u32;
            let mut found = Vec::new();
            for vertex in (first..first + positions.len() as u32).map(VertexId) {
                if is_moved.contains(vertex.0 as usize) {
                    found.push((vertex, 1.0));
                } else if mesh.has_vertex(vertex) && !mesh.is_vertex_hidden(vertex) {
                    let weight = self.shape.weight(distance(vertex.0) / self.radius);
                    if weight > 0.0 {
                        found.push((vertex, weight));
                    }
                }
            }
            found
        };
        mesh.positions.values().par_chunks(PIECE).enumerate().map(weigh_piece).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_curve_falls_from_all_to_nothing() {
        let half = |shape: FalloffShape| shape.weight(0.5);
        use FalloffShape::{Constant, Linear, Root, Sharp, Smooth, Sphere};
        assert_eq!([Smooth, Sharp, Linear, Constant].map(half), [0.5, 0.25, 0.5, 1.0], "half way");
        assert_eq!([Sphere, Root].map(half), [0.75f64.sqrt(), 0.5f64.sqrt()], "half way");
        for shape in [Smooth, Sphere, Root, Sharp, Linear, Constant] {
            assert_eq!(
                (shape.weight(0.0), shape.weight(1.0), shape.weight(7.0)),
                (1.0, 0.0, 0.0),
                "{shape:?}"
            );
            let weights: Vec<f64> = (0..=100).map(|i| shape.weight(f64::from(i) / 100.0)).collect();
            assert!(weights.is_sorted_by(|a, b| a >= b), "{shape:?} never rises");
            assert_eq!(shape.weight(f64::NAN), 0.0, "no distance, no movement");
        }
    }
}
