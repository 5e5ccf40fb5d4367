//! The meshes of the table: faces that visit a vertex twice, spikes, doubled faces, and ordinary ones.

use trigon_math::Vec3;
use trigon_mesh::{Mesh, MeshBuilder, primitives};

/// A mesh of the table.
pub(super) struct Input {
    pub(super) name: &'static str,
    pub(super) mesh: Mesh,
    /// Whether it lies in the plane z = 0, so that what is cut anew has the same area.
    pub(super) is_flat: bool,
    /// Whether each edge is run along in both directions equally often.
    pub(super) is_closed: bool,
}

fn flat(name: &'static str, places: &[[f32; 2]], faces: &[&[u32]]) -> Input {
    let mut builder = MeshBuilder::new();
    for &[x, y] in places {
        builder.push_vertex(Vec3::new(x, y, 0.0));
    }
    for face in faces {
        builder.push_face(face).expect("three different vertices");
    }
    Input { name, mesh: builder.build(), is_flat: true, is_closed: false }
}

/// A square of edge 4 with a hole around its middle, a bridge from the first corner to the hole, and spikes.
const KEYHOLE: [[f32; 2]; 8] =
    [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]];

/// Faces that touch themselves, with the same area in every triangulation.
pub(super) fn touching() -> Vec<Input> {
    let (c, s) = (0.5, 0.866_025_4);
    let lobes = [[0.0, 0.0], [c, s], [-c, s], [-c, -s], [c, -s]];
    let mut split = lobes.to_vec();
    split.push([0.0, 0.0]);
    let corner = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [1., 2.], [2., 2.], [2., 1.]];
    let edge = [[0., 0.], [2., 0.], [4., 0.], [4., 4.], [0., 4.], [1., 2.], [2., 3.], [3., 2.]];
    let quads = [[0., 0.], [1., 0.], [1., 1.], [0., 1.], [3., 1.], [3., 4.], [1., 4.]];
    let three = [[0., 0.], [4., -2.], [4., 2.], [-1., 5.], [-4., 3.], [-4., -3.], [-1., -5.]];
    vec![
        flat("keyhole", &KEYHOLE, &[&[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]]),
        flat("two lobes", &lobes, &[&[0, 1, 2, 0, 3, 4]]),
        flat("two lobes at two vertices in one place", &split, &[&[0, 1, 2, 5, 3, 4]]),
        flat("three lobes", &three, &[&[0, 1, 2, 0, 3, 4, 0, 5, 6]]),
        flat("two quads", &quads, &[&[0, 1, 2, 4, 5, 6, 2, 3]]),
        flat("a hole at a corner", &corner, &[&[0, 1, 2, 3, 0, 4, 5, 6]]),
        flat("a hole at an edge", &edge, &[&[0, 1, 5, 6, 7, 1, 2, 3, 4]]),
        flat("a dart", &[[0., 0.], [2., 1.], [0., 2.], [0.5, 1.]], &[&[0, 1, 2, 3]]),
        flat("a spike", &KEYHOLE, &[&[0, 1, 2, 6, 2, 3]]),
        flat("a spike along a neighbour", &KEYHOLE, &[&[0, 1, 2, 6, 2, 3], &[4, 7, 6]]),
    ]
}

/// All inputs.
pub(super) fn all() -> Vec<Input> {
    let mut inputs = touching();
    let quad: [&[u32]; 2] = [&[0, 1, 2, 3], &[3, 2, 1, 0]];
    inputs.push(Input { is_closed: true, ..flat("both sides of a square", &KEYHOLE[..4], &quad) });
    inputs.push(flat("a face twice", &KEYHOLE[..4], &[&[0, 1, 2, 3], &[0, 1, 2, 3], &[1, 2, 3]]));
    inputs.push(flat("nothing but spikes", &KEYHOLE[..4], &[&[0, 1, 0, 2], &[0, 1, 2]]));
    inputs.push(flat("twice around", &KEYHOLE[..4], &[&[0, 1, 2, 0, 1, 2]]));
    let closed = [
        ("cube", primitives::cube(2.0)),
        ("torus", primitives::torus(2.0, 0.5, 6, 5)),
        ("icosphere", primitives::icosphere(1.0, 1)),
        ("cylinder", primitives::cylinder(1.0, 2.0, 7)),
    ];
    inputs.extend(closed.map(|(name, mesh)| Input { name, mesh, is_flat: false, is_closed: true }));
    let grid = primitives::grid(2.0, 3.0, 3, 3);
    inputs.push(Input { name: "grid", mesh: grid, is_flat: false, is_closed: false });
    inputs.push(Input { name: "drilled plate", mesh: drilled_plate(), is_flat: false, is_closed: true });
    inputs
}

/// A plate of 4 × 4 × 1 with a round hole of 16 sides, in triangles, as CAD programs export it: 128 of them.
pub(super) fn drilled_plate() -> Mesh {
    let mut builder = MeshBuilder::new();
    let around: Vec<[f32; 2]> = (0..16)
        .map(|i| {
            let angle = f64::from(i) / 16.0 * std::f64::consts::TAU;
            let (sin, cos) = trigon_math::elementary::sin_cos(angle);
            [cos as f32, sin as f32]
        })
        .collect();
    // The outline has a vertex beside each of the hole, on the sides of the square.
    for z in [0.0, 1.0] {
        for &[x, y] in &around {
            builder.push_vertex(Vec3::new(x, y, z));
        }
        for &[x, y] in &around {
            let scale = 2.0 / x.abs().max(y.abs());
            builder.push_vertex(Vec3::new(x * scale, y * scale, z));
        }
    }
    let mut quad = |[a, b, c, d]: [u32; 4]| {
        builder.push_face(&[a, b, c]).expect("a triangle");
        builder.push_face(&[a, c, d]).expect("a triangle");
    };
    for i in 0..16 {
        let j = (i + 1) % 16;
        quad([16 + i, i, j, 16 + j]);
        quad([32 + i, 48 + i, 48 + j, 32 + j]);
        quad([i, 32 + i, 32 + j, j]);
        quad([48 + i, 16 + i, 16 + j, 48 + j]);
    }
    builder.build()
}
