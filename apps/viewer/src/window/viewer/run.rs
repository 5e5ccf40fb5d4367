//! What the viewer's own keys do: an arm for each row of their table.

use trigon_camera::UpAxis;
use trigon_scene::{Background, Display};
use trigon_window::{Stage, Visibility};

use super::{ViewChange, Viewer};
use crate::args::Step;
use crate::window::commands::Command;
use crate::window::comparing::Comparing;
use crate::window::side::Content;

impl Viewer {
    pub(super) fn run(&mut self, stage: &mut Stage, command: Command) {
        /// Eight presses of a key double the light.
        const BRIGHTER: f32 = 1.090_507_7;
        match command {
            Command::PreviousFile => self.step(stage, -1, ViewChange::Fit),
            Command::NextFile => self.step(stage, 1, ViewChange::Fit),
            Command::PreviousFileSameView => self.step(stage, -1, ViewChange::Keep),
            Command::NextFileSameView => self.step(stage, 1, ViewChange::Keep),
            Command::Reload => self.load_again(stage),
            Command::Open => {
                stage.cheat_sheet = Visibility::Hidden;
                self.open.toggle();
            }
            Command::PlayOrPause => self.play(stage, |playback, stage| {
                playback.toggle(stage);
                None
            }),
            Command::PlayBackward => self.play(stage, |playback, stage| {
                playback.toggle_backward(stage);
                None
            }),
            Command::CycleAnimation => self.play(stage, |playback, stage| Some(playback.cycle(stage))),
            Command::AddFolder => self.add_folder(stage),
            Command::CancelLoading => self.cancel_loading(stage),
            Command::ResetView => self.reset_view(stage),
            Command::ToggleName => self.show_name = !self.show_name,
            Command::ToggleMetadata => self.show_metadata = !self.show_metadata,
            Command::ToggleDifference => self.quality.toggle_difference(stage),
            Command::ToggleQuality => self.quality.toggle(stage),
            Command::Brighter => Self::brighten(stage, BRIGHTER),
            Command::Darker => Self::brighten(stage, 1.0 / BRIGHTER),
            Command::UpY => self.set_up(stage, UpAxis::Y),
            Command::UpZ => self.set_up(stage, UpAxis::Z),
            Command::Screenshot => self.take_screenshot(stage, stage.settings.background, None),
            Command::ScreenshotWithoutBackground => {
                self.take_screenshot(stage, Background::Transparent, None);
            }
            Command::AmbientOcclusion => self.toggle_flag(stage, "ambient-occlusion"),
            Command::Shadows => self.toggle_shadows(stage),
            Command::ToneMapping => self.toggle_flag(stage, "tone-mapping"),
            Command::EnvironmentLight => self.toggle_environment(stage),
            Command::EnvironmentBackground => self.toggle_skybox(stage),
            Command::Spheres => self.change_by_key(stage, Step::Cycle("point-sprites".to_owned())),
            Command::MoreOpaque => self.change_by_key(stage, Step::Increase("opacity".to_owned(), true)),
            Command::LessOpaque => self.change_by_key(stage, Step::Increase("opacity".to_owned(), false)),
            Command::Bones => self.toggle_flag(stage, "armature"),
            Command::Normals => self.toggle_flag(stage, "normal-glyphs"),
            Command::Notifications => self.toggle_flag(stage, "notifications"),
            Command::Tree => self.side.toggle(stage, Content::Tree),
            Command::Pixel => self.side.toggle(stage, Content::Pixel),
            Command::Effects => self.side.toggle(stage, Content::Effects),
            Command::StageTimes => stage.stage_times = stage.stage_times.toggled(),
            Command::Axes => self.request.overlay.shows_axes ^= true,
            Command::Grid => self.toggle_grid(stage),
            Command::Displays => self.side.toggle(stage, Content::Displays),
            Command::NextDisplay => self.step_display(stage, 1),
            Command::PreviousDisplay => self.step_display(stage, Display::ALL.len() - 1),
            Command::Matcap => self.toggle_display(stage, Display::Matcap),
            Command::Measure => self.measuring.toggle(),
            Command::Copy => self.copy_command(stage),
            Command::SaveState => self.save_state(stage),
            Command::LoadState => self.load_state(stage),
            Command::Blink => self.compare(stage, Comparing::blink),
            Command::Heat => self.compare(stage, Comparing::toggle_heat),
            Command::Depth => self.toggle_display(stage, Display::Depth),
        }
    }
}
