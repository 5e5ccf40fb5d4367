//! V and Alt+V: the mesh opens on the pointer's side of the selection, and that side follows the pointer.

use trigon_document::mesh::math::DVec2;
use trigon_document::{Rip, TransformSpace};
use trigon_window::Stage;

use super::editor::Editor;
use super::panes::{pane_of, tool_view};
use crate::request::ToolKind;
use crate::tool::Selected;

impl Editor {
    /// Rips, and moves what came loose.
    pub(super) fn rip(&mut self, stage: &mut Stage, fill: bool) {
        let Some(selected) = Selected::of(&self.document) else { return };
        let pane = self.pointer.map_or_else(|| pane_of(stage, None), |at| stage.pane_at(at));
        let (view, middle) = (tool_view(stage, &pane), selected.median());
        let to_pointer = self.pointer.zip(view.screen(middle));
        let way = to_pointer.map_or(DVec2::X, |(at, from)| at - pane.area.origin() - from);
        let direction = view.dragged(middle, way).to_array();
        let before = self.entries();
        self.run(Rip { direction, space: TransformSpace::World, fill }.into());
        if self.entries() > before {
            self.start_tool(stage, ToolKind::Move);
        }
    }
}
