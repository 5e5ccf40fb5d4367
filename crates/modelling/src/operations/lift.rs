//! Lifting faces off a mesh: walls connect the lifted faces to their old positions. Nothing moves
//! yet, so walls have no area.

use smallvec::SmallVec;
use trigon_math::{DVec3, angle, area_vector, unit_or_zero};

use super::region::{BorderEdge, Region, SplitVertex, SplitVertices};
use super::tables::IndexTable;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// A region that was lifted as a whole.
pub(super) struct Lifted {
    /// One for each border edge, in order. The corners of a wall, from its first on: at the base of the
    /// vertex of the border's inner corner, at the base of the next corner's, and at both vertices of the cap
    /// backwards.
    pub(super) walls: Vec<FaceId>,
    /// The flipped faces that close sheets.
    pub(super) bottoms: Vec<FaceId>,
    pub(super) splits: Vec<SplitVertex>,
    /// For each split vertex the edge to its base; `None` without a wall.
    pub(super) hinges: Vec<Option<EdgeId>>,
}

/// The result of lifting one face after the other, with memory reused for each.
#[derive(Default)]
pub(super) struct LiftedFaces {
    /// The walls, for each corner of a face the one along the edge that leaves there. Corners are as in
    /// [`Lifted::walls`].
    pub(super) walls: Vec<FaceId>,
    /// The new vertices, for each corner of a face.
    pub(super) vertices: Vec<VertexId>,
    corners: Vec<CornerId>,
    old: Vec<(VertexId, EdgeId)>,
    new_edges: Vec<EdgeId>,
    hinges: Vec<EdgeId>,
}

/// A corner of a face of a region.
#[derive(Debug, Clone, Copy)]
pub(super) struct RegionCorner {
    /// Of its vertex, in the list of the region's vertices.
    pub(super) index: usize,
    /// The unit normal of its face.
    pub(super) normal: DVec3,
    /// The angle of the face there, in radians.
    pub(super) angle: f64,
}

/// The unit normals of faces at a vertex, weighted by their angles there.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NormalSum {
    sum: DVec3,
    angle: f64,
}

impl NormalSum {
    /// The direction of the mean; zero if it has none.
    pub(super) fn direction(self) -> DVec3 {
        unit_or_zero(self.sum)
    }

    /// A vector along the mean whose component along each normal is 1, in the mean: a vertex that moves by it moves
    /// the planes of its faces by 1, exactly where all are at the same angle to the mean. Zero if that has no direction.
    pub(super) fn even(self) -> DVec3 {
        /// Almost folded faces would need endless vectors.
        const LONGEST: f64 = 20.0;
        let direction = self.direction();
        let component = direction.dot(self.sum) / self.angle;
        direction * if component > 1.0 / LONGEST { 1.0 / component } else { LONGEST }
    }
}

impl EditMesh {
    /// Refuses a region for which there is no room once it is lifted.
    pub(super) fn check_capacity_for_lift(
        &self,
        border: &[BorderEdge],
        sheets: &[FaceId],
    ) -> Result<(), Refusal> {
        let corners: usize = sheets.iter().map(|&face| self.face_size(face)).sum();
        let (border, corners) = (border.len() as u64, corners as u64);
        // A wall has a base, two edges that lead up to it, and vertices at their ends; a bottom is a copy.
        self.check_capacity_for(NewElements {
            vertices: 2 * border + corners,
            edges: 3 * border + corners,
            corners: 4 * border + corners,
            faces: border + sheets.len() as u64,
        })
    }

    /// Refuses faces that are lifted one by one where there is no room for a wall along each of their edges.
    pub(super) fn check_capacity_for_walls(&self, corners: usize) -> Result<(), Refusal> {
        let walls = corners as u64;
        self.check_capacity_for(NewElements {
            vertices: walls,
            edges: 2 * walls,
            corners: 4 * walls,
            faces: walls,
        })
    }

    /// Lifts a region: walls along the given border edges, and bottoms for the faces of sheets.
    pub(super) fn lift_region(
        &mut self,
        region: &Region,
        border: &[BorderEdge],
        sheets: &[FaceId],
    ) -> Lifted {
        let corners_of_sheets: usize = sheets.iter().map(|&face| self.face_size(face)).sum();
        let mut splits = SplitVertices::new(self, border.len() + corners_of_sheets);
        for border in border {
            for vertex in self.edge_vertices(border.edge) {
                splits.split(self, vertex);
            }
        }
        for &face in sheets {
            let mut corner = CornerId(self.faces[face.0].corner);
            for _ in 0..self.face_size(face) {
                splits.split(self, self.corner_vertex(corner));
                corner = self.next_corner(corner);
            }
        }
        let base_edges = self.part_from_outside(region, border, &splits);
        let bottoms = self.add_bottoms(sheets, border, &base_edges, &splits);
        let mut hinges = vec![None; splits.list.len()];
        let sides = border.iter().zip(&base_edges);
        let walls = sides.map(|(border, &base)| self.add_wall(border, base, &splits, &mut hinges)).collect();
        Lifted { walls, bottoms, splits: splits.list, hinges }
    }

    /// The wall along an edge of the border, wound like the face of the region there.
    pub(super) fn add_wall(
        &mut self,
        border: &BorderEdge,
        base_edge: EdgeId,
        splits: &SplitVertices,
        hinges: &mut [Option<EdgeId>],
    ) -> FaceId {
        let from = border.inner;
        let to = self.next_corner(from);
        let [(a, base_a, hinge_a), (b, base_b, hinge_b)] = [from, to].map(|corner| {
            let index = splits.index_of(self.corner_vertex(corner)).expect("the border was split");
            let SplitVertex { cap, base } = splits.list[index];
            let hinge = *hinges[index].get_or_insert_with(|| self.fresh_edge(base, cap));
            (cap, base, hinge)
        });
        let outline = [(base_a, base_edge), (base_b, hinge_b), (b, border.edge), (a, hinge_a)];
        let wall = self.face_along(&outline);
        self.copy_face(self.corner_face(from), wall);
        self.dress_wall(wall, from, to);
        wall
    }

    /// Gives the corners of a wall the values of the two corners below it.
    fn dress_wall(&mut self, wall: FaceId, from: CornerId, to: CornerId) {
        let mut corner = CornerId(self.faces[wall.0].corner);
        for source in [from, to, to, from] {
            self.copy_corner_upright(source, corner);
            corner = self.next_corner(corner);
        }
    }

    /// The faces of sheets once more, flipped, on the base's vertices.
    pub(super) fn add_bottoms(
        &mut self,
        sheets: &[FaceId],
        border: &[BorderEdge],
        base_edges: &[EdgeId],
        splits: &SplitVertices,
    ) -> Vec<FaceId> {
        if sheets.is_empty() {
            return Vec::new();
        }
        let corners: usize = sheets.iter().map(|&face| self.face_size(face)).sum();
        let mut edges = IndexTable::new(self.edge_capacity(), corners);
        for (border, base) in border.iter().zip(base_edges) {
            edges.insert(border.edge.0, base.0);
        }
        let mut sources: Vec<CornerId> = Vec::new();
        let mut outline: Vec<(VertexId, EdgeId)> = Vec::new();
        let mut add = |&face: &FaceId| {
            sources.clear();
            sources.extend(self.face_corners(face));
            // The first corner stays first, the others follow in the opposite direction.
            sources[1..].reverse();
            outline.clear();
            for &corner in &sources {
                let edge = self.corner_edge(self.previous_corner(corner));
                let edge = self.base_edge(edge, &mut edges, splits);
                outline.push((splits.base(self.corner_vertex(corner)).expect("sheets were split"), edge));
            }
            let bottom = self.face_along(&outline);
            self.copy_face(face, bottom);
            let mut corner = CornerId(self.faces[bottom.0].corner);
            for &source in &sources {
                self.copy_corner(source, corner);
                self.corner_layers.iter_mut().for_each(|layer| layer.turn_over(corner.0));
                corner = self.next_corner(corner);
            }
            bottom
        };
        sheets.iter().map(&mut add).collect()
    }

    /// The edge of the base below one of a sheet.
    fn base_edge(&mut self, edge: EdgeId, edges: &mut IndexTable, splits: &SplitVertices) -> EdgeId {
        if let Some(base) = edges.get(edge.0) {
            return EdgeId(base);
        }
        let [a, b] = self.edge_vertices(edge).map(|vertex| splits.base(vertex).expect("sheets were split"));
        let base = self.fresh_edge(a, b);
        self.copy_edge(edge, base);
        edges.insert(edge.0, base.0);
        base
    }

    /// Lifts one face that visits each of its vertices once: the face gets new vertices at the given
    /// positions, one for each corner, and the rest keeps the old ones. The corners of the walls have no
    /// values yet.
    pub(super) fn lift_face(&mut self, face: FaceId, positions: &[DVec3], lifted: &mut LiftedFaces) {
        let LiftedFaces { walls, vertices, corners, old, new_edges, hinges } = lifted;
        corners.clear();
        corners.extend(self.face_corners(face));
        old.clear();
        old.extend(corners.iter().map(|&corner| (self.corner_vertex(corner), self.corner_edge(corner))));
        let count = corners.len();
        let first = vertices.len();
        for (&(vertex, _), position) in old.iter().zip(positions) {
            let lifted = self.twin_vertex(vertex);
            *self.positions.write(lifted.0) = position.as_vec3();
            vertices.push(lifted);
        }
        let caps = &vertices[first..];
        hinges.clear();
        new_edges.clear();
        for i in 0..count {
            let hinge = self.new_edge([old[i].0.0, caps[i].0]);
            self.link_at_vertex(hinge, 0);
            hinges.push(EdgeId(hinge));
            let edge = EdgeId(self.new_edge([caps[i].0, caps[(i + 1) % count].0]));
            self.copy_edge(old[i].1, edge);
            self.unlink_at_edge(corners[i].0);
            self.corners.write(corners[i].0).vertex = caps[i].0;
            self.link_at_edge(corners[i].0, edge.0);
            new_edges.push(edge);
        }
        for i in 0..count {
            let before = new_edges[(i + count - 1) % count];
            self.link_all_at_vertex(caps[i].0, &[hinges[i].0, before.0, new_edges[i].0]);
        }
        for i in 0..count {
            let next = (i + 1) % count;
            let wall = self.face_along(&[
                old[i],
                (old[next].0, hinges[next]),
                (caps[next], new_edges[i]),
                (caps[i], hinges[i]),
            ]);
            self.copy_face(face, wall);
            walls.push(wall);
        }
    }

    /// Gives the walls of the last lifted face the values of its corners.
    pub(super) fn dress_walls(&mut self, lifted: &LiftedFaces) {
        let count = lifted.corners.len();
        let walls = &lifted.walls[lifted.walls.len() - count..];
        for (i, &wall) in walls.iter().enumerate() {
            self.dress_wall(wall, lifted.corners[i], lifted.corners[(i + 1) % count]);
        }
    }

    /// The unit normal of a face; zero if it has no area or is not finite.
    pub(super) fn unit_normal(&self, face: FaceId) -> DVec3 {
        unit_or_zero(area_vector(self.face_vertices(face).map(|vertex| self.point(vertex))))
    }

    /// The corners of a region's faces, without those of faces that have no normal. All vertices of the region are listed.
    pub(super) fn region_corners(
        &self,
        region: &Region,
        vertices: &[VertexId],
    ) -> impl Iterator<Item = RegionCorner> {
        let mut indices = IndexTable::new(self.vertex_capacity(), vertices.len());
        for (index, vertex) in (0..).zip(vertices) {
            indices.insert(vertex.0, index);
        }
        let of_face = move |face: FaceId| {
            let normal = self.unit_normal(face);
            let corners: SmallVec<[RegionCorner; 4]> = self
                .face_corners(face)
                .filter(|_| normal != DVec3::ZERO)
                .map(|corner| {
                    let point = |corner| self.point(self.corner_vertex(corner));
                    let here = point(corner);
                    let [back, ahead] = [self.previous_corner(corner), self.next_corner(corner)].map(point);
                    let index = indices.get(self.corner_vertex(corner).0).expect("all are listed");
                    RegionCorner { index: index as usize, normal, angle: angle(back - here, ahead - here) }
                })
                .collect();
            corners
        };
        region.faces.iter().copied().flat_map(of_face)
    }

    /// For each vertex of a region the normals of the region's faces there.
    pub(super) fn region_normals(&self, region: &Region, vertices: &[VertexId]) -> Vec<NormalSum> {
        let mut sums = vec![NormalSum::default(); vertices.len()];
        for RegionCorner { index, normal, angle } in self.region_corners(region, vertices) {
            sums[index].sum += normal * angle;
            sums[index].angle += angle;
        }
        sums
    }
}
