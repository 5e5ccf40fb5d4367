//! The accuracy panel: each setting that trades accuracy for time, the time of the image, its
//! difference from the reference, and both at many other settings.

mod costs;
mod frontier;
mod measurement;
mod plot;
mod settings;

use std::time::Duration;

use trigon_scene::quality::Quality;
use trigon_window::{Comparison, Difference, QualityReport, Refinement, Stage, choose, egui};

use costs::Costs;
use frontier::FrontierSection;
use settings::Setting;

use crate::ladder::QualityStep;

/// In points.
const WIDTH: f32 = 392.0;
const LEAST_WIDTH: f32 = 264.0;

/// The most of the window's width that it takes: the image needs more.
const SHARE: f32 = 0.36;

/// Below this width in points, what a change costs is told by the list's tooltip.
const WITH_COSTS: f32 = 370.0;

/// The widths of the columns beside the lists, with the gaps.
const LABELS: f32 = 122.0;
const COSTS: f32 = 76.0;

/// Budgets that can be chosen, in milliseconds: 200 to 2 frames a second.
const BUDGETS: std::ops::RangeInclusive<f64> = 5.0..=500.0;

/// The panel.
#[derive(Default)]
pub(super) struct QualityPanel {
    shown: bool,
    costs: Costs,
    frontier: FrontierSection,
}

impl QualityPanel {
    /// Shows or hides it.
    pub(super) fn toggle(&mut self, stage: &mut Stage) {
        self.set_shown(!self.shown, stage);
    }

    /// The difference in place of the image, or the image again.
    pub(super) fn toggle_difference(&self, stage: &mut Stage) {
        stage.comparison = match stage.comparison {
            Comparison::Shown => self.usual_comparison(),
            Comparison::Off | Comparison::Measured => Comparison::Shown,
        };
    }

    pub(in crate::window) fn is_shown(&self) -> bool {
        self.shown
    }

    fn set_shown(&mut self, shown: bool, stage: &mut Stage) {
        self.shown = shown;
        // Nobody would tell it when the window draws.
        self.frontier.cancel();
        if stage.comparison != Comparison::Shown {
            stage.comparison = self.usual_comparison();
        }
    }

    /// While the panel is there, somebody reads the figures.
    fn usual_comparison(&self) -> Comparison {
        if self.shown { Comparison::Measured } else { Comparison::Off }
    }

    /// Shows it at the left, if it is to be seen. `beside` adds to it.
    pub(super) fn show(
        &mut self,
        ui: &mut egui::Ui,
        stage: &mut Stage,
        beside: impl FnOnce(&mut egui::Ui, &mut Stage),
    ) {
        if !self.shown {
            return;
        }
        if let Some(report) = stage.quality_report() {
            self.costs.measured(&stage.settings, report.settings);
        }
        // An open list is closed first.
        let is_alone = !egui::Popup::is_any_open(ui.ctx());
        let mut shown = !(is_alone && ui.input(|input| input.key_pressed(egui::Key::Escape)));
        let width = (ui.available_width() * SHARE).clamp(LEAST_WIDTH, WIDTH);
        let panel = egui::Panel::left("accuracy").resizable(false).exact_size(width);
        panel.show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.heading("Accuracy");
                shown &= !ui.button("Close (Escape)").clicked();
            });
            egui::ScrollArea::vertical().show(ui, |ui| {
                self.contents(ui, stage);
                beside(ui, stage);
            });
        });
        if !shown {
            self.set_shown(false, stage);
            ui.ctx().request_repaint();
        }
    }

    fn contents(&mut self, ui: &mut egui::Ui, stage: &mut Stage) {
        self.steps(ui, stage);
        ui.separator();
        let width = ui.available_width();
        egui::Grid::new("accuracy").spacing([8.0, 4.0]).show(ui, |ui| {
            for setting in Setting::ALL {
                self.row(ui, stage, width, setting);
                ui.end_row();
            }
        });
        ui.separator();
        figures(ui, stage);
        ui.separator();
        at_rest(ui, stage);
        budget(ui, stage);
        ui.separator();
        if let Some(quality) = self.frontier.show(ui, stage) {
            self.choose(stage, quality);
        }
    }

    /// Whole choices with a name, from the quickest on; the current one is lit.
    fn steps(&mut self, ui: &mut egui::Ui, stage: &mut Stage) {
        ui.horizontal_wrapped(|ui| {
            for step in QualityStep::ALL {
                if ui.selectable_label(step.is_current(&stage.settings), step.name()).clicked() {
                    self.choose(stage, step.quality());
                }
            }
        });
    }

    fn choose(&mut self, stage: &mut Stage, quality: Quality) {
        quality.apply(&mut stage.settings);
        stage.refinement = Refinement::Settings;
        self.costs.changed_all();
    }

    /// A setting, its choices, and what the last change of it cost.
    fn row(&mut self, ui: &mut egui::Ui, stage: &mut Stage, width: f32, setting: Setting) {
        let (has_costs, costs) = (width > WITH_COSTS, self.costs.of(setting));
        let label = ui.label(setting.name());
        let choices = setting.choices(&stage.settings);
        let current = choices.iter().find(|(_, choice)| *choice == stage.settings);
        let text = current.map_or("another value", |(name, _)| name.as_str());
        let width = width - LABELS - if has_costs { COSTS } else { 0.0 };
        let list = egui::ComboBox::from_id_salt(setting.name()).width(width).truncate().selected_text(text);
        let (list, chosen) = choose(ui, list, &choices, &stage.settings);
        let list = list.labelled_by(label.id);
        if !has_costs && !costs.is_empty() {
            list.on_hover_text(&costs);
        }
        if let Some(choice) = chosen {
            stage.settings = choice;
            // Whoever changes a setting wants to see what that does.
            stage.refinement = Refinement::Settings;
            self.costs.changed(setting);
        }
        if has_costs {
            ui.label(egui::RichText::new(costs).monospace());
        }
    }
}

/// What the image took, and how far it is from the reference.
fn figures(ui: &mut egui::Ui, stage: &Stage) {
    let [time, error] = stage.quality_report().map_or_else(
        || ["time: -".to_owned(), "error: -".to_owned()],
        |report| {
            [times(&report), report.difference.as_ref().map_or("error: not known yet".to_owned(), error)]
        },
    );
    ui.label(time);
    ui.label(error);
}

/// "time: 12.3 ms; the reference: 812.0 ms"
fn times(report: &QualityReport) -> String {
    let ms = |time: Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
    match (report.best, report.difference) {
        (Some(best), Some(_)) => format!("time: {}; the reference: {}", ms(report.settings), ms(best)),
        _ => format!("time: {}", ms(report.settings)),
    }
}

/// "error: RMSE 0.0123, worst pixel 0.510 (120 levels)"
fn error(difference: &Difference) -> String {
    let Difference { rmse, worst, worst_levels, .. } = *difference;
    if worst_levels == 0 {
        return "error: none; this is the reference".to_owned();
    }
    format!("error in linear light: RMSE {rmse:.4}, worst pixel {worst:.3} ({worst_levels} levels)")
}

fn at_rest(ui: &mut egui::Ui, stage: &mut Stage) {
    let mut refined = stage.refinement == Refinement::Reference;
    if ui.checkbox(&mut refined, "at rest, refine to the reference").changed() {
        stage.refinement = if refined { Refinement::Reference } else { Refinement::Settings };
    }
    let mut shown = stage.comparison == Comparison::Shown;
    if ui.checkbox(&mut shown, "show the difference from the reference (D)").changed() {
        stage.comparison = if shown { Comparison::Shown } else { Comparison::Measured };
    }
}

fn budget(ui: &mut egui::Ui, stage: &mut Stage) {
    ui.horizontal(|ui| {
        let label = ui.label("while moving, time per image");
        let mut ms = stage.frame_budget.as_secs_f64() * 1e3;
        let value = egui::DragValue::new(&mut ms).range(BUDGETS).suffix(" ms").max_decimals(0);
        if ui.add(value).labelled_by(label.id).changed() {
            stage.frame_budget = Duration::from_secs_f64(ms / 1e3);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pass of the interface; returns all text in it.
    fn pass(context: &egui::Context, panel: &mut QualityPanel, stage: &mut Stage) -> String {
        let input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(900.0, 700.0))),
            ..egui::RawInput::default()
        };
        let mut output = context.run_ui(input, |ui| panel.show(ui, stage, |_, _| {}));
        output.textures_delta.clear();
        let texts = output.shapes.iter().filter_map(|clipped| match &clipped.shape {
            egui::Shape::Text(text) => Some(text.galley.text().to_owned()),
            _ => None,
        });
        texts.collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn the_panel_shows_every_setting_and_asks_for_figures_while_it_is_there() {
        let (context, mut panel, mut stage) =
            (egui::Context::default(), QualityPanel::default(), Stage::new("test"));
        assert_eq!(pass(&context, &mut panel, &mut stage), "", "not there yet");
        panel.toggle(&mut stage);
        assert_eq!(stage.comparison, Comparison::Measured, "figures are to be read");
        pass(&context, &mut panel, &mut stage);
        let text = pass(&context, &mut panel, &mut stage);
        let names =
            Setting::ALL.map(Setting::name).into_iter().chain(QualityStep::ALL.map(QualityStep::name));
        for name in names.chain(["9", "from the material", "per image\n33\n ms"]) {
            assert!(text.contains(name), "{name} is not in\n{text}");
        }
        panel.toggle_difference(&mut stage);
        panel.toggle(&mut stage);
        assert_eq!(stage.comparison, Comparison::Shown, "the map stays without the panel");
        panel.toggle_difference(&mut stage);
        assert_eq!(stage.comparison, Comparison::Off, "nobody reads the figures any more");
    }

    #[test]
    fn figures_have_their_units() {
        let difference = Difference { rmse: 0.012_34, worst: 0.51, worst_levels: 120, share: 0.031 };
        let ms = Duration::from_millis;
        let mut report = QualityReport { settings: ms(12), best: Some(ms(800)), difference: None };
        assert_eq!(times(&report), "time: 12.0 ms", "the reference is not there yet");
        report.difference = Some(difference);
        assert_eq!(times(&report), "time: 12.0 ms; the reference: 800.0 ms", "both");
        assert_eq!(
            error(&difference),
            "error in linear light: RMSE 0.0123, worst pixel 0.510 (120 levels)",
            "of linear light"
        );
    }
}
