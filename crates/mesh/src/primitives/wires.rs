//! Wire objects: points and edges without faces.

use trigon_math::Vec3;

use super::circle::{on_ground, turned};
use super::solid::{MOST_PIECES, length};
use crate::{Mesh, MeshBuilder};

/// A line from one point to another.
#[must_use]
pub fn segment(from: Vec3, to: Vec3) -> Mesh {
    polyline(&[from, to])
}

/// Lines from each point to the next. A single point is kept as a point.
#[must_use]
pub fn polyline(points: &[Vec3]) -> Mesh {
    let mut builder = MeshBuilder::with_capacity(points.len(), 0, 0);
    let vertices: Vec<u32> = points.iter().map(|&point| builder.push_vertex(point)).collect();
    for ends in vertices.windows(2) {
        connect(&mut builder, ends[0], ends[1]);
    }
    if let [single] = vertices[..] {
        builder.push_loose_point(single).expect("the point was pushed just before");
    }
    builder.build()
}

/// A level circle of `segments` lines, 3 to 2048.
#[must_use]
pub fn ring(radius: f32, segments: u32) -> Mesh {
    let segments = segments.clamp(3, MOST_PIECES);
    let radius = f64::from(length(radius));
    let mut builder = MeshBuilder::with_capacity(segments as usize, 0, 0);
    for i in 0..segments {
        builder.push_vertex((on_ground(turned(i, segments)) * radius).as_vec3());
    }
    for i in 0..segments {
        connect(&mut builder, i, (i + 1) % segments);
    }
    builder.build()
}

fn connect(builder: &mut MeshBuilder, from: u32, to: u32) {
    builder.push_loose_edge(from, to).expect("both points were pushed, as different vertices");
}
