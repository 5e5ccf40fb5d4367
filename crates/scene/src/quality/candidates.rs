//! The qualities among which a time budget chooses.

use super::{Preset, Quality};

/// The qualities that a budget chooses from, fastest first; the presets are among them.
///
/// There are few shadow methods and ray counts, because changing the size of shadow maps means
/// drawing them again.
pub fn candidates() -> [Quality; 12] {
    let [draft, standard, high, reference] = Preset::ALL.map(Preset::quality);
    let samples = |quality, samples| Quality { samples, ..quality };
    let nine = |quality| Quality { samples_per_axis: 3, ..quality };
    [
        draft,
        samples(draft, 2),
        samples(draft, 4),
        samples(draft, 8),
        standard,
        samples(standard, 2),
        samples(standard, 4),
        nine(high),
        nine(samples(high, 2)),
        high,
        samples(high, 2),
        reference,
    ]
}
