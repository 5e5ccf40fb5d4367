//! Why an operation did nothing.

use thiserror::Error;
use trigon_math::DVec3;

use super::ids::{CornerId, EdgeId, FaceId, VertexId};

/// Why an operation was refused. The mesh is as it was before.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Refusal {
    /// There is no such vertex (any more).
    #[error("there is no {0}: it was removed, or never made")]
    NoSuchVertex(VertexId),
    /// There is no such edge (any more).
    #[error("there is no {0}: it was removed, or never made")]
    NoSuchEdge(EdgeId),
    /// There is no such corner (any more).
    #[error("there is no {0}: it was removed, or never made")]
    NoSuchCorner(CornerId),
    /// There is no such face (any more).
    #[error("there is no {0}: it was removed, or never made")]
    NoSuchFace(FaceId),
    /// There is no vertex group of this name.
    #[error("there is no vertex group \"{0}\" in the mesh: add it first, or choose another")]
    NoSuchGroup(String),
    /// There is a vertex group of this name already.
    #[error("there is a vertex group \"{0}\" already: choose another name")]
    GroupExists(String),
    /// The operation needs elements, and none were given.
    #[error("{operation} needs {needed}: select them first")]
    NothingGiven {
        /// What was to be done.
        operation: &'static str,
        /// What it needs, as "at least one face".
        needed: &'static str,
    },
    /// What was given does not fit together.
    #[error("{operation} is not possible here: {reason}")]
    NotPossible {
        /// What was to be done.
        operation: &'static str,
        /// What is in the way, and what to do instead.
        reason: &'static str,
    },
    /// A parameter is out of its range, or not finite.
    #[error("{parameter} is {value}, but must be {range}")]
    OutOfRange {
        /// Which.
        parameter: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed, as "at least 1".
        range: &'static str,
    },
    /// A mesh does not bound a volume.
    #[error("{operation} needs closed meshes whose faces look outwards: {fault} near {}", position_in_words(*position))]
    NotSolid {
        /// What was to be done.
        operation: &'static str,
        /// What is wrong, and what to do.
        fault: SolidFault,
        /// Where, in metres in the space of the mesh.
        position: DVec3,
    },
    /// A vertex would lie farther away than its coordinates can say.
    #[error("{0} would lie beyond 3.4e38, the largest number of a coordinate: use a smaller value")]
    Overflow(VertexId),
    /// The mesh would take more memory than is allowed.
    #[error(
        "the mesh would take {} of memory, and {} are allowed: do it to a part of it, or raise the setting `memory`",
        in_words(*needed),
        in_words(*allowed)
    )]
    Memory {
        /// What the mesh would take, in bytes: an estimate before anything is done.
        needed: u64,
        /// What it may take, in bytes.
        allowed: u64,
    },
    /// The mesh would have more elements than 32-bit indices can name.
    #[error("the mesh would have too many elements for 32-bit indices: do it to a part of it")]
    TooMany,
}

/// Why a mesh does not bound a volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SolidFault {
    /// A hole begins at an edge.
    #[error("fill the hole at {0}, or merge vertices by distance,")]
    Open(EdgeId),
    /// Faces at an edge look in different directions.
    #[error("recalculate the normals of the faces at {0}, which look different ways,")]
    Turned(EdgeId),
    /// A face of a part that looks inwards.
    #[error("recalculate the normals of the part with {0}, which looks inwards,")]
    InsideOut(FaceId),
}

/// A position as a user reads it.
fn position_in_words(position: DVec3) -> String {
    format!("({:.4}, {:.4}, {:.4})", position.x, position.y, position.z)
}

/// Bytes as a user reads them, as "1.5 GiB".
fn in_words(bytes: u64) -> String {
    let mebibytes = bytes as f64 / f64::from(1 << 20);
    if mebibytes < 1024.0 { format!("{mebibytes:.1} MiB") } else { format!("{:.1} GiB", mebibytes / 1024.0) }
}
