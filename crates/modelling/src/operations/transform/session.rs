//! A movement of vertices from beginning to end: what a modal tool holds while it runs.

use rayon::prelude::*;
use trigon_math::{DVec3, Vec3};

use super::super::delete::require;
use super::clip::Clip;
use super::falloff::{Falloff, Weighted};
use super::given_normals::GivenNormals;
use super::kind::{Prepared, Transform};
use crate::edit_mesh::EditMesh;
use crate::ids::VertexId;
use crate::numbering::is_more_than_one_of;
use crate::refusal::Refusal;
use crate::transaction::Difference;

/// Vertices that move, from where they were at the start.
///
/// Each [`MoveSession::apply`] computes all places anew from the start, [`MoveSession::cancel`]
/// restores the old bytes, and [`MoveSession::confirm`] makes the last transform one step that
/// can be undone. Between these the mesh must not be changed otherwise: its elements stay.
///
/// Normals that were given for corners turn with faces that move wholly by a linear map; at other
/// faces that move they are cleared, and computed ones show. A mirror modifier with clipping holds vertices on its planes, and
/// others on their side.
///
/// ```
/// use trigon_mesh::math::{DVec3, Vec3};
/// use trigon_modelling::{EditMesh, MoveSession, Refusal, Transform, VertexId};
/// use trigon_mesh::primitives;
///
/// let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
/// let vertex = VertexId::new(0);
/// let start = mesh.position(vertex);
/// let mut session = MoveSession::new(&mesh, &[vertex])?;
/// for step in 1..=10 {
///     let offset = DVec3::X * 0.1 * f64::from(step);
///     session.apply(&mut mesh, &Transform::Translate { offset })?;
/// }
/// let mut difference = session.confirm(&mut mesh)?;
/// assert_eq!(mesh.position(vertex), start + Vec3::X);
/// difference.apply(&mut mesh);
/// assert_eq!(mesh.position(vertex), start, "one step to undo");
/// # Ok::<(), Refusal>(())
/// ```
#[derive(Debug, Clone)]
pub struct MoveSession {
    /// In ascending order.
    vertices: Vec<VertexId>,
    starts: Vec<Vec3>,
    weights: Weights,
    /// At the start; empty until they are needed.
    normals: Vec<DVec3>,
    given: GivenNormals,
    clip: Clip,
    /// Where vertices go: kept for its memory.
    positions: Vec<Vec3>,
    last: Option<Transform>,
}

#[derive(Debug, Clone)]
enum Weights {
    All,
    Each(Vec<f64>),
}

impl Weights {
    #[inline]
    fn of(&self, index: usize) -> f64 {
        match self {
            Self::All => 1.0,
            Self::Each(weights) => weights[index],
        }
    }
}

/// Vertices in a piece of work: enough to hide what handing one to a thread costs. A movement of no
/// more than these stays on its thread.
const PIECE: usize = 1 << 15;

impl MoveSession {
    /// Vertices that all move wholly.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn new(mesh: &EditMesh, vertices: &[VertexId]) -> Result<Self, Refusal> {
        Ok(Self::begin(mesh, sorted(mesh, vertices)?, Weights::All))
    }

    /// Vertices that move wholly, and others near them that follow in part.
    ///
    /// # Errors
    /// No vertex is given, one does not exist, or the radius is not above 0 and finite.
    pub fn with_falloff(mesh: &EditMesh, vertices: &[VertexId], falloff: &Falloff) -> Result<Self, Refusal> {
        let Weighted { vertices, weights } = falloff.weigh(mesh, &sorted(mesh, vertices)?)?;
        Ok(Self::begin(mesh, vertices, Weights::Each(weights)))
    }

    fn begin(mesh: &EditMesh, vertices: Vec<VertexId>, weights: Weights) -> Self {
        let starts: Vec<Vec3> = vertices.iter().map(|&vertex| mesh.position(vertex)).collect();
        let given = GivenNormals::at(mesh, &vertices, |index| weights.of(index) == 1.0);
        let (positions, normals, clip) = (starts.clone(), Vec::new(), Clip::of(mesh));
        Self { vertices, starts, weights, normals, given, clip, positions, last: None }
    }

    /// The vertices that move, wholly or in part, in ascending order.
    #[must_use]
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    /// How much of the movement a vertex makes, by its place in [`Self::vertices`]: above 0 to 1.
    ///
    /// # Panics
    /// When there is no such place.
    #[must_use]
    pub fn weight(&self, index: usize) -> f64 {
        self.weights.of(index)
    }

    /// Moves the vertices from the start; what was applied before does not count.
    ///
    /// # Errors
    /// A parameter is not finite, or an axis has no direction. The mesh is as it was.
    ///
    /// # Panics
    /// May panic when the mesh is not the one of the start, or lost elements since.
    pub fn apply(&mut self, mesh: &mut EditMesh, transform: &Transform) -> Result<(), Refusal> {
        let prepared = transform.prepare(|center| self.mean_distance(center))?;
        if matches!(prepared, Prepared::AlongNormals { .. }) && self.normals.is_empty() {
            self.cancel(mesh);
            self.normals = mesh.vertex_normals(&self.vertices);
        }
        self.move_positions(&prepared);
        // A map of the mesh into another space is no movement within it.
        if self.clip.is_needed() && !matches!(transform, Transform::Affine { .. }) {
            self.clip_positions();
        }
        self.last = Some(*transform);
        if self.positions == self.starts {
            self.restore(mesh);
            return Ok(());
        }
        self.write(mesh, &self.positions);
        self.given.apply(mesh, prepared.linear().as_ref());
        Ok(())
    }

    fn write(&self, mesh: &mut EditMesh, moved: &[Vec3]) {
        let moved = self.vertices.iter().zip(moved);
        if is_more_than_one_of(2, self.vertices.len(), mesh.vertex_capacity()) {
            // One copy of the old list takes less time and memory than a note for each.
            let positions = mesh.positions.write_all();
            moved.for_each(|(vertex, &position)| positions[vertex.0 as usize] = position);
        } else {
            moved.for_each(|(vertex, &position)| *mesh.positions.write(vertex.0) = position);
        }
    }

    fn move_positions(&mut self, prepared: &Prepared) {
        let (starts, weights, normals) = (&self.starts, &self.weights, &self.normals);
        let pieces = self.positions.par_chunks_mut(PIECE).enumerate();
        pieces.for_each(|(piece, moved)| {
            for (position, index) in moved.iter_mut().zip(piece * PIECE..) {
                let normal = normals.get(index).copied().unwrap_or(DVec3::ZERO);
                *position = prepared.moved(starts[index].as_dvec3(), weights.of(index), normal).as_vec3();
            }
        });
    }

    fn clip_positions(&mut self) {
        for (position, &start) in self.positions.iter_mut().zip(&self.starts) {
            *position = self.clip.clipped(start, *position);
        }
    }

    /// The mean distance of the vertices from a point at the start, by weight.
    fn mean_distance(&self, center: DVec3) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (index, start) in self.starts.iter().enumerate().filter(|(_, start)| start.is_finite()) {
            sum += start.as_dvec3().distance(center) * self.weights.of(index);
            weights += self.weights.of(index);
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }

    /// Takes the mesh back to the start, to the last byte. The session can go on.
    ///
    /// # Panics
    /// As [`Self::apply`].
    pub fn cancel(&mut self, mesh: &mut EditMesh) {
        self.restore(mesh);
        self.last = None;
    }

    fn restore(&self, mesh: &mut EditMesh) {
        self.write(mesh, &self.starts);
        self.given.restore(mesh);
    }

    /// Ends the movement with the transform that was applied last: goes back to the start, and
    /// applies it in one transaction. What undoes it; an empty difference if nothing was applied.
    ///
    /// # Errors
    /// None that [`Self::apply`] has not had already.
    ///
    /// # Panics
    /// As [`Self::apply`].
    pub fn confirm(mut self, mesh: &mut EditMesh) -> Result<Difference, Refusal> {
        let last = self.last;
        self.restore(mesh);
        let result = mesh.transaction(|mesh| match last {
            Some(transform) => self.apply(mesh, &transform),
            None => Ok(()),
        });
        result.map(|((), difference)| difference)
    }
}

/// The vertices in ascending order, each once.
pub(in crate::operations) fn sorted(
    mesh: &EditMesh,
    vertices: &[VertexId],
) -> Result<Vec<VertexId>, Refusal> {
    require(vertices, "moving vertices", "at least one vertex")?;
    vertices.iter().try_for_each(|&vertex| mesh.check_vertex(vertex))?;
    let mut sorted = vertices.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    Ok(sorted)
}

impl EditMesh {
    /// Moves vertices, and with falloff also others near them in part: a [`MoveSession`] in one
    /// step.
    ///
    /// # Errors
    /// As those of [`MoveSession::with_falloff`] and [`MoveSession::apply`].
    pub fn transform_vertices(
        &mut self,
        vertices: &[VertexId],
        transform: &Transform,
        falloff: Option<&Falloff>,
    ) -> Result<(), Refusal> {
        let mut session = match falloff {
            Some(falloff) => MoveSession::with_falloff(self, vertices, falloff)?,
            None => MoveSession::new(self, vertices)?,
        };
        session.apply(self, transform)
    }
}
