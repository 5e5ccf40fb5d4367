//! Export options.

use trigon_camera::UpAxis;
use trigon_math::{DAffine3, DMat3, DVec3};
use trigon_scene::{NodeId, Scene};

use crate::format::Format;
use crate::gltf_source::GltfSource;

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
    /// The axis that points up in the file; by default that of its [format](crate::Format::up), +Z for STL and +Y
    /// for all others. A scene in which another axis is up ([`Scene::up`]) is turned, exactly between the axes of
    /// the world.
    pub up: Option<UpAxis>,
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
            up: None,
            images: None,
            faces: FaceExport::Polygons,
            encoding: Encoding::Binary,
        }
    }
}

impl ExportOptions<'_> {
    /// With the conventions of a format where nothing else is said.
    pub(crate) fn for_format(&self, format: Format) -> Self {
        Self { up: self.up.or(Some(format.up())), ..self.clone() }
    }

    /// The map from a scene to the file; none if they are the same.
    pub(crate) fn root(&self, scene: &Scene) -> Option<DAffine3> {
        let scale = if self.scale > 0.0 && self.scale.is_finite() { self.scale } else { 1.0 };
        let turn = scene.up.turn_to(self.up.unwrap_or_default());
        let map = DAffine3::from_mat3(turn * DMat3::from_diagonal(DVec3::splat(scale)));
        Some(map).filter(|map| *map != DAffine3::IDENTITY)
    }
}
