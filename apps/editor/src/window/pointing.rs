//! The id image in which the editor looks up what is under the pointer.
//!
//! It is a separate image: the one in the window may be a draft, and shows edges, vertices and X-ray. It is
//! kept until scene or camera change, so that repeated selections draw nothing. A press of a button announces a
//! question: another thread then prepares the answer while the hand goes on.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

use trigon_edit::mesh::edit::FaceId;
use trigon_edit::scene::camera::{Camera, Projector, Viewport};
use trigon_edit::scene::{
    Frame, KeptPoints, MeshId, Outputs, Picker, Reach, RenderSettings, Renderer, Scene,
};
use trigon_edit::{Document, Picks};
use trigon_window::scene::math::DVec2;
use trigon_window::{Pane, Stage};

/// Where it is looked up.
pub(crate) struct Pointing(Place);

enum Place {
    Here(Box<Lookup>),
    Elsewhere(Preparation),
}

/// A thread that prepares a lookup, and returns it when it is done.
struct Preparation {
    thread: JoinHandle<Box<Lookup>>,
    /// Whether it shall find the visible vertices, too.
    finds_vertices: Arc<AtomicBool>,
}

/// What a question may be about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Announced {
    /// A place.
    Place,
    /// The visible vertices in a region.
    Vertices,
}

/// An image of ids, drawn when somebody asks.
struct Lookup {
    renderer: Renderer,
    known: Option<Known>,
}

/// What the image is of.
struct Known {
    camera: Camera,
    viewport: Viewport,
    frame: Frame,
    /// What is known of points in it, as far as somebody asked.
    points: KeptPoints,
    /// Whether the visible vertices were looked for.
    is_searched: bool,
}

impl Default for Pointing {
    fn default() -> Self {
        Self(Place::Here(Box::default()))
    }
}

impl Default for Lookup {
    fn default() -> Self {
        let outputs = Outputs { ids: true, depth: true, ..Outputs::NONE };
        let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(1, 1) };
        Self { renderer: Renderer::new(settings), known: None }
    }
}

impl Pointing {
    /// The scene is another one.
    pub(crate) fn forget(&mut self) {
        self.here().known = None;
    }

    /// Waits until no other thread looks at the scene, which is about to change.
    pub(crate) fn wait(&mut self) {
        self.here();
    }

    /// A question about a view is likely to follow. A thread that is at work finds more if it is asked in time.
    pub(crate) fn announce(&mut self, (stage, pane): (&Stage, &Pane), about: Announced) {
        if let Place::Elsewhere(Preparation { thread, finds_vertices }) = &self.0
            && !thread.is_finished()
        {
            finds_vertices.fetch_or(about == Announced::Vertices, Ordering::Relaxed);
            return;
        }
        let lookup = self.here();
        let (camera, viewport) = (stage.camera_of(pane), pane.area.size);
        if lookup.is_prepared(&camera, viewport, about) {
            return;
        }
        let (mut lookup, scene) = (Box::new(std::mem::take(lookup)), Scene::clone(&stage.scene));
        let finds_vertices = Arc::new(AtomicBool::new(about == Announced::Vertices));
        let asked = Arc::clone(&finds_vertices);
        let prepare = move || {
            lookup.prepare(&scene, (camera, viewport), || asked.load(Ordering::Relaxed));
            lookup
        };
        // Without a thread the question takes longer.
        if let Ok(thread) = thread::Builder::new().name("trigon-pointing".into()).spawn(prepare) {
            self.0 = Place::Elsewhere(Preparation { thread, finds_vertices });
        }
    }

    /// The image, after the thread that prepares it is done.
    fn here(&mut self) -> &mut Lookup {
        if let Place::Elsewhere(_) = &self.0
            && let Place::Elsewhere(Preparation { thread, .. }) = std::mem::take(self).0
        {
            // After a panic nothing is known.
            self.0 = Place::Here(thread.join().unwrap_or_default());
        }
        match &mut self.0 {
            Place::Here(lookup) => lookup,
            Place::Elsewhere(_) => unreachable!("it was brought here"),
        }
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
        let known = self.here().known(&stage.scene, camera, viewport)?;
        let picker = Picker::with_points(&stage.scene, &camera, &known.frame, &known.points);
        let answer = question(&Picks::new(document, &picker, Projector::new(&camera, viewport), reach));
        known.points = picker.points();
        Some(answer)
    }

    /// The face of an edited mesh that is seen at a place of a view.
    pub(crate) fn face(
        &mut self,
        document: &Document,
        (stage, pane): (&Stage, &Pane),
        at: DVec2,
    ) -> Option<(MeshId, FaceId)> {
        let known = self.here().known(&stage.scene, stage.camera_of(pane), pane.area.size)?;
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

impl Lookup {
    /// Whether a question of this kind needs nothing more.
    fn is_prepared(&self, camera: &Camera, viewport: Viewport, about: Announced) -> bool {
        self.known.as_ref().is_some_and(|known| {
            known.camera == *camera
                && known.viewport == viewport
                && (about == Announced::Place || known.is_searched)
        })
    }

    /// `finds_vertices` is asked once the image is there.
    fn prepare(
        &mut self,
        scene: &Scene,
        (camera, viewport): (Camera, Viewport),
        finds_vertices: impl FnOnce() -> bool,
    ) {
        let Some(known) = self.known(scene, camera, viewport) else { return };
        if finds_vertices() {
            let picker = Picker::with_points(scene, &camera, &known.frame, &known.points);
            picker.find_visible_vertices();
            (known.points, known.is_searched) = (picker.points(), true);
        }
    }

    /// The image of what a camera sees of the scene; `None` where there is nothing to be seen.
    fn known(&mut self, scene: &Scene, camera: Camera, viewport: Viewport) -> Option<&mut Known> {
        if !self.is_prepared(&camera, viewport, Announced::Place) {
            let settings = self.renderer.settings_mut();
            (settings.width, settings.height) = (viewport.width, viewport.height);
            let frame = self.renderer.render(scene, &camera).ok();
            let points = KeptPoints::default();
            self.known = frame.map(|frame| Known { camera, viewport, frame, points, is_searched: false });
        }
        self.known.as_mut()
    }
}
