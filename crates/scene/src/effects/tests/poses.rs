//! Morphed meshes are drawn, and throw their shadows, where their pose puts them.
//!
//! A large mesh of flat polygons has normals of polygons instead of vertices. The same mesh whose corners are given these
//! normals has them at vertices, and must draw the same bytes.

use trigon_mesh::{Deltas, MorphTarget};

use super::*;
use crate::effect::Effect;
use crate::{Display, Outputs};

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

/// Enough corners for it.
const PIECES: u32 = 130;

/// A hilly sheet, flat or with the same normals at its corners.
fn sheet(has_normals: bool) -> trigon_mesh::Mesh {
    let mut mesh = primitives::grid(3.0, 3.0, PIECES, PIECES);
    for place in mesh.positions_mut() {
        place.y = 0.3 * elementary::sin_f32(place.x * 5.0) * elementary::cos_f32(place.z * 7.0);
    }
    let corner_normals = has_normals.then(|| mesh.shading_normals());
    let attributes = Attributes { corner_normals, ..mesh.attributes().clone() };
    mesh.set_attributes(attributes).expect("one for each corner");
    mesh
}

/// The sheet in a material, stretched and lit, beside a ball that it hides partly.
fn scene(has_normals: bool, mut material: Material, has_normal_map: bool) -> Scene {
    let mut scene = Scene::new();
    if has_normal_map {
        let texture =
            Texture::new(1, 1, vec![[180, 90, 200, 255]], TextureFormat::Linear).expect("one texel");
        let binding = TextureBinding::new(scene.add_texture("normal", texture));
        material.normal_map = Some(NormalMap { binding, scale: 0.7 });
    }
    let node = scene.add_object("sheet", sheet(has_normals), material);
    scene.node_mut(node).expect("just added").transform = Transform::from_scale_rotation_translation(
        DVec3::new(1.0, 1.5, 0.8),
        DQuat::from_rotation_z(0.3),
        DVec3::ZERO,
    );
    scene.add_object("ball", primitives::uv_sphere(0.4, 16, 8), matt(Vec3::new(0.7, 0.3, 0.2)));
    scene.add(shining(Light::directional(1.0), DVec3::ZERO, DVec3::new(0.4, -1.0, 0.3)));
    scene.add(Node::from_light(Light::ambient(0.2)));
    scene
}

/// Draws both.
fn check(what: &str, material: &Material, has_normal_map: bool, settings: &RenderSettings) {
    // So near that some triangles are cut at the image's edge and at the near plane.
    let projection = Projection::perspective(1.0, 0.2, Some(20.0)).expect("in range");
    let camera = Camera { projection, ..Camera::look_at(DVec3::new(0.2, 0.6, 1.1), DVec3::ZERO, DVec3::Y) };
    let [flat, split] = [false, true].map(|has_normals| {
        let scene = scene(has_normals, material.clone(), has_normal_map);
        let frame = render(&scene, &camera, settings).expect("drawn");
        let asset = scene.meshes().iter().next().expect("the sheet").1;
        (frame, asset.geometry().columns.face_normals.is_some())
    });
    assert!(flat.1 && !split.1, "{what}: one of them has normals of polygons");
    assert!(flat.0 == split.0, "{what}: not the same bytes");
}

#[test]
fn normals_of_polygons_draw_what_normals_of_vertices_draw() {
    let small = RenderSettings {
        outputs: Outputs { normals: true, geometric_normals: true, triangle_ids: true, ..Outputs::default() },
        lighting: Lighting::Scene,
        samples_per_axis: 2,
        ..RenderSettings::new(64, 48)
    };
    let lit = matt(Vec3::new(0.4, 0.6, 0.8));
    let rough = MetallicRoughness { metallic: 0.3, roughness: 0.5, ..MetallicRoughness::default() };
    let rough = Material { shading: Shading::MetallicRoughness(rough), double_sided: true, ..lit.clone() };
    for shading in [ShadingModel::Phong, ShadingModel::Gouraud, ShadingModel::Flat] {
        for material in [&lit, &rough] {
            let settings = RenderSettings { shading, ..small.clone() };
            check(&format!("{shading:?}"), material, false, &settings);
        }
    }
    for display in [Display::Normal, Display::GeometricNormal, Display::Matcap] {
        check(&format!("{display:?}"), &lit, true, &RenderSettings { display, ..small.clone() });
    }
    check("a normal map", &rough, true, &small);
    check("edges", &lit, false, &RenderSettings { style: Style::SurfaceWithEdges, ..small.clone() });
    let effects = EffectSettings {
        shadows: Shadows::Rays,
        ambient_occlusion: Some(AmbientOcclusion::new(2, 0.5)),
        fog: Some(Fog { color: Vec3::ONE, density: 0.1 }),
        sight: SightRays::all(2),
        ..EffectSettings::default()
    };
    check("rays", &metal(1.0), false, &RenderSettings { effects, ..small });
}
