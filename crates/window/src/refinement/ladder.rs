//! The sequence of images at rest, each better than the one before.

use trigon_scene::RenderSettings;
use trigon_scene::quality::{Preset, Quality};

use super::{Comparison, Refinement};

/// The settings of the images at rest: the given ones, the better presets, the reference. The last
/// one is always the reference. If the first is not drawn by the renderer, it does not count as the
/// reference, whatever its settings are.
pub(crate) fn ladder(settings: &RenderSettings, drawn_otherwise: bool) -> Vec<RenderSettings> {
    let with = |preset: Preset| {
        let mut settings = settings.clone();
        preset.apply(&mut settings);
        settings
    };
    let reference = with(Preset::Reference);
    let mut steps = vec![settings.clone()];
    for preset in [Preset::Standard, Preset::High].map(with) {
        if steps.last().is_some_and(|last| is_better(&preset, last)) && is_better(&reference, &preset) {
            steps.push(preset);
        }
    }
    if drawn_otherwise || steps.last() != Some(&reference) {
        steps.push(reference);
    }
    steps
}

/// The steps to do, for a ladder of some length and the comparison after it.
pub(crate) fn wanted(length: usize, refinement: Refinement, comparison: Comparison) -> Vec<usize> {
    match (refinement, comparison) {
        (Refinement::Settings, Comparison::Off) => vec![0],
        (Refinement::Reference, Comparison::Off) => (0..length).collect(),
        (Refinement::Reference, _) => (0..=length).collect(),
        (Refinement::Settings, _) => {
            let mut steps = vec![0, length - 1, length];
            steps.dedup();
            steps
        }
    }
}

fn is_better(one: &RenderSettings, other: &RenderSettings) -> bool {
    Quality::of(one).is_finer_than(&Quality::of(other))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_scene::AmbientOcclusion;

    fn samples(settings: &RenderSettings) -> Vec<(u32, u32)> {
        ladder(settings, false).iter().map(|step| (step.samples_per_axis, step.samples)).collect()
    }

    #[test]
    fn each_step_is_better_and_the_last_one_is_the_reference() {
        let mut settings = RenderSettings { samples_per_axis: 1, ..RenderSettings::new(8, 8) };
        assert_eq!(samples(&settings), [(1, 1), (2, 1), (4, 1), (4, 16)], "all presets are better");
        settings.samples_per_axis = 3;
        assert_eq!(samples(&settings), [(3, 1), (4, 1), (4, 16)], "one shades less and is left out");
        settings.effects.ambient_occlusion = Some(AmbientOcclusion::new(40, 1.0));
        assert_eq!(samples(&settings), [(3, 1), (4, 16)], "one has fewer rays and is left out");
        Preset::Reference.apply(&mut settings);
        assert_eq!(ladder(&settings, false), [settings.clone()], "the reference is the reference");
        assert_eq!(ladder(&settings, true).len(), 2, "unless something else draws it");
    }

    #[test]
    fn only_what_somebody_looks_at_is_drawn() {
        use {Comparison as C, Refinement as R};
        assert_eq!(wanted(4, R::Settings, C::Off), [0], "as the settings say");
        assert_eq!(wanted(4, R::Reference, C::Off), [0, 1, 2, 3], "step by step");
        assert_eq!(wanted(4, R::Settings, C::Shown), [0, 3, 4], "the reference is needed for comparing");
        assert_eq!(wanted(4, R::Reference, C::Measured), [0, 1, 2, 3, 4], "all of it");
        assert_eq!(wanted(1, R::Settings, C::Measured), [0, 1], "where the settings are the reference");
    }
}
