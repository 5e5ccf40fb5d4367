//! Pins, against similarities of flat charts, energies by singular values, and bits.

use proptest::prelude::*;
use trigon_math::{DMat3, DVec2, DVec3, Orientation, SplitMix64, Vec2, orientation};
use trigon_mesh::primitives;

use super::tests::{UvTriangle, all_triangles, common_area, grid, stretch};
use super::*;
use crate::ids::{CornerId, VertexId};
use crate::tests::check_operation;

fn editable(mesh: &trigon_mesh::Mesh) -> EditMesh {
    let (mut mesh, _) = EditMesh::from_mesh(mesh);
    mesh.add_uv_set(0).expect("room");
    mesh
}

fn faces(mesh: &EditMesh) -> Vec<FaceId> {
    mesh.faces().collect()
}

/// Pins all corners of a vertex at texture coordinates.
fn pin(mesh: &mut EditMesh, vertex: u32, uv: Vec2) {
    let corners: Vec<CornerId> = mesh.vertex_corners(VertexId(vertex)).collect();
    corners.iter().for_each(|&corner| mesh.set_uv(0, corner, uv));
    mesh.pin_uvs(0, &corners).expect("they exist");
}

/// By corner: the bits of its coordinates.
fn bits(mesh: &EditMesh, corners: impl Iterator<Item = CornerId>) -> Vec<[u32; 2]> {
    let uv = |corner| mesh.uv(0, corner).expect("the set exists");
    corners.map(|corner| uv(corner).to_array().map(f32::to_bits)).collect()
}

fn pinned(mesh: &EditMesh) -> Vec<CornerId> {
    mesh.corners().filter(|&corner| mesh.is_uv_pinned(0, corner)).collect()
}

fn settings(minimize_stretch: u32) -> UnwrapSettings {
    UnwrapSettings { minimize_stretch, ..UnwrapSettings::default() }
}

/// The conformal energy by singular values: half of their squared differences, over the surface.
fn conformal_energy(triangles: &[UvTriangle]) -> f64 {
    let of = |triangle: &UvTriangle| {
        let ([a, b, c], [p, q, r]) = (triangle.uv, triangle.surface);
        let (along, to) = (q - p, r - p);
        let right = along.normalize();
        let x = to.dot(right);
        let height = (to - right * x).length();
        // The columns of the Jacobian from the surface to the texture coordinates.
        let first = (b - a) / along.length();
        let second = (c - a - first * x) / height;
        let sum = first.length_squared() + second.length_squared();
        (sum - 2.0 * first.perp_dot(second)) * along.length() * height / 4.0
    };
    triangles.iter().map(of).sum()
}

fn mountains(columns: u32, rows: u32, random: &mut SplitMix64, height: f64) -> EditMesh {
    let mesh = grid(columns, rows, |at| {
        let [x, y] = [(); 2].map(|()| random.between(-0.05, 0.05));
        DVec3::new(at.x + x, at.y + y, random.between(0.0, height))
    });
    editable(&mesh)
}

/// A flat chart somewhere in space, with the similarity of each of its vertices, v downwards.
struct Flat {
    mesh: EditMesh,
    uvs: Vec<Vec2>,
}

impl Flat {
    fn new([columns, rows]: [u32; 2], similarity: DVec2, random: &mut SplitMix64) -> Self {
        let turn = DMat3::from_rotation_x(1.0 + random.unit()) * DMat3::from_rotation_z(random.unit());
        let mut uvs = Vec::new();
        let mesh = grid(columns, rows, |at| {
            let at = at + DVec2::new(random.between(-0.05, 0.05), random.between(-0.05, 0.05));
            let uv = factor::times(similarity, at) + DVec2::new(0.3, -0.4);
            uvs.push(DVec2::new(uv.x, -uv.y).as_vec2());
            turn * at.extend(0.0)
        });
        Self { mesh: editable(&mesh), uvs }
    }

    /// The greatest distance from the similarity.
    fn error(&self) -> f32 {
        let distance = |corner| {
            let vertex = self.mesh.corner_vertex(corner).index() as usize;
            self.mesh.uv(0, corner).expect("the set exists").distance(self.uvs[vertex])
        };
        self.mesh.corners().map(distance).fold(0.0, f32::max)
    }
}

#[test]
fn islands_with_pins_are_left_where_they_are() {
    let mut cube = editable(&primitives::cube(2.0));
    let edges: Vec<_> = cube.edges().collect();
    cube.mark_seams(&edges).expect("twelve");
    let all = faces(&cube);
    cube.unwrap_faces(&all, &settings(0)).expect("six squares");
    let corners: Vec<CornerId> = cube.face_corners(all[2]).collect();
    for &corner in &corners {
        cube.set_uv(0, corner, cube.uv(0, corner).expect("the set exists") + 3.5);
    }
    cube.pin_uvs(0, &corners[..1]).expect("one");
    let before = bits(&cube, corners.iter().copied());
    let packing = PackSettings { rotate: false, average_scale: false, margin: 0.1 };
    assert_eq!(cube.pack_uv_islands(&all, 0, &packing), Ok(5), "all others");
    assert_eq!(bits(&cube, corners.iter().copied()), before, "packing");
    let unwrapped = cube.unwrap_faces(&all, &settings(2)).expect("six squares");
    assert_eq!((unwrapped.islands, unwrapped.pinned, unwrapped.overlapping), (6, 1, 0));
    assert_eq!(bits(&cube, corners[..1].iter().copied()), before[..1], "the pin to the bit");
    for (&corner, before) in corners.iter().zip(before) {
        let moved =
            cube.uv(0, corner).expect("the set exists").distance(Vec2::from(before.map(f32::from_bits)));
        assert!(moved < 1e-6, "the square has its size and direction: {moved}");
    }
    cube.pin_uvs(0, &cube.corners().collect::<Vec<_>>()).expect("all");
    let before = bits(&cube, cube.corners());
    assert_eq!(cube.pack_uv_islands(&all, 0, &packing), Ok(0));
    assert_eq!(cube.unwrap_faces(&all, &settings(2)).expect("nothing is free").pinned, 6);
    assert_eq!(bits(&cube, cube.corners()), before, "all are held");
}

#[test]
fn two_positions_of_a_vertex_need_a_seam() {
    let mut mesh = editable(&primitives::grid(2.0, 2.0, 2, 2));
    let middle: Vec<CornerId> = mesh
        .vertices()
        .map(|vertex| mesh.vertex_corners(vertex).collect())
        .max_by_key(Vec::len)
        .expect("nine");
    mesh.set_uv(0, middle[0], Vec2::ONE);
    mesh.pin_uvs(0, &middle).expect("four");
    let before = mesh.clone();
    let all = faces(&mesh);
    let refused = mesh.unwrap_faces(&all, &settings(0)).expect_err("which of them?").to_string();
    assert!(refused.contains("pin") && refused.contains("seam"), "{refused}");
    mesh.set_uv(0, middle[0], Vec2::new(f32::NAN, 0.0));
    let refused = mesh.unwrap_faces(&all, &settings(0)).expect_err("NaN").to_string();
    assert!(refused.contains("finite"), "{refused}");
    mesh.set_uv(0, middle[0], Vec2::ONE);
    assert!(mesh == before, "nothing was done");
    let edges: Vec<_> = mesh.edges().collect();
    mesh.mark_seams(&edges).expect("they exist");
    assert_eq!(mesh.unwrap_faces(&all, &settings(0)).expect("four squares").pinned, 4);
    assert_eq!(mesh.uv(0, middle[0]), Some(Vec2::ONE), "where it was");
}

#[test]
fn less_stretch_between_pins() {
    let dome = grid(10, 10, |at| {
        let flat = (at - 0.5) * 1.9;
        DVec3::new(flat.x, flat.y, 1.5 * (1.0 - flat.x * flat.x) * (1.0 - flat.y * flat.y))
    });
    let mut last = f64::INFINITY;
    for steps in [0, 2, 20] {
        let mut mesh = editable(&dome);
        for (vertex, uv) in [(0, [0.0, 1.0]), (10, [1.0, 1.0]), (110, [0.0, 0.0]), (120, [1.0, 0.0])] {
            pin(&mut mesh, vertex, Vec2::from(uv));
        }
        let corners = pinned(&mesh);
        let before = bits(&mesh, corners.iter().copied());
        let all = faces(&mesh);
        let unwrapped = mesh.unwrap_faces(&all, &settings(steps)).expect("it can be laid flat");
        assert_eq!((unwrapped.turned_over, unwrapped.overlapping), (0, 0), "after {steps} steps");
        assert_eq!(bits(&mesh, corners.into_iter()), before, "after {steps} steps");
        let stretch = stretch(&all_triangles(&mesh));
        assert!(stretch < last, "{stretch} after {steps} steps, {last} before");
        last = stretch;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Pins at a similarity of a flat chart: all of it follows that.
    #[test]
    fn a_flat_chart_follows_a_similarity(
        size in prop::array::uniform2(1u32..6),
        seed in any::<u64>(),
        similarity in prop::array::uniform2(-2.0f64..2.0),
        count in 1usize..6,
        steps in prop_oneof![Just(0u32), Just(3)],
    ) {
        let similarity = DVec2::from(similarity) + DVec2::new(0.0, 2.5);
        let mut random = SplitMix64::new(seed);
        let mut flat = Flat::new(size, similarity, &mut random);
        if count == 1 {
            // A single pin holds the size and direction that were there.
            for corner in flat.mesh.corners().collect::<Vec<_>>() {
                flat.mesh.set_uv(0, corner, flat.uvs[flat.mesh.corner_vertex(corner).index() as usize]);
            }
        }
        let (first, step) = (random.below(flat.uvs.len()), 1 + random.below(flat.uvs.len() - 1));
        for i in 0..count {
            // The first two are different.
            let vertex = (first + i * step) % flat.uvs.len();
            pin(&mut flat.mesh, vertex as u32, flat.uvs[vertex]);
        }
        let corners = pinned(&flat.mesh);
        let before = bits(&flat.mesh, corners.iter().copied());
        let all = faces(&flat.mesh);
        let unwrapped = flat.mesh.unwrap_faces(&all, &settings(steps)).expect("it is flat");
        prop_assert_eq!(unwrapped, Unwrapped { islands: 1, pinned: 1, ..Unwrapped::default() });
        prop_assert_eq!(bits(&flat.mesh, corners.into_iter()), before);
        // Two neighbours among six, rounded to f32 (2⁻²⁴ of at most 4), carry their error over six lengths.
        prop_assert!(flat.error() < 1e-4, "{}", flat.error());
    }

    /// Pins anywhere: they are held to the bit, what is reported is what an exact look finds, no free vertex could lower
    /// the energy, and all is undone.
    #[test]
    fn pins_anywhere_are_held(
        size in prop::array::uniform2(2u32..6),
        seed in any::<u64>(),
        height in 0.0f64..1.0,
        spread in prop_oneof![Just(0.0f64), Just(0.1), Just(1.0)],
        count in 2u32..6,
        steps in prop_oneof![2 => Just(0u32), 1 => Just(3)],
    ) {
        let mut random = SplitMix64::new(seed);
        let mut mesh = mountains(size[0], size[1], &mut random, height);
        // The first two are different.
        let (first, step) = (random.below(mesh.vertex_count()), 1 + random.below(mesh.vertex_count() - 1));
        for i in 0..count as usize {
            let vertex = ((first + i * step) % mesh.vertex_count()) as u32;
            let at = mesh.position(VertexId(vertex)).as_dvec3();
            let off = DVec2::new(random.between(-spread, spread), random.between(-spread, spread));
            pin(&mut mesh, vertex, (DVec2::new(at.x, -at.y) + off).as_vec2());
        }
        let corners = pinned(&mesh);
        let before = bits(&mesh, corners.iter().copied());
        let all = faces(&mesh);
        let done = check_operation(&mesh, |mesh| mesh.unwrap_faces(&all, &settings(steps)));
        let (after, unwrapped) = done.map_err(TestCaseError::fail)?.expect("it can be laid flat");
        prop_assert_eq!(bits(&after, corners.iter().copied()), before);
        let triangles = all_triangles(&after);
        let is_turned = |triangle: &&UvTriangle| {
            let [a, b, c] = triangle.uv;
            orientation(a, b, c) != Orientation::CounterClockwise
        };
        let turned = triangles.iter().filter(is_turned).count();
        prop_assert_eq!(unwrapped.turned_over, turned);
        prop_assert!(unwrapped.overlapping <= 1 && (turned == 0 || unwrapped.overlapping == 1));
        if unwrapped.overlapping == 0 {
            for (i, one) in triangles.iter().enumerate() {
                for other in &triangles[i + 1..] {
                    let common = common_area(&one.uv, &other.uv);
                    prop_assert!(common < 1e-6 * one.uv_area().min(other.uv_area()) + 1e-9, "{}", common);
                }
            }
        }
        if steps == 0 && mesh.vertex_corners(VertexId(0)).all(|corner| !mesh.is_uv_pinned(0, corner)) {
            let energy = conformal_energy(&triangles);
            for offset in [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y] {
                let mut other = after.clone();
                for corner in after.vertex_corners(VertexId(0)) {
                    other.set_uv(0, corner, after.uv(0, corner).expect("the set exists") + offset * 0.02);
                }
                prop_assert!(conformal_energy(&all_triangles(&other)) > energy);
            }
        }
    }
}
