//! The plan of a frame: which effects the scene needs, as far as the camera sees the scene, and why. The renderer does
//! what the plan says. Frames can also be drawn without one of their effects, to see what the effect adds and costs.

mod left_out;
mod omission;
mod reason;
mod survey;

use std::fmt;

use survey::{Survey, has_ambient};
use trigon_camera::{Camera, FisheyeCamera, Projection};
use trigon_math::Vec3;

use crate::display::Display;
use crate::effect::Effect;
use crate::effect_settings::{Exposure, MetalReflection, Shadows};
use crate::effects::FogModel;
use crate::lighting::{IdleLamps, Lights};
use crate::prepare::PreparedScene;
use crate::scene::Scene;
use crate::settings::{Background, Reflection, RenderSettings, ShadingModel, Style};

pub use omission::Omission;
pub use reason::{Absence, Cause, Decision, Invisible, Named};

/// The effects of a frame, and why.
///
/// ```
/// use trigon_scene::{Effect, EffectPlan, RenderSettings, showcase};
///
/// let scene = showcase();
/// let plan = EffectPlan::new(&scene, &scene.cameras()[0].1, &RenderSettings::new(100, 60));
/// assert!(plan.is_on(Effect::Lamps));
/// assert_eq!(plan.decision(Effect::Fog).to_string(), "off, because the settings do not request it");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EffectPlan {
    /// In the order of [`Effect::ALL`].
    decisions: Vec<Decision>,
}

impl EffectPlan {
    /// Examines the scene and what the camera can see of it.
    #[must_use]
    pub fn new(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Self {
        Self::of_prepared(&PreparedScene::new(scene, camera, settings))
    }

    /// As [`new`](Self::new), for a fisheye lens, which draws [surfaces alone](crate::Omission).
    #[must_use]
    pub fn of_fisheye(scene: &Scene, camera: &FisheyeCamera, settings: &RenderSettings) -> Self {
        let settings = Omission::without(settings);
        let pose = camera.with_projection(Projection::default());
        Self::of_prepared(&PreparedScene::through(Some(&camera.lens), scene, &pose, &settings))
    }

    pub(crate) fn of_prepared(prepared: &PreparedScene<'_>) -> Self {
        let survey = Survey::new(prepared);
        Self { decisions: Effect::ALL.iter().map(|&effect| decide(effect, prepared, &survey)).collect() }
    }

    /// Whether an effect is on, and why.
    #[must_use]
    pub fn decision(&self, effect: Effect) -> &Decision {
        &self.decisions[effect as usize]
    }

    /// Whether an effect is on.
    #[must_use]
    pub fn is_on(&self, effect: Effect) -> bool {
        matches!(self.decision(effect), Decision::On(_))
    }

    /// All effects with their decisions.
    pub fn iter(&self) -> impl Iterator<Item = (Effect, &Decision)> {
        Effect::ALL.into_iter().zip(&self.decisions)
    }
}

impl fmt::Display for EffectPlan {
    /// A line for each effect.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.iter().try_for_each(|(effect, decision)| writeln!(f, "{effect}: {decision}"))
    }
}

fn decide(effect: Effect, prepared: &PreparedScene<'_>, survey: &Survey) -> Decision {
    let outcome = match effect {
        _ if !prepared.settings.outputs.of_light() && !shapes(effect) => Err(Absence::NoColor),
        _ if let Some(absence) = not_displayed(effect, prepared.settings) => Err(absence),
        Effect::Lamps => lamps(prepared, survey),
        Effect::AmbientLight => ambient_light(prepared, survey),
        Effect::LightMeter => light_meter(prepared, survey),
        Effect::Environment => environment(prepared, survey),
        Effect::MetalStudio => metal_studio(prepared, survey),
        Effect::ShadowMaps => {
            shadows(matches!(prepared.settings.effects.shadows, Shadows::Maps { .. }), prepared, survey)
        }
        Effect::ShadowRays => shadows(prepared.settings.effects.shadows == Shadows::Rays, prepared, survey),
        Effect::SoftShadows => soft_shadows(prepared, survey),
        Effect::AmbientOcclusion => ambient_occlusion(prepared, survey),
        Effect::Fog => requested(prepared.settings.effects.fog.as_ref().and_then(FogModel::new).is_some()),
        Effect::ToneMapping => requested(prepared.settings.effects.maps_tones()),
        Effect::Outline => requested(
            prepared.settings.effects.outline.as_ref().is_some_and(|outline| !outline.nodes.is_empty()),
        ),
        Effect::Edges if prepared.lens.is_some() => Err(Absence::FisheyeLens),
        Effect::Edges => requested(prepared.settings.style != Style::Surface),
        Effect::Reflection if !prepared.settings.effects.sight.start_at_mirrors() => {
            Err(Absence::NotRequested)
        }
        Effect::Refraction => refraction(prepared, survey),
        Effect::OcclusionMaps => occlusion_maps(prepared, survey),
        Effect::NormalMaps | Effect::Reflection => of_pixels(effect, prepared, survey),
        Effect::Highlights
        | Effect::Textures
        | Effect::Emission
        | Effect::VertexColors
        | Effect::Masks
        | Effect::Transparency
        | Effect::Poses => of_objects(effect, prepared, survey),
    };
    match outcome {
        Ok(cause) => Decision::On(cause),
        Err(absence) => Decision::Off(absence),
    }
}

/// Why an effect is off where surfaces are displayed otherwise than in light.
fn not_displayed(effect: Effect, settings: &RenderSettings) -> Option<Absence> {
    let is_background = effect == Effect::Environment && settings.background == Background::Environment;
    let is_retained = is_background || effect == Effect::Outline || shapes(effect);
    let is_clay = matches!(effect, Effect::Lamps | Effect::AmbientLight | Effect::Highlights);
    let is_shown = match settings.display {
        Display::Shaded => true,
        Display::Matcap => is_retained || is_clay,
        _ => is_retained,
    };
    (!is_shown).then_some(Absence::Display)
}

/// Whether an effect concerns the position of surfaces, and not their appearance.
fn shapes(effect: Effect) -> bool {
    match effect {
        Effect::Masks | Effect::Poses | Effect::Edges => true,
        Effect::Lamps
        | Effect::AmbientLight
        | Effect::LightMeter
        | Effect::Highlights
        | Effect::Textures
        | Effect::NormalMaps
        | Effect::OcclusionMaps
        | Effect::Emission
        | Effect::VertexColors
        | Effect::Transparency
        | Effect::Environment
        | Effect::MetalStudio
        | Effect::ShadowMaps
        | Effect::ShadowRays
        | Effect::SoftShadows
        | Effect::AmbientOcclusion
        | Effect::Reflection
        | Effect::Refraction
        | Effect::Fog
        | Effect::ToneMapping
        | Effect::Outline => false,
    }
}

type Outcome = Result<Cause, Absence>;

fn requested(is_requested: bool) -> Outcome {
    if is_requested { Ok(Cause::Requested) } else { Err(Absence::NotRequested) }
}

/// Whether light is evaluated at all.
fn check_lit(prepared: &PreparedScene<'_>, survey: &Survey) -> Result<(), Absence> {
    match prepared.settings.style {
        Style::Wireframe | Style::HiddenLine => Err(Absence::NoFaces),
        Style::Surface | Style::SurfaceWithEdges if survey.lit == 0 => Err(Absence::NothingLit),
        Style::Surface | Style::SurfaceWithEdges => Ok(()),
    }
}

fn lamps(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    check_lit(prepared, survey)?;
    let Lights { lamps, idle, .. } = &prepared.lights;
    match (lamps.len(), lamps.first().and_then(|lamp| lamp.node)) {
        (0, _) if prepared.settings.light_factor() == 0.0 => Err(Absence::NoIntensity),
        (0, _) if *idle == IdleLamps::default() => Err(Absence::Nowhere),
        (0, _) => Err(Absence::IdleLamps { dark: idle.dark, out_of_reach: idle.out_of_reach }),
        (_, None) => Ok(Cause::Studio),
        (count, Some(_)) => Ok(Cause::Lights(count)),
    }
}

fn ambient_light(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    check_lit(prepared, survey)?;
    if prepared.settings.effects.environment.is_some() {
        return Err(Absence::Environment);
    }
    match (prepared.lights.ambient == Vec3::ZERO, prepared.lights.own_ambient) {
        (true, _) if prepared.settings.light_factor() == 0.0 => Err(Absence::NoIntensity),
        (true, _) => Err(Absence::Nowhere),
        (false, 0) => Ok(Cause::Studio),
        (false, count) => Ok(Cause::Lights(count)),
    }
}

/// Lamps that a display can show stay as they are.
fn light_meter(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    if prepared.settings.effects.exposure != Exposure::Metered {
        return Err(Absence::FixedExposure);
    }
    check_lit(prepared, survey)?;
    if prepared.lights.lamps.iter().all(|lamp| lamp.node.is_none()) {
        let is_far = prepared.lights.idle.out_of_reach > 0;
        return Err(if is_far { Absence::Unreached } else { Absence::NoOwnLamp });
    }
    let scene = prepared.scene;
    match (scene.exposed_by(prepared.settings), scene.light_reading()) {
        (Some(reading), _) => Ok(Cause::Metered(reading)),
        (None, None) => Err(Absence::Unreached),
        (None, Some(reading)) if reading.is_in_range() => Err(Absence::InRange(reading)),
        (None, Some(_)) => Err(Absence::Environment),
    }
}

fn environment(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    if prepared.settings.effects.environment.is_none() {
        return Err(Absence::NotRequested);
    }
    if prepared.settings.background == Background::Environment {
        return Ok(Cause::Background);
    }
    check_lit(prepared, survey)?;
    Ok(Cause::Requested)
}

fn metal_studio(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    match prepared.settings.effects.metal_reflection {
        MetalReflection::Ambient => return Err(Absence::NotRequested),
        MetalReflection::Studio => {}
    }
    check_lit(prepared, survey)?;
    let [metals, _] = survey.of(Effect::MetalStudio);
    if metals.count == 0 {
        return Err(Absence::NoMetal);
    }
    if prepared.settings.effects.environment.is_some() {
        return Err(Absence::Environment);
    }
    match (prepared.lights.ambient == Vec3::ZERO, prepared.lights.own_ambient) {
        (true, _) => Err(Absence::NoAmbientLight),
        (false, 0) => Ok(Cause::Metals(metals.clone())),
        (false, _) => Err(Absence::OwnAmbientLight),
    }
}

fn shadows(is_requested: bool, prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    if !is_requested {
        return Err(Absence::NotRequested);
    }
    check_lit(prepared, survey)?;
    match (prepared.lights.lamps.len(), survey.casters) {
        (0, _) => Err(Absence::NoLamp),
        (_, 0) => Err(Absence::NoCaster),
        (lamps, casters) => Ok(Cause::Shadows { lamps, casters }),
    }
}

fn soft_shadows(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    shadows(prepared.settings.effects.shadows != Shadows::Off, prepared, survey)?;
    match prepared.lights.lamps.iter().filter(|lamp| lamp.radius > 0.0).count() {
        0 => Err(Absence::NoExtent),
        lamps => Ok(Cause::Extent(lamps)),
    }
}

fn ambient_occlusion(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    if prepared.settings.effects.ambient_occlusion.is_none() {
        return Err(Absence::NotRequested);
    }
    check_lit(prepared, survey)?;
    if prepared.settings.shading != ShadingModel::Phong {
        return Err(Absence::ShadingModel);
    }
    match (has_ambient(prepared), survey.casters) {
        (false, _) => Err(Absence::NoAmbientLight),
        (true, 0) => Err(Absence::NoCaster),
        (true, _) => Ok(Cause::Requested),
    }
}

/// Occlusion maps dim ambient light alone.
fn occlusion_maps(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    let cause = of_pixels(Effect::OcclusionMaps, prepared, survey)?;
    if has_ambient(prepared) { Ok(cause) } else { Err(Absence::NoAmbientLight) }
}

/// What is behind glass. Glass in view that is drawn as if it were opaque always has a reason that
/// says so.
fn refraction(prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    let [glass, _] = survey.of(Effect::Refraction);
    let RenderSettings { effects, shading, reflection, .. } = prepared.settings;
    let lit_otherwise =
        *shading != ShadingModel::Phong || matches!(reflection, Reflection::Lambert | Reflection::BlinnPhong);
    of_objects(Effect::Refraction, prepared, survey)?;
    match effects.sight.bounces() {
        0 => Err(Absence::GlassNotRequested(glass.clone())),
        _ if lit_otherwise => Err(Absence::GlassLitOtherwise(glass.clone())),
        bounces => Ok(Cause::Glass { objects: glass.clone(), bounces }),
    }
}

/// Effects of objects that require per-pixel lighting.
fn of_pixels(effect: Effect, prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    let cause = of_objects(effect, prepared, survey)?;
    match prepared.settings.shading {
        ShadingModel::Flat | ShadingModel::Gouraud => Err(Absence::ShadingModel),
        ShadingModel::Phong => Ok(cause),
    }
}

fn of_objects(effect: Effect, prepared: &PreparedScene<'_>, survey: &Survey) -> Outcome {
    let [in_view, elsewhere] = survey.of(effect);
    let faces = matches!(prepared.settings.style, Style::Surface | Style::SurfaceWithEdges);
    match (in_view.count, elsewhere.count) {
        (0, 0) => Err(match survey.invisible(effect) {
            Some((why, objects)) => Absence::Invisible(*why, objects.clone()),
            // Importers leave them out of unlit materials, which need none.
            None if survey.lit == 0 && matches!(effect, Effect::NormalMaps | Effect::OcclusionMaps) => {
                Absence::NothingLit
            }
            None => Absence::Nowhere,
        }),
        (0, _) => Err(Absence::OutOfView(elsewhere.clone())),
        _ if !faces && effect != Effect::Poses && !survey.is_of_wires(effect) => Err(Absence::NoFaces),
        _ => Ok(Cause::Objects(in_view.clone())),
    }
}
