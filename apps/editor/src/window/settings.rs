//! Settings of the window and its tools, independent of the document. Here is also what the stage shows of a
//! document.

use std::collections::BTreeSet;
use std::time::Duration;

use trigon_document::scene::{NodeId, Reach};
use trigon_document::{DisplayMarks, Proportional};
use trigon_window::scene::camera::{Camera, Orbit, Viewport};
use trigon_window::scene::math::{DQuat, DVec3};
use trigon_window::{
    Action, DragAction, DragBinding, Key, Keymap, Modifiers, PointerButton, Refinement, Stage,
};

use super::surfaces::Surfaces;
use crate::request::{DisplayMode, GizmoKind, Orientation, Pivot, SnapSource, SnapTarget, SolidColor};
use crate::tool::{SnapSettings, TransformSettings};

/// How tools work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ToolSettings {
    pub(crate) snapping: bool,
    pub(crate) snap_target: SnapTarget,
    pub(crate) snap_source: SnapSource,
    pub(crate) proportional: bool,
    pub(crate) pivot: Pivot,
    pub(crate) orientation: Orientation,
    /// The gizmo on what is selected, if there is to be one.
    pub(crate) gizmo: Option<GizmoKind>,
    /// Where the 3D cursor is, in metres in the world.
    pub(crate) cursor: DVec3,
}

impl Default for ToolSettings {
    fn default() -> Self {
        Self {
            snapping: false,
            snap_target: SnapTarget::default(),
            snap_source: SnapSource::default(),
            proportional: false,
            pivot: Pivot::default(),
            orientation: Orientation::default(),
            // Who does not know the keys has to see that things can be moved.
            gizmo: Some(GizmoKind::Move),
            cursor: DVec3::ZERO,
        }
    }
}

impl ToolSettings {
    /// How tools snap; `reach` tells whether they do to what faces hide.
    pub(crate) fn snap(&self, reach: Reach) -> SnapSettings {
        let (target, source, through) = (self.snap_target, self.snap_source, reach == Reach::Through);
        SnapSettings { is_on: self.snapping, target, source, through, ..SnapSettings::default() }
    }

    pub(crate) fn transform(&self, reach: Reach) -> TransformSettings {
        TransformSettings {
            orientation: self.orientation,
            pivot: self.pivot,
            snap: self.snap(reach),
            cursor: self.cursor,
            proportional: self.proportional.then(Proportional::default),
        }
    }
}

/// The view of the document.
#[derive(Debug, Clone)]
pub(crate) struct ViewState {
    pub(crate) display: DisplayMode,
    /// What was shown before the wireframe.
    pub(crate) before_wireframe: DisplayMode,
    pub(crate) solid: SolidColor,
    pub(crate) x_ray: bool,
    /// The only objects that are shown.
    pub(crate) local: Option<BTreeSet<NodeId>>,
    /// The view before that.
    pub(crate) before_local: Option<Orbit>,
    /// While a side is looked at in parallel projection for that alone: the direction that it was set to.
    pub(crate) side: Option<DQuat>,
    /// While the view looks through the scene's camera.
    pub(crate) camera: Option<ThroughCamera>,
    /// Whether what lies over the image is drawn: grid, axes, lights, cameras, the gizmo.
    pub(crate) overlays: bool,
}

impl Default for ViewState {
    fn default() -> Self {
        let (display, before_wireframe) = (DisplayMode::default(), DisplayMode::default());
        Self {
            display,
            before_wireframe,
            solid: SolidColor::default(),
            x_ray: false,
            local: None,
            before_local: None,
            side: None,
            camera: None,
            overlays: true,
        }
    }
}

/// A view through the scene's camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ThroughCamera {
    /// The view that it replaced.
    pub(crate) before: Orbit,
    /// What it was set to; another view has left the camera.
    pub(crate) set: Orbit,
    /// The camera as it was then.
    pub(crate) camera: Camera,
}

/// Which parts of the window are shown.
#[derive(Debug)]
pub(crate) struct Layout {
    pub(crate) tool_bar: bool,
    pub(crate) side_bar: bool,
    pub(crate) adjust: bool,
    pub(crate) help: bool,
}

impl Default for Layout {
    fn default() -> Self {
        Self { tool_bar: true, side_bar: true, adjust: true, help: false }
    }
}

/// Prepares a stage for the editor: its size, quality, and Blender's drags.
pub(crate) fn prepare(stage: &mut Stage) {
    // What is modelled is looked at closely: a few images fewer a second are better than coarse ones.
    stage.frame_budget = Duration::from_millis(50);
    stage.set_size(Viewport { width: 1440, height: 900 });
    stage.refinement = Refinement::Settings;
    (stage.settings.samples_per_axis, stage.settings.samples) = (2, 1);
    stage.keymap = drags(true);
}

/// The camera's drags, and the way to the panels without a mouse: all that the editor uses of the window's own
/// keymap.
pub(crate) fn drags(emulates_mouse: bool) -> Keymap {
    let none = Modifiers::NONE;
    let kinds = [
        (none, DragAction::Orbit, "orbit"),
        (Modifiers::SHIFT, DragAction::Pan, "pan"),
        (Modifiers::CTRL, DragAction::Zoom, "zoom"),
        (Modifiers::CTRL | Modifiers::SHIFT, DragAction::Zoom, "zoom"),
    ];
    let mut keymap = Keymap::empty();
    let description = "focus the interface (Escape: leave it)";
    keymap.bind(Key::Function(6), "interface", Action::EnterInterface, description);
    let emulated = emulates_mouse.then_some((PointerButton::Left, Modifiers::ALT));
    for (button, base) in [(PointerButton::Middle, none)].into_iter().chain(emulated) {
        for (modifiers, action, description) in kinds {
            let modifiers = base | modifiers;
            keymap.bind_drag(DragBinding { button, modifiers, action, description: description.into() });
        }
    }
    keymap
}

/// What the stage shows, as far as the document does not tell.
#[derive(Debug, Default)]
pub(crate) struct Look {
    pub(super) marks: DisplayMarks,
    /// The only objects that the stage shows.
    pub(super) local: Option<BTreeSet<NodeId>>,
    pub(super) surfaces: Surfaces,
}
