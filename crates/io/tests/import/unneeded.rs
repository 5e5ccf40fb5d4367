//! Files with effects that nobody could see: each is off, with the reason, and takes nothing.

use std::path::Path;

use trigon_io::{LoadOptions, load};
use trigon_scene::{Effect, EffectCounts, EffectPlan, EffectSettings, RenderSettings, Renderer, Shadows};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/effects-unneeded");

/// For each file: effects, and what the plan says of them. All have a directional lamp that shines.
const CASES: &[(&str, &[(Effect, &str)])] = &[
    ("z8", &[(Effect::Lamps, "on, because one light shines on visible objects")]),
    ("e6_range", &[(Effect::Lamps, "on, because one light shines on visible objects")]),
    ("e6b_spotaway", &[(Effect::Lamps, "on, because one light shines on visible objects")]),
    (
        "e2b_normalscale0",
        &[
            (Effect::NormalMaps, "off, because the only object that has it, `node 0`, multiplies it by 0"),
            (Effect::Textures, "off, because the only object that has it, `node 0`, multiplies it by 0"),
        ],
    ),
    (
        "e3_blend1",
        &[(
            Effect::Transparency,
            "off, because the only object that has it, `node 0`, has an alpha of 1 everywhere",
        )],
    ),
    (
        "e4_mask1",
        &[(
            Effect::Masks,
            "off, because the only object that has it, `node 0`, has no alpha below the cutoff",
        )],
    ),
    (
        "e7_whitecol",
        &[(
            Effect::VertexColors,
            "off, because the only object that has it, `node 0`, has nothing but white",
        )],
    ),
    (
        "e12_unlit",
        &[
            (Effect::Textures, "on, because `node 0` has it"),
            (Effect::NormalMaps, "off, because no visible surface is lit"),
            (Effect::OcclusionMaps, "off, because no visible surface is lit"),
            (Effect::Lamps, "off, because no visible surface is lit"),
            (Effect::ShadowRays, "off, because no visible surface is lit"),
        ],
    ),
    (
        "e13_blacktex",
        &[(Effect::Textures, "off, because the only object that has it, `node 0`, multiplies it by 0")],
    ),
];

#[test]
fn what_nobody_could_see_is_off_with_the_reason() {
    let files = std::fs::read_dir(FOLDER).expect("a folder").count();
    assert_eq!(files, CASES.len(), "a case for each file");
    for (name, decisions) in CASES {
        let loaded = load(Path::new(FOLDER).join(format!("{name}.glb")), &LoadOptions::default());
        let scene = loaded.unwrap_or_else(|error| panic!("{error}")).scene;
        let effects = EffectSettings { shadows: Shadows::Rays, ..EffectSettings::default() };
        let settings = RenderSettings { effects, ..RenderSettings::new(24, 24) };
        let camera = scene.overview(settings.aspect());
        let mut renderer = Renderer::new(settings);
        renderer.render(&scene, &camera).expect("drawn");
        let plan = EffectPlan::new(&scene, &camera, renderer.settings());
        for (effect, said) in *decisions {
            let decision = plan.decision(*effect).to_string();
            assert_eq!(decision, *said, "{name}, {effect}");
            let counts = renderer.effect_counts(*effect);
            assert!(plan.is_on(*effect) || counts == EffectCounts::default(), "{name}, {effect}: {counts:?}");
        }
    }
}
