//! Tubes around chains of edges.

#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_math::{DVec2, DVec3, Vec2, elementary, unit_or_zero};

use super::delete::require;
use super::outlines::Chain;
use super::sweep_frame::SweepFrame;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// Makes tubes around chains of selected edges.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TubeSettings {
    /// The distance of the tube's edges from the chain, in metres.
    #[schemars(range(min = 0.0))]
    pub radius: f64,
    /// The number of sides around.
    #[schemars(range(min = 3, max = 1000))]
    pub sides: u32,
    /// Whether open ends are closed by faces.
    pub caps: bool,
    /// Whether the edges go that no face has.
    pub replace: bool,
}

impl Default for TubeSettings {
    /// Ten centimetres thick, with eight sides, closed, in place of the edges.
    fn default() -> Self {
        Self { radius: 0.05, sides: 8, caps: true, replace: true }
    }
}

const OPERATION: &str = "making a tube";

/// More sides than that are a mistake.
const MOST_SIDES: u32 = 1000;

/// At a sharp bend, a ring is at most this many times longer than it is wide.
const LONGEST: f64 = 4.0;

impl TubeSettings {
    fn check(&self) -> Result<(), Refusal> {
        if !(self.radius > 0.0 && self.radius.is_finite()) {
            let parameter = "the radius of a tube";
            return Err(Refusal::OutOfRange { parameter, value: self.radius, range: "above 0" });
        }
        if !(3..=MOST_SIDES).contains(&self.sides) {
            let (parameter, value) = ("the number of sides", f64::from(self.sides));
            return Err(Refusal::OutOfRange { parameter, value, range: "3 to 1000" });
        }
        Ok(())
    }
}

impl EditMesh {
    /// Makes a tube around each chain of edges: a closed solid around an open chain, if it has caps, and a ring around a
    /// loop.
    ///
    /// Each part along an edge is a prism over a regular polygon, whose corners have the radius as their distance from the
    /// edge. Prisms meet in the plane that halves the angle between them; at very sharp bends they get thinner. The
    /// polygon turns around the chain no more than its bends need, and what is left to close a loop is spread along it.
    /// Texture coordinates run from 0 to 1 around the tube and along it, and caps fill the image; the first set is added
    /// if there is none. The material is that of a face at the chain, if there is one.
    ///
    /// # Errors
    /// No edge is given, or one does not exist; more than two meet in a vertex; all vertices of a chain are in the same
    /// position, or one is not finite; a parameter is out of range; there would be too many elements.
    ///
    /// ```
    /// use trigon_mesh::math::Vec3;
    /// use trigon_modelling::{EditMesh, TubeSettings};
    ///
    /// let mut mesh = EditMesh::new();
    /// let ends = [mesh.add_vertex(Vec3::ZERO)?, mesh.add_vertex(Vec3::Y * 2.0)?];
    /// let edge = mesh.add_edge(ends[0], ends[1])?;
    /// let made = mesh.tube_edges(&[edge], &TubeSettings { radius: 0.5, sides: 4, ..TubeSettings::default() })?;
    /// assert_eq!(made.len(), 6, "four sides and two caps");
    /// assert!((mesh.volume() - 1.0).abs() < 1e-6, "a square with a diagonal of 1");
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn tube_edges(&mut self, edges: &[EdgeId], settings: &TubeSettings) -> Result<Vec<FaceId>, Refusal> {
        require(edges, OPERATION, "at least one edge")?;
        settings.check()?;
        let chains = self.chains(edges, OPERATION)?;
        let sides = u64::from(settings.sides);
        let count = |of: fn(&Chain) -> usize| chains.iter().map(|chain| of(chain) as u64).sum::<u64>();
        let (rings, steps) = (count(|chain| chain.vertices.len()), count(|chain| chain.steps().count()));
        let caps = if settings.caps { 2 * (rings - steps) } else { 0 };
        self.check_capacity_for(NewElements {
            vertices: rings * sides,
            edges: (rings + steps) * sides,
            corners: (4 * steps + caps) * sides,
            faces: steps * sides + caps,
        })?;
        let paths: Vec<TubePath> =
            chains.iter().map(|chain| TubePath::new(self, chain)).collect::<Result<_, _>>()?;
        self.whole(|mesh| {
            if mesh.uv_set_count() == 0 {
                mesh.add_uv_set(0)?;
            }
            let mut made = Vec::new();
            for (chain, path) in chains.iter().zip(&paths) {
                mesh.add_tube(chain, path, settings, &mut made);
            }
            if settings.replace {
                mesh.remove_loose(edges);
            }
            Ok(made)
        })
    }

    fn add_tube(&mut self, chain: &Chain, path: &TubePath, settings: &TubeSettings, made: &mut Vec<FaceId>) {
        let beside = self.corners_beside(chain).into_iter().flatten().next();
        let like = beside.map(|corner| self.corner_face(corner));
        let rings: Vec<Vec<VertexId>> =
            (0..chain.vertices.len()).map(|ring| self.add_ring(chain, path, settings, ring)).collect();
        let first = made.len();
        for step in 0..chain.steps().count() {
            let [from, to] = [step, step + 1].map(|ring| &rings[ring % rings.len()]);
            let along = [step, step + 1].map(|ring| path.distances[ring] / path.length());
            self.add_sides([from, to], along, made);
        }
        if let ([start, .., end], false, true) = (&rings[..], chain.is_closed, settings.caps) {
            let backwards: Vec<VertexId> = start.iter().rev().copied().collect();
            made.extend([self.add_cap(&backwards), self.add_cap(end)]);
        }
        if let Some(like) = like {
            for &face in &made[first..] {
                self.copy_face(like, face);
                self.set_face_hidden(face, false);
            }
        }
    }

    fn add_ring(
        &mut self,
        chain: &Chain,
        path: &TubePath,
        settings: &TubeSettings,
        ring: usize,
    ) -> Vec<VertexId> {
        let corner = |side: u32| {
            let vertex = self.twin_vertex(chain.vertices[ring]);
            let angle = TAU * f64::from(side) / f64::from(settings.sides);
            let position = path.position(ring, angle, settings.radius).as_vec3();
            self.set_position(vertex, position);
            self.set_first_position(vertex, position);
            self.set_vertex_hidden(vertex, false);
            vertex
        };
        (0..settings.sides).map(corner).collect()
    }

    /// The quads between two rings, which are at two parts of the length.
    fn add_sides(&mut self, [from, to]: [&[VertexId]; 2], along: [f64; 2], made: &mut Vec<FaceId>) {
        let sides = from.len();
        for side in 0..sides {
            let next = (side + 1) % sides;
            let face = self.face_of(&[from[side], from[next], to[next], to[side]]);
            let [left, right] = [side, side + 1].map(|corner| corner as f64 / sides as f64);
            let uvs = [[left, along[0]], [right, along[0]], [right, along[1]], [left, along[1]]];
            self.set_tube_uvs(face, uvs.into_iter().map(DVec2::from));
            made.push(face);
        }
    }

    fn add_cap(&mut self, ring: &[VertexId]) -> FaceId {
        let face = self.face_of(ring);
        let uvs = (0..ring.len()).map(|i| {
            let (sin, cos) = elementary::sin_cos(TAU * i as f64 / ring.len() as f64);
            DVec2::new(0.5 + 0.5 * cos, 0.5 - 0.5 * sin)
        });
        self.set_tube_uvs(face, uvs);
        face
    }

    fn set_tube_uvs(&mut self, face: FaceId, uvs: impl Iterator<Item = DVec2>) {
        let corners: Vec<CornerId> = self.face_corners(face).collect();
        for (corner, uv) in corners.into_iter().zip(uvs) {
            let uv: Vec2 = uv.as_vec2();
            self.set_uv(0, corner, uv);
        }
    }
}

/// The middle line of a tube.
struct TubePath {
    points: Vec<DVec3>,
    /// Of each edge: its direction, and the directions of the polygon around it.
    frames: Vec<SweepFrame>,
    is_closed: bool,
    /// From the first point to each point along the chain; to the first one again at the end of a loop.
    distances: Vec<f64>,
    /// By what angle the last frame of a loop is turned against the first one.
    twist: f64,
}

impl TubePath {
    fn new(mesh: &EditMesh, chain: &Chain) -> Result<Self, Refusal> {
        let refused = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        let points: Vec<DVec3> = chain.vertices.iter().map(|&vertex| mesh.point(vertex)).collect();
        if points.iter().any(|point| !point.is_finite()) {
            return refused("the position of a vertex is not finite: repair the mesh first");
        }
        let ways: Vec<DVec3> = chain.steps().map(|(from, to)| mesh.point(to) - mesh.point(from)).collect();
        let Some(mut direction) =
            ways.iter().map(|&way| unit_or_zero(way)).find(|&direction| direction != DVec3::ZERO)
        else {
            return refused("all vertices of a chain are in the same position: move them apart");
        };
        let mut frames: Vec<SweepFrame> = Vec::with_capacity(ways.len());
        let mut distances = vec![0.0];
        for &way in &ways {
            // An edge without length goes on as the one before it.
            direction = if unit_or_zero(way) == DVec3::ZERO { direction } else { unit_or_zero(way) };
            frames.push(match frames.last() {
                Some(frame) => frame.after(DVec3::ZERO, direction),
                None => SweepFrame::new(direction, DVec3::ZERO),
            });
            distances.push(distances[distances.len() - 1] + way.length());
        }
        let mut path = Self { points, frames, is_closed: chain.is_closed, distances, twist: 0.0 };
        if let (true, [first, .., last]) = (path.is_closed, &path.frames[..]) {
            let back = last.after(DVec3::ZERO, first.tangent).right;
            path.twist = elementary::atan2(back.dot(first.up()), back.dot(first.right));
        }
        Ok(path)
    }

    fn length(&self) -> f64 {
        self.distances[self.distances.len() - 1]
    }

    /// A corner of the polygon around a point: in the plane that halves the angle between both edges there.
    fn position(&self, point: usize, angle: f64, radius: f64) -> DVec3 {
        let frame = self.frames[point.min(self.frames.len() - 1)];
        let turned = angle - self.twist * self.distances[point] / self.length();
        let (sin, cos) = elementary::sin_cos(turned);
        let arm = (frame.right * cos + frame.up() * sin) * radius;
        let before = match point {
            0 if self.is_closed => self.frames[self.frames.len() - 1],
            0 => frame,
            _ => self.frames[point - 1],
        };
        let normal = unit_or_zero(before.tangent + frame.tangent);
        let cosine = normal.dot(frame.tangent);
        let along = if cosine > 1.0 / LONGEST { cosine } else { 1.0 / LONGEST };
        self.points[point] + arm - frame.tangent * (arm.dot(normal) / along)
    }
}
