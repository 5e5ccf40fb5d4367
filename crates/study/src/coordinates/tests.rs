//! What the report claims of coordinates.

use super::*;

#[test]
fn relative_to_the_camera_nothing_depends_on_the_place() {
    let [near, far] = [0.0, 1e7].map(|offset| Coordinates::CameraRelative.worst_error(offset));
    assert_eq!(near, far, "ten thousand kilometres from the origin");
    // Places of up to 4 metres round to 2^-23 and the matrix adds as much thrice:
    // together below 2^-19 metres, 3 metres away, at 1000 pixels to the metre.
    assert!(near < 1000.0 / 3.0 * 2e-6, "{near} pixels");
}

#[test]
fn in_world_space_errors_grow_with_the_distance() {
    let errors = [1e2, 1e4, 1e6].map(|offset| Coordinates::World.worst_error(offset));
    assert!(errors[1] > 30.0 * errors[0] && errors[2] > 30.0 * errors[1], "{errors:?}");
    assert!(errors[2] > 10.0, "a thousand kilometres away points jump by {} pixels", errors[2]);
}
