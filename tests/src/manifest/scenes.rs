//! Images of a scene with every effect that can be on at once.

use std::sync::Arc;

use trigon_math::Vec3;
use trigon_raster::ExecuteSettings;
use trigon_scene::{
    AmbientOcclusion, Background, EffectSettings, Environment, Exposure, Fog, Frame, Outline, RaySampling,
    RenderSettings, Renderer, Scene, Shadows, SightRays, Sky, SoftShadows, Style, ToneMapping, showcase,
};

/// Their names.
pub(super) const NAMES: [&str; 6] = [
    "scene: rays at every sample",
    "scene: rays that pixels share",
    "scene: shadow maps, studio",
    "scene: soft shadows by rays at every sample",
    "scene: soft shadows by rays that pixels share",
    "scene: soft shadows by maps",
];

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

fn settings(scene: &Scene) -> [RenderSettings; 6] {
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
    let soft =
        [(&all, 3, RaySampling::Full), (&shared, 32, RaySampling::Shared), (&maps, 1, RaySampling::Full)];
    let [soft_all, soft_shared, soft_maps] = soft.map(|(like, rays, sampling)| {
        let mut soft = like.clone();
        soft.effects.soft_shadows = SoftShadows { radius: 0.1, rays, sampling };
        soft
    });
    [all, shared, maps, soft_all, soft_shared, soft_maps]
}
