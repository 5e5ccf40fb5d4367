//! The part of the accuracy panel that measures what the view costs at many settings, and how wrong it then is.

use trigon_camera::Orbit;
use trigon_scene::quality::{Frontier, Preset, Quality, Sweep, SweepOptions};
use trigon_scene::{RenderSettings, Scene};
use trigon_window::{Revision, Stage, egui};

use super::measurement::{Measurement, Results};
use super::plot;

/// The measurement, if there is one.
#[derive(Default)]
pub(super) struct FrontierSection {
    measurement: Option<Measurement>,
    /// What was known of the last one.
    results: Option<(Frontier, MeasuredView)>,
    failure: Option<String>,
}

/// Everything that a measurement depends on.
#[derive(Clone, PartialEq)]
struct MeasuredView {
    scene: Revision,
    orbit: Orbit,
    /// At the quality of the reference.
    settings: RenderSettings,
}

impl MeasuredView {
    fn of(stage: &Stage) -> Self {
        let mut settings = stage.image_settings();
        Preset::Reference.apply(&mut settings);
        Self { scene: stage.scene.revision(), orbit: stage.orbit, settings }
    }
}

impl FrontierSection {
    /// Shows it; returns the setting that was clicked.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, stage: &Stage) -> Option<Quality> {
        let is_current = self.follow(stage);
        ui.strong("error against time");
        match &self.measurement {
            None => {
                let label = if self.results.is_some() { "Measure again" } else { "Measure this view" };
                let is_possible = !stage.scene.nodes().is_empty();
                if ui.add_enabled(is_possible, egui::Button::new(label)).clicked() {
                    self.start(stage);
                    // It waits for a pass while the window rests.
                    ui.ctx().request_repaint();
                }
            }
            Some(measurement) => {
                let Results { progress, .. } = measurement.results();
                let mut is_cancelled = false;
                ui.horizontal(|ui| {
                    is_cancelled = ui.button("Cancel").clicked();
                    let text = format!("frame {} of {}", progress.done, progress.of);
                    let share = progress.done as f32 / progress.of.max(1) as f32;
                    ui.add(egui::ProgressBar::new(share).text(text));
                });
                if is_cancelled {
                    self.cancel();
                }
            }
        }
        if let Some(failure) = &self.failure {
            ui.label(failure);
        }
        let current = Quality::of(&stage.settings);
        let (frontier, _) = self.results.as_ref().filter(|(frontier, _)| !frontier.dots.is_empty())?;
        if !is_current {
            ui.strong("This was another view, size or effect.");
        }
        let chosen = plot::show(ui, frontier, stage.frame_budget, current);
        notes(ui, stage);
        chosen
    }

    /// Takes over what was measured; what is measured of another view is cancelled. Returns whether the results are
    /// those of this view.
    fn follow(&mut self, stage: &Stage) -> bool {
        let is_current = self.results.as_ref().is_some_and(|(_, view)| *view == MeasuredView::of(stage));
        let Some(measurement) = &self.measurement else { return is_current };
        measurement.interface_is_drawn(stage.is_resting());
        let Results { frontier, failure, .. } = measurement.results();
        if let Some((known, _)) = &mut self.results {
            *known = frontier;
        }
        if !is_current || measurement.is_over() {
            (self.failure, self.measurement) = (failure, None);
        }
        is_current
    }

    /// Cancels what is measured.
    pub(super) fn cancel(&mut self) {
        self.measurement = None;
    }

    fn start(&mut self, stage: &Stage) {
        let scene = Scene::clone(&stage.scene);
        let sweep = Sweep::new(scene, stage.camera(), &stage.image_settings(), SweepOptions::default());
        self.results = Some((sweep.frontier(), MeasuredView::of(stage)));
        let waker = stage.waker();
        self.measurement = Some(Measurement::start(sweep, move || waker.wake()));
        self.failure = None;
    }
}

/// What the colours mean, and how it is measured.
fn notes(ui: &mut egui::Ui, stage: &Stage) {
    let ms = stage.frame_budget.as_secs_f64() * 1e3;
    let text = format!(
        "Blue: no other setting is faster and more accurate; hollow: one is, within the spread of times; grey: one \
         certainly is. Ring: what {ms:.0} ms buy. Square: what is shown. A click on a dot uses its setting.\n\
         Errors are relative to reference at this size, not to the exact image. Times are medians, with their \
         quartiles. Frames are measured while the window rests, and again if it draws meanwhile."
    );
    ui.label(egui::RichText::new(text).small());
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use trigon_scene::Node;
    use trigon_scene::quality::{FrontierDot, Standing, TimeSpread};

    use super::*;

    /// What a measurement of this view has found: the presets, each with a tenth of the error and twice the time.
    fn measured(stage: &Stage) -> FrontierSection {
        let dot = |(preset, step): (Preset, u32)| FrontierDot {
            quality: preset.quality().within(&stage.settings),
            preset: Some(preset),
            time: TimeSpread {
                low: Duration::from_millis(9 << step),
                median: Duration::from_millis(10 << step),
                high: Duration::from_millis(11 << step),
            },
            frames: 5,
            error: [0.1, 0.01, 0.001, 0.0][step as usize],
            standing: Standing::Best,
        };
        let dots = Preset::ALL.into_iter().zip(0..).map(dot).collect();
        let frontier = Frontier { dots, floor: 0.002, reference: Preset::Reference.quality() };
        FrontierSection { results: Some((frontier, MeasuredView::of(stage))), ..FrontierSection::default() }
    }

    /// What a pass of the interface shows.
    #[derive(Default)]
    struct Pass {
        clicked: Option<Quality>,
        text: String,
        /// Names and centres, as screen readers have them.
        widgets: Vec<(String, egui::Pos2)>,
    }

    /// Passes of the interface with one event each, after one without any.
    fn run(section: &mut FrontierSection, stage: &Stage, events: Vec<egui::Event>) -> Pass {
        let context = egui::Context::default();
        context.enable_accesskit();
        let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(400.0, 600.0));
        let mut last = Pass::default();
        let passes = std::iter::once(Vec::new()).chain(events.into_iter().map(|event| vec![event]));
        for (pass, events) in passes.enumerate() {
            let input = egui::RawInput {
                screen_rect: Some(screen),
                // A press of less than 0.8 s is a click.
                time: Some(0.1 * pass as f64),
                events,
                ..egui::RawInput::default()
            };
            let mut clicked = last.clicked;
            let mut output = context.run_ui(input, |ui| clicked = section.show(ui, stage).or(clicked));
            output.textures_delta.clear();
            let texts = output.shapes.iter().filter_map(|clipped| match &clipped.shape {
                egui::Shape::Text(text) => Some(text.galley.text().to_owned() + "\n"),
                _ => None,
            });
            let update = output.platform_output.accesskit_update.take().expect("it is on");
            let widgets = update.nodes.iter().filter_map(|(_, node)| {
                let bounds = node.bounds()?;
                let [x, y] = [bounds.x0 + bounds.x1, bounds.y0 + bounds.y1].map(|sum| 0.5 * sum as f32);
                Some((node.label()?.to_owned(), egui::pos2(x, y)))
            });
            last = Pass { clicked, text: texts.collect(), widgets: widgets.collect() };
        }
        last
    }

    fn click(at: egui::Pos2) -> Vec<egui::Event> {
        let button = |pressed| egui::Event::PointerButton {
            pos: at,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: egui::Modifiers::NONE,
        };
        vec![egui::Event::PointerMoved(at), button(true), button(false)]
    }

    #[test]
    fn the_plot_says_what_errors_are_relative_to() {
        let mut stage = Stage::new("test");
        let text = run(&mut FrontierSection::default(), &stage, Vec::new()).text;
        assert!(text.contains("Measure this view") && !text.contains("draft"), "nothing is known: {text}");
        let mut section = measured(&stage);
        let text = run(&mut section, &stage, Vec::new()).text;
        for part in [
            "Measure again",
            "draft",
            "reference",
            "rounding to 8-bit bytes",
            "not to the exact image",
            "33 ms",
        ] {
            assert!(text.contains(part), "{part} is not in {text}");
        }
        assert!(!text.contains("another view"), "{text}");
        Preset::High.apply(&mut stage.settings);
        assert!(!run(&mut section, &stage, Vec::new()).text.contains("another view"), "of any quality");
        stage.orbit.zoom(1.5);
        assert!(run(&mut section, &stage, Vec::new()).text.contains("another view"), "nearer");
    }

    #[test]
    fn a_click_on_a_dot_uses_its_setting() {
        let stage = Stage::new("test");
        let mut section = measured(&stage);
        let widgets = run(&mut section, &stage, Vec::new()).widgets;
        for preset in Preset::ALL {
            let name = format!("{preset}: ");
            let (_, at) = widgets.iter().find(|(label, _)| label.starts_with(&name)).expect("a dot");
            let clicked = run(&mut section, &stage, click(*at)).clicked;
            assert_eq!(clicked, Some(preset.quality().within(&stage.settings)), "{preset}");
        }
        let beside = egui::pos2(300.0, 60.0);
        assert_eq!(run(&mut section, &stage, click(beside)).clicked, None, "where there is no dot");
    }

    #[test]
    fn another_view_cancels_the_measurement() {
        let mut stage = Stage::new("test");
        stage.scene.add(Node::default());
        let mut section = FrontierSection::default();
        section.start(&stage);
        assert!(section.follow(&stage) && section.measurement.is_some(), "it goes on");
        stage.orbit.zoom(1.5);
        assert!(!section.follow(&stage) && section.measurement.is_none(), "it is of another view");
    }
}
