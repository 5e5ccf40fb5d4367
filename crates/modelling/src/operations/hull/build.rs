//! The hull of points, by exact signs.
//!
//! Triangles grow around a tetrahedron, each time to the farthest point in front of one (C. B. Barber, D. Dobkin,
//! H. Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996). A point in the plane of a triangle is not in front of it,
//! so that the result is exactly convex; triangles in one plane are united at the end.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use trigon_math::{DVec2, DVec3, DisjointSets, Orientation, orientation, side_of_triangle};

struct HullTriangle {
    vertices: [u32; 3],
    /// Across the side from each vertex to the next.
    neighbors: [u32; 3],
    /// The points in front of it for which it was found first.
    points: Vec<u32>,
    is_gone: bool,
}

/// The faces of the hull as lists of points, counter-clockwise from outside. `None` if all points are in a plane.
pub(super) fn hull_polygons(points: &[DVec3]) -> Option<Vec<Vec<u32>>> {
    let first = first_tetrahedron(points)?;
    let mut hull = Hull { points, triangles: Vec::new() };
    let mut waiting: Vec<u32> = (0..4).collect();
    hull.begin(first, &mut waiting);
    while let Some(number) = waiting.pop() {
        let triangle = &hull.triangles[number as usize];
        if !triangle.is_gone && !triangle.points.is_empty() {
            hull.grow(number, &mut waiting);
        }
    }
    Some(hull.polygons())
}

/// Four points that are not in a plane.
fn first_tetrahedron(points: &[DVec3]) -> Option<[u32; 4]> {
    let indices = || 0..points.len() as u32;
    let at = |index: u32| points[index as usize];
    let farthest = |measure: &dyn Fn(DVec3) -> f64| {
        indices().max_by(|&a, &b| measure(at(a)).total_cmp(&measure(at(b))).then(b.cmp(&a)))
    };
    let a = farthest(&|point| -point.x)?;
    let b = farthest(&|point| point.distance_squared(at(a)))?;
    let c = farthest(&|point| (point - at(a)).cross(at(b) - at(a)).length_squared())?;
    // What rounding takes for flat may not be.
    let c =
        if is_line(at(a), at(b), at(c)) { indices().find(|&c| !is_line(at(a), at(b), at(c)))? } else { c };
    let normal = (at(b) - at(a)).cross(at(c) - at(a));
    let side = |d: u32| side_of_triangle([at(a), at(b), at(c)], at(d));
    let d = farthest(&|point| (point - at(a)).dot(normal).abs())?;
    let d = if side(d) == Ordering::Equal { indices().find(|&d| side(d) != Ordering::Equal)? } else { d };
    Some(if side(d) == Ordering::Less { [a, b, c, d] } else { [a, c, b, d] })
}

/// Whether three points are on a line: if they are in each view along an axis.
fn is_line(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let along = |view: fn(DVec3) -> DVec2| orientation(view(a), view(b), view(c)) == Orientation::Collinear;
    along(|p| DVec2::new(p.x, p.y)) && along(|p| DVec2::new(p.y, p.z)) && along(|p| DVec2::new(p.z, p.x))
}

struct Hull<'a> {
    points: &'a [DVec3],
    triangles: Vec<HullTriangle>,
}

impl Hull<'_> {
    fn side(&self, triangle: u32, point: u32) -> Ordering {
        let corners = self.triangles[triangle as usize].vertices.map(|vertex| self.points[vertex as usize]);
        side_of_triangle(corners, self.points[point as usize])
    }

    fn is_in_front(&self, triangle: u32, point: u32) -> bool {
        self.side(triangle, point) == Ordering::Greater
    }

    /// The tetrahedron of `a`, `b` and `c`, seen from outside, and `d` behind them.
    fn begin(&mut self, [a, b, c, d]: [u32; 4], waiting: &mut Vec<u32>) {
        let sides =
            [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])];
        for (vertices, neighbors) in sides {
            self.triangles.push(HullTriangle { vertices, neighbors, points: Vec::new(), is_gone: false });
        }
        let all: Vec<u32> = (0..self.points.len() as u32).collect();
        self.share_out(all, 0..4, waiting);
    }

    /// Gives each point to the first of some triangles that it is in front of; those behind all are inside. One in a
    /// plane of them may still be in front of another triangle, which waits then.
    fn share_out(&mut self, points: Vec<u32>, among: std::ops::Range<u32>, waiting: &mut Vec<u32>) {
        for point in points {
            let mut is_in_plane = false;
            let mut found = None;
            for triangle in among.clone() {
                match self.side(triangle, point) {
                    Ordering::Greater => {
                        found = Some(triangle);
                        break;
                    }
                    Ordering::Equal => is_in_plane = true,
                    Ordering::Less => {}
                }
            }
            if found.is_none() && is_in_plane {
                let mut others = 0..among.start;
                found = others
                    .find(|&other| !self.triangles[other as usize].is_gone && self.is_in_front(other, point));
                waiting.extend(found);
            }
            if let Some(triangle) = found {
                self.triangles[triangle as usize].points.push(point);
            }
        }
    }

    /// Replaces the triangles that the farthest point in front of one sees.
    fn grow(&mut self, number: u32, waiting: &mut Vec<u32>) {
        let HullTriangle { vertices, points, .. } = &self.triangles[number as usize];
        let [a, b, c] = vertices.map(|vertex| self.points[vertex as usize]);
        let normal = (b - a).cross(c - a);
        let distance = |&point: &u32| (self.points[point as usize] - a).dot(normal);
        let apex = points.iter().copied().max_by(|a, b| distance(a).total_cmp(&distance(b)).then(b.cmp(a)));
        let apex = apex.expect("it has points in front");
        let (visible, horizon) = self.visible_from(number, apex);
        let mut loose: Vec<u32> = Vec::new();
        for triangle in visible {
            let triangle = &mut self.triangles[triangle as usize];
            triangle.is_gone = true;
            loose.append(&mut triangle.points);
        }
        loose.retain(|&point| point != apex);
        let first = self.triangles.len() as u32;
        let mut starting: BTreeMap<u32, u32> = BTreeMap::new();
        for &[from, to, beyond] in &horizon {
            let new = self.triangles.len() as u32;
            starting.insert(from, new);
            let side = self.side_of(beyond, to);
            self.triangles[beyond as usize].neighbors[side] = new;
            let (vertices, neighbors) = ([from, to, apex], [beyond, 0, 0]);
            self.triangles.push(HullTriangle { vertices, neighbors, points: Vec::new(), is_gone: false });
        }
        for new in first..self.triangles.len() as u32 {
            let next = starting[&self.triangles[new as usize].vertices[1]];
            self.triangles[new as usize].neighbors[1] = next;
            self.triangles[next as usize].neighbors[2] = new;
        }
        let last = self.triangles.len() as u32;
        waiting.extend(first..last);
        self.share_out(loose, first..last, waiting);
    }

    /// The triangles that a point is in front of, from one of them on, and the sides where they end: from, to, and the
    /// triangle beyond.
    fn visible_from(&self, number: u32, point: u32) -> (Vec<u32>, Vec<[u32; 3]>) {
        let mut visible = vec![number];
        let mut is_visible: BTreeMap<u32, bool> = BTreeMap::from([(number, true)]);
        let mut horizon = Vec::new();
        let mut next = 0;
        while let Some(&here) = visible.get(next) {
            next += 1;
            for side in 0..3 {
                let HullTriangle { vertices, neighbors, .. } = &self.triangles[here as usize];
                let beyond = neighbors[side];
                let known = is_visible.get(&beyond).copied();
                let sees = known.unwrap_or_else(|| self.is_in_front(beyond, point));
                is_visible.insert(beyond, sees);
                if !sees {
                    horizon.push([vertices[side], vertices[(side + 1) % 3], beyond]);
                } else if known.is_none() {
                    visible.push(beyond);
                }
            }
        }
        (visible, horizon)
    }

    /// The side of a triangle that starts at a vertex.
    fn side_of(&self, triangle: u32, vertex: u32) -> usize {
        let vertices = self.triangles[triangle as usize].vertices;
        vertices.iter().position(|&other| other == vertex).expect("the horizon runs along it")
    }

    /// The triangles, with those in one plane as one polygon, and without vertices between two sides in a line.
    fn polygons(&self) -> Vec<Vec<u32>> {
        let mut planes = DisjointSets::new(self.triangles.len());
        let left = || (0..).zip(&self.triangles).filter(|(_, triangle)| !triangle.is_gone);
        for (number, triangle) in left() {
            for &neighbor in &triangle.neighbors {
                let corners = triangle.vertices.map(|vertex| self.points[vertex as usize]);
                let other = &self.triangles[neighbor as usize].vertices;
                let is_flat = |&vertex: &u32| {
                    side_of_triangle(corners, self.points[vertex as usize]) == Ordering::Equal
                };
                if other.iter().all(is_flat) {
                    planes.join(number, neighbor);
                }
            }
        }
        // For each plane, from each vertex of its border to the next.
        let mut borders: BTreeMap<u32, BTreeMap<u32, u32>> = BTreeMap::new();
        let mut counts = vec![0u32; self.points.len()];
        for (number, triangle) in left() {
            let plane = planes.root(number);
            for side in 0..3 {
                if planes.root(triangle.neighbors[side]) != plane {
                    let (from, to) = (triangle.vertices[side], triangle.vertices[(side + 1) % 3]);
                    borders.entry(plane).or_default().insert(from, to);
                    counts[from as usize] += 1;
                }
            }
        }
        let outline = |border: &BTreeMap<u32, u32>| {
            let start = *border.keys().next().expect("a border has sides");
            let around = std::iter::successors(Some(start), |here| {
                border.get(here).copied().filter(|&next| next != start)
            });
            // Where only two planes meet, their common edge runs straight on.
            around.take(border.len()).filter(|&vertex| counts[vertex as usize] > 2).collect()
        };
        borders.values().map(outline).collect()
    }
}
