//! What the report claims of the same bytes.

use super::*;

#[test]
fn the_image_has_a_highlight_and_shade() {
    let light = Rules::SameBytes.draw();
    let least = light.values().iter().copied().fold(f32::INFINITY, f32::min);
    let most = light.values().iter().copied().fold(0.0, f32::max);
    assert!(least < 0.4 && most > 0.9 && most <= 1.0, "from {least} to {most}");
}

#[test]
fn the_renderers_rules_round_little() {
    // A cosine near 1 to the power of 32 has 32 times its error, which comes from a dozen
    // roundings of 2^-24: 32 · 12 · 6e-8 = 2.3e-5 at the highlight.
    let error = Rules::SameBytes.error();
    assert!(error.worst < 2.3e-5, "{error:?}");
    assert_eq!(Rules::SameBytes.other_bytes_per_mille(), 0.0, "by definition");
}

/// How far estimates are off depends on the processor; 2^-8 is the least that is documented.
#[test]
fn estimates_are_no_more_accurate_than_quotients() {
    let [ours, _, estimated] = Rules::ALL.map(|rules| rules.error().rmse());
    assert!(estimated >= ours / 2.0, "{estimated} and {ours}");
    assert!(estimated < 0.3, "but it is the same image: {estimated}");
}
