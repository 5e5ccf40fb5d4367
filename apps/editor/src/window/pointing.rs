//! The id image in which the editor looks up what is under the pointer.
//!
//! It is a separate image: the one in the window may be a draft, and shows edges, vertices and X-ray. It is
//! kept until scene or camera change, so that repeated selections draw nothing. A pressed button
//! prefetches: another thread prepares what a click or a region will ask for, while the user goes on.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

use trigon_document::modelling::FaceId;
use trigon_document::scene::camera::{Camera, Projector, Viewport};
use trigon_document::scene::{
    CachedPoints, Frame, MeshId, Outputs, Picker, Reach, RenderSettings, Renderer, Scene,
};
use trigon_document::{Document, Picks};
use trigon_window::scene::math::DVec2;
use trigon_window::{Pane, Stage};

/// The lookup. While a thread prefetches, that one has it, and an empty one is here.
#[derive(Default)]
pub(crate) struct Pointing {
    lookup: Lookup,
    task: Option<Task>,
}

/// A thread that prefetches, and returns the lookup when it is done.
struct Task {
    thread: JoinHandle<Lookup>,
    /// Whether it also has to find the visible vertices.
    finds_vertices: Arc<AtomicBool>,
}

/// What to prefetch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Prefetch {
    /// The id image.
    Ids,
    /// The id image, and which vertices are visible in it.
    VisibleVertices,
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
    points: CachedPoints,
    /// Whether the visible vertices are among that, if they can be kept.
    knows_visible_vertices: bool,
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
        self.lookup().known = None;
    }

    /// Waits until no other thread looks at the scene, which is about to change.
    pub(crate) fn wait(&mut self) {
        self.lookup();
    }

    /// Begins to prefetch for a view on another thread. One that already runs does more if it is asked in time.
    pub(crate) fn prefetch(&mut self, stage: &Stage, pane: &Pane, what: Prefetch) {
        if let Some(Task { thread, finds_vertices }) = &self.task
            && !thread.is_finished()
        {
            finds_vertices.fetch_or(what == Prefetch::VisibleVertices, Ordering::Relaxed);
            return;
        }
        let lookup = self.lookup();
        let (camera, viewport) = (stage.camera_of(pane), pane.area.size);
        if lookup.has(&camera, viewport, what) {
            return;
        }
        let (mut lookup, scene) = (std::mem::take(lookup), Scene::clone(&stage.scene));
        let finds_vertices = Arc::new(AtomicBool::new(what == Prefetch::VisibleVertices));
        let requested = Arc::clone(&finds_vertices);
        let work = move || {
            lookup.prefetch(&scene, camera, viewport, || requested.load(Ordering::Relaxed));
            lookup
        };
        // Without a thread the question itself finds out.
        let thread = thread::Builder::new().name("trigon-pointing".into()).spawn(work);
        self.task = thread.ok().map(|thread| Task { thread, finds_vertices });
    }

    /// Waits for the thread that prefetches, if there is one.
    fn lookup(&mut self) -> &mut Lookup {
        if let Some(task) = self.task.take() {
            // After a panic nothing is known.
            self.lookup = task.thread.join().unwrap_or_default();
        }
        &mut self.lookup
    }

    /// Asks what is under the pointer or in a region of a view, in its physical pixels; `None` while the window
    /// has no size.
    pub(crate) fn ask<T>(
        &mut self,
        document: &Document,
        stage: &Stage,
        pane: &Pane,
        reach: Reach,
        question: impl FnOnce(&Picks<'_>) -> T,
    ) -> Option<T> {
        let (camera, viewport) = (stage.camera_of(pane), pane.area.size);
        let known = self.lookup().known(&stage.scene, camera, viewport)?;
        let picker = Picker::with_points(&stage.scene, &camera, &known.frame, &known.points);
        let answer = question(&Picks::new(document, &picker, Projector::new(&camera, viewport), reach));
        known.points = picker.points();
        Some(answer)
    }

    /// The face of an edited mesh that is seen at a place of a view, or else around it, at most so many pixels away.
    pub(crate) fn face_near(
        &mut self,
        document: &Document,
        stage: &Stage,
        pane: &Pane,
        at: DVec2,
        reach: f64,
    ) -> Option<(MeshId, FaceId)> {
        /// Directions that are tried.
        const AROUND: [(f64, f64); 8] = [
            (1.0, 0.0),
            (0.0, 1.0),
            (-1.0, 0.0),
            (0.0, -1.0),
            (0.7, 0.7),
            (-0.7, 0.7),
            (-0.7, -0.7),
            (0.7, -0.7),
        ];
        let near = [0.5, 1.0]
            .into_iter()
            .flat_map(|part| AROUND.map(|(x, y)| at + DVec2::new(x, y) * (part * reach)));
        let positions = std::iter::once(at).chain(near.filter(|_| reach > 0.0));
        positions.into_iter().find_map(|at| self.face(document, stage, pane, at))
    }

    /// The face of an edited mesh that is seen at a place of a view.
    pub(crate) fn face(
        &mut self,
        document: &Document,
        stage: &Stage,
        pane: &Pane,
        at: DVec2,
    ) -> Option<(MeshId, FaceId)> {
        let known = self.lookup().known(&stage.scene, stage.camera_of(pane), pane.area.size)?;
        if at.cmplt(DVec2::ZERO).any() {
            return None;
        }
        let hit = known.frame.hit(stage.scene.nodes(), at.x as u32, at.y as u32)?;
        let mesh = document.nodes().node(hit.node)?.mesh?;
        let face = *document.shown_elements(mesh)?.faces.get(hit.face?)?;
        document.selection().of(mesh)?;
        // A face that modifiers made between others is none of the mesh.
        document.mesh(mesh)?.has_face(face).then_some((mesh, face))
    }
}

impl Lookup {
    /// Whether something of a view is known.
    fn has(&self, camera: &Camera, viewport: Viewport, what: Prefetch) -> bool {
        self.known.as_ref().is_some_and(|known| {
            known.camera == *camera
                && known.viewport == viewport
                && (what == Prefetch::Ids || known.knows_visible_vertices)
        })
    }

    /// `finds_vertices` is asked once the image is there.
    fn prefetch(
        &mut self,
        scene: &Scene,
        camera: Camera,
        viewport: Viewport,
        finds_vertices: impl FnOnce() -> bool,
    ) {
        let Some(known) = self.known(scene, camera, viewport) else { return };
        if finds_vertices() {
            let picker = Picker::with_points(scene, &camera, &known.frame, &known.points);
            picker.find_visible_vertices();
            (known.points, known.knows_visible_vertices) = (picker.points(), true);
        }
    }

    /// The image of what a camera sees of the scene; `None` where there is nothing to be seen.
    fn known(&mut self, scene: &Scene, camera: Camera, viewport: Viewport) -> Option<&mut Known> {
        if !self.has(&camera, viewport, Prefetch::Ids) {
            let settings = self.renderer.settings_mut();
            (settings.width, settings.height) = (viewport.width, viewport.height);
            let frame = self.renderer.render(scene, &camera).ok();
            let points = CachedPoints::default();
            self.known =
                frame.map(|frame| Known { camera, viewport, frame, points, knows_visible_vertices: false });
        }
        self.known.as_mut()
    }
}
