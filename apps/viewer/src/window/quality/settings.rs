//! The settings that trade accuracy for time, with their choices.

use trigon_scene::{
    AmbientOcclusion, RaySampling, Reflection, RenderSettings, ShadingModel, Shadows, SightRays,
};

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Setting {
    Supersampling,
    Multisampling,
    Shading,
    Reflection,
    Shadows,
    Occlusion,
    Bounces,
}

/// How far surroundings count for ambient occlusion that is switched on here, in metres:
/// as on the command line.
const OCCLUSION_DISTANCE: f32 = 1.0;

/// Rays of ambient occlusion, from the quickest to the most accurate.
const OCCLUSION: [(u32, RaySampling); 9] = [
    (0, RaySampling::Full),
    (32, RaySampling::Shared),
    (64, RaySampling::Shared),
    (4, RaySampling::Full),
    (8, RaySampling::Full),
    (16, RaySampling::Full),
    (32, RaySampling::Full),
    (64, RaySampling::Full),
    (128, RaySampling::Full),
];

impl Setting {
    /// In the order of the panel.
    pub(super) const ALL: [Self; 7] = [
        Self::Supersampling,
        Self::Multisampling,
        Self::Shading,
        Self::Reflection,
        Self::Shadows,
        Self::Occlusion,
        Self::Bounces,
    ];

    /// What the panel calls it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Supersampling => "samples per pixel",
            Self::Multisampling => "extra edge samples",
            Self::Shading => "lighting",
            Self::Reflection => "reflection",
            Self::Shadows => "shadows",
            Self::Occlusion => "ambient occlusion",
            Self::Bounces => "mirrors and glass",
        }
    }

    /// Its choices with their names: these settings, with one thing changed. From the
    /// cheapest on, where that can be said.
    pub(super) fn choices(self, settings: &RenderSettings) -> Vec<(String, RenderSettings)> {
        let with = |name: String, change: &dyn Fn(&mut RenderSettings)| {
            let mut settings = settings.clone();
            change(&mut settings);
            (name, settings)
        };
        let named = |name: &str, change: &dyn Fn(&mut RenderSettings)| with(name.to_owned(), change);
        match self {
            Self::Supersampling => (1..=4)
                .map(|n| with((n * n).to_string(), &|settings| settings.samples_per_axis = n))
                .collect(),
            Self::Multisampling => {
                [1, 2, 4, 8, 16].map(|n| with(extra_samples(n), &|settings| settings.samples = n)).into()
            }
            Self::Shading => [
                ("per triangle (flat)", ShadingModel::Flat),
                ("per vertex (Gouraud)", ShadingModel::Gouraud),
                ("per pixel (Phong)", ShadingModel::Phong),
            ]
            .map(|(name, shading)| named(name, &|settings| settings.shading = shading))
            .into(),
            Self::Reflection => [
                ("from the material", Reflection::Material),
                ("diffuse (Lambert)", Reflection::Lambert),
                ("highlights (Blinn-Phong)", Reflection::BlinnPhong),
                ("metallic-roughness (GGX)", Reflection::MetallicRoughness),
            ]
            .map(|(name, reflection)| named(name, &|settings| settings.reflection = reflection))
            .into(),
            Self::Shadows => [
                ("none", Shadows::Off),
                ("maps of 1024", Shadows::Maps { resolution: 1024 }),
                ("maps of 2048", Shadows::Maps { resolution: 2048 }),
                ("maps of 4096", Shadows::Maps { resolution: 4096 }),
                ("rays", Shadows::Rays),
            ]
            .map(|(name, shadows)| named(name, &|settings| settings.effects.shadows = shadows))
            .into(),
            Self::Occlusion => OCCLUSION
                .map(|(rays, sampling)| {
                    let name = occlusion_name(rays, sampling);
                    with(name, &|settings| set_occlusion(settings, rays, sampling))
                })
                .into(),
            Self::Bounces => sight_choices(settings.effects.sight)
                .map(|(name, sight)| with(name, &|settings| settings.effects.sight = sight))
                .into(),
        }
    }
}

fn extra_samples(samples: u32) -> String {
    if samples == 1 { "none".to_owned() } else { samples.to_string() }
}

fn occlusion_name(rays: u32, sampling: RaySampling) -> String {
    match (rays, sampling) {
        (0, _) => "none".to_owned(),
        (rays, RaySampling::Full) => format!("{rays} rays per sample"),
        (rays, RaySampling::Shared) => format!("{rays} shared rays"),
    }
}

/// Those for glass alone keep the number of bounces.
fn sight_choices(current: SightRays) -> [(String, SightRays); 6] {
    let glass = match current {
        SightRays::Glass { .. } => current,
        SightRays::Off | SightRays::All { .. } => SightRays::default(),
    };
    let bounces = |count: u32| (format!("both, {count} bounces"), SightRays::all(count));
    [
        ("neither".to_owned(), SightRays::Off),
        ("glass alone".to_owned(), glass),
        ("both, one bounce".to_owned(), SightRays::all(1)),
        bounces(2),
        bounces(4),
        bounces(8),
    ]
}

fn set_occlusion(settings: &mut RenderSettings, rays: u32, sampling: RaySampling) {
    let occlusion = &mut settings.effects.ambient_occlusion;
    let distance = occlusion.map_or(OCCLUSION_DISTANCE, |occlusion| occlusion.distance);
    let requested = AmbientOcclusion { sampling, ..AmbientOcclusion::new(rays, distance) };
    *occlusion = (rays > 0).then_some(requested);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_settings_are_among_the_choices_and_all_choices_differ() {
        let settings = RenderSettings::new(8, 8);
        for setting in Setting::ALL {
            let choices = setting.choices(&settings);
            let current = choices.iter().filter(|(_, choice)| *choice == settings).count();
            assert_eq!(current, 1, "{setting:?}");
            for (i, (name, choice)) in choices.iter().enumerate() {
                let twin = choices[..i].iter().any(|(other, same)| other == name || same == choice);
                assert!(!twin, "{setting:?}: {name} is there twice");
            }
        }
    }

    #[test]
    fn occlusion_keeps_its_distance() {
        let mut settings = RenderSettings::new(8, 8);
        settings.effects.ambient_occlusion = Some(AmbientOcclusion::new(8, 0.25));
        let choices = Setting::Occlusion.choices(&settings);
        let kept = choices.iter().filter_map(|(_, choice)| choice.effects.ambient_occlusion);
        assert!(
            kept.clone().count() == 8 && kept.clone().all(|kept| kept.distance == 0.25),
            "however many rays"
        );
    }
}
