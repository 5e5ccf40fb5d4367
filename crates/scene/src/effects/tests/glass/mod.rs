//! What is behind glass, against rays that are traced here in f64, with spheres and planes instead of meshes.

mod traced;

use trigon_math::DVec2;
use trigon_mesh::{Mesh, MeshBuilder};

use super::*;
use crate::{Absence, Cause, Effect, Reflection};
use traced::{SQUARE, WALL, traced};

/// Clear glass of an index of refraction, thin.
fn glass(ior: f32) -> Material {
    Material { transmission: 1.0, ior, ..metal(0.0) }
}

/// The same with something beneath its surface.
fn solid(ior: f32) -> Material {
    Material { thickness: 1.0, double_sided: false, ..glass(ior) }
}

fn unlit(color: Vec3) -> Material {
    Material { shading: Shading::Unlit, ..matt(color) }
}

fn add(scene: &mut Scene, mesh: Mesh, material: Material, at: DVec3) {
    let id = scene.add_object("it", mesh, material);
    scene.node_mut(id).expect("just added").transform =
        Transform::from_scale_rotation_translation(DVec3::ONE, DQuat::IDENTITY, at);
}

/// A plane that faces +Z.
fn wall(width: f32, height: f32) -> Mesh {
    standing(primitives::plane(width, height))
}

fn standing(mesh: Mesh) -> Mesh {
    let mut builder = MeshBuilder::new();
    for position in mesh.positions() {
        builder.push_vertex(Vec3::new(position.x, -position.z, position.y));
    }
    for face in 0..mesh.face_count() {
        builder.push_face(mesh.face_vertices(face)).expect("as before");
    }
    builder.build()
}

fn linear(frame: &Frame, x: u32, y: u32) -> Vec3 {
    let [r, g, b, _] = frame.pixel(x, y);
    Vec3::from([r, g, b].map(color::srgb8_to_linear))
}

fn middle(scene: &Scene, effects: EffectSettings) -> Vec3 {
    linear(&render(scene, &from_front(), &settings(effects)).expect("drawn"), SIDE / 2, SIDE / 2)
}

/// Beer's law for what the eye sees straight through: the colour to the power of the way in attenuation
/// distances. Nothing is reflected where the index is that of air.
#[test]
fn a_pane_dims_what_is_behind_it_by_the_way_through_it() {
    let behind = Vec3::new(0.9, 0.6, 0.4);
    let attenuation_color = Vec3::new(0.5, 0.9, 0.1);
    for (thickness, distance) in [(0.5_f32, 0.5_f32), (0.5, 0.2), (0.25, 2.0)] {
        let air = Material { thickness, attenuation_distance: distance, attenuation_color, ..solid(1.0) };
        let left = |channel: usize| {
            let exponent = f64::from(thickness) / f64::from(distance);
            f64::from(behind[channel]) * elementary::pow(f64::from(attenuation_color[channel]), exponent)
        };
        let expected = Vec3::from([0, 1, 2].map(|channel| left(channel) as f32));
        // A box, in which rays find their way, and a pane without other faces, which says how thick it is.
        for mesh in [primitives::cube(thickness), wall(2.0, 2.0)] {
            let mut scene = Scene::new();
            add(&mut scene, mesh, air.clone(), DVec3::ZERO);
            add(&mut scene, wall(3.0, 3.0), unlit(behind), DVec3::NEG_Z * 3.0);
            let shown = middle(&scene, EffectSettings::default());
            assert!((shown - expected).abs().max_element() < 0.006, "{shown}, not {expected}");
        }
    }
}

#[test]
fn an_open_pane_is_as_thick_as_its_node_and_its_texture_say() {
    let half = Material {
        attenuation_distance: 0.5,
        attenuation_color: Vec3::splat(0.5),
        thickness: 0.25,
        ..solid(1.0)
    };
    let mut scene = Scene::new();
    let id = scene.add_object("pane", primitives::plane(1.0, 1.0), half);
    let turn = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
    scene.node_mut(id).expect("just added").transform =
        Transform::from_scale_rotation_translation(DVec3::splat(2.0), turn, DVec3::ZERO);
    add(&mut scene, wall(3.0, 3.0), unlit(Vec3::splat(0.8)), DVec3::NEG_Z * 3.0);
    let shown = middle(&scene, EffectSettings::default());
    assert!((shown - 0.4).abs().max_element() < 0.006, "half a metre of half a metre: {shown}");
    let texture = Texture::new(1, 1, vec![[9, 128, 9, 9]], TextureFormat::Linear).expect("a texel");
    let binding = TextureBinding::new(scene.add_texture("half", texture));
    scene.materials.iter_mut().for_each(|(_, material)| {
        if material.thickness > 0.0 {
            material.thickness_texture = Some(binding);
        }
    });
    let shown = middle(&scene, EffectSettings::default());
    let expected = (0.8 * elementary::pow(0.5, 128.0 / 255.0)) as f32;
    assert!((shown - expected).abs().max_element() < 0.006, "half as thick: {shown}, not {expected}");
}

/// Two nodes that share a pane: each is as thick as its own scale makes it.
#[test]
fn nodes_that_share_a_pane_have_their_own_thickness() {
    let material = Material {
        attenuation_distance: 0.5,
        attenuation_color: Vec3::splat(0.5),
        thickness: 0.25,
        ..solid(1.0)
    };
    let mut scene = Scene::new();
    let (mesh, material) = (scene.add_mesh("pane", wall(0.5, 0.5)), scene.add_material(material));
    for (x, scale) in [(-1.0, 1.0), (1.0, 2.0)] {
        let place = (DVec3::splat(scale), DQuat::IDENTITY, DVec3::X * x);
        let place = Transform::from_scale_rotation_translation(place.0, place.1, place.2);
        scene.add(Node::from_mesh(mesh, material).with_transform(place));
    }
    add(&mut scene, wall(4.0, 4.0), unlit(Vec3::splat(0.8)), DVec3::NEG_Z * 3.0);
    let frame = render(&scene, &from_front(), &settings(EffectSettings::default())).expect("drawn");
    for (x, exponent) in [(SIDE / 4, 0.5), (3 * SIDE / 4, 1.0)] {
        let (shown, expected) = (linear(&frame, x, SIDE / 2), (0.8 * elementary::pow(0.5, exponent)) as f32);
        assert!((shown - expected).abs().max_element() < 0.006, "{shown}, not {expected}");
    }
}

/// A pane that is not there: whatever is behind it, the image is the same, even where the eye sees through
/// masks and through faces that are seen from behind.
#[test]
fn a_clear_pane_of_no_index_changes_nothing() {
    let scene = |with_pane: bool| {
        let mut scene = Scene::new();
        let holes = vec![[255, 90, 30, 255], [0; 4], [0; 4], [30, 90, 255, 255]];
        let holes = Texture::new(2, 2, holes, TextureFormat::Srgb).expect("four texels");
        let mut fence = Material::from_texture(scene.add_texture("holes", holes));
        fence = Material { alpha_mode: AlphaMode::Mask { cutoff: 0.5 }, shading: Shading::Unlit, ..fence };
        let fence_id = scene.add_object("fence", primitives::plane(2.5, 1.0), fence);
        scene.node_mut(fence_id).expect("just added").transform = Transform::from_scale_rotation_translation(
            DVec3::ONE,
            DQuat::from_rotation_arc(DVec3::Y, DVec3::Z),
            DVec3::new(0.0, 0.5, -1.0),
        );
        add(
            &mut scene,
            primitives::uv_sphere(0.6, 32, 16),
            matt(Vec3::new(0.2, 0.6, 0.3)),
            DVec3::NEG_Z * 2.0,
        );
        let mut away = wall(1.0, 1.0);
        away = mirrored_faces(&away);
        add(
            &mut scene,
            away,
            Material { double_sided: false, ..unlit(Vec3::X) },
            DVec3::new(0.0, -0.5, -0.5),
        );
        scene.add(Node::from_light(Light::point(9.0)).at(DVec3::new(1.0, 2.0, 3.0)));
        scene.add(Node::from_light(Light::ambient(0.3)));
        if with_pane {
            add(&mut scene, wall(3.0, 3.0), glass(1.0), DVec3::Z);
        }
        scene
    };
    let gradient = Background::Gradient { top: Vec3::new(0.9, 0.1, 0.3), bottom: Vec3::new(0.1, 0.4, 0.9) };
    let perspective = Camera::look_at(DVec3::new(0.3, 0.4, 5.0), DVec3::ZERO, DVec3::Y);
    for (camera, exposure) in [(from_front(), 0.0), (perspective, 0.0), (perspective, -1.0)] {
        let effects = EffectSettings { exposure: Exposure::Stops(exposure), ..EffectSettings::default() };
        let settings = RenderSettings { background: gradient, ..settings(effects) };
        let [without, with] =
            [false, true].map(|with_pane| render(&scene(with_pane), &camera, &settings).expect("drawn"));
        let differing = (without.color.iter().zip(&with.color)).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert!(differing <= without.color.len() / 1000, "{differing} values differ, exposure {exposure}");
    }
}

fn mirrored_faces(mesh: &Mesh) -> Mesh {
    let mut builder = MeshBuilder::new();
    mesh.positions().iter().for_each(|&position| {
        builder.push_vertex(position);
    });
    for face in 0..mesh.face_count() {
        let corners: Vec<u32> = mesh.face_vertices(face).iter().rev().copied().collect();
        builder.push_face(&corners).expect("as before");
    }
    builder.build()
}

/// White squares on black.
fn checker(scene: &mut Scene) {
    for x in -8..8 {
        for y in (-8..8).filter(|y| (x + y) % 2 == 0) {
            let at = DVec3::new((f64::from(x) + 0.5) * SQUARE, (f64::from(y) + 0.5) * SQUARE, WALL);
            add(scene, wall(SQUARE as f32, SQUARE as f32), unlit(Vec3::splat(0.9)), at);
        }
    }
}

/// Compares an image of bodies before the checker with rays in f64.
fn compare(scene: &Scene, spheres: &[(f64, f64)], reach: f64) {
    let frame = render(scene, &from_front(), &settings(EffectSettings::default())).expect("drawn");
    let (mut compared, mut white) = (0, 0);
    for (x, y) in (0..SIDE).flat_map(|x| (0..SIDE).map(move |y| (x, y))) {
        let at = |pixel: u32| (f64::from(pixel) + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0;
        let place = DVec2::new(at(x), -at(y));
        if place.length() > reach {
            continue;
        }
        let Some(expected) = traced(place, spheres) else { continue };
        let shown = f64::from(linear(&frame, x, y).y);
        assert!((shown - expected).abs() < 0.02, "{shown} at {place}, not {expected}");
        compared += 1;
        white += usize::from(expected > 0.0);
    }
    assert!(compared > 150 && white * 4 > compared && white * 4 < 3 * compared, "{white} of {compared}");
}

#[test]
fn a_ball_of_glass_turns_a_checker_as_rays_in_f64_do() {
    for ior in [1.2, 1.5, 2.0] {
        let mut scene = Scene::new();
        add(&mut scene, primitives::uv_sphere(1.0, 512, 256), solid(ior), DVec3::ZERO);
        checker(&mut scene);
        compare(&scene, &[(1.0, f64::from(ior))], 0.9);
    }
}

/// A hollow ball, as one surface whose inside faces the hollow; and a ball of another index within a ball.
#[test]
fn bodies_within_bodies_bend_light_as_rays_in_f64_do() {
    let ball = |radius: f32| primitives::uv_sphere(radius, 512, 256);
    let mut hollow = Scene::new();
    add(&mut hollow, ball(1.0), solid(1.5), DVec3::ZERO);
    let nested = hollow.clone();
    add(&mut hollow, mirrored_faces(&ball(0.8)), solid(1.5), DVec3::ZERO);
    checker(&mut hollow);
    compare(&hollow, &[(1.0, 1.5), (0.8, 1.0)], 0.75);
    let mut nested = nested;
    add(&mut nested, ball(0.6), solid(1.2), DVec3::ZERO);
    checker(&mut nested);
    compare(&nested, &[(1.0, 1.5), (0.6, 1.2)], 0.9);
}

/// The faces of a slab are parallel: it displaces what is behind it by t sin θ (1 − cos θ / √(n² − sin² θ)), and lets
/// through what neither face reflects by the formulas of A. Fresnel.
#[test]
fn a_slanting_slab_displaces_what_is_behind_it() {
    for (ior, degrees, thickness) in [(1.33, 20.0, 0.6), (1.5, 45.0, 0.4), (2.4, 60.0, 0.3)] {
        let [sine, cosine] =
            [elementary::sin(f64::to_radians(degrees)), elementary::cos(f64::to_radians(degrees))];
        let bent = (ior * ior - sine * sine).sqrt();
        let displaced = thickness * sine * (1.0 - cosine / bent);
        let [across, along] =
            [(cosine - bent) / (cosine + bent), (ior * ior * cosine - bent) / (ior * ior * cosine + bent)];
        let reflected = (across * across + along * along) / 2.0;
        let mut scene = Scene::new();
        let slab = scene.add_object("slab", primitives::cube(1.0), solid(ior as f32));
        scene.node_mut(slab).expect("just added").transform = Transform::from_scale_rotation_translation(
            DVec3::new(3.0, 3.0, thickness),
            DQuat::from_rotation_arc(DVec3::Z, DVec3::new(sine, 0.0, cosine)),
            DVec3::ZERO,
        );
        checker(&mut scene);
        let frame = render(&scene, &from_front(), &settings(EffectSettings::default())).expect("drawn");
        let at = |pixel: u32| (f64::from(pixel) + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0;
        for (x, y) in (0..SIDE).flat_map(|x| (0..SIDE).map(move |y| (x, y))) {
            let square = DVec2::new(at(x) - displaced, -at(y)) / SQUARE;
            let is_near = |value: f64| (value - value.round()).abs() < 0.004;
            // The slab covers the middle of the image.
            if at(x).abs() > 0.4 || at(y).abs() > 1.4 || is_near(square.x) || is_near(square.y) {
                continue;
            }
            let is_white = (square.x.floor() + square.y.floor()).rem_euclid(2.0) == 0.0;
            let expected = if is_white { 0.9 * (1.0 - reflected) * (1.0 - reflected) } else { 0.0 };
            let shown = f64::from(linear(&frame, x, y).y);
            assert!((shown - expected).abs() < 0.03, "{shown}, not {expected}, at {square} behind {ior}");
        }
    }
}

/// Without a volume glass is as thin as a soap bubble: everything behind it is where it was.
#[test]
fn thin_glass_bends_nothing() {
    let mut scene = Scene::new();
    let bubble = Material { double_sided: false, ..glass(1.5) };
    add(&mut scene, primitives::uv_sphere(1.0, 512, 256), bubble, DVec3::ZERO);
    checker(&mut scene);
    let frame = render(&scene, &from_front(), &settings(EffectSettings::default())).expect("drawn");
    for (x, y) in [(64, 64), (72, 56), (80, 80), (48, 72), (40, 56)] {
        let at = |pixel: u32| (f64::from(pixel) + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0;
        let place = DVec2::new(at(x), -at(y));
        let is_white = ((place.x / SQUARE).floor() + (place.y / SQUARE).floor()).rem_euclid(2.0) == 0.0;
        let cosine = (1.0 - place.length_squared()).sqrt();
        let expected = if is_white { 0.9 * (0.96 - 0.96 * elementary::pow(1.0 - cosine, 5.0)) } else { 0.0 };
        let shown = f64::from(linear(&frame, x, y).y);
        assert!((shown - expected).abs() < 0.02, "{shown} at {place}, not {expected}");
    }
}

/// A right-angled prism before the eye, its long face at 45°: beyond an index of √2 it reflects all light,
/// below that it lets it through.
#[test]
fn a_prism_reflects_totally_beyond_the_critical_angle() {
    let mut builder = MeshBuilder::new();
    for y in [-1.0, 1.0] {
        for (x, z) in [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)] {
            builder.push_vertex(Vec3::new(x, y, z));
        }
    }
    for face in [&[0, 2, 1][..], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[0, 3, 5, 2]] {
        builder.push_face(face).expect("a face");
    }
    let prism = builder.build();
    let shown = |ior: f32| {
        let mut scene = Scene::new();
        add(&mut scene, prism.clone(), solid(ior), DVec3::ZERO);
        let beside = scene.add_object("beside", primitives::plane(9.0, 9.0), unlit(Vec3::new(0.8, 0.0, 0.0)));
        scene.node_mut(beside).expect("just added").transform = Transform::from_scale_rotation_translation(
            DVec3::ONE,
            DQuat::from_rotation_arc(DVec3::Y, DVec3::NEG_X),
            DVec3::X * 3.0,
        );
        add(&mut scene, wall(19.0, 9.0), unlit(Vec3::new(0.0, 0.8, 0.0)), DVec3::NEG_Z * 3.0);
        middle(&scene, EffectSettings::default())
    };
    // Head-on (1 − F0)² of the light comes in and goes out.
    let passed = |ior: f32| {
        let root = (ior - 1.0) / (ior + 1.0);
        (1.0 - root * root) * (1.0 - root * root)
    };
    for ior in [1.45, 1.5, 2.4] {
        let (found, expected) = (shown(ior), Vec3::new(0.8 * passed(ior), 0.0, 0.0));
        assert!((found - expected).abs().max_element() < 0.01, "{found} at {ior}, not {expected}");
    }
    for ior in [1.1, 1.3] {
        let found = shown(ior);
        assert!(found.x < 0.01 && found.y > 0.6, "{found} at {ior}: through the long face");
    }
}

/// Whoever turns glass off is told what becomes of it.
#[test]
fn glass_is_on_and_an_opaque_one_has_a_reason() {
    let mut scene = Scene::new();
    scene.add_object("bowl", primitives::uv_sphere(1.0, 16, 8), glass(1.5));
    let decision = |change: &dyn Fn(&mut RenderSettings)| {
        let mut settings = settings(EffectSettings::default());
        change(&mut settings);
        EffectPlan::new(&scene, &from_front(), &settings).decision(Effect::Refraction).clone()
    };
    let on = decision(&|_| {});
    assert!(
        matches!(&on, Decision::On(Cause::Glass { objects, bounces: 8 }) if objects.first == "bowl"),
        "{on}"
    );
    assert!(
        on.to_string().contains("up to 8 surfaces") && on.to_string().contains("without highlights"),
        "{on}"
    );
    let off = decision(&|settings| settings.effects.sight = SightRays::Off);
    assert!(matches!(off, Decision::Off(Absence::GlassNotRequested(_))), "{off}");
    let shading = decision(&|settings| settings.shading = ShadingModel::Gouraud);
    let reflection = decision(&|settings| settings.reflection = Reflection::Lambert);
    for otherwise in [shading, reflection] {
        assert!(matches!(otherwise, Decision::Off(Absence::GlassLitOtherwise(_))), "{otherwise}");
        assert!(
            otherwise.to_string().contains("`bowl` is glass, and is drawn as if it were opaque"),
            "{otherwise}"
        );
    }
}
