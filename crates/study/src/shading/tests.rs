//! What the report claims of shading.

use super::*;

#[test]
fn each_method_is_nearer_to_the_ball_than_the_one_before() {
    for subdivisions in [1, 2, 3] {
        let ball = Ball::new(128, subdivisions);
        let [flat, gouraud, phong] = BallShading::ALL.map(|shading| shading.error(&ball).rmse());
        assert!(flat > 1.5 * gouraud && gouraud > 1.5 * phong, "{flat}, {gouraud}, {phong}");
    }
}

#[test]
fn finer_triangles_make_all_of_them_better() {
    for shading in BallShading::ALL {
        let errors = [1, 2, 3].map(|subdivisions| shading.error(&Ball::new(128, subdivisions)).rmse());
        assert!(errors[0] > 1.5 * errors[1] && errors[1] > 1.5 * errors[2], "{shading:?}: {errors:?}");
    }
}

#[test]
fn the_ball_covers_what_it_should() {
    let drawn = BallShading::Flat.draw(&Ball::new(128, 3));
    let covered = drawn.values().iter().flatten().count() as f64;
    let disc = std::f64::consts::PI * 64.0 * 64.0;
    // The outline is inside the ball by at most (1 - cos of half an edge's angle, 0.07 of
    // a radian) of the radius, so the area is less by twice that share.
    assert!((0.99..1.0).contains(&(covered / disc)), "{covered} of {disc} pixels");
}

#[test]
fn light_is_brightest_at_the_highlight() {
    let half = DVec3::new(2.0, 3.0, 13.0).normalize();
    assert!(light_of(half) > 0.95, "towards the middle of eye and light: {}", light_of(half));
    assert_eq!(light_of(DVec3::NEG_Z), 0.1, "away from both");
}
