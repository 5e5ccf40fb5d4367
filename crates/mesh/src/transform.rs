//! Baking a transform into the vertices.

use trigon_math::{DAffine3, DMat3, Vec3};

use crate::Mesh;
use crate::normals::unit_or_zero;

impl Mesh {
    /// A copy with a transform baked into it, see [`Mesh::transform`].
    pub fn transformed(&self, transform: &DAffine3) -> Mesh {
        let mut mesh = self.clone();
        mesh.transform(transform);
        mesh
    }

    /// Bakes a transform into the vertices: positions are computed in f64 and
    /// rounded once, corner normals turn by the cofactor matrix and stay of
    /// unit length, and a transform that mirrors turns every face over
    /// ([`Mesh::flip_faces`]) so that outside stays outside.
    ///
    /// A transform that flattens space to a plane leaves the normals of that
    /// plane; one that leaves a line or a point makes normals zero, which
    /// counts as "none given".
    pub fn transform(&mut self, transform: &DAffine3) {
        for position in self.positions_mut() {
            *position = transform.transform_point3(position.as_dvec3()).as_vec3();
        }
        let mirrors = transform.matrix3.determinant() < 0.0;
        let mut normal_matrix = cofactors(&transform.matrix3);
        if mirrors {
            normal_matrix *= -1.0;
            self.flip_faces();
        }
        for normal in self.attributes_mut().corner_normals.iter_mut().flatten() {
            *normal = transformed_normal(&normal_matrix, *normal);
        }
    }
}

fn transformed_normal(matrix: &DMat3, normal: Vec3) -> Vec3 {
    unit_or_zero(*matrix * normal.as_dvec3()).as_vec3()
}

/// The matrix of cofactors: determinant times inverse transpose, but defined
/// without an inverse. It maps area vectors.
fn cofactors(matrix: &DMat3) -> DMat3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y))
}
