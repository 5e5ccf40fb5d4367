//! Mirrors and glass.

use super::*;

/// A pane in the middle, and an unlit wall of a colour somewhere.
fn pane_and_wall(pane: Material, turn: DQuat, wall: (DVec3, DVec3)) -> Scene {
    let mut scene = Scene::new();
    let (place, facing) = wall;
    for (name, mesh, material, rotation, place) in [
        ("pane", primitives::plane(2.0, 2.0), pane, turn, DVec3::ZERO),
        (
            "wall",
            primitives::plane(3.0, 3.0),
            Material { shading: Shading::Unlit, ..matt(Vec3::new(0.2, 0.6, 0.4)) },
            DQuat::from_rotation_arc(DVec3::Y, facing),
            place,
        ),
    ] {
        let id = scene.add_object(name, mesh, material);
        scene.node_mut(id).expect("just added").transform =
            Transform::from_scale_rotation_translation(DVec3::ONE, rotation, place);
    }
    scene
}

fn middle(scene: &Scene) -> Vec3 {
    let effects = EffectSettings { sight: SightRays::all(3), ..EffectSettings::default() };
    let frame = render(scene, &from_front(), &settings(effects)).expect("drawn");
    let [r, g, b, _] = frame.pixel(SIDE / 2, SIDE / 2);
    Vec3::from([r, g, b].map(color::srgb8_to_linear))
}

#[test]
fn a_mirror_shows_what_is_beside_the_eye() {
    // The pane's normal is between +Z and +X, so that the eye sees along +X.
    let askew = DQuat::from_rotation_arc(DVec3::Y, DVec3::new(1.0, 0.0, 1.0).normalize());
    let scene = pane_and_wall(metal(1.0), askew, (DVec3::X * 4.0, DVec3::NEG_X));
    let shown = middle(&scene);
    assert!((shown - Vec3::new(0.2, 0.6, 0.4)).abs().max_element() < 0.01, "the wall: {shown}");
}

#[test]
fn glass_as_thin_as_air_is_not_seen() {
    let upright = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
    let air = Material { transmission: 1.0, ior: 1.0, ..metal(0.0) };
    let scene = pane_and_wall(air, upright, (DVec3::NEG_Z * 3.0, DVec3::Z));
    let shown = middle(&scene);
    assert!((shown - Vec3::new(0.2, 0.6, 0.4)).abs().max_element() < 0.01, "the wall behind: {shown}");
    let glass = Material { transmission: 1.0, ior: 1.5, ..metal(0.0) };
    let through = middle(&pane_and_wall(glass, upright, (DVec3::NEG_Z * 3.0, DVec3::Z)));
    // Head-on, 4 % are reflected where the light enters; the pane has no other side.
    assert!((through / shown - 0.96).abs().max_element() < 0.02, "{through} of {shown}");
}

/// A texel of one half lets half as much through, where the eye looks at the pane and
/// where a ray meets it.
#[test]
fn a_texture_says_how_much_passes() {
    let upright = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
    let shown = |transmission: f32, texel: Option<u8>, is_mirrored: bool| {
        let mut scene = Scene::new();
        let transmission_texture = texel.map(|red| {
            let texture = Texture::new(1, 1, vec![[red, 9, 9, 9]], TextureFormat::Linear).expect("a texel");
            TextureBinding::new(scene.add_texture("half", texture))
        });
        let glass = Material { transmission, transmission_texture, ior: 1.0, ..metal(0.0) };
        let (pane, wall) = if is_mirrored { (DVec3::Z * 9.0, 12.0) } else { (DVec3::ZERO, -3.0) };
        let bright = Material { shading: Shading::Unlit, ..matt(Vec3::new(0.2, 0.6, 0.4)) };
        let mut add = |mesh, material, place: DVec3, turn| {
            let id = scene.add_object("it", mesh, material);
            scene.node_mut(id).expect("just added").transform =
                Transform::from_scale_rotation_translation(DVec3::ONE, turn, place);
        };
        add(primitives::plane(2.0, 2.0), glass, pane, upright);
        let towards = DQuat::from_rotation_arc(DVec3::Y, if is_mirrored { DVec3::NEG_Z } else { DVec3::Z });
        add(primitives::plane(9.0, 9.0), bright, DVec3::Z * wall, towards);
        if is_mirrored {
            add(primitives::plane(2.0, 2.0), metal(1.0), DVec3::ZERO, upright);
        }
        middle(&scene)
    };
    for is_mirrored in [false, true] {
        let half = shown(1.0, Some(128), is_mirrored);
        let same = shown(128.0 / 255.0, None, is_mirrored);
        let whole = shown(1.0, Some(255), is_mirrored);
        assert!((half - same).abs().max_element() < 0.01, "{half} is {same}, mirrored: {is_mirrored}");
        assert!((half - whole).abs().max_element() > 0.05, "{half} is not {whole}");
    }
}

/// In a room of one colour everything that a ray reaches is that light, times the factor for all lights.
#[test]
fn a_traced_mirror_shows_the_surroundings_as_bright_as_the_lights_are_set() {
    let room = Vec3::new(0.1, 0.2, 0.3);
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.5, 64, 32), metal(1.0));
    for light_intensity in [0.5, 1.0, 3.0] {
        let environment = Some(Arc::new(Environment::uniform(room)));
        let effects = EffectSettings { sight: SightRays::all(2), environment, ..EffectSettings::default() };
        let settings = RenderSettings { light_intensity, ..settings(effects) };
        let frame = render(&scene, &from_front(), &settings).expect("drawn");
        let [r, g, b, _] = frame.pixel(SIDE / 2, SIDE / 2);
        let shown = Vec3::from([r, g, b].map(color::srgb8_to_linear));
        assert!((shown / (room * light_intensity) - 1.0).abs().max_element() < 0.03, "{shown}");
    }
}
