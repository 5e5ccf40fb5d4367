//! What the report claims of depth formats.

use super::*;

#[test]
fn near_and_far_are_the_ends() {
    let ends = |format: DepthFormat| [NEAR, FAR].map(|distance| format.encode(distance));
    assert_eq!(ends(DepthFormat::Fixed16), [0, 65_535], "16 bit");
    assert_eq!(ends(DepthFormat::Fixed24), [0, 16_777_215], "24 bit");
    assert_eq!(ends(DepthFormat::FloatReversed), [1.0_f32, 0.0].map(f32::to_bits), "reversed");
}

#[test]
fn reversed_depth_resolves_the_same_share_at_any_distance() {
    let resolved =
        [1.0, 10.0, 100.0, 1000.0].map(|distance| resolved_separation(DepthFormat::FloatReversed, distance));
    assert!(resolved.iter().all(|&share| share < 1e-5), "{resolved:?}");
    let forward = [10.0, 1000.0].map(|distance| resolved_separation(DepthFormat::Float, distance));
    assert!(forward[1] > 30.0 * forward[0], "as much is resolved in metres only: {forward:?}");
}

#[test]
fn floats_without_reversal_are_no_better_than_24_bits() {
    let [fixed, float] =
        [DepthFormat::Fixed24, DepthFormat::Float].map(|format| resolved_separation(format, 1000.0));
    // Depths lie between 1/2 and 1, where an f32 has 24 bits, too.
    assert!(fixed / float < 4.0 && float / fixed < 4.0, "{fixed} and {float}");
    assert!(resolved_separation(DepthFormat::Fixed16, 1000.0) > 10.0 * fixed, "16 bit are worse");
}

#[test]
fn an_image_shows_what_its_format_resolves() {
    let road = Road::new(256, 0.0001);
    let wrong = DepthFormat::ALL.map(|format| road.wrong_per_mille(format));
    let [fixed16, fixed24, float, reversed] = wrong;
    // The paint is nearer by 0.006 %: that is a unit of 24 bits at 100 metres, where the farthest
    // one of 128 rows is at 435, and a unit of 16 bits at 0.4 metres.
    assert!(
        fixed16 > 500.0 && [fixed24, float].iter().all(|wrong| (1.0..100.0).contains(wrong)),
        "{wrong:?}"
    );
    assert_eq!(reversed, 0.0, "hundreds of units of an f32 about 0 everywhere: {wrong:?}");
}

#[test]
fn depth_is_linear_in_one_over_the_distance() {
    for format in DepthFormat::ALL {
        for distance in [0.2_f32, 3.0, 500.0] {
            let found = format.store(format.depth_at(1.0 / f64::from(distance)) as f32);
            let [found, stored] = [found, format.encode(distance)].map(i64::from);
            // Three roundings in f32: units of the last bit of 24, or of a float.
            assert!((found - stored).abs() <= 4, "{format:?} at {distance}: {found} and {stored}");
        }
    }
}
