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
    let effects = EffectSettings { bounces: 3, ..EffectSettings::default() };
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
