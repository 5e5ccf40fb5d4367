//! Level rectangles, in one piece or in many, and wire objects: points and edges without faces.

use trigon_math::{DVec2, DVec3, Vec2, Vec3};

use super::round::{on_ground, turned};
use super::solid::{MOST_PIECES, SQUARE, Solid, length};
use crate::{Mesh, MeshBuilder};

/// A level rectangle that faces up: `width` metres along X, `depth` metres
/// along Z. One quad with the whole image, whose top is at −Z.
#[must_use]
pub fn plane(width: f32, depth: f32) -> Mesh {
    let mut solid = Solid::with_capacity(4, 1, 4);
    let half = DVec2::new(f64::from(length(width)), f64::from(length(depth))) / 2.0;
    for uv in SQUARE {
        let [u, v] = [uv.x, uv.y].map(|t| 2.0 * f64::from(t) - 1.0);
        solid.vertex(DVec3::new(u * half.x, 0.0, v * half.y).as_vec3());
    }
    solid.face(&[0, 1, 2, 3], &SQUARE);
    solid.build()
}

/// The rectangle of [`plane`] as `columns` by `rows` quads, 1 to 2048 each,
/// with the image over all of it. Vertices and faces are numbered row by row
/// from −Z, each row from −X.
#[must_use]
pub fn grid(width: f32, depth: f32, columns: u32, rows: u32) -> Mesh {
    let [columns, rows] = [columns, rows].map(|count| count.clamp(1, MOST_PIECES));
    let size = DVec2::new(f64::from(length(width)), f64::from(length(depth)));
    let (vertices, faces) = ((columns + 1) * (rows + 1), columns * rows);
    let mut solid = Solid::with_capacity(vertices as usize, faces as usize, 4 * faces as usize);
    let uv = |column, row| {
        let u = f64::from(column) / f64::from(columns);
        DVec2::new(u, f64::from(row) / f64::from(rows))
    };
    for row in 0..=rows {
        for column in 0..=columns {
            let position = (uv(column, row) - 0.5) * size;
            solid.vertex(DVec3::new(position.x, 0.0, position.y).as_vec3());
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let corners = [(column, row + 1), (column + 1, row + 1), (column + 1, row), (column, row)];
            let uvs: [Vec2; 4] = corners.map(|(c, r)| uv(c, r).as_vec2());
            solid.face(&corners.map(|(c, r)| r * (columns + 1) + c), &uvs);
        }
    }
    solid.build()
}

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
