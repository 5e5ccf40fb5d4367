//! Insetting a region as a whole, or the faces around it.

use std::collections::BTreeMap;

use smallvec::SmallVec;
use trigon_math::{DVec3, unit_or_zero};

use super::super::frame::FaceFrame;
use super::super::region::{BorderEdge, Region};
use super::super::tables::{IndexSet, IndexTable};
use super::{Inset, InsetFaces, Sides};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::layers::Blends;
use crate::refusal::Refusal;

/// Which side of a border shrinks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shrinks {
    Region,
    Outside,
}

/// A vertex that moves, and the edges that it has to keep away from.
struct Slide {
    vertex: VertexId,
    sides: Sides,
}

/// The vertices that move, each once.
struct Slides {
    list: Vec<Slide>,
    table: IndexTable,
}

impl EditMesh {
    /// Insets faces as regions: a region shrinks where it ends, and faces inside stay joined.
    ///
    /// Each edge where the region ends moves inwards by the thickness, in the plane of its face; a
    /// vertex between two such edges goes to where both are right. The region keeps its ids, and what
    /// is outside gets new vertices along the border; parts that touch in one vertex get one each.
    /// Values of the faces that shrink are interpolated in each of them. With a depth, all vertices of
    /// the region move along the mean of its normals there, so far that the faces move by the depth: exactly
    /// where the normals at a vertex are all at the same angle to their mean, as at the corner of a cube.
    ///
    /// # Errors
    /// No face is given, or one does not exist; a parameter is out of its range; the region ends
    /// nowhere; there would be too many elements.
    pub fn inset_region(&mut self, faces: &[FaceId], inset: Inset) -> Result<InsetFaces, Refusal> {
        self.inset_border(faces, inset, Shrinks::Region)
    }

    /// Insets the faces around a region: it stays as it is, and the ring of new quads is outside of it, with
    /// the materials found there. Open borders stay in place.
    ///
    /// # Errors
    /// As [`Self::inset_region`]; also if no faces are around the region.
    pub fn outset_region(&mut self, faces: &[FaceId], inset: Inset) -> Result<InsetFaces, Refusal> {
        self.inset_border(faces, Inset { open_borders: false, ..inset }, Shrinks::Outside)
    }

    fn inset_border(
        &mut self,
        faces: &[FaceId],
        inset: Inset,
        shrinks: Shrinks,
    ) -> Result<InsetFaces, Refusal> {
        let region = Region::new(self, faces, "insetting")?;
        inset.check()?;
        let mut border = region.border(self);
        border.retain(|edge| inset.open_borders || edge.outer.is_some());
        if border.is_empty() {
            let reason = "the faces have no border that could move; select fewer, or inset open borders";
            return Err(Refusal::NotPossible { operation: "insetting", reason });
        }
        self.check_capacity_for_lift(&border, &[])?;
        let lifted = self.lift_region(&region, &border, &[]);
        for (split, hinge) in lifted.splits.iter().zip(&lifted.hinges) {
            let hinge = hinge.expect("each split vertex is at a wall");
            let shrinking = if shrinks == Shrinks::Region { split.cap } else { split.base };
            self.part_fans(shrinking, hinge);
        }
        let vertices = region.vertices(self);
        let normals = if inset.depth == 0.0 { Vec::new() } else { self.region_normals(&region, &vertices) };
        let rim = IndexSet::from_faces(self, &lifted.walls);
        let slides = self.slides(&border, &lifted.walls, shrinks);
        self.dress_rim(&border, &lifted.walls, shrinks);
        self.slide_border(&slides, inset.thickness, |face| match shrinks {
            Shrinks::Region => region.contains(face),
            Shrinks::Outside => !region.contains(face) && !rim.contains(face.0),
        });
        self.dress_moved(&border, &lifted.walls, shrinks);
        for (&vertex, normal) in vertices.iter().zip(normals) {
            self.set_position(vertex, (self.point(vertex) + normal.even() * inset.depth).as_vec3());
        }
        Ok(InsetFaces { rim: lifted.walls, vertices })
    }

    /// The corners of the shrinking face below or above the first two corners of a quad of the rim.
    fn shrinking_side(&self, border: &BorderEdge, quad: FaceId, shrinks: Shrinks) -> [CornerId; 2] {
        match (shrinks, border.outer) {
            (Shrinks::Outside, Some(outer)) => {
                let first = self.corner_vertex(CornerId(self.faces[quad.0].corner));
                let next = self.next_corner(outer);
                // Neighbours that wind alike run along the edge in opposite directions.
                if self.corner_vertex(outer) == first { [outer, next] } else { [next, outer] }
            }
            _ => [border.inner, self.next_corner(border.inner)],
        }
    }

    /// Gives the rim all values of the side that shrinks, before it does.
    fn dress_rim(&mut self, border: &[BorderEdge], rim: &[FaceId], shrinks: Shrinks) {
        for (border, &quad) in border.iter().zip(rim) {
            let [from, to] = self.shrinking_side(border, quad, shrinks);
            self.copy_face(self.corner_face(from), quad);
            let mut corner = CornerId(self.faces[quad.0].corner);
            for source in [from, to, to, from] {
                self.copy_corner(source, corner);
                corner = self.next_corner(corner);
            }
        }
    }

    /// Gives the rim the values of the side that shrank, where that moved.
    fn dress_moved(&mut self, border: &[BorderEdge], rim: &[FaceId], shrinks: Shrinks) {
        for (border, &quad) in border.iter().zip(rim) {
            let [from, to] = self.shrinking_side(border, quad, shrinks);
            let first = CornerId(self.faces[quad.0].corner);
            let second = self.next_corner(first);
            let third = self.next_corner(second);
            let [at_from, at_to] = match shrinks {
                Shrinks::Region => [self.next_corner(third), third],
                Shrinks::Outside => [first, second],
            };
            self.copy_corner(from, at_from);
            self.copy_corner(to, at_to);
        }
    }

    /// Which vertices move, and how.
    fn slides(&self, border: &[BorderEdge], rim: &[FaceId], shrinks: Shrinks) -> Slides {
        let table = IndexTable::new(self.vertex_capacity(), 2 * border.len());
        let mut slides = Slides { list: Vec::new(), table };
        let mut normals: BTreeMap<FaceId, DVec3> = BTreeMap::new();
        for (border, &quad) in border.iter().zip(rim) {
            let [from, to] = self.shrinking_side(border, quad, shrinks);
            let [a, b] = [from, to].map(|corner| self.corner_vertex(corner));
            // Inwards of a face is to the left of its sides, seen against its normal.
            let along = self.point(b) - self.point(a);
            let along = if self.next_corner(from) == to { along } else { -along };
            let face = self.corner_face(from);
            let normal = *normals.entry(face).or_insert_with(|| self.unit_normal(face));
            let inward = unit_or_zero(normal.cross(along));
            for vertex in [a, b] {
                slides.add(vertex, inward);
            }
        }
        slides.list.iter_mut().for_each(|slide| self.keep_on_border(slide));
        slides
    }

    /// A vertex where the rim ends at an open border slides along that.
    fn keep_on_border(&self, slide: &mut Slide) {
        /// Of an edge at a smaller angle, as its sine, to the open border, the meeting point is too far away.
        const FLAT: f64 = 0.05;
        if slide.sides.count != 1 {
            return;
        }
        let inward = slide.sides.first;
        let mut across = None;
        for edge in self.vertex_edges(slide.vertex).filter(|&edge| self.is_boundary(edge)) {
            let other = self.point(self.other_vertex(edge, slide.vertex));
            let along = unit_or_zero(other - self.point(slide.vertex));
            let sine = along.dot(inward);
            if sine > FLAT {
                // `step` gives `sum·distance/|sum|²` for one side: this is `along/sine`.
                slide.sides.sum = along * sine;
                return;
            }
            if along != DVec3::ZERO {
                across.get_or_insert(along);
            }
        }
        // An open border that turns away from the rim: its vertex stays on it, as far away as the rim is wide.
        if let Some(along) = across {
            slide.sides.sum = along;
        }
    }

    /// Moves vertices away from the old border, and gives the corners there that belong to a surface
    /// their share of the values of their faces.
    fn slide_border(&mut self, slides: &Slides, distance: f64, is_surface: impl Fn(FaceId) -> bool) {
        let mut jobs: Vec<(FaceId, CornerId, usize)> = Vec::new();
        for (index, slide) in slides.list.iter().enumerate() {
            let corners = self.vertex_corners(slide.vertex);
            let corners = corners.map(|corner| (self.corner_face(corner), corner, index));
            jobs.extend(corners.filter(|&(face, ..)| is_surface(face)));
        }
        jobs.sort_unstable();
        let (mut of_corners, mut of_vertices) = (Blends::default(), Blends::default());
        let mut has_values = vec![false; slides.list.len()];
        let (mut frame, mut weights) = (FaceFrame::default(), Vec::new());
        for of_face in jobs.chunk_by(|a, b| a.0 == b.0) {
            frame.load(self, of_face[0].0);
            for number in 0..frame.corners.len() {
                let corner = frame.corners[number];
                let Ok(job) = of_face.binary_search_by_key(&corner, |&(_, corner, _)| corner) else {
                    continue;
                };
                let index = of_face[job].2;
                let step = slides.list[index].sides.step(distance);
                frame.weights(number, frame.positions[number] + step, &mut weights);
                if weights.len() == 1 {
                    continue;
                }
                let corners = &frame.corners;
                of_corners.push(weights.iter().map(|&(part, weight)| (corners[part].0, weight)), corner.0);
                if !std::mem::replace(&mut has_values[index], true) {
                    let vertex = |part: usize| self.corner_vertex(corners[part]).0;
                    let parts = weights.iter().map(|&(part, weight)| (vertex(part), weight));
                    of_vertices.push(parts, slides.list[index].vertex.0);
                }
            }
        }
        self.corner_layers.iter_mut().for_each(|layer| layer.blend_all(&of_corners));
        self.vertex_layers.iter_mut().for_each(|layer| layer.blend_all(&of_vertices));
        for slide in &slides.list {
            let position = self.point(slide.vertex) + slide.sides.step(distance);
            self.set_position(slide.vertex, position.as_vec3());
        }
    }

    /// Gives each fan of faces at one end of an upright edge, but the first, a vertex and an upright edge
    /// of its own: faces that are not joined by other edges there shrink in different
    /// directions.
    fn part_fans(&mut self, vertex: VertexId, hinge: EdgeId) {
        let mut edges: SmallVec<[EdgeId; 8]> =
            self.vertex_edges(vertex).filter(|&edge| edge != hinge).collect();
        edges.sort_unstable();
        let fans = self.fans(vertex, hinge, &edges);
        let of_edge = |edge: EdgeId| fans[edges.binary_search(&edge).expect("it is at the vertex")];
        // The first fan with faces keeps the vertex, and so do wires.
        let Some(retained) = edges.iter().position(|&edge| self.edge_corners(edge).next().is_some()) else {
            return;
        };
        let retained = fans[retained];
        let is_wire = |edge: EdgeId| self.edge_corners(edge).next().is_none();
        let leaving: SmallVec<[EdgeId; 8]> =
            edges.iter().copied().filter(|&edge| of_edge(edge) != retained && !is_wire(edge)).collect();
        if leaving.is_empty() {
            return;
        }
        let upright: SmallVec<[(CornerId, usize); 8]> = self
            .edge_corners(hinge)
            .map(|corner| {
                let starts_here = self.corner_vertex(corner) == vertex;
                let at = if starts_here { self.previous_corner(corner) } else { self.next_corner(corner) };
                (corner, of_edge(self.corner_edge(at)))
            })
            .collect();
        let foot = self.other_vertex(hinge, vertex);
        let mut parted: Vec<(usize, VertexId, EdgeId)> = Vec::new();
        for edge in leaving {
            let fan = of_edge(edge);
            let known = parted.binary_search_by_key(&fan, |&(fan, ..)| fan);
            let index = known.unwrap_or_else(|index| {
                let twin = self.twin_vertex(vertex);
                let twin_hinge = self.fresh_edge(foot, twin);
                self.copy_edge(hinge, twin_hinge);
                parted.insert(index, (fan, twin, twin_hinge));
                index
            });
            self.move_edge_end(edge, vertex, parted[index].1);
        }
        for (corner, fan) in upright {
            if let Ok(index) = parted.binary_search_by_key(&fan, |&(fan, ..)| fan) {
                let (_, twin, twin_hinge) = parted[index];
                self.unlink_at_edge(corner.0);
                if self.corner_vertex(corner) == vertex {
                    self.corners.write(corner.0).vertex = twin.0;
                }
                self.link_at_edge(corner.0, twin_hinge.0);
            }
        }
    }

    /// For each of the edges at a vertex but one, in ascending order, the number of its fan: edges are
    /// in the same fan if a face joins them.
    fn fans(&self, vertex: VertexId, hinge: EdgeId, edges: &[EdgeId]) -> SmallVec<[usize; 8]> {
        fn root(parents: &mut [usize], mut index: usize) -> usize {
            while parents[index] != index {
                parents[index] = parents[parents[index]];
                index = parents[index];
            }
            index
        }
        let mut parents: SmallVec<[usize; 8]> = (0..edges.len()).collect();
        for corner in self.vertex_corners(vertex) {
            let sides = [corner, self.previous_corner(corner)].map(|corner| self.corner_edge(corner));
            if sides.contains(&hinge) {
                continue;
            }
            let [a, b] = sides.map(|edge| edges.binary_search(&edge).expect("both are at the vertex"));
            let (a, b) = (root(&mut parents, a), root(&mut parents, b));
            let (low, high) = (a.min(b), a.max(b));
            parents[high] = low;
        }
        (0..edges.len()).map(|index| root(&mut parents, index)).collect()
    }
}

impl Slides {
    fn add(&mut self, vertex: VertexId, inward: DVec3) {
        let index = self.table.get(vertex.0).unwrap_or_else(|| {
            let index = self.list.len() as u32;
            self.list.push(Slide { vertex, sides: Sides::default() });
            self.table.insert(vertex.0, index);
            index
        });
        self.list[index as usize].sides.add(inward);
    }
}
