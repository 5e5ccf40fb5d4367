//! The scenes, and the settings by which each effect is on.

use std::num::NonZeroUsize;
use std::sync::Arc;

use trigon_camera::Camera;
use trigon_math::glam::Affine2;
use trigon_math::{DQuat, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_mesh::{Attributes, Deltas, Mesh, MorphTarget};
use trigon_scene::{
    AlphaMode, AmbientOcclusion, Background, Effect, Environment, Exposure, Fog, Light, Lighting, Material,
    MetallicRoughness, Node, NodeId, NormalMap, Occlusion, Outline, RaySampling, RenderSettings, Scene,
    Shading, Shadows, SightRays, Sky, SoftShadows, Style, Texture, TextureBinding, TextureFormat,
    ToneMapping, Transform, showcase,
};

/// A scene and how it is looked at.
pub(crate) struct Subject {
    pub(crate) scene: Scene,
    pub(crate) camera: Camera,
    /// The effect that the scene is for; `None` shows all that it has.
    pub(crate) only: Option<Effect>,
}

/// Makes a subject.
pub(crate) type Maker = fn() -> Subject;

/// The names of all subjects, and what makes each.
pub(crate) const SUBJECTS: [(&str, Maker); 5] = [
    ("Exhibition", exhibition),
    ("Materials", materials),
    ("Knot", knot),
    ("Figures", figures),
    ("Candela", candela),
];

/// Every effect with settings that may have it.
pub(crate) fn shown(subject: &Subject) -> Vec<(Effect, RenderSettings)> {
    let plain = RenderSettings {
        samples_per_axis: 1,
        threads: NonZeroUsize::new(1),
        ..RenderSettings::new(480, 300)
    };
    let asked = |effect, change: &dyn Fn(&mut RenderSettings)| {
        let mut settings = plain.clone();
        change(&mut settings);
        (effect, settings)
    };
    let sky = Arc::new(Environment::from_sky(&Sky::default()));
    let first: Vec<NodeId> = subject
        .scene
        .nodes()
        .iter()
        .filter(|(_, node)| node.mesh.is_some())
        .map(|(id, _)| id)
        .skip(1)
        .take(1)
        .collect();
    let of_scene = [
        Effect::Lamps,
        Effect::AmbientLight,
        Effect::LightMeter,
        Effect::Highlights,
        Effect::Textures,
        Effect::NormalMaps,
        Effect::OcclusionMaps,
        Effect::Emission,
        Effect::VertexColors,
        Effect::Masks,
        Effect::Transparency,
        Effect::Poses,
        Effect::Refraction,
    ];
    let of_settings = vec![
        asked(Effect::Environment, &|settings| {
            settings.effects.environment = Some(Arc::clone(&sky));
            settings.background = Background::Environment;
        }),
        // These scenes have ambient light of their own, which metals mirror otherwise.
        asked(Effect::MetalStudio, &|settings| settings.lighting = Lighting::Studio),
        asked(Effect::ShadowMaps, &|settings| settings.effects.shadows = Shadows::Maps { resolution: 2048 }),
        asked(Effect::ShadowRays, &|settings| settings.effects.shadows = Shadows::Rays),
        asked(Effect::SoftShadows, &|settings| {
            settings.effects.shadows = Shadows::Rays;
            settings.effects.soft_shadows =
                SoftShadows { radius: 0.1, rays: 64, sampling: RaySampling::Shared };
        }),
        asked(Effect::AmbientOcclusion, &|settings| {
            settings.effects.ambient_occlusion = Some(AmbientOcclusion::new(16, 1.0));
        }),
        asked(Effect::Reflection, &|settings| settings.effects.sight = SightRays::all(4)),
        asked(Effect::Fog, &|settings| {
            settings.effects.fog = Some(Fog { color: Vec3::new(0.5, 0.53, 0.57), density: 0.12 });
        }),
        asked(Effect::ToneMapping, &|settings| {
            settings.effects.exposure = Exposure::Stops(1.0);
            settings.effects.tone_mapping = ToneMapping::KhronosPbrNeutral;
        }),
        asked(Effect::Outline, &|settings| {
            let outline = Outline { nodes: first.clone(), color: Vec3::new(1.0, 0.45, 0.0), width: 3 };
            settings.effects.outline = Some(outline);
        }),
        asked(Effect::Edges, &|settings| settings.style = Style::SurfaceWithEdges),
    ];
    let all = of_scene.map(|effect| (effect, plain.clone())).into_iter().chain(of_settings);
    all.filter(|(effect, _)| subject.only.is_none_or(|only| only == *effect)).collect()
}

/// The built-in scene.
fn exhibition() -> Subject {
    let scene = showcase();
    let camera = scene.cameras()[0].1;
    Subject { scene, camera, only: None }
}

/// Balls of several materials on a checked floor.
fn materials() -> Subject {
    let mut scene = Scene::new();
    let checker = scene.add_texture("checker", texture(TextureFormat::Srgb, checker));
    let floor = Material { shading: Shading::Lambert, ..Material::from_texture(checker) };
    scene.add_object("floor", primitives::plane(9.0, 9.0), floor);
    let model = |metallic, roughness| {
        Shading::MetallicRoughness(MetallicRoughness { metallic, roughness, ..MetallicRoughness::default() })
    };
    let gold = Vec4::new(1.0, 0.77, 0.34, 1.0);
    let glass = Material { transmission: 1.0, base_color: Vec4::ONE, ..Material::default() };
    let lamp = Material { emissive: Vec3::new(0.9, 0.5, 0.1), ..Material::from_color(Vec3::ZERO) };
    let balls = [
        (
            "mirror",
            Material { base_color: Vec4::splat(0.95), shading: model(1.0, 0.0), ..Material::default() },
        ),
        ("glass", Material { shading: model(0.0, 0.0), ..glass }),
        ("gold", Material { base_color: gold, shading: model(1.0, 0.35), ..Material::default() }),
        (
            "plastic",
            Material { shading: model(0.0, 0.3), ..Material::from_color(Vec3::new(0.7, 0.06, 0.05)) },
        ),
        ("lamp", lamp),
    ];
    for (i, (name, material)) in (-2_i8..).zip(balls) {
        let ball = scene.add_object(name, primitives::uv_sphere(0.55, 96, 48), material);
        let place = DVec3::new(f64::from(i) * 1.2, 0.55, f64::from(i.unsigned_abs() % 2) * 0.5);
        if let Some(node) = scene.node_mut(ball) {
            node.transform = Transform::from_translation(place);
        }
    }
    light(&mut scene);
    let camera = Camera::look_at(DVec3::new(0.3, 2.6, 8.2), DVec3::new(0.0, 0.4, 0.0), DVec3::Y);
    Subject { scene, camera, only: None }
}

/// A textured torus knot with a normal map.
fn knot() -> Subject {
    let mut scene = Scene::new();
    let shape = TorusKnot { segments: 700, sides: 50, tube_radius: 0.28, ..TorusKnot::default() };
    let colors = scene.add_texture("colours", texture(TextureFormat::Srgb, checker));
    let bumps = scene.add_texture("bumps", texture(TextureFormat::Linear, bumps));
    let transform = Affine2::from_scale(Vec2::new(10.0, 2.0));
    let on = |texture| TextureBinding { transform, ..TextureBinding::new(texture) };
    let normal_map = Some(NormalMap { binding: on(bumps), scale: 1.0 });
    let base_color_texture = Some(on(colors));
    let material = Material { base_color: Vec4::ONE, base_color_texture, normal_map, ..Material::default() };
    scene.add_object("floor", primitives::plane(7.0, 7.0), Material::from_color(Vec3::splat(0.6)));
    let knot = scene.add_object("knot", primitives::torus_knot(&shape), material);
    if let Some(node) = scene.node_mut(knot) {
        node.transform = Transform::from_translation(DVec3::Y * 1.3);
    }
    light(&mut scene);
    let camera = Camera::look_at(DVec3::new(1.0, 2.6, 6.0), DVec3::new(0.0, 1.0, 0.0), DVec3::Y);
    Subject { scene, camera, only: None }
}

/// What a scene has by itself and the others lack: a ball with vertex colours, a fence with holes, a pane, a ball with an
/// occlusion map, and a ball halfway towards another shape.
fn figures() -> Subject {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(7.0, 7.0), Material::from_color(Vec3::splat(0.6)));
    let colors = scene.add_texture("holes", texture(TextureFormat::Srgb, holes));
    let shade = scene.add_texture("shade", texture(TextureFormat::Linear, bumps));
    let ball = || primitives::uv_sphere(0.6, 96, 48);
    let holes = Some(TextureBinding::new(colors));
    let fence = Material {
        base_color: Vec4::ONE,
        base_color_texture: holes,
        double_sided: true,
        ..Material::default()
    };
    let occlusion = Some(Occlusion { binding: TextureBinding::new(shade), strength: 1.0 });
    let objects = [
        ("painted", painted(ball()), Material { base_color: Vec4::ONE, ..Material::default() }),
        (
            "fence",
            primitives::plane(1.2, 1.2),
            Material { alpha_mode: AlphaMode::Mask { cutoff: 0.5 }, ..fence },
        ),
        (
            "pane",
            primitives::plane(1.2, 1.2),
            Material {
                base_color: Vec4::new(0.2, 0.5, 0.7, 0.4),
                alpha_mode: AlphaMode::Blend,
                double_sided: true,
                ..Material::default()
            },
        ),
        ("dented", ball(), Material { occlusion, ..Material::from_color(Vec3::new(0.7, 0.6, 0.5)) }),
        ("posed", posed(ball()), Material::from_color(Vec3::new(0.3, 0.6, 0.4))),
    ];
    for (i, (name, mesh, material)) in (-2_i8..).zip(objects) {
        let is_flat = matches!(name, "fence" | "pane");
        let object = scene.add_object(name, mesh, material);
        if let Some(node) = scene.node_mut(object) {
            let tilt = if is_flat { DQuat::from_rotation_x(1.2) } else { DQuat::IDENTITY };
            let place = DVec3::new(f64::from(i) * 1.35, 0.65, 0.0);
            node.transform = Transform::from_scale_rotation_translation(DVec3::ONE, tilt, place);
            node.morph_weights = if name == "posed" { vec![0.5] } else { Vec::new() };
        }
    }
    light(&mut scene);
    let camera = Camera::look_at(DVec3::new(0.3, 2.2, 7.6), DVec3::new(0.0, 0.5, 0.0), DVec3::Y);
    Subject { scene, camera, only: None }
}

/// What a modelling program exports: a lamp of 1000 W in candela.
fn candela() -> Subject {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(7.0, 7.0), Material::from_color(Vec3::splat(0.6)));
    let colors = [Vec3::new(0.7, 0.2, 0.15), Vec3::new(0.25, 0.5, 0.3), Vec3::new(0.2, 0.35, 0.6)];
    for (i, color) in (-1_i8..).zip(colors) {
        let ball = scene.add_object("ball", primitives::uv_sphere(0.6, 96, 48), Material::from_color(color));
        if let Some(node) = scene.node_mut(ball) {
            node.transform = Transform::from_translation(DVec3::new(f64::from(i) * 1.5, 0.6, 0.0));
        }
    }
    let lamp = Light::point(54_350.0 / std::f32::consts::PI);
    scene.add(Node::from_light(lamp).at(DVec3::new(4.0, 6.0, 3.0)));
    let camera = Camera::look_at(DVec3::new(0.3, 2.2, 7.0), DVec3::new(0.0, 0.4, 0.0), DVec3::Y);
    Subject { scene, camera, only: Some(Effect::LightMeter) }
}

/// With a colour at each corner, by its direction.
fn painted(mut mesh: Mesh) -> Mesh {
    let color = |vertex: &u32| (mesh.positions()[*vertex as usize].normalize() * 0.5 + 0.5).extend(1.0);
    let corner_colors = Some(mesh.corner_vertices().iter().map(color).collect());
    let attributes = Attributes { corner_colors, ..mesh.attributes().clone() };
    mesh.set_attributes(attributes).expect("one colour for each corner");
    mesh
}

/// With a shape to move towards: upwards by what it is wide there.
fn posed(mut mesh: Mesh) -> Mesh {
    let rise = |place: &Vec3| Vec3::Y * (place.x * place.x + place.z * place.z);
    let positions = Deltas::from_dense(mesh.positions().iter().map(rise));
    let target = MorphTarget { positions, ..MorphTarget::default() };
    let attributes = Attributes { morph_targets: vec![target], ..mesh.attributes().clone() };
    mesh.set_attributes(attributes).expect("one for each vertex");
    mesh
}

/// Bars with holes between them.
fn holes(x: u32, y: u32) -> [u8; 4] {
    let is_bar = x % 64 < 24 || y % 64 < 24;
    [150, 110, 70, if is_bar { 255 } else { 0 }]
}

fn light(scene: &mut Scene) {
    let place = DVec3::new(3.0, 5.0, 3.5);
    let turned = Camera::look_at(place, DVec3::ZERO, DVec3::Y).orientation;
    let sun = Transform::from_scale_rotation_translation(DVec3::ONE, turned, place);
    scene.add(Node::from_light(Light::directional(0.8)).with_transform(sun));
    scene.add(Node::from_light(Light::ambient(0.25)));
}

fn texture(format: TextureFormat, texel: fn(u32, u32) -> [u8; 4]) -> Texture {
    let texels = (0..256).flat_map(|y| (0..256).map(move |x| texel(x, y))).collect();
    Texture::new(256, 256, texels, format).expect("the size is in range")
}

fn checker(x: u32, y: u32) -> [u8; 4] {
    if (x / 32 + y / 32).is_multiple_of(2) { [214, 205, 190, 255] } else { [74, 96, 118, 255] }
}

/// Round dents.
fn bumps(x: u32, y: u32) -> [u8; 4] {
    let tilt = |i: u32| (i % 32) as f32 / 16.0 - 1.0;
    let (dx, dy) = (tilt(x), tilt(y));
    let inside = dx * dx + dy * dy < 0.8;
    let normal = if inside { Vec3::new(dx * 0.6, -dy * 0.6, 1.0).normalize() } else { Vec3::Z };
    let [r, g, b] = (normal * 127.5 + 127.5).to_array().map(|channel| channel as u8);
    [r, g, b, 255]
}
