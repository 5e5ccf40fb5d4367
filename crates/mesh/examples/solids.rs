//! Prints the standard objects with their vertices, edges and faces, and what
//! Euler's polyhedron formula makes of them.

#![expect(clippy::print_stdout, reason = "what it prints is what it is for")]

use trigon_mesh::{Mesh, RenderMesh, primitives};

fn main() {
    let solids: [(&str, Mesh); 16] = [
        ("cube", primitives::cube(1.0)),
        ("tetrahedron", primitives::tetrahedron(1.0)),
        ("octahedron", primitives::octahedron(1.0)),
        ("dodecahedron", primitives::dodecahedron(1.0)),
        ("icosahedron", primitives::icosahedron(1.0)),
        ("pyramid", primitives::pyramid(1.0, 1.0)),
        ("plane", primitives::plane(1.0, 1.0)),
        ("grid", primitives::grid(1.0, 1.0, 8, 8)),
        ("disc", primitives::disc(0.5, 32)),
        ("uv_sphere", primitives::uv_sphere(0.5, 32, 16)),
        ("icosphere", primitives::icosphere(0.5, 3)),
        ("cylinder", primitives::cylinder(0.5, 1.0, 32)),
        ("cone", primitives::cone(0.5, 1.0, 32)),
        ("torus", primitives::torus(0.5, 0.2, 32, 16)),
        ("torus_knot", primitives::torus_knot(&primitives::TorusKnot::default())),
        ("teapot", primitives::teapot(8)),
    ];
    println!("{:<13}{:>7}{:>7}{:>7}{:>7}{:>9}{:>7}", "object", "V", "E", "F", "V-E+F", "closed", "drawn");
    for (name, mesh) in solids {
        println!(
            "{name:<13}{:>7}{:>7}{:>7}{:>7}{:>9}{:>7}",
            mesh.vertex_count(),
            mesh.edge_count(),
            mesh.face_count(),
            mesh.euler_characteristic(),
            if mesh.is_closed() { "yes" } else { "no" },
            RenderMesh::from_mesh(&mesh).triangles.len(),
        );
    }
}
