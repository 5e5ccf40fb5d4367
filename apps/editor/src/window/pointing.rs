//! The id image in which the editor looks up what is under the pointer.
//!
//! It is a separate image: the one in the window may be a draft, and shows edges, vertices and X-ray. It is
//! kept until scene or camera change, so that repeated selections draw nothing.

use trigon_edit::mesh::edit::FaceId;
use trigon_edit::scene::camera::{Camera, Projector, Viewport};
use trigon_edit::scene::{
    Frame, KeptPoints, MeshId, Outputs, Picker, Reach, RenderSettings, Renderer, Scene,
};
use trigon_edit::{Document, Picks};
use trigon_window::scene::math::DVec2;
use trigon_window::{Pane, Stage};

/// An image of ids, drawn when somebody asks.
pub(crate) struct Pointing {
    renderer: Renderer,
    known: Option<Known>,
}

/// What the image is of.
struct Known {
    camera: Camera,
    viewport: Viewport,
    frame: Frame,
    /// Where points are in it, as far as somebody asked.
    points: KeptPoints,
}

impl Default for Pointing {
    fn default() -> Self {
        let outputs = Outputs { ids: true, depth: true, ..Outputs::NONE };
        let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(1, 1) };
        Self { renderer: Renderer::new(settings), known: None }
    }
}

impl Pointing {
    /// The scene is another one.
    pub(crate) fn forget(&mut self) {
        self.known = None;
    }

    /// The image of what the stage shows now; `None` where there is nothing to be seen.
    fn known(&mut self, scene: &Scene, camera: Camera, viewport: Viewport) -> Option<&mut Known> {
        let is_current =
            self.known.as_ref().is_some_and(|known| known.camera == camera && known.viewport == viewport);
        if !is_current {
            let settings = self.renderer.settings_mut();
            (settings.width, settings.height) = (viewport.width, viewport.height);
            let frame = self.renderer.render(scene, &camera).ok();
            self.known = frame.map(|frame| Known { camera, viewport, frame, points: KeptPoints::default() });
        }
        self.known.as_mut()
    }

    /// Asks what is under the pointer or in a region of a view, in its physical pixels; `None` while the window
    /// has no size.
    pub(crate) fn ask<T>(
        &mut self,
        document: &Document,
        (stage, pane): (&Stage, &Pane),
        reach: Reach,
        question: impl FnOnce(&Picks<'_>) -> T,
    ) -> Option<T> {
        let (camera, viewport) = (stage.camera_of(pane), pane.area.size);
        let Known { camera, viewport, frame, points } = self.known(&stage.scene, camera, viewport)?;
        let picker = Picker::with_points(&stage.scene, camera, frame, points);
        let answer = question(&Picks::new(document, &picker, Projector::new(camera, *viewport), reach));
        *points = picker.points();
        Some(answer)
    }

    /// The face of an edited mesh that is seen at a place of a view.
    pub(crate) fn face(
        &mut self,
        document: &Document,
        (stage, pane): (&Stage, &Pane),
        at: DVec2,
    ) -> Option<(MeshId, FaceId)> {
        let known = self.known(&stage.scene, stage.camera_of(pane), pane.area.size)?;
        if at.cmplt(DVec2::ZERO).any() {
            return None;
        }
        let hit = known.frame.hit(stage.scene.nodes(), at.x as u32, at.y as u32)?;
        let mesh = document.nodes().node(hit.node)?.mesh?;
        let face = *document.shown_elements(mesh)?.faces.get(hit.face?)?;
        document.selection().of(mesh)?;
        Some((mesh, face))
    }
}
