//! The panel at the right of the image: the scene as a tree, a pixel explained, or the effect plan. One of
//! them stands there at a time, so that none covers another.

mod command;
mod effects;
mod pixel;
mod tree;

use trigon_math::DVec2;
use trigon_scene::{Display, NodeId};
use trigon_window::{Hands, Input, Key, PointerButton, Stage, Taken, egui};

use command::CommandPanel;
use effects::EffectPanel;
use pixel::PixelPanel;
use tree::TreePanel;

/// Its usual width and its least one, in points.
const WIDTH: f32 = 270.0;
const LEAST_WIDTH: f32 = 180.0;

/// What stands in the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// The nodes of the scene.
    Tree,
    /// Why a pixel looks as it does.
    Pixel,
    /// Which effects there are, and why.
    Effects,
    /// What faces can show.
    Displays,
    /// The command line that draws the image.
    Command,
}

impl Content {
    fn title(self) -> &'static str {
        match self {
            Self::Tree => "Scene",
            Self::Pixel => "Pixel",
            Self::Effects => "Effects",
            Self::Displays => "Faces show",
            Self::Command => "Command line",
        }
    }
}

/// The panel at the right.
#[derive(Default)]
pub(super) struct SidePanel {
    shown: Option<Content>,
    tree: TreePanel,
    pixel: PixelPanel,
    effects: EffectPanel,
    command: CommandPanel,
    /// Where the pointer was last, in physical pixels.
    pointer: Option<DVec2>,
}

impl SidePanel {
    /// Shows the tree of the scene when the window opens.
    pub(super) fn with_tree() -> Self {
        Self { shown: Some(Content::Tree), ..Self::default() }
    }

    /// Shows this.
    pub(super) fn open(&mut self, content: Content) {
        self.shown = Some(content);
    }

    /// Copies a command line to the clipboard in the next pass, and keeps it to be read.
    pub(super) fn show_command(&mut self, command: String, differs: Option<&'static str>) {
        self.command = CommandPanel::new(command, differs);
    }

    /// Another model is shown.
    pub(super) fn forget(&mut self) {
        self.pixel.forget();
    }

    /// Shows this, or nothing if it is shown. A pixel that is to be explained is that at the pointer.
    pub(super) fn toggle(&mut self, stage: &Stage, content: Content) {
        self.shown = (self.shown != Some(content)).then_some(content);
        if self.shown == Some(Content::Pixel) {
            self.pixel.explain(stage, self.pointer);
        }
    }

    /// While pixels are explained, a click chooses one. Escape closes the panel.
    pub(super) fn input(&mut self, stage: &Stage, input: &Input, hands: Hands) -> Taken {
        self.pointer = hands.pointer.or(self.pointer);
        match (self.shown, input) {
            (Some(_), Input::Key { logical: Some(Key::Escape), .. }) => self.shown = None,
            (Some(Content::Pixel), Input::Clicked(PointerButton::Left)) => {
                self.pixel.explain(stage, hands.pointer);
            }
            _ => return Taken::No,
        }
        Taken::Yes
    }

    /// Shows it, if it is to be seen. Nodes that are beside the model are not in the tree.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, stage: &mut Stage, beside: &[NodeId]) {
        let Some(content) = self.shown else { return };
        let most = (ui.available_width() * 0.5).max(1.0);
        let panel = egui::Panel::right("side").default_size(WIDTH.min(most));
        let panel = panel.min_size(LEAST_WIDTH.min(most)).max_size(most);
        panel.show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.heading(content.title());
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button("Close").on_hover_text("Escape").clicked() {
                        self.shown = None;
                    }
                });
            });
            ui.separator();
            match content {
                Content::Tree => self.tree.show(ui, stage, beside),
                Content::Pixel => self.pixel.show(ui, stage),
                Content::Effects => self.effects.show(ui, stage),
                Content::Displays => displays(ui, stage),
                Content::Command => self.command.show(ui),
            }
        });
    }
}

/// A line for each thing that faces can show.
fn displays(ui: &mut egui::Ui, stage: &mut Stage) {
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for display in Display::ALL {
            ui.selectable_value(&mut stage.settings.display, display, display.name());
        }
    });
}
