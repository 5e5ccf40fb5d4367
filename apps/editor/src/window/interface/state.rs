//! Which entries of menus are switches, and which of them are on.

use trigon_window::Stage;

use crate::request::{UiRequest, ViewRequest};
use crate::window::actions::{Action, Does};
use crate::window::editor::Editor;

/// Whether what an action switches or chooses is on; `None` for actions that do something else.
pub(super) fn state_of(action: &Action, editor: &Editor, stage: &Stage) -> Option<bool> {
    match action.does {
        Does::View(view) => state_of_view(view, editor, stage),
        Does::Ui(ui) => state_of_window(ui, editor, stage),
        _ => None,
    }
}

fn state_of_view(request: ViewRequest, editor: &Editor, stage: &Stage) -> Option<bool> {
    let view = &editor.view;
    Some(match request {
        ViewRequest::ToggleOrthographic => stage.orbit.is_orthographic(),
        ViewRequest::ToggleFourViews => stage.four_views,
        ViewRequest::ToggleLocal => view.local.is_some(),
        ViewRequest::Camera => view.camera.is_some(),
        ViewRequest::Display(mode) => view.display == mode,
        ViewRequest::Solid(color) => view.solid == color,
        ViewRequest::ToggleXRay => view.x_ray,
        ViewRequest::ToggleOverlays => view.overlays,
        _ => return None,
    })
}

fn state_of_window(request: UiRequest, editor: &Editor, stage: &Stage) -> Option<bool> {
    let (tools, layout) = (&editor.tools, &editor.layout);
    Some(match request {
        UiRequest::ToolBar => layout.tool_bar,
        UiRequest::SideBar => layout.side_bar,
        UiRequest::UvView => editor.uv.is_open,
        UiRequest::AdjustPanel => layout.adjust,
        UiRequest::Development => editor.preferences.get().development,
        UiRequest::EmulateMouse => editor.preferences.get().emulates_mouse,
        UiRequest::EmulateNumpad => editor.preferences.get().emulates_numpad,
        UiRequest::Snapping => tools.snapping,
        UiRequest::Snap(target) => tools.snap_target == target,
        UiRequest::SnapWith(source) => tools.snap_source == source,
        UiRequest::Proportional => tools.proportional,
        UiRequest::Pivot(pivot) => tools.pivot == pivot,
        UiRequest::Orientation(orientation) => tools.orientation == orientation,
        UiRequest::Gizmo(gizmo) => tools.gizmo == gizmo,
        UiRequest::Theme(theme) => stage.theme == theme,
        UiRequest::Up(up) => editor.up() == up,
        _ => return None,
    })
}
