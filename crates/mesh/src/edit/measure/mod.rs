//! Measures of what is edited: normals, areas, lengths, angles, bounds, volume.

mod faces;
mod lengths;
mod solid;

pub(super) use faces::FaceNormals;
