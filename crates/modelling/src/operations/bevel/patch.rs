//! The grid that fills the middle where three or more curves meet.
//!
//! From each node a square part of the grid goes to the middles of both curves beside it and to the common centre
//! (for an odd number of segments to a polygon there). Points have one coordinate for each node. On a cube's
//! corner the points are those of a sphere or superellipsoid, so the ratios of coordinates on the curves give the
//! ratios within (on a sphere the "equiangular cubed sphere": Ronchi, Iacono, Paolucci, "The Cubed Sphere", 1996),
//! and the sum of their powers is 1.

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::laid::Round;
use super::profile::Profile;
use super::shape::{NewCorner, Plan};
use crate::ids::{CornerId, NONE};

/// One side of a grid: a node, and the curve from it to the next node.
#[derive(Debug, Clone, Copy)]
struct GridSide {
    node: u32,
    home: CornerId,
    arc: u32,
    is_reversed: bool,
    control: DVec3,
}

/// The points of a grid within its border.
struct PatchGrid {
    sides: SmallVec<[GridSide; 8]>,
    /// How many steps each part has along a curve.
    half: usize,
    is_even: bool,
    /// The points within each part, `inner_rows` by `half` of them.
    inner: Vec<u32>,
    inner_rows: usize,
    center: u32,
}

impl Plan<'_> {
    pub(super) fn add_grid(&mut self, round: &Round, profile: &Profile, width: f64) {
        let sides = self.sides(round, width);
        let grid = self.grid_points(sides, profile);
        for side in 0..grid.sides.len() {
            for b in 0..grid.half {
                for a in 0..grid.half {
                    let cells = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)];
                    let points = cells.map(|(a, b)| self.grid_point(&grid, side, a, b));
                    self.add_grid_face(round, &grid, side, &points);
                }
                if !grid.is_even {
                    let (half, next) = (grid.half, (side + 1) % grid.sides.len());
                    let points = [
                        self.grid_point(&grid, side, half, b),
                        self.grid_point(&grid, next, b, half),
                        self.grid_point(&grid, next, b + 1, half),
                        self.grid_point(&grid, side, half, b + 1),
                    ];
                    self.add_grid_face(round, &grid, side, &points);
                }
            }
        }
        if !grid.is_even {
            let center: SmallVec<[u32; 8]> = (0..grid.sides.len())
                .map(|side| self.grid_point(&grid, side, grid.half, grid.half))
                .collect();
            self.add_grid_face(round, &grid, 0, &center);
        }
    }

    fn sides(&self, round: &Round, width: f64) -> SmallVec<[GridSide; 8]> {
        let mut sides = SmallVec::<[GridSide; 8]>::new();
        for stop in self.stops(round) {
            if stop.arc != NONE {
                sides.push(GridSide {
                    node: stop.right,
                    home: self.out.laid.nodes[stop.right as usize].home,
                    arc: stop.arc,
                    is_reversed: stop.is_reversed,
                    control: self.control(stop.arc, width),
                });
            }
        }
        sides
    }

    fn add_grid_face(&mut self, round: &Round, grid: &PatchGrid, side: usize, points: &[u32]) {
        let home = grid.sides[side].home;
        let corners: SmallVec<[NewCorner; 8]> =
            points.iter().map(|&point| self.corner_in_middle(round, home, point)).collect();
        let material = self.mesh.corner_face(home);
        self.add_face(corners, material);
    }

    /// Makes the points within a grid.
    fn grid_points(&mut self, sides: SmallVec<[GridSide; 8]>, profile: &Profile) -> PatchGrid {
        let half = self.out.segments / 2;
        let is_even = self.out.segments.is_multiple_of(2);
        // For an even number the last row belongs to the neighbour, and the last point to all.
        let inner_rows = if is_even { half - 1 } else { half };
        let ratio = |step: usize| profile.point(step).y / profile.point(step).x;
        let mut inner = Vec::with_capacity(sides.len() * inner_rows * half);
        for side in 0..sides.len() {
            for b in 1..=inner_rows {
                for a in 1..=half {
                    inner.push(self.add_inner(&sides, side, [ratio(a), ratio(b)], profile));
                }
            }
        }
        let center = if is_even { self.add_inner(&sides, 0, [1.0, 1.0], profile) } else { NONE };
        PatchGrid { sides, half, is_even, inner, inner_rows, center }
    }

    /// A point of the part at one node: `a` steps towards the next node, `b` towards the one before.
    fn grid_point(&self, grid: &PatchGrid, side: usize, a: usize, b: usize) -> u32 {
        let count = grid.sides.len();
        let before = (side + count - 1) % count;
        if b == 0 {
            let here = &grid.sides[side];
            self.out.curve_point(here.arc, here.is_reversed, a)
        } else if a == 0 {
            let other = &grid.sides[before];
            self.out.curve_point(other.arc, other.is_reversed, self.out.segments - b)
        } else if b > grid.inner_rows {
            if a == grid.half { grid.center } else { self.grid_point(grid, before, grid.half, a) }
        } else {
            grid.inner[(side * grid.inner_rows + b - 1) * grid.half + a - 1]
        }
    }

    /// Adds a point whose coordinates have given ratios to that of its own node.
    fn add_inner(&mut self, sides: &[GridSide], side: usize, ratios: [f64; 2], profile: &Profile) -> u32 {
        let count = sides.len();
        // The others are as large as both ratios allow: none on the curves, all alike in the centre.
        let mut coordinates: SmallVec<[f64; 8]> = SmallVec::from_elem(ratios[0] * ratios[1], count);
        coordinates[side] = 1.0;
        coordinates[(side + 1) % count] = ratios[0];
        coordinates[(side + count - 1) % count] = ratios[1];
        let norm = profile.norm(coordinates.iter().copied());
        coordinates.iter_mut().for_each(|x| *x /= norm);
        let product = |i: usize| coordinates[i] * coordinates[(i + 1) % count];
        let products: f64 = (0..count).map(product).sum();
        // Each curve has its point opposite the control point: their mean is the origin here.
        let rest = 1.0 - coordinates.iter().sum::<f64>();
        let mut terms = SmallVec::<[(u32, f64); 16]>::new();
        let mut position = DVec3::ZERO;
        for (i, here) in sides.iter().enumerate() {
            let before = (i + count - 1) % count;
            let weight = coordinates[i] + rest * (product(i) + product(before)) / products;
            let control = -rest * product(i) / products;
            position += self.out.positions[here.node as usize] * weight + here.control * control;
            terms.push((self.out.point_sums[here.node as usize], weight));
            terms.push((self.out.laid.arcs[here.arc as usize].control_sum, control));
        }
        let sum = self.combine(terms);
        self.add_point(position, sum, CornerId(NONE))
    }
}
