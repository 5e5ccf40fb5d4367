//! Values of corners while triangles are reduced: corners at a vertex between two features share them.
//!
//! H. Hoppe, "New Quadric Metric for Simplifying Meshes with Appearance Attributes", 1999, calls such corners a wedge.
//! Texture coordinates and colours are linear functions on each triangle; how far they are off adds to the error. Values
//! themselves are interpolated along collapsed edges.

use fixedbitset::FixedBitSet;
use trigon_math::{DVec3, DisjointSets, Vec2, Vec4};

use super::quadric::Quadric;
use super::surface::{Freedom, Merge, ReducedTriangle, Surface};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, NONE};
use crate::layers::{LayerKind, LayerValues};

/// A texture that is shifted on the surface by a length is as bad as a surface that is shifted by this part of it.
const TEXTURE: f64 = 0.1;

/// Black that becomes white is as bad as a surface that is shifted by this part of its extent.
const COLOR: f64 = 0.02;

/// How many texture coordinates and channels there are.
const MOST: usize = 6;

/// The sums of the gradients and constants of one value, each weighted by area.
#[derive(Debug, Clone, Copy, Default)]
struct LinearSum {
    gradient: DVec3,
    constant: f64,
}

#[derive(Debug, Default)]
pub(super) struct Wedges {
    /// The wedge of each corner of each triangle, named by one of its corners in the mesh. Empty if no corner has values.
    pub(super) of: Vec<[u32; 3]>,
    /// Those whose corners have different normals, by corner in the mesh.
    pub(super) has_split_normals: FixedBitSet,
    pub(super) merges: Vec<Merge>,
    /// How many values add to the error.
    count: usize,
    /// For each vertex the sums of all these values.
    sums: Vec<LinearSum>,
    /// For each vertex the sum of areas; 0 for one with several wedges, whose values have no single error.
    areas: Vec<f64>,
}

impl EditMesh {
    /// Whether two corners have the same texture coordinates and colours, to the bit.
    pub(super) fn has_same_values(&self, a: CornerId, b: CornerId) -> bool {
        self.corner_layers.iter().filter(|layer| !layer.kind.is_direction()).all(|layer| {
            match &layer.values {
                LayerValues::Vec2(column) => same(column[a.0].to_array(), column[b.0].to_array()),
                LayerValues::Vec3(column) => same(column[a.0].to_array(), column[b.0].to_array()),
                LayerValues::Vec4(column) => same(column[a.0].to_array(), column[b.0].to_array()),
                LayerValues::Influences(_) | LayerValues::Pins(_) | LayerValues::Weights(_) => true,
            }
        })
    }
}

fn same<const N: usize>(a: [f32; N], b: [f32; N]) -> bool {
    a.map(f32::to_bits) == b.map(f32::to_bits)
}

impl Wedges {
    pub(super) fn of(mesh: &EditMesh, surface: &mut Surface) -> Self {
        if mesh.corner_layers.is_empty() {
            return Self::default();
        }
        let mut wedges = Self { of: groups(mesh, surface), ..Self::default() };
        if mesh.corner_layers.iter().any(|layer| layer.kind == LayerKind::Normal) {
            wedges.find_split_normals(mesh, surface);
        }
        wedges.sum_values(mesh, surface);
        wedges
    }

    fn find_split_normals(&mut self, mesh: &EditMesh, surface: &Surface) {
        self.has_split_normals.grow(mesh.corner_capacity());
        for (triangle, wedges) in surface.triangles.iter().zip(&self.of) {
            for (corner, &wedge) in surface.corners(mesh, triangle.face).iter().zip(wedges) {
                if mesh.custom_normal(*corner) != mesh.custom_normal(CornerId(wedge)) {
                    self.has_split_normals.insert(wedge as usize);
                }
            }
        }
    }

    /// Adds up the linear functions of all triangles at each vertex that has one wedge, and adds their squares to the
    /// quadrics there.
    fn sum_values(&mut self, mesh: &EditMesh, surface: &mut Surface) {
        let values = Values::of(mesh, surface);
        self.count = values.count;
        if self.count == 0 {
            return;
        }
        self.sums = vec![LinearSum::default(); self.count * surface.points.len()];
        self.areas = vec![0.0; surface.points.len()];
        let mut quadrics = std::mem::take(&mut surface.quadrics);
        for triangle in &surface.triangles {
            let corners = surface.corners(mesh, triangle.face).map(|corner| values.at(mesh, corner));
            let Some(frame) = TrianglePlane::of(surface, triangle) else { continue };
            let vertices = triangle.vertices.into_iter().map(|vertex| vertex as usize);
            for vertex in vertices.filter(|&vertex| surface.freedoms[vertex] == Freedom::Free) {
                self.areas[vertex] += frame.area;
                let sums = &mut self.sums[vertex * self.count..][..self.count];
                for (value, sum) in sums.iter_mut().enumerate() {
                    let (gradient, constant) = frame.linear(corners.map(|values| values[value]));
                    sum.gradient += gradient * frame.area;
                    sum.constant += constant * frame.area;
                    quadrics[vertex] += Quadric::square_of(gradient, constant, frame.area);
                }
            }
        }
        surface.quadrics = quadrics;
    }

    /// Takes off the error of the values of two vertices what the best values for each position save.
    pub(super) fn add_error(&self, [a, b]: [u32; 2], quadric: &mut Quadric) {
        if self.count == 0 {
            return;
        }
        let area = self.areas[a as usize] + self.areas[b as usize];
        if area <= 0.0 {
            return;
        }
        for value in 0..self.count {
            let [one, two] = [a, b].map(|vertex| self.sums[vertex as usize * self.count + value]);
            let (gradient, constant) = (one.gradient + two.gradient, one.constant + two.constant);
            *quadric += Quadric::square_of(gradient, constant, -1.0 / area);
        }
    }

    /// Lets one vertex stand for two.
    pub(super) fn merge_vertices(&mut self, retained: u32, gone: u32) {
        if self.count == 0 {
            return;
        }
        self.areas[retained as usize] += self.areas[gone as usize];
        for value in 0..self.count {
            let other = self.sums[gone as usize * self.count + value];
            let sum = &mut self.sums[retained as usize * self.count + value];
            sum.gradient += other.gradient;
            sum.constant += other.constant;
        }
    }
}

/// The wedges of all corners of triangles, each named by one of its corners in the mesh.
fn groups(mesh: &EditMesh, surface: &Surface) -> Vec<[u32; 3]> {
    let mut numbers = vec![NONE; mesh.corner_capacity()];
    let corners: Vec<[CornerId; 3]> =
        surface.triangles.iter().map(|triangle| surface.corners(mesh, triangle.face)).collect();
    for (number, corner) in (0..).zip(corners.as_flattened()) {
        numbers[corner.0 as usize] = number;
    }
    let mut sets = DisjointSets::new(3 * corners.len());
    for (triangle, corners) in surface.triangles.iter().zip(&corners) {
        for (side, &corner) in corners.iter().enumerate() {
            let other = mesh.radial_next(corner);
            if triangle.features[side] == NONE && numbers[other.0 as usize] != NONE {
                let number = |corner: CornerId| numbers[corner.0 as usize];
                sets.join(number(corner), number(mesh.next_corner(other)));
                sets.join(number(mesh.next_corner(corner)), number(other));
            }
        }
    }
    let all = corners.as_flattened();
    let mut wedges = vec![[0; 3]; corners.len()];
    for (number, wedge) in (0..).zip(wedges.as_flattened_mut()) {
        *wedge = all[sets.root(number) as usize].0;
    }
    wedges
}

/// The plane of a triangle, for linear functions in it.
struct TrianglePlane {
    points: [DVec3; 3],
    /// Gradients of the functions that are 1 at one corner and 0 at the others.
    gradients: [DVec3; 3],
    area: f64,
}

impl TrianglePlane {
    fn of(surface: &Surface, triangle: &ReducedTriangle) -> Option<Self> {
        let points = triangle.vertices.map(|vertex| surface.points[vertex as usize]);
        let cross = (points[1] - points[0]).cross(points[2] - points[0]);
        let squared = cross.length_squared();
        let gradient = |i: usize| cross.cross(points[(i + 2) % 3] - points[(i + 1) % 3]) / squared;
        let gradients = [gradient(0), gradient(1), gradient(2)];
        let is_usable = gradients.iter().all(|gradient| gradient.is_finite());
        is_usable.then(|| Self { points, gradients, area: cross.length() / 2.0 })
    }

    /// The gradient and the constant of the linear function with these values at the corners.
    fn linear(&self, values: [f64; 3]) -> (DVec3, f64) {
        let gradient =
            self.gradients[0] * values[0] + self.gradients[1] * values[1] + self.gradients[2] * values[2];
        (gradient, values[0] - gradient.dot(self.points[0]))
    }
}

/// The values that add to the error: the first set of texture coordinates and colours, as lengths.
struct Values {
    count: usize,
    texture: f64,
    color: f64,
}

impl Values {
    fn of(mesh: &EditMesh, surface: &Surface) -> Self {
        let (mut area, mut of_image) = (0.0, 0.0);
        for triangle in &surface.triangles {
            let [a, b, c] = triangle.vertices.map(|vertex| surface.points[vertex as usize]);
            let corners = surface.corners(mesh, triangle.face);
            let [u, v, w] = corners.map(|corner| mesh.uv(0, corner).unwrap_or(Vec2::ZERO).as_dvec2());
            let (image, solid) = ((v - u).perp_dot(w - u).abs(), (b - a).cross(c - a).length());
            if image.is_finite() && solid.is_finite() {
                area += solid;
                of_image += image;
            }
        }
        let extent = 2.0
            * surface.points.iter().fold(0.0, |most: f64, point| {
                let length = point.length();
                if length > most { length } else { most }
            });
        let texture = if of_image > 0.0 { TEXTURE * (area / of_image).sqrt() } else { 0.0 };
        let has_colors = mesh.corner_layers.iter().any(|layer| layer.kind == LayerKind::Color);
        let color = if has_colors { COLOR * extent } else { 0.0 };
        let count = if color > 0.0 {
            MOST
        } else if texture > 0.0 {
            2
        } else {
            0
        };
        Self { count, texture, color }
    }

    fn at(&self, mesh: &EditMesh, corner: CornerId) -> [f64; MOST] {
        let uv = mesh.uv(0, corner).unwrap_or(Vec2::ZERO).as_dvec2() * self.texture;
        let color = mesh.color(corner).unwrap_or(Vec4::ZERO).as_dvec4() * self.color;
        let values = [uv.x, uv.y, color.x, color.y, color.z, color.w];
        values.map(|value| if value.is_finite() { value } else { 0.0 })
    }
}
