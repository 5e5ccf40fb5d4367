//! What the keys of panels and overlays do.

use trigon_window::Stage;

use super::Viewer;
use crate::scenery::Scenery;
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
