//! An active tool or gesture: its status line and drawing, and which inputs remain the camera's meanwhile.

use trigon_document::mesh::math::DVec2;
use trigon_document::scene::Region;
use trigon_document::scene::camera::AxisView;
use trigon_window::{Hands, Input, Modifiers, Pane, PointerButton};

use super::button_start::ButtonStart;
use super::button_start::Click;
use crate::request::ToolKind;
use crate::tool::{FaceTool, Gesture, GestureKind, Tool, ToolMarks, TransformKind};

/// A tool or a gesture that runs.
pub(crate) struct Running {
    pub(crate) kind: ToolKind,
    pub(super) what: What,
    /// Where a press of the left button started it.
    pub(super) pressed: Option<Click>,
    /// Whether the camera has taken the pointer: where that comes back is no movement.
    pub(super) is_navigating: bool,
    /// Of the view that it was started in, in whose pixels it counts.
    pub(super) side: Option<AxisView>,
    /// How far it is, if a button or a menu started it.
    pub(super) start: ButtonStart,
}

/// What runs.
pub(super) enum What {
    Tool(Box<dyn Tool>),
    /// It gets the face under the pointer, too.
    OnFaces(Box<dyn FaceTool>),
    Gesture(Gesture),
}

impl Running {
    pub(super) fn new(kind: ToolKind, what: What, pane: &Pane) -> Self {
        Self { kind, what, pressed: None, is_navigating: false, side: pane.side, start: ButtonStart::Over }
    }

    /// The side that is seen in the view that it was started in; `None` for the camera's own.
    pub(crate) fn side(&self) -> Option<AxisView> {
        self.side
    }

    /// A key started it: the pointer counts from where it is.
    pub(super) fn follow_at_once(&mut self) {
        self.start = ButtonStart::Over;
    }

    /// Keys and numbers for the status line.
    pub(crate) fn status(&self) -> String {
        match &self.what {
            What::Tool(tool) => self.start.hint().to_owned() + &tool.status(),
            What::OnFaces(tool) => tool.status(),
            What::Gesture(gesture) => gesture.status().into(),
        }
    }

    /// What it draws in the world.
    pub(crate) fn marks(&self) -> ToolMarks {
        match &self.what {
            What::Tool(tool) => tool.marks(),
            What::OnFaces(tool) => tool.marks(),
            What::Gesture(_) => ToolMarks::default(),
        }
    }

    /// The region that a gesture draws, in physical pixels; `None` where there is none.
    pub(crate) fn region(&self) -> Option<Region> {
        match &self.what {
            What::Gesture(gesture) => gesture.shown(),
            What::Tool(_) | What::OnFaces(_) => None,
        }
    }

    /// Whether an input turns or zooms the view in the middle of the tool.
    pub(super) fn leaves_to_camera(&self, input: &Input, hands: Hands) -> bool {
        use ToolKind::{
            Bevel, BevelVertices, Extrude, ExtrudeIndividual, Inset, Knife, LoopCut, Measure, SelectCircle,
        };
        match input {
            Input::Pressed(PointerButton::Left) => hands.modifiers.contains(Modifiers::ALT),
            Input::Pressed(PointerButton::Middle) => {
                let has_no_use = matches!(
                    self.kind,
                    Extrude | ExtrudeIndividual | Inset | Bevel | BevelVertices | LoopCut | Knife | Measure
                );
                has_no_use || hands.modifiers.contains(Modifiers::ALT)
            }
            Input::Wheel(_) => {
                let takes = matches!(self.kind, Bevel | BevelVertices | LoopCut | SelectCircle);
                !takes && self.marks().circle.is_none()
            }
            Input::Pinch(_) => true,
            _ => false,
        }
    }

    /// Whether it follows how far the pointer goes, and not where it is in the image.
    pub(crate) fn goes_on_beyond_borders(&self) -> bool {
        matches!(self.what, What::Tool(_)) && !matches!(self.start, ButtonStart::Waits)
    }

    /// The pointer was put somewhere else in its view: that was no movement.
    pub(crate) fn pointer_jumped(&mut self, to: DVec2) {
        match &mut self.what {
            What::Tool(tool) => tool.pointer_jumped(to),
            What::OnFaces(tool) => tool.pointer_jumped(to),
            What::Gesture(_) => {}
        }
    }
}

/// What a transform is for the tool that does all of them.
pub(super) fn transform_kind(tool: ToolKind) -> Option<TransformKind> {
    Some(match tool {
        ToolKind::Move | ToolKind::EdgeSlide => TransformKind::Translate,
        ToolKind::Rotate => TransformKind::Rotate,
        ToolKind::Scale => TransformKind::Scale,
        ToolKind::ShrinkFatten => TransformKind::ShrinkFatten,
        ToolKind::PushPull => TransformKind::PushPull,
        ToolKind::ToSphere => TransformKind::ToSphere,
        _ => return None,
    })
}

/// Which gesture selects so.
pub(super) fn gesture_kind(tool: ToolKind) -> Option<GestureKind> {
    Some(match tool {
        ToolKind::SelectBox => GestureKind::Box,
        ToolKind::SelectCircle => GestureKind::Circle,
        ToolKind::SelectLasso => GestureKind::Lasso,
        _ => return None,
    })
}
