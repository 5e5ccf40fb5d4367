//! Other faces for the same surface: Catmull-Clark, voxels, triangles, quads; filling holes and loops.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use trigon_modelling::{BridgeSettings as Bridge, VoxelRemeshSettings as VoxelRemesh};
use trigon_modelling::{GridSides, QuadLimits};

use super::action::{remake, whole_meshes};
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

const FACES: &str = "at least one selected face";

/// Subdivides whole meshes into smooth surfaces: the edited ones, or those of the selected objects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CatmullClark {
    /// The number of subdivisions.
    #[schemars(range(min = 1, max = 10))]
    pub levels: u32,
}

impl Default for CatmullClark {
    fn default() -> Self {
        Self { levels: 1 }
    }
}

impl Action for CatmullClark {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut faces = 0;
        for id in whole_meshes(change, "subdividing")? {
            faces += remake(change, id, |mesh| Ok(mesh.catmull_clark(self.levels).map(drop)?))?;
        }
        Ok(Outcome::counted("made", faces, ["face", "faces"]))
    }
}

impl Action for VoxelRemesh {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut faces = 0;
        for id in whole_meshes(change, "remeshing by voxels")? {
            faces += remake(change, id, |mesh| Ok(mesh.voxel_remesh(self).map(drop)?))?;
        }
        Ok(Outcome::counted("made", faces, ["face", "faces"]))
    }
}

/// Cuts the selected faces into triangles.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Triangulate {}

impl Action for Triangulate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("triangulating", FACES, |mesh, selection| {
            let made = mesh.triangulate_faces(&selection.faces(mesh, kind))?;
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Joins pairs of selected triangles into quads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TrisToQuads {
    /// The largest angle between the two triangles, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub face_angle: f64,
    /// The largest deviation of the quad's corners from right angles, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub shape_angle: f64,
}

impl Default for TrisToQuads {
    fn default() -> Self {
        Self { face_angle: 40.0, shape_angle: 40.0 }
    }
}

impl Action for TrisToQuads {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let limits = QuadLimits {
            face_angle: self.face_angle.to_radians(),
            shape_angle: self.shape_angle.to_radians(),
        };
        let mut quads = 0;
        change.edit_selected("joining triangles", "at least two selected triangles", |mesh, selection| {
            quads += mesh.tris_to_quads(&selection.faces(mesh, kind), limits)?.len();
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::counted("made", quads, ["quad", "quads"]))
    }
}

/// Makes a face from a loop or a chain of edges, or from vertices; two vertices become an edge.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Fill {}

impl Action for Fill {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("filling", "edges or vertices", |mesh, selection| {
            let edges = selection.edges(mesh, kind);
            let made = if kind == ElementKind::Vertex && edges.len() < 2 {
                mesh.fill_vertices(&selection.vertices(mesh, kind))?
            } else {
                mesh.fill_edges(&edges)?
            };
            let elements =
                if made.faces.is_empty() { Elements::Edges(made.edges) } else { Elements::Faces(made.faces) };
            Ok(AfterEdit::Select(elements))
        })?;
        Ok(Outcome::silent())
    }
}

impl Action for Bridge {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("bridging", "two loops of edges", |mesh, selection| {
            let (faces, edges) = (selection.faces(mesh, kind), selection.edges(mesh, kind));
            let made = match &faces[..] {
                [] => mesh.bridge_edges(&edges, self)?,
                faces => mesh.bridge_faces(faces, &edges, self)?,
            };
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Connects the selected vertices with edges through the faces between them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ConnectVertices {}

impl Action for ConnectVertices {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.edit_selected_vertices("connecting", "at least two selected vertices", |mesh, vertices| {
            mesh.connect_vertices(vertices).map(drop)
        })?;
        Ok(Outcome::silent())
    }
}

/// Fills the selected loop, which needs an even number of edges, with a grid of quads.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct GridFill {
    /// The number of edges on the first side of the grid: 1 to half of all, minus 1. Default: as square as
    /// possible.
    #[schemars(range(min = 1))]
    pub span: Option<u32>,
    /// Shifts the first corner along the loop by this number of edges.
    pub offset: u32,
}

impl Action for GridFill {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let sides = GridSides { span: self.span.map(|span| span as usize), offset: self.offset as usize };
        let mut count = 0;
        change.edit_selected("filling with a grid", "one loop of edges", |mesh, selection| {
            let made = mesh.grid_fill(&selection.edges(mesh, kind), sides)?;
            count += made.faces.len();
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        Ok(Outcome::counted("made", count, ["face", "faces"]))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;

    use crate::tests::commands::{edited, editing_faces, run, try_run};

    #[test]
    fn a_hole_is_bridged_through_a_cube_with_cuts_and_undone() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "inset", "mode": "individual", "thickness": 0.5 }));
        run(&mut document, json!({ "op": "select_within", "min": [-0.6, -2, -0.6], "max": [0.6, 2, 0.6] }));
        let before = edited(&document).face_count();
        run(&mut document, json!({ "op": "bridge", "cuts": 3, "interpolation": "path" }));
        assert_eq!(edited(&document).face_count(), before - 2 + 16);
        assert!(edited(&document).is_watertight());
        document.undo().expect("one");
        assert_eq!(edited(&document).face_count(), before);
        let refused = try_run(&mut document, json!({ "op": "bridge", "cuts": 2000 })).expect_err("too many");
        assert!(refused.to_string().contains("cuts"), "{refused}");
    }

    #[test]
    fn a_sphere_becomes_quads_and_is_undone() {
        let mut document = editing_faces(primitives::icosphere(1.0, 2));
        let outcome =
            try_run(&mut document, json!({ "op": "voxel_remesh", "voxel_size": 0.25 })).expect("closed");
        let mesh = edited(&document);
        assert!(mesh.is_watertight() && mesh.faces().all(|face| mesh.face_size(face) == 4));
        assert_eq!(outcome.message, format!("made {} faces", mesh.face_count()));
        document.undo().expect("one");
        assert_eq!(edited(&document).face_count(), 320);
        let mut open = editing_faces(primitives::grid(1.0, 1.0, 2, 2));
        let refused = try_run(&mut open, json!({ "op": "voxel_remesh" })).expect_err("open").to_string();
        assert!(refused.contains("hole"), "{refused}");
    }
}
