//! Bridging two edge loops with strips of faces, with rings of vertices between them.

mod faces;
mod rings;
mod settings;
#[cfg(test)]
mod tests;

use smallvec::SmallVec;
use trigon_math::{DVec3, area_vector};

use self::rings::BridgeRing;
pub use self::settings::{BridgePath, BridgeProfile, BridgeSettings};
use super::delete::require;
use super::fill::Filled;
use super::outlines::Chain;
use super::parts::fill_strip;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

const BRIDGING: &str = "bridging";

/// What is joined with what.
struct Strip {
    /// Those of both chains.
    vertices: Vec<VertexId>,
    /// For each of them an adjacent corner, whose values new corners take.
    sources: Vec<Option<CornerId>>,
    /// Which of the vertices are joined across, in order: one of the first chain and one of the second. Between each and
    /// the next are faces.
    rungs: Vec<[usize; 2]>,
    is_closed: bool,
    /// Whether faces run back along the first chain.
    is_turned_over: bool,
}

impl Strip {
    /// Each rung and the next one, by index.
    fn pieces(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let count = self.rungs.len();
        (0..if self.is_closed { count } else { count - 1 }).map(move |i| [i, (i + 1) % count])
    }

    /// The outline of a piece without cuts: indices of vertices, along the first chain.
    fn outline(&self, piece: [usize; 2]) -> impl Iterator<Item = usize> + '_ {
        let [[a, b], [c, d]] = piece.map(|rung| self.rungs[rung]);
        [Some(a), (c != a).then_some(c), (d != b).then_some(d), Some(b)].into_iter().flatten()
    }

    fn new_elements(&self, cuts: u32) -> NewElements {
        let (cuts, rungs, pieces) = (u64::from(cuts), self.rungs.len() as u64, self.pieces().count() as u64);
        NewElements {
            vertices: cuts * rungs,
            edges: (cuts + 1) * rungs + cuts * pieces,
            corners: 4 * (cuts + 1) * pieces,
            faces: (cuts + 1) * pieces,
        }
    }
}

/// A vertex of a rung, and the parts of its corners' values.
struct RungPoint {
    vertex: VertexId,
    /// The vertices at both ends of the rung.
    ends: [usize; 2],
    /// Which part of the way it is from the first of them: 0 to 1.
    part: f64,
}

impl EditMesh {
    /// Joins two edge loops, or two open chains, with a strip of faces: quads, and evenly
    /// distributed triangles where the counts differ.
    ///
    /// The order and direction of the edges do not matter. The twist is chosen for the shortest edges across:
    /// the sum of their squared lengths is compared for both directions and every start, at up to 64 evenly
    /// spread positions. New faces are wound like the neighbours of both loops; without neighbours they face
    /// away from the middle of the strip. New faces have the material of the first neighbour, and its values
    /// at the corners there. Faces that fill a loop stay; [`bridge_faces`](Self::bridge_faces) removes them.
    ///
    /// With [`BridgeSettings::cuts`], there are rings of vertices between both loops: on straight lines, or along a
    /// cubic curve from one loop's middle to the other's. Along the curve, rings keep their angle to it, and turn around
    /// it no more than it bends. Values of corners change evenly from one loop to the other.
    ///
    /// # Errors
    /// No edge is given, one does not exist, or they are not two loops or two chains without a common vertex; a parameter
    /// is out of range; there would be too many elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{BridgePath, BridgeSettings, EditMesh, EdgeId};
    ///
    /// let (mut plates, _) = EditMesh::from_mesh(&primitives::grid(1.0, 1.0, 1, 1));
    /// let (other, _) = EditMesh::from_mesh(&primitives::grid(1.0, 1.0, 1, 1));
    /// plates.join_mesh(&other, &trigon_math::DAffine3::from_translation(trigon_math::DVec3::Y))?;
    /// let edges: Vec<EdgeId> = plates.edges().collect();
    /// let settings = BridgeSettings { cuts: 2, ..BridgeSettings::default() };
    /// let made = plates.bridge_edges(&edges, &settings)?;
    /// assert_eq!((made.faces.len(), made.vertices.len()), (12, 8));
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn bridge_edges(&mut self, edges: &[EdgeId], settings: &BridgeSettings) -> Result<Filled, Refusal> {
        settings.check()?;
        require(edges, BRIDGING, "two loops of edges")?;
        let chains = self.chains(edges, BRIDGING)?;
        let refused = |reason| Err(Refusal::NotPossible { operation: BRIDGING, reason });
        let [first, second] = &chains[..] else {
            return refused("exactly two separate loops or chains are needed");
        };
        if first.is_closed != second.is_closed {
            return refused("one is a loop and the other is open: close or open one");
        }
        let mut second = self.aligned(first, second);
        if first.is_closed {
            settings.twist(&mut second.vertices);
        } else {
            settings.check_open()?;
        }
        let strip = self.strip(first, &second);
        self.check_capacity_for(strip.new_elements(settings.cuts))?;
        let rings = self.bridge_rings([first, &second], settings);
        self.whole(|mesh| {
            let mut filled = Filled::default();
            let columns = mesh.add_rungs(&strip, &rings, &mut filled);
            for piece in strip.pieces() {
                mesh.add_pieces(piece.map(|rung| &columns[rung][..]), &strip, &mut filled)?;
            }
            if let Some(&source) = strip.sources.iter().flatten().next() {
                let neighbor = mesh.corner_face(source);
                filled.faces.iter().for_each(|&face| mesh.copy_face(neighbor, face));
            }
            Ok(filled)
        })
    }

    /// The second chain, rotated for the shortest edges across.
    fn aligned(&self, first: &Chain, second: &Chain) -> Chain {
        let from: Vec<DVec3> = first.vertices.iter().map(|&vertex| self.point(vertex)).collect();
        let mut best: Option<(f64, Chain)> = None;
        for is_reversed in [false, true] {
            let mut vertices = second.vertices.clone();
            if is_reversed {
                vertices.reverse();
            }
            let to: Vec<DVec3> = vertices.iter().map(|&vertex| self.point(vertex)).collect();
            let starts = if second.is_closed { to.len() } else { 1 };
            for start in 0..starts {
                let cost = cost_across(&from, &to, start, first.is_closed);
                // A cost of NaN is never better.
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    let mut vertices = vertices.clone();
                    vertices.rotate_left(start);
                    best = Some((cost, Chain { vertices, is_closed: second.is_closed }));
                }
            }
        }
        best.expect("a chain has vertices").1
    }

    fn strip(&self, first: &Chain, second: &Chain) -> Strip {
        let mut sources = self.corners_beside(first);
        sources.append(&mut self.corners_beside(second));
        let vertices = [&first.vertices[..], &second.vertices].concat();
        let counts = [first, second].map(|chain| chain.vertices.len() as u32);
        let mut row: Vec<u32> = (0..counts[0]).collect();
        let mut other: Vec<u32> = (counts[0]..counts[0] + counts[1]).collect();
        let mut rungs = Vec::with_capacity(vertices.len());
        if first.is_closed {
            row.push(0);
            other.push(counts[0]);
        }
        fill_strip(&row, &other, |piece| {
            rungs.push([piece[0], piece[piece.len() - 1]].map(|index| index as usize));
        });
        if !first.is_closed {
            rungs.push([counts[0] - 1, counts[0] + counts[1] - 1].map(|index| index as usize));
        }
        let mut strip = Strip { vertices, sources, rungs, is_closed: first.is_closed, is_turned_over: false };
        strip.is_turned_over = self.is_turned_over(first, second, &strip);
        strip
    }

    /// Whether the strip, which runs along the first chain and back along the second, must be wound
    /// the other way.
    fn is_turned_over(&self, first: &Chain, second: &Chain, strip: &Strip) -> bool {
        let votes = self.winding_votes(first.steps()) - self.winding_votes(second.steps());
        if votes != 0 {
            return votes < 0;
        }
        let count = strip.vertices.len() as f64;
        let middle = strip.vertices.iter().map(|&vertex| self.point(vertex)).sum::<DVec3>() / count;
        let outwards: f64 = strip
            .pieces()
            .map(|piece| {
                let points = || strip.outline(piece).map(|index| self.point(strip.vertices[index]) - middle);
                area_vector(points()).dot(points().sum())
            })
            .sum();
        outwards < 0.0
    }

    /// The vertices of each rung, those of the chains first and last, with new ones between.
    fn add_rungs(&mut self, strip: &Strip, rings: &[BridgeRing], filled: &mut Filled) -> Vec<Vec<RungPoint>> {
        let mut columns = Vec::with_capacity(strip.rungs.len());
        for &ends in &strip.rungs {
            let [a, b] = ends.map(|end| strip.vertices[end]);
            let mut column = vec![RungPoint { vertex: a, ends, part: 0.0 }];
            for ring in rings {
                let position = ring.position([self.point(a), self.point(b)]).as_vec3();
                let vertex = VertexId(self.new_vertex(position));
                let part = ring.part();
                self.blend_vertex(&[(a, 1.0 - part), (b, part)], vertex);
                self.set_first_position(vertex, position);
                filled.vertices.push(vertex);
                column.push(RungPoint { vertex, ends, part });
            }
            column.push(RungPoint { vertex: b, ends, part: 1.0 });
            columns.push(column);
        }
        columns
    }

    /// The faces between two rungs.
    fn add_pieces(
        &mut self,
        [from, to]: [&[RungPoint]; 2],
        strip: &Strip,
        filled: &mut Filled,
    ) -> Result<(), Refusal> {
        for level in 0..from.len() - 1 {
            let mut outline = vec![&from[level]];
            // Rungs may begin or end in the same vertex.
            outline.extend([&to[level], &to[level + 1]].into_iter().filter(|point| {
                point.vertex != from[level].vertex && point.vertex != from[level + 1].vertex
            }));
            outline.push(&from[level + 1]);
            if strip.is_turned_over {
                outline.reverse();
            }
            self.add_piece(&outline, strip, filled)?;
        }
        Ok(())
    }

    fn add_piece(
        &mut self,
        outline: &[&RungPoint],
        strip: &Strip,
        filled: &mut Filled,
    ) -> Result<(), Refusal> {
        let vertices: Vec<VertexId> = outline.iter().map(|point| point.vertex).collect();
        for (i, &vertex) in vertices.iter().enumerate() {
            self.join_new(vertex, vertices[(i + 1) % vertices.len()], &mut filled.edges);
        }
        let face: FaceId = self.add_first_face(&vertices, BRIDGING)?;
        let corners: Vec<CornerId> = self.face_corners(face).collect();
        for (&corner, point) in corners.iter().zip(outline) {
            let weights = [1.0 - point.part, point.part];
            let parts: SmallVec<[(CornerId, f64); 2]> = point
                .ends
                .into_iter()
                .zip(weights)
                .filter(|(_, weight)| *weight > 0.0)
                .filter_map(|(end, weight)| strip.sources[end].map(|source| (source, weight)))
                .collect();
            match parts[..] {
                [] => {}
                // Beside the other chain there are no faces.
                [(source, _)] => self.copy_corner(source, corner),
                _ => self.blend_corner(&parts, corner),
            }
        }
        filled.faces.push(face);
        Ok(())
    }
}

/// The sum of squared lengths across, from evenly spread positions of one row to those of another
/// that begins at `start`.
fn cost_across(from: &[DVec3], to: &[DVec3], start: usize, is_closed: bool) -> f64 {
    /// Comparing this many positions aligns a loop of any length in time proportional to it.
    const MOST: usize = 64;
    let sample_count = from.len().max(to.len()).min(MOST);
    let sample = |count: usize, i: usize| match is_closed {
        true => i * count / sample_count,
        false => i * (count - 1) / (sample_count - 1).max(1),
    };
    let squared = |i: usize| {
        let other = to[(start + sample(to.len(), i)) % to.len()];
        from[sample(from.len(), i)].distance_squared(other)
    };
    (0..sample_count).map(squared).sum()
}
