//! What the report claims of transparency.

use super::*;
use crate::visibility::VisibilityCase;

#[test]
fn finer_sorting_is_nearer_and_fragments_are_right() {
    let scene = VisibilityCase::Crossing.scene(128);
    let right = exact(&scene);
    let [unsorted, body, face, fragment, engine] =
        Transparency::ALL.map(|way| way.error(&scene, &right).rmse());
    assert!(unsorted > body && body > face && face > 0.01, "{unsorted}, {body}, {face}");
    // Half of a light in f64 is exact; sums of them round a few times.
    assert!(fragment < 1e-15, "depths in f64 have the exact order: {fragment}");
    assert!(engine < face / 10.0, "the engine sorts fragments by depths in f32: {engine}");
}

#[test]
fn one_face_lets_half_of_the_light_through() {
    let scene = Scene::new(
        [16; 2],
        vec![trigon_classic::Body {
            corners: vec![[-4000, -4000, 100], [20_000, -4000, 100], [-4000, 20_000, 100]],
            triangles: vec![[0, 1, 2]],
        }],
    );
    for way in Transparency::ALL {
        let found = way.draw(&scene)[[8, 8]];
        // A half of it is exact; the light itself is rounded to f32 by the engine.
        assert!((found - light(0) / 2.0).abs() < 1e-7, "{way:?}: {found}");
    }
}

/// The memory of an image is that of the one before.
#[test]
fn what_is_drawn_twice_is_the_same() {
    let scene = VisibilityCase::Balls.scene(64);
    for way in Transparency::ALL {
        let mut drawn = way.way(&scene);
        drawn.draw(&scene);
        let first = drawn.image();
        drawn.draw(&scene);
        assert!(first == drawn.image() && first == way.draw(&scene), "{way:?}");
    }
}

/// By hand: two faces of one body, and a body beyond it.
#[test]
fn faces_are_sorted_by_their_middle_and_bodies_by_theirs() {
    let body = |depths: [i32; 4]| {
        trigon_classic::Body::tetrahedron([
            [0, 0, depths[0]],
            [900, 0, depths[1]],
            [0, 900, depths[2]],
            [900, 900, depths[3]],
        ])
    };
    let scene = Scene::new([4; 2], vec![body([3, 6, 9, 30]), body([-8, -4, 0, 4])]);
    let faces: Vec<i64> = (0..8).map(|number| depth_of_face(&scene, number)).collect();
    assert_eq!(faces, [18, 39, 42, 45, -12, -8, -4, 0], "three times the middle");
    let bodies: Vec<i64> = (0..8).map(|number| depth_of_body(&scene, number)).collect();
    assert_eq!(bodies, [12, 12, 12, 12, -2, -2, -2, -2]);
}
