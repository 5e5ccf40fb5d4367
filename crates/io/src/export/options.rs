//! How to write a model.

use trigon_math::{DAffine3, DMat3, DVec3};
use trigon_scene::NodeId;

use crate::gltf::GltfSource;

/// Which way is up in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y, as glTF and OBJ define it.
    #[default]
    Y,
    /// +Z, as programs for printing and scanning have it.
    Z,
}

/// What faces are in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FaceExport {
    /// Polygons, where the format has them.
    #[default]
    Polygons,
    /// Triangles.
    Triangles,
}

/// How numbers are in a file, where the format leaves a choice: PLY and STL.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes, the lowest first.
    #[default]
    Binary,
    /// Bytes, the highest first; only PLY has it, and STL is written with the lowest first.
    BinaryBigEndian,
    /// Decimal digits, as many as bring back the same number.
    Text,
}

/// How to write a model for other programs.
#[derive(Clone, Debug)]
pub struct ExportOptions<'a> {
    /// The nodes to write, in their places; all by default. What hangs on them is written only
    /// if it is named, too.
    pub nodes: Option<Vec<NodeId>>,
    /// Units of the file per metre: 1 is what glTF defines. Positive and finite, else it counts as 1.
    pub scale: f64,
    /// Which way is up.
    pub up: UpAxis,
    /// The file that the scene came from: pictures are taken from it as they were encoded.
    /// Others are written as PNG.
    pub pictures: Option<&'a GltfSource>,
    /// Whether polygons are cut into triangles. GLB and STL have nothing else.
    pub faces: FaceExport,
    /// How numbers are written.
    pub encoding: Encoding,
}

impl Default for ExportOptions<'_> {
    fn default() -> Self {
        Self {
            nodes: None,
            scale: 1.0,
            up: UpAxis::Y,
            pictures: None,
            faces: FaceExport::Polygons,
            encoding: Encoding::Binary,
        }
    }
}

impl ExportOptions<'_> {
    /// The map from the scene to the file; none if they are the same.
    pub(crate) fn root(&self) -> Option<DAffine3> {
        let scale = if self.scale > 0.0 && self.scale.is_finite() { self.scale } else { 1.0 };
        let turn = match self.up {
            UpAxis::Y => DMat3::IDENTITY,
            UpAxis::Z => DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
        };
        let map = DAffine3::from_mat3(turn * DMat3::from_diagonal(DVec3::splat(scale)));
        Some(map).filter(|map| *map != DAffine3::IDENTITY)
    }
}
