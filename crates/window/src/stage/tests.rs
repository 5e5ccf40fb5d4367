//! What a stage knows of its window.

use super::*;
use crate::refinement::Wanted;
use crate::shown;
use trigon_mesh::primitives;
use trigon_scene::quality::Preset;
use trigon_scene::{
    AmbientOcclusion, Light, Material, Node, Outputs, RaySampling, Shadows, SightRays, VertexPoints,
};

fn stage() -> Stage {
    let mut stage = Stage::new("test");
    stage.scene.add_object("cube", primitives::cube(2.0), Material::default());
    stage.resize(Viewport { width: 400, height: 200 });
    stage
}

#[test]
fn a_stage_begins_with_its_title_and_the_usual_size() {
    let mut stage = Stage::new("test");
    assert_eq!((stage.title(), stage.viewport()), ("test", DEFAULT_SIZE));
    stage.set_title("other");
    stage.set_size(Viewport { width: 30, height: 20 });
    assert_eq!((stage.title(), stage.viewport()), ("other", Viewport { width: 30, height: 20 }));
    assert_eq!(Visibility::Hidden.toggled(), Visibility::Shown);
    assert_eq!(Visibility::Shown.toggled(), Visibility::Hidden);
}

#[test]
fn views_are_fitted_to_one_of_several_columns() {
    let mut stage = stage();
    let aspects = [0, 1, 2, 4].map(|columns| {
        stage.columns = columns;
        stage.fit_aspect()
    });
    assert_eq!(aspects, [2.0, 2.0, 1.0, 0.5]);
}

#[test]
fn what_covers_the_lower_edge_is_left_free_above_and_below() {
    let mut stage = stage();
    assert_eq!(stage.fit_share(), 1.0, "nothing does");
    stage.covered_below = 20.0;
    assert_eq!(stage.fit_share(), 0.8, "20 of 200 pixels, twice");
    stage.text_scale = 0.5;
    assert_eq!(stage.fit_share(), 0.9, "in smaller text");
    stage.rescale(2.0);
    assert_eq!(stage.fit_share(), 0.8, "on a finer screen");
    stage.covered_below = 900.0;
    assert_eq!(stage.fit_share(), 0.5, "half of the window at least");
}

#[test]
fn fitted_views_show_all_of_the_scene_and_nothing_beside_it() {
    let mut stage = stage();
    stage.fit_view();
    let distance = stage.orbit.distance();
    let far = stage.scene.add_object("grid", primitives::cube(90.0), Material::default());
    stage.fit_view();
    assert!(stage.orbit.distance() > 10.0 * distance, "it is larger");
    stage.beside = vec![far];
    stage.fit_view();
    assert!((stage.orbit.distance() - distance).abs() < 1e-9, "but does not count");
    assert!(stage.scene.node(far).is_some(), "and stays");
    stage.covered_below = 25.0;
    stage.fit_view();
    let expected = distance / stage.fit_share();
    assert!((stage.orbit.distance() / expected - 1.0).abs() < 0.01, "from farther away");
}

#[test]
fn scales_that_are_none_are_ignored() {
    let mut stage = stage();
    for (scale, expected) in
        [(2.0, 2.0), (0.0, 2.0), (-1.0, 2.0), (f64::NAN, 2.0), (f64::INFINITY, 2.0), (0.5, 0.5)]
    {
        stage.rescale(scale);
        assert_eq!(stage.scale(), expected, "after {scale}");
    }
}

#[test]
fn the_home_view_is_returned_to() {
    let mut stage = stage();
    let mut home = stage.orbit;
    home.set_angles(0.3, 0.2, 0.1);
    home.set_distance(7.0);
    stage.set_home(home);
    assert_ne!(stage.orbit, home, "not yet");
    stage.reset_view();
    assert_eq!(stage.orbit, home);
    stage.set_home_direction(DVec3::NEG_Y);
    stage.reset_view();
    assert!((stage.orbit.orientation() * DVec3::Z).distance(DVec3::Y) < 1e-6, "from above");
}

/// On a screen with two pixels to a point, drafts are a half or a third as large.
#[test]
fn images_are_as_large_as_the_window_and_drafts_smaller() {
    let mut stage = stage();
    stage.rescale(2.0);
    stage.settings.line_width = 1.5;
    stage.settings.vertices = Some(VertexPoints { size: 3.0, marked_size: 5.0, ..VertexPoints::default() });
    stage.settings.outputs = Outputs { normals: true, ..Outputs::default() };
    (stage.settings.samples_per_axis, stage.settings.samples) = (4, 16);
    let sizes = |settings: &RenderSettings| {
        let points = settings.vertices.as_ref().expect("they are drawn");
        ([settings.width, settings.height], settings.line_width, [points.size, points.marked_size])
    };
    let image = stage.image_settings();
    assert_eq!(sizes(&image), ([400, 200], 3.0, [6.0, 10.0]), "in physical pixels");
    assert_eq!((image.samples_per_axis, image.samples), (4, 16));
    assert_eq!(image.outputs, stage.settings.outputs, "what the application asks for");
    let draft = stage.draft_settings(2.0);
    assert_eq!(sizes(&draft), ([200, 100], 1.5, [3.0, 5.0]));
    assert_eq!((draft.samples_per_axis, draft.samples, draft.outputs), (1, 1, shown::OUTPUTS));
    let tiny = stage.draft_settings(1e9);
    assert_eq!([tiny.width, tiny.height], [1, 1], "no smaller than a pixel");
    for step in stage.ladder() {
        assert_eq!(sizes(&step), ([400, 200], 3.0, [6.0, 10.0]));
        assert_eq!(step.outputs, shown::OUTPUTS, "what picking needs");
    }
}

#[test]
fn drafts_have_no_more_rays_than_the_draft_preset() {
    let mut stage = stage();
    let most = Preset::Draft.quality();
    stage.settings.effects.shadows = Shadows::Rays;
    for rays in [0, most.occlusion_rays, most.occlusion_rays + 30] {
        stage.settings.effects.ambient_occlusion = Some(AmbientOcclusion::new(rays, 1.0));
        let effects = stage.draft_settings(1.0).effects;
        assert_eq!(effects.shadows, most.shadows);
        assert_eq!(
            effects.ambient_occlusion.map(|occlusion| (occlusion.rays, occlusion.sampling)),
            Some((rays.min(most.occlusion_rays), RaySampling::Shared))
        );
    }
    stage.settings.effects.shadows = Shadows::Off;
    assert_eq!(stage.draft_settings(1.0).effects.shadows, Shadows::Off, "none stays none");
    for bounces in [1, most.glass_bounces, most.glass_bounces + 3] {
        stage.settings.effects.sight = SightRays::Glass { bounces };
        let bounces = bounces.min(most.glass_bounces);
        assert_eq!(
            stage.draft_settings(1.0).effects.sight,
            SightRays::Glass { bounces },
            "glass stays glass"
        );
    }
}

#[test]
fn previews_share_rays_that_would_start_at_every_sample() {
    let mut stage = stage();
    (stage.settings.samples_per_axis, stage.settings.effects.shadows) = (2, Shadows::Rays);
    assert_eq!(stage.preview_settings(), None, "one ray to a lamp without an extent");
    let occlusion = |rays, sampling| Some(AmbientOcclusion { sampling, ..AmbientOcclusion::new(rays, 1.0) });
    let shared = |preset: Preset| (preset.quality().occlusion_rays, preset.quality().shadow_rays);
    stage.settings.effects.ambient_occlusion = occlusion(16, RaySampling::Full);
    let preview = stage.preview_settings().expect("64 rays a pixel");
    let mut expected = stage.ladder()[0].clone();
    expected.effects.ambient_occlusion = occlusion(shared(Preset::Standard).0, RaySampling::Shared);
    assert_eq!(preview, expected, "all else as at rest");
    for (rays, sampling) in [(1, RaySampling::Full), (16, RaySampling::Shared)] {
        stage.settings.effects.ambient_occlusion = occlusion(rays, sampling);
        assert_eq!(
            stage.preview_settings().is_some(),
            sampling == RaySampling::Full,
            "four rays a pixel, or shared"
        );
    }
    stage.scene.add(Node::from_light(Light { radius: 0.1, ..Light::point(1.0) }));
    let preview = stage.preview_settings().expect("its shadow is soft").effects;
    let soft = preview.soft_shadows;
    assert_eq!((soft.rays, soft.sampling), (shared(Preset::High).1, RaySampling::Shared));
    assert_eq!(
        preview.ambient_occlusion, stage.settings.effects.ambient_occlusion,
        "they are shared already"
    );
    stage.settings.effects.shadows = Shadows::Maps { resolution: 64 };
    assert_eq!(stage.preview_settings(), None, "maps need no rays");
}

#[test]
fn what_is_wanted_follows_from_refinement_and_comparison() {
    let mut stage = stage();
    stage.settings.samples_per_axis = 1;
    let mut wanted = |refinement, comparison| {
        (stage.refinement, stage.comparison) = (refinement, comparison);
        (stage.wanted_steps().len(), stage.wanted_image())
    };
    let length = 4;
    assert_eq!(wanted(Refinement::Settings, Comparison::Off), (1, Wanted::Settings));
    assert_eq!(wanted(Refinement::Reference, Comparison::Off), (length, Wanted::Best));
    assert_eq!(wanted(Refinement::Reference, Comparison::Measured), (length + 1, Wanted::Best));
    assert_eq!(wanted(Refinement::Settings, Comparison::Measured), (3, Wanted::Settings));
    assert_eq!(wanted(Refinement::Settings, Comparison::Shown), (3, Wanted::Difference));
}

#[test]
fn an_image_is_as_good_as_what_it_depends_on() {
    let first = stage().subject();
    assert_eq!(first, first.clone());
    let mut stage = stage();
    let before = stage.subject();
    assert_eq!(stage.subject(), before, "nothing has changed");
    let mut differs = |change: &dyn Fn(&mut Stage)| {
        let before = stage.subject();
        change(&mut stage);
        stage.subject() != before
    };
    assert!(differs(&|stage| stage.orbit.zoom(2.0)));
    assert!(differs(&|stage| stage.settings.line_width += 1.0));
    assert!(differs(&|stage| stage.rescale(3.0)));
    assert!(differs(&|stage| stage.resize(Viewport { width: 9, height: 9 })));
    assert!(differs(&|stage| stage.four_views = true));
    let size = Viewport { width: 10, height: 9 };
    assert!(differs(&|stage| stage.view_area = Some(Area { min: [1; 2], size })));
    assert!(!differs(&|stage| stage.text_scale = 2.0), "text is not in it");
}
