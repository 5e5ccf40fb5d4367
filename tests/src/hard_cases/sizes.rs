//! Images of the smallest and the largest size, and of none.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::DVec3;
use trigon_mesh::primitives;
use trigon_scene::{MAX_SIZE, Material, RenderSettings, Renderer, Scene, Style, render};

use super::flight::{check_ids, check_numbers, settings};
use super::flight_oracle::Oracle;
use crate::effort::cases;

fn ball() -> Scene {
    let mut scene = Scene::new();
    scene.add_object("ball", primitives::icosphere(1.0, 2), Material::default());
    scene
}

/// One row or one column, as long as can be: every pixel shows what its ray meets.
#[test]
fn the_longest_rows_and_columns_show_what_rays_meet() {
    let scene = ball();
    for size in [[MAX_SIZE, 1], [1, MAX_SIZE]] {
        // The image's height is what the angle is for.
        let angle = if size[1] == 1 { 1e-4 } else { 1.2 };
        let projection = Projection::perspective(angle, 0.1, None).expect("in range");
        let camera =
            Camera::look_at(DVec3::new(0.1, 0.2, 3.0), DVec3::ZERO, DVec3::Y).with_projection(projection);
        let frame = render(&scene, &camera, &settings(size)).expect("in range");
        check_numbers(&frame);
        let share = check_ids(&frame, &Oracle::new(&scene, &camera, size), "a single row or column");
        let seen = frame.object_ids.expect("asked for").iter().filter(|&&id| id == 0).count();
        assert!(share > 0.9 && seen > 1000, "{size:?}: {share} decided, {seen} pixels show the ball");
    }
}

#[test]
fn sizes_out_of_range_are_errors_that_name_them() {
    let scene = ball();
    let camera = scene.overview(1.0);
    let mut renderer = Renderer::new(RenderSettings::new(8, 8));
    let usual = renderer.render(&scene, &camera).expect("in range");
    for [width, height] in [[0, 0], [0, 5], [5, 0], [MAX_SIZE + 1, 1], [1, MAX_SIZE + 1], [u32::MAX; 2]] {
        (renderer.settings_mut().width, renderer.settings_mut().height) = (width, height);
        let error = renderer.render(&scene, &camera).expect_err("out of range").to_string();
        assert!(error.contains(&width.to_string()) && error.contains(&height.to_string()), "{error}");
    }
    (renderer.settings_mut().width, renderer.settings_mut().height) = (8, 8);
    assert_eq!(renderer.render(&scene, &camera).expect("in range"), usual, "a refusal leaves no trace");
}

proptest! {
    #![proptest_config(cases(24))]

    /// Any small size, 1×1 among them, in every style, drawn by one renderer after the
    /// other size: each is what a new renderer draws.
    #[test]
    fn sizes_follow_each_other_without_a_trace(
        sizes in prop::collection::vec((1..40_u32, 1..40_u32), 1..5), single in any::<bool>(),
        style in prop_oneof![Just(Style::Surface), Just(Style::SurfaceWithEdges), Just(Style::Wireframe), Just(Style::HiddenLine)],
    ) {
        let scene = ball();
        let mut sizes = sizes;
        if single {
            sizes.push((1, 1));
        }
        let mut renderer = Renderer::new(RenderSettings { style, ..settings([1, 1]) });
        for (width, height) in sizes {
            let camera = Camera::look_at(DVec3::new(0.3, 0.4, 3.0), DVec3::ZERO, DVec3::Y);
            (renderer.settings_mut().width, renderer.settings_mut().height) = (width, height);
            let again = renderer.render(&scene, &camera).expect("in range");
            check_numbers(&again);
            let anew = render(&scene, &camera, renderer.settings()).expect("in range");
            prop_assert!(again == anew, "{}×{} differs", width, height);
            if style == Style::Surface {
                check_ids(&again, &Oracle::new(&scene, &camera, [width, height]), "another size");
            }
        }
    }
}
