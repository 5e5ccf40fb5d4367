//! The modal tool: how it is started, its input, and its result.

use trigon_document::scene::camera::AxisView;
use trigon_document::scene::{Reach, Region};
use trigon_document::{ElementKind, SelectAction, Shear};
use trigon_window::{Hands, Input, InputOwner, Key, Modifiers, Pane, PointerButton, Stage, Taken};

use super::button_start::Click;
use super::button_start::{ButtonStart, Passed};
use super::editor::{Editor, Message};
use super::panes::{in_pane, pane_of};
use super::pointing::Prefetch;
use super::running::{Running, What, gesture_kind, transform_kind};
use crate::request::{Request, ToolKind};
use crate::tool::{
    BevelTool, ExtrudeTool, FaceTool, Freedom, Gesture, GestureKind, GestureState, InsetTool, KnifeTool,
    LoopCutTool, MeasureTool, RegionMode, Tool, ToolState, TransformKind, TransformTool,
};

impl Editor {
    /// Starts a tool at the pointer, or says why it cannot.
    pub(crate) fn start_tool(&mut self, stage: &mut Stage, kind: ToolKind) {
        let hands = Hands { pointer: self.pointer, modifiers: Modifiers::NONE };
        if kind == ToolKind::Shear {
            // It has nothing that follows the pointer; its values can be adjusted.
            return self.run(Shear::default().into());
        }
        let pane = hands.pointer.map_or_else(|| pane_of(stage, None), |at| stage.pane_at(at));
        if let Some(tool) = self.uv_tool(stage, &pane, kind, hands) {
            return self.follow(stage, Running::new(kind, What::Tool(tool), &pane));
        }
        match self.started(stage, &pane, kind, in_pane(hands, &pane)) {
            Some(what) => {
                let waits = matches!(what, What::Tool(_));
                let start =
                    if waits { ButtonStart::of(self.is_in_view(stage, hands)) } else { ButtonStart::Over };
                self.follow(stage, Running { start, ..Running::new(kind, what, &pane) });
            }
            None => self.message = Message::Refusal(format!("{kind:?}: select something first")),
        }
    }

    fn started(&mut self, stage: &Stage, pane: &Pane, kind: ToolKind, hands: Hands) -> Option<What> {
        let (view, reach) = (self.tool_view(stage, pane), self.reach());
        let document = &mut self.document;
        if let Some(gesture) = gesture_kind(kind) {
            return Some(What::Gesture(Gesture::waiting(gesture, hands, stage.scale())));
        }
        if let Some(transform) = transform_kind(kind) {
            let settings = self.tools.transform(reach);
            let tool = TransformTool::start(transform, settings, document, hands, &view)?;
            let slides = kind == ToolKind::EdgeSlide;
            let tool = if slides { tool.sliding(document, &view) } else { tool };
            return Some(What::Tool(Box::new(tool)));
        }
        let snap = self.tools.snap(reach);
        let tool: Box<dyn Tool> = match kind {
            ToolKind::Extrude => Box::new(ExtrudeTool::start(false, snap, document, hands, &view)?),
            ToolKind::ExtrudeIndividual => Box::new(ExtrudeTool::start(true, snap, document, hands, &view)?),
            ToolKind::Inset => Box::new(InsetTool::start(document, hands, &view)?),
            ToolKind::Bevel => Box::new(BevelTool::start(false, document, hands, &view)?),
            ToolKind::BevelVertices => Box::new(BevelTool::start(true, document, hands, &view)?),
            kind => {
                let mut tool: Box<dyn FaceTool> = match kind {
                    ToolKind::Knife => Box::new(KnifeTool::start(document, hands)?),
                    ToolKind::Measure => Box::new(MeasureTool::start(document, snap.through, hands)),
                    _ => Box::new(LoopCutTool::start(document, hands)?),
                };
                let reach = tool.reach() * view.scale;
                let face =
                    hands.pointer.and_then(|at| self.pointing.face_near(document, stage, pane, at, reach));
                tool.hover(document, &view, face);
                return Some(What::OnFaces(tool));
            }
        };
        Some(What::Tool(tool))
    }

    fn follow(&mut self, stage: &mut Stage, running: Running) {
        self.click = None;
        if let What::Gesture(_) = &running.what {
            self.prefetch_region(stage, running.side);
        }
        self.tool = Some(running);
        stage.input_owner = InputOwner::Application;
    }

    /// Starts to move, turn or scale by a handle of the gizmo that is held.
    pub(crate) fn start_held(
        &mut self,
        stage: &mut Stage,
        kind: ToolKind,
        freedom: Option<Freedom>,
        press: Click,
    ) {
        let pane = stage.pane_at(press.at);
        let hands = in_pane(Hands { pointer: Some(press.at), modifiers: press.modifiers }, &pane);
        let (view, settings) = (self.tool_view(stage, &pane), self.tools.transform(self.reach()));
        let tool = transform_kind(kind)
            .and_then(|transform| TransformTool::start(transform, settings, &self.document, hands, &view));
        if let Some(tool) = tool {
            let what = What::Tool(Box::new(tool.held(freedom)));
            self.follow(stage, Running { pressed: Some(press), ..Running::new(kind, what, &pane) });
        }
    }

    /// A press became a drag: it selects within a box, with Ctrl within a lasso.
    pub(crate) fn drag_region(&mut self, stage: &mut Stage, press: Click, hands: Hands) {
        let is_lasso = press.modifiers.contains(Modifiers::CTRL);
        let (tool, gesture) = match is_lasso {
            true => (ToolKind::SelectLasso, GestureKind::Lasso),
            false => (ToolKind::SelectBox, GestureKind::Box),
        };
        let pane = stage.pane_at(press.at);
        let start = in_pane(Hands { pointer: Some(press.at), modifiers: press.modifiers }, &pane);
        let gesture = Gesture::drawing(gesture, PointerButton::Left, start, stage.scale());
        self.follow(stage, Running::new(tool, What::Gesture(gesture), &pane));
        self.tool_input(stage, &Input::PointerMoved, hands);
    }

    /// Gives an input to the tool.
    pub(crate) fn tool_input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        let Some(mut running) = self.tool.take() else { return Taken::No };
        let pane = pane_of(stage, running.side);
        let (in_window, hands) = (hands, in_pane(hands, &pane));
        if running.leaves_to_camera(input, hands) {
            running.is_navigating = true;
            self.tool = Some(running);
            return Taken::No;
        }
        if std::mem::take(&mut running.is_navigating)
            && let Some(to) = hands.pointer
        {
            running.pointer_jumped(to);
        }
        let confirm = Input::Pressed(PointerButton::Left);
        let input =
            match running.start.pass(self.is_in_view(stage, in_window), stage.scale(), input, in_window) {
                Passed::On => input,
                Passed::Confirms => &confirm,
                Passed::Cancels => &Input::Pressed(PointerButton::Right),
                passed => {
                    if let Passed::Begins(at) = passed {
                        let pane = stage.pane_at(at);
                        running.side = pane.side;
                        running.pointer_jumped(at - pane.area.origin());
                    }
                    self.tool = Some(running);
                    return Taken::Yes;
                }
            };
        let view = self.tool_view(stage, &pane);
        let before = self.entries();
        let state = match &mut running.what {
            What::Tool(tool) => tool.input(input, hands, &view, &mut self.document),
            What::OnFaces(tool) => {
                let state = tool.input(input, hands, &view, &mut self.document);
                if tool.wants_face() {
                    let reach = tool.reach() * view.scale;
                    let (document, pointing) = (&self.document, &mut self.pointing);
                    let aim = tool.aim(document, &view).or(hands.pointer);
                    let face = aim.and_then(|at| pointing.face_near(document, stage, &pane, at, reach));
                    tool.hover(document, &view, face);
                }
                state
            }
            What::Gesture(gesture) => {
                let state = gesture.input(input, hands);
                return self.gesture_did(stage, running, state);
            }
        };
        match state {
            ToolState::Running => self.tool = Some(running),
            ToolState::Confirmed | ToolState::Cancelled => self.tool_ended(stage, &running, before),
            ToolState::ConfirmedThen(next) => {
                self.tool_ended(stage, &running, before);
                let is_turn = next == TransformKind::Rotate;
                self.start_tool(stage, if is_turn { ToolKind::Rotate } else { ToolKind::Scale });
            }
        }
        self.show(stage);
        Taken::Yes
    }

    /// How many entries the history ever had.
    pub(crate) fn entries(&self) -> usize {
        self.document.history().done().len() + self.document.history().dropped()
    }

    fn tool_ended(&mut self, stage: &mut Stage, running: &Running, before: usize) {
        stage.input_owner = InputOwner::Interface;
        if self.entries() > before {
            let last = self.document.history().done().last().map(|entry| entry.command().name());
            self.file.ran(false);
            self.done(last.unwrap_or_default(), "");
        } else if let Some(Click { at, modifiers }) = running.pressed {
            // A handle that was pressed and not dragged hides what it lies on no longer.
            super::pick::click(self, stage, at, modifiers);
        } else {
            self.message = Message::Hint(String::new());
        }
    }

    fn gesture_did(&mut self, stage: &mut Stage, running: Running, state: GestureState) -> Taken {
        let side = running.side;
        let (region, goes_on) = match state {
            GestureState::Running => (None, true),
            GestureState::Selects(region, mode) => (Some((region, mode)), true),
            GestureState::Ended(region) => (region, false),
        };
        if goes_on {
            self.tool = Some(running);
            self.prefetch_region(stage, side);
        } else {
            stage.input_owner = InputOwner::Interface;
        }
        if let Some((region, mode)) = region {
            self.select_region(stage, side, &region, mode);
        }
        Taken::Yes
    }

    /// Prefetches what a selection within a region will ask for.
    fn prefetch_region(&mut self, stage: &Stage, side: Option<AxisView>) {
        let selection = self.document.selection();
        let finds_vertices = selection.is_editing()
            && selection.kinds().contains(ElementKind::Vertex)
            && self.reach() == Reach::Visible;
        let what = if finds_vertices { Prefetch::VisibleVertices } else { Prefetch::Ids };
        self.pointing.prefetch(stage, &pane_of(stage, side), what);
    }

    fn select_region(
        &mut self,
        stage: &mut Stage,
        side: Option<AxisView>,
        region: &Region,
        mode: RegionMode,
    ) {
        let action = match mode {
            RegionMode::Set => SelectAction::Replace,
            RegionMode::Extend => SelectAction::Add,
            RegionMode::Subtract => SelectAction::Remove,
            RegionMode::Intersect => SelectAction::Intersect,
        };
        let (reach, pane) = (self.reach(), pane_of(stage, side));
        let requested =
            self.pointing.ask(&self.document, stage, &pane, reach, |picks| picks.region(region, action));
        let command = requested.flatten();
        if let Some(command) = command {
            self.perform(stage, Request::Run(command));
        }
    }

    /// Ends the tool that runs, if there is one: the document is as it was before.
    pub(crate) fn cancel_tool(&mut self, stage: &mut Stage) {
        let escape = Input::Key { logical: Some(Key::Escape), physical: None, repeat: false };
        let hands = Hands { pointer: self.pointer, modifiers: Modifiers::NONE };
        self.tool_input(stage, &escape, hands);
    }
}
