//! Where the manifest's triangles lie.

use crate::programs::Vertices;
use crate::random::Random;
use trigon_math::{Mat4, Vec3, Vec4, elementary};
use trigon_math::{look_at_mat4, perspective_infinite_reverse};

/// What an image shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// A ring in perspective, near and far sides over each other.
    Ring,
    /// The ground from under the eye to the horizon.
    Ground,
    /// Anywhere around the view, with w of either sign.
    Scattered,
    /// Corners far beyond the guard band.
    Huge,
    /// Needles around a point.
    Needles,
}

impl Layout {
    /// The vertices and the triangles between them.
    pub(super) fn build(self) -> (Vertices, Vec<[u32; 3]>) {
        match self {
            Self::Ring => ring(),
            Self::Ground => ground(),
            Self::Scattered => scattered(),
            Self::Huge => huge(),
            Self::Needles => needles(),
        }
    }
}

fn camera(eye: Vec3, target: Vec3) -> Mat4 {
    perspective_infinite_reverse(0.9, 1.5, 0.1) * look_at_mat4(eye, target, Vec3::Y)
}

/// Sine and cosine of parts of a turn.
fn turn(part: f32) -> (f32, f32) {
    let (sine, cosine) = elementary::sin_cos(f64::from(part) * std::f64::consts::TAU);
    (sine as f32, cosine as f32)
}

/// A grid of so many cells, its vertices given by their places in 0 to 1.
fn grid(cells: [u32; 2], vertex: impl Fn(f32, f32) -> (Vec4, Vec4)) -> (Vertices, Vec<[u32; 3]>) {
    let mut vertices = Vertices::default();
    for j in 0..=cells[1] {
        for i in 0..=cells[0] {
            let (position, color) = vertex(i as f32 / cells[0] as f32, j as f32 / cells[1] as f32);
            vertices.push(position, color);
        }
    }
    let corners = (0..cells[1]).flat_map(|j| (0..cells[0]).map(move |i| j * (cells[0] + 1) + i));
    let below = cells[0] + 1;
    let triangles = corners.flat_map(|a| [[a, a + 1, a + 1 + below], [a, a + 1 + below, a + below]]);
    (vertices, triangles.collect())
}

fn ring() -> (Vertices, Vec<[u32; 3]>) {
    let view = camera(Vec3::new(0.6, 1.4, 2.2), Vec3::ZERO);
    grid([24, 12], |u, v| {
        let ((around, along), (out, up)) = (turn(u), turn(v));
        let radius = 1.0 + 0.45 * out;
        let position = Vec3::new(radius * along, 0.45 * up, radius * around);
        (view * position.extend(1.0), Vec4::new(u, v, 0.5 + 0.5 * up, 0.3 + 0.6 * v))
    })
}

fn ground() -> (Vertices, Vec<[u32; 3]>) {
    let view = camera(Vec3::new(0.0, 0.3, 0.0), Vec3::new(0.3, 0.1, -1.0));
    grid([3, 3], |u, v| {
        let place = Vec3::new(u * 600.0 - 300.0, 0.0, v * 600.0 - 300.0);
        (view * place.extend(1.0), Vec4::new(u * 60.0, v * 60.0, 0.4, 0.7))
    })
}

/// A number in -1 to 1.
fn signed(random: &mut Random) -> f32 {
    random.within(1 << 20) as f32 / (1 << 20) as f32
}

fn color(random: &mut Random) -> Vec4 {
    let channel = |random: &mut Random| 0.5 + 0.5 * signed(random);
    Vec4::new(channel(random), channel(random), channel(random), 0.2 + 0.8 * channel(random))
}

/// Triangles of three vertices each.
fn separate(count: u32, mut position: impl FnMut(&mut Random) -> Vec4) -> (Vertices, Vec<[u32; 3]>) {
    let mut random = Random(u64::from(count));
    let mut vertices = Vertices::default();
    for _ in 0..3 * count {
        let position = position(&mut random);
        vertices.push(position, color(&mut random));
    }
    (vertices, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
}

fn scattered() -> (Vertices, Vec<[u32; 3]>) {
    separate(60, |random| {
        let w = 1.2 + 1.5 * signed(random);
        Vec4::new(1.6 * signed(random) * w, 1.6 * signed(random) * w, 0.5 + 0.6 * signed(random), w)
    })
}

fn huge() -> (Vertices, Vec<[u32; 3]>) {
    separate(20, |random| {
        let far = 1e3 * (1.0 + signed(random)) * (1.0 + signed(random));
        Vec4::new(far * signed(random), far * signed(random), 0.5 + 0.5 * signed(random), 1.0)
    })
}

fn needles() -> (Vertices, Vec<[u32; 3]>) {
    let count = 300;
    let mut vertices = Vertices::default();
    let mut random = Random(3);
    vertices.push(Vec4::new(0.11, -0.07, 0.9, 1.0), Vec4::new(1.0, 1.0, 1.0, 0.9));
    for i in 0..count {
        let (sine, cosine) = turn(i as f32 / count as f32);
        let reach = 1.2 + signed(&mut random);
        vertices.push(Vec4::new(reach * cosine, reach * sine, 0.1, 1.0), color(&mut random));
    }
    (vertices, (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect())
}
