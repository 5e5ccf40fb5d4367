//! Measures of an editable mesh: normals, areas, lengths, angles, bounds, volume.

mod faces;
mod lengths;
mod solid;

pub(super) use faces::FaceNormals;
