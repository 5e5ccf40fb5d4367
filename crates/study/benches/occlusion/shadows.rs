//! Soft shadows of a sun of several sizes.

use std::error::Error;

use trigon_camera::Camera;
use trigon_math::DVec3;
use trigon_scene::{
    Effect, Light, Node, RaySampling, RenderSettings, Renderer, Shadows, SoftShadows, Transform,
};

use crate::scenes::Subject;
use crate::{costs, error, settings, surfaces, truth};

/// Radii of the sun's disc at one metre; the first one is that of the sun.
const RADII: [f32; 3] = [0.00465, 0.05, 0.2];

/// The rays that are compared, and where they start.
const RAYS: [(u32, RaySampling); 6] = [
    (16, RaySampling::Full),
    (64, RaySampling::Full),
    (16, RaySampling::Shared),
    (32, RaySampling::Shared),
    (64, RaySampling::Shared),
    (128, RaySampling::Shared),
];

/// Texels of the maps that are compared.
const MAPS: [u32; 2] = [1024, 2048];

/// Whence the sun shines.
const TOWARDS: DVec3 = DVec3::new(0.5, 0.8, 0.35);

/// Prints errors, and costs above the frame with the sharp shadow of the same kind.
pub(crate) fn report(subject: &Subject) -> Result<(), Box<dyn Error>> {
    let turned = Camera::look_at(TOWARDS, DVec3::ZERO, DVec3::Y).orientation;
    let sun = Node::from_light(Light::directional(1.0))
        .with_transform(Transform::from_scale_rotation_translation(DVec3::ONE, turned, DVec3::ZERO));
    let (white, own) = (subject.in_white().in_light(sun.clone()), subject.in_light(sun));
    let surfaces = surfaces(&white)?;
    let normals = surfaces.normals.iter().flatten();
    let facing = normals.map(|normal| normal.as_dvec3().dot(TOWARDS.normalize()).max(0.0));
    let facing: Vec<f64> = facing.collect();
    for radius in RADII {
        println!("  radius {radius}");
        let truth = truth::visibility(&surfaces, &white, TOWARDS.normalize(), f64::from(radius));
        let truth: Vec<Option<f64>> =
            truth.iter().zip(&facing).map(|(visible, facing)| Some((*visible)? * facing)).collect();
        for shadows in [Shadows::Rays].into_iter().chain(MAPS.map(|resolution| Shadows::Maps { resolution }))
        {
            let rays: &[_] = if shadows == Shadows::Rays { &RAYS } else { &RAYS[..1] };
            let soft = |&(rays, sampling): &_| SoftShadows { radius, rays, sampling };
            let kinds = std::iter::once(SoftShadows::default()).chain(rays.iter().map(soft));
            let kinds: Vec<RenderSettings> = kinds.map(|soft| with(&own, shadows, soft)).collect();
            let costs = costs(&own, &kinds, Effect::SoftShadows)?;
            println!("    {shadows:?}, sharp: {:.2} ms", costs[0].milliseconds);
            for (kind, cost) in kinds.iter().zip(costs).skip(1) {
                let light =
                    visible(&white, kind)?.into_iter().zip(&facing).map(|(visible, facing)| visible * facing);
                let error = error(&light.collect::<Vec<_>>(), &truth);
                let SoftShadows { rays, sampling, .. } = kind.effects.soft_shadows;
                let more = (cost.ratio - 1.0) * 100.0;
                println!(
                    "    {rays} {sampling:?}: {:.2} ms, +{more:.0} %, {} rays, error {error:.4}",
                    cost.milliseconds, cost.rays
                );
            }
        }
    }
    Ok(())
}

fn with(subject: &Subject, shadows: Shadows, soft_shadows: SoftShadows) -> RenderSettings {
    let mut settings = settings(subject, None, true);
    (settings.effects.shadows, settings.effects.soft_shadows) = (shadows, soft_shadows);
    settings
}

/// The fraction of the sun that each pixel shows; not a number where it does not shine.
fn visible(white: &Subject, settings: &RenderSettings) -> Result<Vec<f64>, Box<dyn Error>> {
    let light = |shadows| -> Result<Vec<f64>, Box<dyn Error>> {
        let mut settings = settings.clone();
        (settings.effects.shadows, settings.outputs.radiance) = (shadows, true);
        let frame = Renderer::new(settings).render(&white.scene, &white.camera)?;
        Ok(frame.radiance.iter().flatten().map(|light| f64::from(light.x)).collect())
    };
    let (lit, open) = (light(settings.effects.shadows)?, light(Shadows::Off)?);
    Ok(lit.into_iter().zip(open).map(|(lit, open)| lit / open).collect())
}
