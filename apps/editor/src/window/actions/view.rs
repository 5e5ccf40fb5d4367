//! The menu View.

use trigon_window::scene::camera::AxisView;

use super::{Action, Does::*, Needs, actions};
use crate::request::{DisplayMode, UiRequest, ViewRequest};

actions! {
    "View" "view.frame_selected" "Frame Selected" "Numpad." Nothing View(ViewRequest::FrameSelected) => "Frames the selection.";
    "View" "view.frame_all" "Frame All" "Home" Nothing View(ViewRequest::FrameAll) => "Frames the whole scene.";
    "View" "view.local" "Local View" "Numpad/ /" ObjectMode View(ViewRequest::ToggleLocal) => "Shows only the selection, or everything again.";
    "View" "view.orthographic" "Perspective/Orthographic" "Numpad5" Nothing View(ViewRequest::ToggleOrthographic) => "Switches between perspective and orthographic projection.";
    "View" "view.four" "Four Views" "Ctrl+Alt+Q" Nothing View(ViewRequest::ToggleFourViews) => "Switches between one view and four: top, front, right and the current one.";
    "View" "view.camera" "Camera" "Numpad0" Nothing View(ViewRequest::Camera) => "Looks through the scene's camera.";
    "View" "view.camera_to_view" "Camera to View" "Ctrl+Alt+Numpad0" ObjectMode View(ViewRequest::CameraToView) => "Moves the active camera, or else the scene's first, to the current view.";
    "View/Viewpoint" "viewpoint.menu" "View Menu" "` ~ Shift+`" Nothing Ui(UiRequest::Popup("View/Viewpoint")) => "Chooses a side to look from.";
    "View/Viewpoint" "view.front" "Front" "Numpad1" Nothing View(ViewRequest::Axis(AxisView::Front)) => "Looks from the front.";
    "View/Viewpoint" "view.back" "Back" "Ctrl+Numpad1" Nothing View(ViewRequest::Axis(AxisView::Back)) => "Looks from behind.";
    "View/Viewpoint" "view.right" "Right" "Numpad3" Nothing View(ViewRequest::Axis(AxisView::Right)) => "Looks from the right.";
    "View/Viewpoint" "view.left" "Left" "Ctrl+Numpad3" Nothing View(ViewRequest::Axis(AxisView::Left)) => "Looks from the left.";
    "View/Viewpoint" "view.top" "Top" "Numpad7" Nothing View(ViewRequest::Axis(AxisView::Top)) => "Looks from above.";
    "View/Viewpoint" "view.bottom" "Bottom" "Ctrl+Numpad7" Nothing View(ViewRequest::Axis(AxisView::Bottom)) => "Looks from below.";
    "View/Viewpoint" "view.opposite" "Opposite" "Numpad9" Nothing View(ViewRequest::Opposite) => "Looks from the opposite side.";
    "View/Navigation" "view.orbit_left" "Orbit Left" "Numpad4" Nothing View(ViewRequest::Orbit(-15.0, 0.0)) => "Orbits the scene by 15 degrees.";
    "View/Navigation" "view.orbit_right" "Orbit Right" "Numpad6" Nothing View(ViewRequest::Orbit(15.0, 0.0)) => "Orbits the scene by 15 degrees.";
    "View/Navigation" "view.orbit_up" "Orbit Up" "Numpad8" Nothing View(ViewRequest::Orbit(0.0, 15.0)) => "Orbits up by 15 degrees.";
    "View/Navigation" "view.orbit_down" "Orbit Down" "Numpad2" Nothing View(ViewRequest::Orbit(0.0, -15.0)) => "Orbits down by 15 degrees.";
    "View/Navigation" "view.pan_left" "Pan Left" "Ctrl+Numpad4" Nothing View(ViewRequest::Pan(-0.1, 0.0)) => "Moves the view to the left.";
    "View/Navigation" "view.pan_right" "Pan Right" "Ctrl+Numpad6" Nothing View(ViewRequest::Pan(0.1, 0.0)) => "Moves the view to the right.";
    "View/Navigation" "view.pan_up" "Pan Up" "Ctrl+Numpad8" Nothing View(ViewRequest::Pan(0.0, 0.1)) => "Moves the view up.";
    "View/Navigation" "view.pan_down" "Pan Down" "Ctrl+Numpad2" Nothing View(ViewRequest::Pan(0.0, -0.1)) => "Moves the view down.";
    "View/Navigation" "view.roll_left" "Roll Left" "Shift+Numpad4" Nothing View(ViewRequest::Roll(15.0)) => "Rolls the view by 15 degrees.";
    "View/Navigation" "view.roll_right" "Roll Right" "Shift+Numpad6" Nothing View(ViewRequest::Roll(-15.0)) => "Rolls the view by 15 degrees.";
    "View/Navigation" "view.zoom_in" "Zoom In" "Numpad+" Nothing View(ViewRequest::Zoom(1.2)) => "Goes closer.";
    "View/Navigation" "view.zoom_out" "Zoom Out" "Numpad-" Nothing View(ViewRequest::Zoom(1.0 / 1.2)) => "Goes away.";
    "View/Display" "display.menu" "Display Menu" "Z" Nothing Ui(UiRequest::Popup("View/Display")) => "Chooses the display mode.";
    "View/Display" "display.wireframe" "Wireframe" "" Nothing View(ViewRequest::Display(DisplayMode::Wireframe)) => "Shows edges only.";
    "View/Display" "display.solid" "Solid" "" Nothing View(ViewRequest::Display(DisplayMode::Solid)) => "Shows surfaces in plain shading.";
    "View/Display" "display.matcap" "Matcap" "" Nothing View(ViewRequest::Display(DisplayMode::Matcap)) => "Shows all surfaces as clay, shaded by their direction only.";
    "View/Display" "display.textured" "Textured" "" Nothing View(ViewRequest::Display(DisplayMode::Textured)) => "Shows materials in studio lighting.";
    "View/Display" "display.rendered" "Rendered" "" Nothing View(ViewRequest::Display(DisplayMode::Rendered)) => "Shows the scene with its own lights.";
    "View/Display" "display.toggle_wireframe" "Toggle Wireframe" "Shift+Z" Nothing View(ViewRequest::ToggleWireframe) => "Switches between wireframe and the previous mode.";
    "View" "view.x_ray" "X-Ray" "Alt+Z" Nothing View(ViewRequest::ToggleXRay) => "Shows and selects elements behind faces, too.";
    "View" "view.overlays" "Overlays" "Alt+Shift+Z" Nothing View(ViewRequest::ToggleOverlays) => "Shows or hides grid, axes, lights, cameras and the gizmo.";
    "View" "view.tool_bar" "Tool Bar" "T" Nothing Ui(UiRequest::ToolBar) => "Shows or hides the tools on the left.";
    "View" "view.side_bar" "Side Bar" "N" Nothing Ui(UiRequest::SideBar) => "Shows or hides the panels on the right.";
    "View/Input" "input.mouse" "Emulate Three-Button Mouse" "" Nothing Ui(UiRequest::EmulateMouse) => "Alt+left drag orbits, with Shift it pans, with Ctrl it zooms.";
    "View/Input" "input.numpad" "Emulate Numpad" "" Nothing Ui(UiRequest::EmulateNumpad) => "The digit row acts as the number pad.";
    "View/Text" "view.larger_text" "Larger Text" "Ctrl+=" Nothing Ui(UiRequest::LargerText) => "Makes text and buttons larger.";
    "View/Text" "view.smaller_text" "Smaller Text" "Ctrl+-" Nothing Ui(UiRequest::SmallerText) => "Makes text and buttons smaller.";
}
