//! What the report claims of texture filters.

use super::*;

#[test]
fn better_filters_are_nearer_to_what_a_pixel_sees() {
    let ground = Ground::new(192);
    let right = exact(&ground);
    let errors = TextureFilter::ALL.map(|filter| filter.error(&ground, &right).rmse());
    let [nearest, bilinear, trilinear, _, four, sixteen] = errors;
    assert!(nearest > bilinear && bilinear > trilinear, "{errors:?}");
    assert!(trilinear > four && four >= sixteen, "{errors:?}");
}

#[test]
fn footprints_are_derivatives() {
    let ground = Ground::new(192);
    let at = |x: f64, y: f64| ground.footprint([x, y]);
    let [here, ddx, ddy] = at(50.0, 40.0);
    const STEP: f64 = 1e-4;
    let [right, below] = [at(50.0 + STEP, 40.0)[0], at(50.0, 40.0 + STEP)[0]];
    for axis in 0..2 {
        // A step is wrong by half the second derivative times its length: far below.
        assert!(((right[axis] - here[axis]) / STEP - ddx[axis]).abs() < 1e-4, "to the right");
        assert!(((below[axis] - here[axis]) / STEP - ddy[axis]).abs() < 1e-4, "down");
    }
}
