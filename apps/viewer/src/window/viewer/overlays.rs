//! What the keys of panels and overlays do.

use trigon_scene::Display;
use trigon_window::Stage;

use super::Viewer;
use crate::scenery::Scenery;
use crate::window::comparing::Comparing;
use crate::window::overlay_commands::OverlayCommand;
use crate::window::side::Content;

impl Viewer {
    pub(super) fn run_overlay(&mut self, stage: &mut Stage, command: OverlayCommand) {
        match command {
            OverlayCommand::Tree => self.side.toggle(stage, Content::Tree),
            OverlayCommand::Pixel => self.side.toggle(stage, Content::Pixel),
            OverlayCommand::Effects => self.side.toggle(stage, Content::Effects),
            OverlayCommand::StageTimes => stage.stage_times = stage.stage_times.toggled(),
            OverlayCommand::Axes => self.request.overlay.shows_axes ^= true,
            OverlayCommand::Grid => self.toggle_grid(stage),
            OverlayCommand::Displays => self.side.toggle(stage, Content::Displays),
            OverlayCommand::NextDisplay => self.step_display(stage, 1),
            OverlayCommand::PreviousDisplay => self.step_display(stage, Display::ALL.len() - 1),
            OverlayCommand::Matcap => self.toggle_display(stage, Display::Matcap),
            OverlayCommand::Measure => self.measuring.toggle(),
            OverlayCommand::Copy => self.copy_command(stage),
            OverlayCommand::SaveState => self.save_state(stage),
            OverlayCommand::LoadState => self.load_state(stage),
            OverlayCommand::Blink => self.compare(stage, Comparing::blink),
            OverlayCommand::Heat => self.compare(stage, Comparing::toggle_heat),
            OverlayCommand::Depth => self.toggle_display(stage, Display::Depth),
        }
    }

    /// Goes so many steps on in the list of what faces can show, around its end.
    fn step_display(&self, stage: &mut Stage, by: usize) {
        let now = Display::ALL.iter().position(|&display| display == stage.settings.display).unwrap_or(0);
        self.set_display(stage, Display::ALL[(now + by) % Display::ALL.len()]);
    }

    fn toggle_display(&self, stage: &mut Stage, display: Display) {
        let is_on = stage.settings.display == display;
        self.set_display(stage, if is_on { Display::Shaded } else { display });
    }

    fn set_display(&self, stage: &mut Stage, display: Display) {
        stage.settings.display = display;
        self.notify(stage, format!("faces show: {}", display.name()));
    }

    fn compare(&mut self, stage: &mut Stage, change: fn(&mut Comparing, &mut Stage)) {
        match &mut self.comparing {
            Some(comparing) => change(comparing, stage),
            None => self.notify(stage, "there is no other model; start with --compare FILE"),
        }
    }

    /// Shows the grid, or removes it. It is part of the scene, and hidden by the model like any lines.
    fn toggle_grid(&mut self, stage: &mut Stage) {
        self.request.scenery.shows_grid ^= true;
        let Some(shown) = &mut self.shown else { return };
        let grid = shown
            .scenery
            .iter()
            .copied()
            .find(|&id| stage.scene.node(id).is_some_and(|node| node.name == Scenery::GRID));
        match grid {
            Some(grid) => {
                stage.scene.remove(grid);
                shown.scenery.retain(|&id| id != grid);
            }
            None => {
                let model = shown.model(stage);
                shown.scenery.push(self.request.scenery.add_grid(&mut stage.scene, &model.scene));
            }
        }
    }
}
