//! How long the properties run.

use proptest::prelude::ProptestConfig;

/// `cases` of a property, and with `PROPTEST_CASES` set as many times more as
/// that is more than proptest's own 256: then one variable makes all properties
/// run longer, the cheap and the dear ones in proportion.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    const USUAL: u64 = 256;
    let usual = ProptestConfig::default();
    let scaled = |number: u32| {
        let scaled = u64::from(number) * u64::from(usual.cases) / USUAL;
        u32::try_from(scaled.max(1)).unwrap_or(u32::MAX)
    };
    ProptestConfig { cases: scaled(cases), max_global_rejects: scaled(usual.max_global_rejects), ..usual }
}
