//! Outlines.

use super::*;

#[test]
fn an_outline_runs_around_what_is_seen_of_a_node() {
    let mut scene = Scene::new();
    let ball = scene.add_object("ball", primitives::uv_sphere(1.0, 64, 32), matt(Vec3::ZERO));
    let outline = Outline { nodes: vec![ball], color: Vec3::new(1.0, 0.0, 0.0), width: 3 };
    let effects = EffectSettings { outline: Some(outline), ..EffectSettings::default() };
    let frame = render(&scene, &from_front(), &settings(effects)).expect("drawn");
    assert_eq!(frame.object_ids, None, "ids were not asked for");
    let red: Vec<u32> = (0..SIDE).filter(|&x| frame.pixel(x, SIDE / 2)[0] > 0).collect();
    // The ball has a radius of 32 pixels around the middle.
    assert_eq!(red, [29, 30, 31, 96, 97, 98], "three pixels on either side");
}
