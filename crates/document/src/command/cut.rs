//! Cutting: subdivide, loop cut, slide, and faces along a path.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3, Vec3};
use trigon_modelling::{EdgeId, FaceId, KnifePoint, LoopCutSettings, VertexId};

use super::space::TransformSpace;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

const CUTTING: &str = "cutting a loop";
const EDGES: &str = "at least one selected edge";

/// Cuts the selected edges into equal pieces, and the faces at them into a grid. No vertex moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Subdivide {
    /// The number of cuts per edge.
    #[schemars(range(min = 1, max = 1000))]
    pub cuts: u32,
}

impl Default for Subdivide {
    fn default() -> Self {
        Self { cuts: 1 }
    }
}

impl Action for Subdivide {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut faces = 0;
        change.edit_selected("subdividing", EDGES, |mesh, selection| {
            let made = mesh.subdivide(&selection.edges(mesh, kind), self.cuts)?;
            faces += made.faces.len();
            Ok(AfterEdit::Select(Elements::Edges(made.edges)))
        })?;
        Ok(Outcome::counted("cut into", faces, ["face", "faces"]))
    }
}

/// Cuts new loops across the ring of quads that an edge belongs to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LoopCut {
    /// The number of loops, side by side.
    #[schemars(range(min = 1, max = 1000))]
    pub cuts: u32,
    /// Moves all loops together: −1 to 1 from side to side, 0 in the middle.
    #[schemars(range(min = -1.0, max = 1.0))]
    pub position: f64,
    /// Whether the loops keep the same distances on all edges of the ring as on the given one, instead of the
    /// same fraction of each.
    pub even: bool,
    /// Whether even distances are measured from the other side.
    pub flipped: bool,
    /// The number of the edge. Default: the last selected one of each mesh.
    pub edge: Option<u32>,
    /// The object with the edge, if several are edited.
    pub object: Option<ObjectName>,
}

impl Default for LoopCut {
    fn default() -> Self {
        Self { cuts: 1, position: 0.0, even: false, flipped: false, edge: None, object: None }
    }
}

impl LoopCut {
    /// Across a given edge: nothing needs to be selected.
    fn cut_given(
        &self,
        change: &mut Change<'_>,
        edge: u32,
        settings: &LoopCutSettings,
    ) -> Result<usize, EditError> {
        let object = self.object.as_ref().map(|object| object.find(change.scene())).transpose()?;
        let id = change.only_edited_mesh(object, CUTTING)?;
        let kind = change.selection().kind();
        let cut = change.edit(id, |mesh| Ok(mesh.loop_cut(EdgeId::new(edge), settings)?))?;
        let count = cut.edges.len();
        let (selections, meshes) = change.selection_and_meshes();
        if let (Some(selection), Some(mesh)) = (selections.of_mut(id), meshes.get(&id)) {
            selection.select(mesh, kind, &Elements::Edges(cut.edges));
        }
        Ok(count)
    }
}

impl Action for LoopCut {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let settings = LoopCutSettings {
            cuts: self.cuts as usize,
            position: self.position,
            even: self.even,
            flipped: self.flipped,
        };
        if let Some(edge) = self.edge {
            let edges = self.cut_given(change, edge, &settings)?;
            return Ok(Outcome::counted("cut", edges, ["edge", "edges"]));
        }
        let mut edges = 0;
        change.edit_selected(CUTTING, EDGES, |mesh, selection| {
            let selected = selection.edges(mesh, kind);
            let last = selection.order().last().copied();
            let of_last = selected.iter().copied().find(|edge| last == Some(edge.index()));
            let Some(edge) = of_last.or(selected.first().copied()) else {
                return Ok(AfterEdit::Keep);
            };
            let cut = mesh.loop_cut(edge, &settings)?;
            edges += cut.edges.len();
            Ok(AfterEdit::Select(Elements::Edges(cut.edges)))
        })?;
        Ok(Outcome::counted("cut", edges, ["edge", "edges"]))
    }
}

/// Slides the selected edge loops along the adjacent edges.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SlideEdges {
    /// How far: −1 (all the way to one side) to 1 (to the other).
    #[schemars(range(min = -1.0, max = 1.0))]
    pub factor: f64,
}

impl Action for SlideEdges {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.edit_selected_edges("sliding edges", EDGES, |mesh, edges| {
            mesh.slide_edges(edges, self.factor).map(drop)
        })?;
        Ok(Outcome::silent())
    }
}

/// Slides each selected vertex along the one of its edges that is closest to a direction.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SlideVertices {
    /// The distance as a fraction of the edge's length; negative values move backwards.
    #[schemars(range(min = -1.0, max = 1.0))]
    pub factor: f64,
    /// The direction; its length does not matter.
    pub direction: [f64; 3],
    /// The space of the direction.
    pub space: TransformSpace,
}

impl Action for SlideVertices {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (command, kind) = ("sliding vertices", change.selection().kind());
        let into_meshes = self.space.into_meshes(command, change)?;
        change.edit_selected_meshes(command, "at least one selected vertex", |id, mesh, selection| {
            let into_mesh = into_meshes.get(&id).copied().unwrap_or(DAffine3::IDENTITY);
            let direction = into_mesh.matrix3 * DVec3::from(self.direction);
            let slides: Vec<_> = selection
                .vertices(mesh, kind)
                .into_iter()
                .filter_map(|vertex| Some((vertex, mesh.edge_towards(vertex, direction)?)))
                .collect();
            mesh.slide_vertices(&slides, self.factor)?;
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::silent())
    }
}

/// Cuts faces along strokes, and selects the edges of the cut. Consecutive points of a stroke belong to the same face.
/// A stroke that ends in its first point is closed. Where strokes cross, they get a vertex. Pieces that end within a face
/// cut nothing; a warning counts them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Knife {
    /// The object whose mesh is cut. Default: the only edited one.
    pub object: Option<ObjectName>,
    /// Paths of at least two points each.
    pub strokes: Vec<Vec<PathPoint>>,
}

/// A point of a knife's stroke.
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
        let points = |stroke: &Vec<PathPoint>| stroke.iter().map(|&point| point.into()).collect();
        let strokes: Vec<Vec<KnifePoint>> = self.strokes.iter().map(points).collect();
        let cut = change.edit(id, |mesh| Ok(mesh.knife(&strokes)?))?;
        let kind = change.selection().kind();
        let (selections, meshes) = change.selection_and_meshes();
        if let (Some(selection), Some(mesh)) = (selections.of_mut(id), meshes.get(&id)) {
            selection.select(mesh, kind, &Elements::Edges(cut.edges));
        }
        Ok(cut_outcome(cut.faces.len(), cut.uncut))
    }

    fn bytes(&self) -> usize {
        self.strokes.iter().map(|stroke| size_of::<PathPoint>() * stroke.len()).sum()
    }
}

/// How many faces a cut made, with a warning if some of it cut nothing.
pub(super) fn cut_outcome(faces: usize, uncut: usize) -> Outcome {
    let mut outcome = Outcome::counted("made", faces, ["face", "faces"]);
    if uncut > 0 {
        let pieces = if uncut == 1 {
            "1 piece of the cut was".into()
        } else {
            format!("{uncut} pieces of the cut were")
        };
        outcome.warnings.push(format!("{pieces} left out: a cut goes from edge to edge, or closes"));
    }
    outcome
}
