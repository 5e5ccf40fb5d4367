//! The scenes that are built here: what each is to show is said at [`FrameCase`](super::FrameCase).

use trigon_io::LoadOptions;
use trigon_math::{DQuat, DVec3, Vec3, Vec4};
use trigon_mesh::primitives::TorusKnot;
use trigon_mesh::{Mesh, primitives};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::{
    AlphaMode, Light, Material, MetallicRoughness, Node, Scene, Shading, Texture, TextureFormat, Transform,
};

/// A model on a chequered floor four times as wide, in the sun; one unit high.
pub(super) fn standing(mesh: &Mesh, color: Vec3) -> Scene {
    let bounds = mesh.bounds();
    let scale = 1.0 / (bounds.max.y - bounds.min.y);
    let foot = DVec3::Y * bounds.min.y;
    let mut scene = Scene::new();
    let pattern = scene.add_texture("pattern", chequered());
    scene.add_object("floor", primitives::plane(4.0, 4.0), Material::from_texture(pattern));
    let (mesh, material) =
        (scene.add_mesh("model", mesh.clone()), scene.add_material(Material::from_color(color)));
    let spot =
        Transform::from_scale_rotation_translation(DVec3::splat(scale), DQuat::IDENTITY, -foot * scale);
    scene.add(Node::from_mesh(mesh, material).with_transform(spot));
    add_sun(&mut scene);
    scene
}

/// The mesh of a file of this crate.
pub(super) fn read(text: &str) -> Mesh {
    let loaded = trigon_io::load_from_slice("model.obj", text.as_bytes(), &LoadOptions::default());
    let scene = loaded.expect("the model is part of this crate").scene;
    let mut meshes = scene.meshes().iter().map(|(_, asset)| asset.mesh().clone());
    meshes.next().expect("it has a mesh")
}

/// Nine knots in rows on a floor with a fine pattern, in the sun.
pub(super) fn knots() -> Scene {
    let mut scene = Scene::new();
    let pattern = scene.add_texture("pattern", chequered());
    scene.add_object("floor", primitives::plane(8.0, 8.0), Material::from_texture(pattern));
    let shape =
        TorusKnot { major_radius: 0.5, minor_radius: 0.22, tube_radius: 0.12, ..TorusKnot::default() };
    let mesh = scene.add_mesh("knot", primitives::torus_knot(&shape));
    for spot in 0..9 {
        let [column, row] = [spot % 3, spot / 3].map(|step| f64::from(step - 1));
        let color = Vec3::new(0.7 - 0.2 * row as f32, 0.4, 0.5 + 0.2 * column as f32);
        let material = scene.add_material(Material::from_color(color));
        scene.add(Node::from_mesh(mesh, material).at(DVec3::new(2.2 * column, 0.8, 2.2 * row)));
    }
    add_sun(&mut scene);
    scene
}

/// The sun, and some light from everywhere.
fn add_sun(scene: &mut Scene) {
    let down = DQuat::from_axis_angle(DVec3::Y, 0.6) * DQuat::from_axis_angle(DVec3::X, -0.9);
    let sun = Transform::from_scale_rotation_translation(DVec3::ONE, down, DVec3::ZERO);
    scene.add(Node::from_light(Light::directional(0.8)).with_transform(sun));
    scene.add(Node::from_light(Light::ambient(0.25)));
}

/// Fields of 16 texels.
fn chequered() -> Texture {
    const SIDE: u32 = 512;
    let texel = |index: u32| {
        let is_light = (index % SIDE / 16 + index / SIDE / 16).is_multiple_of(2);
        if is_light { [220, 214, 200, 255] } else { [60, 70, 92, 255] }
    };
    let texels = (0..SIDE * SIDE).map(texel).collect();
    Texture::new(SIDE, SIDE, texels, TextureFormat::Srgb).expect("the size is within the limits")
}

/// Balls in a square; lit by the lights that come with the camera.
pub(super) fn balls() -> Scene {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh("ball", primitives::icosphere(0.45, 4));
    let material = scene.add_material(Material::from_color(Vec3::new(0.75, 0.55, 0.3)));
    for spot in 0..36 {
        let [x, z] = [spot % 6, spot / 6].map(|step| f64::from(step) - 2.5);
        scene.add(Node::from_mesh(mesh, material).at(DVec3::new(x, 0.0, z)));
    }
    scene
}

/// Boxes of many heights in rows, as a city has them: most faces are hidden, and all edges are straight.
pub(super) fn city() -> Scene {
    let mut scene = Scene::new();
    scene.add_object("ground", primitives::plane(40.0, 40.0), Material::from_color(Vec3::splat(0.35)));
    let mesh = scene.add_mesh("house", primitives::cube(1.0));
    let colors = [Vec3::new(0.7, 0.45, 0.3), Vec3::new(0.6, 0.6, 0.65), Vec3::new(0.8, 0.75, 0.6)];
    let materials = colors.map(|color| scene.add_material(Material::from_color(color)));
    for spot in 0..625_u32 {
        let [column, row] = [spot % 25, spot / 25].map(|step| f64::from(step) - 12.0);
        // A hash of the place: heights from 0.5 to 3.
        let hash = spot.wrapping_mul(0x9e37_79b1) >> 16;
        let height = 0.5 + 2.5 * f64::from(hash % 256) / 255.0;
        let size = DVec3::new(0.7, height, 0.7);
        let at = DVec3::new(column, height / 2.0, row);
        let house = Node::from_mesh(mesh, materials[(hash % 3) as usize]);
        scene.add(house.with_transform(Transform::from_scale_rotation_translation(
            size,
            DQuat::IDENTITY,
            at,
        )));
    }
    add_sun(&mut scene);
    add_camera(&mut scene, [DVec3::new(9.0, 6.0, 12.0), DVec3::new(0.0, 0.5, 0.0)]);
    scene
}

/// A passage with a chequered floor and walls, lit by lamps along it: textures from near by to the far end, and shadows of columns.
pub(super) fn passage() -> Scene {
    let mut scene = Scene::new();
    let pattern = scene.add_texture("pattern", chequered());
    let material = scene.add_material(Material::from_texture(pattern));
    let plane = scene.add_mesh("wall", primitives::plane(4.0, 40.0));
    let sides = [(0.0, DVec3::ZERO), (90.0, DVec3::new(2.0, 2.0, 0.0)), (-90.0, DVec3::new(-2.0, 2.0, 0.0))];
    for (turn, at) in sides {
        let turn = DQuat::from_axis_angle(DVec3::Z, f64::to_radians(turn));
        let placed = Transform::from_scale_rotation_translation(DVec3::ONE, turn, at);
        scene.add(Node::from_mesh(plane, material).with_transform(placed));
    }
    let column = scene.add_mesh("column", primitives::cylinder(0.2, 3.0, 32));
    let stone = scene.add_material(Material::from_color(Vec3::new(0.75, 0.7, 0.6)));
    for step in 0..8 {
        let z = 16.0 - 4.0 * f64::from(step);
        for x in [-1.3, 1.3] {
            scene.add(Node::from_mesh(column, stone).at(DVec3::new(x, 1.5, z)));
        }
        if step % 2 == 0 {
            let lamp = Light::point(3.0).with_color(Vec3::new(1.0, 0.85, 0.65));
            scene.add(Node::from_light(lamp).at(DVec3::new(0.0, 2.8, z - 2.0)));
        }
    }
    scene.add(Node::from_light(Light::ambient(0.08)));
    add_camera(&mut scene, [DVec3::new(0.4, 1.5, 21.0), DVec3::new(0.0, 1.2, 0.0)]);
    scene
}

/// A meadow of blades of grass, each thinner than a pixel at its tip.
pub(super) fn grass() -> Scene {
    let mut scene = Scene::new();
    scene.add_object(
        "ground",
        primitives::plane(12.0, 12.0),
        Material::from_color(Vec3::new(0.2, 0.14, 0.08)),
    );
    let mesh = scene.add_mesh("blade", primitives::pyramid(0.04, 0.5));
    let greens = [Vec3::new(0.2, 0.5, 0.1), Vec3::new(0.35, 0.55, 0.15), Vec3::new(0.5, 0.55, 0.25)];
    let materials = greens.map(|green| scene.add_material(Material::from_color(green)));
    for spot in 0..2500_u32 {
        let hash = spot.wrapping_mul(0x9e37_79b1) ^ spot.wrapping_mul(0x85eb_ca6b) >> 7;
        let part = |shift: u32| f64::from(hash >> shift & 255) / 255.0 - 0.5;
        let at = DVec3::new(
            f64::from(spot % 50) * 0.16 - 4.0 + 0.16 * part(0),
            0.25,
            f64::from(spot / 50) * 0.16 - 4.0 + 0.16 * part(8),
        );
        let lean = DQuat::from_axis_angle(DVec3::Z, part(16)) * DQuat::from_axis_angle(DVec3::X, part(24));
        let blade = Node::from_mesh(mesh, materials[(spot % 3) as usize]);
        scene.add(blade.with_transform(Transform::from_scale_rotation_translation(DVec3::ONE, lean, at)));
    }
    add_sun(&mut scene);
    add_camera(&mut scene, [DVec3::new(2.0, 1.6, 5.5), DVec3::new(0.0, 0.2, 0.0)]);
    scene
}

/// Balls of coloured glass without refraction, one in front of the other: up to twelve layers.
pub(super) fn layers() -> Scene {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh("ball", primitives::uv_sphere(0.6, 48, 24));
    for spot in 0..27 {
        let [x, y, z] = [spot % 3, spot / 3 % 3, spot / 9].map(|step| f64::from(step) - 1.0);
        let color = Vec3::new(0.5 + 0.4 * x as f32, 0.5 + 0.4 * y as f32, 0.5 + 0.4 * z as f32);
        let material =
            Material { base_color: color.extend(0.3), alpha_mode: AlphaMode::Blend, ..Material::default() };
        let material = scene.add_material(material);
        scene.add(Node::from_mesh(mesh, material).at(DVec3::new(x, y, z)));
    }
    add_sun(&mut scene);
    scene
}

/// Balls of polished metal among glowing knots, on a metal floor: mirrors in mirrors. There is no lamp, because what a mirror shows
/// of a lamp without size is a point of infinite light.
pub(super) fn mirrors() -> Scene {
    let mut scene = Scene::new();
    let metal = |color: Vec3| {
        let model = MetallicRoughness { metallic: 1.0, roughness: 0.0, ..MetallicRoughness::default() };
        let base_color: Vec4 = color.extend(1.0);
        Material { base_color, ..Material::default() }.with_shading(Shading::MetallicRoughness(model))
    };
    scene.add_object("floor", primitives::plane(9.0, 9.0), metal(Vec3::splat(0.5)));
    let ball = scene.add_mesh("ball", primitives::uv_sphere(0.7, 64, 32));
    let knot = scene.add_mesh(
        "knot",
        primitives::torus_knot(&TorusKnot {
            major_radius: 0.45,
            minor_radius: 0.2,
            tube_radius: 0.12,
            ..TorusKnot::default()
        }),
    );
    let glowing = |color: Vec3| Material::from_color(color).with_shading(Shading::Unlit);
    for spot in 0..9_u8 {
        let [x, z] = [spot % 3, spot / 3].map(|step| 2.0 * (f64::from(step) - 1.0));
        let color = Vec3::new(0.8 - 0.06 * f32::from(spot), 0.35 + 0.06 * f32::from(spot), 0.5);
        let is_metal = spot % 2 == 0;
        let (mesh, look) = if is_metal { (ball, metal(color)) } else { (knot, glowing(color)) };
        let material = scene.add_material(look);
        scene.add(Node::from_mesh(mesh, material).at(DVec3::new(x, 0.75, z)));
    }
    scene.add(Node::from_light(Light::ambient(0.6)));
    add_camera(&mut scene, [DVec3::new(3.5, 3.2, 6.5), DVec3::new(0.0, 0.4, 0.0)]);
    scene
}

/// A chair and a teapot in the corner of a room, in light from everywhere.
pub(super) fn corner() -> Scene {
    let mut scene = Scene::new();
    let plaster = Material::from_color(Vec3::new(0.8, 0.78, 0.74)).with_shading(Shading::Lambert);
    let plaster = scene.add_material(plaster);
    let wall = scene.add_mesh("wall", primitives::plane(4.0, 4.0));
    let sides = [
        (DQuat::IDENTITY, DVec3::ZERO),
        (DQuat::from_axis_angle(DVec3::X, 90_f64.to_radians()), DVec3::new(0.0, 2.0, -2.0)),
        (DQuat::from_axis_angle(DVec3::Z, -90_f64.to_radians()), DVec3::new(-2.0, 2.0, 0.0)),
    ];
    for (turn, at) in sides {
        let placed = Transform::from_scale_rotation_translation(DVec3::ONE, turn, at);
        scene.add(Node::from_mesh(wall, plaster).with_transform(placed));
    }
    let mut add = |mesh: &Mesh, color: Vec3, height: f64, at: DVec3| {
        let bounds = mesh.bounds();
        let scale = height / (bounds.max.y - bounds.min.y);
        let (mesh, material) =
            (scene.add_mesh("model", mesh.clone()), scene.add_material(Material::from_color(color)));
        let at = at - DVec3::Y * bounds.min.y * scale;
        let placed = Transform::from_scale_rotation_translation(DVec3::splat(scale), DQuat::IDENTITY, at);
        scene.add(Node::from_mesh(mesh, material).with_transform(placed));
    };
    add(
        &read(include_str!("../../models/chair.obj")),
        Vec3::new(0.5, 0.3, 0.16),
        1.6,
        DVec3::new(-0.9, 0.0, -0.9),
    );
    add(&primitives::teapot(8), Vec3::new(0.7, 0.35, 0.25), 0.7, DVec3::new(0.6, 0.0, 0.3));
    scene.add(Node::from_light(Light::ambient(0.9)));
    add_camera(&mut scene, [DVec3::new(3.6, 2.4, 4.4), DVec3::new(-0.2, 0.8, -0.4)]);
    scene
}

/// A camera with an eye and a target.
fn add_camera(scene: &mut Scene, [eye, target]: [DVec3; 2]) {
    let camera = Camera::look_at(eye, target, DVec3::Y);
    let projection =
        Projection::perspective(40_f64.to_radians(), 0.1, None).expect("the numbers are in range");
    let placed = Transform::from_scale_rotation_translation(DVec3::ONE, camera.orientation, camera.position);
    let mut node = Node::default();
    node.camera = Some(Box::new(projection));
    scene.add(node.with_name("camera").with_transform(placed));
}
