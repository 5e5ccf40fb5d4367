//! Joining: another mesh becomes part of this one.

use trigon_math::{DAffine3, DMat3, Vec3, cofactors, is_mirroring, transformed_delta, transformed_direction};

use super::copy::CopiedElements;
use crate::edit_mesh::EditMesh;
use crate::layers::{Layer, LayerKind, LayerValues};
use crate::refusal::Refusal;
use crate::slots::NewElements;

impl EditMesh {
    /// Adds all elements of another mesh, transformed (from its space to this one's, in metres), with their
    /// values and marks. The two are not welded where they touch.
    ///
    /// Positions are computed in f64 and rounded once; normals, tangents and morph targets are rotated, and a
    /// mirroring transform flips the faces, so that outside stays outside. Sets of texture coordinates
    /// correspond by order. Layers that either mesh lacks are zero for it, colours white. Material slots,
    /// joints and numbers of morph targets are unchanged: if they mean different things in the two objects,
    /// adjust them first. Vertex groups of the same name become one.
    ///
    /// # Errors
    /// There would be too many elements, or too many vertex groups.
    pub fn join_mesh(&mut self, other: &Self, transform: &DAffine3) -> Result<CopiedElements, Refusal> {
        self.check_capacity_for(NewElements::of(other))?;
        self.check_groups_with(other)?;
        if *transform == DAffine3::IDENTITY {
            return Ok(self.append(other));
        }
        let mut moved = other.clone();
        moved.bake(transform);
        let added = self.append(&moved);
        if is_mirroring(&transform.matrix3) {
            added.faces.iter().try_for_each(|&face| self.flip_face(face))?;
        }
        Ok(added)
    }

    /// Transforms all values. Faces, and the sides to which normals point, are not flipped by a
    /// mirroring transform.
    fn bake(&mut self, transform: &DAffine3) {
        for column in [&mut self.positions, &mut self.first_positions] {
            for position in column.write_all() {
                *position = transform.transform_point3(position.as_dvec3()).as_vec3();
            }
        }
        let matrix = transform.matrix3;
        for layer in &mut self.vertex_layers {
            if let (LayerKind::MorphPosition(_), LayerValues::Vec3(column)) = (layer.kind, &mut layer.values)
            {
                for delta in column.write_all() {
                    *delta = (matrix * delta.as_dvec3()).as_vec3();
                }
            }
        }
        // Differences first: they refer to the directions as they were.
        let normal_matrix = cofactors(&matrix);
        let normals = directions(&self.corner_layers, LayerKind::Normal);
        let tangents = directions(&self.corner_layers, LayerKind::Tangent);
        for layer in &mut self.corner_layers {
            match (layer.kind, &mut layer.values) {
                (LayerKind::MorphNormal(_), LayerValues::Vec3(column)) => {
                    bake_deltas(column.write_all(), &normals, &normal_matrix);
                }
                (LayerKind::MorphTangent(_), LayerValues::Vec3(column)) => {
                    bake_deltas(column.write_all(), &tangents, &matrix);
                }
                (LayerKind::Normal, LayerValues::Vec3(column)) => {
                    for normal in column.write_all() {
                        *normal = transformed_direction(&normal_matrix, *normal);
                    }
                }
                (LayerKind::Tangent, LayerValues::Vec4(column)) => {
                    for tangent in column.write_all() {
                        let direction = transformed_direction(&matrix, tangent.truncate());
                        *tangent = direction.extend(tangent.w);
                    }
                }
                _ => {}
            }
        }
    }
}

/// The directions of a layer; none without it.
fn directions(layers: &[Layer], kind: LayerKind) -> Vec<Vec3> {
    match layers.iter().find(|layer| layer.kind == kind).map(|layer| &layer.values) {
        Some(LayerValues::Vec3(column)) => column.values().to_vec(),
        Some(LayerValues::Vec4(column)) => column.values().iter().map(|value| value.truncate()).collect(),
        _ => Vec::new(),
    }
}

fn bake_deltas(deltas: &mut [Vec3], bases: &[Vec3], matrix: &DMat3) {
    for (index, delta) in deltas.iter_mut().enumerate() {
        let base = bases.get(index).copied().unwrap_or(Vec3::ZERO);
        *delta = transformed_delta(matrix, base, *delta);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{DVec3, Vec2, Vec4};
    use trigon_mesh::{Attributes, Mesh, primitives};

    use super::super::region::tests::{check_change, counts};
    use super::*;
    use crate::FaceId;
    use crate::tests::{meshes, with_affine_values};

    fn without_values(mut mesh: Mesh) -> Mesh {
        mesh.set_attributes(Attributes::default()).expect("none");
        mesh
    }

    #[test]
    fn two_cubes_keep_their_values_and_get_those_of_each_other() {
        let start = with_affine_values(primitives::cube(2.0));
        let plain = EditMesh::from_mesh(&without_values(primitives::cube(2.0))).0;
        let away = DAffine3::from_translation(DVec3::X * 5.0);
        let (mesh, added) = check_change(&start, |mesh| mesh.join_mesh(&plain, &away)).expect("room");
        assert_eq!(counts(&mesh), [16, 24, 12], "two cubes");
        let corner = mesh.face_corners(added.faces[0]).next().expect("four");
        assert_eq!(
            (mesh.uv(0, corner), mesh.color(corner)),
            (Some(Vec2::ZERO), Some(Vec4::ONE)),
            "no values"
        );
        assert!((mesh.to_mesh().0.volume() - 16.0).abs() < 1e-9, "whole numbers");

        let rich = EditMesh::from_mesh(&start).0;
        let plain = without_values(primitives::cube(2.0));
        let (mesh, added) = check_change(&plain, |mesh| mesh.join_mesh(&rich, &away)).expect("room");
        assert_eq!(mesh.uv_set_count(), 1, "a set was added");
        let corner = mesh.face_corners(FaceId(0)).next().expect("four");
        assert_eq!(
            (mesh.uv(0, corner), mesh.color(corner)),
            (Some(Vec2::ZERO), Some(Vec4::ONE)),
            "no values"
        );
        let pairs = mesh.face_corners(added.faces[3]).zip(rich.face_corners(FaceId(3)));
        for (new, old) in pairs {
            assert_eq!(
                (mesh.uv(0, new), mesh.color(new)),
                (rich.uv(0, old), rich.color(old)),
                "carried over"
            );
        }
    }

    #[test]
    fn a_mirrored_mesh_looks_outwards() {
        let mut start = primitives::uv_sphere(1.0, 8, 4);
        let normals = start.shading_normals();
        let attributes = Attributes { corner_normals: Some(normals), ..start.attributes().clone() };
        start.set_attributes(attributes).expect("one for each corner");
        let mirror = DAffine3::from_scale_rotation_translation(
            DVec3::new(-2.0, 1.0, 1.0),
            trigon_math::DQuat::from_rotation_y(1.0),
            DVec3::new(1.0, 2.0, 3.0),
        );
        let mut joined = EditMesh::new();
        joined.join_mesh(&EditMesh::from_mesh(&start).0, &mirror).expect("room");
        joined.check_structure().expect("whole");
        let expected = start.transformed(&mirror);
        let (mesh, _) = joined.to_mesh();
        assert!((mesh.volume() - expected.volume()).abs() < 1e-6, "{} outwards", mesh.volume());
        assert!(mesh.volume() > 0.0, "the inside is inside");
        assert_eq!(mesh.positions(), expected.positions(), "the same transform");
        for face in 0..mesh.face_count() {
            let normal = mesh.face_area_vector(face);
            for corner in mesh.face_corners(face) {
                let given = mesh.attributes().corner_normals.as_ref().expect("given")[corner];
                assert!(given.as_dvec3().dot(normal) > 0.0, "normals point outwards");
            }
        }
    }

    proptest! {
        #[test]
        fn joining_adds_the_numbers(start in meshes(), other in meshes()) {
            let other = EditMesh::from_mesh(&other).0;
            let turn = DAffine3::from_rotation_z(1.0);
            let sum = {
                let [a, b] = [counts(&EditMesh::from_mesh(&start).0), counts(&other)];
                [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
            };
            let (mesh, _) = check_change(&start, |mesh| mesh.join_mesh(&other, &turn)).expect("room");
            prop_assert_eq!(counts(&mesh), sum);
        }
    }
}
