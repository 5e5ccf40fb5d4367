//! What nobody can see is off, with the reason, and leaving it out changes no byte.

use proptest::prelude::*;
use trigon_mesh::Mesh;

use super::*;
use crate::effect::Effect;
use crate::material::MaterialTexture;
use crate::work::kept::with_everything;
use crate::{EffectCounts, Outputs, VertexPoints};

/// What a plan says of an effect of one ball in a material.
fn said(material: Material, effect: Effect) -> String {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 12, 6), material);
    scene.add(shining(Light::directional(1.0), DVec3::Z, DVec3::NEG_Z));
    decision(&scene, effect)
}

fn decision(scene: &Scene, effect: Effect) -> String {
    EffectPlan::new(scene, &from_front(), &settings(EffectSettings::default())).decision(effect).to_string()
}

/// One texel.
fn texture(scene: &mut Scene, texel: [u8; 4], format: TextureFormat) -> TextureBinding {
    let texture = Texture::new(1, 1, vec![texel], format).expect("one texel");
    TextureBinding::new(scene.add_texture("texel", texture))
}

#[test]
fn alpha_that_is_1_everywhere_neither_blends_nor_masks() {
    let blend = Material { alpha_mode: AlphaMode::Blend, ..matt(Vec3::ONE) };
    assert_eq!(
        said(blend.clone(), Effect::Transparency),
        "off, because the only object that has it, `ball`, has an alpha of 1 everywhere"
    );
    let mask = |cutoff| Material { alpha_mode: AlphaMode::Mask { cutoff }, ..matt(Vec3::ONE) };
    let no_hole = "off, because the only object that has it, `ball`, has no alpha below the cutoff";
    assert_eq!(said(mask(0.5), Effect::Masks), no_hole);
    assert_eq!(said(mask(1.0), Effect::Masks), no_hole, "alpha is just as large");
    let thin = Vec4::new(1.0, 1.0, 1.0, 0.5);
    assert_eq!(said(Material { base_color: thin, ..mask(0.5) }, Effect::Masks), no_hole);
    for cutoff in [0.51, f32::NAN] {
        let plan = said(Material { base_color: thin, ..mask(cutoff) }, Effect::Masks);
        assert_eq!(plan, "on, because `ball` has it", "{cutoff}");
    }
    let plan = said(Material { base_color: thin, ..blend }, Effect::Transparency);
    assert_eq!(plan, "on, because `ball` has it");
}

#[test]
fn textures_and_vertex_colors_decide_about_alpha_too() {
    let plan = |alpha: u8, vertex_alpha: f32, alpha_mode| {
        let mut scene = Scene::new();
        let binding = texture(&mut scene, [255, 255, 255, alpha], TextureFormat::Srgb);
        let material = Material { base_color_texture: Some(binding), alpha_mode, ..matt(Vec3::ONE) };
        scene.add_object("ball", colored_ball(Some(Vec4::new(1.0, 1.0, 1.0, vertex_alpha))), material);
        EffectPlan::new(&scene, &from_front(), &settings(EffectSettings::default()))
    };
    let masked = AlphaMode::Mask { cutoff: 0.75 };
    for (alpha, vertex_alpha, shows) in [(255, 1.0, false), (254, 1.0, true), (255, 0.5, true)] {
        let blended = plan(alpha, vertex_alpha, AlphaMode::Blend);
        assert_eq!(blended.is_on(Effect::Transparency), shows, "{alpha} {vertex_alpha}: {blended}");
        let white = vertex_alpha == 1.0;
        assert_eq!(blended.is_on(Effect::VertexColors), !white, "{alpha} {vertex_alpha}: {blended}");
        // What a texture that is not opaque holds is not searched.
        let with_mask = plan(alpha, vertex_alpha, masked);
        assert_eq!(with_mask.is_on(Effect::Masks), shows, "{alpha} {vertex_alpha}: {with_mask}");
    }
    assert!(!plan(3, 1.0, AlphaMode::Mask { cutoff: 0.0 }).is_on(Effect::Masks), "no alpha is below 0");
    let opaque = plan(255, 0.5, AlphaMode::Opaque);
    assert!(!opaque.is_on(Effect::VertexColors), "only their alpha is not 1: {opaque}");
}

#[test]
fn a_factor_of_0_hides_its_texture() {
    let mut scene = Scene::new();
    let binding = texture(&mut scene, [200, 100, 50, 128], TextureFormat::Linear);
    let rough =
        MetallicRoughness { metallic: 0.0, roughness: 0.0, specular: 0.0, ..MetallicRoughness::default() };
    let black = Material { base_color: Vec4::W, ..matt(Vec3::ZERO) };
    let microfacets = |model| Material { shading: Shading::MetallicRoughness(model), ..matt(Vec3::ONE) };
    let glossy =
        Shading::BlinnPhong { specular: Vec3::ZERO, shininess: 9.0, specular_texture: Some(binding) };
    let hidden = [
        Material { base_color_texture: Some(binding), ..black },
        microfacets(MetallicRoughness { texture: Some(binding), ..rough }),
        microfacets(MetallicRoughness { texture: Some(binding), roughness: 1.0, ..rough }),
        microfacets(MetallicRoughness { specular_texture: Some(binding), ..rough }),
        microfacets(MetallicRoughness { specular_color_texture: Some(binding), ..rough }),
        microfacets(MetallicRoughness {
            specular_color_texture: Some(binding),
            specular: 1.0,
            specular_color: Vec3::ZERO,
            ..rough
        }),
        Material { shading: glossy, ..matt(Vec3::ONE) },
        Material { emissive_texture: Some(binding), ..matt(Vec3::ONE) },
        Material { normal_map: Some(NormalMap { binding, scale: 0.0 }), ..matt(Vec3::ONE) },
        Material { occlusion: Some(Occlusion { binding, strength: 0.0 }), ..matt(Vec3::ONE) },
    ];
    for material in hidden {
        let mut scene = scene.clone();
        scene.add_object("ball", primitives::uv_sphere(1.0, 12, 6), material.clone());
        let settings = settings(EffectSettings::default());
        let plan = EffectPlan::new(
            &scene,
            &from_front(),
            &RenderSettings { lighting: Lighting::Studio, ..settings },
        );
        let place = material.textures().next().expect("it has one").0;
        for effect in [Effect::Textures, place.row().effect] {
            assert_eq!(
                plan.decision(effect).to_string(),
                "off, because the only object that has it, `ball`, multiplies it by 0",
                "{place:?}"
            );
        }
    }
}

#[test]
fn unlit_surfaces_need_no_maps_of_light() {
    let mut scene = Scene::new();
    let binding = texture(&mut scene, [128, 128, 255, 255], TextureFormat::Linear);
    let material = Material {
        shading: Shading::Unlit,
        normal_map: Some(NormalMap { binding, scale: 1.0 }),
        occlusion: Some(Occlusion { binding, strength: 1.0 }),
        ..Material::default()
    };
    scene.add_object("ball", primitives::uv_sphere(1.0, 12, 6), material);
    for effect in [Effect::NormalMaps, Effect::OcclusionMaps, Effect::Textures] {
        let unlit = "off, because the only object that has it, `ball`, is unlit and needs none";
        assert_eq!(decision(&scene, effect), unlit, "{effect}");
    }
    assert_eq!(decision(&scene, Effect::Highlights), "off, because nothing in the scene has it");
}

#[test]
fn white_vertex_colors_are_off() {
    let plan = |color: Vec4, base: Vec3| {
        let mut scene = Scene::new();
        scene.add_object("ball", colored_ball(Some(color)), matt(base));
        scene.add_object("other", colored_ball(Some(color)), matt(base));
        scene.add(Node::from_light(Light::ambient(1.0)));
        decision(&scene, Effect::VertexColors)
    };
    let two = "the 2 objects that have it, such as `ball`,";
    assert_eq!(plan(Vec4::ONE, Vec3::ONE), format!("off, because {two} have nothing but white"));
    assert_eq!(plan(Vec4::X, Vec3::ZERO), format!("off, because {two} multiply it by 0"));
    assert_eq!(plan(Vec4::X, Vec3::ONE), "on, because 2 objects have it, such as `ball`");
    assert_eq!(plan(Vec4::NEG_X, Vec3::ZERO), "on, because 2 objects have it, such as `ball`", "less than 0");
}

#[test]
fn lamps_that_reach_nothing_are_off() {
    let plan = |lamps: &[Node], effects: EffectSettings| {
        let mut scene = Scene::new();
        scene.add_object("ball", primitives::uv_sphere(1.0, 12, 6), matt(Vec3::ONE));
        for lamp in lamps {
            scene.add(lamp.clone());
        }
        EffectPlan::new(&scene, &from_front(), &settings(effects))
    };
    let said = |lamps: &[Node]| plan(lamps, EffectSettings::default()).decision(Effect::Lamps).to_string();
    let dark = Node::from_light(Light::point(0.0));
    let black = Node::from_light(Light::point(1.0).with_color(Vec3::ZERO));
    let far = Node::from_light(Light::point(1.0).with_range(1.0)).at(DVec3::X * 3.0);
    let away = shining(Light::spot(1.0), DVec3::X * 3.0, DVec3::X);
    let at = shining(Light::spot(1.0), DVec3::X * 3.0, DVec3::NEG_X);
    assert_eq!(said(&[]), "off, because nothing in the scene has it");
    assert_eq!(
        said(&[dark.clone(), black.clone()]),
        "off, because all 2 lights are dark (their intensity or colour is 0)"
    );
    assert_eq!(
        said(&[far.clone(), away.clone()]),
        "off, because none of 2 lights reaches anything that is visible (their ranges or cones end before)"
    );
    assert_eq!(
        said(&[dark.clone(), far.clone(), away.clone()]),
        "off, because of 3 lights 1 are dark (their intensity or colour is 0), and the others reach nothing that is visible"
    );
    assert_eq!(said(&[dark.clone(), far.clone(), at]), "on, because one light shines on visible objects");
    let shadows = EffectSettings { shadows: Shadows::Rays, ..EffectSettings::default() };
    let plan = plan(&[dark, far, away], shadows);
    assert_eq!(plan.decision(Effect::ShadowRays).to_string(), "off, because no light casts shadows");
}

/// A lamp out of range of a ball at rest lights it when a node or a pose moves it near.
#[test]
fn whatever_moves_into_the_range_of_a_lamp_is_lit() {
    use trigon_mesh::{Deltas, MorphTarget};
    let mut ball = primitives::uv_sphere(0.5, 12, 6);
    let positions = Deltas::from_dense(vec![Vec3::X; ball.vertex_count()]);
    let target = MorphTarget { positions, ..MorphTarget::default() };
    ball.set_attributes(Attributes { morph_targets: vec![target], ..ball.attributes().clone() })
        .expect("one delta each");
    let mut scene = Scene::new();
    let id = scene.add_object("ball", ball, matt(Vec3::ONE));
    let lamp = Node::from_light(Light::point(1.0).with_range(1.0)).at(DVec3::new(1.0, 0.0, 1.4));
    let lamp = scene.add(lamp);
    let is_lit = |scene: &Scene| {
        let plan = EffectPlan::new(scene, &from_front(), &settings(EffectSettings::default()));
        plan.is_on(Effect::Lamps)
    };
    assert!(!is_lit(&scene), "1.03 m from the box around it");
    scene.node_mut(id).expect("there").morph_weights = vec![1.0];
    assert!(is_lit(&scene), "the pose is 0.9 m away");
    scene.node_mut(id).expect("there").morph_weights = vec![0.0];
    assert!(!is_lit(&scene), "as before");
    scene.node_mut(id).expect("there").transform = Transform::from_translation(DVec3::X);
    assert!(is_lit(&scene), "the node is");
    scene.node_mut(id).expect("there").transform = Transform::default();
    scene.node_mut(lamp).expect("there").transform = Transform::from_translation(DVec3::X);
    assert!(is_lit(&scene), "the lamp has moved");
}

/// What is known of vertex colours follows a change of them, also where the geometry is changed in place.
#[test]
fn a_vertex_that_gets_a_color_turns_vertex_colors_on() {
    let mut scene = Scene::new();
    scene.add_object("ball", colored_ball(Some(Vec4::ONE)), matt(Vec3::ONE));
    scene.add(Node::from_light(Light::ambient(1.0)));
    let mesh = scene.meshes().iter().next().expect("a ball").0;
    let mut renderer = Renderer::new(settings(EffectSettings::default()));
    for (color, shows) in
        [(Vec4::ONE, false), (Vec4::X, true), (Vec4::X, true), (Vec4::ONE, false), (Vec4::Y, true)]
    {
        let corner_colors = vec![(5, color)];
        let change = trigon_mesh::MeshChange { corner_colors, ..trigon_mesh::MeshChange::default() };
        scene.change_mesh(mesh, &change).expect("the ball has this corner");
        let frame = renderer.render(&scene, &from_front()).expect("drawn");
        let plan = renderer.plan().expect("drawn");
        assert_eq!(plan.is_on(Effect::VertexColors), shows, "{color}: {plan}");
        let anew = with_everything(|| render(&scene, &from_front(), renderer.settings()).expect("drawn"));
        assert!(frame == anew, "{color}: the same bytes");
    }
}

/// A ball whose corners all have a colour.
fn colored_ball(color: Option<Vec4>) -> Mesh {
    let mut ball = primitives::uv_sphere(1.0, 12, 6);
    let corner_colors = color.map(|color| vec![color; ball.corner_count()]);
    ball.set_attributes(Attributes { corner_colors, ..ball.attributes().clone() }).expect("one each");
    ball
}

fn factor() -> impl Strategy<Value = f32> {
    prop::sample::select(vec![0.0_f32, 0.0, 1.0, 1.0, 0.5])
}

fn alpha_mode() -> impl Strategy<Value = AlphaMode> {
    prop_oneof![
        Just(AlphaMode::Opaque),
        Just(AlphaMode::Blend),
        Just(AlphaMode::Blend),
        factor().prop_map(|cutoff| AlphaMode::Mask { cutoff })
    ]
}

fn shading() -> impl Strategy<Value = Shading> {
    (0..4_u8, factor(), factor(), factor()).prop_map(|(kind, metallic, roughness, specular)| match kind {
        0 => Shading::Unlit,
        1 => Shading::Lambert,
        2 => Shading::blinn_phong(Vec3::splat(specular), 20.0 * roughness),
        _ => Shading::MetallicRoughness(MetallicRoughness {
            metallic,
            roughness,
            specular,
            specular_color: Vec3::splat(1.0 - roughness),
            ..MetallicRoughness::default()
        }),
    })
}

/// A material without textures, and which places have one: opaque or not.
fn material() -> impl Strategy<Value = (Material, Vec<Option<bool>>)> {
    let colors = (factor(), prop::sample::select(vec![1.0_f32, 1.0, 1.0, 0.5, 0.0]), factor(), any::<bool>());
    let textures =
        prop::collection::vec(prop::option::weighted(0.3, any::<bool>()), MaterialTexture::ALL.len());
    (shading(), alpha_mode(), colors, textures).prop_map(
        |(shading, alpha_mode, (red, alpha, emission, double_sided), textures)| {
            let material = Material {
                base_color: Vec4::new(red, red * 0.5, red, alpha),
                emissive: Vec3::splat(emission * 0.2),
                shading,
                alpha_mode,
                double_sided,
                ..Material::default()
            };
            (material, textures)
        },
    )
}

fn lamp() -> impl Strategy<Value = Node> {
    let place = (-3..4_i8, -3..4_i8, -3..4_i8).prop_map(|(x, y, z)| DVec3::new(x.into(), y.into(), z.into()));
    let range = prop::sample::select(vec![0.5_f32, 1.5, 3.0, f32::INFINITY]);
    (0..3_u8, factor(), place.clone(), place, range).prop_map(|(kind, intensity, from, along, range)| {
        let kind = match kind {
            0 => LightKind::Directional,
            1 => LightKind::Point,
            _ => LightKind::Spot { inner: 0.1, outer: 0.5 },
        };
        let radius = if along.x > 0.0 { 0.1 } else { 0.0 };
        let light = Light { kind, color: Vec3::new(1.0, 0.8, 0.6), intensity, range, radius };
        shining(light, from, along + DVec3::X * 0.25)
    })
}

/// Two balls that overlap, a pane in front of a part of them, and one at the very place of the first pane: equal depths.
fn any_scene() -> impl Strategy<Value = Scene> {
    let color = prop::sample::select(vec![
        None,
        None,
        Some(Vec4::ONE),
        Some(Vec4::new(1.0, 1.0, 1.0, 0.5)),
        Some(Vec4::new(1.0, 0.5, 0.25, 1.0)),
    ]);
    let objects = prop::collection::vec((material(), color), 4);
    (objects, prop::collection::vec(lamp(), 0..4), prop::option::of(factor())).prop_map(
        |(objects, lamps, ambient)| {
            let mut scene = Scene::new();
            for (number, ((mut material, textures), color)) in objects.into_iter().enumerate() {
                for (place, is_opaque) in MaterialTexture::ALL.into_iter().zip(textures) {
                    let Some(is_opaque) = is_opaque else { continue };
                    let texel = [200, 100, 250, if is_opaque { 255 } else { 100 }];
                    let binding = texture(&mut scene, texel, place.format());
                    material.set_texture(place, Some(binding));
                }
                let is_ball = number < 2;
                let mut mesh =
                    if is_ball { primitives::uv_sphere(0.8, 10, 5) } else { primitives::plane(1.5, 1.5) };
                let corner_colors = color.map(|color| vec![color; mesh.corner_count()]);
                mesh.set_attributes(Attributes { corner_colors, ..mesh.attributes().clone() })
                    .expect("one each");
                let id = scene.add_object("object", mesh, material);
                let (place, turn) = match number {
                    0 => (DVec3::ZERO, DQuat::IDENTITY),
                    1 => (DVec3::new(0.6, 0.2, 0.1), DQuat::IDENTITY),
                    _ => (DVec3::new(-0.4, 0.0, 0.3), DQuat::from_rotation_x(1.2)),
                };
                scene.node_mut(id).expect("just added").transform =
                    Transform::from_scale_rotation_translation(DVec3::ONE, turn, place);
            }
            for lamp in lamps.into_iter().chain(ambient.map(|light| Node::from_light(Light::ambient(light))))
            {
                scene.add(lamp);
            }
            scene
        },
    )
}

fn any_settings() -> impl Strategy<Value = RenderSettings> {
    let samples = prop::sample::select(vec![(1, 1), (1, 4), (2, 1), (1, 8)]);
    let style = prop::sample::select(vec![Style::Surface, Style::Surface, Style::SurfaceWithEdges]);
    let model = prop::sample::select(vec![ShadingModel::Flat, ShadingModel::Gouraud, ShadingModel::Phong]);
    let effects = (0..3_usize, any::<[bool; 3]>(), 0..3_u32);
    let outputs = (any::<[bool; 4]>(), 0..3_usize);
    (samples, style, model, effects, outputs).prop_map(
        |(
            (samples_per_axis, samples),
            style,
            shading,
            effects,
            ([ids, radiance, normals, of_blended], lighting),
        )| {
            let (shadows, [environment, tones, vertices], bounces) = effects;
            let vertices = vertices.then(VertexPoints::default);
            let effects = EffectSettings {
                shadows: [Shadows::Off, Shadows::Rays, Shadows::Maps { resolution: 32 }][shadows],
                environment: environment.then(|| Arc::new(Environment::uniform(Vec3::ONE))),
                exposure: Exposure::Stops(if tones { 0.5 } else { 0.0 }),
                sight: if bounces == 1 { SightRays::default() } else { SightRays::all(bounces) },
                ..EffectSettings::default()
            };
            let outputs =
                Outputs { ids, depth: ids, radiance, albedo: normals, of_blended, ..Outputs::default() };
            let lighting = [Lighting::Scene, Lighting::Automatic, Lighting::Studio][lighting];
            let (width, height) = (24, 24);
            let settings = settings(effects);
            RenderSettings {
                samples_per_axis,
                samples,
                style,
                shading,
                outputs,
                lighting,
                vertices,
                width,
                height,
                ..settings
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// The promise: images with everything that nobody can see, and without it, are the same.
    #[test]
    fn leaving_out_what_nobody_sees_changes_no_byte(scene in any_scene(), settings in any_settings()) {
        let mut renderer = Renderer::new(settings.clone());
        let without = renderer.render(&scene, &from_front()).expect("drawn");
        let plan = renderer.plan().expect("drawn").clone();
        let with = with_everything(|| render(&scene, &from_front(), &settings).expect("drawn"));
        prop_assert!(without == with, "{plan}");
        for effect in Effect::ALL {
            let counts = renderer.effect_counts(effect);
            prop_assert!(plan.is_on(effect) || counts == EffectCounts::default(), "{} is off: {:?}", effect, counts);
        }
    }
}

/// A map of scale 0 is flat: the surface shows its own normals, exactly.
#[test]
fn a_normal_map_of_scale_0_is_none() {
    let picture = |scale: Option<f32>| {
        let mut scene = Scene::new();
        let binding = texture(&mut scene, [200, 30, 180, 255], TextureFormat::Linear);
        let normal_map = scale.map(|scale| NormalMap { binding, scale });
        scene.add_object("ball", colored_ball(None), Material { normal_map, ..matt(Vec3::ONE) });
        scene.add(shining(Light::directional(1.0), DVec3::ONE, DVec3::NEG_ONE));
        let outputs = Outputs { radiance: true, normals: true, ..Outputs::default() };
        let settings = RenderSettings { outputs, ..settings(EffectSettings::default()) };
        render(&scene, &from_front(), &settings).expect("drawn")
    };
    assert!(picture(Some(0.0)) == picture(None), "as without one");
    assert!(picture(Some(1.0)) != picture(None), "it would change the image");
}
