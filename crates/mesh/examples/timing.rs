//! Measures what happens to a million triangles between a file and a renderer.

#![expect(clippy::print_stdout, reason = "what it prints is what it is for")]

use std::f64::consts::TAU;
use std::time::Instant;

use trigon_math::{DVec3, Vec3, elementary};
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
    timed("  its face normals", || mesh.face_normals());
    timed("  its flat normals", || mesh.shading_normals());
    let flat = timed("  its render mesh, flat", || RenderMesh::from_mesh(&mesh));
    let faces = mesh.face_count();
    let attributes = Attributes { face_smooth: Some(vec![true; faces]), ..Attributes::default() };
    mesh.set_attributes(attributes).expect("one flag per face");
    timed("  its smooth normals", || mesh.shading_normals());
    let smooth = timed("  its render mesh, smooth", || RenderMesh::from_mesh(&mesh));
    println!("  vertices: {} flat, {} smooth", flat.positions.len(), smooth.positions.len());
    timed("  smooth by angle", || mesh.smooth_by_angle(0.5));
    timed("a star of 20 000 corners", || triangulate_polygon(&star(1)));
    timed("a star of 20 000 corners on 2000 sides", || triangulate_polygon(&star(10)));
    timed("a comb of 20 000 corners", || triangulate_polygon(&comb()));
}

/// A star of 20 000 corners with so many on each side.
fn star(per_side: usize) -> Vec<Vec3> {
    let sides = 20_000 / per_side;
    let tip = |i: usize| {
        let (sin, cos) = elementary::sin_cos(TAU * (i % sides) as f64 / sides as f64);
        DVec3::new(cos, sin, 0.0) * if i.is_multiple_of(2) { 1000.0 } else { 400.0 }
    };
    let on_side =
        |i: usize| tip(i / per_side).lerp(tip(i / per_side + 1), (i % per_side) as f64 / per_side as f64);
    (0..20_000).map(|i| on_side(i).as_vec3()).collect()
}

/// Long thin teeth: every box is as wide as the polygon.
fn comb() -> Vec<Vec3> {
    let teeth = (0..9_999).flat_map(|i| [(1000.0, 2.0 * i as f32), (0.0, 2.0 * i as f32 + 1.0)]);
    let back = [(-1.0, 20_000.0), (-1.0, -1.0)];
    teeth.chain(back).map(|(x, y)| Vec3::new(x, y, 0.0)).collect()
}
