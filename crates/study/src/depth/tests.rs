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
