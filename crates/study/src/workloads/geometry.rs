//! The meshes, each generated from a formula.
//!
//! Positions and normals are columns (structure of arrays), the layout that a vectorized vertex stage reads.

use trigon_math::{DVec3, Vec3, elementary};

use super::pipelines;
use std::f64::consts::TAU;

/// Indexed triangles; counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The x, y and z of the vertices.
    pub positions: [Vec<f32>; 3],
    /// The x, y and z of the vertices' unit normals; empty where no shading
    /// asks for them.
    pub normals: [Vec<f32>; 3],
    /// Texture coordinates of the vertices; empty likewise.
    pub coordinates: [Vec<f32>; 2],
    /// Colours of the triangles, RGBA; empty likewise.
    pub colors: Vec<[u8; 4]>,
    /// Indices of vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// How finely a tube is divided: quads in either direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Quads along the tube.
    pub along: u32,
    /// Quads around it.
    pub around: u32,
}

impl Mesh {
    /// How many vertices there are.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions[0].len()
    }

    /// Adds a vertex and returns its index.
    fn push_vertex(&mut self, position: Vec3) -> u32 {
        push(&mut self.positions, position.to_array());
        self.vertex_count() as u32 - 1
    }

    fn push_normal(&mut self, normal: Vec3) {
        push(&mut self.normals, normal.to_array());
    }

    /// Adds a quad with corners of its own and one colour.
    fn push_quad(&mut self, corners: [Vec3; 4], color: [u8; 4]) {
        let [a, b, c, d] = corners.map(|corner| self.push_vertex(corner));
        self.triangles.extend([[a, b, c], [a, c, d]]);
        self.colors.extend([color; 2]);
    }

    /// Adds the triangles of a grid of quads; `corner` gives the vertex at a
    /// place along and around.
    fn push_grid(&mut self, grid: Grid, corner: impl Fn(u32, u32) -> u32) {
        for i in 0..grid.along {
            for j in 0..grid.around {
                let [a, b] = [corner(i, j), corner(i + 1, j)];
                let [c, d] = [corner(i + 1, j + 1), corner(i, j + 1)];
                self.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
}

fn push<const N: usize>(columns: &mut [Vec<f32>; N], values: [f32; N]) {
    for (column, value) in columns.iter_mut().zip(values) {
        column.push(value);
    }
}

/// One triangle without area, beyond the edge of the screen, in clip space.
pub(super) fn off_screen() -> Mesh {
    let mut mesh = Mesh::default();
    let corner = mesh.push_vertex(Vec3::new(5.0, 5.0, 0.5));
    mesh.triangles.push([corner; 3]);
    mesh.colors.push([0; 4]);
    mesh
}

/// Quads over the whole screen, in clip space with w = 1; `places` counts from
/// the eye, in the order of drawing.
pub(super) fn layers(slots: impl ExactSizeIterator<Item = u32>) -> Mesh {
    let mut mesh = Mesh::default();
    let count = slots.len() as u32;
    for (i, spot) in (0..count).zip(slots) {
        let depth = 1.0 - (spot + 1) as f32 / (count + 1) as f32;
        let corner = |x, y| Vec3::new(x, y, depth);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        mesh.push_quad(corners, [i * 3, 255 - i * 2, i * 37 % 256, 255].map(|channel| channel as u8));
    }
    mesh
}

/// A torus of radius 1 about the y axis, its tube of radius 0.4, with vertices
/// shared all round.
pub(super) fn torus(grid: Grid) -> Mesh {
    const TUBE: f64 = 0.4;
    let mut mesh = Mesh::default();
    for i in 0..grid.along {
        let (s, c) = elementary::sin_cos(-turn(i, grid.along));
        let outwards = DVec3::new(c, 0.0, s);
        for j in 0..grid.around {
            let (s, c) = elementary::sin_cos(turn(j, grid.around));
            let normal = outwards * c + DVec3::Y * s;
            mesh.push_vertex((outwards + TUBE * normal).as_vec3());
            mesh.push_normal(normal.as_vec3());
        }
    }
    mesh.push_grid(grid, |i, j| i % grid.along * grid.around + j % grid.around);
    mesh
}

/// A (2, 3) torus knot, its tube of radius 0.28: 70,000 triangles. The texture
/// goes round the tube once and along it twelve times; vertices on the seam are
/// there twice.
pub(super) fn knot() -> Mesh {
    const TUBE: f64 = 0.28;
    const TEXTURES_ALONG: f32 = 12.0;
    const GRID: Grid = Grid { along: 700, around: 50 };
    let mut mesh = Mesh::default();
    for i in 0..=GRID.along {
        let KnotPoint { center, side, up } = KnotPoint::at(turn(i % GRID.along, GRID.along));
        for j in 0..=GRID.around {
            let (s, c) = elementary::sin_cos(-turn(j % GRID.around, GRID.around));
            let normal = side * c + up * s;
            mesh.push_vertex((center + TUBE * normal).as_vec3());
            mesh.push_normal(normal.as_vec3());
            let u = TEXTURES_ALONG * i as f32 / GRID.along as f32;
            push(&mut mesh.coordinates, [u, j as f32 / GRID.around as f32]);
        }
    }
    mesh.push_grid(GRID, |i, j| i * (GRID.around + 1) + j);
    mesh
}

/// A place on the knot's centre line, and two unit vectors across the tube.
struct KnotPoint {
    center: DVec3,
    side: DVec3,
    up: DVec3,
}

impl KnotPoint {
    fn at(t: f64) -> Self {
        let (s2, c2) = elementary::sin_cos(2.0 * t);
        let (s3, c3) = elementary::sin_cos(3.0 * t);
        let radius = 1.0 + 0.5 * c3;
        let center = DVec3::new(radius * c2, radius * s2, 0.5 * s3);
        // The derivative of the centre by t.
        let ahead =
            DVec3::new(-1.5 * s3 * c2 - 2.0 * radius * s2, -1.5 * s3 * s2 + 2.0 * radius * c2, 1.5 * c3);
        let ahead = ahead.normalize();
        let up = ahead.cross(center).normalize();
        Self { center, side: up.cross(ahead), up }
    }
}

/// 25 by 20 by 20 cubes of edge 0.6, one unit apart, in an order that leaps
/// about. Each side has one colour, lit beforehand.
pub(super) fn cubes() -> Mesh {
    const COUNT: u32 = 10_000;
    // A prime: the leaps visit every cube.
    const LEAP: u32 = 7919;
    let mut mesh = Mesh::default();
    for k in (0..COUNT).map(|i| i * LEAP % COUNT) {
        let cell = Vec3::new((k % 25) as f32, (k / 25 % 20) as f32, (k / 500) as f32);
        let color = [53, 97, 31].map(|step| (80 + k * step % 176) as f32);
        push_cube(&mut mesh, cell - Vec3::new(12.0, 9.5, 9.5), color.into());
    }
    mesh
}

fn push_cube(mesh: &mut Mesh, center: Vec3, color: Vec3) {
    const HALF_EDGE: f32 = 0.3;
    for axis in 0..3 {
        let [first, second] = [1, 2].map(|step| Vec3::AXES[(axis + step) % 3]);
        for normal in [-Vec3::AXES[axis], Vec3::AXES[axis]] {
            // Turned over with the side, so that it winds counter-clockwise.
            let turned = if normal[axis] > 0.0 { [first, second] } else { [second, first] };
            let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let corner = |[p, q]: [f32; 2]| center + HALF_EDGE * (normal + turned[0] * p + turned[1] * q);
            let [r, g, b] = (color * pipelines::lambert(normal, 0.2)).to_array();
            mesh.push_quad(signs.map(corner), [r as u8, g as u8, b as u8, 255]);
        }
    }
}

/// The angle in radians of step `index` of `count` in a full turn.
fn turn(index: u32, count: u32) -> f64 {
    f64::from(index) / f64::from(count) * TAU
}
