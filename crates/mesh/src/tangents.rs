//! Tangents by MikkTSpace, for which normal maps are baked (M. S. Mikkelsen, "Simulation of Wrinkled
//! Surfaces Revisited", 2008), computed by the crate `bevy_mikktspace` with an arc cosine that is the same
//! on every machine.

use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use trigon_math::{Vec3, Vec4, elementary};

use crate::Mesh;

impl Mesh {
    /// The tangent of every corner for a set of texture coordinates, in the form of
    /// [`Attributes::corner_tangents`](crate::Attributes::corner_tangents); `None` if the mesh has
    /// no such set. Corners of faces without area, in space or in the image, use the tangent of a
    /// neighbour or get an arbitrary direction perpendicular to their normal.
    pub fn generate_tangents(&self, uv_set: usize) -> Option<Vec<Vec4>> {
        let uvs = self.attributes().uv_sets.get(uv_set)?;
        let normals = self.shading_normals();
        let mut corners = Corners {
            mesh: self,
            triangles: self.triangulation().triangles,
            normals: &normals,
            uvs,
            tangents: vec![None; self.corner_count()],
        };
        let Ok(()) = generate_tangents(&mut corners) else { return None };
        let across = |normal: Vec3| normal.any_orthonormal_vector().extend(1.0);
        let pairs = corners.tangents.into_iter().zip(&normals);
        Some(pairs.map(|(tangent, &normal)| tangent.unwrap_or_else(|| across(normal))).collect())
    }
}

/// The triangles of a mesh in the form that the crate needs. Corners of a polygon are in several
/// triangles; the first one decides.
struct Corners<'m> {
    mesh: &'m Mesh,
    triangles: Vec<[u32; 3]>,
    normals: &'m [Vec3],
    uvs: &'m [trigon_math::Vec2],
    tangents: Vec<Option<Vec4>>,
}

impl Corners<'_> {
    fn corner(&self, triangle: usize, vertex: usize) -> usize {
        self.triangles[triangle][vertex] as usize
    }
}

impl Geometry<SameEverywhere> for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, triangle: usize, vertex: usize) -> [f32; 3] {
        let vertex = self.mesh.corner_vertices()[self.corner(triangle, vertex)];
        self.mesh.positions()[vertex as usize].to_array().map(finite)
    }

    fn normal(&self, triangle: usize, vertex: usize) -> [f32; 3] {
        self.normals[self.corner(triangle, vertex)].to_array()
    }

    fn tex_coord(&self, triangle: usize, vertex: usize) -> [f32; 2] {
        self.uvs[self.corner(triangle, vertex)].to_array().map(finite)
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, triangle: usize, vertex: usize) {
        let corner = self.corner(triangle, vertex);
        // In MikkTSpace v points up, so its bitangent is the opposite of ours.
        let tangent = space.map(|space| Vec4::from(space.tangent_encoded()) * Vec4::new(1.0, 1.0, 1.0, -1.0));
        let usable = tangent.filter(|tangent| tangent.is_finite() && tangent.truncate() != Vec3::ZERO);
        self.tangents[corner] = self.tangents[corner].or(usable);
    }
}

/// Sorting and grouping need valid numbers.
fn finite(value: f32) -> f32 {
    if value.is_finite() { value } else { 0.0 }
}

/// The functions that the standard library takes from the platform.
struct SameEverywhere;

impl Ops for SameEverywhere {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        elementary::acos(f64::from(x)) as f32
    }
}

#[cfg(test)]
mod tests {
    use crate::primitives;

    #[test]
    fn tangents_follow_growing_u_and_bitangents_point_up_in_the_image() {
        let mesh = primitives::uv_sphere(1.0, 24, 12);
        let tangents = mesh.generate_tangents(0).expect("a sphere has texture coordinates");
        let (normals, uvs) = (mesh.shading_normals(), &mesh.attributes().uv_sets[0]);
        let position = |corner: usize| mesh.positions()[mesh.corner_vertices()[corner] as usize];
        for corners in mesh.faces().filter(|corners| corners.len() == 4) {
            let corner = corners.start;
            let (tangent, normal) = (tangents[corner], normals[corner]);
            let bitangent = normal.cross(tangent.truncate()) * tangent.w;
            for next in [corner + 1, corner + 3] {
                let (along, change) = (position(next) - position(corner), uvs[next] - uvs[corner]);
                let (u, v) = (along.dot(tangent.truncate()), along.dot(bitangent));
                assert!(change.x.abs() < 1e-6 || u * change.x > 0.0, "u grows along the tangent");
                assert!(change.y.abs() < 1e-6 || v * change.y < 0.0, "v falls along the bitangent");
            }
        }
        assert_eq!(mesh.generate_tangents(1), None, "no second set");
    }
}
