//! What computes booleans of triangle meshes, behind a trait, so that it can be replaced.

use trigon_math::DVec3;

use super::operation::BooleanOperation;

/// A triangle, counter-clockwise seen from outside, and the patch that it is a part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PatchTriangle {
    /// Indices of vertices.
    pub(super) vertices: [u32; 3],
    /// The number of the patch: a number of the caller's, below 2³¹.
    pub(super) patch: u32,
}

/// Triangles that bound a volume: every edge is run along equally often in both directions.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PatchedTriangles {
    /// The vertices, in metres.
    pub(super) positions: Vec<DVec3>,
    pub(super) triangles: Vec<PatchTriangle>,
}

/// Combines volumes.
///
/// The result is bounded by pieces of the operands' triangles, each with the patch of the triangle that it is a piece
/// of. Pieces of what is subtracted are turned over. Vertices of the operands that are vertices of the result keep
/// their positions to the last bit. Where boundaries of two operands coincide, the pieces have the patch of either.
/// The same operands give the same result on every machine.
pub(super) trait BooleanKernel {
    /// The first volume without the others, all together, or what is common to all. A volume whose boundary crosses
    /// itself is what its boundary winds around at least once.
    fn combine(
        &self,
        operands: &[PatchedTriangles],
        operation: BooleanOperation,
    ) -> Result<PatchedTriangles, KernelFault>;
}

/// Why a kernel has no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum KernelFault {
    /// An operand, or the result, is not closed.
    NotClosed,
    /// There are more triangles than it has numbers for.
    TooLarge,
    /// A fault of the kernel itself.
    Failed,
}
