//! The effect of changing a setting on the time of an image.

use std::collections::HashMap;
use std::time::Duration;

use trigon_scene::RenderSettings;

use super::settings::Setting;

/// Compares what images took before and after a change.
#[derive(Default)]
pub(super) struct Costs {
    /// What was measured last.
    last: Option<(RenderSettings, Duration)>,
    /// What was changed since then.
    changed: Option<Setting>,
    differences: HashMap<Setting, f64>,
}

impl Costs {
    /// A setting was changed by hand.
    pub(super) fn changed(&mut self, setting: Setting) {
        self.changed = Some(setting);
    }

    /// Several were changed at once: nothing can be said of a single one.
    pub(super) fn changed_all(&mut self) {
        *self = Self::default();
    }

    /// An image with these settings took this long.
    pub(super) fn measured(&mut self, settings: &RenderSettings, took: Duration) {
        let before = self.last.replace((settings.clone(), took));
        let Some((_, before)) = before.filter(|(before, _)| before != settings) else { return };
        if let Some(setting) = self.changed.take() {
            self.differences.insert(setting, (took.as_secs_f64() - before.as_secs_f64()) * 1e3);
        }
    }

    /// "+3.1 ms": what the last change of a setting did; empty if it was not changed.
    pub(super) fn of(&self, setting: Setting) -> String {
        self.differences.get(&setting).map(|ms| format!("{ms:+.1} ms")).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_costs_what_the_image_takes_longer() {
        let mut costs = Costs::default();
        let (one, mut two) = (RenderSettings::new(8, 8), RenderSettings::new(8, 8));
        two.samples = 4;
        let ms = Duration::from_millis;
        costs.measured(&one, ms(10));
        costs.measured(&one, ms(11));
        assert_eq!(costs.of(Setting::Multisampling), "", "nothing was changed");
        costs.changed(Setting::Multisampling);
        costs.measured(&one, ms(12));
        assert_eq!(costs.of(Setting::Multisampling), "", "the new image is not there yet");
        costs.measured(&two, ms(20));
        assert_eq!(costs.of(Setting::Multisampling), "+8.0 ms", "more");
        costs.measured(&one, ms(10));
        assert_eq!(costs.of(Setting::Multisampling), "+8.0 ms", "what nobody changed here says nothing");
        costs.changed(Setting::Multisampling);
        costs.measured(&two, ms(9));
        assert_eq!(costs.of(Setting::Multisampling), "-1.0 ms", "or less");
        costs.changed_all();
        assert_eq!(costs.of(Setting::Multisampling), "", "begun anew");
    }
}
