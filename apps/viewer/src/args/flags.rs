//! From settings back to flags: the words that set what a window shows.

use trigon_scene::{
    Display, Exposure, MetalReflection, RaySampling, Reflection, RenderSettings, ShadingModel, Shadows,
    SightRays, SoftShadows, Style, ToneMapping,
};

/// The flags that [`of_settings`] and a window's camera and overlays decide. All that is typed of them is replaced.
pub(crate) const DECIDED: [&str; 52] = [
    "ambient-occlusion",
    "ambient-occlusion-distance",
    "ambient-occlusion-rays",
    "ambient-occlusion-sampling",
    "animation-indices",
    "animation-jump",
    "animation-time",
    "anti-aliasing",
    "axis",
    "bounces",
    "camera-azimuth-angle",
    "camera-direction",
    "camera-elevation-angle",
    "camera-exact",
    "camera-focal-point",
    "camera-index",
    "camera-orthographic",
    "camera-position",
    "camera-turn",
    "camera-view-angle",
    "camera-view-up",
    "camera-zoom-factor",
    "display",
    "display-depth",
    "edges",
    "exposure",
    "filename",
    "grid",
    "hide-nodes",
    "input",
    "light-intensity",
    "light-radius",
    "line-width",
    "metadata",
    "metal-reflection",
    "output",
    "place-node",
    "point-size",
    "preset",
    "reflection",
    "resolution",
    "samples",
    "scene-hierarchy",
    "shading",
    "shadow-rays",
    "shadow-resolution",
    "shadow-sampling",
    "shadows",
    "style",
    "tone-mapping",
    "up",
    "view",
];

/// The flags of what differs from the usual settings, apart from the background and from what lights the scene, which
/// no key of the window changes.
pub(crate) fn of_settings(settings: &RenderSettings) -> Vec<String> {
    let RenderSettings { width, height, samples_per_axis, samples, .. } = *settings;
    let mut flags = vec![format!("--resolution={width},{height}")];
    match (samples_per_axis, samples) {
        (3, 1) => {}
        (1, 1) => flags.push("--anti-aliasing=none".to_owned()),
        (axis, 1) => flags.push(format!("--samples={axis}")),
        // Both at once have no flag.
        (_, samples) => {
            flags.extend(["--anti-aliasing=msaa".to_owned(), format!("--samples={samples}")]);
        }
    }
    let mut add = |is_unusual: bool, flag: &str, value: &dyn std::fmt::Display| {
        if is_unusual {
            flags.push(format!("--{flag}={value}"));
        }
    };
    add(settings.style != Style::Surface, "style", &style(settings.style));
    add(settings.display != Display::Shaded, "display", &settings.display.name());
    add(settings.line_width != 1.0, "line-width", &settings.line_width);
    if let Some(size) = settings.point_size {
        add(true, "point-size", &size);
    }
    add(settings.light_intensity != 1.0, "light-intensity", &settings.light_intensity);
    add(settings.shading != ShadingModel::Phong, "shading", &shading(settings.shading));
    add(settings.reflection != Reflection::Material, "reflection", &reflection(settings.reflection));
    let effects = &settings.effects;
    match effects.shadows {
        Shadows::Off => {}
        Shadows::Rays => add(true, "shadows", &"rays"),
        Shadows::Maps { resolution } => {
            add(true, "shadows", &"maps");
            add(true, "shadow-resolution", &resolution);
        }
    }
    let (soft, usual) = (effects.soft_shadows, SoftShadows::default());
    add(soft.radius != 0.0, "light-radius", &soft.radius);
    if effects.shadows == Shadows::Rays && soft != (SoftShadows { radius: soft.radius, ..usual }) {
        add(true, "shadow-rays", &soft.rays);
        add(true, "shadow-sampling", &sampling(soft.sampling));
    }
    if let Some(occlusion) = effects.ambient_occlusion {
        add(true, "ambient-occlusion", &true);
        add(true, "ambient-occlusion-rays", &occlusion.rays);
        add(true, "ambient-occlusion-distance", &occlusion.distance);
        add(true, "ambient-occlusion-sampling", &sampling(occlusion.sampling));
    }
    add(effects.metal_reflection == MetalReflection::Ambient, "metal-reflection", &"ambient");
    match effects.sight {
        SightRays::Off => add(true, "bounces", &0),
        SightRays::Glass { .. } => {}
        SightRays::All { bounces } => add(true, "bounces", &bounces),
    }
    if let Exposure::Stops(stops) = effects.exposure {
        add(true, "exposure", &stops);
    }
    add(effects.tone_mapping != ToneMapping::None, "tone-mapping", &true);
    flags
}

fn sampling(sampling: RaySampling) -> &'static str {
    match sampling {
        RaySampling::Full => "full",
        RaySampling::Shared => "shared",
    }
}

fn style(style: Style) -> &'static str {
    match style {
        Style::Surface => "surface",
        Style::SurfaceWithEdges => "edges",
        Style::Wireframe => "wireframe",
        Style::HiddenLine => "hidden-line",
    }
}

fn shading(shading: ShadingModel) -> &'static str {
    match shading {
        ShadingModel::Flat => "flat",
        ShadingModel::Gouraud => "gouraud",
        ShadingModel::Phong => "phong",
    }
}

fn reflection(reflection: Reflection) -> &'static str {
    match reflection {
        Reflection::Material => "material",
        Reflection::Lambert => "lambert",
        Reflection::BlinnPhong => "blinn-phong",
        Reflection::MetallicRoughness => "metallic-roughness",
    }
}
