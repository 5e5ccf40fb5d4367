//! Cuts along the outline of another mesh, projected in a direction: Blender's Knife Project.

use trigon_math::{Bvh, DAffine3, DVec3, Ray, Vec3, area_vector};

use super::in_view::FacesInView;
use super::{KnifeCut, KnifePoint, ProjectedLine, Sight};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};
use crate::operations::delete::require;
use crate::refusal::Refusal;

const OPERATION: &str = "projecting an outline";

/// How the outline of a mesh is projected onto another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnifeProjection {
    /// From the other mesh into the space of this one.
    pub transform: DAffine3,
    /// Where the outline is projected to, in the space of this mesh; its length does not matter.
    pub direction: DVec3,
    /// Whether faces that others hide, as seen in this direction, are cut, too.
    pub cut_through: bool,
}

/// A line that is seen in a direction, from far away.
pub(super) struct ParallelLine {
    pub(super) ends: [DVec3; 2],
    direction: DVec3,
    pub(super) normal: DVec3,
    pub(super) along: DVec3,
}

impl ParallelLine {
    /// `None` if the line is seen as a point.
    pub(super) fn new(ends: [DVec3; 2], direction: DVec3) -> Option<Self> {
        let way = ends[1] - ends[0];
        let normal = direction.cross(way);
        let along = normal.cross(direction);
        (along.length_squared() > 0.0).then_some(Self { ends, direction, normal, along })
    }
}

impl ProjectedLine for ParallelLine {
    fn side(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.ends[0])
    }

    fn progress(&self, point: DVec3) -> f64 {
        self.along.dot(point - self.ends[0])
    }

    fn sights(&self) -> [Sight; 2] {
        self.ends.map(|origin| Sight { origin, direction: self.direction })
    }
}

impl EditMesh {
    /// Cuts faces along the outline of another mesh, seen in a direction: its loose edges, its borders, and the edges
    /// between faces that look towards the viewer and faces that look away.
    ///
    /// A part of a line within a face counts as hidden as a whole if its middle is hidden by another face of this mesh.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the direction or the transform is not finite, or the direction is zero;
    /// the outline passes none of the faces, or ends within all that it meets; there would be too many elements.
    pub fn knife_project(
        &mut self,
        faces: &[FaceId],
        tool: &EditMesh,
        projection: &KnifeProjection,
    ) -> Result<KnifeCut, Refusal> {
        require(faces, OPERATION, "at least one face")?;
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        let refused = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        let direction = projection.direction.normalize_or_zero();
        if direction == DVec3::ZERO || !projection.transform.is_finite() {
            return refused("the direction is zero, or a number is not finite; give a direction");
        }
        let position = |vertex| projection.transform.transform_point3(tool.point(vertex));
        let in_view = FacesInView::new(self, faces, direction);
        let mut strokes = Vec::new();
        for edge in tool.edges().filter(|&edge| tool.is_outline(edge, direction, position)) {
            let ends = tool.edge_vertices(edge).map(position);
            if let Some(line) = ParallelLine::new(ends, direction) {
                strokes.extend(self.knife_through(&in_view.beside(&line), &line));
            }
        }
        if !projection.cut_through {
            let occluders = Occluders::of(self);
            strokes.retain(|stroke| !occluders.hide(self, stroke, direction));
        }
        if strokes.is_empty() {
            return refused(
                "the outline passes none of the faces in this direction; turn or move the other mesh",
            );
        }
        self.knife(&strokes)
    }

    /// Whether an edge is a part of the outline of its mesh, seen in a direction.
    fn is_outline(
        &self,
        edge: EdgeId,
        direction: DVec3,
        position: impl Fn(crate::ids::VertexId) -> DVec3,
    ) -> bool {
        let looks_away =
            |face: FaceId| area_vector(self.face_vertices(face).map(&position)).dot(direction) >= 0.0;
        let mut faces = self.edge_faces(edge).map(looks_away);
        match [faces.next(), faces.next(), faces.next()] {
            [Some(one), Some(other), None] => one != other,
            _ => true,
        }
    }
}

/// What may hide a cut.
struct Occluders {
    tree: Bvh,
    /// Nearer ones are those that the cut lies on: a share of the mesh's size.
    near: f32,
}

impl Occluders {
    /// The visible faces of a mesh.
    fn of(mesh: &EditMesh) -> Self {
        let visible = mesh.triangles().into_iter().filter(|triangle| !mesh.is_face_hidden(triangle.face));
        let triangles: Vec<[Vec3; 3]> = visible.map(|triangle| triangle.positions).collect();
        let size =
            triangles.iter().flatten().map(|position| position.abs().max_element()).fold(0.0, f32::max);
        Self { tree: Bvh::new(&triangles), near: 1e-5 * size }
    }

    /// Whether the middle of a stroke of two points is hidden from a viewer who looks in a direction.
    fn hide(&self, mesh: &EditMesh, stroke: &[KnifePoint], direction: DVec3) -> bool {
        let sum: DVec3 = stroke.iter().map(|&point| mesh.knife_position(point)).sum();
        let origin = (sum / stroke.len() as f64).as_vec3();
        let ray = Ray { origin, direction: -direction.as_vec3() };
        self.tree.occluded(&ray, self.near..f32::INFINITY)
    }
}
