//! What all exporters share: they write scenes for other programs, in formats that hold less than a scene. Here are
//! their options, the files in memory, and what a format cannot hold, as data.

mod gather;

use std::fmt;
use std::path::Path;

use trigon_camera::UpAxis;
use trigon_math::{DAffine3, DMat3, DVec3};
use trigon_mesh::Mesh;
use trigon_scene::{Node, NodeId, Scene};

use self::gather::node_location;
use super::error::Location;
use super::format::Format;
use super::gltf_source::GltfSource;
use super::write::{WriteError, write_atomically};

pub(crate) use super::numbers::{Precision, number_text, push_number};
pub(crate) use gather::{ExportedVertices, Gathered, Object, VertexColumns};

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
    /// Units of the file per metre: 1 is what glTF defines. A 3MF says that its unit is the millimetre: there it is a
    /// factor, and 1 is the true size. Must be positive and finite, otherwise it counts as 1.
    pub scale: f64,
    /// The axis that points up in the file; by default that of its [format](crate::Format::up), +Z for STL and 3MF,
    /// +Y for all others. A scene in which another axis is up ([`Scene::up`]) is turned, exactly between the axes of
    /// the world.
    pub up: Option<UpAxis>,
    /// The file that the scene came from: images are taken from it as they were encoded. Others are
    /// written as PNG.
    pub images: Option<&'a GltfSource>,
    /// Whether polygons are triangulated. GLB and STL have nothing else.
    pub faces: FaceExport,
    /// How numbers are written.
    pub encoding: Encoding,
    /// Whether a document's meshes are written as their modifiers make them, or as they are edited. Meshes of a scene alone have
    /// no modifiers.
    pub modifiers: bool,
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
            modifiers: true,
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

/// A name valid in text formats: without spaces, comments and characters that end or continue a line; never
/// empty.
pub(crate) fn plain_name(name: &str, otherwise: &str) -> String {
    let is_odd = |c: char| c.is_whitespace() || c.is_control() || matches!(c, '#' | '\\' | '/' | '"');
    let name: String = name.trim().chars().map(|c| if is_odd(c) { '_' } else { c }).collect();
    if name.is_empty() { otherwise.to_owned() } else { name }
}

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ExportedFile {
    /// Its name, without a folder.
    pub name: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// A model ready to be written.
#[derive(Clone, Debug)]
pub struct Export {
    /// The files in the order in which they are to be written: the model comes last, after the files that it
    /// refers to.
    pub files: Vec<ExportedFile>,
    pub(crate) losses: Vec<Loss>,
}

impl Export {
    /// What the scene contains and the files do not.
    #[must_use]
    pub fn what_would_be_lost(&self) -> &[Loss] {
        &self.losses
    }

    /// Adds what a caller knows that the scene had not, and so the files have not.
    pub fn add_loss(&mut self, location: Location, what: impl Into<String>) {
        self.losses.push(Loss { location, what: what.into() });
    }

    /// Writes the files into a folder, each atomically.
    ///
    /// # Errors
    /// One cannot be written; those before it were written.
    pub fn write(&self, folder: impl AsRef<Path>) -> Result<(), WriteError> {
        self.files.iter().try_for_each(|file| {
            write_atomically(&folder.as_ref().join(&file.name), |writer| writer.write_all(&file.bytes))
        })
    }
}

const POLYGONS: &str = "polygons: they are cut into triangles";
const NOT_FINITE: &str = "faces with vertices that are not finite";

/// Which isolated vertices a format can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HeldPoints {
    All,
    /// Those of a file with nothing else.
    Clouds,
    None,
}

/// What a format can hold besides vertices and faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Holds {
    pub(crate) materials: bool,
    pub(crate) normals: bool,
    pub(crate) uvs: bool,
    pub(crate) colors: bool,
    /// Edges without faces.
    pub(crate) edges: bool,
    pub(crate) points: HeldPoints,
    pub(crate) polygons: bool,
    /// Several named objects.
    pub(crate) objects: bool,
}

/// Adds what will not be in the file.
pub(crate) fn add_losses(gathered: &mut Gathered<'_>, holds: &Holds) {
    let scene = gathered.scene;
    add_of_nodes(gathered);
    let mut losses = Vec::new();
    let mut add = |is_lost: bool, what: &str| losses.extend(is_lost.then(|| Loss::of_scene(what)));
    let any = |has: fn(&Object<'_>) -> bool| gathered.objects.iter().any(has);
    add(!holds.materials && scene.materials.iter().next().is_some(), "materials and their textures");
    add(!holds.objects && gathered.objects.len() > 1, "which faces belong to which object: all become one");
    add(
        any(|object| object.node.parent().is_some()),
        "the node tree: objects are written with their transforms applied",
    );
    add(!scene.animations.is_empty(), "animations");
    add(
        any(|object| object.mesh.attributes().skin.is_some()),
        "skins: meshes are written in their rest pose",
    );
    add(any(|object| !object.mesh.attributes().morph_targets.is_empty()), "morph targets");
    add(!holds.normals && any(|object| object.mesh.attributes().corner_normals.is_some()), "normals");
    add(!holds.uvs && any(|object| !object.mesh.attributes().uv_sets.is_empty()), "texture coordinates");
    add(
        holds.uvs && any(|object| object.mesh.attributes().uv_sets.len() > 1),
        "texture coordinates beyond the first set",
    );
    add(!holds.colors && any(|object| object.mesh.attributes().has_colors()), "vertex colours");
    add(!holds.edges && any(|object| !object.mesh.loose_edges().is_empty()), "edges without faces");
    let is_cloud = !any(|object| object.mesh.face_count() > 0 || !object.mesh.loose_edges().is_empty());
    let keeps_points = match holds.points {
        HeldPoints::All => true,
        HeldPoints::Clouds => is_cloud,
        HeldPoints::None => false,
    };
    add(!keeps_points && any(|object| !object.mesh.loose_points().is_empty()), "points");
    add(!holds.polygons && any(|object| has_polygons(object.mesh)), POLYGONS);
    add(any(|object| has_lost_vertices(object.mesh)), NOT_FINITE);
    gathered.losses.append(&mut losses);
}

/// What is missing in a file that holds everything of a scene except polygons.
pub(crate) fn losses_of_whole(scene: &Scene, options: &ExportOptions<'_>) -> Vec<Loss> {
    let is_wanted = |id: NodeId| options.nodes.as_ref().is_none_or(|wanted| wanted.contains(&id));
    let mesh = |node: &Node| scene.meshes().get(node.mesh?).map(|asset| asset.mesh());
    let meshes = || scene.nodes().iter().filter(|(id, _)| is_wanted(*id)).filter_map(|(_, node)| mesh(node));
    let are_cut = options.faces == FaceExport::Polygons && meshes().any(has_polygons);
    let losses = [(are_cut, POLYGONS), (meshes().any(has_lost_vertices), NOT_FINITE)];
    losses.into_iter().filter(|(is_lost, _)| *is_lost).map(|(_, what)| Loss::of_scene(what)).collect()
}

fn has_lost_vertices(mesh: &Mesh) -> bool {
    mesh.positions().iter().any(|position| !position.is_finite())
}

fn has_polygons(mesh: &Mesh) -> bool {
    mesh.corner_count() > 3 * mesh.face_count()
}

fn add_of_nodes(gathered: &mut Gathered<'_>) {
    for (_, node) in gathered.scene.nodes().iter() {
        let parts = [(node.light.is_some(), "its light"), (node.camera.is_some(), "its camera")];
        for (_, what) in parts.iter().filter(|(is_there, _)| *is_there) {
            gathered.losses.push(Loss { location: node_location(node), what: (*what).to_owned() });
        }
    }
}

/// Something in a file or a scene that would be lost by saving. Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Loss {
    /// Its location in the loaded file, or in the scene.
    pub location: Location,
    /// What it is.
    pub what: String,
}

impl Loss {
    /// Something of the whole scene.
    pub(crate) fn of_scene(what: impl Into<String>) -> Self {
        Self { location: Location::Whole, what: what.into() }
    }
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let location = self.location.to_string();
        match location.strip_prefix(", ") {
            Some(location) => write!(f, "{location}: {}", self.what),
            None => f.write_str(&self.what),
        }
    }
}
