//! What is in each cell of a grid, and what remains of the mesh.

use trigon_math::DVec3;

use super::SourceTriangles;
use super::grid::{CellGrid, NumberedCells};

/// No element.
const NONE: u32 = u32::MAX;

/// The cells that a mesh has corners in.
pub(super) struct Cells {
    numbers: NumberedCells,
    cells: Vec<Cell>,
}

/// What is in one of them.
#[derive(Clone)]
struct Cell {
    /// Of the positions of its corners; at first their sum.
    mean: DVec3,
    corners: u32,
    /// The corner nearest to the mean, the first one of several: its vertex is that of the cell.
    nearest: Nearest,
    /// The largest triangle with a corner in it, the first one of several.
    largest: Largest,
    /// Whether a triangle that remains has a corner in it.
    is_covered: bool,
}

#[derive(Clone)]
struct Nearest {
    corner: u32,
    squared_distance: f64,
}

#[derive(Clone)]
struct Largest {
    triangle: u32,
    /// Of the parallelogram; squared.
    squared_area: f64,
}

/// A triangle with corners in three cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Survivor {
    /// The numbers of the cells in the order of the corners, beginning with the smallest.
    cells: [u32; 3],
    triangle: u32,
}

/// A corner of what remains.
#[derive(Clone, Copy)]
pub(super) struct MovedCorner {
    /// The corner of the source that it was.
    pub(super) own: u32,
    /// The corner of the source at the vertex that it has now.
    pub(super) of_cell: u32,
}

/// What remains of a mesh.
#[derive(Default)]
pub(super) struct Remaining {
    /// The corner of the source whose position each vertex has.
    pub(super) vertices: Vec<u32>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) corners: Vec<[MovedCorner; 3]>,
    /// The triangle of the source that each triangle was.
    pub(super) sources: Vec<u32>,
}

impl Cells {
    pub(super) fn of(source: &SourceTriangles<'_>, grid: &CellGrid) -> Self {
        let mut set = grid.no_cells();
        source.corners().flatten().for_each(|corner| set.insert(grid.cell(source.position(corner))));
        let numbers = set.numbered();
        let mut cells = Self { cells: vec![Cell::EMPTY; numbers.count], numbers };
        for corner in source.corners().flatten() {
            let number = cells.number(source, grid, corner);
            let cell = &mut cells.cells[number];
            cell.mean += source.position(corner).as_dvec3();
            cell.corners += 1;
        }
        cells.cells.iter_mut().for_each(|cell| cell.mean /= f64::from(cell.corners));
        cells
    }

    fn number(&self, source: &SourceTriangles<'_>, grid: &CellGrid, corner: u32) -> usize {
        self.numbers.number(grid.cell(source.position(corner)))
    }

    /// The triangles that remain. They are sorted by their cells, so that neighbours are near each other in memory.
    pub(super) fn remaining(mut self, source: &SourceTriangles<'_>, grid: &CellGrid) -> Remaining {
        let survivors = self.survivors(source, grid);
        let mut remaining = Remaining::default();
        let mut vertices = vec![NONE; self.cells.len()];
        for Survivor { triangle, .. } in survivors {
            let own = source.corners_of(triangle);
            let numbers = own.map(|corner| self.number(source, grid, corner));
            let corners = [0, 1, 2].map(|i| {
                let cell = &mut self.cells[numbers[i]];
                cell.is_covered = true;
                MovedCorner { own: own[i], of_cell: cell.nearest.corner }
            });
            for (number, corner) in numbers.into_iter().zip(&corners) {
                if vertices[number] == NONE {
                    vertices[number] = remaining.push_vertex(corner.of_cell);
                }
            }
            remaining.push(triangle, numbers.map(|number| vertices[number]), corners);
        }
        let uncovered = self.cells.iter().filter(|cell| !cell.is_covered);
        let mut retained: Vec<u32> = uncovered.map(|cell| cell.largest.triangle).collect();
        retained.sort_unstable();
        retained.dedup();
        for triangle in retained {
            let own = source.corners_of(triangle);
            let vertices = own.map(|corner| remaining.push_vertex(corner));
            remaining.push(
                triangle,
                vertices,
                own.map(|corner| MovedCorner { own: corner, of_cell: corner }),
            );
        }
        remaining
    }

    /// Finds the vertices and the largest triangles of the cells, and the triangles with corners in three of them: the
    /// first of those that are alike.
    fn survivors(&mut self, source: &SourceTriangles<'_>, grid: &CellGrid) -> Vec<Survivor> {
        let mut survivors = Vec::new();
        for (triangle, corners) in (0..).zip(source.corners()) {
            let points = corners.map(|corner| source.position(corner).as_dvec3());
            let numbers = corners.map(|corner| self.number(source, grid, corner));
            let squared_area = (points[1] - points[0]).cross(points[2] - points[0]).length_squared();
            for ((number, corner), point) in numbers.into_iter().zip(corners).zip(points) {
                self.cells[number].add(corner, point, Largest { triangle, squared_area });
            }
            let [a, b, c] = numbers.map(|number| number as u32);
            if a != b && b != c && c != a {
                let turned = [[a, b, c], [b, c, a], [c, a, b]];
                let cells = turned.into_iter().min().expect("there are three");
                survivors.push(Survivor { cells, triangle });
            }
        }
        survivors.sort_unstable();
        survivors.dedup_by_key(|survivor| survivor.cells);
        survivors
    }
}

impl Cell {
    const EMPTY: Self = Self {
        mean: DVec3::ZERO,
        corners: 0,
        nearest: Nearest { corner: NONE, squared_distance: f64::INFINITY },
        largest: Largest { triangle: NONE, squared_area: 0.0 },
        is_covered: false,
    };

    /// Adds a corner at a point, and its triangle. The first is taken whatever its values are: they may be no numbers.
    fn add(&mut self, corner: u32, point: DVec3, of: Largest) {
        let squared_distance = point.distance_squared(self.mean);
        if self.nearest.corner == NONE || squared_distance < self.nearest.squared_distance {
            self.nearest = Nearest { corner, squared_distance };
        }
        if self.largest.triangle == NONE || of.squared_area > self.largest.squared_area {
            self.largest = of;
        }
    }
}

impl Remaining {
    fn push_vertex(&mut self, corner: u32) -> u32 {
        self.vertices.push(corner);
        self.vertices.len() as u32 - 1
    }

    fn push(&mut self, source: u32, triangle: [u32; 3], corners: [MovedCorner; 3]) {
        self.sources.push(source);
        self.triangles.push(triangle);
        self.corners.push(corners);
    }
}
