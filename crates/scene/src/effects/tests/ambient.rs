//! Light from everywhere, and what keeps it away.

use super::*;

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
        ambient_occlusion: Some(AmbientOcclusion { rays: 64, distance }),
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
