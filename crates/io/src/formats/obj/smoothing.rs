//! Normals for meshes with several smoothing groups: faces of the same group are smooth among each other,
//! with a crease towards all others.

use std::collections::HashMap;

use trigon_math::Vec3;
use trigon_mesh::Mesh;

use super::follow::STRIDE;
use crate::error::LoadError;

/// Fills in the normals of smooth faces where none is given (zero). Faces of
/// group 0 keep zero, which means flat. `go_on` is asked now and then, and may end it.
pub(crate) fn group_normals(
    mesh: &Mesh,
    given: Option<Vec<Vec3>>,
    face_groups: &[u32],
    go_on: &dyn Fn() -> Result<(), LoadError>,
) -> Result<Vec<Vec3>, LoadError> {
    let ask = |face: usize| if face.is_multiple_of(STRIDE) { go_on() } else { Ok(()) };
    let mut normals = given.unwrap_or_else(|| vec![Vec3::ZERO; mesh.corner_count()]);
    let mut sums: HashMap<(u32, u32), Vec3> = HashMap::new();
    for (face, &group) in face_groups.iter().enumerate().filter(|&(_, &group)| group != 0) {
        ask(face)?;
        let area = area_vector(mesh, face);
        for &vertex in mesh.face_vertices(face) {
            *sums.entry((vertex, group)).or_default() += area;
        }
    }
    for (face, &group) in face_groups.iter().enumerate().filter(|&(_, &group)| group != 0) {
        ask(face)?;
        for (corner, &vertex) in mesh.face_corners(face).zip(mesh.face_vertices(face)) {
            if normals[corner] == Vec3::ZERO {
                normals[corner] = sums[&(vertex, group)].normalize_or_zero();
            }
        }
    }
    Ok(normals)
}

/// The normal of a polygon, as long as twice its area (Newell's method; Sutherland,
/// Sproull, Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", 1974).
fn area_vector(mesh: &Mesh, face: usize) -> Vec3 {
    let positions = mesh.positions();
    let corners = mesh.face_vertices(face);
    let origin = positions[corners[0] as usize];
    let from_origin = |index: usize| positions[corners[index] as usize] - origin;
    (1..corners.len() - 1).map(|index| from_origin(index).cross(from_origin(index + 1))).sum()
}
