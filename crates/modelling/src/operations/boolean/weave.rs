//! Makes the faces of a boolean's result in the mesh to which all operands were added.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;

use smallvec::SmallVec;
use trigon_math::{DAffine3, DVec3, Vec3};

use super::operation::Combined;
use super::outlines::PatchPolygon;
use super::solid::Sources;
use super::values::SourceFace;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, NONE, VertexId};
use crate::modifier::BooleanOperation;
use crate::operations::copy::CopiedElements;
use crate::refusal::Refusal;

/// The bits of a position, the same for both zeros.
pub(in crate::operations) fn position_key(position: Vec3) -> [u32; 3] {
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// The positions of all operands' vertices.
pub(super) struct Given(HashSet<[u32; 3]>);

impl Given {
    pub(super) fn of(mesh: &EditMesh, tools: &[EditMesh]) -> Self {
        let all = std::iter::once(mesh).chain(tools);
        Self(all.flat_map(|mesh| mesh.vertices().map(|vertex| position_key(mesh.position(vertex)))).collect())
    }

    /// Whether a position rounds to one of them.
    pub(super) fn has(&self, position: DVec3) -> bool {
        self.0.contains(&position_key(position.as_vec3()))
    }
}

/// The mesh with all operands, while it becomes the result.
pub(super) struct Weave<'m> {
    mesh: &'m mut EditMesh,
    sources: &'m Sources,
    /// Of the outlines' vertices.
    positions: &'m [DVec3],
    /// The faces of each operand, in this mesh.
    faces: Vec<Vec<FaceId>>,
    tools: Vec<CopiedElements>,
    /// For each vertex of outlines the one in the mesh; `NONE` while there is none.
    vertices: Vec<u32>,
}

impl<'m> Weave<'m> {
    /// Adds all operands to the mesh; refused if there would be too many vertex groups.
    pub(super) fn new(
        mesh: &'m mut EditMesh,
        tools: &[EditMesh],
        sources: &'m Sources,
        positions: &'m [DVec3],
    ) -> Result<Self, Refusal> {
        let add = |tool: &EditMesh| mesh.join_mesh(tool, &DAffine3::IDENTITY);
        let tools: Vec<CopiedElements> = tools.iter().map(add).collect::<Result<_, _>>()?;
        let own = sources.faces.first().cloned().into_iter();
        let faces = own.chain(tools.iter().map(|tool| tool.faces.clone())).collect();
        let vertices = vec![NONE; positions.len()];
        Ok(Self { mesh, sources, positions, faces, tools, vertices })
    }

    pub(super) fn run(
        mut self,
        outlines: &[PatchPolygon],
        operation: BooleanOperation,
    ) -> Result<Combined, Refusal> {
        self.find_vertices(outlines);
        let mut combined = Combined::default();
        let mut is_retained = vec![false; self.mesh.face_capacity()];
        let mut pieces = Vec::new();
        for group in self.by_face(outlines) {
            let outlines = &outlines[group];
            let patch = &self.sources.patches[outlines[0].patch as usize];
            let face = self.faces[patch.operand][patch.face];
            let is_turned = patch.operand > 0 && operation == BooleanOperation::Difference;
            if self.is_unchanged(face, outlines, is_turned) {
                is_retained[face.0 as usize] = true;
                if is_turned {
                    self.mesh.flip_face(face)?;
                }
                if patch.operand > 0 {
                    combined.faces.push(face);
                }
            } else {
                pieces.extend(self.lay_pieces(face, outlines, is_turned)?);
            }
        }
        self.remove_others(&is_retained)?;
        for &face in &pieces {
            self.mesh.reveal_outline(face);
        }
        combined.faces.extend(pieces);
        combined.edges = self.seams(outlines);
        Ok(combined)
    }

    /// The outlines of each face that has any: they follow each other.
    fn by_face(&self, outlines: &[PatchPolygon]) -> Vec<Range<usize>> {
        let face = |outline: &PatchPolygon| {
            let patch = &self.sources.patches[outline.patch as usize];
            (patch.operand, patch.face)
        };
        let mut groups: Vec<Range<usize>> = Vec::new();
        for (index, outline) in outlines.iter().enumerate() {
            match groups.last_mut() {
                Some(group) if face(&outlines[group.start]) == face(outline) => group.end = index + 1,
                _ => groups.push(index..index + 1),
            }
        }
        groups
    }

    /// Finds the vertex of the mesh for each vertex of outlines: one of the faces that they are parts of, in the same
    /// position, or a new one.
    fn find_vertices(&mut self, outlines: &[PatchPolygon]) {
        let mut known: BTreeMap<u32, SmallVec<[VertexId; 2]>> = BTreeMap::new();
        for outline in outlines {
            let face = self.source(outline.patch);
            for &vertex in &outline.vertices {
                let position = self.positions[vertex as usize].as_vec3();
                let here = known.entry(vertex).or_default();
                let own = face.corner_at(self.mesh, position).map(|corner| self.mesh.corner_vertex(corner));
                here.extend(own.filter(|own| !here.contains(own)));
            }
        }
        let mut is_taken = vec![false; self.mesh.vertex_capacity()];
        for (&vertex, own) in &mut known {
            own.sort_unstable();
            let free = own.iter().find(|own| !is_taken[own.0 as usize]);
            if let Some(&free) = free {
                is_taken[free.0 as usize] = true;
                self.vertices[vertex as usize] = free.0;
            }
        }
        for outline in outlines {
            for &vertex in &outline.vertices {
                if self.vertices[vertex as usize] == NONE {
                    let first = known.get(&vertex).and_then(|own| own.first().copied());
                    self.vertices[vertex as usize] = self.new_vertex(vertex, outline.patch, first).0;
                }
            }
        }
    }

    /// A new vertex with the values of another one, or of a patch there.
    fn new_vertex(&mut self, vertex: u32, patch: u32, like: Option<VertexId>) -> VertexId {
        let position = self.positions[vertex as usize];
        let new = VertexId(self.mesh.new_vertex(position.as_vec3()));
        match like {
            Some(like) => {
                self.mesh.copy_vertex(like, new);
                self.mesh.set_first_position(new, self.mesh.first_position(like));
            }
            None => {
                let parts = self.source(patch).parts_at(self.mesh, position);
                let parts: SmallVec<[(VertexId, f64); 3]> =
                    parts.iter().map(|&(corner, weight)| (self.mesh.corner_vertex(corner), weight)).collect();
                self.mesh.blend_vertex(&parts, new);
            }
        }
        new
    }

    fn source(&self, patch: u32) -> SourceFace<'m> {
        let patch = &self.sources.patches[patch as usize];
        let face = self.faces[patch.operand][patch.face];
        SourceFace::new(self.mesh, face, &self.sources.triangles[patch.triangles.clone()])
    }

    /// An outline's vertices in the mesh, as the face runs that it is a part of.
    fn ring(&self, outline: &PatchPolygon, is_turned: bool) -> Vec<VertexId> {
        let mut ring: Vec<VertexId> =
            outline.vertices.iter().map(|&vertex| VertexId(self.vertices[vertex as usize])).collect();
        if is_turned {
            ring.reverse();
        }
        ring
    }

    /// Whether a face is left as it is: its outlines are all of its patches, as a whole.
    fn is_unchanged(&self, face: FaceId, outlines: &[PatchPolygon], is_turned: bool) -> bool {
        let corners: Vec<VertexId> = self.mesh.face_vertices(face).collect();
        let is_whole = |outline: &PatchPolygon| {
            let patch = &self.sources.patches[outline.patch as usize];
            let is_face = self.sources.triangles[patch.triangles.clone()].len() + 2 == corners.len();
            let ring = self.ring(outline, is_turned);
            if is_face {
                return is_same_ring(&ring, &corners);
            }
            let triangle =
                self.sources.triangles[patch.triangles.start].map(|corner| corners[corner as usize]);
            is_same_ring(&ring, &triangle)
        };
        let triangles: usize =
            outlines.iter().map(|outline| self.sources.patches[outline.patch as usize].triangles.len()).sum();
        triangles + 2 == corners.len() && outlines.iter().all(is_whole)
    }

    /// Makes faces of parts of a face.
    fn lay_pieces(
        &mut self,
        face: FaceId,
        outlines: &[PatchPolygon],
        is_turned: bool,
    ) -> Result<Vec<FaceId>, Refusal> {
        let mut pieces = Vec::with_capacity(outlines.len());
        for outline in outlines {
            let source = self.source(outline.patch);
            let ring = self.ring(outline, is_turned);
            let piece = self.mesh.add_face(&ring)?;
            let record = self.mesh.faces[face.0];
            let own = self.mesh.faces.write(piece.0);
            (own.material, own.flags) = (record.material, record.flags);
            source.give_values(self.mesh, piece);
            if is_turned {
                self.mesh.flip_face(piece)?;
            }
            pieces.push(piece);
        }
        Ok(pieces)
    }

    /// Removes the faces of all operands that were not retained, and what belongs to nothing then.
    fn remove_others(&mut self, is_retained: &[bool]) -> Result<(), Refusal> {
        let mut edges = Vec::new();
        for &face in self.faces.iter().flatten().filter(|face| !is_retained[face.0 as usize]) {
            edges.extend(self.mesh.face_edges(face));
            self.mesh.remove_face(face)?;
        }
        self.mesh.remove_loose(&edges);
        for tool in &self.tools {
            self.mesh.remove_loose(&tool.edges);
            for &vertex in &tool.vertices {
                self.mesh.remove_loose_vertex(vertex);
            }
        }
        Ok(())
    }

    /// The edges at which outlines of different operands meet.
    fn seams(&self, outlines: &[PatchPolygon]) -> Vec<EdgeId> {
        let mut operands: HashMap<[u32; 2], usize> = HashMap::new();
        let mut edges = Vec::new();
        for outline in outlines {
            let operand = self.sources.patches[outline.patch as usize].operand;
            for [from, to] in outline.sides() {
                if operands.get(&[to, from]).is_some_and(|&other| other != operand) {
                    let [from, to] = [from, to].map(|vertex| VertexId(self.vertices[vertex as usize]));
                    edges.extend(self.mesh.find_edge(from, to));
                }
                operands.insert([from, to], operand);
            }
        }
        edges.sort_unstable();
        edges
    }
}

/// Whether two outlines have the same vertices in the same order, whichever is the first.
fn is_same_ring(one: &[VertexId], other: &[VertexId]) -> bool {
    let Some(start) = one.first().and_then(|first| other.iter().position(|vertex| vertex == first)) else {
        return false;
    };
    one.len() == other.len() && one.iter().eq(other[start..].iter().chain(&other[..start]))
}
