//! Morphed meshes are drawn, and throw their shadows, where their pose puts them.

use crate::effect::Effect;
use trigon_mesh::{Deltas, MorphTarget};

use super::*;

/// A square that a morph target moves by a metre to the right.
fn morphed(weight: f32) -> (Scene, crate::NodeId) {
    let mut square = primitives::plane(1.0, 1.0);
    let positions = Deltas::from_dense(vec![Vec3::X; square.vertex_count()]);
    let target = MorphTarget { positions, ..MorphTarget::default() };
    let attributes = Attributes { morph_targets: vec![target], ..square.attributes().clone() };
    square.set_attributes(attributes).expect("a delta for each vertex");
    let mut scene = Scene::new();
    let material = Material { shading: Shading::Unlit, ..matt(Vec3::new(1.0, 0.0, 0.0)) };
    let id = scene.add_object("square", square, material);
    let node = scene.node_mut(id).expect("just added");
    node.morph_weights = vec![weight];
    node.transform = Transform::from_translation(DVec3::Y);
    (scene, id)
}

/// The first and the last column of the middle row that show the square.
fn columns(frame: &Frame) -> [u32; 2] {
    let red = |&x: &u32| frame.pixel(x, SIDE / 2)[0] > 200 && frame.pixel(x, SIDE / 2)[1] == 0;
    let all: Vec<u32> = (0..SIDE).filter(red).collect();
    [all[0], all[all.len() - 1]]
}

#[test]
fn a_morphed_mesh_is_drawn_where_its_weights_put_it() {
    for (weight, expected) in [(0.0, [48, 79]), (0.5, [64, 95]), (1.0, [80, 111])] {
        let (scene, _) = morphed(weight);
        let frame = render(&scene, &from_above(), &settings(EffectSettings::default())).expect("drawn");
        assert_eq!(columns(&frame), expected, "moved by {weight} m of 32 pixels each");
    }
}

/// Tangents that a normal map calls for were made of the mesh at rest, which then was
/// drawn at rest.
#[test]
fn a_normal_map_leaves_a_mesh_in_its_pose() {
    let (mut scene, id) = morphed(1.0);
    let flat = Texture::new(1, 1, vec![[128, 128, 255, 255]], TextureFormat::Linear).expect("one texel");
    let binding = TextureBinding::new(scene.add_texture("flat", flat));
    let red = matt(Vec3::new(1.0, 0.0, 0.0));
    let bumpy = scene.add_material(Material { normal_map: Some(NormalMap { binding, scale: 1.0 }), ..red });
    scene.node_mut(id).expect("it is there").materials = vec![bumpy];
    for light in [Light::ambient(1.0), Light::directional(1.0)] {
        scene.add(shining(light, DVec3::ZERO, DVec3::NEG_Y));
    }
    let mut renderer = Renderer::new(settings(EffectSettings::default()));
    let frame = renderer.render(&scene, &from_above()).expect("drawn");
    assert!(renderer.plan().is_some_and(|plan| plan.is_on(Effect::NormalMaps)), "the map is used");
    assert_eq!(columns(&frame), [80, 111], "moved by a metre of 32 pixels");
}

#[test]
fn a_morphed_mesh_throws_its_shadow_from_where_it_is() {
    for shadows in [Shadows::Maps { resolution: 512 }, Shadows::Rays] {
        let (mut scene, _) = morphed(0.5);
        scene.add_object("floor", primitives::plane(8.0, 8.0), matt(Vec3::ONE));
        scene.add(shining(Light::directional(1.0), DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0)));
        let effects = EffectSettings { shadows, ..EffectSettings::default() };
        let frame = render(&scene, &from_above(), &settings(effects)).expect("drawn");
        // The square is from 0 to 1 m, its shadow from 1 to 2 m: the last quarter.
        let dark = |x: u32| light(&frame, x, SIDE / 2) < 0.3;
        assert!(dark(100) && dark(120) && !dark(40), "{shadows:?}: the shadow is a metre further");
    }
}

/// A camera was fitted to meshes at rest, and missed those whose pose is elsewhere.
#[test]
fn a_camera_is_fitted_to_a_mesh_in_its_pose() {
    let (scene, _) = morphed(3.0);
    let points: Vec<_> = scene.visible_points().collect();
    assert_eq!(points.len(), 4, "the square's corners");
    let across: Vec<f64> = points.iter().map(|point| point.x).collect();
    assert!(across.iter().all(|x| (2.5..=3.5).contains(x)), "moved by three metres: {across:?}");
    assert_eq!(trigon_math::Bounds3::from_points(points), scene.bounds(), "as the scene's box says");
}
