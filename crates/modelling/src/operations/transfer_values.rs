//! Transfer of texture coordinates and colours from another mesh.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smallvec::{SmallVec, smallvec};
use trigon_math::{DAffine3, DVec2, DVec4, Vec4};

use super::surface_tree::{SurfaceTree, face_triangles};
use crate::column::Column;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};
use crate::layers::{Layer, LayerKind, LayerValues};
use crate::refusal::Refusal;

/// A mesh from which values are taken.
#[derive(Debug, Clone, Copy)]
pub struct TransferSource<'a> {
    /// The mesh.
    pub mesh: &'a EditMesh,
    /// From its space to that of the mesh that gets the values.
    pub transform: DAffine3,
}

/// Which corner of the source a value comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TransferMapping {
    /// The nearest point of its surface.
    #[default]
    Nearest,
    /// The same corner of the same face, for meshes that differ in positions only.
    Topology,
}

/// Parameters of [`EditMesh::transfer_values`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TransferSettings {
    /// Where values come from.
    pub mapping: TransferMapping,
    /// Whether all sets of texture coordinates are transferred.
    pub uvs: bool,
    /// Whether colours are transferred.
    pub colors: bool,
}

impl Default for TransferSettings {
    /// Texture coordinates of the nearest points.
    fn default() -> Self {
        Self { mapping: TransferMapping::Nearest, uvs: true, colors: false }
    }
}

const OPERATION: &str = "transferring texture coordinates";

/// How far into its face a corner is moved to find the face of the source, as a part of the way to the middle of its
/// triangle: where faces of different islands meet, this decides for one of them.
const INWARDS: f64 = 0.01;

/// Corners of the source and their weights, which add up to 1.
type SourceParts = SmallVec<[(CornerId, f64); 3]>;

impl EditMesh {
    /// Gives the corners of faces the texture coordinates or colours of another mesh.
    ///
    /// By nearest points, the source's face is the nearest one to a position slightly inside the own face, so that both
    /// sides of a seam keep their islands; within it, the value is that of the point nearest to the corner, between the
    /// corners of its triangle. A corner in the position of the source's corner has exactly its value. Sets of texture
    /// coordinates, or colours, that the mesh does not have are added.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the source has no such values; by topology, the faces of both meshes are
    /// not the same.
    ///
    /// ```
    /// use trigon_math::DAffine3;
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, FaceId, TransferSettings, TransferSource};
    ///
    /// let (source, _) = EditMesh::from_mesh(&primitives::uv_sphere(1.0, 16, 8));
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(1.0));
    /// let faces: Vec<FaceId> = cube.faces().collect();
    /// let source = TransferSource { mesh: &source, transform: DAffine3::IDENTITY };
    /// cube.transfer_values(&faces, &source, &TransferSettings::default())?;
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn transfer_values(
        &mut self,
        faces: &[FaceId],
        source: &TransferSource<'_>,
        settings: &TransferSettings,
    ) -> Result<(), Refusal> {
        self.check_faces(faces, OPERATION)?;
        let refused = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        let has_colors =
            source.mesh.corners().next().is_some_and(|corner| source.mesh.color(corner).is_some());
        if settings.uvs && source.mesh.uv_set_count() == 0 {
            return refused("the other mesh has none: unwrap it first");
        }
        if settings.colors && !has_colors {
            return refused("the other mesh has no colours");
        }
        let matches = match settings.mapping {
            TransferMapping::Nearest => self.nearest_corners(faces, source)?,
            TransferMapping::Topology => self.same_corners(faces, source.mesh)?,
        };
        self.whole(|mesh| {
            if settings.uvs {
                mesh.take_uvs(&matches, source.mesh)?;
            }
            if settings.colors {
                mesh.take_colors(&matches, source.mesh);
            }
            Ok(())
        })
    }

    fn nearest_corners(
        &self,
        faces: &[FaceId],
        source: &TransferSource<'_>,
    ) -> Result<Vec<(CornerId, SourceParts)>, Refusal> {
        let tree = SurfaceTree::new(source.mesh, &source.transform);
        let triangles = face_triangles(self, faces, &DAffine3::IDENTITY);
        // A corner of several triangles of a face is moved inwards in the last one of them.
        let mut last = vec![0; self.corner_capacity()];
        for (index, triangle) in triangles.iter().enumerate() {
            triangle.corners.iter().for_each(|corner| last[corner.0 as usize] = index);
        }
        let mut matches = Vec::new();
        for (index, triangle) in triangles.iter().enumerate() {
            for (&corner, &point) in triangle.corners.iter().zip(&triangle.points) {
                if last[corner.0 as usize] != index {
                    continue;
                }
                let inside = point.lerp(triangle.middle(), INWARDS);
                let Some(found) = tree.nearest(inside) else {
                    let reason = "a mesh has no faces, or a position is not finite: repair it first";
                    return Err(Refusal::NotPossible { operation: OPERATION, reason });
                };
                matches.push((corner, tree.nearest_of_face(&found, point).parts().collect()));
            }
        }
        Ok(matches)
    }

    fn same_corners(&self, faces: &[FaceId], source: &Self) -> Result<Vec<(CornerId, SourceParts)>, Refusal> {
        let reason = "the faces of both meshes are not the same: transfer by the nearest points";
        let differ = Refusal::NotPossible { operation: OPERATION, reason };
        let ranks = [self, source].map(vertex_ranks);
        if self.face_count() != source.face_count() || self.corner_count() != source.corner_count() {
            return Err(differ);
        }
        let mut partner = vec![None; self.face_capacity()];
        for (own, other) in self.faces().zip(source.faces()) {
            let vertices = |mesh: &Self, face, ranks: &[u32]| {
                mesh.face_vertices(face)
                    .map(|vertex: VertexId| ranks[vertex.0 as usize])
                    .collect::<Vec<u32>>()
            };
            if vertices(self, own, &ranks[0]) != vertices(source, other, &ranks[1]) {
                return Err(differ);
            }
            partner[own.0 as usize] = Some(other);
        }
        let pairs = faces.iter().flat_map(|&face| {
            let other = partner[face.0 as usize].expect("each face has one");
            self.face_corners(face).zip(source.face_corners(other))
        });
        Ok(pairs.map(|(own, other)| (own, smallvec![(other, 1.0)])).collect())
    }

    fn take_uvs(&mut self, matches: &[(CornerId, SourceParts)], source: &Self) -> Result<(), Refusal> {
        for set in 0..source.uv_set_count() {
            if set == self.uv_set_count() {
                self.add_uv_set(set)?;
            }
            for (corner, parts) in matches {
                let uv = |corner: CornerId| source.uv(set, corner).unwrap_or_default();
                // A single one keeps its bits.
                let value = match parts[..] {
                    [(only, _)] => uv(only),
                    _ => parts.iter().map(|&(part, w)| uv(part).as_dvec2() * w).sum::<DVec2>().as_vec2(),
                };
                self.set_uv(set, *corner, value);
            }
        }
        Ok(())
    }

    fn take_colors(&mut self, matches: &[(CornerId, SourceParts)], source: &Self) {
        if !self.corner_layers.iter().any(|layer| layer.kind == LayerKind::Color) {
            let values = LayerValues::Vec4(Column::new(vec![Vec4::ONE; self.corner_capacity()]));
            self.corner_layers.push(Layer { kind: LayerKind::Color, values });
        }
        for (corner, parts) in matches {
            let color = |corner: CornerId| source.color(corner).unwrap_or(Vec4::ONE);
            let value = match parts[..] {
                [(only, _)] => color(only),
                _ => parts.iter().map(|&(part, w)| color(part).as_dvec4() * w).sum::<DVec4>().as_vec4(),
            };
            self.set_color(*corner, value);
        }
    }
}

/// For each index of a vertex its number among all that exist.
fn vertex_ranks(mesh: &EditMesh) -> Vec<u32> {
    let mut ranks = vec![u32::MAX; mesh.vertex_capacity()];
    for (rank, vertex) in (0..).zip(mesh.vertices()) {
        ranks[vertex.0 as usize] = rank;
    }
    ranks
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{DVec3, Vec2};
    use trigon_mesh::primitives;

    use super::*;
    use crate::SmartProjection;
    use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

    fn both(mapping: TransferMapping) -> TransferSettings {
        TransferSettings { mapping, uvs: true, colors: true }
    }

    fn source(mesh: &EditMesh) -> TransferSource<'_> {
        TransferSource { mesh, transform: DAffine3::IDENTITY }
    }

    fn all(mesh: &EditMesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    #[test]
    fn a_copy_gets_the_same_bytes() {
        for mesh in [primitives::cube(2.0), primitives::icosphere(1.0, 1), primitives::torus(1.0, 0.3, 12, 8)]
        {
            let (mut unwrapped, _) = EditMesh::from_mesh(&with_affine_values(mesh.clone()));
            unwrapped.smart_project_uvs(&all(&unwrapped), &SmartProjection::default()).expect("islands");
            for mapping in [TransferMapping::Nearest, TransferMapping::Topology] {
                let (mut copy, _) = EditMesh::from_mesh(&mesh);
                let faces = all(&copy);
                copy.transfer_values(&faces, &source(&unwrapped), &both(mapping)).expect("a copy");
                for (own, other) in copy.corners().zip(unwrapped.corners()) {
                    assert_eq!(copy.uv(0, own), unwrapped.uv(0, other), "{own}, {mapping:?}");
                    assert_eq!(copy.color(own), unwrapped.color(other), "{own}, {mapping:?}");
                }
            }
        }
    }

    #[test]
    fn a_subdivided_mesh_gets_what_is_between() {
        for mesh in [primitives::grid(2.0, 2.0, 2, 2), primitives::cube(2.0)] {
            let (from, _) = EditMesh::from_mesh(&with_affine_values(mesh.clone()));
            let (mut fine, _) = EditMesh::from_mesh(&mesh);
            let edges: Vec<_> = fine.edges().collect();
            fine.subdivide(&edges, 3).expect("some");
            fine.transfer_values(&all(&fine), &source(&from), &both(TransferMapping::Nearest)).expect("near");
            keeps_affine_values(&fine).expect("affine");
            let refused = fine.transfer_values(&all(&fine), &source(&from), &both(TransferMapping::Topology));
            assert!(refused.expect_err("other faces").to_string().contains("not the same"));
        }
    }

    /// Both halves of a sheet are islands of their own: a corner at the seam has the value of its own side.
    #[test]
    fn islands_stay_apart() {
        let (mut sheet, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(2.0, 2.0, 2, 2)));
        for face in all(&sheet) {
            let island = if sheet.face_center(face).x < 0.0 { -10.0 } else { 10.0 };
            let corners: Vec<CornerId> = sheet.face_corners(face).collect();
            corners.into_iter().for_each(|corner| sheet.set_uv(0, corner, Vec2::splat(island)));
        }
        let (mut fine, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 6, 6));
        let moved = TransferSource { mesh: &sheet, transform: DAffine3::from_translation(DVec3::Y) };
        let (part, settings) = (all(&fine)[..18].to_vec(), TransferSettings::default());
        fine.transfer_values(&part, &moved, &settings).expect("near");
        for face in part {
            let expected = if fine.face_center(face).x < 0.0 { -10.0 } else { 10.0 };
            for corner in fine.face_corners(face) {
                assert_eq!(fine.uv(0, corner), Some(Vec2::splat(expected)));
            }
        }
        let other = fine.face_corners(all(&fine)[30]).next().expect("a corner");
        assert_ne!(fine.uv(0, other).map(|uv| uv.x.abs()), Some(10.0), "others stay");
        assert!(fine.color(other).is_none(), "colours were not asked for");
        let nothing = EditMesh::new();
        assert!(fine.transfer_values(&all(&fine), &source(&nothing), &settings).is_err(), "no values");
        assert!(fine.transfer_values(&[], &moved, &settings).is_err(), "no faces");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn transfers_are_undone(start in meshes(), other in meshes(), bits in any::<u64>(), by_topology: bool) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let (other, _) = EditMesh::from_mesh(&with_affine_values(other));
            let mapping = if by_topology { TransferMapping::Topology } else { TransferMapping::Nearest };
            let faces: Vec<FaceId> = mesh.faces().filter(|face| bits >> (face.0 % 64) & 1 != 0).collect();
            let outcome =
                check_operation(&mesh, |mesh| mesh.transfer_values(&faces, &source(&other), &both(mapping)));
            if let Some((after, ())) = outcome.map_err(TestCaseError::fail)? {
                for corner in after.corners() {
                    prop_assert!(after.uv(0, corner).expect("a set").is_finite());
                }
            }
        }
    }
}
