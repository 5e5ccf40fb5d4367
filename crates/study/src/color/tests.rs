//! What the report claims of mixing light.

use super::*;

#[test]
fn linear_light_is_right_to_half_a_byte() {
    let error = Mixing::Linear.error();
    // The widest step of sRGB bytes, 254 to 255, is 0.9 % of the light.
    assert!(error.worst < 0.0046, "{}", error.worst);
    assert!(error.delta_e() < 0.2, "{}", error.delta_e());
}

#[test]
fn bytes_of_either_kind_are_seen() {
    let [gamma, bytes, linear] = Mixing::ALL.map(|mixing| mixing.error());
    assert!(gamma.delta_e() > 2.0, "black and white make a grey that is too dark: {}", gamma.delta_e());
    assert!(
        bytes.delta_e() > 1.5 * linear.delta_e(),
        "dark greys have few linear bytes: {}",
        bytes.delta_e()
    );
    assert_eq!(Mixing::GammaBytes.mix(0, 255), 128, "which is 22 % of the light");
    assert_eq!(Mixing::Linear.mix(0, 255), 188, "which is half");
}
