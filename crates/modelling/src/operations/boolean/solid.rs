//! Meshes as the kernel takes them: closed, in triangles, each a part of a patch.
//!
//! A patch is a face that is flat, or one triangle of a face that is not: what is cut off from a patch lies in one
//! plane, so that it can be joined to polygons again whatever the cuts.

use std::ops::Range;

use trigon_math::{DVec3, DisjointSets, Vec3, area_vector};
use trigon_mesh::{EdgeJoin, Triangulator};

use super::kernel::{PatchTriangle, PatchedTriangles};
use super::operation::OPERATION;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::{Refusal, SolidFault};

/// A face is flat if no vertex is farther from its plane than this many times its largest coordinate: the spacing of
/// `f32` there, twice.
pub(super) const FLATNESS: f64 = 2.5e-7;

/// What a part of an operand's boundary comes from.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    /// Which operand.
    pub(super) operand: usize,
    /// The index of the face among those of the operand's mesh, in the order of ids.
    pub(super) face: usize,
    /// The triangles of the patch in [`Sources::triangles`].
    pub(super) triangles: Range<usize>,
}

/// Where the triangles of all operands come from.
#[derive(Debug, Default)]
pub(super) struct Sources {
    pub(super) patches: Vec<Patch>,
    /// For each triangle the numbers of its corners in its face, from 0.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The faces of each operand.
    pub(super) faces: Vec<Vec<FaceId>>,
}

impl Sources {
    /// Adds an operand, and returns its triangles.
    pub(super) fn add(&mut self, mesh: &EditMesh) -> PatchedTriangles {
        let operand = self.faces.len();
        let faces: Vec<FaceId> = mesh.faces().collect();
        let mut solid = PatchedTriangles::default();
        let mut numbers = vec![u32::MAX; mesh.vertex_capacity()];
        let mut triangulator = Triangulator::default();
        let (mut outline, mut cut) = (Vec::new(), Vec::new());
        for (index, &face) in faces.iter().enumerate() {
            outline.clear();
            outline.extend(mesh.face_vertices(face));
            let positions: Vec<Vec3> = outline.iter().map(|&vertex| mesh.position(vertex)).collect();
            cut.clear();
            triangulator.complete_polygon(&positions, &mut cut);
            let is_flat = is_flat(&positions);
            for (number, &triangle) in cut.iter().enumerate() {
                let here = self.triangles.len();
                if number == 0 || !is_flat {
                    self.patches.push(Patch { operand, face: index, triangles: here..here });
                }
                self.triangles.push(triangle);
                let patch = self.patches.len() - 1;
                self.patches[patch].triangles.end = here + 1;
                let vertices = triangle
                    .map(|corner| number_of(mesh, outline[corner as usize], &mut numbers, &mut solid));
                solid.triangles.push(PatchTriangle { vertices, patch: patch as u32 });
            }
        }
        self.faces.push(faces);
        solid
    }
}

/// The number of a vertex among those of a solid, which gets it if it has it not yet.
fn number_of(mesh: &EditMesh, vertex: VertexId, numbers: &mut [u32], solid: &mut PatchedTriangles) -> u32 {
    let number = &mut numbers[vertex.0 as usize];
    if *number == u32::MAX {
        *number = solid.positions.len() as u32;
        solid.positions.push(mesh.point(vertex));
    }
    *number
}

/// Whether all of a polygon lies in a plane, but for the rounding of its coordinates.
pub(in crate::operations) fn is_flat(positions: &[Vec3]) -> bool {
    let normal = area_vector(positions.iter().map(|position| position.as_dvec3())).normalize_or_zero();
    let (Some(first), true) = (positions.first(), positions.len() > 3) else { return true };
    let first = first.as_dvec3();
    let is_near = |position: &Vec3| {
        let largest = f64::from(position.abs().max_element()).max(first.abs().max_element());
        (position.as_dvec3() - first).dot(normal).abs() <= FLATNESS * largest
    };
    normal != DVec3::ZERO && positions.iter().all(is_near)
}

impl EditMesh {
    /// Whether the faces bound a volume, as booleans need it: at every edge as many faces run in one direction as in
    /// the other, and faces look outwards, but those of cavities. Faces may cross each other.
    ///
    /// # Errors
    /// They do not; the first fault.
    pub fn check_solid(&self) -> Result<(), Refusal> {
        if self.face_count() == 0 {
            return Err(Refusal::NothingGiven { operation: OPERATION, needed: "meshes with faces" });
        }
        if let Some(vertex) = self.vertices().find(|&vertex| !self.position(vertex).is_finite()) {
            return Err(Refusal::Overflow(vertex));
        }
        self.edges().try_for_each(|edge| self.check_sides(edge, OPERATION))?;
        match self.face_of_a_shell_that_looks_inwards() {
            Some(face) => {
                let vertex = self.corner_vertex(self.face_corners(face).next().expect("a face has corners"));
                let (fault, position) = (SolidFault::InsideOut(face), self.point(vertex));
                Err(Refusal::NotSolid { operation: OPERATION, fault, position })
            }
            None => Ok(()),
        }
    }

    /// Refuses an edge at which not as many faces run in one direction as in the other.
    pub(in crate::operations) fn check_sides(
        &self,
        edge: EdgeId,
        operation: &'static str,
    ) -> Result<(), Refusal> {
        let [a, b] = self.edge_vertices(edge);
        let fault = match self.edge_join(edge) {
            EdgeJoin::Loose | EdgeJoin::Closed => return Ok(()),
            EdgeJoin::Open => SolidFault::Open(edge),
            EdgeJoin::Turned => SolidFault::Turned(edge),
            EdgeJoin::NonManifold => {
                let forwards =
                    self.edge_corners(edge).filter(|&corner| self.corner_vertex(corner) == a).count();
                let all = self.edge_corners(edge).count();
                match all {
                    all if all == 2 * forwards => return Ok(()),
                    all if all % 2 == 1 => SolidFault::Open(edge),
                    _ => SolidFault::Turned(edge),
                }
            }
        };
        let position = (self.point(a) + self.point(b)) / 2.0;
        Err(Refusal::NotSolid { operation, fault, position })
    }

    /// A face of a shell (faces connected by vertices) that encloses a negative volume and is not within the box of
    /// one with a positive volume, whose cavity it could bound.
    fn face_of_a_shell_that_looks_inwards(&self) -> Option<FaceId> {
        let shells = self.shells();
        let outer: Vec<&Shell> = shells.iter().filter(|shell| shell.volume > 0.0).collect();
        let is_within = |inner: &Shell| {
            outer.iter().any(|shell| shell.min.cmple(inner.min).all() && shell.max.cmpge(inner.max).all())
        };
        shells.iter().find(|shell| shell.volume < 0.0 && !is_within(shell)).map(|shell| shell.face)
    }

    fn shells(&self) -> Vec<Shell> {
        let mut sets = DisjointSets::new(self.vertex_capacity());
        for edge in self.edges() {
            let [a, b] = self.edge_vertices(edge);
            sets.join(a.0, b.0);
        }
        let mut numbers = vec![usize::MAX; self.vertex_capacity()];
        let mut shells: Vec<Shell> = Vec::new();
        for face in self.faces() {
            let mut vertices = self.face_vertices(face).map(|vertex| (vertex, self.point(vertex)));
            let (Some((vertex, first)), Some((_, mut last))) = (vertices.next(), vertices.next()) else {
                continue;
            };
            let number = &mut numbers[sets.root(vertex.0) as usize];
            if *number == usize::MAX {
                *number = shells.len();
                shells.push(Shell { face, origin: first, volume: 0.0, min: first, max: first });
            }
            let shell = &mut shells[*number];
            shell.include([first, last]);
            for (_, position) in vertices {
                shell.include([position, position]);
                let [a, b, c] = [first, last, position].map(|position| position - shell.origin);
                shell.volume += a.dot(b.cross(c)) / 6.0;
                last = position;
            }
        }
        shells
    }
}

/// Faces that are connected.
struct Shell {
    /// One of them.
    face: FaceId,
    origin: DVec3,
    volume: f64,
    min: DVec3,
    max: DVec3,
}

impl Shell {
    fn include(&mut self, positions: [DVec3; 2]) {
        for position in positions {
            self.min = self.min.min(position);
            self.max = self.max.max(position);
        }
    }
}
