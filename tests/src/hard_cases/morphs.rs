//! Morph targets: sums in f64, weights far beyond 0 to 1, and planes that follow.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DVec3, Vec3};
use trigon_mesh::{Attributes, Deltas, Mesh, MeshBuilder, MorphTarget, primitives};
use trigon_scene::{Frame, Material, Scene, render};

use super::flight::{check_ids, check_numbers, settings};
use super::flight_oracle::Oracle;
use super::flight_scenes::in_triangles;
use crate::effort::cases;

const SIZE: [u32; 2] = [48, 36];

/// Vertices of the ball that is moved.
const VERTICES: usize = 42;

fn ball() -> Mesh {
    in_triangles(&primitives::icosphere(1.0, 1))
}

/// For each target what it adds to each vertex, and its weight.
#[derive(Clone, Debug)]
struct Morph {
    targets: Vec<(Vec<Vec3>, f32)>,
}

impl Morph {
    /// The ball, with these targets.
    fn mesh(&self) -> Mesh {
        let mut mesh = ball();
        let target = |(deltas, _): &(Vec<Vec3>, f32)| MorphTarget {
            positions: Deltas::from_dense(deltas.iter().copied()),
            ..MorphTarget::default()
        };
        let morph_targets = self.targets.iter().map(target).collect();
        let attributes = Attributes { morph_targets, ..mesh.attributes().clone() };
        mesh.set_attributes(attributes).expect("a value for each vertex");
        mesh
    }

    fn weights(&self) -> Vec<f32> {
        self.targets.iter().map(|(_, weight)| *weight).collect()
    }

    /// Where a vertex goes, and the sum of the sizes of what is added.
    fn place(&self, vertex: usize, start: Vec3) -> (DVec3, f64) {
        let terms =
            || self.targets.iter().map(|(deltas, weight)| deltas[vertex].as_dvec3() * f64::from(*weight));
        let size = terms().map(|term| term.abs().max_element()).sum::<f64>();
        (start.as_dvec3() + terms().sum::<DVec3>(), size + f64::from(start.abs().max_element()))
    }

    /// The moved ball as a mesh of its own.
    fn baked(&self) -> Mesh {
        let (ball, mut builder) = (ball(), MeshBuilder::new());
        for (vertex, &start) in ball.positions().iter().enumerate() {
            builder.push_vertex(self.place(vertex, start).0.as_vec3());
        }
        for face in 0..ball.face_count() {
            builder.push_face(ball.face_vertices(face)).expect("as in the ball");
        }
        builder.build()
    }
}

/// What one rounding to f32 is off by at most, relative.
const UNIT: f64 = 1.0 / (1 << 24) as f64;

fn deltas(range: f32) -> impl Strategy<Value = Vec<Vec3>> {
    // Few vertices, or all of them.
    let vector = prop::array::uniform3(-range..range).prop_map(Vec3::from_array);
    let some = prop_oneof![3 => Just(Vec3::ZERO), 1 => vector.clone()];
    prop_oneof![prop::collection::vec(vector, VERTICES), prop::collection::vec(some, VERTICES)]
}

/// Weights from 0 to 1, negative, as large as a hundred thousand, and denormal.
fn weight() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => 0.0_f32..1.0, 2 => -2.0_f32..2.0, 1 => -1e5_f32..1e5,
        1 => Just(0.0), 1 => Just(1.0), 1 => Just(-1.0), 1 => Just(1e-40)
    ]
}

fn morph() -> impl Strategy<Value = Morph> {
    prop::collection::vec((deltas(2.0), weight()), 1..6).prop_map(|targets| Morph { targets })
}

fn shell() -> Material {
    Material { double_sided: false, ..Material::default() }
}

/// A scene with one mesh, moved by weights.
fn scene(mesh: Mesh, weights: Vec<f32>) -> Scene {
    let mut scene = Scene::new();
    let node = scene.add_object("ball", mesh, shell());
    scene.node_mut(node).expect("just added").morph_weights = weights;
    scene
}

fn draw(scene: &Scene, camera: &Camera) -> Frame {
    let frame = render(scene, camera, &settings(SIZE)).expect("in range");
    check_numbers(&frame);
    frame
}

proptest! {
    #![proptest_config(cases(100))]

    /// Each target is a product and a sum: as many roundings of the sum of the sizes as there are of both.
    #[test]
    fn vertices_go_where_the_sum_of_their_targets_is(morph in morph()) {
        let (mesh, weights) = (morph.mesh(), morph.weights());
        let moved = mesh.deformed_positions(&weights, &[]);
        let roundings = 2.0 * morph.targets.len() as f64 + 1.0;
        for (vertex, (&start, found)) in mesh.positions().iter().zip(&moved).enumerate() {
            let (expected, size) = morph.place(vertex, start);
            let error = (found.as_dvec3() - expected).abs().max_element();
            prop_assert!(error <= roundings * UNIT * size + 1e-44, "{} instead of {}", found, expected);
        }
        let bounds = scene(mesh, weights).bounds();
        for (vertex, &start) in ball().positions().iter().enumerate() {
            let (place, size) = morph.place(vertex, start);
            let slack = DVec3::splat(roundings * UNIT * size);
            let is_within = place.cmpge(bounds.min - slack).all() && place.cmple(bounds.max + slack).all();
            prop_assert!(is_within, "{} is not in {:?}", place, bounds);
        }
    }
}

/// Numbers whose products and sums f32 holds exactly: eighths, and weights of few bits.
fn exact() -> impl Strategy<Value = Morph> {
    let eighths = prop::collection::vec(prop::array::uniform3(-12..12_i8), VERTICES).prop_map(|deltas| {
        deltas.into_iter().map(|d| Vec3::from_array(d.map(|v| f32::from(v) / 8.0))).collect()
    });
    let weight = prop_oneof![
        4 => Just(0.25_f32), 2 => Just(-0.5), 2 => Just(1.0), 1 => Just(-64.0), 1 => Just(1024.0)
    ];
    prop::collection::vec((eighths, weight), 1..4).prop_map(|targets| Morph { targets })
}

proptest! {
    #![proptest_config(cases(40))]

    /// A moved ball, up to a thousand times as large as at rest, and near or far from where it was: each pixel shows the
    /// triangle that a ray meets first among triangles at the sums in f64, with no plane at all. Planes that were fitted
    /// to the ball at rest would cut it.
    #[test]
    fn a_moved_mesh_is_seen_whole_where_rays_meet_the_sum(
        morph in exact(), away in prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from_array), is_shifted in any::<bool>(),
    ) {
        // All of it may move away together.
        let mut morph = morph;
        if is_shifted {
            morph.targets.push((vec![Vec3::new(-3.0, 1.0, 2.0); VERTICES], 4096.0));
        }
        let shown = scene(morph.mesh(), morph.weights());
        let baked = scene(morph.baked(), Vec::new());
        let (middle, size) = (baked.bounds().center().expect("not empty"), baked.bounds().size().length());
        let eye = middle + away.normalize_or(DVec3::X) * size * 0.8;
        let projection = |near| Projection::perspective(1.0, near, None).expect("in range");
        let camera = Camera::look_at(eye, middle, DVec3::Y).with_projection(projection(1.0));
        let frame = draw(&shown, &camera.with_clip_planes(&shown.bounds()));
        let uncut = camera.with_projection(projection(1e-100));
        let decided = check_ids(&frame, &Oracle::new(&baked, &uncut, SIZE), "moved");
        let seen = frame.object_ids.iter().flatten().filter(|&&id| id == 0).count();
        prop_assert!(decided > 0.3 && seen > 50, "{} decided, {} pixels", decided, seen);
    }

    /// The normals of a smooth surface are the sums of what targets add to them, made unit vectors: the same all over a
    /// plate whose corners have the same.
    #[test]
    fn normals_are_the_sums_of_their_targets_as_unit_vectors(
        targets in prop::collection::vec((prop::array::uniform3(-2.0_f32..2.0), weight()), 1..5),
    ) {
        let sum = targets.iter().fold(DVec3::Y, |sum, (delta, weight)| {
            sum + Vec3::from_array(*delta).as_dvec3() * f64::from(*weight)
        });
        let terms = targets.iter().map(|(delta, weight)| f64::from(weight.abs()) * Vec3::from_array(*delta).as_dvec3().length());
        let size = 1.0 + terms.sum::<f64>();
        // Where nearly all cancels, its direction is open.
        prop_assume!(sum.length() > 1e-3 * size);
        let mut mesh = primitives::plane(4.0, 4.0);
        let morph_targets = targets.iter().map(|(delta, _)| MorphTarget {
            normals: Deltas::from_dense([Vec3::from_array(*delta); 4]),
            ..MorphTarget::default()
        });
        let attributes = Attributes {
            corner_normals: Some(vec![Vec3::Y; 4]), morph_targets: morph_targets.collect(), ..mesh.attributes().clone()
        };
        mesh.set_attributes(attributes).expect("a value for each corner");
        let shown = scene(mesh, targets.iter().map(|(_, weight)| *weight).collect());
        let projection = Projection::orthographic(2.0, 0.1, 20.0).expect("in range");
        let camera = Camera::look_at(DVec3::Y * 5.0, DVec3::ZERO, DVec3::NEG_Z).with_projection(projection);
        let frame = draw(&shown, &camera);
        let expected = sum.normalize();
        // A product and a sum for each, on each axis, beside the length of the sum; and four for the unit vector.
        let roundings = 2.0 * targets.len() as f64 + 1.0;
        let bound = 3.0_f64.sqrt() * roundings * UNIT * size / sum.length() + 8.0 * UNIT;
        for normal in frame.normals.expect("asked for") {
            let error = (normal.as_dvec3() - expected).length();
            prop_assert!(error <= bound, "{} instead of {}", normal, expected);
        }
    }
}
