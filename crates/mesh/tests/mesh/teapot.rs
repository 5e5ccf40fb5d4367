//! The teapot against what is published about it.

use std::collections::BTreeMap;

use trigon_math::Vec3;
use trigon_mesh::Mesh;
use trigon_mesh::primitives::teapot;

fn has_vertex(mesh: &Mesh, at: Vec3) -> bool {
    mesh.positions().iter().any(|p| p.distance(at) < 1e-6)
}

#[test]
fn published_points_on_the_surface() {
    let pot = teapot(4);
    // The rim's inner edge, its outer foot, the widest row, the lid's edge and
    // tip, the bottom, the ends of handle and spout (published as x, y, z with
    // z up).
    for (x, y, z) in [
        (1.4, 0.0, 2.4),
        (0.0, -1.4, 2.4),
        (-1.5, 0.0, 2.4),
        (2.0, 0.0, 0.9),
        (1.3, 0.0, 2.4),
        (0.0, 0.0, 3.15),
        (0.0, 0.0, 0.0),
        (-1.6, 0.0, 2.025),
        (-3.0, 0.0, 1.8),
        (1.7, 0.0, 1.425),
        (3.3, 0.0, 2.4),
    ] {
        assert!(has_vertex(&pot, Vec3::new(x, z, -y)), "({x}, {y}, {z}) is a corner of a patch");
    }
}

#[test]
fn it_stands_on_the_table() {
    let bounds = teapot(8).bounds();
    assert_eq!(
        (bounds.min.y, bounds.max.y),
        (0.0, f64::from(3.15_f32)),
        "from the table to the tip of the lid"
    );
    assert_eq!((bounds.min.z, bounds.max.z), (-2.0, 2.0), "the belly's radius is 2");
    assert!(bounds.max.x > 3.4 && bounds.min.x < -2.9, "spout at +X, handle at -X: {bounds:?}");
}

#[test]
fn parts_have_no_cracks() {
    for n in [2, 3, 7] {
        let pot = teapot(n);
        assert_eq!(pot.face_count(), (32 * n * n) as usize, "faces of 32 patches");
        let mut borders: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let mut uses = vec![0; pot.edge_count()];
        for corner in 0..pot.corner_count() {
            uses[pot.corner_edge(corner).expect("no face repeats a vertex") as usize] += 1;
        }
        for (edge, &[a, b]) in pot.edges().iter().enumerate() {
            assert!(uses[edge] <= 2, "edge {edge} joins {} faces", uses[edge]);
            if uses[edge] == 1 {
                borders.entry(a).or_default().push(b);
                borders.entry(b).or_default().push(a);
            }
        }
        // The open edges of body and lid go round 4 patches, those of handle
        // and spout twice round 2.
        assert_eq!(borders.len(), (16 * n) as usize, "vertices on open edges, {n} pieces per patch");
        assert!(borders.values().all(|next| next.len() == 2), "open edges form loops");
        // 2 for each closed surface, less one for each opening: 1, 1, 0, 0.
        assert_eq!(pot.euler_characteristic(), 2, "a body, a lid and two tubes");
    }
}

#[test]
fn it_faces_outwards_with_its_exact_normals() {
    let pot = teapot(12);
    let faces = pot.face_normals();
    let normals = pot.shading_normals();
    for (face, corners) in pot.faces().enumerate() {
        for corner in corners {
            let normal = normals[corner];
            assert!((normal.length() - 1.0).abs() < 1e-6, "|{normal}| at corner {corner}");
            let side = normal.dot(faces[face]);
            // The lip of the spout is bent most: by a third of a right angle
            // and more within a face.
            assert!(side > 0.5, "corner {corner} of face {face} looks away: {side}");
            let position = pot.positions()[pot.corner_vertices()[corner] as usize];
            let belly =
                position.y > 0.3 && position.y < 1.9 && Vec3::new(position.x, 0.0, position.z).length() > 1.6;
            if belly && position.z.abs() > 0.7 {
                let outwards = normal.dot(Vec3::new(position.x, 0.0, position.z));
                assert!(outwards > 0.0, "the belly at {position} looks inwards");
            }
        }
    }
    let at = |height: f32| {
        let is_pole = |v: u32| pot.positions()[v as usize] == Vec3::new(0.0, height, 0.0);
        let corner = pot.corner_vertices().iter().position(|&v| is_pole(v));
        normals[corner.expect("a pole on the axis")]
    };
    assert_eq!((at(3.15), at(0.0)), (Vec3::Y, Vec3::NEG_Y), "the normals at both poles");
}
