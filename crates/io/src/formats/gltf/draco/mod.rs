//! Draco: the mesh compression of KHR_draco_mesh_compression. Written from its "Draco Bitstream
//! Specification" (Google, version 2.2), and where that is silent, from how Google's own decoder
//! numbers points: other data of a primitive may rely on their order.
//!
//! A stream holds the triangles and then the attributes:
//!
//! 1. `header` reads the kind of the mesh and passes over metadata.
//! 2. `sequential` reads triangles that are stored as indices. `edgebreaker` rebuilds triangles that are stored as
//!    a walk, with the symbols of `walk`, into a table of `corners`. `seams` splits that table for attributes that
//!    are discontinuous, and `points` numbers the vertices of the result.
//! 3. `attributes` reads the values, in the order given by `order`. `prediction` adds to the stored
//!    corrections what their neighbours let expect.
//!
//! `symbols`, `rans` and `bits` are the entropy coding below all of them. Every read is checked. A
//! few bytes may stand for millions of equal symbols: a `Budget` bounds the memory and the time.
//!
//! The results have the bytes of Google's decoder (`tests/draco`). The crate `draco-oxide-decoder` is not used: it
//! would bring 58 other crates, a minute of compilation and `unsafe`.

mod attributes;
mod bits;
mod budget;
mod corners;
mod edgebreaker;
mod failure;
mod header;
mod order;
mod points;
mod prediction;
mod rans;
mod seams;
mod sequential;
mod shape;
mod symbols;
mod values;
mod walk;

use super::stream::Stream;
pub(crate) use attributes::DecodedAttribute;
pub(crate) use budget::Budget;
pub(crate) use failure::Failure;
use header::Method;

/// A decoded mesh.
pub(crate) struct DecodedMesh {
    /// How many points it has: every attribute has one value for each.
    pub(crate) points: usize,
    /// Three points each.
    pub(crate) triangles: Vec<u32>,
    pub(crate) attributes: Vec<DecodedAttribute>,
}

/// Decodes a mesh.
pub(crate) fn decode(bytes: &[u8], budget: &mut Budget) -> Result<DecodedMesh, Failure> {
    let mut stream = Stream(bytes);
    let method = header::read_header(&mut stream)?;
    let shape = match method {
        Method::Sequential => sequential::read_triangles(&mut stream, budget)?,
        Method::Edgebreaker => edgebreaker::read_triangles(&mut stream, budget)?,
    };
    let attributes = attributes::read_attributes(&mut stream, &shape, budget)?;
    Ok(DecodedMesh { points: shape.points, triangles: shape.triangles, attributes })
}

#[cfg(test)]
mod tests;
