//! The vertex attributes of a mesh as columns (structure of arrays), for the vectorized vertex stage. What all vertex
//! colours of a mesh have in common is found once, when a material first asks for it.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Deformed, Mesh, RenderMesh, RenderUpdate, UpdatedVertex, WeldedMesh};

use super::Geometry;
use crate::display::Display;
use crate::material::{AlphaMode, Material};
use crate::work::keeps_unseen;

/// The vertex values of a mesh. All columns have the same length, but that of normals may be empty.
#[derive(Clone, Debug, Default)]
pub(crate) struct Columns {
    pub(crate) positions: [Vec<f32>; 3],
    /// Of unit length. Empty if `face_normals` exist.
    pub(crate) normals: [Vec<f32>; 3],
    /// The normals of polygons, of unit length, where all are flat. Vertices then need no normals, and
    /// neighbouring polygons can share them.
    pub(crate) face_normals: Option<[Vec<f32>; 3]>,
    /// Of unit length, and the handedness of the bitangent.
    pub(crate) tangents: Option<[Vec<f32>; 4]>,
    pub(crate) uv_sets: Vec<[Vec<f32>; 2]>,
    /// Linear light, straight alpha.
    pub(crate) colors: Option<[Vec<f32>; 4]>,
    pub(super) color_traits: ColorTraits,
}

impl Columns {
    /// Each list of the mesh is freed as soon as its columns are written: large meshes set the peak of memory.
    pub(crate) fn new(mesh: RenderMesh) -> Self {
        let RenderMesh { positions, normals, tangents, uv_sets, colors, .. } = mesh;
        Self {
            positions: columns_of(positions, Vec3::to_array),
            normals: columns_of(normals, Vec3::to_array),
            face_normals: None,
            tangents: tangents.map(|tangents| columns_of(tangents, Vec4::to_array)),
            uv_sets: uv_sets.into_iter().map(|set| columns_of(set, Vec2::to_array)).collect(),
            colors: colors.map(|colors| columns_of(colors, Vec4::to_array)),
            color_traits: ColorTraits::default(),
        }
    }

    /// Of a mesh and its welded vertices.
    pub(crate) fn of_welded(mesh: &Mesh, welded: WeldedMesh) -> Self {
        let WeldedMesh { corners, normals, .. } = welded;
        let attributes = mesh.attributes();
        let position =
            |&corner: &u32| mesh.positions()[mesh.corner_vertices()[corner as usize] as usize].to_array();
        let uvs = |set: &Vec<Vec2>| turned(&corners, |&corner| set[corner as usize].to_array());
        let fours = |values: &Vec<Vec4>| turned(&corners, |&corner| values[corner as usize].to_array());
        Self {
            normals: columns_of(normals, Vec3::to_array),
            positions: turned(&corners, position),
            face_normals: None,
            tangents: attributes.corner_tangents.as_ref().map(fours),
            uv_sets: attributes.uv_sets.iter().map(uvs).collect(),
            colors: attributes.corner_colors.as_ref().map(fours),
            color_traits: ColorTraits::default(),
        }
    }

    /// Of a mesh and its welded vertices without normals, whose polygons have these.
    pub(crate) fn of_flat_faces(mesh: &Mesh, welded: WeldedMesh, normals: Vec<Vec3>) -> Self {
        let columns = Self::of_welded(mesh, welded);
        Self { face_normals: Some(columns_of(normals, Vec3::to_array)), ..columns }
    }

    /// The same vertices in a pose.
    pub(crate) fn deformed(&self, pose: &Deformed) -> Self {
        Self {
            positions: turned(&pose.positions, Vec3::to_array),
            normals: turned(&pose.normals, Vec3::to_array),
            tangents: self.tangents.as_ref().map(|_| turned(&pose.tangents, Vec4::to_array)),
            ..self.clone()
        }
    }

    /// Writes the values of vertices that a change of the mesh has affected; new vertices are appended in
    /// order.
    pub(crate) fn update(&mut self, mesh: &Mesh, update: &RenderUpdate) {
        let Self { positions, normals, face_normals, tangents, uv_sets, colors, color_traits } = self;
        let attributes = mesh.attributes();
        let replaced = || update.vertices.iter().filter(|of| !of.is_normal_alone);
        let write_others = || {
            write(positions, replaced(), |of| {
                mesh.positions()[mesh.corner_vertices()[of.corner as usize] as usize].to_array()
            });
            if let (Some(columns), Some(values)) = (tangents, &attributes.corner_tangents) {
                write(columns, replaced(), |of| values[of.corner as usize].to_array());
            }
            for (columns, values) in uv_sets.iter_mut().zip(&attributes.uv_sets) {
                write(columns, replaced(), |of| values[of.corner as usize].to_array());
            }
            if let (Some(columns), Some(values)) = (colors, &attributes.corner_colors) {
                let color = |of: &UpdatedVertex| values[of.corner as usize].to_array();
                // Most changes move vertices, and leave their colours.
                if replaced().any(|of| !holds(columns, of.vertex, color(of))) {
                    *color_traits = ColorTraits::default();
                }
                write(columns, replaced(), color);
            }
        };
        let write_normals = || match face_normals {
            Some(columns) => write_face_normals(columns, &update.face_normals),
            None => write(normals, update.vertices.iter(), |of| of.normal.to_array()),
        };
        rayon::join(write_normals, write_others);
    }

    /// The bytes that a pose changes.
    pub(crate) fn byte_count(&self) -> usize {
        let tangents = self.tangents.iter().flatten();
        let columns = self.positions.iter().chain(&self.normals).chain(tangents);
        columns.map(|column| size_of_val(column.as_slice())).sum()
    }

    /// The position of a vertex, if it exists.
    pub(crate) fn position(&self, vertex: u32) -> Option<Vec3> {
        let [x, y, z] = self.positions.each_ref().map(|column| column.get(vertex as usize).copied());
        Some(Vec3::new(x?, y?, z?))
    }

    /// The normal at a vertex of a polygon.
    pub(crate) fn normal(&self, vertex: usize, face: u32) -> Vec3 {
        let (columns, at) = match &self.face_normals {
            Some(columns) => (columns, face as usize),
            None => (&self.normals, vertex),
        };
        Vec3::from_array(columns.each_ref().map(|column| column[at]))
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.positions[0].len()
    }
}

/// Whether a vertex has these values.
fn holds<const N: usize>(columns: &[Vec<f32>; N], vertex: u32, values: [f32; N]) -> bool {
    columns.iter().zip(values).all(|(column, value)| column.get(vertex as usize) == Some(&value))
}

fn write_face_normals(columns: &mut [Vec<f32>; 3], normals: &[(u32, Vec3)]) {
    for (column, axis) in columns.iter_mut().zip(0..) {
        normals.iter().for_each(|(face, normal)| column[*face as usize] = normal[axis]);
    }
}

/// Writes the columns of one attribute.
fn write<'a, const N: usize>(
    columns: &mut [Vec<f32>; N],
    vertices: impl Iterator<Item = &'a UpdatedVertex>,
    value: impl Fn(&UpdatedVertex) -> [f32; N],
) {
    for vertex in vertices {
        for (column, entry) in columns.iter_mut().zip(value(vertex)) {
            match column.get_mut(vertex.vertex as usize) {
                Some(slot) => *slot = entry,
                None => column.push(entry),
            }
        }
    }
}

/// Rows become columns, and are freed.
fn columns_of<T: Copy + Sync, const N: usize>(
    rows: Vec<T>,
    entries: impl Fn(&T) -> [f32; N] + Sync,
) -> [Vec<f32>; N] {
    turned(&rows, entries)
}

/// Rows become columns; all threads write them if there are many.
fn turned<T: Sync, const N: usize>(rows: &[T], entries: impl Fn(&T) -> [f32; N] + Sync) -> [Vec<f32>; N] {
    const MANY: usize = 1 << 14;
    let mut columns = [(); N].map(|()| Vec::with_capacity(rows.len()));
    let write = |(axis, column): (usize, &mut Vec<f32>)| {
        column.extend(rows.iter().map(|row| entries(row)[axis]));
    };
    if rows.len() < MANY {
        columns.iter_mut().enumerate().for_each(write);
    } else {
        columns.par_iter_mut().enumerate().for_each(write);
    }
    columns
}

/// What is the same of all vertex colours; each is searched when it is first asked for.
#[derive(Clone, Debug, Default)]
pub(crate) struct ColorTraits {
    /// Red, green and blue are 1.
    white: OnceLock<bool>,
    /// Alpha is 1.
    opaque: OnceLock<bool>,
    /// All are finite numbers, at least 0.
    positive: OnceLock<bool>,
}

impl Columns {
    /// Whether vertex colours show in a material whose alpha mode is the one that can be seen. Interpolated between
    /// equal values they are exactly these, so white ones change no byte.
    pub(crate) fn show_colors(&self, material: &Material, display: Display) -> bool {
        let shows_alpha = material.alpha_mode != AlphaMode::Opaque || display == Display::Alpha;
        let is_black = || material.base_color.truncate() == Vec3::ZERO && self.are_colors_positive();
        let shows = || !self.are_colors_white() && !is_black() || shows_alpha && !self.are_colors_opaque();
        self.colors.is_some() && (keeps_unseen() || shows())
    }

    /// Whether the red, green and blue of all vertex colours, if there are any, are 1.
    pub(crate) fn are_colors_white(&self) -> bool {
        *self.color_traits.white.get_or_init(|| self.all_of_colors(0..3, |value| value == 1.0))
    }

    /// Whether their alpha is 1.
    pub(crate) fn are_colors_opaque(&self) -> bool {
        *self.color_traits.opaque.get_or_init(|| self.all_of_colors(3..4, |value| value == 1.0))
    }

    /// Whether all of their values are finite and at least 0.
    pub(crate) fn are_colors_positive(&self) -> bool {
        let is_positive = |value: f32| value.is_finite() && value >= 0.0;
        *self.color_traits.positive.get_or_init(|| self.all_of_colors(0..4, is_positive))
    }

    fn all_of_colors(&self, channels: std::ops::Range<usize>, holds: impl Fn(f32) -> bool) -> bool {
        let Some(colors) = &self.colors else { return true };
        colors[channels].iter().flatten().all(|&value| holds(value))
    }
}

/// Triangles per task.
const TRIANGLES_PER_TASK: usize = 4096;

/// For each vertex of geometry at rest that a triangle has, a vertex of the mesh at the same position, to the bit;
/// 0 for the others.
pub(super) fn mesh_vertices(source: &Mesh, geometry: &Geometry) -> Vec<u32> {
    let vertices: Vec<AtomicU32> = (0..geometry.columns.vertex_count()).map(|_| AtomicU32::new(0)).collect();
    let bits = |position: [f32; 3]| position.map(f32::to_bits);
    let triangles = geometry.triangles.par_iter().enumerate().with_min_len(TRIANGLES_PER_TASK);
    // Fillers cover nothing, and need not be anywhere.
    let triangles = triangles.filter(|(_, [a, b, c])| a != b || b != c);
    triangles.for_each(|(number, triangle)| {
        let candidates = source.face_vertices(geometry.face(number) as usize);
        for &drawn in triangle {
            let position = geometry.columns.positions.each_ref().map(|column| column[drawn as usize]);
            let is_here =
                |&&vertex: &&u32| bits(source.positions()[vertex as usize].to_array()) == bits(position);
            let vertex = candidates.iter().find(is_here);
            // Triangles that share a vertex may find different ones, all at the same position.
            let vertex = vertex.expect("triangles have corners of their faces");
            vertices[drawn as usize].store(*vertex, Ordering::Relaxed);
        }
    });
    vertices.into_iter().map(AtomicU32::into_inner).collect()
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn drawn_vertices_lie_where_those_of_the_mesh_do() {
        for mesh in [primitives::cube(1.0), primitives::torus(2.0, 0.5, 6, 5)] {
            let geometry = Geometry::new(&mesh);
            let vertices = mesh_vertices(&mesh, &geometry);
            assert_eq!(vertices.len(), geometry.columns.vertex_count(), "one for each");
            for (&vertex, drawn) in vertices.iter().zip(0..) {
                let position = geometry.columns.position(drawn).expect("it is drawn");
                assert_eq!(mesh.positions()[vertex as usize], position, "vertex {drawn}");
            }
        }
    }
}
