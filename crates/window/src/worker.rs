//! Drawing the scene beside the window's thread, so that the window never waits for
//! a picture.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use trigon_camera::Camera;
use trigon_scene::{Cancel, Frame, RenderError, RenderSettings, Renderer, Scene};

use crate::drawer::Drawer;
use crate::pacing::Quality;
use crate::refinement::{Compared, compare};

/// What a picture is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Purpose {
    /// The window.
    Window(Quality),
    /// Somebody asked for it.
    Picture,
}

/// What is to be done.
pub(crate) struct Job {
    pub(crate) purpose: Purpose,
    /// What pictures are drawn with.
    pub(crate) camera: Camera,
    pub(crate) task: Task,
}

/// A picture to be drawn, or two to be compared.
pub(crate) enum Task {
    Draw {
        scene: Arc<Scene>,
        settings: Box<RenderSettings>,
        /// Instead of the renderer.
        drawer: Option<Arc<dyn Drawer>>,
    },
    /// What was found, and what is right.
    Compare([Arc<Frame>; 2]),
}

/// What a job ends with.
pub(crate) enum Product {
    Picture(Frame),
    Comparison(Compared),
}

/// Why a job has no product.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unfinished {
    Cancelled,
    /// What a user should be told.
    Impossible(String),
}

/// What became of a job.
pub(crate) struct Finished {
    pub(crate) purpose: Purpose,
    pub(crate) camera: Camera,
    pub(crate) took: Duration,
    pub(crate) product: Result<Product, Unfinished>,
}

/// Does one job at a time.
pub(crate) struct Worker {
    /// What somebody waits for.
    first: Hands,
    /// What is only better than what is shown. Once that is cancelled, nobody waits until
    /// its last tiles are given up, which may take seconds where rays are cast.
    second: Option<Hands>,
    under_way: Option<UnderWay>,
    /// Given up, and not collected yet.
    abandoned: Option<UnderWay>,
    begun: u64,
}

/// A job that was begun.
struct UnderWay {
    number: u64,
    purpose: Purpose,
    camera: Camera,
    cancel: Cancel,
}

/// A job with its number, and what ends it.
type Numbered = (u64, Job, Cancel);

enum Hands {
    /// A thread, and what it has finished.
    Thread { jobs: Sender<Numbered>, finished: Receiver<(u64, Finished)> },
    /// The thread that asks. It takes no time, as far as others can tell: so what is
    /// drawn, and how well, does not depend on the machine.
    Caller { renderer: Box<Renderer>, finished: Option<Box<Finished>> },
}

impl Worker {
    /// A worker that draws where it is asked to, at once.
    pub(crate) fn of_caller() -> Self {
        Self::new(Hands::of_caller(), None)
    }

    /// A worker with threads of its own, which call `ring` whenever a job is finished.
    /// Where there are no threads to be had, the caller's.
    pub(crate) fn of_thread(ring: impl Fn() + Clone + Send + 'static) -> Self {
        match Hands::of_thread(ring.clone()) {
            Some(first) => Self::new(first, Hands::of_thread(ring)),
            None => Self::of_caller(),
        }
    }

    fn new(first: Hands, second: Option<Hands>) -> Self {
        Self { first, second, under_way: None, abandoned: None, begun: 0 }
    }

    /// Whether a job is under way.
    pub(crate) fn is_busy(&self) -> bool {
        self.under_way.is_some()
    }

    /// Begins a job; the last one is finished.
    pub(crate) fn begin(&mut self, job: Job) {
        self.begun += 1;
        let (number, cancel) = (self.begun, Cancel::default());
        let Job { purpose, camera, .. } = job;
        self.under_way = Some(UnderWay { number, purpose, camera, cancel: cancel.clone() });
        self.hands(purpose).begin((number, job, cancel));
    }

    /// Nobody will look at the job under way. It still has to be collected.
    pub(crate) fn cancel(&mut self) {
        let Some(job) = &self.under_way else { return };
        job.cancel.cancel();
        if self.second.is_some() && job.purpose.is_refinement() {
            self.abandoned = self.under_way.take();
        }
    }

    /// The job that was under way, if it is finished.
    pub(crate) fn collect(&mut self) -> Option<Finished> {
        if let Some(UnderWay { purpose, camera, .. }) = self.abandoned.take() {
            return Some(Finished {
                purpose,
                camera,
                took: Duration::ZERO,
                product: Err(Unfinished::Cancelled),
            });
        }
        let &UnderWay { number, purpose, .. } = self.under_way.as_ref()?;
        let finished = self.hands(purpose).finished(number)?;
        self.under_way = None;
        Some(finished)
    }

    /// Who does what is for this purpose.
    fn hands(&mut self, purpose: Purpose) -> &mut Hands {
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
    /// Whether there is a right picture already.
    fn is_refinement(self) -> bool {
        matches!(self, Self::Window(Quality::Full(1..)))
    }
}

impl Hands {
    fn of_caller() -> Self {
        Self::Caller { renderer: Box::new(Renderer::builder().build()), finished: None }
    }

    /// `None` where there are no threads to be had.
    fn of_thread(ring: impl Fn() + Send + 'static) -> Option<Self> {
        let (jobs, to_do) = channel::<Numbered>();
        let (done, finished) = channel();
        let work = move || {
            let mut renderer = Renderer::builder().build();
            while let Ok((number, job, cancel)) = to_do.recv() {
                if done.send((number, job.run(&mut renderer, &cancel))).is_err() {
                    return;
                }
                ring();
            }
        };
        thread::Builder::new().name("trigon-render".into()).spawn(work).ok()?;
        Some(Self::Thread { jobs, finished })
    }

    fn begin(&mut self, (number, job, cancel): Numbered) {
        match self {
            // The thread lives for as long as this does.
            Self::Thread { jobs, .. } => drop(jobs.send((number, job, cancel))),
            Self::Caller { renderer, finished } => {
                let done = job.run(renderer, &cancel);
                *finished = Some(Box::new(Finished { took: Duration::ZERO, ..done }));
            }
        }
    }

    /// What became of a job; what was abandoned before it is dropped.
    fn finished(&mut self, number: u64) -> Option<Finished> {
        match self {
            Self::Thread { finished, .. } => {
                finished.try_iter().find_map(|(of, finished)| (of == number).then_some(finished))
            }
            Self::Caller { finished, .. } => finished.take().map(|finished| *finished),
        }
    }
}

impl Job {
    fn run(self, renderer: &mut Renderer, cancel: &Cancel) -> Finished {
        let begun = Instant::now();
        let product = match self.task {
            Task::Draw { scene, settings, drawer } => {
                let drawn = match drawer {
                    None => render((&scene, &self.camera), *settings, renderer, cancel),
                    Some(drawer) => draw_otherwise(&*drawer, (&scene, &self.camera), &settings, cancel),
                };
                drawn.map(Product::Picture)
            }
            Task::Compare([found, right]) => {
                compare(&found, &right, cancel).map(Product::Comparison).ok_or(Unfinished::Cancelled)
            }
        };
        Finished { purpose: self.purpose, camera: self.camera, took: begun.elapsed(), product }
    }
}

fn render(
    (scene, camera): (&Scene, &Camera),
    settings: RenderSettings,
    renderer: &mut Renderer,
    cancel: &Cancel,
) -> Result<Frame, Unfinished> {
    *renderer.settings_mut() = settings;
    renderer.render_cancellable(scene, camera, cancel).map_err(|error| match error {
        RenderError::Cancelled => Unfinished::Cancelled,
        error => Unfinished::Impossible(error.to_string()),
    })
}

/// A picture of another size or without colours is none.
fn draw_otherwise(
    drawer: &dyn Drawer,
    (scene, camera): (&Scene, &Camera),
    settings: &RenderSettings,
    cancel: &Cancel,
) -> Result<Frame, Unfinished> {
    let drawn = drawer.draw(scene, camera, settings, cancel);
    if cancel.is_cancelled() {
        return Err(Unfinished::Cancelled);
    }
    let frame = drawn.map_err(Unfinished::Impossible)?;
    let RenderSettings { width, height, .. } = *settings;
    if [frame.width, frame.height] == [width, height]
        && frame.color.len() == 4 * width as usize * height as usize
    {
        return Ok(frame);
    }
    Err(Unfinished::Impossible(format!(
        "a picture of {}x{} was drawn for one of {width}x{height}",
        frame.width, frame.height
    )))
}

#[cfg(test)]
mod tests {
    use super::{
        Cancel, Drawer, Finished, Frame, Job, Product, Purpose, Quality, RenderSettings, Scene, Task,
        Unfinished, Worker,
    };
    use std::sync::Arc;
    use std::sync::mpsc::channel;
    use std::time::Duration;
    use trigon_camera::Camera;
    use trigon_scene::{render, showcase};

    fn job(side: u32, samples: u32) -> Job {
        let scene = showcase();
        let camera = scene.overview(1.0);
        let settings = RenderSettings { samples_per_axis: samples, ..RenderSettings::new(side, side) };
        let task = Task::Draw { scene: Arc::new(scene), settings: Box::new(settings), drawer: None };
        Job { purpose: Purpose::Picture, camera, task }
    }

    /// The picture of a job that was finished.
    fn picture(worker: &mut Worker) -> Option<Frame> {
        match worker.collect()?.product {
            Ok(Product::Picture(frame)) => Some(frame),
            _ => None,
        }
    }

    #[test]
    fn a_thread_draws_what_the_caller_would() {
        let scene = showcase();
        let settings = RenderSettings { samples_per_axis: 2, ..RenderSettings::new(40, 40) };
        let expected = render(&scene, &scene.overview(1.0), &settings).expect("drawn");
        let (ring, rung) = channel();
        let mut worker = Worker::of_thread(move || {
            let _ = ring.send(());
        });
        worker.begin(job(40, 2));
        rung.recv_timeout(Duration::from_secs(60)).expect("it rings when it is done");
        assert!(picture(&mut worker).as_ref() == Some(&expected), "the same bytes");
        assert!(!worker.is_busy(), "ready for the next one");
        let mut caller = Worker::of_caller();
        caller.begin(job(40, 2));
        assert!(picture(&mut caller) == Some(expected), "the same bytes here");
    }

    #[test]
    fn a_cancelled_job_makes_room_for_the_next() {
        let (ring, rung) = channel();
        let mut worker = Worker::of_thread(move || {
            let _ = ring.send(());
        });
        // Hundreds of tiles with sixteen samples a pixel: minutes.
        worker.begin(job(8192, 4));
        worker.cancel();
        rung.recv_timeout(Duration::from_secs(60)).expect("it ends");
        let finished = worker.collect().expect("it has ended");
        assert_eq!(finished.product.err(), Some(Unfinished::Cancelled), "without a picture");
        worker.begin(job(8, 1));
        rung.recv_timeout(Duration::from_secs(60)).expect("it goes on");
        assert!(picture(&mut worker).is_some(), "with the next one");
    }

    #[test]
    fn nobody_waits_for_the_last_tiles_of_what_was_only_better() {
        let (ring, rung) = channel();
        let mut worker = Worker::of_thread(move || {
            let _ = ring.send(());
        });
        worker.begin(Job { purpose: Purpose::Window(Quality::Full(2)), ..job(8192, 4) });
        worker.cancel();
        assert!(!worker.is_busy(), "there is room at once");
        let given_up = worker.collect().expect("told at once, too");
        assert_eq!(given_up.product.err(), Some(Unfinished::Cancelled), "without a picture");
        worker.begin(Job { purpose: Purpose::Window(Quality::Full(1)), ..job(8, 1) });
        let found = std::iter::from_fn(|| {
            rung.recv_timeout(Duration::from_secs(60)).expect("it goes on");
            Some(picture(&mut worker))
        });
        let found = found.flatten().next().expect("in the end");
        assert_eq!(found.width, 8, "with the next one, and not with what was given up");
    }

    /// Draws a picture of some size, or refuses.
    struct Other(Result<u32, String>);

    impl Drawer for Other {
        fn draw(&self, _: &Scene, _: &Camera, _: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
            let side = self.0.clone()?;
            let color = vec![7; 4 * side as usize * side as usize];
            Ok(Frame { width: side, height: side, color, ..Frame::default() })
        }
    }

    #[test]
    fn other_drawers_are_heard_and_not_trusted() {
        let product = |drawer: Other| {
            let mut job = job(8, 1);
            if let Task::Draw { drawer: used, .. } = &mut job.task {
                *used = Some(Arc::new(drawer));
            }
            let mut worker = Worker::of_caller();
            worker.begin(job);
            worker.collect().map(|Finished { product, .. }| product)
        };
        let drawn = product(Other(Ok(8)));
        assert!(matches!(drawn, Some(Ok(Product::Picture(frame))) if frame.color[0] == 7), "its picture");
        let reason = |product| match product {
            Some(Err(Unfinished::Impossible(reason))) => reason,
            _ => String::new(),
        };
        assert_eq!(reason(product(Other(Err("not convex".into())))), "not convex", "its reason");
        assert!(reason(product(Other(Ok(3)))).contains("3x3"), "a picture of the wrong size is none");
    }
}
