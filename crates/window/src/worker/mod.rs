//! Draws the scene on worker threads, so that the window never waits for an image.

mod coarse;

use std::num::NonZeroUsize;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};
use std::thread;
use std::time::Duration;

use trigon_camera::Camera;
use trigon_scene::{Cancel, Frame, Outputs, Rect, RenderError, RenderSettings, Renderer, Scene, StageTimes};

use self::coarse::{CoarseMeshMaker, coarse_settings, makes_coarse};
use crate::drawer::Drawer;
use crate::pacing::Quality;
use crate::panes::Views;
use crate::refinement::{Compared, compare};
use crate::shared_scene::{Revision, SceneUpdate};

/// The purpose of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Purpose {
    /// The window.
    Window(Quality),
    /// Requested by the application.
    Image,
}

/// The task.
pub(crate) struct Job {
    pub(crate) purpose: Purpose,
    /// The cameras to draw from.
    pub(crate) views: Views,
    pub(crate) task: Task,
}

/// An image to draw, or two to compare.
pub(crate) enum Task {
    Draw {
        /// Makes the thread's replica equal to the scene to draw; see [`Worker::held`].
        scene: SceneUpdate,
        settings: Box<RenderSettings>,
        /// Instead of the renderer.
        drawer: Option<Arc<dyn Drawer>>,
    },
    /// The image and its reference.
    Compare([Arc<Frame>; 2]),
    /// Drops the thread's replica, which is no longer needed. There is no product.
    Forget,
}

/// The result of a job.
pub(crate) enum Product {
    Frame(Arc<Frame>),
    Comparison(Box<Compared>),
}

/// Why a job has no product.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unfinished {
    Cancelled,
    /// A message for the user.
    Impossible(String),
}

impl From<RenderError> for Unfinished {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Cancelled => Self::Cancelled,
            error => Self::Impossible(error.to_string()),
        }
    }
}

/// The outcome of a job.
pub(crate) struct Finished {
    pub(crate) purpose: Purpose,
    pub(crate) views: Views,
    pub(crate) took: Duration,
    /// The part of it that is proportional to the number of pixels: all of it where that is unknown.
    pub(crate) pixels: Duration,
    /// Of the last view.
    pub(crate) stages: StageTimes,
    pub(crate) product: Result<Product, Unfinished>,
    /// Whether coarser meshes were drawn.
    pub(crate) is_coarse: bool,
    /// The difference between an image and the last one, if it is known.
    pub(crate) redrawn: Option<Redrawn>,
}

/// The parts in which an image may differ from an earlier one.
#[derive(Debug, Default)]
pub(crate) struct Redrawn {
    /// The earlier image and the later one.
    pub(crate) images: [Weak<Frame>; 2],
    pub(crate) parts: Vec<Rect>,
}

impl Redrawn {
    /// The parts, if these are the two images.
    pub(crate) fn between(&self, before: &Weak<Frame>, after: &Arc<Frame>) -> Option<&[Rect]> {
        let are_these = self.images[0].ptr_eq(before) && self.images[1].as_ptr() == Arc::as_ptr(after);
        are_these.then_some(&self.parts)
    }
}

/// Does one job at a time.
pub(crate) struct Worker {
    /// Jobs that somebody waits for.
    first: Holder,
    /// Jobs that only improve the image on screen. Once cancelled, nobody waits until their last
    /// tiles are abandoned, which may take seconds if rays are cast.
    second: Option<Holder>,
    under_way: Option<JobInProgress>,
    /// Abandoned, and not collected yet.
    abandoned: Option<JobInProgress>,
    begun: u64,
}

impl Job {
    /// How many drawings it takes.
    fn drawings(&self) -> u32 {
        let of_view = match &self.task {
            Task::Draw { drawer: Some(drawer), .. } => drawer.drawings(),
            _ => 1,
        };
        self.views.count() * of_view
    }
}

/// A job that was begun.
struct JobInProgress {
    number: u64,
    purpose: Purpose,
    views: Views,
    cancel: Cancel,
}

/// A job with its number, and its cancellation.
struct Numbered {
    number: u64,
    job: Job,
    cancel: Cancel,
}

/// A thread or the caller that does jobs, and the revision that its replica of the scene equals.
struct Holder {
    hands: RenderThread,
    held: Option<Revision>,
}

enum RenderThread {
    /// A thread, and its finished jobs.
    Thread { jobs: Sender<Numbered>, finished: Receiver<(u64, Finished)> },
    /// The calling thread. It takes no time as far as others can tell, so what is drawn, and in
    /// which quality, does not depend on the machine.
    Caller { drawing: Box<Drawing>, finished: Option<Box<Finished>> },
}

/// Executes jobs.
struct Drawing {
    renderer: Renderer,
    /// A replica of the window's scene, so that neither waits for the other.
    scene: Scene,
    /// The last image.
    last: Weak<Frame>,
    coarse_meshes: CoarseMeshMaker,
    /// Returns the time since any fixed moment.
    clock: Box<dyn Fn() -> Duration + Send>,
}

impl Worker {
    /// A worker that draws on the calling thread, at once.
    pub(crate) fn of_caller() -> Self {
        Self::new(RenderThread::of_caller(), None)
    }

    /// A worker with its own threads, which call `ring` whenever a job is finished. `clock`
    /// measures jobs: the time since any fixed moment. If no threads can be created, the caller's
    /// is used.
    pub(crate) fn of_threads(
        ring: impl Fn() + Clone + Send + 'static,
        clock: impl Fn() -> Duration + Clone + Send + 'static,
    ) -> Self {
        Self::of_runs(ring, || {
            let mut drawing = Drawing::new(CoarseMeshMaker::Thread(None), clock.clone());
            move |job, cancel: &Cancel| drawing.run(job, cancel)
        })
    }

    /// With one of `runs` on each thread, which executes its jobs.
    fn of_runs<R>(ring: impl Fn() + Clone + Send + 'static, runs: impl Fn() -> R) -> Self
    where
        R: FnMut(Job, &Cancel) -> Finished + Send + 'static,
    {
        match RenderThread::of_thread(runs(), ring.clone()) {
            Some(first) => Self::new(first, RenderThread::of_thread(runs(), ring)),
            None => Self::of_caller(),
        }
    }

    fn new(first: RenderThread, second: Option<RenderThread>) -> Self {
        let (first, second) = (Holder::new(first), second.map(Holder::new));
        Self { first, second, under_way: None, abandoned: None, begun: 0 }
    }

    /// Whether a job is under way.
    pub(crate) fn is_busy(&self) -> bool {
        self.under_way.is_some()
    }

    /// How much of the image in progress is drawn, in percent; 0 if there is none, or only its geometry is prepared.
    pub(crate) fn percent(&self) -> u8 {
        self.under_way.as_ref().map_or(0, |job| (job.cancel.progress() * 100.0) as u8)
    }

    /// The revision that the replica for this purpose equals, once all jobs begun so far are done.
    pub(crate) fn held(&mut self, purpose: Purpose) -> &mut Option<Revision> {
        &mut self.holder(purpose).held
    }

    /// Begins a job; the previous one is finished.
    pub(crate) fn begin(&mut self, job: Job) {
        if matches!(job.task, Task::Draw { scene: SceneUpdate::Whole(_), .. }) {
            self.forget_others(job.purpose);
        }
        self.begun += 1;
        let (number, cancel) = (self.begun, Cancel::for_drawings(job.drawings()));
        let Job { purpose, ref views, .. } = job;
        self.under_way =
            Some(JobInProgress { number, purpose, views: views.clone(), cancel: cancel.clone() });
        self.holder(purpose).hands.begin(Numbered { number, job, cancel });
    }

    /// Another scene replaced the previous one, which the second thread should not keep until it
    /// draws again.
    fn forget_others(&mut self, purpose: Purpose) {
        let Some(second) = self.second.as_mut().filter(|_| !purpose.is_refinement()) else { return };
        if second.held.take().is_some() {
            let forget = Job { purpose, views: Camera::default().into(), task: Task::Forget };
            second.hands.begin(Numbered { number: 0, job: forget, cancel: Cancel::default() });
        }
    }

    /// Nobody will see the job in progress. It still has to be collected.
    pub(crate) fn cancel(&mut self) {
        let Some(job) = &self.under_way else { return };
        job.cancel.cancel();
        if self.second.is_some() && job.purpose.is_refinement() {
            self.abandoned = self.under_way.take();
        }
    }

    /// The job that was in progress, if it is finished.
    pub(crate) fn collect(&mut self) -> Option<Finished> {
        if let Some(JobInProgress { purpose, views, .. }) = self.abandoned.take() {
            return Some(Finished {
                purpose,
                views,
                took: Duration::ZERO,
                pixels: Duration::ZERO,
                stages: StageTimes::default(),
                product: Err(Unfinished::Cancelled),
                is_coarse: false,
                redrawn: None,
            });
        }
        let &JobInProgress { number, purpose, .. } = self.under_way.as_ref()?;
        let finished = self.holder(purpose).hands.finished(number)?;
        self.under_way = None;
        Some(finished)
    }

    /// The thread for this purpose.
    fn holder(&mut self, purpose: Purpose) -> &mut Holder {
        match &mut self.second {
            Some(second) if purpose.is_refinement() => second,
            _ => &mut self.first,
        }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.cancel();
    }
}

impl Purpose {
    /// Whether an up-to-date image exists.
    fn is_refinement(self) -> bool {
        matches!(self, Self::Window(Quality::Full(1..)))
    }
}

impl Holder {
    fn new(hands: RenderThread) -> Self {
        Self { hands, held: None }
    }
}

impl RenderThread {
    fn of_caller() -> Self {
        Self::Caller {
            drawing: Box::new(Drawing::new(CoarseMeshMaker::Caller, || Duration::ZERO)),
            finished: None,
        }
    }

    /// `None` if no threads can be created.
    fn of_thread(
        mut run: impl FnMut(Job, &Cancel) -> Finished + Send + 'static,
        ring: impl Fn() + Send + 'static,
    ) -> Option<Self> {
        let (jobs, to_do) = channel::<Numbered>();
        let (done, finished) = channel();
        let work = move || {
            while let Ok(Numbered { number, job, cancel }) = to_do.recv() {
                let is_silent = matches!(job.task, Task::Forget);
                if done.send((number, run(job, &cancel))).is_err() {
                    return;
                }
                if !is_silent {
                    ring();
                }
            }
        };
        thread::Builder::new().name("trigon-render".into()).spawn(work).ok()?;
        Some(Self::Thread { jobs, finished })
    }

    fn begin(&mut self, numbered: Numbered) {
        match self {
            // The thread lives as long as this does.
            Self::Thread { jobs, .. } => drop(jobs.send(numbered)),
            Self::Caller { drawing, finished } => {
                *finished = Some(Box::new(drawing.run(numbered.job, &numbered.cancel)));
            }
        }
    }

    /// The outcome of a job; abandoned jobs before it are dropped.
    fn finished(&mut self, number: u64) -> Option<Finished> {
        match self {
            Self::Thread { finished, .. } => {
                finished.try_iter().find_map(|(of, finished)| (of == number).then_some(finished))
            }
            Self::Caller { finished, .. } => finished.take().map(|finished| *finished),
        }
    }
}

impl Drawing {
    fn new(coarse_meshes: CoarseMeshMaker, clock: impl Fn() -> Duration + Send + 'static) -> Self {
        let mut renderer = Renderer::builder().build();
        // From these times the size of drafts follows.
        renderer.time_stages();
        Self { renderer, scene: Scene::new(), last: Weak::new(), coarse_meshes, clock: Box::new(clock) }
    }

    fn run(&mut self, Job { purpose, views, task }: Job, cancel: &Cancel) -> Finished {
        let begun = (self.clock)();
        let threads = match &task {
            Task::Draw { drawer: None, settings, .. } => Some(settings.threads),
            _ => None,
        };
        let (count, mut is_coarse) = (views.count(), false);
        let product = match task {
            Task::Draw { scene, mut settings, drawer } => {
                // Also for a cancelled image: the next update relies on it.
                scene.apply(&mut self.scene);
                let Self { renderer, scene, .. } = self;
                if let (None, Some(coarse)) = (&drawer, coarse_settings(purpose, scene, &settings)) {
                    (*settings, is_coarse) = (coarse, true);
                }
                let makes_coarse = makes_coarse(purpose, scene, &settings);
                let drawn = views.draw(*settings, |camera, settings| {
                    match (&drawer, purpose) {
                        (None, Purpose::Window(_)) if is_coarse => {
                            *renderer.settings_mut() = settings;
                            renderer.render_draft(scene, camera, Some(cancel)).map_err(Unfinished::from)
                        }
                        (None, Purpose::Window(_)) => {
                            *renderer.settings_mut() = settings;
                            renderer.render_shared(scene, camera, Some(cancel)).map_err(Unfinished::from)
                        }
                        // Whoever asked for it keeps it.
                        (None, Purpose::Image) => {
                            ViewRequest { scene, camera, settings, cancel }.render(renderer).map(Arc::new)
                        }
                        (Some(drawer), _) => ViewRequest { scene, camera, settings, cancel }
                            .draw_by(&**drawer, renderer)
                            .map(Arc::new),
                    }
                });
                if makes_coarse && drawn.is_ok() {
                    self.coarse_meshes.make(scene);
                }
                drawn.map(Product::Frame)
            }
            Task::Compare([found, right]) => compare(&found, &right, cancel)
                .map(|compared| Product::Comparison(Box::new(compared)))
                .ok_or(Unfinished::Cancelled),
            Task::Forget => {
                self.scene = Scene::new();
                Err(Unfinished::Cancelled)
            }
        };
        let (took, stages) = ((self.clock)().saturating_sub(begun), self.renderer.stats().times);
        let of_pixels = |threads| count * time_of_pixels(&stages, threads);
        let pixels = threads.map_or(took, |threads| took.min(of_pixels(threads)));
        let redrawn = match &product {
            Ok(Product::Frame(frame)) => self.redrawn(frame),
            _ => None,
        };
        Finished { purpose, views, took, pixels, stages, product, is_coarse, redrawn }
    }

    /// The difference between an image and the last one, which it replaces.
    fn redrawn(&mut self, frame: &Arc<Frame>) -> Option<Redrawn> {
        let images = [std::mem::replace(&mut self.last, Arc::downgrade(frame)), Arc::downgrade(frame)];
        let parts = self.renderer.redrawn_between(&*images[0].upgrade()?, frame)?;
        Some(Redrawn { images, parts })
    }
}

/// How long the tiles of an image took, whose times are sums over all threads: so many, or as many as there are cores.
fn time_of_pixels(stages: &StageTimes, threads: Option<NonZeroUsize>) -> Duration {
    let cores = || thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let threads = threads.map_or_else(cores, NonZeroUsize::get) as u32;
    (stages.visibility + stages.shading + stages.blending + stages.resolve) / threads
}

/// What to draw for one view.
struct ViewRequest<'s> {
    scene: &'s Scene,
    camera: &'s Camera,
    settings: RenderSettings,
    cancel: &'s Cancel,
}

impl ViewRequest<'_> {
    /// A frame that nobody else holds.
    fn render(self, renderer: &mut Renderer) -> Result<Frame, Unfinished> {
        let mut frame = Frame::default();
        *renderer.settings_mut() = self.settings;
        renderer.render_cancellable(self.scene, self.camera, self.cancel, &mut frame)?;
        Ok(frame)
    }

    /// Another drawer's image. Where it shows the scene, ids and depths come from the renderer if the settings
    /// require them and the drawer does not provide them.
    fn draw_by(self, drawer: &dyn Drawer, renderer: &mut Renderer) -> Result<Frame, Unfinished> {
        let frame = self.checked_image(drawer)?;
        if !drawer.shows_scene() {
            return Ok(Frame { depth: None, object_ids: None, face_ids: None, ..frame });
        }
        let RenderSettings { outputs, .. } = self.settings;
        if !outputs.ids || (frame.object_ids.is_some() && frame.face_ids.is_some() && frame.depth.is_some()) {
            return Ok(frame);
        }
        let outputs = Outputs { color: false, radiance: false, ..outputs };
        let settings = RenderSettings { outputs, samples_per_axis: 1, samples: 1, ..self.settings };
        let Frame { depth, object_ids, face_ids, .. } = Self { settings, ..self }.render(renderer)?;
        Ok(Frame { depth, object_ids, face_ids, ..frame })
    }

    /// Another drawer's image; one of another size or without colours is rejected.
    fn checked_image(&self, drawer: &dyn Drawer) -> Result<Frame, Unfinished> {
        let drawn = drawer.draw(self.scene, self.camera, &self.settings, self.cancel);
        if self.cancel.is_cancelled() {
            return Err(Unfinished::Cancelled);
        }
        let frame = drawn.map_err(Unfinished::Impossible)?;
        let RenderSettings { width, height, .. } = self.settings;
        if [frame.width, frame.height] == [width, height]
            && frame.color.len() == 4 * width as usize * height as usize
        {
            return Ok(frame);
        }
        Err(Unfinished::Impossible(format!(
            "an image of {}x{} was drawn for one of {width}x{height}",
            frame.width, frame.height
        )))
    }
}

#[cfg(test)]
pub(crate) mod gate;

#[cfg(test)]
mod tests;
