//! Keys over the UV view: what they move, select and frame there.

use trigon_document::SelectAction;
use trigon_window::scene::math::DVec2;
use trigon_window::{Chord, Hands, Key, Modifiers, Pane, Stage};

use super::actions;
use super::actions::Action;
use super::editor::{Editor, Message};
use super::panes::{in_pane, point, points};
use crate::request::{ToolKind, ViewRequest};
use crate::tool::{Tool, UvPixels, UvTool, UvTransform};
use crate::uv;
use crate::uv::UvCanvas;

/// Keys that mean something else over the UV view, as in Blender.
const KEYS: [(Chord, &str); 3] = [
    (Chord::new(Modifiers::NONE, Key::Character('p')), "uv.pin"),
    (Chord::new(Modifiers::ALT, Key::Character('p')), "uv.unpin"),
    (Chord::new(Modifiers::NONE, Key::Character('v')), "uv.stitch"),
];

impl Editor {
    /// What a key does over the UV view alone.
    pub(super) fn key_over_uvs(&self, stage: &Stage, chord: Chord) -> Option<&'static Action> {
        let (_, name) = KEYS.iter().find(|(known, _)| *known == chord)?;
        self.uv_canvas(stage).and_then(|_| actions::named(name))
    }

    /// The UV view under the pointer.
    fn uv_canvas(&self, stage: &Stage) -> Option<(UvCanvas, DVec2)> {
        let at = point(stage, self.pointer?);
        let canvas = self.uv.canvas_at(at)?;
        Some((*canvas, canvas.uv(at)))
    }

    /// The tool that a key starts over the UV view. `hands` are in the window.
    pub(super) fn uv_tool(
        &self,
        stage: &Stage,
        pane: &Pane,
        kind: ToolKind,
        hands: Hands,
    ) -> Option<Box<dyn Tool>> {
        let transform = match kind {
            ToolKind::Move => UvTransform::Move,
            ToolKind::Rotate => UvTransform::Rotate,
            ToolKind::Scale => UvTransform::Scale,
            _ => return None,
        };
        let (canvas, _) = self.uv_canvas(stage)?;
        let [low, high] = uv::bounds(&self.document)?;
        let (scale, at) = (points(stage), canvas.point((low + high) / 2.0));
        let center = DVec2::new(at.x.into(), at.y.into()) * scale - pane.area.origin();
        let pixels = UvPixels { center, side: canvas.side * scale };
        Some(Box::new(UvTool::start(transform, pixels, self.uv.live_unwrap, in_pane(hands, pane))))
    }

    /// Whether a key over the UV view would change the mesh, which is not what is meant there; says so.
    pub(super) fn refuses_over_uvs(&mut self, stage: &Stage, action: &Action) -> bool {
        let gestures = ["select.box", "select.circle", "select.lasso"].contains(&action.name);
        if self.uv_canvas(stage).is_none() || !(gestures || action.menu.starts_with("Mesh")) {
            return false;
        }
        let remedy = match gestures {
            true => "drag with the left button here",
            false => "it is for the mesh: point at the 3D view",
        };
        self.message = Message::Refusal(format!("{}: {remedy}", action.label));
        true
    }

    /// Adds the island under the pointer to the selection. Returns whether the pointer is over the UV view.
    pub(super) fn select_island(&mut self, stage: &Stage) -> bool {
        let Some((_, at)) = self.uv_canvas(stage) else { return false };
        if let Some(command) = uv::island(&self.document, at, SelectAction::Add) {
            self.run(command);
        }
        true
    }

    /// Frames in the UV view what a request would in the 3D view. Returns whether the pointer is over the UV view.
    pub(super) fn frame_uvs(&mut self, stage: &Stage, request: ViewRequest) -> bool {
        let is_framing = matches!(request, ViewRequest::FrameSelected | ViewRequest::FrameAll);
        let Some((canvas, _)) = self.uv_canvas(stage).filter(|_| is_framing) else { return false };
        let selected = uv::bounds(&self.document).filter(|_| request == ViewRequest::FrameSelected);
        let [low, high] = selected.unwrap_or([DVec2::ZERO, DVec2::ONE]);
        self.uv.camera.frame(canvas.rect, low, high);
        true
    }
}
