//! Colours: layers, backgrounds, effects, and the same bytes everywhere.

use std::num::NonZeroUsize;
use std::sync::Arc;

use trigon_camera::{FisheyeCamera, UpAxis};
use trigon_math::{DQuat, DVec3, Vec3, Vec4};
use trigon_scene::mesh::primitives;
use trigon_scene::{
    Absence, AlphaMode, AmbientOcclusion, Background, Decision, Effect, EffectPlan, Environment, Exposure,
    Material, Omission, Outline, Outputs, RenderSettings, Renderer, Scene, Shading, Shadows, SightRays,
    SimdLevel, Style, ToneMapping, render_fisheye, showcase,
};

use super::{camera, lens, mesh, settings};

const SIDE: u32 = 40;

/// Pixels of 5°, all around.
fn around(position: DVec3) -> FisheyeCamera {
    let lens =
        lens(SIDE, 36.0 / std::f64::consts::PI, [0.0; 4]).with_fov(190_f64.to_radians()).expect("valid");
    camera(position, DQuat::IDENTITY, lens)
}

fn sheet(distance: f32) -> trigon_scene::mesh::Mesh {
    let z = -distance;
    mesh(&[[-9.0, -9.0, z], [9.0, -9.0, z], [9.0, 9.0, z], [-9.0, 9.0, z]], &[&[0, 1, 2, 3]])
}

fn unlit(color: Vec4, alpha_mode: AlphaMode) -> Material {
    Material { base_color: color, alpha_mode, shading: Shading::Unlit, ..Material::default() }
}

#[test]
fn layers_are_blended_from_the_back() {
    let mut scene = Scene::new();
    let layers = [
        (4.0, Vec4::new(0.0, 0.0, 1.0, 1.0), AlphaMode::Opaque),
        (2.0, Vec4::new(0.0, 1.0, 0.0, 0.5), AlphaMode::Blend),
        (1.0, Vec4::new(1.0, 0.0, 0.0, 0.25), AlphaMode::Blend),
        // A hole: less alpha than the cutoff.
        (0.5, Vec4::new(1.0, 1.0, 1.0, 0.3), AlphaMode::Mask { cutoff: 0.4 }),
    ];
    for (distance, color, mode) in layers {
        scene.add_object("sheet", sheet(distance), unlit(color, mode));
    }
    let outputs = Outputs { radiance: true, ids: true, ..Outputs::NONE };
    let frame = render_fisheye(&scene, &around(DVec3::ZERO), &settings(SIDE, outputs)).expect("drawn");
    let middle = (SIDE * SIDE / 2 + SIDE / 2) as usize;
    // A quarter of red; of the rest half of green; of the rest all of blue.
    let expected = Vec4::new(0.25, 0.375, 0.375, 1.0);
    let light = frame.radiance.expect("radiance")[middle];
    assert!((light - expected).abs().max_element() < 1e-6, "{light}");
    assert_eq!(frame.object_ids.expect("ids")[middle], 0, "translucent surfaces have no ids");
}

#[test]
fn nothing_is_drawn_beyond_the_lens() {
    let red = Vec3::new(1.0, 0.0, 0.0);
    let settings =
        RenderSettings { background: Background::Color(red), ..settings(SIDE, Outputs::default()) };
    let mut scene = Scene::new();
    scene.add_object("walls", primitives::cube(40.0), Material { double_sided: true, ..Material::default() });
    let frame = render_fisheye(&scene, &around(DVec3::ZERO), &settings).expect("drawn");
    assert_eq!(frame.pixel(0, 0), [255, 0, 0, 255], "the corner is 143° from the axis");
    assert_ne!(frame.pixel(SIDE / 2, SIDE / 2), [255, 0, 0, 255], "the wall");
}

/// An environment of one colour for each half: what is above is white.
#[test]
fn an_environment_is_visible_along_the_rays() {
    let rows = [vec![[1.0; 3]; 64 * 16], vec![[0.0; 3]; 64 * 16]].concat();
    let environment = Environment::from_equirectangular(64, 32, &rows).expect("valid");
    let mut settings = settings(SIDE, Outputs::default());
    settings.background = Background::Environment;
    settings.effects.environment = Some(Arc::new(environment));
    let mut scene = Scene::new();
    scene.up = UpAxis::Y;
    let frame = render_fisheye(&scene, &around(DVec3::ZERO), &settings).expect("drawn");
    let middle = SIDE / 2;
    assert!(frame.pixel(middle, middle - 12)[0] > 250, "60° above");
    assert!(frame.pixel(middle, middle + 12)[0] < 5, "60° below");
    assert_eq!(frame.pixel(0, 0), [0, 0, 0, 255], "beyond the lens there is none");
}

/// With everything that rays may meet.
fn rich() -> (Scene, RenderSettings) {
    let mut scene = showcase();
    let glass = Material { transmission: 1.0, ..Material::default() };
    scene.add_object("glass", primitives::icosphere(0.3, 2), glass);
    let blended = unlit(Vec4::new(0.2, 0.6, 1.0, 0.5), AlphaMode::Blend);
    scene.add_object("film", sheet(1.0), blended);
    let mut settings = RenderSettings { samples_per_axis: 2, ..settings(SIDE, Outputs::ALL) };
    settings.effects.shadows = Shadows::Rays;
    settings.effects.sight = SightRays::All { bounces: 3 };
    settings.effects.ambient_occlusion = Some(AmbientOcclusion::new(4, 1.0));
    (settings.effects.tone_mapping, settings.effects.exposure) =
        (ToneMapping::KhronosPbrNeutral, Exposure::Stops(0.5));
    (scene, settings)
}

#[test]
fn neither_threads_nor_levels_change_a_byte() {
    let (scene, settings) = rich();
    let camera = around(DVec3::new(0.0, 0.8, 1.5));
    let expected = render_fisheye(&scene, &camera, &settings).expect("drawn");
    let depth = expected.depth.as_ref().expect("depth");
    assert!(depth.iter().filter(|depth| depth.is_finite()).count() > 300, "the scene is visible");
    for threads in [1, 3] {
        let settings = RenderSettings { threads: NonZeroUsize::new(threads), ..settings.clone() };
        assert!(render_fisheye(&scene, &camera, &settings).expect("drawn") == expected, "{threads} threads");
    }
    for level in SimdLevel::ALL.into_iter().filter(|level| level.is_supported()) {
        let settings = RenderSettings { simd: Some(level), ..settings.clone() };
        assert!(render_fisheye(&scene, &camera, &settings).expect("drawn") == expected, "{level}");
    }
}

/// A renderer caches triangles, and draws other frames in between.
#[test]
fn what_a_renderer_caches_changes_no_byte() {
    let (mut scene, settings) = rich();
    let eye = around(DVec3::new(0.0, 0.8, 1.5));
    let mut renderer = Renderer::new(settings.clone());
    let overview = scene.overview(1.0);
    let flat = renderer.render(&scene, &overview).expect("drawn");
    let count = renderer.stats().pixels_shaded;
    for step in 0..2 {
        let moved = scene.nodes().iter().map(|(id, _)| id).last().expect("the film");
        scene.node_mut(moved).expect("the film").visible = step == 0;
        let expected = render_fisheye(&scene, &eye, &settings).expect("drawn");
        for _ in 0..2 {
            assert!(renderer.render_fisheye(&scene, &eye).expect("drawn") == expected, "step {step}");
            assert!(renderer.stats().pixels_shaded > 1000, "surfaces of four samples in 1600 pixels");
        }
    }
    let moved = scene.nodes().iter().map(|(id, _)| id).last().expect("the film");
    scene.node_mut(moved).expect("the film").visible = true;
    assert!(renderer.render(&scene, &overview).expect("drawn") == flat, "and the other way round");
    assert_eq!(renderer.stats().pixels_shaded, count, "of its own");
}

#[test]
fn more_samples_are_the_mean_of_finer_pixels() {
    let scene = showcase();
    let camera = around(DVec3::new(0.0, 0.8, 1.5));
    let outputs = Outputs { radiance: true, ..Outputs::NONE };
    // A background has one colour for each pixel, and not for each sample.
    let on_black =
        |side| RenderSettings { background: Background::Color(Vec3::ZERO), ..settings(side, outputs) };
    let coarse = RenderSettings { samples_per_axis: 2, ..on_black(SIDE) };
    let [coarse, multisampled, fine] =
        [coarse.clone(), RenderSettings { samples_per_axis: 1, samples: 4, ..coarse }, on_black(2 * SIDE)]
            .map(|settings| {
                render_fisheye(&scene, &camera, &settings).expect("drawn").radiance.expect("radiance")
            });
    assert!(coarse == multisampled, "multisampling takes samples on a grid");
    let mut worst = 0.0_f32;
    for at in 0..SIDE * SIDE {
        let [x, y] = [at % SIDE * 2, at / SIDE * 2];
        let four = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| fine[((y + j) * 2 * SIDE + x + i) as usize]);
        let mean = four.into_iter().sum::<Vec4>() / 4.0;
        let error = (mean - coarse[at as usize]).abs().max_element() / (1.0 + mean.max_element());
        worst = worst.max(error);
    }
    // The rays are the same; four numbers are added and divided otherwise.
    assert!(worst < 1e-6, "off by {worst}");
}

#[test]
fn what_is_left_out_is_said() {
    let mut scene = showcase();
    let mut builder = trigon_scene::mesh::MeshBuilder::with_capacity(1, 0, 0);
    let vertex = builder.push_vertex(Vec3::ZERO);
    builder.push_loose_point(vertex).expect("its vertex");
    scene.add_object("dot", builder.build(), Material::default());
    let mut settings = settings(SIDE, Outputs::default());
    settings.style = Style::SurfaceWithEdges;
    let texts: Vec<String> = Omission::all(&scene, &settings).iter().map(ToString::to_string).collect();
    assert_eq!(
        texts,
        [
            "edges of faces are not drawn through a fisheye lens",
            "the lines and points of `dot` are not drawn through a fisheye lens",
        ]
    );
    let camera = around(DVec3::new(0.0, 0.8, 1.5));
    let plan = EffectPlan::of_fisheye(&scene, &camera, &settings);
    assert_eq!(*plan.decision(Effect::Edges), Decision::Off(Absence::FisheyeLens));
    assert!(plan.is_on(Effect::Lamps), "the rest is planned as ever");
    let plain = RenderSettings { style: Style::Surface, ..settings.clone() };
    let [edged, surfaces] = [settings, plain].map(|settings| render_fisheye(&scene, &camera, &settings));
    assert!(edged == surfaces, "surfaces are drawn in their place");
}

#[test]
fn outlines_surround_what_rays_meet() {
    let mut scene = Scene::new();
    let ball = scene.add_object("ball", primitives::icosphere(1.0, 2), Material::default());
    let camera = around(DVec3::new(0.0, 0.0, 3.0));
    let mut settings = settings(SIDE, Outputs { ids: true, ..Outputs::default() });
    let plain = render_fisheye(&scene, &camera, &settings).expect("drawn");
    settings.effects.outline = Some(Outline { nodes: vec![ball], color: Vec3::X, width: 1 });
    let outlined = render_fisheye(&scene, &camera, &settings).expect("drawn");
    let ids = outlined.object_ids.as_ref().expect("ids");
    let differs = |at: usize| plain.color[4 * at..4 * at + 4] != outlined.color[4 * at..4 * at + 4];
    let changed: Vec<usize> = (0..ids.len()).filter(|&at| differs(at)).collect();
    assert!(changed.len() > 20, "{} pixels", changed.len());
    assert!(changed.iter().all(|&at| ids[at] == u32::MAX), "around the ball");
}
