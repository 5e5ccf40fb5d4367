//! The six scenes: one effect each.

use super::{directions, looking};
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::{
    Light, LightKind, Material, MetallicRoughness, Node, NormalMap, Scene, Shading, Shadows, Texture,
    TextureBinding, TextureFormat, Transform,
};

/// A scene, where it is seen from, and the ways in which its shadows are found.
pub(super) struct Truth {
    pub(super) name: &'static str,
    pub(super) scene: Scene,
    pub(super) camera: Camera,
    /// What is appended to the name, and the shadows.
    pub(super) shadows: Vec<(&'static str, Shadows)>,
}

const PLAIN: [(&str, Shadows); 1] = [("", Shadows::Off)];

pub(super) fn all() -> Vec<Truth> {
    vec![lambert(), metal(), dielectric(), normal_map(), point(), spot(), soft_spot(), shadow()]
}

fn lambert() -> Truth {
    ball("lambert", matt(Vec3::new(0.8, 0.5, 0.2)))
}

/// Of a white metal: Schlick's approximation is exact for it.
fn metal() -> Truth {
    ball("metal", metallic(1.0, 0.4))
}

/// Black: its highlight alone.
fn dielectric() -> Truth {
    ball("dielectric", Material { base_color: Vec4::new(0.0, 0.0, 0.0, 1.0), ..metallic(0.0, 0.5) })
}

fn normal_map() -> Truth {
    let mut scene = Scene::new();
    let texture = Texture::new(256, 256, directions(256), TextureFormat::Linear).expect("256 × 256 texels");
    let texture = scene.add_texture("directions", texture);
    let normal_map = Some(NormalMap { binding: TextureBinding::new(texture), scale: 1.0 });
    let material = Material { normal_map, ..matt(Vec3::splat(0.8)) };
    scene.add_object("floor", primitives::plane(4.0, 4.0), material);
    sun(&mut scene, DVec3::new(0.5, -1.0, -0.3));
    Truth { name: "normal-map", scene, camera: above(), shadows: PLAIN.to_vec() }
}

fn point() -> Truth {
    lamp("point", Light::point(2.0))
}

/// With a rim of an eighth of a degree: renderers let light fade in their own ways.
fn spot() -> Truth {
    lamp("spot", Light { kind: LightKind::Spot { inner: 0.5975, outer: 0.6 }, ..Light::spot(3.0) })
}

fn soft_spot() -> Truth {
    lamp("soft-spot", Light { kind: LightKind::Spot { inner: 0.3, outer: 0.6 }, ..Light::spot(3.0) })
}

fn shadow() -> Truth {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(6.0, 6.0), matt(Vec3::splat(0.8)));
    let mesh = scene.add_mesh("knot", primitives::torus_knot(&TorusKnot::default()));
    let material = scene.add_material(matt(Vec3::new(0.3, 0.5, 0.8)));
    let knot = Node::from_mesh(mesh, material).with_name("knot").at(DVec3::new(0.0, 1.6, 0.0));
    scene.add(knot);
    sun(&mut scene, DVec3::new(0.6, -1.0, -0.4));
    let shadows = vec![("-by-rays", Shadows::Rays), ("-by-maps", Shadows::Maps { resolution: 2048 })];
    Truth { name: "shadow", scene, camera: above(), shadows }
}

/// A ball in the sun, alone: nothing casts a shadow on it.
fn ball(name: &'static str, material: Material) -> Truth {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::icosphere(1.0, 6), material);
    sun(&mut scene, DVec3::new(0.6, -0.7, -1.0));
    let camera = Camera::look_at(DVec3::new(0.0, 0.0, 3.6), DVec3::ZERO, DVec3::Y);
    Truth { name, scene, camera: seen(camera), shadows: PLAIN.to_vec() }
}

/// A floor below a lamp.
fn lamp(name: &'static str, light: Light) -> Truth {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(6.0, 6.0), matt(Vec3::splat(0.8)));
    let transform = Transform::from_scale_rotation_translation(
        DVec3::ONE,
        looking(DVec3::new(0.2, -1.0, -0.1)),
        DVec3::new(-0.3, 1.5, 0.2),
    );
    scene.add(Node::from_light(light).with_transform(transform));
    Truth { name, scene, camera: above(), shadows: PLAIN.to_vec() }
}

fn above() -> Camera {
    seen(Camera::look_at(DVec3::new(0.0, 4.0, 5.0), DVec3::new(0.0, 0.4, 0.0), DVec3::Y))
}

fn seen(camera: Camera) -> Camera {
    let projection = Projection::perspective(0.8, 0.1, None).expect("the angle is in range");
    camera.with_projection(projection)
}

fn sun(scene: &mut Scene, along: DVec3) {
    let transform = Transform::from_scale_rotation_translation(DVec3::ONE, looking(along), DVec3::ZERO);
    scene.add(Node::from_light(Light::directional(1.0)).with_transform(transform));
}

fn matt(color: Vec3) -> Material {
    Material::from_color(color).with_shading(Shading::Lambert)
}

fn metallic(metallic: f32, roughness: f32) -> Material {
    let model = MetallicRoughness { metallic, roughness, ..MetallicRoughness::default() };
    Material { base_color: Vec4::ONE, ..Material::default() }.with_shading(Shading::MetallicRoughness(model))
}
