//! Which effects the image has, and why.

use trigon_camera::{Orbit, Viewport};
use trigon_scene::{EffectPlan, RenderSettings};
use trigon_window::{Revision, Stage, egui};

/// All that a plan depends on.
type EffectPlanKey = (Revision, Orbit, RenderSettings, Viewport);

/// The plan of the image in the window.
#[derive(Default)]
pub(super) struct EffectPanel {
    /// Planning visits the whole scene, so the plan is cached.
    planned: Option<(EffectPlanKey, EffectPlan)>,
}

impl EffectPanel {
    pub(super) fn show(&mut self, ui: &mut egui::Ui, stage: &Stage) {
        let plan = self.plan(stage);
        let (on, off): (Vec<_>, Vec<_>) = plan.iter().partition(|(effect, _)| plan.is_on(*effect));
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (title, effects) in [("On", on), ("Off", off)] {
                ui.add_space(4.0);
                ui.strong(title);
                for (effect, decision) in effects {
                    // "on, because …": the title says the first word.
                    let text = decision.to_string();
                    let (_, reason) = text.split_once(", ").unwrap_or(("", &text));
                    ui.add(egui::Label::new(format!("{effect}: {reason}")).wrap());
                }
            }
        });
    }

    fn plan(&mut self, stage: &Stage) -> &EffectPlan {
        let subject = (stage.scene.revision(), stage.orbit, stage.settings.clone(), stage.viewport());
        let cached = self.planned.take().filter(|(of, _)| *of == subject);
        let planned = cached.unwrap_or_else(|| {
            let plan = EffectPlan::new(&stage.scene, &stage.camera(), &stage.image_settings());
            (subject, plan)
        });
        &self.planned.insert(planned).1
    }
}
