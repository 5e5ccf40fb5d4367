//! A large mesh of flat polygons has normals of polygons instead of vertices. The same mesh whose corners are
//! given these normals has them at vertices, and must draw the same bytes.

use super::*;
use crate::{Display, Outputs};

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
        ambient_occlusion: Some(AmbientOcclusion { rays: 2, distance: 0.5 }),
        fog: Some(Fog { color: Vec3::ONE, density: 0.1 }),
        sight: SightRays::all(2),
        ..EffectSettings::default()
    };
    check("rays", &metal(1.0), false, &RenderSettings { effects, ..small });
}
