//! Cutting faces along a path.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::Vec3;
use trigon_modelling::{EdgeId, FaceId, KnifePoint, VertexId};

use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::Change;

/// Cuts faces along a path of points, and selects the edges of the cut. Consecutive points must belong to the
/// same face; the path begins and ends at vertices or on edges.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Knife {
    /// The object whose mesh is cut. Default: the only edited one.
    pub object: Option<ObjectName>,
    /// At least two points.
    pub path: Vec<PathPoint>,
}

/// A point of a knife's path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "at", rename_all = "snake_case", deny_unknown_fields)]
pub enum PathPoint {
    /// At a vertex.
    Vertex {
        /// Its number.
        vertex: u32,
    },
    /// On an edge.
    Edge {
        /// Its number.
        edge: u32,
        /// The position from the edge's first vertex to its second: 0 to 1.
        #[schemars(range(min = 0.0, max = 1.0))]
        position: f64,
    },
    /// Inside a face.
    Face {
        /// Its number.
        face: u32,
        /// The position, in metres in the space of the mesh; it is projected onto the face along its normal.
        position: [f32; 3],
    },
}

impl From<PathPoint> for KnifePoint {
    fn from(point: PathPoint) -> Self {
        match point {
            PathPoint::Vertex { vertex } => Self::Vertex(VertexId::new(vertex)),
            PathPoint::Edge { edge, position } => Self::Edge(EdgeId::new(edge), position),
            PathPoint::Face { face, position } => Self::Face(FaceId::new(face), Vec3::from(position)),
        }
    }
}

impl Action for Knife {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let object = self.object.as_ref().map(|name| name.find(change.scene())).transpose()?;
        let id = change.only_edited_mesh(object, "cutting")?;
        let path: Vec<KnifePoint> = self.path.iter().map(|&point| point.into()).collect();
        let cut = change.edit(id, |mesh| Ok(mesh.knife(&path)?))?;
        let (faces, kind) = (cut.faces.len(), change.selection().kind());
        let (selections, meshes) = change.selection_and_meshes();
        if let (Some(selection), Some(mesh)) = (selections.of_mut(id), meshes.get(&id)) {
            selection.select(mesh, kind, &Elements::Edges(cut.edges));
        }
        Ok(Outcome::counted("made", faces, ["face", "faces"]))
    }
}
