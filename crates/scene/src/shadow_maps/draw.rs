//! Draws a shadow map: depth only.

use std::sync::Arc;

use crate::work::{Work, note};
use trigon_math::Mat3;
use trigon_raster::{Culling, Draw, Pass, Rasterizer, Target, TargetError};

use super::CastingScene;
use crate::display::Display;
use crate::effects::{Caster, LightingEnvironment, ShadowMap, View};
use crate::material::{AlphaMode, Material, Shading};
use crate::placement::{Eye, Rays};
use crate::scene::Scene;
use crate::settings::{Reflection, ShadingModel};
use crate::surface::{BoundMaterial, DrawTriangles, Look, MaterialContext, Surface};
use crate::unseen::Canvas;

/// The parameters of a run of triangles.
enum ShadowDraw<'a> {
    Whole(Surface<'a, true>),
    /// With holes.
    Masked(Surface<'a, false>),
}

/// Draws the casters' depth as a lamp sees it.
pub(super) fn draw(
    view: View,
    resolution: u32,
    casting: &CastingScene<'_>,
    rasterizer: &mut Rasterizer,
) -> Result<ShadowMap, TargetError> {
    note(Work::ShadowMap);
    let dark = LightingEnvironment::default();
    let eye = Eye::new(&view.camera, view.aspect);
    let mut shapes = Vec::new();
    for caster in &casting.casters.list {
        for (run, material) in caster.geometry.runs.iter().zip(&caster.shadow.materials) {
            let Some(material) = material else { continue };
            shapes.push((caster, run.triangles.clone(), shape(casting.scene, &dark, &eye, caster, material)));
        }
    }
    let mut pass = Pass::new();
    for (caster, triangles, shape) in &shapes {
        let triangles = &caster.geometry.triangles[triangles.clone()];
        match shape {
            ShadowDraw::Whole(surface) => {
                pass.triangles(Draw { culling: Culling::None, ..Draw::new(surface, triangles) })
            }
            ShadowDraw::Masked(surface) => pass.triangles(Draw {
                culling: Culling::None,
                blend_mode: trigon_raster::BlendMode::Masked,
                ..Draw::new(surface, triangles)
            }),
        };
    }
    let mut depths = vec![0.0; resolution as usize * resolution as usize];
    let mut target = Target::new(resolution, resolution, &[])?.with_depth(&mut depths)?;
    rasterizer.draw(&pass, &mut target);
    drop(target);
    Ok(ShadowMap { view, resolution, depths })
}

fn shape<'a>(
    scene: &'a Scene,
    dark: &'a LightingEnvironment,
    eye: &Eye,
    caster: &'a Caster,
    material: &Material,
) -> ShadowDraw<'a> {
    let columns = &caster.geometry.columns;
    let alpha_mode = Canvas { scene, columns }.visible_alpha(material);
    let masked = matches!(alpha_mode, AlphaMode::Mask { .. });
    let material = Material { shading: Shading::Unlit, alpha_mode, ..material.clone() };
    let context = MaterialContext {
        scene,
        lighting: dark,
        rays: Rays::Parallel,
        shading: ShadingModel::Flat,
        reflection: Reflection::Material,
        display: Display::Shaded,
        to_world: Mat3::IDENTITY,
    };
    let placement = eye.placement(&caster.shadow.placement, &caster.geometry.bounds());
    let drawn = DrawTriangles { columns, triangles: &[], faces: None };
    let mut bound = BoundMaterial::new(&material, columns, &context);
    if !masked {
        bound.strip();
    }
    let look = Arc::new(Look::new(drawn, bound, &context));
    if masked {
        ShadowDraw::Masked(Surface::new(placement, look))
    } else {
        ShadowDraw::Whole(Surface::new(placement, look))
    }
}
