//! Outputs against rays in f64, formulas and each other.

use std::num::NonZeroUsize;

use trigon_camera::{Camera, Projection, Projector, Viewport};
use trigon_math::{DVec2, DVec3, Vec2, Vec3, Vec4, color};
use trigon_mesh::{Mesh, primitives};

use crate::{
    AlphaMode, Background, Frame, Lighting, Material, NodeId, NormalMap, Outputs, RenderSettings, Renderer,
    Scene, Shading, Style, Texture, TextureBinding, TextureFormat, Transform, render, showcase,
};

fn settings(outputs: Outputs) -> RenderSettings {
    RenderSettings { outputs, samples_per_axis: 1, lighting: Lighting::Scene, ..RenderSettings::new(97, 61) }
}

fn cameras() -> [Camera; 2] {
    let camera = Camera::look_at(DVec3::new(2.0, 1.5, 4.0), DVec3::ZERO, DVec3::Y);
    let flat = Projection::orthographic(3.0, 0.1, 20.0).expect("the numbers are in range");
    [camera, camera.with_projection(flat)]
}

/// Scaled unevenly, turned and mirrored.
fn askew(scene: &mut Scene, node: NodeId) {
    let turned = trigon_math::DQuat::from_xyzw(0.1, 0.5, -0.2, 0.9).normalize();
    scene.node_mut(node).expect("just added").transform = Transform::from_scale_rotation_translation(
        DVec3::new(-1.2, 0.7, 1.0),
        turned,
        DVec3::new(0.2, -0.1, 0.3),
    );
}

fn unlit(material: Material) -> Material {
    Material { shading: Shading::Unlit, ..material }
}

/// The corners in the world of the triangle that a pixel sees.
fn corners(scene: &Scene, mesh: &Mesh, node: NodeId, triangle: u32) -> [DVec3; 3] {
    let world = scene.world_transform(node);
    mesh.triangulation().triangles[triangle as usize].map(|corner| {
        let vertex = mesh.corner_vertices()[corner as usize];
        world.transform_point3(mesh.positions()[vertex as usize].as_dvec3())
    })
}

#[test]
fn points_lie_on_their_triangles_and_on_the_rays_of_their_pixels() {
    for (camera, (axis, samples)) in cameras().iter().flat_map(|c| [(c, (1, 1)), (c, (2, 1)), (c, (1, 4))]) {
        let mut scene = Scene::new();
        let mesh = primitives::dodecahedron(1.0);
        let node = scene.add_object("solid", mesh.clone(), Material::default());
        askew(&mut scene, node);
        let settings = RenderSettings { samples_per_axis: axis, samples, ..settings(Outputs::ALL) };
        let frame = render(&scene, camera, &settings).expect("drawn");
        let viewport = Viewport { width: frame.width, height: frame.height };
        let projector = Projector::new(camera, viewport);
        let sample = match (axis, samples) {
            (1, 1) => DVec2::splat(0.5),
            (2, 1) => DVec2::splat(0.75),
            _ => DVec2::new(6.0, 2.0) / 16.0,
        };
        let mut count = 0;
        for (index, &triangle) in
            list(&frame.triangle_ids).iter().enumerate().filter(|(_, t)| **t != u32::MAX)
        {
            count += 1;
            let face = list(&frame.face_ids)[index];
            assert_eq!(
                mesh.triangulation().triangle_faces[triangle as usize],
                face,
                "a triangle of the polygon"
            );
            let weights = list(&frame.barycentrics)[index].as_dvec3();
            assert!(weights.min_element() >= 0.0, "inside: {weights}");
            assert!((weights.x + weights.y + weights.z - 1.0).abs() < 2e-7, "together 1: {weights}");
            let [a, b, c] = corners(&scene, &mesh, node, triangle);
            let point = list(&frame.positions)[index].as_dvec3();
            let mixed = a * weights.x + b * weights.y + c * weights.z;
            // Weights and positions are rounded to f32; nothing here is larger than 2.
            assert!(point.distance(mixed) < 1e-6, "{point} is {mixed}");
            let pixel = DVec2::new((index % 97) as f64, (index / 97) as f64) + sample;
            let screen = projector.to_screen(point).expect("before the eye");
            // Rounded to f32 at a distance of 5 m; at outlines vertices are moved by
            // half of 1/256 of a sample in each direction.
            assert!(screen.distance(pixel) < 0.004, "{screen} is not {pixel}");
            let depth = f64::from(list(&frame.depth)[index]);
            let along = (point - camera.position).dot(camera.forward());
            let normal = list(&frame.geometric_normals)[index].as_dvec3();
            let plane = (b - a).cross(c - a).normalize();
            assert!((normal.dot(plane).abs() - 1.0).abs() < 1e-6, "across the plane: {normal}");
            let ray = projector.ray(pixel).expect("a ray").direction;
            assert!(normal.dot(ray) < 1e-3, "towards the eye: {normal}");
            // Moved vertices tilt the rasterizer's plane: it is met as if the ray went
            // through another point within 0.004 pixels.
            let slack = [[0.004, 0.004], [-0.004, 0.004], [0.004, -0.004], [-0.004, -0.004]].map(|offset| {
                let ray = projector.ray(pixel + DVec2::from_array(offset)).expect("a ray");
                let met = ray.at((a - ray.origin).dot(plane) / ray.direction.dot(plane));
                ((met - camera.position).dot(camera.forward()) - along).abs()
            });
            let slack = slack.into_iter().fold(1e-5, f64::max);
            assert!((depth - along).abs() <= slack, "{depth} and {along} at {pixel}, more than {slack}");
        }
        assert!(count > 500, "{count} pixels see it");
    }
}

#[test]
fn inner_pixels_are_met_exactly() {
    for camera in cameras() {
        let mut scene = Scene::new();
        let node = scene.add_object("quad", primitives::plane(8.0, 8.0), Material::default());
        let frame = render(&scene, &camera, &settings(Outputs::ALL)).expect("drawn");
        let projector = Projector::new(&camera, Viewport { width: 97, height: 61 });
        let mut count = 0;
        for (x, y) in (0..61).flat_map(|y| (0..97).map(move |x| (x, y))) {
            let index = (y * 97 + x) as usize;
            let ray = projector.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)).expect("a ray");
            let met = ray.at(-ray.origin.y / ray.direction.y);
            if list(&frame.object_ids)[index] != node.index() as u32 || met.abs().max_element() > 3.9 {
                continue;
            }
            count += 1;
            let point = list(&frame.positions)[index].as_dvec3();
            // The last bit of an f32 below 4.
            assert!(point.distance(met) < 3e-7, "{point} is {met}");
            let uv = list(&frame.uvs)[index].as_dvec2();
            let expected = DVec2::new(met.x / 8.0 + 0.5, met.z / 8.0 + 0.5);
            assert!(uv.distance(expected) < 1e-6, "{uv} is {expected}");
            assert_eq!(list(&frame.normals)[index], Vec3::Y, "straight up");
        }
        assert!(count > 1000, "{count} pixels see it");
    }
}

#[test]
fn normals_of_a_ball_point_away_from_its_middle() {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::uv_sphere(1.0, 64, 32), Material::default());
    let frame = render(&scene, &cameras()[0], &settings(Outputs::ALL)).expect("drawn");
    let seen =
        list(&frame.positions).iter().zip(list(&frame.normals)).filter(|(_, normal)| **normal != Vec3::ZERO);
    let mut count = 0;
    for (point, normal) in seen {
        count += 1;
        // A chord of 1/64 of the circle: normals are interpolated along it.
        assert!(normal.distance(point.normalize()) < 0.005, "{normal} at {point}");
        assert!((normal.length() - 1.0).abs() < 1e-6, "of unit length: {normal}");
    }
    assert!(count > 500, "{count} pixels see it");
}

/// The direction in a texel is told along the image: to the right, up, and off the surface.
#[test]
fn a_normal_map_bends_the_normals_of_outputs() {
    let texel = [204, 178, 230];
    let texture = Texture::new(1, 1, vec![[204, 178, 230, 255]], TextureFormat::Linear).expect("one texel");
    let turn = trigon_math::DQuat::from_xyzw(0.1, 0.5, -0.2, 0.9).normalize();
    for (width, turn) in [(1.0, trigon_math::DQuat::IDENTITY), (1.0, turn), (-1.0, turn)] {
        for scale in [1.0, 0.5, -1.5] {
            let mut scene = Scene::new();
            let binding = TextureBinding::new(scene.add_texture("bumps", texture.clone()));
            let material = Material { normal_map: Some(NormalMap { binding, scale }), ..Material::default() };
            let quad = scene.add_object("quad", primitives::plane(3.0, 3.0), material);
            let placed = DVec3::new(width, 1.0, 1.0);
            let placed = Transform::from_scale_rotation_translation(placed, turn, DVec3::ZERO);
            scene.node_mut(quad).expect("just added").transform = placed;
            let world = scene.world_transform(quad);
            let [x, y, z] = texel.map(|byte| f64::from(byte) / 255.0 * 2.0 - 1.0);
            // The image's top is at -Z, and the quad faces up.
            let scale = f64::from(scale);
            let expected = world.transform_vector3(DVec3::new(x * scale, z, -y * scale)).normalize();
            let [right, up] = [DVec3::X, DVec3::Y].map(|axis| world.transform_vector3(axis));
            let camera = Camera::look_at(up * 4.0 + right * 0.5, DVec3::ZERO, right);
            let frame = render(&scene, &camera, &settings(Outputs::ALL)).expect("drawn");
            let normals = list(&frame.normals).iter().filter(|normal| **normal != Vec3::ZERO);
            assert!(normals.clone().count() > 500, "the quad is seen");
            for normal in normals {
                assert!(normal.as_dvec3().distance(expected) < 1e-5, "{normal}, not {expected}");
            }
        }
    }
}

#[test]
fn albedo_is_what_an_unlit_surface_shows() {
    let mut scene = Scene::new();
    let texels = (0..64 * 64_u32).map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, 128, 255]).collect();
    let texture =
        scene.add_texture("ramp", Texture::new(64, 64, texels, TextureFormat::Srgb).expect("64 × 64"));
    let material = Material { base_color: Vec4::new(0.5, 1.0, 0.25, 1.0), ..Material::from_texture(texture) };
    scene.add_object("quad", primitives::plane(3.0, 3.0), unlit(material));
    let plain = unlit(Material::from_color(Vec3::new(0.1, 0.3, 0.7)));
    let cube = scene.add_object("cube", primitives::cube(0.5), plain);
    let frame = render(&scene, &cameras()[0], &settings(Outputs::ALL)).expect("drawn");
    let mut seen = [0; 2];
    for (index, &object) in list(&frame.object_ids).iter().enumerate().filter(|(_, id)| **id != u32::MAX) {
        let albedo = list(&frame.albedo)[index];
        let is_cube = object as usize == cube.index();
        seen[usize::from(is_cube)] += 1;
        if is_cube {
            assert_eq!(albedo, Vec3::new(0.1, 0.3, 0.7), "to the bit");
        }
        let shown = frame.color[4 * index..][..3].iter().zip(albedo.to_array());
        for (&byte, light) in shown {
            let expected = color::linear_to_srgb8(light);
            assert!(byte.abs_diff(expected) <= 1, "{byte} is {expected} at {index}");
        }
    }
    assert!(seen.iter().all(|&count| count > 50), "both are seen: {seen:?}");
}

#[test]
fn the_background_is_as_documented() {
    let frame = render(&Scene::new(), &cameras()[0], &settings(Outputs::ALL)).expect("drawn");
    assert!(list(&frame.depth).iter().all(|&depth| depth == f32::INFINITY), "infinitely far");
    for ids in [&frame.object_ids, &frame.face_ids, &frame.material_ids, &frame.triangle_ids] {
        assert!(list(ids).iter().all(|&id| id == u32::MAX), "nobody");
    }
    for vectors in
        [&frame.barycentrics, &frame.positions, &frame.normals, &frame.geometric_normals, &frame.albedo]
    {
        assert!(list(vectors).iter().all(|&vector| vector == Vec3::ZERO), "nothing");
    }
    assert!(list(&frame.uvs).iter().all(|&uv| uv == Vec2::ZERO), "nothing");
}

/// Outputs are functions of scene, camera and samples: neither threads nor what else
/// is asked for, nor what a renderer drew before, changes a byte.
#[test]
fn outputs_change_neither_colours_nor_each_other() {
    let scene = showcase();
    let camera = scene.cameras()[0].1;
    let mut renderer = Renderer::builder().build();
    for style in [Style::Surface, Style::SurfaceWithEdges, Style::HiddenLine, Style::Wireframe] {
        let settings = RenderSettings { style, samples_per_axis: 3, ..settings(Outputs::ALL) };
        *renderer.settings_mut() = settings.clone();
        let all = renderer.render(&scene, &camera).expect("drawn");
        for threads in [1, 2, 3] {
            let settings = RenderSettings { threads: NonZeroUsize::new(threads), ..settings.clone() };
            assert!(
                render(&scene, &camera, &settings).expect("drawn") == all,
                "{threads} threads, {style:?}"
            );
        }
        renderer.settings_mut().outputs = Outputs::default();
        let color = renderer.render(&scene, &camera).expect("drawn");
        assert!(
            color == Frame { width: 97, height: 61, color: all.color.clone(), ..Frame::default() },
            "{style:?}"
        );
        renderer.settings_mut().outputs = Outputs { color: false, radiance: false, ..Outputs::ALL };
        let rest = renderer.render(&scene, &camera).expect("drawn");
        let unlit = Frame { color: Vec::new(), radiance: None, ..all.clone() };
        assert!(rest == unlit, "without colours, {style:?}");
        assert_eq!(renderer.stats().pixels_shaded, 0, "nothing is shaded, {style:?}");
    }
}

#[test]
fn what_nobody_asks_for_takes_no_memory() {
    let scene = showcase();
    let camera = scene.cameras()[0].1;
    let mut renderer = Renderer::new(settings(Outputs::default()));
    renderer.render(&scene, &camera).expect("drawn");
    let [objects, faces, triangles] = renderer.id_capacities();
    assert_eq!([objects, faces, triangles], [0; 3], "no ids beside colours");
    renderer.settings_mut().outputs = Outputs { depth: true, ..Outputs::NONE };
    renderer.render(&scene, &camera).expect("drawn");
    assert_eq!(renderer.id_capacities(), [0; 3], "no ids beside depth");
    renderer.settings_mut().outputs = Outputs { ids: true, ..Outputs::NONE };
    renderer.render(&scene, &camera).expect("drawn");
    assert_eq!(renderer.id_capacities()[2], 0, "no triangles beside ids");
}

#[test]
fn blended_surfaces_are_seen_when_asked_for() {
    let mut scene = Scene::new();
    let wall = scene.add_object("wall", primitives::cube(1.0), Material::default());
    let texels = vec![[255, 255, 255, 0], [255, 255, 255, 128]];
    let texture = scene.add_texture("half", Texture::new(2, 1, texels, TextureFormat::Srgb).expect("2 × 1"));
    let mut glass = Material { alpha_mode: AlphaMode::Blend, ..Material::from_texture(texture) };
    let binding = glass.base_color_texture.as_mut().expect("just set");
    binding.sampler.magnification = crate::Filter::Nearest;
    let pane = scene.add_object("pane", primitives::plane(2.0, 2.0), glass);
    scene.node_mut(pane).expect("just added").transform = Transform::from_translation(DVec3::Y);
    let camera = Camera::look_at(DVec3::Y * 6.0, DVec3::ZERO, DVec3::NEG_Z);
    let behind = render(&scene, &camera, &settings(Outputs::ALL)).expect("drawn");
    let before =
        render(&scene, &camera, &settings(Outputs { of_blended: true, ..Outputs::ALL })).expect("drawn");
    assert_eq!(behind.color, before.color, "colours show the same");
    let node = |frame: &Frame, x| frame.hit(scene.nodes(), x, 30).map(|hit| hit.node);
    assert_eq!([node(&behind, 44), node(&behind, 52)], [Some(wall); 2], "what is behind the pane");
    assert_eq!([node(&before, 44), node(&before, 52)], [Some(wall), Some(pane)], "where it has alpha");
    assert!(list(&before.depth)[30 * 97 + 52] < list(&behind.depth)[30 * 97 + 52], "and nearer");
}

/// At ten million metres an f32 counts whole metres.
#[test]
fn positions_relative_to_an_origin_are_as_good_anywhere() {
    let at = |offset: DVec3| {
        let mut scene = Scene::new();
        let ball = scene.add_object("ball", primitives::uv_sphere(1.0, 16, 8), Material::default());
        scene.node_mut(ball).expect("just added").transform = Transform::from_translation(offset);
        let mut camera = cameras()[0];
        camera.position += offset;
        let outputs = Outputs { origin: offset, ..Outputs::ALL };
        let frame = render(&scene, &camera, &settings(outputs)).expect("drawn");
        assert_eq!(frame.origin, offset, "as it was asked for");
        Frame { origin: DVec3::ZERO, ..frame }
    };
    let (near, far) = (at(DVec3::ZERO), at(DVec3::new(1e7, -3e7, 2e7)));
    assert!(near == far, "to the bit");
}

fn list<T>(list: &Option<Vec<T>>) -> &[T] {
    list.as_deref().expect("asked for")
}

/// Light is what the bytes are made of, with exposure and tone mapping or without; and
/// asking for it changes none of them.
#[test]
fn radiance_is_the_light_that_colours_are_made_of() {
    let mut scene = showcase();
    let glass = scene.add_object("glass", primitives::cube(1.0), unlit(Material::default()));
    let material = Material {
        base_color: Vec4::new(4.0, 0.5, 0.0, 0.5),
        alpha_mode: AlphaMode::Blend,
        ..unlit(Material::default())
    };
    let material = scene.add_material(material);
    scene.node_mut(glass).expect("just added").materials = vec![material];
    let camera = scene.overview(1.5);
    for (background, (axis, samples), exposure) in [
        (Background::default(), (1, 1), 0.0),
        (Background::Transparent, (2, 4), 0.0),
        (Background::default(), (2, 1), 1.5),
        (Background::Color(Vec3::splat(0.3)), (1, 8), -1.0),
    ] {
        let mut settings =
            RenderSettings { background, samples_per_axis: axis, samples, ..settings(Outputs::default()) };
        settings.effects.exposure = crate::Exposure::Stops(exposure);
        let plain = render(&scene, &camera, &settings).expect("drawn");
        settings.outputs.radiance = true;
        let both = render(&scene, &camera, &settings).expect("drawn");
        assert!(both.color == plain.color, "the same bytes, {background:?}");
        settings.outputs.color = false;
        let light = render(&scene, &camera, &settings).expect("drawn");
        assert!(light.radiance == both.radiance && light.color.is_empty(), "light alone, {background:?}");
        if exposure == 0.0 {
            let lights = both.radiance.iter().flatten();
            for (light, shown) in lights.zip(both.color.as_chunks::<4>().0) {
                assert_eq!(bytes_of(*light), *shown, "{light}");
            }
        }
        let brightest = both.radiance.iter().flatten().fold(0.0, |most: f32, light| most.max(light.x));
        assert!(brightest > 1.5, "brighter than white: {brightest}");
    }
}

/// The bytes of light, premultiplied.
fn bytes_of(light: Vec4) -> [u8; 4] {
    if light.w <= 0.0 {
        return [0; 4];
    }
    let [r, g, b] = (light.truncate() / light.w).to_array().map(color::linear_to_srgb8);
    [r, g, b, (light.w * 255.0 + 0.5) as u8]
}
