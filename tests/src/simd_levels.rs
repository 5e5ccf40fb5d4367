//! SIMD levels: their names, and what happens where the processor lacks one.

use trigon_raster::simd::{SimdLevel, SimdLevelError};
use trigon_raster::{ExecuteSettings, Rasterizer};

#[test]
fn names_and_levels_are_one_to_one() {
    for level in SimdLevel::ALL {
        assert_eq!(level.to_string().parse(), Ok(level), "{level:?} and back");
    }
    for name in ["", "Scalar", "avx", "sse2 ", "512"] {
        assert_eq!(name.parse::<SimdLevel>(), Err(SimdLevelError::Unknown), "{name:?}");
    }
}

/// An error, not another level in its place.
#[test]
fn a_level_that_the_processor_lacks_is_refused() {
    for level in SimdLevel::ALL {
        let made = Rasterizer::new(ExecuteSettings { simd: Some(level), ..Default::default() }).map(|_| ());
        let expected = if level.is_supported() { Ok(()) } else { Err(SimdLevelError::Unsupported(level)) };
        assert_eq!(made, expected, "{level}");
    }
    assert_eq!(
        SimdLevel::Scalar.is_supported(),
        cfg!(feature = "scalar"),
        "everywhere, where it is built in"
    );
    assert!(SimdLevel::best().is_supported(), "the best of them");
    let foreign = if cfg!(target_arch = "aarch64") { SimdLevel::Avx2 } else { SimdLevel::Neon };
    assert!(!foreign.is_supported(), "{foreign} is another architecture's");
    let message = SimdLevelError::Unsupported(foreign).to_string();
    assert!(message.contains(&format!("the SIMD level {foreign}")), "names it: {message}");
}
