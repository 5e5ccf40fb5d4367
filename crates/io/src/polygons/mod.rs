//! Meshes and nodes for formats that have no nodes and materials (PLY, STL, OFF).
//!
//! Vertices keep their numbers, unused ones included, so that a file written back has the same. Vertex values
//! are copied to the corners at each vertex.

mod build;
mod materials;

use trigon_math::color::{srgb_to_linear, srgb8_to_linear};
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_scene::{Node, Transform};

use self::build::build;
use self::materials::add_materials;
use crate::error::{LoadError, LoadErrorKind};
use crate::import::Import;
use crate::options::LoadStage;
use crate::rebase::offset_for;

pub(crate) use materials::{NamedTextures, RawColors};

/// One mesh as a reader found it. Every index leads to a vertex.
#[derive(Debug, Default)]
pub(crate) struct Polygons {
    /// Empty where the file has none.
    pub(crate) name: String,
    pub(crate) positions: Vec<DVec3>,
    /// Of vertices, like the next two: empty, or one each.
    pub(crate) normals: Vec<Vec3>,
    /// v counted downwards.
    pub(crate) uvs: Vec<Vec2>,
    /// Linear, with alpha.
    pub(crate) colors: Vec<Vec4>,
    pub(crate) face_sizes: Vec<u32>,
    pub(crate) corner_vertices: Vec<u32>,
    /// Of corners: empty, or one each. They come before those of vertices.
    pub(crate) corner_uvs: Vec<Vec2>,
    /// Of faces: empty, or one each. Those of vertices come before them.
    pub(crate) face_colors: Vec<Vec4>,
    /// Of the whole, where neither vertices nor faces have colours.
    pub(crate) color: Option<Vec4>,
    pub(crate) textures: NamedTextures,
    pub(crate) edges: Vec<[u32; 2]>,
}

/// A colour from 0 to 1 in sRGB as linear light. Bytes are those of the table that everything else
/// takes bytes from; what is not a number is white.
pub(crate) fn light_from_srgb(color: [f32; 4]) -> Vec4 {
    let unit = |value: f32| if value.is_nan() { 1.0 } else { value.clamp(0.0, 1.0) };
    let [red, green, blue, alpha] = color.map(unit);
    let linear = |unit: f32| {
        let byte = (unit * 255.0).round();
        if byte / 255.0 == unit { srgb8_to_linear(byte as u8) } else { srgb_to_linear(unit) }
    };
    Vec4::new(linear(red), linear(green), linear(blue), alpha)
}

/// Refuses more vertices than the limits allow, or than indices can name.
pub(crate) fn check_vertices(import: &Import<'_>, count: u64) -> Result<(), LoadError> {
    let limit = import.options.limits.vertices.min(u32::MAX as usize - 1);
    if count > limit as u64 {
        return Err(LoadError::limit(import.path, format!("it has more than {limit} vertices")));
    }
    Ok(())
}

/// How many corners of faces, ends of edges and points there may be.
pub(crate) fn most_corners(import: &Import<'_>) -> usize {
    import.options.limits.corners.min(u32::MAX as usize - 1)
}

/// The error of a file that has more.
pub(crate) fn too_many_corners(import: &Import<'_>) -> LoadError {
    LoadError::limit(import.path, format!("the faces have more than {} corners", most_corners(import)))
}

/// Refuses more meshes than there may be nodes.
pub(crate) fn check_solids(import: &Import<'_>, count: usize) -> Result<(), LoadError> {
    let limit = import.options.limits.nodes;
    if count > limit {
        return Err(LoadError::limit(import.path, format!("it has more solids than {limit} nodes")));
    }
    Ok(())
}

/// Adds a node for each of the meshes. Far from the origin they are moved, and their nodes have
/// the offset.
pub(crate) fn add_polygons(import: &mut Import<'_>, list: Vec<Polygons>) -> Result<(), LoadError> {
    let is_empty = list.iter().all(|polygons| polygons.positions.is_empty());
    if is_empty && import.options.may_be_empty {
        return Ok(());
    }
    if is_empty {
        let what = "there is nothing to draw: the file has no vertices";
        let remedy = "export the model with its faces or points";
        return Err(LoadError::new(LoadErrorKind::Empty, import.path, what, remedy));
    }
    check_solids(import, list.len())?;
    let offset = offset_for(list.iter().flat_map(|polygons| polygons.positions.iter().copied()));
    let stem = import.path.file_stem();
    let stem = stem.map_or_else(|| "object".to_owned(), |stem| stem.to_string_lossy().into_owned());
    for mut polygons in list {
        import.options.report(import.path, LoadStage::Geometry, 0.9)?;
        let name = if polygons.name.is_empty() { stem.clone() } else { polygons.name.clone() };
        let materials = add_materials(import, &mut polygons)?;
        let mesh = build(import, polygons, offset)?;
        let mesh = import.scene.add_mesh(name.clone(), mesh);
        let mut node = Node::default().with_name(name).with_transform(Transform::from_translation(offset));
        (node.mesh, node.materials) = (Some(mesh), materials);
        import.scene.add(node);
    }
    import.options.report(import.path, LoadStage::Geometry, 1.0)
}
