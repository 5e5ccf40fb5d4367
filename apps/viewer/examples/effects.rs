//! Writes `docs/effects.md`: what each effect adds to a picture, why it was on, and
//! what it costs, on three scenes.
//!
//! `cargo run --release -p trigon-viewer --no-default-features --example effects -- docs`

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use trigon_camera::Camera;
use trigon_io::{Pixels, write_png};
use trigon_math::glam::Affine2;
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_scene::{
    AmbientOcclusion, Background, Effect, EffectPlan, Environment, Fog, Frame, Light, Lighting, Material,
    MetallicRoughness, Node, NodeId, NormalMap, Outline, RenderSettings, Renderer, Scene, Shading, Shadows,
    Sky, Style, Texture, TextureBinding, TextureFormat, ToneMapping, Transform, render, showcase,
};

/// Pictures of which the quickest counts.
const REPETITIONS: usize = 7;

/// A scene and how it is looked at.
struct Subject {
    name: &'static str,
    scene: Scene,
    camera: Camera,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("name the folder to write to, such as docs")?;
    let folder = Path::new(&folder);
    fs::create_dir_all(folder.join("effects"))?;
    let mut page = INTRODUCTION.to_owned();
    for subject in [exhibition(), materials(), knot()] {
        write!(page, "\n## {}\n\n{HEAD}", subject.name)?;
        for (effect, settings) in shown(&subject) {
            let plan = EffectPlan::new(&subject.scene, &subject.camera, &settings);
            let without = effect.left_out(&subject.scene, &settings).filter(|_| plan.is_on(effect));
            if let Some(without) = without {
                page.push_str(&row(
                    &subject,
                    (effect, &plan),
                    [&without.0, &subject.scene],
                    [&without.1, &settings],
                    folder,
                )?);
            }
        }
    }
    fs::write(folder.join("effects.md"), page)?;
    Ok(())
}

const INTRODUCTION: &str = "# Effects

Every effect is off until a scene and its settings call for it, and then takes
nothing: no attribute, texture, pass, ray or byte (test `off_means_zero`). Here
each effect is taken away from a picture that has it. Times are those of a picture of
480×300 pixels without anti-aliasing on one thread, the shortest of seven in turns;
percentages are of the picture without the effect.

This page is written by

    cargo run --release -p trigon-viewer --no-default-features --example effects -- docs

and `trigon-viewer FILE --explain=time` does the same for any model.

## How shadow maps are kept off their own surface

A map holds depths at the middles of its texels, and a point on the same plane lies
up to √2 texels aside. So points are moved along the normal of the surface, by √2 ·
sin θ texels, θ being the angle between normal and light, which is just what a plane
needs, and by a quarter of a texel for curvature and rounding. Nothing is added to
depths. A shadow begins at most 1.7 texels from what casts it. Rays need none of
this.

## What metals mirror

With lamps alone metals are black beside their highlights. Where a scene has neither an
environment nor ambient light of its own, and is not drawn by its own lights only
(`Lighting::Scene`), they mirror the built-in sky, +Y of the world up. It is mixed with
the ambient light that was added by how metallic a point is: dielectrics keep every byte,
and vectors of eight pixels without metal look nothing up. `--metal-reflection=ambient`
leaves it out. A default material of glTF is a metal, too.

Three balls of metal, of roughness 0, 0.35 and 0.7 on 43 % of 480×300 pixels, take 13 %
more instructions by it, and 15 million once, for the table of the sky, which is a quarter
of such a picture (callgrind, AVX2, one thread). Without metal in view there is neither.
";

const HEAD: &str =
    "| effect | without | with | why | ms without | ms with | cost |\n|---|---|---|---|---|---|---|\n";

fn row(
    subject: &Subject,
    (effect, plan): (Effect, &EffectPlan),
    scenes: [&Scene; 2],
    settings: [&RenderSettings; 2],
    folder: &Path,
) -> Result<String, Box<dyn Error>> {
    let slug = |way: &str| format!("{}-{effect}-{way}.png", subject.name).to_lowercase().replace(' ', "-");
    let [off, on] = [slug("without"), slug("with")];
    let shots = [(scenes[0], settings[0], &off), (scenes[1], settings[1], &on)];
    for (scene, settings, name) in shots {
        let smooth = RenderSettings { samples_per_axis: 3, width: 240, height: 150, ..settings.clone() };
        let frame = render(scene, &subject.camera, &smooth)?;
        let pixels = Pixels::Rgba8(&frame.color);
        write_png(folder.join("effects").join(name), frame.width, frame.height, pixels)?;
    }
    let [less, more] = milliseconds(shots.map(|(scene, settings, _)| (scene, settings)), &subject.camera)?;
    let percent = (more / less - 1.0) * 100.0;
    let why = plan.decision(effect);
    Ok(format!(
        "| {effect} | ![](effects/{off}) | ![](effects/{on}) | {why} | {less:.2} | {more:.2} | {percent:+.0} % |\n"
    ))
}

/// The shortest times of two pictures, drawn in turns, so that whatever else the
/// machine does meets both.
fn milliseconds(shots: [(&Scene, &RenderSettings); 2], camera: &Camera) -> Result<[f64; 2], Box<dyn Error>> {
    let mut kept = shots.map(|(_, settings)| (Renderer::new(settings.clone()), Frame::default()));
    let mut shortest = [f64::INFINITY; 2];
    for repetition in 0..=REPETITIONS {
        for (((renderer, frame), (scene, _)), shortest) in kept.iter_mut().zip(shots).zip(&mut shortest) {
            let start = Instant::now();
            renderer.render_into(scene, camera, frame)?;
            let time = start.elapsed().as_secs_f64() * 1e3;
            if repetition > 0 && time < *shortest {
                *shortest = time;
            }
        }
    }
    Ok(shortest)
}

/// Every effect that can be left out by itself, with settings that may have it.
fn shown(subject: &Subject) -> Vec<(Effect, RenderSettings)> {
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
    vec![
        asked(Effect::Highlights, &|_| {}),
        asked(Effect::Textures, &|_| {}),
        asked(Effect::NormalMaps, &|_| {}),
        asked(Effect::Emission, &|_| {}),
        asked(Effect::Environment, &|settings| {
            settings.effects.environment = Some(Arc::clone(&sky));
            settings.background = Background::Environment;
        }),
        // These scenes have ambient light of their own, which metals mirror otherwise.
        asked(Effect::MetalSky, &|settings| settings.lighting = Lighting::Studio),
        asked(Effect::ShadowMaps, &|settings| settings.effects.shadows = Shadows::Maps { resolution: 2048 }),
        asked(Effect::ShadowRays, &|settings| settings.effects.shadows = Shadows::Rays),
        asked(Effect::AmbientOcclusion, &|settings| {
            settings.effects.ambient_occlusion = Some(AmbientOcclusion { rays: 16, distance: 1.0 });
        }),
        asked(Effect::Reflection, &|settings| settings.effects.bounces = 4),
        asked(Effect::Refraction, &|settings| settings.effects.bounces = 4),
        asked(Effect::Fog, &|settings| {
            settings.effects.fog = Some(Fog { color: Vec3::new(0.5, 0.53, 0.57), density: 0.12 });
        }),
        asked(Effect::ToneMapping, &|settings| {
            settings.effects.exposure = 1.0;
            settings.effects.tone_mapping = ToneMapping::KhronosPbrNeutral;
        }),
        asked(Effect::Outline, &|settings| {
            let outline = Outline { nodes: first.clone(), color: Vec3::new(1.0, 0.45, 0.0), width: 3 };
            settings.effects.outline = Some(outline);
        }),
        asked(Effect::Edges, &|settings| settings.style = Style::SurfaceWithEdges),
    ]
}

/// The built-in scene.
fn exhibition() -> Subject {
    let scene = showcase();
    let camera = scene.cameras()[0].1;
    Subject { name: "Exhibition", scene, camera }
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
    Subject { name: "Materials", scene, camera }
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
    Subject { name: "Knot", scene, camera }
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
