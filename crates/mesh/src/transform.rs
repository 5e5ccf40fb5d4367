//! Baking a transform into the vertices.

use trigon_math::{DAffine3, Vec3, Vec4, cofactors, is_mirroring, transformed_delta, transformed_direction};

use crate::Mesh;

impl Mesh {
    /// A copy with a transform baked into its vertices, see [`Mesh::transform`].
    #[must_use]
    pub fn transformed(&self, transform: &DAffine3) -> Mesh {
        let mut mesh = self.clone();
        mesh.transform(transform);
        mesh
    }

    /// Bakes a transform into the vertices. Positions are computed in f64 and rounded once. Corner normals
    /// are transformed by the cofactor matrix and keep unit length. A mirroring transform flips every face
    /// ([`Mesh::flip_faces`]) so that outside stays outside.
    ///
    /// A transform that flattens space to a plane gives the normals of that plane; one that gives a
    /// line or a point makes normals zero, which counts as "not given". Morph targets are
    /// transformed; skin weights are unchanged, and the caller must adjust the skin's inverse bind
    /// matrices.
    pub fn transform(&mut self, transform: &DAffine3) {
        for position in self.positions_mut() {
            *position = transform.transform_point3(position.as_dvec3()).as_vec3();
        }
        let mirrors = is_mirroring(&transform.matrix3);
        let mut normal_matrix = cofactors(&transform.matrix3);
        if mirrors {
            normal_matrix *= -1.0;
            self.flip_faces();
        }
        let attributes = self.attributes_mut();
        for target in &mut attributes.morph_targets {
            target.positions.map(|_, delta| (transform.matrix3 * delta.as_dvec3()).as_vec3());
            let normals = attributes.corner_normals.as_deref();
            target.normals.map(|corner, delta| {
                let base = normals.map_or(Vec3::ZERO, |normals| normals[corner as usize]);
                transformed_delta(&normal_matrix, base, delta)
            });
            let tangents = attributes.corner_tangents.as_deref();
            target.tangents.map(|corner, delta| {
                let base = tangents.map_or(Vec3::ZERO, |tangents| tangents[corner as usize].truncate());
                transformed_delta(&transform.matrix3, base, delta)
            });
        }
        for normal in attributes.corner_normals.iter_mut().flatten() {
            *normal = transformed_direction(&normal_matrix, *normal);
        }
        let handedness = if mirrors { -1.0 } else { 1.0 };
        for tangent in attributes.corner_tangents.iter_mut().flatten() {
            let direction = transformed_direction(&transform.matrix3, tangent.truncate());
            *tangent = Vec4::from((direction, tangent.w * handedness));
        }
    }
}
