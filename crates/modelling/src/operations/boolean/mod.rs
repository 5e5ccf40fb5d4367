//! Booleans of volumes: union, difference, intersection.
//!
//! 1. `solid` checks the operands and cuts them into triangles, each a part of a patch: a face, or a triangle of one
//!    that is not flat.
//! 2. A `kernel` computes with the triangles: `manifold`.
//! 3. `outlines` joins its triangles to polygons again, by patch (`coincident`, `surface`, `polygons`).
//! 4. `weave` makes faces of these in the mesh to which all operands were added. A face that is the same polygon as
//!    before stays. The others get the values of the faces that they are parts of (`values`).

mod coincident;
mod kernel;
mod manifold;
mod operation;
mod outlines;
mod polygons;
mod solid;
mod surface;
#[cfg(test)]
mod tests;
mod values;
mod weave;

use trigon_math::DAffine3;

use self::coincident::PatchTriangles;
use self::kernel::{BooleanKernel, KernelFault, PatchedTriangles};
use self::manifold::ManifoldKernel;
use self::operation::OPERATION;
pub use self::operation::{BooleanTool, Combined};
use self::outlines::{PatchPolygon, outlines};
use self::solid::Sources;
pub(super) use self::solid::is_flat;
pub(super) use self::values::SourceFace;
use self::weave::Weave;
pub(super) use self::weave::position_key;
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::modifier::BooleanOperation;
use crate::refusal::Refusal;
use crate::slots::NewElements;

impl EditMesh {
    /// Combines the volume inside this mesh with those inside others. What is left of this mesh may be nothing.
    ///
    /// - The result is closed: at every edge two faces run in opposite directions. Parts that touch in an edge or a
    ///   vertex have each their own.
    /// - Positions are computed in f64 and rounded once. Which parts intersect is decided without rounding.
    /// - A face without cuts stays the same polygon, with its values; a face of this mesh also its id. Parts of a flat
    ///   face are polygons; a face with a hole becomes several. A face that is not flat is cut as the triangles that
    ///   are drawn of it.
    /// - Texture coordinates, colours, normals and other values at new corners are those of the old face there, and
    ///   material and shading are the face's. Parts of edges keep their marks. Where faces of two operands lie on each
    ///   other, the first one's values are used, or either's if no part beside it is the first one's.
    /// - A mesh may cross itself; inside is then what its faces wind around. That takes many times longer.
    /// - Loose edges and vertices of this mesh stay, and those of tools are left out.
    ///
    /// Layers, materials and joints are combined as by [`Self::join_mesh`].
    ///
    /// ```
    /// use trigon_math::{DAffine3, DVec3};
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{BooleanOperation, BooleanTool, EditMesh, Refusal};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// let drill = EditMesh::from_mesh(&primitives::cube(1.0)).0;
    /// let tool = BooleanTool { mesh: &drill, transform: DAffine3::from_translation(DVec3::Y) };
    /// cube.boolean(&[tool], BooleanOperation::Difference)?;
    /// assert!(cube.is_watertight() && (cube.volume() - 7.5).abs() < 1e-6);
    /// # Ok::<(), Refusal>(())
    /// ```
    ///
    /// # Errors
    /// No tool is given; a mesh does not bound a volume; there would be too many elements or vertex groups, or more memory would be
    /// needed than is allowed, both counted before the mesh changes.
    pub fn boolean(
        &mut self,
        tools: &[BooleanTool<'_>],
        operation: BooleanOperation,
    ) -> Result<Combined, Refusal> {
        self.boolean_by(&ManifoldKernel, tools, operation)
    }

    /// The same with a part of this mesh as the tool: some faces, which are removed, with those beside them.
    ///
    /// # Errors
    /// Those of [`Self::boolean`]: the faces, and all others, bound a volume each.
    pub fn boolean_of_faces(
        &mut self,
        faces: &[FaceId],
        operation: BooleanOperation,
    ) -> Result<Combined, Refusal> {
        self.whole(|mesh| {
            let tool = mesh.separate(faces)?;
            mesh.boolean(&[BooleanTool { mesh: &tool, transform: DAffine3::IDENTITY }], operation)
        })
    }

    fn boolean_by(
        &mut self,
        kernel: &impl BooleanKernel,
        tools: &[BooleanTool<'_>],
        operation: BooleanOperation,
    ) -> Result<Combined, Refusal> {
        if tools.is_empty() {
            return Err(Refusal::NothingGiven { operation: OPERATION, needed: "at least one other mesh" });
        }
        self.check_solid()?;
        let tools: Vec<Self> = tools.iter().map(moved).collect::<Result<_, _>>()?;
        let mut sources = Sources::default();
        let mut operands = vec![sources.add(self)];
        operands.extend(tools.iter().map(|tool| sources.add(tool)));
        let mut solid = kernel.combine(&operands, operation).map_err(refused)?;
        PatchTriangles::of(&operands, &sources.patches).prefer_first(&mut solid);
        let given = weave::Given::of(self, &tools);
        let outlines = outlines(&solid, |vertex| given.has(solid.positions[vertex as usize]));
        let outlines = outlines.ok_or_else(|| refused(KernelFault::NotClosed))?;
        self.check_capacity_for(needed(&tools, &solid, &outlines))?;
        self.whole(|mesh| Weave::new(mesh, &tools, &sources, &solid.positions)?.run(&outlines, operation))
    }
}

/// A tool in the space of the other mesh.
fn moved(tool: &BooleanTool<'_>) -> Result<EditMesh, Refusal> {
    tool.mesh.check_solid()?;
    let mut mesh = EditMesh::new();
    mesh.join_mesh(tool.mesh, &tool.transform)?;
    if mesh.vertices().any(|vertex| !mesh.position(vertex).is_finite()) {
        let reason = "the transform of a mesh is not finite, or takes it out of range";
        return Err(Refusal::NotPossible { operation: OPERATION, reason });
    }
    Ok(mesh)
}

/// The most elements that are added: those of tools, and those that outlines may need.
fn needed(tools: &[EditMesh], solid: &PatchedTriangles, outlines: &[PatchPolygon]) -> NewElements {
    let corners: u64 = outlines.iter().map(|outline| outline.vertices.len() as u64).sum();
    let mut all = NewElements {
        vertices: solid.positions.len() as u64,
        edges: corners / 2,
        corners,
        faces: outlines.len() as u64,
    };
    for tool in tools.iter().map(NewElements::of) {
        all.vertices += tool.vertices;
        all.edges += tool.edges;
        all.corners += tool.corners;
        all.faces += tool.faces;
    }
    all
}

fn refused(fault: KernelFault) -> Refusal {
    let reason = match fault {
        KernelFault::NotClosed => "the meshes bound no volume: inspect and repair them first",
        KernelFault::TooLarge => return Refusal::TooMany,
        KernelFault::Failed => "it failed on these meshes: repair them first, or move one of them a little",
    };
    Refusal::NotPossible { operation: OPERATION, reason }
}
