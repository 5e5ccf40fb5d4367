//! Measures what happens to a million triangles between a file and a renderer.

use std::time::Instant;

use trigon_math::Vec3;
use trigon_mesh::{Attributes, Mesh, MeshBuilder, RenderMesh, primitives, triangulate_polygon};

fn timed<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    println!("{what:<44}{:>9.1} ms", start.elapsed().as_secs_f64() * 1e3);
    result
}

/// A sphere's quads as triangles, so that there are a million faces.
fn million() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let sphere = primitives::uv_sphere(1.0, 1000, 500);
    let corners = sphere.corner_vertices();
    let triangles = sphere.triangulation().triangles;
    (sphere.positions().to_vec(), triangles.iter().map(|t| t.map(|c| corners[c as usize])).collect())
}

fn build(positions: &[Vec3], triangles: &[[u32; 3]]) -> Mesh {
    let mut builder = MeshBuilder::with_capacity(positions.len(), triangles.len(), 3 * triangles.len());
    for &position in positions {
        builder.push_vertex(position);
    }
    for triangle in triangles {
        builder.push_face(triangle).expect("a triangle of the sphere");
    }
    timed("  of it: finding the edges", || builder.build())
}

fn main() {
    let sphere = timed("sphere of 500 000 quads, with its edges", || primitives::uv_sphere(1.0, 1000, 500));
    timed("  its render mesh (normals, uvs given)", || RenderMesh::from_mesh(&sphere));
    let (positions, triangles) = million();
    let mut mesh = timed("mesh of a million triangles", || build(&positions, &triangles));
    timed("  its triangulation", || mesh.triangulation());
    let flat = timed("  its render mesh, flat", || RenderMesh::from_mesh(&mesh));
    let faces = mesh.face_count();
    let attributes = Attributes { face_smooth: Some(vec![true; faces]), ..Attributes::default() };
    mesh.set_attributes(attributes).expect("one flag per face");
    let smooth = timed("  its render mesh, smooth", || RenderMesh::from_mesh(&mesh));
    println!("  vertices: {} flat, {} smooth", flat.positions.len(), smooth.positions.len());
    timed("  smooth by angle", || mesh.smooth_by_angle(0.5));
    let star: Vec<Vec3> = primitives::disc(1000.0, 2048)
        .positions()
        .iter()
        .enumerate()
        .map(|(i, &p)| if i % 2 == 0 { p } else { p * 0.4 })
        .collect();
    timed("a star of 2048 corners", || triangulate_polygon(&star));
}
