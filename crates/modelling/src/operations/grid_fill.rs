//! Filling a loop of edges with a grid of quads.

use trigon_math::{DVec3, area_vector};

use super::delete::require;
use super::fill::Filled;
use super::outlines::Chain;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

const FILLING: &str = "filling with a grid";

/// How a loop is divided into the four sides of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GridSides {
    /// The number of edges on the first and the third side, 1 to half of all minus 1; the two others have the
    /// rest. `None` for a grid as square as possible.
    pub span: Option<usize>,
    /// Shifts the first corner along the loop by this number of edges; any number.
    pub offset: usize,
}

/// A grid of points whose border is a loop.
struct Grid<'a> {
    border: &'a [VertexId],
    columns: usize,
    rows: usize,
}

impl Grid<'_> {
    /// The index in the loop of a border point.
    fn on_border(&self, column: usize, row: usize) -> Option<usize> {
        let (columns, rows) = (self.columns, self.rows);
        let index = match (column, row) {
            (column, 0) => column,
            (column, row) if column == columns => columns + row,
            (column, row) if row == rows => 2 * columns + rows - column,
            (0, row) => 2 * columns + 2 * rows - row,
            _ => return None,
        };
        Some(index % self.border.len())
    }

    /// Weights of border points for an inner point: the bilinearly blended patch of S. A. Coons
    /// ("Surfaces for computer-aided design of space forms", 1967).
    fn weights(&self, column: usize, row: usize) -> [(usize, f64); 8] {
        let (columns, rows) = (self.columns, self.rows);
        let (u, v) = (column as f64 / columns as f64, row as f64 / rows as f64);
        let parts = [
            (column, 0, 1.0 - v),
            (column, rows, v),
            (0, row, 1.0 - u),
            (columns, row, u),
            (0, 0, -(1.0 - u) * (1.0 - v)),
            (columns, 0, -u * (1.0 - v)),
            (columns, rows, -u * v),
            (0, rows, -(1.0 - u) * v),
        ];
        parts.map(|(column, row, weight)| {
            (self.on_border(column, row).expect("it is on a side or at a corner"), weight)
        })
    }
}

impl EditMesh {
    /// Fills a loop with an even number of edges with a grid of quads. Its inner vertices continue
    /// the sides smoothly (a Coons patch), and so do values: those of vertices always, those of
    /// corners if all vertices of the loop have an adjacent face.
    ///
    /// Faces are wound like their neighbours, as in [`Self::fill_edges`], and have the material of the first.
    ///
    /// # Errors
    /// No edge is given, one does not exist, they do not form one loop with an even number of edges, a face is
    /// there already, the span is out of range, or the mesh would have too many elements.
    pub fn grid_fill(&mut self, edges: &[EdgeId], sides: GridSides) -> Result<Filled, Refusal> {
        require(edges, FILLING, "one loop of edges")?;
        let refused = |reason| Err(Refusal::NotPossible { operation: FILLING, reason });
        let chains = self.chains(edges, FILLING)?;
        let [chain @ Chain { is_closed: true, .. }] = &chains[..] else {
            return refused("exactly one closed loop is needed");
        };
        let count = chain.vertices.len();
        if count < 4 || count % 2 != 0 {
            return refused("an even number of edges, four or more, is needed: subdivide one");
        }
        if self.face_over(&chain.vertices, |_| false).is_some() {
            return refused("there is a face within the loop already: delete it first");
        }
        let columns = sides.span.unwrap_or(count / 4);
        if !(1..count / 2).contains(&columns) {
            let (parameter, range) = ("the span", "1 to half of the edges less 1");
            return Err(Refusal::OutOfRange { parameter, value: columns as f64, range });
        }
        let rows = count / 2 - columns;
        let area = columns as u64 * rows as u64;
        self.check_capacity_for(NewElements {
            vertices: area,
            edges: 2 * area,
            corners: 4 * area,
            faces: area,
        })?;
        let mut chain = chain.clone();
        chain.vertices.rotate_left(sides.offset % count);
        let is_reversed = self.is_wound_against(&chain);
        let sources: Option<Vec<CornerId>> = self.corners_beside(&chain).into_iter().collect();
        let neighbor = self.corners_beside(&chain).into_iter().flatten().next();
        let grid = Grid { border: &chain.vertices, columns, rows };
        self.whole(|mesh| {
            let mut filled = Filled::default();
            mesh.add_grid(&grid, sources.as_deref(), is_reversed, &mut filled)?;
            if let Some(neighbor) = neighbor.map(|corner| mesh.corner_face(corner)) {
                filled.faces.iter().for_each(|&face| mesh.copy_face(neighbor, face));
            }
            Ok(filled)
        })
    }

    /// Whether a face in a loop must run against it.
    pub(super) fn is_wound_against(&self, chain: &Chain) -> bool {
        let votes = self.winding_votes(chain.steps());
        let normal = area_vector(chain.vertices.iter().map(|&vertex| self.point(vertex)));
        let longest =
            normal.to_array().into_iter().fold(0.0f64, |a, b| if b.abs() > a.abs() { b } else { a });
        votes < 0 || (votes == 0 && longest < 0.0)
    }

    fn add_grid(
        &mut self,
        grid: &Grid<'_>,
        sources: Option<&[CornerId]>,
        is_reversed: bool,
        filled: &mut Filled,
    ) -> Result<(), Refusal> {
        let points = self.grid_points(grid, filled)?;
        let at = |column: usize, row: usize| points[row * (grid.columns + 1) + column];
        for row in 0..grid.rows {
            for column in 0..grid.columns {
                let mut cells = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                if is_reversed {
                    cells.reverse();
                }
                let vertices = cells.map(|(column, row)| at(column, row));
                for i in 0..4 {
                    self.join_new(vertices[i], vertices[(i + 1) % 4], &mut filled.edges);
                }
                let face = self.add_first_face(&vertices, FILLING)?;
                filled.faces.push(face);
                let Some(sources) = sources else { continue };
                let corners: Vec<CornerId> = self.face_corners(face).collect();
                for (corner, (column, row)) in corners.into_iter().zip(cells) {
                    match grid.on_border(column, row) {
                        Some(index) => self.copy_corner(sources[index], corner),
                        None => {
                            let parts = grid.weights(column, row);
                            self.blend_corner(&parts.map(|(index, weight)| (sources[index], weight)), corner);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// All points, row by row, with new inner ones.
    fn grid_points(&mut self, grid: &Grid<'_>, filled: &mut Filled) -> Result<Vec<VertexId>, Refusal> {
        let mut points = Vec::with_capacity((grid.columns + 1) * (grid.rows + 1));
        for row in 0..=grid.rows {
            for column in 0..=grid.columns {
                if let Some(index) = grid.on_border(column, row) {
                    points.push(grid.border[index]);
                    continue;
                }
                let parts = grid.weights(column, row).map(|(index, weight)| (grid.border[index], weight));
                let position: DVec3 = parts.iter().map(|&(vertex, weight)| self.point(vertex) * weight).sum();
                let vertex = self.add_vertex(position.as_vec3())?;
                self.blend_vertex(&parts, vertex);
                filled.vertices.push(vertex);
                points.push(vertex);
            }
        }
        Ok(points)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::ids::FaceId;
    use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    /// A grid with a hole of two by three quads in its middle, and the hole's border.
    fn with_hole() -> (EditMesh, Vec<EdgeId>, EditMesh) {
        let (whole, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(6.0, 7.0, 6, 7)));
        let is_inside = |mesh: &EditMesh, face: FaceId| {
            mesh.face_vertices(face)
                .all(|v| mesh.position(v).x.abs() <= 1.0 && mesh.position(v).z.abs() <= 1.5)
        };
        let mut mesh = whole.clone();
        let faces: Vec<FaceId> = mesh.faces().filter(|&face| is_inside(&mesh, face)).collect();
        assert_eq!(faces.len(), 6, "two by three");
        mesh.delete_faces(&faces).expect("they are there");
        let is_border = |edge: &EdgeId| {
            let inside = |v: VertexId| mesh.position(v).x.abs() <= 1.0 && mesh.position(v).z.abs() <= 1.5;
            mesh.is_boundary(*edge) && mesh.edge_vertices(*edge).into_iter().all(inside)
        };
        let border = mesh.edges().filter(is_border).collect();
        (mesh, border, whole)
    }

    #[test]
    fn a_hole_in_a_grid_is_filled_as_it_was() {
        let (start, border, whole) = with_hole();
        let fits = (0..10).filter(|&offset| {
            let mut mesh = start.clone();
            let filled = mesh.grid_fill(&border, GridSides { span: Some(2), offset }).expect("a loop of ten");
            let made = [filled.vertices.len(), filled.edges.len(), filled.faces.len()];
            assert_eq!((made, counts(&mesh)), ([2, 7, 6], counts(&whole)), "offset {offset}");
            keeps_affine_values(&mesh).expect("values continue those around");
            let normal = |face| area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex)));
            mesh.faces().all(|face| normal(face).abs_diff_eq(DVec3::Y, 1e-6))
        });
        assert_eq!(fits.count(), 2, "where the corners are those of the hole, from either end");
    }

    #[test]
    fn a_loop_without_neighbours_faces_up() {
        let (mesh, _) = EditMesh::from_mesh(&primitives::disc(1.0, 12));
        let mut mesh = mesh;
        let border: Vec<EdgeId> = mesh.edges().filter(|&edge| mesh.is_boundary(edge)).collect();
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.delete_only_faces(&faces).expect("they are there");
        let count = border.len();
        let filled = mesh.grid_fill(&border, GridSides::default()).expect("an even loop");
        assert_eq!(filled.faces.len(), (count / 4) * (count / 2 - count / 4), "as square as can be");
        let normal = |face| area_vector(mesh.face_vertices(face).map(|vertex| mesh.point(vertex)));
        let sum: DVec3 = filled.faces.iter().map(|&face| normal(face)).sum();
        assert!(sum.y > 0.0, "towards +Y");
    }

    #[test]
    fn what_cannot_be_filled_is_said() {
        let (mut mesh, border, _) = with_hole();
        let before = mesh.clone();
        for span in [0, 5] {
            let sides = GridSides { span: Some(span), offset: 0 };
            assert!(
                matches!(mesh.grid_fill(&border, sides), Err(Refusal::OutOfRange { .. })),
                "{span} of ten"
            );
        }
        assert!(mesh.grid_fill(&border[1..], GridSides::default()).is_err(), "it is open");
        assert!(mesh.grid_fill(&[], GridSides::default()).is_err(), "nothing");
        assert!(mesh == before, "nothing changed");
    }

    proptest! {
        #[test]
        fn filling_with_a_grid_keeps_every_rule(start in meshes(), pick: u32, span in 0usize..3, offset: usize) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            // The sides of any face, mostly four.
            let faces: Vec<FaceId> = mesh.faces().collect();
            let face = faces.get(pick as usize % faces.len().max(1));
            let edges: Vec<EdgeId> = face.iter().flat_map(|&&face| mesh.face_edges(face)).collect();
            let sides = GridSides { span: (span > 0).then_some(span), offset };
            let outcome = check_operation(&mesh, |mesh| mesh.grid_fill(&edges, sides));
            if let Some((after, filled)) = outcome.map_err(TestCaseError::fail)? {
                prop_assert_eq!(after.face_count(), mesh.face_count() + filled.faces.len());
                prop_assert_eq!(after.vertex_count(), mesh.vertex_count() + filled.vertices.len());
            }
        }
    }
}
