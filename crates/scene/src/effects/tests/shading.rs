//! Shading models and normal maps, light from everywhere, and what keeps this light away.

use super::*;

#[test]
fn a_sphere_is_as_bright_as_lamberts_law_says() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.5, 512, 256), matt(Vec3::splat(0.8)));
    let towards = DVec3::new(0.6, 0.48, 0.64);
    scene.add(shining(Light::directional(1.0), DVec3::ZERO, -towards));
    let frame = render(&scene, &from_front(), &settings(EffectSettings::default())).expect("drawn");
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let place = |pixel: u32| ((f64::from(pixel) + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0) / 1.5;
        let (right, up) = (place(x), -place(y));
        let square = right * right + up * up;
        if square > 0.9 {
            continue;
        }
        let normal = DVec3::new(right, up, (1.0 - square).sqrt());
        let expected = 0.8 * normal.dot(towards).max(0.0);
        let shown = f64::from(light(&frame, x, y));
        // Half a step of sRGB is up to 0.0045 here; the facets' own is below 1e-3.
        assert!((shown - expected).abs() < 0.006, "({x}, {y}): {shown}, not {expected}");
    }
}

/// What a ball shows in its middle and half way to its right edge.
fn two_places(shading: ShadingModel, material: Material) -> [f32; 2] {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.5, 128, 64), material);
    scene.add(shining(Light::directional(0.6), DVec3::ZERO, DVec3::NEG_Z));
    scene.add(Node::from_light(Light::ambient(0.1)));
    let settings = RenderSettings { shading, ..settings(EffectSettings::default()) };
    let frame = render(&scene, &from_front(), &settings).expect("drawn");
    [64, 88].map(|x| light(&frame, x, SIDE / 2))
}

#[test]
fn on_a_fine_mesh_all_shading_models_agree() {
    let rough = MetallicRoughness { metallic: 0.3, roughness: 0.7, ..MetallicRoughness::default() };
    for shading in
        [Shading::Lambert, Shading::blinn_phong(Vec3::splat(0.3), 5.0), Shading::MetallicRoughness(rough)]
    {
        for double_sided in [false, true] {
            let material = Material { shading, double_sided, ..matt(Vec3::splat(0.7)) };
            let exact = two_places(ShadingModel::Phong, material.clone());
            for model in [ShadingModel::Flat, ShadingModel::Gouraud] {
                let shown = two_places(model, material.clone());
                let near = shown.iter().zip(exact).all(|(shown, exact)| (shown - exact).abs() < 0.02);
                assert!(near, "{model:?} of {shading:?}: {shown:?}, not {exact:?}");
            }
        }
    }
}

/// A quad that looks at the eye, its normals all bent by one texel.
fn bent_quad(texel: [u8; 4], mirrored: bool, towards: DVec3) -> f32 {
    let mut scene = Scene::new();
    let texture = Texture::new(1, 1, vec![texel], TextureFormat::Linear).expect("one texel");
    let binding = TextureBinding::new(scene.add_texture("normal", texture));
    let material = Material { normal_map: Some(NormalMap { binding, scale: 1.0 }), ..matt(Vec3::ONE) };
    let quad = scene.add_object("quad", primitives::plane(3.0, 3.0), material);
    let upright = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
    let scale = if mirrored { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE };
    scene.node_mut(quad).expect("just added").transform =
        Transform::from_scale_rotation_translation(scale, upright, DVec3::ZERO);
    scene.add(shining(Light::directional(1.0), DVec3::ZERO, -towards));
    let frame = render(&scene, &from_front(), &settings(EffectSettings::default())).expect("drawn");
    light(&frame, SIDE / 2, SIDE / 2)
}

#[test]
fn a_normal_map_bends_normals_along_u_and_against_v() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // 45 degrees towards growing u, and against growing v. The plane's u runs along
    // +X, and its v along +Z, which the node turns to −Y.
    for (texel, bent) in [
        ([218, 128, 218, 255], DVec3::new(half, 0.0, half)),
        ([128, 218, 218, 255], DVec3::new(0.0, half, half)),
    ] {
        for towards in [bent, DVec3::Z, DVec3::new(-bent.x, -bent.y, bent.z)] {
            let expected = bent.dot(towards).max(0.0);
            let shown = f64::from(bent_quad(texel, false, towards));
            // A byte of the map is up to 0.4 %.
            assert!((shown - expected).abs() < 0.02, "{texel:?} lit from {towards}: {shown}, not {expected}");
            let mirror = DVec3::new(-1.0, 1.0, 1.0);
            let reflected = f64::from(bent_quad(texel, true, towards * mirror));
            assert!((reflected - expected).abs() < 0.02, "in a mirror: {reflected}, not {expected}");
        }
    }
}

/// Beside an endless wall a floor sees half of the sky, far away all of it.
#[test]
fn a_wall_takes_half_of_the_sky_away() {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(60.0, 60.0), matt(Vec3::ONE));
    let wall = scene.add_object("wall", primitives::plane(60.0, 60.0), matt(Vec3::ONE));
    let upright = DQuat::from_rotation_arc(DVec3::Y, DVec3::X);
    scene.node_mut(wall).expect("just added").transform =
        Transform::from_scale_rotation_translation(DVec3::ONE, upright, DVec3::X * 0.5);
    scene.add(Node::from_light(Light::ambient(1.0)));
    let occlusion = |distance| EffectSettings {
        ambient_occlusion: Some(AmbientOcclusion::new(64, distance)),
        ..Default::default()
    };
    let mean = |frame: &Frame, x: u32| (40..80).map(|y| light(frame, x, y)).sum::<f32>() / 40.0;
    let endless = render(&scene, &from_above(), &settings(occlusion(1e3))).expect("drawn");
    // 0.5 m is at column 80: a pixel before it, the wall takes half of the rays.
    assert!((mean(&endless, 78) - 0.5).abs() < 0.06, "{} beside the wall", mean(&endless, 78));
    let near = render(&scene, &from_above(), &settings(occlusion(0.5))).expect("drawn");
    assert_eq!(mean(&near, 10), 1.0, "2 m away nothing within half a metre is in the way");
}

/// The white furnace: what reflects everything vanishes in a white room.
#[test]
fn a_white_surface_cannot_be_seen_in_a_white_room() {
    for (metallic, roughness) in [(1.0, 0.0), (1.0, 0.4), (1.0, 1.0), (0.0, 0.1), (0.0, 0.6), (0.0, 1.0)] {
        let mut scene = Scene::new();
        let model = MetallicRoughness { metallic, roughness, ..MetallicRoughness::default() };
        let material = Material {
            base_color: Vec4::ONE,
            shading: Shading::MetallicRoughness(model),
            ..Material::default()
        };
        scene.add_object("ball", primitives::uv_sphere(1.5, 64, 32), material);
        let room = EffectSettings {
            environment: Some(Arc::new(Environment::uniform(Vec3::splat(0.5)))),
            ..Default::default()
        };
        let settings = RenderSettings { background: Background::Color(Vec3::splat(0.5)), ..settings(room) };
        let frame = render(&scene, &from_front(), &settings).expect("drawn");
        let (least, most) = (0..SIDE)
            .map(|x| light(&frame, x, SIDE / 2))
            .fold((1.0_f32, 0.0_f32), |(least, most), light| (least.min(light), most.max(light)));
        // One percent of the light, and one of 255 steps.
        let within = least > 0.495 - 0.004 && most < 0.505 + 0.004;
        assert!(within, "metallic {metallic}, roughness {roughness}: {least} to {most}");
    }
}
