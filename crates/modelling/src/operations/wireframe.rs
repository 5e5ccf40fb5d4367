//! Wireframes: the edges of faces become struts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_math::DVec3;

use super::region::Region;
use super::tables::IndexTable;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// Makes struts of the edges of faces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WireframeSettings {
    /// The width and height of struts, in metres.
    #[schemars(range(min = 0.0))]
    pub thickness: f64,
    /// Whether the faces go, with edges and vertices that nothing else uses.
    pub replace: bool,
}

impl Default for WireframeSettings {
    /// Two centimetres, in place of the faces.
    fn default() -> Self {
        Self { thickness: 0.02, replace: true }
    }
}

const OPERATION: &str = "making a wireframe";

/// A corner at an acute angle moves at most this many times as far as its edges.
const LONGEST: f64 = 20.0;

/// The vertices of a strut at an end, on both sides of the surface: in front and behind.
type StrutEnd = [VertexId; 2];

impl EditMesh {
    /// Makes a strut of each edge of faces: a closed solid where each edge has at most two of the faces.
    ///
    /// Struts are as wide as high: half of the thickness on each side of the surface, and half on each side of the edge; at
    /// a border, within the face only. Both are measured evenly: planes of faces move by that distance as in
    /// [`Self::solidify_faces`], and sides of faces likewise within their plane. Faces with edges shorter than the
    /// thickness may overlap. Values are those of the faces. The new faces, for each corner its front, its back and the
    /// side of its hole, and then a side at each border.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the thickness is out of range; there would be too many elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, FaceId, WireframeSettings};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// let faces: Vec<FaceId> = cube.faces().collect();
    /// let made = cube.wireframe_faces(&faces, &WireframeSettings::default())?;
    /// assert_eq!(made.len(), 72, "three for each of 24 corners");
    /// assert!(cube.is_watertight());
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn wireframe_faces(
        &mut self,
        faces: &[FaceId],
        settings: &WireframeSettings,
    ) -> Result<Vec<FaceId>, Refusal> {
        let region = Region::new(self, faces, OPERATION)?;
        let &WireframeSettings { thickness, replace } = settings;
        if !(thickness >= 0.0 && thickness.is_finite()) {
            let parameter = "the thickness of struts";
            return Err(Refusal::OutOfRange { parameter, value: thickness, range: "at least 0" });
        }
        let vertices = region.vertices(self);
        let border = self.single_sides(&region);
        let (corners, rim) = (region.corner_count(self) as u64, border.len() as u64);
        self.check_capacity_for(NewElements {
            vertices: 2 * (vertices.len() as u64 + corners),
            edges: 8 * corners + 2 * rim,
            corners: 12 * corners + 4 * rim,
            faces: 3 * corners + rim,
        })?;
        let half = thickness / 2.0;
        let shifts = self.shifts(&region, &vertices, true);
        let mut numbers = IndexTable::new(self.vertex_capacity(), vertices.len());
        let mut sides = Vec::with_capacity(vertices.len());
        for ((number, &vertex), &shift) in (0..).zip(&vertices).zip(&shifts) {
            numbers.insert(vertex.0, number);
            sides.push(self.both_sides(vertex, self.point(vertex), shift * half));
        }
        let struts = Struts { numbers, sides, half };
        let mut made = Vec::new();
        for &face in &region.faces {
            self.add_struts(face, &struts, &mut made);
        }
        for border in border {
            let (from, to) = (border.inner, self.next_corner(border.inner));
            let [a, b] = [from, to].map(|corner| struts.at(self.corner_vertex(corner)));
            let wall = self.face_of(&[b[0], a[0], a[1], b[1]]);
            self.dress_strut(wall, [to, from, from, to]);
            made.push(wall);
        }
        if replace {
            self.delete_faces(&region.faces)?;
        }
        Ok(made)
    }

    /// Two vertices like one, at a position plus and minus a vector.
    fn both_sides(&mut self, like: VertexId, position: DVec3, by: DVec3) -> StrutEnd {
        [position + by, position - by].map(|position| {
            let vertex = self.twin_vertex(like);
            self.set_position(vertex, position.as_vec3());
            self.set_first_position(vertex, position.as_vec3());
            vertex
        })
    }

    /// The parts of all struts in one face.
    fn add_struts(&mut self, face: FaceId, struts: &Struts, made: &mut Vec<FaceId>) {
        let normal = self.face_normal(face);
        let corners: Vec<CornerId> = self.face_corners(face).collect();
        let inner: Vec<StrutEnd> = corners
            .iter()
            .map(|&corner| {
                let position =
                    self.point(self.corner_vertex(corner)) + self.inset(corner, normal) * struts.half;
                self.both_sides(self.corner_vertex(corner), position, normal * struts.half)
            })
            .collect();
        for (i, &from) in corners.iter().enumerate() {
            let next = (i + 1) % corners.len();
            let to = corners[next];
            let [a, b] = [from, to].map(|corner| struts.at(self.corner_vertex(corner)));
            let (c, d) = (inner[next], inner[i]);
            for (outline, sources) in [
                ([a[0], b[0], c[0], d[0]], [from, to, to, from]),
                ([b[1], a[1], d[1], c[1]], [to, from, from, to]),
                ([d[0], c[0], c[1], d[1]], [from, to, to, from]),
            ] {
                let part = self.face_of(&outline);
                self.dress_strut(part, sources);
                made.push(part);
            }
        }
    }

    /// By which vector a corner moves within its face so that both edges there move by 1.
    fn inset(&self, corner: CornerId, normal: DVec3) -> DVec3 {
        let point = |corner: CornerId| self.point(self.corner_vertex(corner));
        let here = point(corner);
        let [back, ahead] =
            [here - point(self.previous_corner(corner)), point(self.next_corner(corner)) - here]
                .map(|way| normal.cross(way).normalize_or_zero());
        let sum = back + ahead;
        // At an edge without length, only the other one counts.
        let inset =
            if back == DVec3::ZERO || ahead == DVec3::ZERO { sum } else { sum / (1.0 + back.dot(ahead)) };
        if inset.length() <= LONGEST { inset } else { sum.normalize_or_zero() * LONGEST }
    }

    fn dress_strut(&mut self, part: FaceId, sources: [CornerId; 4]) {
        self.copy_face(self.corner_face(sources[0]), part);
        let corners: Vec<CornerId> = self.face_corners(part).collect();
        for (corner, source) in corners.into_iter().zip(sources) {
            self.copy_corner_upright(source, corner);
        }
    }
}

/// The vertices of struts at the vertices of faces.
struct Struts {
    numbers: IndexTable,
    sides: Vec<StrutEnd>,
    /// Half of the thickness.
    half: f64,
}

impl Struts {
    fn at(&self, vertex: VertexId) -> StrutEnd {
        self.sides[self.numbers.get(vertex.0).expect("all vertices of the faces have them") as usize]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{check_operation, meshes};

    fn wireframe(mesh: trigon_mesh::Mesh, thickness: f64) -> EditMesh {
        let (mut mesh, _) = EditMesh::from_mesh(&mesh);
        let faces: Vec<FaceId> = mesh.faces().collect();
        let settings = WireframeSettings { thickness, ..WireframeSettings::default() };
        mesh.wireframe_faces(&faces, &settings).expect("possible");
        mesh.check_structure().expect("whole");
        assert!(mesh.is_watertight());
        mesh
    }

    #[test]
    fn struts_have_the_thickness() {
        // A cube with windows on all sides.
        let t = 0.25;
        let (outer, inner): (f64, f64) = (2.0 + t, 2.0 - t);
        let expected = outer * outer * outer - inner * inner * inner - 6.0 * inner * inner * t;
        let volume = wireframe(primitives::cube(2.0), t).volume();
        assert!((volume - expected).abs() < 1e-12, "{volume} for {expected}");
        // A frame within its border.
        let volume = wireframe(primitives::grid(2.0, 2.0, 1, 1), t).volume();
        let expected = (4.0 - inner * inner) * t;
        assert!((volume - expected).abs() < 1e-12, "{volume} for {expected}");
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let wrong = WireframeSettings { thickness: -1.0, ..WireframeSettings::default() };
        assert!(cube.wireframe_faces(&[FaceId(0)], &wrong).is_err());
        assert!(cube.wireframe_faces(&[], &WireframeSettings::default()).is_err());
    }

    proptest! {
        #[test]
        fn wireframes_of_any_faces_are_in_order(start in meshes(), bits in any::<u64>(), replace: bool) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let faces: Vec<FaceId> = mesh.faces().filter(|face| bits >> (face.0 % 64) & 1 != 0).collect();
            prop_assume!(!faces.is_empty());
            let settings = WireframeSettings { thickness: 0.05, replace };
            let outcome = check_operation(&mesh, |mesh| mesh.wireframe_faces(&faces, &settings));
            let (after, made) = outcome.map_err(TestCaseError::fail)?.expect("possible");
            let corners: usize = faces.iter().map(|&face| mesh.face_size(face)).sum();
            prop_assert!(made.len() >= 3 * corners);
            prop_assert!(after.vertices().all(|vertex| after.position(vertex).is_finite()));
            if mesh.is_watertight() && faces.len() == mesh.face_count() && replace {
                prop_assert!(after.is_watertight());
            }
        }
    }
}
