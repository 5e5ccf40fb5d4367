//! Images of a scene with every effect that can be on at once.

use std::sync::Arc;

use trigon_math::Vec3;
use trigon_raster::ExecuteSettings;
use trigon_scene::{
    AmbientOcclusion, Background, EffectSettings, Environment, Exposure, Fog, Frame, Outline, RaySampling,
    RenderSettings, Renderer, Scene, Shadows, SightRays, Sky, Style, ToneMapping, showcase,
};

/// Their names.
pub(super) const NAMES: [&str; 3] =
    ["scene: rays at every sample", "scene: rays that pixels share", "scene: shadow maps, studio"];

/// The images of [`NAMES`].
pub(super) fn images(execution: &ExecuteSettings) -> impl Iterator<Item = Frame> {
    let scene = showcase();
    let settings = settings(&scene);
    let camera = scene.cameras()[0].1;
    settings.into_iter().map(move |settings| {
        let settings = RenderSettings { threads: execution.threads, simd: execution.simd, ..settings };
        Renderer::new(settings).render(&scene, &camera).expect("it is small")
    })
}

fn settings(scene: &Scene) -> [RenderSettings; 3] {
    let nodes =
        scene.nodes().iter().filter(|(_, node)| node.mesh.is_some()).map(|(id, _)| id).skip(1).take(1);
    let occlusion = |rays, sampling| Some(AmbientOcclusion { sampling, ..AmbientOcclusion::new(rays, 1.0) });
    let effects = EffectSettings {
        shadows: Shadows::Rays,
        ambient_occlusion: occlusion(3, RaySampling::Full),
        environment: Some(Arc::new(Environment::from_sky(&Sky::default()))),
        sight: SightRays::all(3),
        fog: Some(Fog { color: Vec3::splat(0.5), density: 0.05 }),
        exposure: Exposure::Stops(0.5),
        tone_mapping: ToneMapping::KhronosPbrNeutral,
        outline: Some(Outline { nodes: nodes.collect(), color: Vec3::X, width: 2 }),
        ..EffectSettings::default()
    };
    let mut all = RenderSettings {
        samples_per_axis: 1,
        samples: 2,
        style: Style::SurfaceWithEdges,
        background: Background::Environment,
        effects,
        ..RenderSettings::new(50, 31)
    };
    (all.outputs.radiance, all.outputs.depth, all.outputs.ids) = (true, true, true);
    let mut shared = all.clone();
    shared.effects.ambient_occlusion = occlusion(32, RaySampling::Shared);
    let mut maps = RenderSettings { background: Background::default(), ..shared.clone() };
    (maps.effects.shadows, maps.effects.environment) = (Shadows::Maps { resolution: 128 }, None);
    [all, shared, maps]
}
