//! Meshes from the lists that most programs have: triangles as indices of vertices, and normals, texture coordinates
//! and colours with one value for each vertex.

use trigon_math::{Vec2, Vec3, Vec4};

use crate::builder::check_capacity;
use crate::{Mesh, MeshBuilder, MeshError};

impl Mesh {
    /// A mesh of triangles. Positions are in metres; each triangle has the indices of its vertices, counter-clockwise
    /// seen from outside.
    ///
    /// Its faces are flat unless [normals](Self::with_vertex_normals) are given or
    /// [computed](Self::smooth_by_angle).
    ///
    /// # Errors
    /// A triangle has fewer than three distinct vertices or one that does not exist, or there are more corners than
    /// indices can count.
    ///
    /// ```
    /// use trigon_mesh::{Mesh, math::{Vec2, Vec3}};
    ///
    /// let square = Mesh::from_triangles(
    ///     &[Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
    ///     &[[0, 1, 2], [0, 2, 3]],
    /// )?
    /// .with_vertex_normals(&[Vec3::Z; 4])?
    /// .with_vertex_uvs(&[Vec2::Y, Vec2::ONE, Vec2::X, Vec2::ZERO])?;
    /// assert_eq!((square.face_count(), square.edge_count()), (2, 5));
    /// # Ok::<(), trigon_mesh::MeshError>(())
    /// ```
    pub fn from_triangles(positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<Self, MeshError> {
        check_capacity("vertices", positions.len())?;
        let mut builder = MeshBuilder::with_capacity(positions.len(), triangles.len(), 3 * triangles.len());
        for &position in positions {
            builder.push_vertex(position);
        }
        builder.push_triangles(triangles)?;
        Ok(builder.build())
    }

    /// The same mesh with a shading normal for each vertex; see [`Attributes::corner_normals`](crate::Attributes::corner_normals) for those that are none.
    ///
    /// # Errors
    /// There is not one for each vertex.
    pub fn with_vertex_normals(mut self, normals: &[Vec3]) -> Result<Self, MeshError> {
        self.attributes_mut().corner_normals = Some(self.corner_values("normals", normals)?);
        Ok(self)
    }

    /// The same mesh with a further set of texture coordinates, one for each vertex. (0, 0) is the upper left corner of
    /// the image.
    ///
    /// # Errors
    /// There is not one for each vertex.
    pub fn with_vertex_uvs(mut self, uvs: &[Vec2]) -> Result<Self, MeshError> {
        let set = self.corner_values("texture coordinates", uvs)?;
        self.attributes_mut().uv_sets.push(set);
        Ok(self)
    }

    /// The same mesh with a colour for each vertex, which faces, loose edges and points show: linear light, straight
    /// alpha. `trigon_math::color` converts sRGB.
    ///
    /// # Errors
    /// There is not one for each vertex.
    pub fn with_vertex_colors(mut self, colors: &[Vec4]) -> Result<Self, MeshError> {
        self.attributes_mut().corner_colors = Some(self.corner_values("colours", colors)?);
        self.attributes_mut().vertex_colors = Some(colors.to_vec());
        Ok(self)
    }

    /// Values of corners from those of vertices: each corner has the value of its vertex.
    ///
    /// # Errors
    /// There is not one for each vertex. `what` stands in the message.
    pub fn corner_values<T: Copy>(&self, what: &'static str, values: &[T]) -> Result<Vec<T>, MeshError> {
        let (expected, found) = (self.vertex_count(), values.len());
        if found != expected {
            return Err(MeshError::AttributeLength { attribute: what, element: "vertices", expected, found });
        }
        Ok(self.corner_vertices().iter().map(|&vertex| values[vertex as usize]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair() -> Mesh {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y];
        Mesh::from_triangles(&positions, &[[2, 0, 1], [0, 2, 3]]).expect("two triangles")
    }

    #[test]
    fn corners_have_the_values_of_their_vertices() {
        let colors = [Vec4::X, Vec4::Y, Vec4::Z, Vec4::W];
        let mesh = pair()
            .with_vertex_normals(&[Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE])
            .and_then(|mesh| mesh.with_vertex_uvs(&[Vec2::X, Vec2::Y, Vec2::ONE, Vec2::ZERO]))
            .and_then(|mesh| mesh.with_vertex_colors(&colors))
            .expect("one for each vertex");
        let attributes = mesh.attributes();
        let normals = [Vec3::Z, Vec3::X, Vec3::Y, Vec3::X, Vec3::Z, Vec3::ONE];
        assert_eq!(attributes.corner_normals.as_deref(), Some(&normals[..]), "normals");
        assert_eq!(
            attributes.uv_sets,
            [[Vec2::ONE, Vec2::X, Vec2::Y, Vec2::X, Vec2::ONE, Vec2::ZERO]],
            "coordinates"
        );
        let shown = [Vec4::Z, Vec4::X, Vec4::Y, Vec4::X, Vec4::Z, Vec4::W];
        assert_eq!(attributes.corner_colors.as_deref(), Some(&shown[..]), "of faces");
        assert_eq!(attributes.vertex_colors.as_deref(), Some(&colors[..]), "of points");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let missing = Mesh::from_triangles(&[Vec3::ZERO; 3], &[[0, 1, 3]]).expect_err("a vertex is missing");
        assert!(missing.to_string().contains("uses vertex 3"), "{missing}");
        let flat = Mesh::from_triangles(&[Vec3::ZERO; 3], &[[0, 1, 2], [0, 1, 1]]).expect_err("two corners");
        assert!(flat.to_string().contains("face 1 has 2 distinct vertices"), "{flat}");
        let short = pair().with_vertex_uvs(&[Vec2::ZERO; 6]).expect_err("of corners");
        assert!(short.to_string().contains("6 values, but the mesh has 4 vertices"), "{short}");
        assert_eq!(Mesh::from_triangles(&[], &[]).expect("empty"), Mesh::default(), "nothing");
    }
}
