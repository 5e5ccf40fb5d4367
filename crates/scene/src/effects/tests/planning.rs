//! Plans, and what is off.

use crate::effect::Effect;
use crate::material::MaterialTexture;
use crate::work::{Work, done};
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_mesh::{Deltas, Mesh, MorphTarget};
use trigon_raster::Stats;

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
        Effect::LightMeter => (material, lights) = (lit, vec![Light::point(3000.0)]),
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
                base_color_texture: Some(TextureBinding::new(scene.add_texture("veil", veil()))),
                ..plain.clone()
            };
        }
        Effect::Transparency => {
            material =
                Material { base_color: Vec4::splat(0.5), alpha_mode: AlphaMode::Blend, ..plain.clone() };
        }
        Effect::Environment => {
            material = lit;
            effects.environment = Some(Arc::new(Environment::uniform(Vec3::ONE)));
        }
        Effect::MetalStudio => (material, lighting) = (metal(1.0), Lighting::Studio),
        Effect::ShadowMaps | Effect::ShadowRays => {
            (material, lights) = (lit, vec![Light::point(3.0)]);
            effects.shadows =
                if effect == Effect::ShadowRays { Shadows::Rays } else { Shadows::Maps { resolution: 64 } };
        }
        Effect::SoftShadows => {
            (material, lights) = (lit, vec![Light::point(3.0).with_radius(0.3)]);
            effects.shadows = Shadows::Rays;
        }
        Effect::AmbientOcclusion => {
            (material, lights) = (lit, vec![Light::ambient(1.0)]);
            effects.ambient_occlusion = Some(AmbientOcclusion::new(4, 1.0));
        }
        Effect::Reflection | Effect::Refraction => {
            let metallic = if effect == Effect::Reflection { 1.0 } else { 0.0 };
            material = Material { transmission: 1.0 - metallic, ..metal(metallic) };
            (effects.sight, lights) = (SightRays::all(2), vec![Light::ambient(1.0)]);
        }
        Effect::Fog => effects.fog = Some(Fog { color: Vec3::ONE, density: 0.1 }),
        Effect::ToneMapping => effects.exposure = Exposure::Stops(1.0),
        Effect::Edges => style = Style::SurfaceWithEdges,
        Effect::VertexColors | Effect::Poses | Effect::Outline => {}
    }
    let mut without = scene.clone();
    without.add_object("ball", ball.clone(), plain);
    let mut ball = ball;
    if effect == Effect::VertexColors {
        let corner_colors = Some(vec![Vec4::new(1.0, 0.5, 1.0, 1.0); ball.corner_count()]);
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

/// One texel through which half of what lies behind it shows.
fn veil() -> Texture {
    Texture::new(1, 1, vec![[255, 255, 255, 128]], TextureFormat::Srgb).expect("one texel")
}

/// The promise of the planner: what is off takes nothing, whatever else is on.
#[test]
fn off_means_zero() {
    for made_for in Effect::ALL {
        for (scene, settings) in with(made_for) {
            let mut renderer = Renderer::new(settings.clone());
            renderer.render(&scene, &from_front()).expect("drawn");
            let plan = renderer.plan().expect("there was an image").clone();
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
        Work::LampLight => &[Effect::Lamps],
        Work::AmbientLight => &[Effect::AmbientLight],
        Work::LightMeter => &[Effect::LightMeter],
        Work::Highlight => &[Effect::Highlights],
        Work::TextureLookUp(place) => match place.row().effect {
            Effect::NormalMaps => &[Effect::NormalMaps],
            Effect::OcclusionMaps => &[Effect::OcclusionMaps],
            Effect::Emission => &[Effect::Emission],
            Effect::Refraction => &[Effect::Refraction],
            _ => &[Effect::Textures],
        },
        Work::Blend => &[Effect::Transparency],
        Work::Mask => &[Effect::Masks],
        Work::Emission => &[Effect::Emission],
        Work::Tangents => &[Effect::NormalMaps],
        Work::VertexColors => &[Effect::VertexColors],
        Work::Pose => &[Effect::Poses],
        Work::ShadowMap | Work::ShadowLookUp => &[Effect::ShadowMaps],
        Work::ShadowRay => &[Effect::ShadowRays],
        Work::SoftShadowRay | Work::PenumbraLookUp => &[Effect::SoftShadows],
        Work::OcclusionRay => &[Effect::AmbientOcclusion],
        Work::SightRay => &[Effect::Reflection, Effect::Refraction],
        Work::EnvironmentLight => &[Effect::Environment],
        Work::StudioLight => &[Effect::MetalStudio],
        Work::Fog => &[Effect::Fog],
        Work::ToneMapping => &[Effect::ToneMapping],
        Work::Outline => &[Effect::Outline],
    }
}

/// What was done for an image.
struct Done {
    plan: EffectPlan,
    work: Vec<Work>,
    /// What the rasterizer counts itself.
    stats: Stats,
}

impl Done {
    fn of(scene: &Scene, settings: &RenderSettings) -> Self {
        let one = NonZeroUsize::new(1);
        let mut renderer = Renderer::new(RenderSettings { threads: one, ..settings.clone() });
        done::take();
        renderer.render(scene, &from_front()).expect("drawn");
        let plan = renderer.plan().expect("drawn").clone();
        Self { plan, work: done::take(), stats: *renderer.stats() }
    }

    /// Whether anything was done for an effect.
    fn has(&self, effect: Effect) -> bool {
        match effect {
            Effect::Edges => self.stats.triangles_edged > 0,
            Effect::Transparency if self.stats.pixels_blended > 0 => true,
            _ => self.work.iter().any(|work| reasons(*work).contains(&effect)),
        }
    }

    /// Fails if anything was done for no effect that is on.
    fn check(&self, what: &str) {
        for &work in &self.work {
            let is_due = reasons(work).iter().any(|effect| self.plan.is_on(*effect));
            assert!(is_due, "{work:?} is done for no effect that is on ({what}): {}", self.plan);
        }
        for effect in [Effect::Edges, Effect::Transparency] {
            assert!(self.plan.is_on(effect) || !self.has(effect), "{effect} is off and done ({what})");
        }
    }
}

/// The same by what is done while an image is drawn, whatever the plan and the counts say.
#[test]
fn what_is_off_is_not_done() {
    for made_for in Effect::ALL {
        let [off, on] = with(made_for).map(|(scene, settings)| Done::of(&scene, &settings));
        off.check(&format!("without {made_for}"));
        on.check(&format!("with {made_for}"));
        assert!(!off.has(made_for), "{made_for} is off and done: {:?}", off.work);
        assert!(on.has(made_for), "{made_for} is on and not done: {:?}", on.work);
        assert!(on.plan.is_on(made_for), "{made_for}: {}", on.plan.decision(made_for));
    }
}

/// A scene of one ball, in any material, light and style.
fn any_scene() -> impl Strategy<Value = (Scene, RenderSettings)> {
    let flag = any::<bool>;
    let factor = || prop_oneof![Just(0.0_f32), Just(1.0), 0.0_f32..1.0];
    let shading = (0..4_u8, factor(), factor(), factor()).prop_map(
        |(kind, metallic, roughness, specular)| match kind {
            0 => Shading::Unlit,
            1 => Shading::Lambert,
            2 => Shading::blinn_phong(Vec3::splat(specular), 20.0 * roughness),
            _ => Shading::MetallicRoughness(MetallicRoughness {
                metallic,
                roughness,
                specular,
                ..MetallicRoughness::default()
            }),
        },
    );
    let alpha_mode = prop_oneof![
        Just(AlphaMode::Opaque),
        Just(AlphaMode::Blend),
        factor().prop_map(|cutoff| AlphaMode::Mask { cutoff })
    ];
    let textures = prop::collection::vec(prop::bool::weighted(0.3), MaterialTexture::ALL.len());
    let material = (shading, alpha_mode, textures, (factor(), factor(), factor()), flag()).prop_map(
        |(shading, alpha_mode, textures, (emission, transmission, strength), double_sided)| {
            let emissive = Vec3::splat(emission);
            let material =
                Material { shading, alpha_mode, emissive, transmission, double_sided, ..Material::default() };
            (material, textures, strength)
        },
    );
    let lights = (prop::option::of(factor()), prop::option::of(factor()), 0..3_u8);
    let effects = (0..3_u8, flag(), flag(), flag(), 0..3_u32, flag());
    let style = prop::sample::select(vec![
        Style::Surface,
        Style::Surface,
        Style::SurfaceWithEdges,
        Style::HiddenLine,
    ]);
    let model = prop::sample::select(vec![
        ShadingModel::Flat,
        ShadingModel::Gouraud,
        ShadingModel::Phong,
        ShadingModel::Phong,
    ]);
    (material, lights, effects, (style, model), (flag(), flag())).prop_map(
        |(
            (mut material, textures, strength),
            (lamp, ambient, lighting),
            effects,
            (style, model),
            (colored, posed),
        )| {
            let mut scene = Scene::new();
            let binding = TextureBinding::new(scene.add_texture("grey", grey()));
            for (place, is_there) in MaterialTexture::ALL.into_iter().zip(textures) {
                material.set_texture(place, is_there.then_some(binding));
            }
            material.occlusion = material.occlusion.map(|map| Occlusion { strength, ..map });
            let ball = scene.add_object("ball", painted_ball(colored, posed), material);
            scene.node_mut(ball).expect("just added").morph_weights = if posed { vec![0.5] } else { vec![] };
            let point = |intensity| Light::point(intensity).with_radius(if posed { 0.2 } else { 0.0 });
            for light in [lamp.map(point), ambient.map(Light::ambient)].into_iter().flatten() {
                scene.add(Node::from_light(light).at(DVec3::new(0.0, 0.0, 3.0)));
            }
            let lighting = [Lighting::Scene, Lighting::Automatic, Lighting::Studio][usize::from(lighting)];
            let (shadows, environment, occlusion, fog, bounces, outline) = effects;
            let effects = EffectSettings {
                shadows: [Shadows::Off, Shadows::Rays, Shadows::Maps { resolution: 16 }]
                    [usize::from(shadows)],
                environment: environment.then(|| Arc::new(Environment::uniform(Vec3::ONE))),
                ambient_occlusion: occlusion.then_some(AmbientOcclusion {
                    sampling: [RaySampling::Full, RaySampling::Shared][usize::from(outline)],
                    ..AmbientOcclusion::new(2, 1.0)
                }),
                soft_shadows: SoftShadows {
                    rays: 2,
                    sampling: [RaySampling::Full, RaySampling::Shared][usize::from(fog)],
                    ..SoftShadows::default()
                },
                fog: fog.then_some(Fog { color: Vec3::ONE, density: 0.1 }),
                outline: outline.then(|| Outline { nodes: vec![ball], color: Vec3::X, width: 2 }),
                sight: if bounces == 1 { SightRays::default() } else { SightRays::all(bounces) },
                ..EffectSettings::default()
            };
            let settings = RenderSettings {
                style,
                lighting,
                shading: model,
                width: 24,
                height: 24,
                ..settings(effects)
            };
            (scene, settings)
        },
    )
}

fn painted_ball(colored: bool, posed: bool) -> Mesh {
    let mut ball = primitives::uv_sphere(1.0, 12, 6);
    let corner_colors = colored.then(|| vec![Vec4::ONE; ball.corner_count()]);
    let positions = Deltas::from_dense(vec![Vec3::X; ball.vertex_count()]);
    let morph_targets =
        if posed { vec![MorphTarget { positions, ..MorphTarget::default() }] } else { vec![] };
    ball.set_attributes(Attributes { corner_colors, morph_targets, ..ball.attributes().clone() })
        .expect("one each");
    ball
}

proptest! {
    #[test]
    fn what_is_off_is_not_done_whatever_a_scene_has((scene, settings) in any_scene()) {
        let done = Done::of(&scene, &settings);
        done.check("any scene");
        let mut renderer = Renderer::new(settings);
        renderer.render(&scene, &from_front()).expect("drawn");
        for effect in Effect::ALL {
            let is_zero = renderer.effect_counts(effect) == EffectCounts::default();
            prop_assert!(done.plan.is_on(effect) || is_zero, "{} is off: {:?}", effect, renderer.effect_counts(effect));
        }
    }
}

/// Textures that nothing shows are no reason to prepare their coordinates.
#[test]
fn a_texture_without_effect_is_neither_planned_nor_looked_up() {
    let maps_of = |shading: Shading, lights: &[Light], strength: f32| {
        let mut scene = Scene::new();
        let binding = TextureBinding::new(scene.add_texture("grey", grey()));
        let occlusion = Some(Occlusion { binding, strength });
        scene.add_object(
            "ball",
            painted_ball(false, false),
            Material { shading, occlusion, ..Material::default() },
        );
        for &light in lights {
            scene.add(Node::from_light(light).at(DVec3::Z * 3.0));
        }
        let done = Done::of(&scene, &settings(EffectSettings::default()));
        let looked_up = done.work.contains(&Work::TextureLookUp(MaterialTexture::Occlusion));
        let planned = [Effect::Textures, Effect::OcclusionMaps].map(|effect| done.plan.is_on(effect));
        assert_eq!(planned, [looked_up; 2], "{}", done.plan);
        looked_up
    };
    let [lamp, ambient] = [Light::point(3.0), Light::ambient(1.0)];
    assert!(!maps_of(Shading::Unlit, &[lamp, ambient], 1.0), "no light");
    assert!(!maps_of(Shading::Lambert, &[lamp], 1.0), "no ambient light");
    assert!(!maps_of(Shading::Lambert, &[lamp, ambient], 0.0), "no strength");
    assert!(maps_of(Shading::Lambert, &[lamp, ambient], 1.0), "all that it needs");
}

/// Nothing is prepared for light that no material takes.
#[test]
fn an_unlit_material_takes_no_effect_of_light() {
    let of_light = [
        Effect::Lamps,
        Effect::AmbientLight,
        Effect::LightMeter,
        Effect::Highlights,
        Effect::NormalMaps,
        Effect::OcclusionMaps,
        Effect::Environment,
        Effect::MetalStudio,
        Effect::ShadowMaps,
        Effect::ShadowRays,
        Effect::SoftShadows,
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
    assert_eq!(count, 18, "all but those that are the scene itself");
}

#[test]
fn what_is_out_of_view_is_named() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 8, 4), matt(Vec3::ONE));
    let glass = Material { base_color: Vec4::splat(0.5), alpha_mode: AlphaMode::Blend, ..matt(Vec3::ONE) };
    let pane = scene.add_object("pane", primitives::plane(1.0, 1.0), glass);
    scene.node_mut(pane).expect("just added").transform = Transform::from_translation(DVec3::X * 50.0);
    let plan = EffectPlan::new(&scene, &from_front(), &settings(EffectSettings::default()));
    let said = plan.decision(Effect::Transparency).to_string();
    assert_eq!(said, "off, because the only object that has it, `pane`, is outside the view", "named");
    assert_eq!(plan.to_string().lines().count(), Effect::ALL.len(), "a line for each");
}
