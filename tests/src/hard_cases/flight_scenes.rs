//! What the flight goes over, and along which way.

use std::f64::consts::{PI, TAU};

use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3, Vec3, elementary};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_mesh::{Mesh, MeshBuilder};
use trigon_scene::{Material, Scene, Transform};

/// A scene to fly over.
pub(super) struct Hard {
    pub(super) name: &'static str,
    pub(super) scene: Scene,
    /// What the camera looks at.
    target: DVec3,
    /// The least and the greatest distance from there, in metres.
    distances: [f64; 2],
    /// How much of the images the oracle decides at least.
    pub(super) decided: f64,
}

impl Hard {
    /// The camera at a moment from 0 to 1: around, up to both poles and down again,
    /// nearer and farther, rolling, with all angles of view.
    pub(super) fn camera(&self, moment: f64) -> Camera {
        let wave = |turns: f64| elementary::sin(TAU * turns * moment);
        let (azimuth, elevation) = (TAU * 5.0 * moment, 0.5 * PI * wave(3.0));
        let [near, far] = self.distances;
        let distance = near * elementary::pow(far / near, 0.5 + 0.5 * wave(7.0));
        let (level, up) = (elementary::cos(elevation), elementary::sin(elevation));
        let away = DVec3::new(level * elementary::sin(azimuth), up, level * elementary::cos(azimuth));
        let head = DVec3::new(wave(2.0), elementary::cos(TAU * 2.0 * moment), 0.1);
        let projection = Projection::perspective(1.0 + 0.9 * wave(11.0), near * 1e-3, None);
        Camera::look_at(self.target + away * distance, self.target, head)
            .with_projection(projection.expect("an angle from 0.1 to 1.9"))
    }
}

/// All scenes.
pub(super) fn all() -> [Hard; 6] {
    [slivers(), coplanar(), far_away(), deep(), fan(), wide()]
}

/// A mesh cut into triangles, so that nothing is left open about which triangles there are.
pub(crate) fn in_triangles(mesh: &Mesh) -> Mesh {
    let mut builder = MeshBuilder::new();
    mesh.positions().iter().for_each(|&position| {
        builder.push_vertex(position);
    });
    for triangle in mesh.triangulation().triangles {
        let vertices = triangle.map(|corner| mesh.corner_vertices()[corner as usize]);
        builder.push_face(&vertices).expect("three vertices that exist");
    }
    builder.build()
}

/// Drawn from the front only, so that a crack shows the background.
fn shell() -> Material {
    Material { double_sided: false, ..Material::default() }
}

/// Closed meshes with needles: the caps of a cylinder, and of a sphere pressed flat.
fn slivers() -> Hard {
    let mut scene = Scene::new();
    scene.add_object("cylinder", in_triangles(&primitives::cylinder(1.0, 2.0, 90)), shell());
    let flat = scene.add_object("pressed", in_triangles(&primitives::uv_sphere(1.0, 40, 12)), shell());
    let pressed = DVec3::new(2.0, 1e-4, 2.0);
    scene.node_mut(flat).expect("just added").transform =
        Transform::from_scale_rotation_translation(pressed, DQuat::IDENTITY, DVec3::Y * -1.5);
    Hard { name: "slivers", scene, target: DVec3::ZERO, distances: [3.0, 60.0], decided: 0.8 }
}

/// Two cubes in the same place, and a third one that is a millimetre larger.
fn coplanar() -> Hard {
    let mut scene = Scene::new();
    for _ in 0..2 {
        scene.add_object("cube", in_triangles(&primitives::cube(2.0)), shell());
    }
    scene.add_object("larger", in_triangles(&primitives::cube(2.001)), shell());
    Hard { name: "coplanar", scene, target: DVec3::new(0.3, 0.2, 0.1), distances: [2.5, 40.0], decided: 0.8 }
}

/// A knot of ten centimetres with millimetres of detail, ten million metres away.
fn far_away() -> Hard {
    let shape = TorusKnot {
        major_radius: 0.03,
        minor_radius: 0.012,
        tube_radius: 0.005,
        segments: 80,
        sides: 6,
        ..TorusKnot::default()
    };
    let mut scene = Scene::new();
    let knot = scene.add_object("knot", in_triangles(&primitives::torus_knot(&shape)), shell());
    let target = DVec3::new(1.0e7 + 1.0 / 3.0, -9.7e6 - 0.1, 1.1e7 + 0.7);
    scene.node_mut(knot).expect("just added").transform.set_translation(target);
    Hard { name: "far away", scene, target, distances: [0.1, 1.0], decided: 0.7 }
}

/// Cubes of a millimetre to a hundred kilometres in sight of each other.
fn deep() -> Hard {
    let mut scene = Scene::new();
    for step in 0..9 {
        let size = elementary::pow(10.0, f64::from(step) - 3.0);
        let cube = scene.add_object("cube", in_triangles(&primitives::cube(1.0)), shell());
        let angle = 0.7 * f64::from(step);
        let place = DVec3::new(elementary::cos(angle), 0.3 - 0.1 * f64::from(step), elementary::sin(angle));
        scene.node_mut(cube).expect("just added").transform = Transform::from_scale_rotation_translation(
            DVec3::splat(size),
            DQuat::IDENTITY,
            place * size * 3.0,
        );
    }
    Hard { name: "deep", scene, target: DVec3::ZERO, distances: [1e-2, 1e3], decided: 0.8 }
}

/// Many needles around one vertex.
fn fan() -> Hard {
    const BLADES: u32 = 600;
    let mut builder = MeshBuilder::new();
    builder.push_vertex(Vec3::ZERO);
    for blade in 0..BLADES {
        let (sin, cos) = elementary::sin_cos(TAU * f64::from(blade) / f64::from(BLADES));
        builder.push_vertex(Vec3::new(cos as f32, 0.0, -sin as f32));
    }
    for blade in 0..BLADES {
        builder.push_face(&[0, blade + 1, (blade + 1) % BLADES + 1]).expect("three vertices that exist");
    }
    let mut scene = Scene::new();
    scene.add_object("fan", builder.build(), Material::default());
    Hard { name: "fan", scene, target: DVec3::ZERO, distances: [0.5, 5.0], decided: 0.4 }
}

/// A mesh of two hundred kilometres: tents at its corners, and far from its middle
/// steps of a metre over which the camera flies at a man's height.
fn wide() -> Hard {
    let mut scene = Scene::new();
    scene.add_object("land", in_triangles(&land(100_000.0, [60_001.0, -49_999.0])), Material::default());
    let target = DVec3::new(60_005.0, 0.0, -49_995.0);
    Hard { name: "wide", scene, target, distances: [1.0, 30.0], decided: 0.7 }
}

fn land(half: f32, [left, back]: [f32; 2]) -> Mesh {
    let mut builder = MeshBuilder::new();
    for row in 0..9_u8 {
        for column in 0..9_u8 {
            let depth = f32::from((row * 5 + column * 3) % 4) * -0.25;
            builder.push_vertex(Vec3::new(left + f32::from(column), depth, back + f32::from(row)));
        }
    }
    for row in 0..8 {
        for column in 0..8 {
            let first = row * 9 + column;
            builder.push_face(&[first, first + 9, first + 10, first + 1]).expect("four vertices that exist");
        }
    }
    for corner in [[-half, -half], [-half, half], [half, half], [half, -half]] {
        let tent = [[0.0, 0.0], [500.0, 0.0], [250.0, 900.0]];
        let tent = tent.map(|[x, y]| builder.push_vertex(Vec3::new(corner[0] + x, y, corner[1])));
        builder.push_face(&tent).expect("three vertices that exist");
    }
    builder.build()
}
