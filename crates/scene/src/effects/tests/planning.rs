//! Plans, and what is off.

use crate::effect::Effect;
use crate::effects::work::{Work, done};
use std::num::NonZeroUsize;
use trigon_mesh::{Deltas, MorphTarget};

use super::*;

/// A scene in which the effect is off, and one in which it is on.
fn with(effect: Effect) -> [(Scene, RenderSettings); 2] {
    let mut scene = Scene::new();
    let ball = primitives::uv_sphere(1.0, 24, 12);
    let texture = scene.add_texture("grey", grey());
    let binding = TextureBinding::new(texture);
    let plain = Material { shading: Shading::Unlit, double_sided: false, ..Material::default() };
    let mut material = Material { base_color: Vec4::ONE, ..plain.clone() };
    let mut effects = EffectSettings::default();
    let (mut style, mut lighting) = (Style::Surface, Lighting::Scene);
    let mut lights = vec![];
    let lit = Material { shading: Shading::Lambert, ..plain.clone() };
    match effect {
        Effect::Lamps => (material, lights) = (lit, vec![Light::point(3.0)]),
        Effect::AmbientLight => (material, lights) = (lit, vec![Light::ambient(0.5)]),
        Effect::Highlights => (material, lights) = (Material::default(), vec![Light::point(3.0)]),
        Effect::Textures => material.base_color_texture = Some(binding),
        Effect::NormalMaps => {
            material = Material { normal_map: Some(NormalMap { binding, scale: 1.0 }), ..lit };
            lights = vec![Light::point(3.0)];
        }
        Effect::OcclusionMaps => {
            material = Material { occlusion: Some(Occlusion { binding, strength: 1.0 }), ..lit };
            lights = vec![Light::ambient(1.0)];
        }
        Effect::Emission => {
            material = Material { emissive: Vec3::ONE, emissive_texture: Some(binding), ..plain.clone() };
        }
        Effect::Masks => {
            material = Material {
                alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
                base_color_texture: Some(binding),
                ..plain.clone()
            };
        }
        Effect::Transparency => material.alpha_mode = AlphaMode::Blend,
        Effect::Environment => {
            material = lit;
            effects.environment = Some(Arc::new(Environment::uniform(Vec3::ONE)));
        }
        Effect::MetalSky => (material, lighting) = (metal(1.0), Lighting::Studio),
        Effect::ShadowMaps | Effect::ShadowRays => {
            (material, lights) = (lit, vec![Light::point(3.0)]);
            effects.shadows =
                if effect == Effect::ShadowRays { Shadows::Rays } else { Shadows::Maps { resolution: 64 } };
        }
        Effect::AmbientOcclusion => {
            (material, lights) = (lit, vec![Light::ambient(1.0)]);
            effects.ambient_occlusion = Some(AmbientOcclusion { rays: 4, distance: 1.0 });
        }
        Effect::Reflection | Effect::Refraction => {
            let metallic = if effect == Effect::Reflection { 1.0 } else { 0.0 };
            material = Material { transmission: 1.0 - metallic, ..metal(metallic) };
            (effects.bounces, lights) = (2, vec![Light::ambient(1.0)]);
        }
        Effect::Fog => effects.fog = Some(Fog { color: Vec3::ONE, density: 0.1 }),
        Effect::ToneMapping => effects.exposure = 1.0,
        Effect::Edges => style = Style::SurfaceWithEdges,
        Effect::VertexColors | Effect::Poses | Effect::Outline => {}
    }
    let mut without = scene.clone();
    without.add_object("ball", ball.clone(), plain);
    let mut ball = ball;
    if effect == Effect::VertexColors {
        let corner_colors = Some(vec![Vec4::ONE; ball.corner_count()]);
        ball.set_attributes(Attributes { corner_colors, ..ball.attributes().clone() }).expect("one each");
    }
    if effect == Effect::Poses {
        let positions = Deltas::from_dense(vec![Vec3::X; ball.vertex_count()]);
        let target = MorphTarget { positions, ..MorphTarget::default() };
        let attributes = Attributes { morph_targets: vec![target], ..ball.attributes().clone() };
        ball.set_attributes(attributes).expect("one delta each");
    }
    let ball = scene.add_object("ball", ball, material);
    scene.node_mut(ball).expect("just added").morph_weights = vec![0.5];
    if effect == Effect::Outline {
        effects.outline = Some(Outline { nodes: vec![ball], color: Vec3::X, width: 2 });
    }
    for light in lights {
        scene.add(Node::from_light(light).at(DVec3::new(0.0, 0.0, 3.0)));
    }
    let off = settings(EffectSettings::default());
    let on = RenderSettings { style, lighting, ..settings(effects) };
    [(without, off), (scene, on)]
}

fn grey() -> Texture {
    Texture::new(1, 1, vec![[128, 128, 255, 255]], TextureFormat::Linear).expect("one texel")
}

/// The promise of the planner: what is off takes nothing, whatever else is on.
#[test]
fn off_means_zero() {
    for made_for in Effect::ALL {
        for (scene, settings) in with(made_for) {
            let mut renderer = Renderer::new(settings.clone());
            renderer.render(&scene, &from_front()).expect("drawn");
            let plan = renderer.plan().expect("there was a picture").clone();
            assert_eq!(plan, EffectPlan::new(&scene, &from_front(), &settings), "the plan is a function");
            for effect in Effect::ALL {
                let counts = renderer.effect_counts(effect);
                let none = counts == EffectCounts::default();
                assert!(plan.is_on(effect) || none, "{effect} is off and took {counts:?} ({made_for})");
            }
        }
        let [(scene, settings), on] = with(made_for);
        let plan = EffectPlan::new(&scene, &from_front(), &settings);
        assert!(!plan.is_on(made_for), "{made_for}: {}", plan.decision(made_for));
        let mut renderer = Renderer::new(on.1);
        renderer.render(&on.0, &from_front()).expect("drawn");
        let decision = renderer.plan().expect("drawn").decision(made_for).clone();
        assert!(matches!(decision, Decision::On(_)), "{made_for}: {decision}");
        let counts = renderer.effect_counts(made_for);
        assert_ne!(counts, EffectCounts::default(), "{made_for} is on and takes something");
    }
}

/// For which effects each kind of work may be done.
fn reasons(work: Work) -> &'static [Effect] {
    match work {
        Work::TextureLookUp => &[
            Effect::Textures,
            Effect::NormalMaps,
            Effect::OcclusionMaps,
            Effect::Emission,
            Effect::Masks,
            Effect::Highlights,
        ],
        Work::Tangents => &[Effect::NormalMaps],
        Work::VertexColors => &[Effect::VertexColors],
        Work::Pose => &[Effect::Poses],
        Work::ShadowMap | Work::ShadowLookUp => &[Effect::ShadowMaps],
        Work::ShadowRay => &[Effect::ShadowRays],
        Work::OcclusionRay => &[Effect::AmbientOcclusion],
        Work::SightRay => &[Effect::Reflection, Effect::Refraction],
        Work::EnvironmentLight => &[Effect::Environment],
        Work::SkyLight => &[Effect::MetalSky],
        Work::Fog => &[Effect::Fog],
        Work::ToneMapping => &[Effect::ToneMapping],
        Work::Outline => &[Effect::Outline],
    }
}

/// The same by what is done while a picture is drawn, whatever the plan and the counts say.
#[test]
fn what_is_off_is_not_done() {
    let mut missed = Vec::new();
    for made_for in Effect::ALL {
        let [off, on] = with(made_for).map(|(scene, settings)| {
            let mut renderer = Renderer::new(RenderSettings { threads: NonZeroUsize::new(1), ..settings });
            done::take();
            renderer.render(&scene, &from_front()).expect("drawn");
            let plan = renderer.plan().expect("drawn").clone();
            let done = done::take();
            for &work in &done {
                let is_due = reasons(work).iter().any(|effect| plan.is_on(*effect));
                assert!(is_due, "{work:?} is done for no effect that is on ({made_for}): {plan}");
            }
            done
        });
        let has_work = |done: &[Work]| done.iter().any(|work| reasons(*work).contains(&made_for));
        assert!(!has_work(&off), "{made_for} is off and done: {off:?}");
        if !has_work(&on) {
            missed.push(made_for);
        }
    }
    // Light at vertices, what the rasterizer blends and the edges that it paints are noted nowhere.
    let unnoted =
        [Effect::Lamps, Effect::AmbientLight, Effect::Highlights, Effect::Transparency, Effect::Edges];
    assert_eq!(missed, unnoted, "all others are done where they are on");
}

/// Nothing is prepared for light that no material takes.
#[test]
fn an_unlit_material_takes_no_effect_of_light() {
    let of_light = [
        Effect::Lamps,
        Effect::AmbientLight,
        Effect::Highlights,
        Effect::NormalMaps,
        Effect::OcclusionMaps,
        Effect::Environment,
        Effect::MetalSky,
        Effect::ShadowMaps,
        Effect::ShadowRays,
        Effect::AmbientOcclusion,
        Effect::Reflection,
        Effect::Refraction,
    ];
    for made_for in of_light {
        let [_, (mut scene, settings)] = with(made_for);
        for (_, material) in scene.materials.iter_mut() {
            material.shading = Shading::Unlit;
        }
        let mut renderer = Renderer::new(RenderSettings { threads: NonZeroUsize::new(1), ..settings });
        done::take();
        renderer.render(&scene, &from_front()).expect("drawn");
        let plan = renderer.plan().expect("drawn");
        for effect in of_light {
            assert!(!plan.is_on(effect), "{effect}, in the scene of {made_for}: {}", plan.decision(effect));
        }
        assert_eq!(done::take(), [], "in the scene of {made_for}");
    }
}

#[test]
fn an_effect_that_is_left_out_is_off() {
    let mut count = 0;
    for effect in Effect::ALL {
        let [_, (scene, settings)] = with(effect);
        let Some((scene, settings)) = effect.left_out(&scene, &settings) else { continue };
        let plan = EffectPlan::new(&scene, &from_front(), &settings);
        assert!(!plan.is_on(effect), "{effect}: {}", plan.decision(effect));
        count += 1;
    }
    assert_eq!(count, 16, "all but those that are the scene itself");
}

#[test]
fn what_is_out_of_view_is_named() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 8, 4), matt(Vec3::ONE));
    let glass = Material { alpha_mode: AlphaMode::Blend, ..matt(Vec3::ONE) };
    let pane = scene.add_object("pane", primitives::plane(1.0, 1.0), glass);
    scene.node_mut(pane).expect("just added").transform = Transform::from_translation(DVec3::X * 50.0);
    let plan = EffectPlan::new(&scene, &from_front(), &settings(EffectSettings::default()));
    let said = plan.decision(Effect::Transparency).to_string();
    assert_eq!(said, "off, because the only object that has it, `pane`, is outside the view", "named");
    assert_eq!(plan.to_string().lines().count(), Effect::ALL.len(), "a line for each");
}
