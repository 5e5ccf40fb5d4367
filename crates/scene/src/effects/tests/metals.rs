//! Metals in a scene that says nothing of what is around them.

use super::*;
use crate::effect::Effect;
use crate::effects::MetalStudio;
use crate::lighting::{Lamp, LampSource, Lights};
use crate::{Outputs, SimdLevel};

fn in_the_studio(metal_reflection: MetalReflection) -> RenderSettings {
    let outputs = Outputs { radiance: true, normals: true, ids: true, ..Outputs::default() };
    let effects = EffectSettings { metal_reflection, ..EffectSettings::default() };
    RenderSettings { lighting: Lighting::Automatic, outputs, ..settings(effects) }
}

fn of_roughness(metallic: f32, roughness: f32) -> Material {
    let model = MetallicRoughness { metallic, roughness, ..MetallicRoughness::default() };
    Material { base_color: Vec4::ONE, shading: Shading::MetallicRoughness(model), ..Material::default() }
}

fn ball(material: Material) -> Scene {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.9, 128, 64), material);
    scene
}

/// By the law of reflection, +Y of the world up, wherever the camera is; traced by rays
/// or not.
#[test]
fn a_white_mirror_shows_the_studio() {
    let studio = MetalStudio::new(&trigon_math::Mat3::IDENTITY, 1.0);
    let scene = ball(metal(1.0));
    for (camera, bounces) in [(from_front(), 0), (from_above(), 0), (from_above(), 2)] {
        let mut settings = in_the_studio(MetalReflection::Studio);
        settings.effects.sight = SightRays::all(bounces);
        let frame = render(&scene, &camera, &settings).expect("drawn");
        let (radiance, normals) = (frame.radiance.expect("asked for"), frame.normals.expect("asked for"));
        let view = -camera.forward().as_vec3();
        let lamps: Vec<Vec3> = Lights::studio().lamps.iter().map(in_the_world(&camera)).collect();
        let mut count = 0;
        for (pixel, (light, normal)) in radiance.iter().zip(&normals).enumerate() {
            let towards = *normal * (2.0 * normal.dot(view)) - view;
            // Not on highlights, nor where the table of reflectance bends at grazing angles.
            let near_lamp = lamps.iter().any(|lamp| lamp.dot(towards) > 0.9);
            if normal.dot(view) < 0.2 || near_lamp {
                continue;
            }
            let found = [camera.right(), camera.up()].map(|axis| normal.as_dvec3().dot(axis));
            let off = [0, 1].map(|axis| (found[axis] - on_ball(pixel, 1.9)[axis]).abs());
            // As below.
            assert!(off[0].max(off[1]) < 0.01, "the normal {normal} is {off:?} off");
            let (shown, exact) = (light.truncate(), studio.radiance(towards));
            let error = (shown - exact).abs().max_element();
            // The normals of the ball's faces are up to a hundredth askew near its poles.
            assert!(error < 0.02, "{towards}, {bounces} bounces: {shown}, not {exact}");
            count += 1;
        }
        assert!(count > 5000, "most of the ball was seen: {count} pixels");
    }
}

fn in_the_world(camera: &Camera) -> impl Fn(&Lamp) -> Vec3 {
    let turn = camera.orientation.as_quat();
    move |lamp| match lamp.source {
        LampSource::Directional(towards) => turn * towards,
        LampSource::Point { .. } => panic!("lamps of the studio are parallel"),
    }
}

/// Metals were baby blue, among them the default material of glTF.
#[test]
fn white_metals_are_grey() {
    for roughness in [0.0, 0.3, 0.6, 1.0] {
        let scene = ball(of_roughness(1.0, roughness));
        let frame = render(&scene, &from_front(), &in_the_studio(MetalReflection::Studio)).expect("drawn");
        let mut lit = 0;
        for pixel in frame.color.chunks(4) {
            assert!(pixel[0] == pixel[1] && pixel[1] == pixel[2], "{roughness}: {pixel:?}");
            lit += usize::from(pixel[0] > 60);
        }
        // The ball covers 11,600 pixels, and the darkest light around it has 105 of 255 levels.
        assert!(lit > 11_000, "{roughness}: {lit} pixels are lit");
    }
}

/// The complaint: metals were black but for their highlights.
#[test]
fn metals_are_not_black() {
    for roughness in [0.0, 0.3, 0.6, 1.0] {
        let scene = ball(of_roughness(1.0, roughness));
        let mean = |way| {
            let frame = render(&scene, &from_front(), &in_the_studio(way)).expect("drawn");
            let radiance = frame.radiance.expect("asked for");
            let seen = || radiance.iter().zip(frame.object_ids.as_ref().expect("asked for"));
            let shown: Vec<f32> =
                seen().filter(|(_, id)| **id != u32::MAX).map(|(light, _)| light.y.min(1.0)).collect();
            shown.iter().sum::<f32>() / shown.len() as f32
        };
        let (with, without) = (mean(MetalReflection::Studio), mean(MetalReflection::Ambient));
        assert!(with > 0.3 && with > without, "roughness {roughness}: {with}, and {without} without");
    }
}

#[test]
fn nothing_but_metal_changes_by_the_studio() {
    let mut scene = Scene::new();
    let texture = Texture::new(2, 1, vec![[255, 255, 255, 255], [255, 255, 0, 255]], TextureFormat::Linear);
    let halves = scene.add_texture("metal on the left", texture.expect("two texels"));
    let model = MetallicRoughness {
        metallic: 1.0,
        roughness: 0.4,
        texture: Some(TextureBinding::new(halves)),
        ..MetallicRoughness::default()
    };
    let glossy = Shading::blinn_phong(Vec3::ONE, 20.0);
    let materials = [
        of_roughness(0.0, 0.0),
        of_roughness(0.0, 0.7),
        Material { shading: glossy, ..Material::default() },
        matt(Vec3::ONE),
        Material { transmission: 1.0, ..of_roughness(0.0, 0.0) },
        Material { shading: Shading::MetallicRoughness(model), ..Material::default() },
    ];
    let count = materials.len();
    for (place, material) in materials.into_iter().enumerate() {
        let ball = scene.add_object("ball", primitives::uv_sphere(0.4, 48, 24), material);
        let [x, y] = [place % 3, place / 3].map(|step| step as f64 * 1.2 - 1.2);
        scene.node_mut(ball).expect("just added").transform =
            Transform::from_translation(DVec3::new(x, y, 0.0));
    }
    for (shading, bounces) in [(ShadingModel::Phong, 0), (ShadingModel::Phong, 2), (ShadingModel::Gouraud, 0)]
    {
        let [with, without] = [MetalReflection::Studio, MetalReflection::Ambient].map(|way| {
            let mut settings = RenderSettings { shading, ..in_the_studio(way) };
            settings.effects.sight = SightRays::all(bounces);
            render(&scene, &from_front(), &settings).expect("drawn")
        });
        let ids = with.object_ids.as_ref().expect("asked for");
        let different = |object: usize| {
            let pixels = ids.iter().zip(with.color.chunks(4).zip(without.color.chunks(4)));
            pixels.filter(|(id, (with, without))| **id as usize == object && with != without).count()
        };
        let changed: Vec<usize> = (0..count).map(different).collect();
        let (last, others) = changed.split_last().expect("six");
        assert!(others.iter().all(|&count| count == 0), "{shading:?}, {bounces} bounces: {changed:?}");
        let seen = ids.iter().filter(|&&id| id as usize == count - 1).count();
        if shading == ShadingModel::Phong {
            assert!(*last > seen / 4 && *last < seen * 3 / 4, "the metal half of it: {last} of {seen}");
        }
    }
}

#[test]
fn metals_are_the_same_at_every_level_and_with_any_threads() {
    let scene = ball(of_roughness(0.8, 0.37));
    let draw = |simd, threads| {
        let threads = std::num::NonZeroUsize::new(threads);
        let settings = RenderSettings { simd, threads, ..in_the_studio(MetalReflection::Studio) };
        render(&scene, &from_front(), &settings).expect("drawn").radiance
    };
    let expected = draw(None, 1);
    for level in SimdLevel::ALL.into_iter().filter(|level| level.is_supported()) {
        assert!(draw(Some(level), 3) == expected, "{level:?} and three threads change the image");
    }
}

#[test]
fn the_plan_says_why_metals_mirror_the_studio_or_not() {
    let said = |scene: &Scene, settings: &RenderSettings| {
        EffectPlan::new(scene, &from_front(), settings).decision(Effect::MetalStudio).to_string()
    };
    let studio = in_the_studio(MetalReflection::Studio);
    let mut scene = ball(matt(Vec3::ONE));
    assert_eq!(said(&scene, &studio), "off, because no metal is visible", "a matt ball");
    scene.add_object("coin", primitives::uv_sphere(1.0, 8, 4), metal(0.5));
    assert_eq!(said(&scene, &studio), "on, because `coin` is metal, and the scene has no environment", "one");
    let other = scene.add_object("other", primitives::uv_sphere(1.0, 8, 4), metal(1.0));
    let two = "on, because 2 objects in view are metal, such as `coin`, and the scene has no environment";
    assert_eq!(said(&scene, &studio), two, "two");
    scene.node_mut(other).expect("just added").transform = Transform::from_translation(DVec3::X * 50.0);
    assert!(said(&scene, &studio).contains("`coin` is metal"), "one of them in view");
    let ambient = in_the_studio(MetalReflection::Ambient);
    assert_eq!(said(&scene, &ambient), "off, because the settings do not request it", "as asked");
    let as_matt = RenderSettings { reflection: crate::Reflection::Lambert, ..studio.clone() };
    assert_eq!(said(&scene, &as_matt), "off, because no metal is visible", "drawn as no metal");
    let mut surrounded = studio.clone();
    surrounded.effects.environment = Some(Arc::new(Environment::uniform(Vec3::ONE)));
    assert_eq!(said(&scene, &surrounded), "off, because the environment takes its place", "an environment");
    scene.add(Node::from_light(Light::directional(1.0)));
    assert!(said(&scene, &studio).starts_with("on"), "lamps say nothing of what is around");
    let alone = RenderSettings { lighting: Lighting::Scene, ..studio.clone() };
    assert_eq!(said(&scene, &alone), "off, because there is no ambient light", "nothing is added");
    scene.add(Node::from_light(Light::ambient(0.3)));
    assert_eq!(said(&scene, &studio), "off, because the scene has ambient light of its own", "it says so");
    assert!(
        said(&scene, &RenderSettings { lighting: Lighting::Studio, ..studio }).starts_with("on"),
        "put out"
    );
}
