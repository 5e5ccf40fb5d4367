//! Builds a mesh from lists: invalid faces are left out, and vertex values are copied to corners.

use std::mem::take;
use std::ops::Range;

use rayon::prelude::*;
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, MeshColumns};

use super::{Polygons, most_corners, too_many_corners};
use crate::error::{LoadError, Location};
use crate::import::Import;

/// Faces and edges of one mesh that were left out, by reason.
#[derive(Default)]
struct LeftOut {
    non_finite: Occurrences,
    flat: Occurrences,
}

/// How often something occurred, and where it did first.
#[derive(Clone, Copy, Default)]
struct Occurrences {
    count: usize,
    first: usize,
}

impl Occurrences {
    fn note(&mut self, index: usize) {
        if self.count == 0 {
            self.first = index;
        }
        self.count += 1;
    }
}

/// The mesh of a part, with all positions less the offset.
pub(super) fn build(
    import: &mut Import<'_>,
    mut polygons: Polygons,
    offset: DVec3,
) -> Result<Mesh, LoadError> {
    match whole(&mut polygons, offset) {
        Some(mesh) => Ok(mesh),
        None => build_of_sound_faces(import, polygons, offset),
    }
}

/// The mesh of a part of which nothing is left out, as of most: it takes over the lists of faces. None if something is, or
/// the part has edges or no faces.
fn whole(polygons: &mut Polygons, offset: DVec3) -> Option<Mesh> {
    if polygons.face_sizes.is_empty() || !polygons.edges.is_empty() {
        return None;
    }
    let to_local = |position: &DVec3| (*position - offset).as_vec3();
    let columns = MeshColumns {
        positions: polygons.positions.par_iter().map(to_local).collect(),
        face_sizes: take(&mut polygons.face_sizes),
        corner_vertices: take(&mut polygons.corner_vertices),
        ..MeshColumns::default()
    };
    if !columns.positions.iter().all(|position| position.is_finite()) || columns.check().is_err() {
        (polygons.face_sizes, polygons.corner_vertices) = (columns.face_sizes, columns.corner_vertices);
        return None;
    }
    // Large, and not needed any more.
    polygons.positions = Vec::new();
    let mut mesh = Mesh::from_columns(columns).expect("they were checked");
    let attributes = attributes(take(polygons), &RetainedFaces::default(), mesh.corner_vertices(), &mesh);
    mesh.set_attributes(attributes).expect("one value per corner");
    Some(mesh)
}

/// The mesh of the faces that have three different vertices at least, all of them finite.
fn build_of_sound_faces(
    import: &mut Import<'_>,
    mut polygons: Polygons,
    offset: DVec3,
) -> Result<Mesh, LoadError> {
    let faces = polygons.face_sizes.len();
    let mut builder =
        MeshBuilder::with_capacity(polygons.positions.len(), faces, polygons.corner_vertices.len());
    let local = push_vertices(import, &polygons, offset, &mut builder);
    // Large, and not needed any more.
    polygons.positions = Vec::new();
    let mut left_out = LeftOut::default();
    let mut retained = RetainedFaces::default();
    let (mut face, mut start) = (Vec::new(), 0);
    for (index, &size) in polygons.face_sizes.iter().enumerate() {
        let corners = start..start + size as usize;
        start = corners.end;
        face.clear();
        face.extend(polygons.corner_vertices[corners.clone()].iter().map(|&vertex| local.of(vertex)));
        if face.contains(&NOWHERE) {
            left_out.non_finite.note(index);
        } else if builder.push_face(&face).is_err() {
            left_out.flat.note(index);
        } else {
            retained.push(index, corners);
            continue;
        }
        retained.begin(index, corners.start);
    }
    push_edges(import, &polygons, &local, &mut builder, &mut left_out)?;
    warn(import, &left_out);
    let mut mesh = builder.build();
    let vertices = retained.at_corners(take(&mut polygons.corner_vertices));
    let vertex_colors = local.of_wires(&mut polygons);
    let attributes = Attributes { vertex_colors, ..attributes(polygons, &retained, &vertices, &mesh) };
    mesh.set_attributes(attributes).expect("one value per accepted corner");
    Ok(mesh)
}

/// The faces that were accepted, and their corners, by their numbers in the file: lists only once one is left out.
#[derive(Default)]
struct RetainedFaces(Option<(Vec<u32>, Vec<u32>)>);

impl RetainedFaces {
    /// A face is left out that stands after so many faces and corners.
    fn begin(&mut self, faces: usize, corners: usize) {
        self.0.get_or_insert_with(|| ((0..faces as u32).collect(), (0..corners as u32).collect()));
    }

    fn push(&mut self, face: usize, corners: Range<usize>) {
        if let Some((faces, all)) = &mut self.0 {
            faces.push(face as u32);
            all.extend(corners.map(|corner| corner as u32));
        }
    }

    /// The number in the file of an accepted face.
    fn face(&self, face: usize) -> usize {
        self.0.as_ref().map_or(face, |(faces, _)| faces[face] as usize)
    }

    /// Of values at all corners those at the corners that were accepted.
    fn at_corners<T: Copy>(&self, values: Vec<T>) -> Vec<T> {
        match &self.0 {
            None => values,
            Some((_, corners)) => corners.iter().map(|&corner| values[corner as usize]).collect(),
        }
    }
}

/// Stands for a vertex that has no place.
const NOWHERE: u32 = u32::MAX;

/// The numbers of the file's vertices in the mesh.
enum Local {
    Same,
    Others(Vec<u32>),
}

impl Local {
    fn of(&self, vertex: u32) -> u32 {
        match self {
            Self::Same => vertex,
            Self::Others(local) => local[vertex as usize],
        }
    }

    /// The colours of the mesh's vertices, if it has edges or points that show them. Those of a cloud are taken over:
    /// they may be many.
    fn of_wires(&self, polygons: &mut Polygons) -> Option<Vec<Vec4>> {
        let has_faces = !polygons.face_sizes.is_empty();
        if polygons.colors.is_empty() || (has_faces && polygons.edges.is_empty()) {
            return None;
        }
        let colors = if has_faces { polygons.colors.clone() } else { take(&mut polygons.colors) };
        Some(match self {
            Self::Same => colors,
            Self::Others(local) => colors
                .into_iter()
                .zip(local)
                .filter(|(_, at)| **at != NOWHERE)
                .map(|(color, _)| color)
                .collect(),
        })
    }
}

fn push_vertices(
    import: &mut Import<'_>,
    polygons: &Polygons,
    offset: DVec3,
    builder: &mut MeshBuilder,
) -> Local {
    let to_local = |position: &DVec3| -> Vec3 { (*position - offset).as_vec3() };
    let Some(first) = polygons.positions.iter().position(|position| !to_local(position).is_finite()) else {
        for position in &polygons.positions {
            builder.push_vertex(to_local(position));
        }
        return Local::Same;
    };
    let mut count = 0;
    let local = polygons.positions.iter().map(to_local).map(|position| {
        if position.is_finite() {
            return builder.push_vertex(position);
        }
        count += 1;
        NOWHERE
    });
    let local = Local::Others(local.collect());
    import.warnings.push_counted(
        count,
        Location::Item("vertex", first),
        "a vertex has a position that is not finite and is left out",
        "export the model again",
    );
    local
}

/// The edges of the file; where it has neither faces nor edges, its vertices are points.
fn push_edges(
    import: &mut Import<'_>,
    polygons: &Polygons,
    local: &Local,
    builder: &mut MeshBuilder,
    left_out: &mut LeftOut,
) -> Result<(), LoadError> {
    for (index, edge) in polygons.edges.iter().enumerate() {
        let [from, to] = edge.map(|vertex| local.of(vertex));
        if from == NOWHERE || to == NOWHERE {
            left_out.non_finite.note(index);
        } else if builder.push_loose_edge(from, to).is_err() {
            left_out.flat.note(index);
        }
    }
    if !polygons.face_sizes.is_empty() || !polygons.edges.is_empty() {
        return Ok(());
    }
    if builder.vertex_count() > most_corners(import) {
        return Err(too_many_corners(import));
    }
    for vertex in 0..builder.vertex_count() as u32 {
        builder.push_loose_point(vertex).expect("the vertex exists");
    }
    Ok(())
}

fn warn(import: &mut Import<'_>, left_out: &LeftOut) {
    let mut warn = |Occurrences { count, first }, what: &str, remedy: &str| {
        import.warnings.push_counted(count, Location::Item("face", first), what, remedy);
    };
    warn(
        left_out.non_finite,
        "a face or an edge has a vertex that is not finite and is left out",
        "export the model again",
    );
    warn(
        left_out.flat,
        "a face has fewer than 3 different vertices, or an edge fewer than 2, and is left out",
        "clean the model up",
    );
}

/// The values at the corners of the faces that were accepted, those of a mesh; `vertices` are the file's vertices there.
fn attributes(mut polygons: Polygons, retained: &RetainedFaces, vertices: &[u32], mesh: &Mesh) -> Attributes {
    let normals = of_vertices(&polygons.normals, vertices);
    let uvs = match polygons.corner_uvs.is_empty() {
        true => of_vertices(&polygons.uvs, vertices),
        false => Some(retained.at_corners(take(&mut polygons.corner_uvs))),
    };
    let colors = of_vertices(&polygons.colors, vertices);
    let colors_by_face =
        || (!polygons.face_colors.is_empty()).then(|| colors_of_faces(&polygons.face_colors, retained, mesh));
    let textures = &polygons.textures.of_faces;
    let of_faces = (!textures.is_empty())
        .then(|| (0..mesh.face_count()).map(|face| textures[retained.face(face)]).collect());
    Attributes {
        face_materials: of_faces,
        corner_normals: normals,
        uv_sets: uvs.into_iter().collect(),
        corner_colors: colors.or_else(colors_by_face),
        ..Attributes::default()
    }
}

/// The values of the vertices at corners, if vertices have values. All threads write them.
fn of_vertices<T: Copy + Send + Sync>(values: &[T], vertices: &[u32]) -> Option<Vec<T>> {
    let of = |&vertex: &u32| values[vertex as usize];
    (!values.is_empty()).then(|| vertices.par_iter().map(of).collect())
}

/// The colour of its face at each corner of the faces that were accepted.
fn colors_of_faces(colors: &[Vec4], retained: &RetainedFaces, mesh: &Mesh) -> Vec<Vec4> {
    let color = |(face, corners): (usize, Range<usize>)| {
        std::iter::repeat_n(colors[retained.face(face)], corners.len())
    };
    mesh.faces().enumerate().flat_map(color).collect()
}
