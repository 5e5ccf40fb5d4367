//! Measures of an editable mesh: normals, areas, lengths, angles, bounds, volume, weight.

mod faces;
mod lengths;
mod print_material;
mod solid;

pub(super) use faces::FaceNormals;
pub use print_material::{PRINT_MATERIALS, PrintMaterial};
