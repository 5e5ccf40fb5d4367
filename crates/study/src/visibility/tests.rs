//! What the report claims of hidden surfaces.

use super::*;
use trigon_classic::{Body, Surface, visible_lines};

const SIDE: usize = 128;

fn misordered(visibility: Visibility, case: VisibilityCase) -> usize {
    let scene = case.scene(SIDE);
    let drawing = visibility.draw(&scene).unwrap();
    let OrderErrors { visible, misordered } = OrderErrors::of(&scene, &drawing.faces);
    assert!(visible > SIDE * SIDE / 10, "{case:?} fills a part of the image: {visible} pixels");
    misordered
}

fn tests(visibility: Visibility, scene: &Scene) -> f64 {
    visibility.draw(scene).unwrap().tests as f64
}

#[test]
fn what_looks_at_every_depth_is_right() {
    for visibility in [Visibility::Classic(Method::Warnock), Visibility::Classic(Method::AllRays)] {
        for case in VisibilityCase::ALL {
            assert_eq!(misordered(visibility, case), 0, "{visibility:?}, {case:?}");
        }
    }
}

#[test]
fn depths_in_f32_are_wrong_at_most_where_faces_meet() {
    for visibility in
        [Visibility::Classic(Method::ZBuffer), Visibility::Classic(Method::TreeRays), Visibility::Engine]
    {
        for case in VisibilityCase::ALL {
            // Depths of up to 2¹⁶ steps round to 2⁻⁸ of a step: faces as near to each
            // other are rare, and along lines only.
            let wrong = misordered(visibility, case);
            assert!(wrong <= SIDE / 8, "{visibility:?}, {case:?}: {wrong} pixels");
        }
    }
}

#[test]
fn roberts_is_right_about_convex_bodies_and_refuses_others() {
    for case in [VisibilityCase::Balls, VisibilityCase::Ring, VisibilityCase::Crossing] {
        assert_eq!(misordered(Visibility::Classic(Method::Roberts), case), 0, "{case:?}");
    }
    for case in [VisibilityCase::Torus, VisibilityCase::Teapot] {
        let refusal = Visibility::Classic(Method::Roberts).draw(&case.scene(SIDE)).unwrap_err();
        assert!(refusal.to_string().contains("is not convex"), "{case:?}: {refusal}");
    }
}

#[test]
fn the_painter_fails_at_rings_and_crossings() {
    for case in [VisibilityCase::Ring, VisibilityCase::Crossing] {
        let wrong = misordered(Visibility::Classic(Method::Painter), case);
        // Several times what depths in f32 are allowed above.
        assert!(wrong > SIDE / 2, "{case:?}: {wrong} pixels");
    }
}

/// Source D, section 1.5.1: work grows with the square of the number of objects.
#[test]
fn roberts_is_quadratic_in_objects() {
    let work =
        [20, 40, 80].map(|count| tests(Visibility::Classic(Method::Roberts), &balls(SIDE, count, 6.0, 2)));
    let lines = [20, 40, 80].map(|count| visible_lines(&balls(SIDE, count, 6.0, 2)).unwrap().tests as f64);
    for [few, more, most] in [work, lines] {
        // Each edge meets every other body, 79 instead of 39; bodies that miss a ray
        // after a few planes make the numbers vary.
        for growth in [more / few, most / more] {
            assert!((3.4..4.8).contains(&growth), "twice the objects, {growth} times the work");
        }
    }
}

/// Source D, section 1.5.3: time is linear in the number of faces.
#[test]
fn the_z_buffer_is_linear_in_faces() {
    let [few, many] = [50, 400].map(|count| {
        let scene = balls(SIDE, count, 6.0, 3);
        tests(Visibility::Classic(Method::ZBuffer), &scene) / scene.face_count() as f64
    });
    // Where a ball lies on the grid of pixels makes the boxes of its faces vary a little.
    assert!((many / few - 1.0).abs() < 0.05, "{few} and {many} tests for each face");
}

/// Source D, section 1.5.2: Warnock's algorithm depends on what overlaps.
#[test]
fn warnock_is_uneven_where_the_z_buffer_is_not() {
    let scenes = [0, SIDE as i32].map(|tilt| sheets(SIDE, tilt));
    let [parallel, crossing] =
        scenes.each_ref().map(|scene| tests(Visibility::Classic(Method::Warnock), scene));
    assert!(crossing > 20.0 * parallel, "sheets that cross: {crossing} tests instead of {parallel}");
    let [parallel, crossing] =
        scenes.each_ref().map(|scene| tests(Visibility::Classic(Method::ZBuffer), scene));
    assert_eq!(parallel, crossing, "the z-buffer looks at as many pixels");
}

#[test]
fn rays_without_a_tree_look_at_every_face_everywhere() {
    let scene = balls(SIDE, 10, 6.0, 4);
    let expected = SIDE * SIDE * scene.face_count();
    let edge_on = scene.faces().filter(|(_, face)| Surface::new(face).is_none()).count();
    assert_eq!(
        tests(Visibility::Classic(Method::AllRays), &scene),
        (expected - SIDE * SIDE * edge_on) as f64,
        "pixels times faces"
    );
}

#[test]
fn hidden_lines_end_where_the_body_before_them_begins() {
    let far = Body::tetrahedron([[1000, 5000, 0], [9000, 5000, 0], [5000, 5001, -900], [5000, 6000, -500]]);
    let near =
        Body::tetrahedron([[3000, 1000, 900], [7000, 1000, 900], [5000, 9000, 900], [5000, 4000, 1900]]);
    let scene = Scene::new([40; 2], vec![far, near]);
    let lines = visible_lines(&scene).unwrap().lines;
    // The first edge of the far body crosses the near one, which is 4000 wide at the top
    // and half of that at y = 5000: from 4000 to 6000.
    let mut ends: Vec<f64> = lines
        .iter()
        .filter(|line| line.iter().all(|point| point[1] == 5000.0))
        .flat_map(|line| line.map(|point| point[0].round()))
        .collect();
    ends.sort_by(f64::total_cmp);
    assert_eq!(ends, [1000.0, 4000.0, 6000.0, 9000.0], "two parts of the edge are seen");
}
