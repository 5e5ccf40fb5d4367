//! What the keys of panels and overlays do.

use trigon_scene::Display;
use trigon_window::Stage;

use super::Viewer;
use crate::scenery::Scenery;
use crate::window::comparing::Comparing;

impl Viewer {
    /// Goes so many steps on in the list of what faces can show, around its end.
    pub(super) fn step_display(&self, stage: &mut Stage, by: usize) {
        let now = Display::ALL.iter().position(|&display| display == stage.settings.display).unwrap_or(0);
        self.set_display(stage, Display::ALL[(now + by) % Display::ALL.len()]);
    }

    pub(super) fn toggle_display(&self, stage: &mut Stage, display: Display) {
        let is_on = stage.settings.display == display;
        self.set_display(stage, if is_on { Display::Shaded } else { display });
    }

    fn set_display(&self, stage: &mut Stage, display: Display) {
        stage.settings.display = display;
        self.notify(stage, format!("faces show: {}", display.name()));
    }

    pub(super) fn compare(&mut self, stage: &mut Stage, change: fn(&mut Comparing, &mut Stage)) {
        match &mut self.comparing {
            Some(comparing) => change(comparing, stage),
            None => self.notify(stage, "there is no other model; start with --compare FILE"),
        }
    }

    /// Shows the grid, or removes it. It is part of the scene, and hidden by the model like any lines.
    pub(super) fn toggle_grid(&mut self, stage: &mut Stage) {
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
