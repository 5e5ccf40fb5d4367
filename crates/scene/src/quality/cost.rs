//! Predicts the time of a frame, from the frames that were drawn before.

use std::time::Duration;

use super::Quality;
use crate::effect_settings::{RaySampling, Shadows};
use crate::settings::{RenderSettings, ShadingModel};

/// The units of work that make up a frame's time: the frame itself (its vertices and triangles),
/// pixels, shaded samples, additional samples, lighting at each shaded sample, shadow rays there,
/// ambient occlusion rays, rays to lamps with an extent.
const UNITS: usize = 8;

/// Nanoseconds per unit before anything was measured. Only their proportions count, and only until
/// frames have given better values; they are those of the built-in scene on two threads. A ray to a lamp with
/// an extent counts a quarter of one of ambient occlusion: it takes as long, but settings cannot tell whether a scene has
/// such lamps, and most have none.
const USUAL: [f64; UNITS] = [500_000.0, 4.0, 15.0, 4.0, 10.0, 60.0, 40.0, 10.0];

/// The weight of the default proportions relative to a measured frame.
const TRUST_IN_USUAL: f64 = 0.001;

/// The number of frames of different work that are remembered.
const MOST_MEASUREMENTS: usize = 32;

/// Learns from measured frames of a scene how long others will take.
///
/// Time is assumed to be linear in a few units of work, with costs that are not negative. The costs are
/// fitted to relative errors by non-negative least squares (cyclic coordinate descent; C. Lawson and R.
/// Hanson, "Solving Least Squares Problems", 1974, chapter 23, has the problem). Where frames give no
/// information, the fit is regularized towards default proportions. So more work is never predicted to take
/// less time.
///
/// If work that was done before takes longer now, the scene has become more expensive, and all remembered
/// times are scaled half of the way. This follows a moving camera, and a frame that had to wait for another
/// program misleads only once.
///
/// ```
/// use std::time::Duration;
/// use trigon_scene::quality::CostModel;
/// use trigon_scene::RenderSettings;
///
/// let small = RenderSettings { samples_per_axis: 1, ..RenderSettings::new(100, 100) };
/// let large = RenderSettings { width: 200, height: 200, ..small.clone() };
/// let mut costs = CostModel::default();
/// costs.learn(&small, Duration::from_millis(2));
/// costs.learn(&large, Duration::from_millis(5));
/// let between = costs.predict(&RenderSettings { height: 200, ..small });
/// assert!(between > Duration::from_millis(2) && between < Duration::from_millis(5));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CostModel {
    measurements: Vec<Measurement>,
    /// Nanoseconds of each unit.
    costs: [f64; UNITS],
}

/// Measured work.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Measurement {
    work: [f64; UNITS],
    /// Nanoseconds, greater than 0.
    time: f64,
}

impl Default for CostModel {
    /// For an unknown scene and machine.
    fn default() -> Self {
        Self { measurements: Vec::new(), costs: USUAL }
    }
}

impl CostModel {
    /// Reports that a frame with these settings took this long.
    pub fn learn(&mut self, settings: &RenderSettings, time: Duration) {
        /// The largest change that one frame may cause.
        const MOST_CHANGE: f64 = 8.0;
        let (work, time) = (work(settings), (time.as_nanos() as f64).max(1.0));
        if let Some(known) = self.measurements.iter().find(|measurement| measurement.work == work) {
            let change = (time / known.time).clamp(1.0 / MOST_CHANGE, MOST_CHANGE).sqrt();
            self.measurements.iter_mut().for_each(|measurement| measurement.time *= change);
            self.costs.iter_mut().for_each(|cost| *cost *= change);
            return;
        }
        if self.measurements.len() == MOST_MEASUREMENTS {
            self.measurements.remove(0);
        }
        self.measurements.push(Measurement { work, time });
        self.costs = fitted(&self.measurements);
    }

    /// The predicted time of a frame with these settings.
    pub fn predict(&self, settings: &RenderSettings) -> Duration {
        let work = work(settings);
        let same = self
            .measurements
            .iter()
            .find(|measurement| measurement.work == work)
            .map(|measurement| measurement.time);
        let time = same.unwrap_or_else(|| sum(&work, &self.costs));
        // At least the time measured for less work in the same number of pixels.
        let is_part = |measurement: &&Measurement| {
            measurement.work[1] == work[1]
                && measurement.work.iter().zip(&work).all(|(part, whole)| part <= whole)
        };
        let parts = self.measurements.iter().filter(is_part).map(|measurement| measurement.time);
        Duration::from_nanos(parts.fold(time, f64::max) as u64)
    }
}

/// The units of work in a frame.
fn work(settings: &RenderSettings) -> [f64; UNITS] {
    let quality = Quality::of(settings);
    let pixels = f64::from(settings.width) * f64::from(settings.height);
    let shaded = pixels * f64::from(quality.shaded_samples());
    let when = |is_so: bool| if is_so { shaded } else { 0.0 };
    let all_rays = |rays: u32, sampling| {
        f64::from(rays)
            * match sampling {
                RaySampling::Full => shaded,
                // A sixteenth of them in a quarter of the pixels.
                RaySampling::Shared => pixels / 64.0,
            }
    };
    [
        1.0,
        pixels,
        shaded,
        shaded * f64::from(quality.samples.saturating_sub(1)),
        when(quality.shading == ShadingModel::Phong),
        when(quality.shadows == Shadows::Rays),
        all_rays(quality.occlusion_rays, quality.occlusion_sampling),
        all_rays(quality.shadow_rays, quality.shadow_sampling),
    ]
}

fn sum(work: &[f64; UNITS], costs: &[f64; UNITS]) -> f64 {
    work.iter().zip(costs).map(|(work, cost)| work * cost).sum()
}

/// The costs that fit the measured frames.
fn fitted(measurements: &[Measurement]) -> [f64; UNITS] {
    /// More iterations than needed for convergence.
    const SWEEPS: usize = 256;
    let mut scales: Vec<f64> =
        measurements.iter().map(|measurement| measurement.time / sum(&measurement.work, &USUAL)).collect();
    scales.sort_by(f64::total_cmp);
    let scale = scales.get(scales.len() / 2).copied().unwrap_or(1.0);
    let usual = USUAL.map(|cost| cost * scale);
    // Each unit's share of each time, at its default cost.
    let share = |measurement: &Measurement| {
        std::array::from_fn(|unit| measurement.work[unit] * usual[unit] / measurement.time)
    };
    let rows: Vec<[f64; UNITS]> = measurements.iter().map(share).collect();
    let mut factors = [1.0; UNITS];
    for _ in 0..SWEEPS {
        for unit in 0..UNITS {
            let (mut above, mut below) = (TRUST_IN_USUAL, TRUST_IN_USUAL);
            for row in &rows {
                let others = sum(row, &factors) - row[unit] * factors[unit];
                above += row[unit] * (1.0 - others);
                below += row[unit] * row[unit];
            }
            factors[unit] = (above / below).max(0.0);
        }
    }
    std::array::from_fn(|unit| factors[unit] * usual[unit])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect_settings::EffectSettings;
    use crate::quality::{Preset, candidates};

    fn image(quality: Quality) -> RenderSettings {
        let mut settings = RenderSettings::new(320, 200);
        quality.apply(&mut settings);
        settings
    }

    /// Milliseconds on a fictional machine that does not follow the default proportions.
    fn invented(settings: &RenderSettings) -> Duration {
        let costs = [3e6, 1.0, 40.0, 1.0, 2.0, 0.0, 0.0, 0.0];
        Duration::from_nanos(sum(&work(settings), &costs) as u64)
    }

    #[test]
    fn an_unknown_machine_is_learnt_from_a_few_frames() {
        let mut costs = CostModel::default();
        let learnt = [(1, 1), (1, 4), (2, 1)];
        for (samples_per_axis, samples) in learnt {
            let quality = Quality { samples_per_axis, samples, ..Preset::Draft.quality() };
            costs.learn(&image(quality), invented(&image(quality)));
        }
        let by_vertex = image(Quality { shading: ShadingModel::Gouraud, ..Preset::Draft.quality() });
        costs.learn(&by_vertex, invented(&by_vertex));
        for quality in candidates() {
            let (said, is) = (costs.predict(&image(quality)), invented(&image(quality)));
            let ratio = said.as_secs_f64() / is.as_secs_f64();
            assert!((0.8..1.25).contains(&ratio), "{quality}: {said:?} of {is:?}");
        }
    }

    /// To each of these lamps the reference casts 1,024 rays in each pixel, the others a few that pixels share, or none.
    #[test]
    fn the_reference_is_foreseen_with_lamps_of_an_extent_and_without() {
        for nanoseconds in [0.0, 40.0, 200.0] {
            let frame = |size: u32, quality: Quality| {
                let effects = EffectSettings { shadows: Shadows::Rays, ..EffectSettings::default() };
                let mut settings = RenderSettings { effects, ..RenderSettings::new(size, size) };
                quality.apply(&mut settings);
                settings
            };
            let takes = |settings: &RenderSettings| {
                let costs = [1e5, 5.0, 20.0, 6.0, 8.0, 80.0, 0.0, nanoseconds];
                Duration::from_nanos(sum(&work(settings), &costs) as u64)
            };
            let mut costs = CostModel::default();
            for quality in candidates() {
                costs.learn(&frame(60, quality), takes(&frame(60, quality)));
            }
            for preset in [Preset::High, Preset::Reference] {
                let whole = frame(400, preset.quality());
                let ratio = costs.predict(&whole).as_secs_f64() / takes(&whole).as_secs_f64();
                assert!((0.8..1.25).contains(&ratio), "{preset}, {nanoseconds} ns: {ratio}");
            }
        }
    }

    #[test]
    fn more_work_never_takes_less() {
        let mut costs = CostModel::default();
        // Contradictory: the least work took longest.
        let qualities = Preset::ALL.map(Preset::quality);
        for (quality, milliseconds) in qualities.into_iter().zip([9, 1, 5, 2]) {
            costs.learn(&image(quality), Duration::from_millis(milliseconds));
        }
        let times = qualities.map(|quality| costs.predict(&image(quality)));
        assert!(times.is_sorted(), "{times:?}");
        assert!(costs.costs.iter().all(|&cost| cost >= 0.0), "{:?}", costs.costs);
    }

    #[test]
    fn a_scene_that_comes_to_cost_more_does_so_at_every_quality() {
        let mut costs = CostModel::default();
        let [draft, standard, ..] = Preset::ALL.map(|preset| image(preset.quality()));
        [&draft, &standard].into_iter().for_each(|settings| costs.learn(settings, invented(settings)));
        for _ in 0..8 {
            costs.learn(&draft, 3 * invented(&draft));
        }
        let ratio = costs.predict(&standard).as_secs_f64() / invented(&standard).as_secs_f64();
        // Each frame goes half of the way that is left, in logarithms: 3^(1 − 2⁻⁸).
        assert!((2.98..3.0001).contains(&ratio), "also at the other one: {ratio}");
    }

    #[test]
    fn one_frame_that_waited_misleads_little_and_not_for_long() {
        let mut costs = CostModel::default();
        let draft = image(Preset::Draft.quality());
        let usual = invented(&draft);
        costs.learn(&draft, usual);
        costs.learn(&draft, 1000 * usual);
        assert!(costs.predict(&draft) < 3 * usual, "the root of eight");
        (0..4).for_each(|_| costs.learn(&draft, usual));
        // 8^(1/2 / 2⁴) = 1.07
        assert!(costs.predict(&draft) < usual.mul_f64(1.08), "it is forgotten");
    }

    #[test]
    fn memory_has_an_end() {
        let mut costs = CostModel::default();
        for width in 1..100 {
            costs.learn(&RenderSettings::new(width, 10), Duration::from_micros(u64::from(width)));
        }
        assert_eq!(costs.measurements.len(), MOST_MEASUREMENTS, "the newest");
        costs.learn(&RenderSettings::new(5, 5), Duration::ZERO);
        assert!(costs.costs.iter().all(|cost| cost.is_finite()), "a clock that stands still");
    }
}
