//! Export options.

use trigon_math::{DAffine3, DMat3, DVec3};
use trigon_scene::NodeId;

use crate::gltf_source::GltfSource;

/// The up axis of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y, as in glTF and OBJ.
    #[default]
    Y,
    /// +Z, as in programs for printing and scanning.
    Z,
}

/// The faces of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FaceExport {
    /// Polygons, if the format has them.
    #[default]
    Polygons,
    /// Triangles.
    Triangles,
}

/// The encoding of numbers, if the format leaves a choice: PLY and STL.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Binary, little-endian.
    #[default]
    Binary,
    /// Binary, big-endian; only for PLY. STL is written little-endian.
    BinaryBigEndian,
    /// Decimal digits, as many as read back as the same number.
    Text,
}

/// Options for exporting a model for other programs.
#[derive(Clone, Debug)]
pub struct ExportOptions<'a> {
    /// The nodes to write, with their transforms; all by default. Their children are written only
    /// if they are named, too.
    pub nodes: Option<Vec<NodeId>>,
    /// Units of the file per metre: 1 is what glTF defines. Must be positive and finite, otherwise it counts
    /// as 1.
    pub scale: f64,
    /// The up axis.
    pub up: UpAxis,
    /// The file that the scene came from: images are taken from it as they were encoded. Others are
    /// written as PNG.
    pub images: Option<&'a GltfSource>,
    /// Whether polygons are triangulated. GLB and STL have nothing else.
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
            images: None,
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
