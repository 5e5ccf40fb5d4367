//! How long the properties run.

use proptest::prelude::ProptestConfig;

/// A number of cases, and with `PROPTEST_CASES` set as many times more as that is more than
/// proptest's own 256: then one variable makes all properties run longer, the cheap and
/// the dear ones in proportion.
pub(crate) fn scaled(cases: u32) -> u32 {
    const USUAL: u64 = 256;
    let scaled = u64::from(cases) * u64::from(ProptestConfig::default().cases) / USUAL;
    u32::try_from(scaled.max(1)).unwrap_or(u32::MAX)
}

/// A property that draws so many [`scaled`] cases.
///
/// Says how many in a line of its own, which is seen with `--show-output`: so those of a
/// run can be added up.
#[expect(clippy::print_stdout, reason = "captured unless it is asked for")]
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    let usual = ProptestConfig::default();
    let config = ProptestConfig {
        cases: scaled(cases),
        max_global_rejects: scaled(usual.max_global_rejects),
        ..usual
    };
    println!("{} cases", config.cases);
    config
}
